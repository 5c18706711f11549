//! Crates that read a robot at run time.

use std::error::Error;
use std::hint::black_box;
use std::path::Path;

use phyz_math::{DVec, Mat3, SpatialInertia, SpatialTransform, Vec3};
use phyz_model::{Model, ModelBuilder};

use crate::{Ready, timed};

/// Computes them by `dynibo`, whose gravity is 9.80665 m/s² against z whatever the robot says.
pub fn dynibo(urdf: &Path, function: &str) -> Result<Option<Ready>, Box<dyn Error>> {
    let robot = dynibo::Robot::from_urdf(urdf)?;
    let mut result = vec![0.0; robot.generalized_count()];
    let n = result.len();
    let inverse = match function {
        "inverse_dynamics" => true,
        "forward_dynamics" => false,
        _ => return Ok(None),
    };
    let run = move |robot: &mut dynibo::Robot, state: &[f64], result: &mut [f64]| {
        let (q, qd, x) = (&state[..n], &state[n..2 * n], &state[2 * n..]);
        let done = if inverse {
            robot.inverse_dynamics(q, qd, x, &[], result)
        } else {
            robot.forward_dynamics(q, qd, x, &[], result)
        };
        done.expect("vectors of the robot's length");
    };
    let (mut first, mut second, mut other) = (robot.fork(), robot, result.clone());
    Ok(Some(Ready {
        compute: Box::new(move |q, qd, x, out| {
            run(&mut first, &[q, qd, x].concat(), &mut other);
            out.extend(&other);
        }),
        batch: Box::new(move |states| {
            timed(states, |state| {
                run(&mut second, state, &mut result);
                black_box(&result);
            })
        }),
    }))
}

/// Computes them by `phyz-rigid`, of rows `slides rotation(9) place(3) mass com(3) inertia(9)`
/// after one of gravity.
pub fn phyz(rows: &[Vec<f64>], function: &str) -> Option<Ready> {
    let (gravity, joints) = rows.split_first()?;
    let vector = |x: &[f64]| Vec3::new(x[0], x[1], x[2]);
    let matrix = |x: &[f64]| Mat3::new(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8]);
    let mut builder = ModelBuilder::new().gravity(vector(gravity));
    for (i, row) in joints.iter().enumerate() {
        // The crate's rotations are from the parent's axes to the joint's.
        let place = SpatialTransform::new(matrix(&row[1..10]).transpose(), vector(&row[10..13]));
        let inertia = SpatialInertia::new(row[13], vector(&row[14..17]), matrix(&row[17..26]));
        let (name, parent) = (format!("l{i}"), i as i32 - 1);
        builder = if row[0] == 1.0 {
            let z = Vec3::new(0.0, 0.0, 1.0);
            builder.add_prismatic_body(&name, parent, place, z, inertia)
        } else {
            builder.add_revolute_body(&name, parent, place, inertia)
        };
    }
    let model = builder.build();
    let n = joints.len();
    let inverse = match function {
        "inverse_dynamics" => true,
        "forward_dynamics" => false,
        _ => return None,
    };
    let run = move |model: &Model, state: &mut phyz_model::State, x: &[f64]| -> DVec {
        let (q, rest) = x.split_at(n);
        state.q.as_mut_slice().copy_from_slice(q);
        state.v.as_mut_slice().copy_from_slice(&rest[..n]);
        if inverse {
            phyz_rigid::rnea(model, state, &DVec::from_slice(&rest[n..]))
        } else {
            state.ctrl.as_mut_slice().copy_from_slice(&rest[n..]);
            phyz_rigid::aba(model, state)
        }
    };
    let other = model.clone();
    let mut scratch = (model.default_state(), model.default_state());
    Some(Ready {
        compute: Box::new(move |q, qd, x, out| {
            let tau = run(&model, &mut scratch.0, &[q, qd, x].concat());
            out.extend(tau.as_slice());
        }),
        batch: Box::new(move |states| {
            timed(states, |state| {
                black_box(run(&other, &mut scratch.1, state));
            })
        }),
    })
}
