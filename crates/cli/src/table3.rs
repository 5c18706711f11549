//! The paper's Table 3 beside the operation counts of the textbook formulas.

use dalembert_model::equations::{Arm, Formulation, JointPosition, SinCosPair};
use dalembert_model::number::Exact;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::count::Counter;

/// Returns operation counts of three formulations for the torques of a robot: multiplications and
/// additions by the paper's polynomials for its number of joints, then those of the formula with
/// its numbers, where zeros and ones cost nothing.
pub fn comparisons(robot: &Robot) -> [(&'static str, [u64; 4]); 3] {
    let table = [
        (Formulation::LagrangeEuler, "Lagrange–Euler"),
        (Formulation::NewtonEulerLink, "Newton–Euler"),
        (Formulation::Dalembert, "generalized D'Alembert"),
    ];
    table.map(|(formulation, name)| {
        let paper = paper(formulation, robot.joints.len() as u64);
        let written = as_written(formulation, robot);
        (name, [paper[0], paper[1], written[0], written[1]])
    })
}

fn paper(formulation: Formulation, n: u64) -> [u64; 2] {
    let powers = |[n4, n3, n2, n1, n0]: [u64; 5], denominator: u64| {
        ((((n4 * n + n3) * n + n2) * n + n1) * n + n0) / denominator
    };
    match formulation {
        Formulation::LagrangeEuler => [
            powers([128, 512, 739, 160, 0], 3),
            powers([196, 781, 1118, 245, 0], 6),
        ],
        Formulation::Dalembert => [
            powers([0, 13, 315, 536, 414], 6),
            powers([0, 4, 132, 146, 135], 3),
        ],
        _ => [132 * n, (111 * n).saturating_sub(4)],
    }
}

fn as_written(formulation: Formulation, robot: &Robot) -> [u64; 2] {
    let counter = Counter::new();
    let arm = Arm::from_robot(robot, &mut Exact::counted);
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
    counter.counts().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first, third and last of the rows that the paper prints for 1 to 7 joints.
    #[test]
    fn the_printed_rows() {
        use Formulation::{Dalembert, LagrangeEuler, NewtonEulerLink};
        let euler = [[513, 390], [10441, 7960], [173425, 132496]];
        for (formulation, rows) in [
            (LagrangeEuler, euler),
            (NewtonEulerLink, [[132, 107], [396, 329], [924, 773]]),
            (Dalembert, [[213, 139], [868, 623], [4010, 2999]]),
        ] {
            assert_eq!([1, 3, 7].map(|n| paper(formulation, n)), rows);
        }
    }
}
