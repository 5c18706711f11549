//! What the formulas cost as they are written: run with the counting scalar.

use dalembert_model::equations::friction::Friction;
use dalembert_model::equations::{Arm, Formulation, JointPosition, Link, SinCosPair};
use dalembert_model::number::Exact;
use dalembert_model::robot::{Convention, Inertia, JointKind, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::count::{Count, Counter};

use super::Pair;

/// For n revolute joints of which nothing is known, standard DH, θ_i given.
pub fn generic(formulation: Formulation, n: usize) -> Pair {
    let counter = Counter::new();
    let value = || counter.value();
    let link = || Link {
        kind: JointKind::Revolute,
        alpha: SinCosPair {
            sin: value(),
            cos: value(),
        },
        beta: None,
        theta: SinCosPair {
            sin: Count::Zero,
            cos: Count::One,
        },
        a: value(),
        d: value(),
        mass: value(),
        com: [value(), value(), value()],
        inertia: Inertia {
            xx: value(),
            yy: value(),
            zz: value(),
            xy: value(),
            yz: value(),
            xz: value(),
        },
        friction: Friction::none(),
        armature: Count::Zero,
    };
    let arm = Arm {
        convention: Convention::Standard,
        gravity: [value(), value(), value()],
        base: None,
        tool: None,
        links: (0..n).map(|_| link()).collect(),
    };
    count(formulation, &arm, &counter)
}

/// For a robot: its numbers are known, zeros and ones cost nothing.
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
