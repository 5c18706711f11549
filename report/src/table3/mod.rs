//! The paper's Table 3 beside what the formulas cost as they are written and
//! what is generated.
//!
//! - `paper`: the polynomials of the table
//! - `written`: the formulas with the counting scalar
//! - `generic`: an arm without special numbers

mod generic;
mod paper;
mod written;

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{GenerateError, Request, generate};
use dalembert_codegen::workspace::portfolio::Start;
use dalembert_codegen::workspace::program::{Counts, ScalarType};
use dalembert_codegen::workspace::simplify::Pass;
use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;

/// The formulations of the table, and what it calls them.
pub const FORMULATIONS: [(Formulation, &str); 3] = [
    (Formulation::LagrangeEuler, "Lagrange–Euler"),
    (Formulation::NewtonEulerLink, "Newton–Euler"),
    (Formulation::Dalembert, "generalized D'Alembert"),
];

/// The rows of the table: numbers of joints.
pub const JOINTS: std::ops::RangeInclusive<usize> = 1..=7;

/// Multiplications and additions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pair {
    /// Multiplications.
    pub mul: u64,
    /// Additions and subtractions.
    pub add: u64,
}

/// One formulation at one number of joints.
#[derive(Clone, Debug)]
pub struct Cell {
    /// What the paper's polynomials count.
    pub paper: Pair,
    /// The formula, no number special.
    pub written: Pair,
    /// For an arm of random numbers, by a quick search.
    pub generated: Counts,
}

/// One number of joints: a cell a formulation, in the order of
/// [`FORMULATIONS`], and what is generated from the best start.
#[derive(Clone, Debug)]
pub struct Row {
    /// The number of joints.
    pub n: usize,
    /// A cell a formulation.
    pub cells: Vec<Cell>,
    /// From the best of all starts.
    pub auto: Counts,
}

/// One robot from one formulation.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What the paper's polynomials count at its number of joints.
    pub paper: Pair,
    /// The formula with the robot's numbers.
    pub written: Pair,
    /// The counts after every stage of the search.
    pub passes: Vec<Pass>,
}

/// What the paper counts for a formulation.
pub fn paper(formulation: Formulation, joints: usize) -> Pair {
    paper::counts(formulation, joints as u64)
}

/// A row of the table: inverse dynamics of n revolute joints.
///
/// # Errors
/// As [`generate`]; none is known for these arms.
pub fn row(n: usize) -> Result<Row, GenerateError> {
    let robot = generic::robot(n);
    let generated = |start: Start| -> Result<Counts, GenerateError> {
        let passes = passes(&robot, start)?;
        Ok(passes.last().map(|pass| pass.counts).unwrap_or_default())
    };
    let cell = |(formulation, _): (Formulation, &str)| -> Result<Cell, GenerateError> {
        Ok(Cell {
            paper: paper(formulation, n),
            written: written::generic(formulation, n),
            generated: generated(Start::Only(formulation))?,
        })
    };
    let cells = FORMULATIONS.into_iter().map(cell);
    Ok(Row {
        n,
        cells: cells.collect::<Result<_, _>>()?,
        auto: generated(Start::Auto)?,
    })
}

/// The same for one robot and one of the formulations.
///
/// # Errors
/// As [`generate`].
pub fn comparison(robot: &Robot, formulation: Formulation) -> Result<Comparison, GenerateError> {
    Ok(Comparison {
        paper: paper(formulation, robot.joints.len()),
        written: written::robot(formulation, robot),
        passes: passes(robot, Start::Only(formulation))?,
    })
}

/// The counts after every stage of a quick search for a robot's torques.
///
/// # Errors
/// As [`generate`].
pub fn passes(robot: &Robot, start: Start) -> Result<Vec<Pass>, GenerateError> {
    let request = Request {
        functions: vec![Function::InverseDynamics],
        scalars: vec![ScalarType::F64],
        start,
        ..Request::default()
    };
    let functions = generate(robot, &request)?.functions;
    Ok(functions.into_iter().flat_map(|f| f.passes).collect())
}
