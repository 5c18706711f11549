//! The exact proof: the final program equals Lagrange–Euler as written.
//!
//! Both are evaluated with their exact constants modulo p = 2⁶¹ − 465 at four to ten points that
//! follow from the SHA-256 of robot, scene and program. Above [`WRITTEN_LIMIT`] joints on the way
//! to a tip, of which a base that floats has six, the reference is the link-frame recursion,
//! itself proved against Lagrange–Euler for every joint kind and convention at up to that many
//! joints by tests.
//!
//! **The chance of a miss.** A difference that does not vanish modulo p is a polynomial of degree k
//! in the points' parameters ([`points`](super::points)). It vanishes at a random point with
//! probability at most k/2⁶⁰ (Schwartz–Zippel; a residue is drawn with at most 2⁻⁶⁰), so at four
//! with at most (2³⁰/2⁶⁰)⁴ < 1e-36. A larger degree takes up to ten points, and one beyond 2⁴⁸ is
//! refused. A difference all of whose coefficients p divides is not seen here, and has to get past
//! the check of what was generated in 256 bits; constants that p divides are refused. The search
//! finds equal values modulo another prime, 2⁶¹ − 1: no mistake that it makes there is hidden here.
//!
//! A solution of equations, such as q̈, is also put into them: at every point the formula's own
//! values must solve D q̈ + h + c + b∘q̇ = τ with D and the loads as written.
//!
//! A point where a divisor is zero has no values: the next is drawn instead.

use std::fmt;

use dalembert_model::equations::Formulation;
use dalembert_model::scalar::Divide;

use super::points::{Degrees, Point, Residue, integers, points, written};
use crate::dag::Leaves;
use crate::function::{Argument, Function};
use crate::program::{Input, Program};
use crate::scalar::{AnyLeaves, restored};
use crate::setup::Setup;
use dalembert_model::number::Exact;

/// The cost of Lagrange–Euler grows with n⁴ to n⁵ of a serial arm.
const WRITTEN_LIMIT: usize = 10;

pub(super) fn reference_formulation(setup: &Setup) -> Formulation {
    match setup.robot().depth() <= WRITTEN_LIMIT {
        true => Formulation::LagrangeEuler,
        false => Formulation::NewtonEulerLink,
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The formulation that the program equals; none of a load, which has its definition.
    pub reference_formulation: Option<Formulation>,
    /// The number of points at which the two were compared.
    pub points: usize,
}

impl Proof {
    /// A wrong program passes with a probability below 10 to the power of this.
    pub const FAILURE_EXPONENT: i32 = -36;
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Disproof {
    /// The output of this name, one-based, differs at a point.
    Output(String),
    /// The formula does not solve its own equation of motion: a defect of this library.
    Equation,
    /// The base parameters do not give what a parameter takes of torque: a defect of this library.
    Dependence(String),
    /// The program has another number of outputs.
    Shape,
    /// Constants or divisors vanish, or have no value, modulo 2⁶¹ − 465.
    Unfit,
    /// The degree is so large that a miss is not unlikely.
    Large,
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let formula = match self.reference_formulation {
            None => "its definition",
            Some(Formulation::LagrangeEuler) => "Lagrange–Euler as written",
            Some(_) => "the Newton–Euler recursion",
        };
        write!(
            f,
            "equals {formula} at {} random points modulo 2⁶¹ − 465 (a wrong program passes with \
             probability below 1e{})",
            self.points,
            Proof::FAILURE_EXPONENT
        )
    }
}

impl fmt::Display for Disproof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Disproof::Output(entry) => write!(f, "{entry} differs from the formula as written"),
            Disproof::Equation => f.write_str("the formula does not solve its own equation"),
            Disproof::Dependence(parameter) => write!(
                f,
                "the base parameters do not give what {parameter} takes of torque"
            ),
            Disproof::Shape => f.write_str("the number of outputs differs from the formula's"),
            Disproof::Unfit => f.write_str(
                "constants or divisors vanish modulo 2⁶¹ − 465: write parameters as short decimals",
            ),
            Disproof::Large => f.write_str("the program's degree is too large to be proved"),
        }
    }
}

