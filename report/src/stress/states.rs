//! States where robots are not.

use dalembert_model::reference::Reference;
use dalembert_model::robot::{JointKind, Robot};
use nalgebra::DVector;

use dalembert_codegen::workspace::{JointState, Random, seeded};

/// Angles up to `size`.
pub fn angles(robot: &Robot, count: usize, seed: u64, size: f64) -> Vec<JointState> {
    let mut random = Random::new(seed ^ size.to_bits());
    let mut states = seeded(robot, count, seed);
    for (q, joint) in states
        .iter_mut()
        .flat_map(|s| s.q.iter_mut().zip(&robot.joints))
    {
        if joint.kind == JointKind::Revolute {
            *q = size * (2.0 * random.unit() - 1.0);
        }
    }
    states
}

/// Positions, velocities and accelerations times a factor each.
pub fn times(robot: &Robot, count: usize, seed: u64, factors: [f64; 3]) -> Vec<JointState> {
    let mut states = seeded(robot, count, seed);
    for state in &mut states {
        let rows = [&mut state.q, &mut state.qd, &mut state.qdd];
        for (values, factor) in rows.into_iter().zip(factors) {
            values.iter_mut().for_each(|x| *x *= factor);
        }
    }
    states
}

/// Returns the last joint but one of the revolute ones where its neighbours' axes are
/// parallel, θ = 0 or π: what a wrist calls singular.
pub fn wrist(robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
    let revolute = revolute(robot);
    let bend = revolute.iter().rev().nth(1).or(revolute.last()).copied();
    let mut states = seeded(robot, count, seed);
    for (index, state) in states.iter_mut().enumerate() {
        if let Some(bend) = bend {
            state.q[bend] = aligned(robot, bend, index % 2);
        }
    }
    states
}

/// Returns every revolute joint but the first at θ = 0 or a right angle, about half of
/// them straight: arms stretched out, folded and squared.
pub fn stretched(robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
    let mut random = Random::new(seed);
    let mut states = seeded(robot, count, seed);
    for state in &mut states {
        for &joint in revolute(robot).iter().skip(1) {
            let quarters = random.below(8).saturating_sub(4);
            let straight = aligned(robot, joint, 0);
            state.q[joint] = straight + quarters as f64 * std::f64::consts::FRAC_PI_2;
        }
    }
    states
}

/// Draws a state at rest.
pub fn still(robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
    times(robot, count, seed, [1.0, 0.0, 0.0])
}

/// Draws a state at rest, and as many joints as possible where gravity does not load them: each
/// in turn, from the hand to the base, is brought to the zero of its own torque by bisection.
pub fn balanced(robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
    let runtime = Reference::<f64>::from_robot(robot);
    let load = |q: &[f64], joint: usize| {
        let c = runtime.gravity(&DVector::from_column_slice(q));
        c.map_or(0.0, |c| c[joint])
    };
    let mut states = still(robot, count, seed);
    for state in &mut states {
        for &joint in revolute(robot)
            .iter()
            .rev()
            .chain(revolute(robot).iter().rev())
        {
            let mut low = state.q[joint];
            let mut high = low + std::f64::consts::PI;
            let at = |q: f64, state: &mut JointState| {
                state.q[joint] = q;
                load(&state.q, joint)
            };
            let first = at(low, state);
            // Half a turn away the load is the opposite, but for an axis that
            // gravity does not reach at all.
            if first == 0.0 || at(high, state) * first >= 0.0 {
                state.q[joint] = low;
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if at(middle, state) * first > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            state.q[joint] = low;
        }
    }
    states
}

fn revolute(robot: &Robot) -> Vec<usize> {
    let is = |i: &usize| robot.joints[*i].kind == JointKind::Revolute;
    (0..robot.joints.len()).filter(is).collect()
}

/// Returns q for θ = half·π.
fn aligned(robot: &Robot, joint: usize, half: usize) -> f64 {
    half as f64 * std::f64::consts::PI - robot.joints[joint].theta.to_f64()
}
