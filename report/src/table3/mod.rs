//! The paper's Table 3 beside what the formulas cost as they are written.
//!
//! - `paper`: the polynomials of the table
//! - `written`: the formulas with the counting scalar

mod paper;
mod written;

use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;
use serde::Serialize;

/// The formulations of the table, and what it calls them.
pub const FORMULATIONS: [(Formulation, &str); 3] = [
    (Formulation::LagrangeEuler, "Lagrange–Euler"),
    (Formulation::NewtonEulerLink, "Newton–Euler"),
    (Formulation::Dalembert, "generalized D'Alembert"),
];

/// Multiplications and additions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Pair {
    /// Multiplications.
    pub mul: u64,
    /// Additions and subtractions.
    pub add: u64,
}

/// One formulation for a robot.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Its name.
    pub formulation: &'static str,
    /// The counts of the paper's polynomials at the robot's number of joints.
    pub paper: Pair,
    /// The formula with the robot's numbers, zeros and ones left out.
    pub as_written: Pair,
}

/// Returns what the paper counts for a formulation.
pub fn paper(formulation: Formulation, joints: usize) -> Pair {
    paper::counts(formulation, joints as u64)
}

/// Compares the formulations for the torques of a robot.
pub fn comparisons(robot: &Robot) -> Vec<Comparison> {
    let all = FORMULATIONS.into_iter();
    let all = all.map(|(formulation, name)| Comparison {
        formulation: name,
        paper: paper(formulation, robot.joints.len()),
        as_written: written::robot(formulation, robot),
    });
    all.collect()
}