/// Proves a program of a robot in its scene: against the full arm's formula with
/// constants in place of what the scene fixes, whatever was merged.
pub fn prove(setup: &Setup, program: &Program) -> Result<Proof, Disproof> {
    // A program reads speeds of the robot's widths, and no other.
    if program.rows != setup.rows() || program.speeds != program.read_speeds(setup.speeds()) {
        return Err(Disproof::Shape);
    }
    let function = program.function;
    let formulation = reference_formulation(setup);
    let task = setup.task(function);
    let degrees = Degrees::default();
    let outputs = run(Some(setup), program, &degrees).ok_or(Disproof::Shape)?;
    let others = task.textbook(formulation, &AnyLeaves(&degrees));
    let points = degrees.points(&outputs, &restored(others), program.joints)?;
    compare(
        points,
        &["program", &written(setup), &format!("{program:?}")],
        |point| {
            let posed = task.posed(&AnyLeaves(point));
            let results = posed.all(formulation);
            let residuals = function.residual(formulation, &posed.arm, &posed.motion, &results);
            match integers(&restored(residuals)) {
                None => Ok(None),
                Some(residues) if residues.iter().any(|residual| residual.divides()) => {
                    Err(Disproof::Equation)
                }
                Some(_) => Ok(Some(restored(posed.select(results)))),
            }
        },
        |point| run(Some(setup), program, point),
        |index| Disproof::Output(program.entry(index)),
    )?;
    Ok(Proof {
        points,
        reference_formulation: (function != Function::Load).then_some(formulation),
    })
}

/// Proves that two programs compute the same, or returns the first output that differs.
pub(crate) fn prove_same(a: &Program, b: &Program) -> Result<(), Disproof> {
    if a.speeds != b.speeds {
        return Err(Disproof::Shape);
    }
    let degrees = Degrees::default();
    let both = run(None, a, &degrees).zip(run(None, b, &degrees));
    let (outputs, others) = both.ok_or(Disproof::Shape)?;
    let points = degrees.points(&outputs, &others, a.joints.max(b.joints))?;
    compare(
        points,
        &["two programs", &format!("{a:?}"), &format!("{b:?}")],
        |point| Ok(run(None, a, point)),
        |point| run(None, b, point),
        |index| Disproof::Output(b.entry(index)),
    )
}

/// `differs` names a value by its place.
pub(super) fn compare(
    count: usize,
    statement: &[&str],
    expected: impl Fn(&Point) -> Result<Option<Vec<Residue>>, Disproof>,
    actual: impl Fn(&Point) -> Option<Vec<Residue>>,
    differs: impl Fn(usize) -> Disproof,
) -> Result<(), Disproof> {
    let mut good = 0;
    for point in points(statement, count) {
        let Some((actual, expected)) = actual(&point).zip(expected(&point)?) else {
            continue;
        };
        if expected.len() != actual.len() {
            return Err(Disproof::Shape);
        }
        // Where a divisor is zero there is no value, and nothing to compare.
        let Some((actual, expected)) = integers(&actual).zip(integers(&expected)) else {
            continue;
        };
        let mut pairs = actual.iter().zip(&expected);
        if let Some(index) = pairs.position(|(a, b)| a != b) {
            return Err(differs(index));
        }
        good += 1;
        if good == count {
            return Ok(());
        }
    }
    Err(Disproof::Unfit)
}

/// With a robot, the load is that of a payload whose ten numbers are variables of the proof.
pub(super) fn run<L: Leaves>(
    setup: Option<&Setup>,
    program: &Program,
    leaves: &L,
) -> Option<Vec<L::Value>> {
    let load = match setup {
        Some(setup) if program.arguments.contains(&Argument::Load) => {
            let loading = setup.loading(|input| leaves.input(input), |x| leaves.constant(x));
            loading.load()
        }
        _ => Vec::new(),
    };
    let input = |input: Input| match input {
        Input::Entry(Argument::Load, index) if index < load.len() => load[index].clone(),
        input => leaves.input(input),
    };
    let constant = |constant: &Exact| leaves.constant(constant);
    let run = || program.dag.run(&(constant, input));
    program.dag.is_straight().then(run)
}

impl Program {
    /// Returns the name of an output: `D_12`, `h_346`.
    pub fn entry(&self, mut index: usize) -> String {
        for quantity in self.function.quantities() {
            let len = quantity.len(self.sizes());
            if index < len {
                return quantity.entry(index, &self.rows, self.sizes());
            }
            index -= len;
        }
        format!("output {index}")
    }
}
