//! The paper's Table 3 beside the counts of the formulas as they are written.

use dalembert_model::equations::{Arm, Formulation, JointPosition, SinCosPair};
use dalembert_model::number::Exact;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::count::{Count, Counter};

/// Multiplications and additions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair {
    /// Multiplications.
    pub mul: u64,
    /// Additions and subtractions.
    pub add: u64,
}

/// One formulation for a robot.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Its name.
    pub formulation: &'static str,
    /// The counts of the paper's polynomials at the robot's number of joints.
    pub paper: Pair,
    /// The formula with the robot's numbers, zeros and ones left out.
    pub as_written: Pair,
}

/// Compares the formulations for the torques of a robot.
pub fn comparisons(robot: &Robot) -> [Comparison; 3] {
    let table = [
        (Formulation::LagrangeEuler, "Lagrange–Euler"),
        (Formulation::NewtonEulerLink, "Newton–Euler"),
        (Formulation::Dalembert, "generalized D'Alembert"),
    ];
    table.map(|(formulation, name)| Comparison {
        formulation: name,
        paper: paper(formulation, robot.joints.len() as u64),
        as_written: as_written(formulation, robot),
    })
}

/// Returns the paper's counts for n joints: polynomials over a common denominator.
fn paper(formulation: Formulation, n: u64) -> Pair {
    let powers = |[n4, n3, n2, n1, n0]: [u64; 5], denominator: u64| {
        ((((n4 * n + n3) * n + n2) * n + n1) * n + n0) / denominator
    };
    match formulation {
        Formulation::LagrangeEuler => Pair {
            mul: powers([128, 512, 739, 160, 0], 3),
            add: powers([196, 781, 1118, 245, 0], 6),
        },
        Formulation::Dalembert => Pair {
            mul: powers([0, 13, 315, 536, 414], 6),
            add: powers([0, 4, 132, 146, 135], 3),
        },
        _ => Pair {
            mul: 132 * n,
            add: (111 * n).saturating_sub(4),
        },
    }
}

/// Counts a formulation's operations with a robot's numbers: zeros and ones cost nothing.
fn as_written(formulation: Formulation, robot: &Robot) -> Pair {
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
    let links = arm.links.iter();
    let position: Vec<_> = links
        .map(|link| match link.kind {
            JointKind::Revolute => JointPosition::Revolute(SinCosPair {
                sin: counter.value(),
                cos: counter.value(),
            }),
            JointKind::Prismatic => JointPosition::Prismatic(counter.value()),
        })
        .collect();
    let rates = vec![counter.value(); arm.links.len()];
    formulation.inverse_dynamics(&arm, &arm.at(&position), &rates, &rates);
    Pair {
        mul: counter.multiplications(),
        add: counter.additions(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first, third and last of the rows that the paper prints for 1 to 7 joints.
    #[test]
    fn the_printed_rows() {
        for (formulation, rows) in [
            (
                Formulation::LagrangeEuler,
                [(513, 390), (10441, 7960), (173425, 132496)],
            ),
            (
                Formulation::NewtonEulerLink,
                [(132, 107), (396, 329), (924, 773)],
            ),
            (
                Formulation::Dalembert,
                [(213, 139), (868, 623), (4010, 2999)],
            ),
        ] {
            let found = [1, 3, 7].map(|n| paper(formulation, n));
            assert_eq!(found, rows.map(|(mul, add)| Pair { mul, add }));
        }
    }
}
