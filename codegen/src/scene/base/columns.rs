//! Columns of a regressor modulo 2⁶¹ − 1, at random states.

use std::cell::RefCell;

use dalembert_model::equations::following::gather;
use dalembert_model::equations::regressor::Column;
use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::number::{Angle, Exact, Rational};
use dalembert_model::outputs::{RuntimeParameter, Written};
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::record::{Recorder, Recording};

use crate::function::{Argument, Quantity};
use crate::program::Input;
use crate::scene::SceneRobot;

/// A seed of its own.
const SEED: u64 = 0x6261_7365;

/// Columns modulo the prime, each over the rows of so many random states that
/// every dependence that is none shows; `None` if a constant has no value.
pub(super) fn values(
    scene_robot: &SceneRobot,
    quantity: Quantity,
    columns: &[Column<Exact>],
) -> Option<Vec<Vec<Field>>> {
    let points = RefCell::new(Points::new(SEED));
    let circle = || {
        let (sin, cos) = points.borrow_mut().circle();
        SinCosPair { sin, cos }
    };
    // Constant angles are the same in every state.
    let angles: RefCell<Vec<(Angle, SinCosPair<Field>)>> = RefCell::default();
    let constant = |value: &Exact| {
        let pair = &mut |angle: &Angle| {
            let mut angles = angles.borrow_mut();
            if let Some((_, pair)) = angles.iter().find(|(known, _)| known == angle) {
                return pair.clone();
            }
            let pair = circle();
            angles.push((angle.clone(), pair.clone()));
            pair
        };
        value.map(&mut |x: &Rational| Field::from_rational(x), pair)
    };
    let entries = entries(scene_robot, quantity, columns);
    let mut found: Vec<Vec<Field>> = vec![Vec::new(); columns.len()];
    let states = columns.len() / scene_robot.rows().len().max(1) + 4;
    for _ in 0..states {
        let pairs: Vec<SinCosPair<Field>> = scene_robot.joints().iter().map(|_| circle()).collect();
        let input = |input: &Input| match *input {
            Input::Sin(angle) => angle.pair(|joint| pairs[joint].clone()).sin,
            Input::Cos(angle) => angle.pair(|joint| pairs[joint].clone()).cos,
            Input::PerSpeed(_) | Input::Entry(..) => points.borrow_mut().field(),
        };
        let entries = entries.run(input, constant)?;
        let rows: Vec<&[Field]> = entries.chunks(columns.len().max(1)).collect();
        for &joint in scene_robot.rows() {
            let row = scene_robot.robot().row_of(joint);
            for (column, entry) in found.iter_mut().zip(rows[row]) {
                column.push(*entry);
            }
        }
    }
    Some(found)
}

/// Returns every entry of the regressor, row by row, as a formula; those of joints that follow
/// gathered at their leaders.
fn entries(
    scene_robot: &SceneRobot,
    quantity: Quantity,
    columns: &[Column<Exact>],
) -> Recording<Input, Exact> {
    let recorder = Recorder::new();
    let (input, constant) = (|x| recorder.input(x), |x: &Exact| recorder.constant(x));
    let mut arm = Arm::from_robot(scene_robot.robot(), &mut { constant });
    let columns: Vec<_> = columns.iter().map(|c| c.map(constant)).collect();
    let motion = scene_robot.motion(input, constant);
    if scene_robot.has(RuntimeParameter::Gravity) {
        let entry = |axis| input(Input::Entry(Argument::Gravity, axis));
        arm = arm.with_gravity(&[0, 1, 2].map(entry));
    }
    let arm = arm.at_speeds(&motion.per_speed);
    let mut entries = quantity.written(&Written {
        formulation: Formulation::NewtonEulerLink,
        arm: &arm,
        at: &arm.at(&motion.q),
        motion: &motion,
        columns: &columns,
    });
    let rows: Vec<usize> = (0..arm.links.len()).collect();
    gather(&arm.following, &rows, columns.len(), &mut entries);
    recorder.finish(&entries)
}
