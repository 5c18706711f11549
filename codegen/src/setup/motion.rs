//! The motion of a robot's joints from the inputs of a program.

use dalembert_model::equations::{JointPosition, SinCosPair};
use dalembert_model::outputs::{Motion, Sizes};
use dalembert_model::robot::{JointKind, Robot};

use crate::function::Argument;
use crate::program::Input;

/// Returns the motion of a robot from the values of a program's inputs.
pub fn motion<S>(robot: &Robot, mut input: impl FnMut(Input) -> S) -> Motion<S> {
    let n = robot.joints.len();
    let q = robot
        .joints
        .iter()
        .enumerate()
        .map(|(i, joint)| match joint.kind {
            JointKind::Revolute => JointPosition::Revolute(SinCosPair {
                sin: input(Input::Sin(i)),
                cos: input(Input::Cos(i)),
            }),
            JointKind::Prismatic => {
                JointPosition::Prismatic(input(Input::Entry(Argument::Position, i)))
            }
        });
    let q = q.collect();
    let speeds = robot.joints.iter().enumerate();
    let speeds = speeds.map(|(i, joint)| joint.has_coulomb().then(|| input(Input::PerSpeed(i))));
    let per_speed = speeds.collect();
    let entries = |argument: Argument| {
        let length = argument.length(Sizes::whole(n));
        (0..length)
            .map(|i| input(Input::Entry(argument, i)))
            .collect()
    };
    Motion {
        per_speed,
        ..Motion::new(q, entries)
    }
}
