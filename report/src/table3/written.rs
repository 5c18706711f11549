//! What the formulas cost as they are written: run with the counting scalar.

use dalembert_model::equations::{Arm, Formulation, JointPosition, SinCosPair};
use dalembert_model::number::Exact;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::count::{Count, Counter};

use super::Pair;

/// Counts for a robot: its numbers are known, zeros and ones cost nothing.
pub fn robot(formulation: Formulation, robot: &Robot) -> Pair {
    let counter = Counter::new();
    let arm = Arm::from_robot(robot, &mut |constant: &Exact| {
        if constant.is_zero() {
            Count::Zero
        } else if constant.is_one() {
            Count::One
        } else if constant.neg().is_one() {
            Count::MinusOne
        } else {
            Count::Number
        }
    });
    count(formulation, &arm, &counter)
}

fn count<'a>(formulation: Formulation, arm: &Arm<Count<'a>>, counter: &'a Counter) -> Pair {
    let position: Vec<_> = arm
        .links
        .iter()
        .map(|link| match link.kind {
            JointKind::Revolute => JointPosition::Revolute(SinCosPair {
                sin: counter.value(),
                cos: counter.value(),
            }),
            JointKind::Prismatic => JointPosition::Prismatic(counter.value()),
        })
        .collect();
    let at = arm.at(&position);
    let rates = vec![counter.value(); arm.links.len()];
    formulation.inverse_dynamics(arm, &at, &rates, &rates);
    Pair {
        mul: counter.multiplications(),
        add: counter.additions(),
    }
}
