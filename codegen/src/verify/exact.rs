//! The exact proof: the final program equals Lagrange–Euler as written.
//!
//! Both are evaluated with their exact constants modulo [`PRIMES`] primes of
//! 63 bits, each with a random point of its own. Above [`WRITTEN_LIMIT`] joints
//! the reference is the link-frame recursion modulo the same primes, itself
//! proved against Lagrange–Euler for every joint kind and convention at up to
//! that many joints by tests. The formula is executed once, by a scalar that
//! [records](dalembert_model::scalar::record) the operations it asks for; the
//! recording, which says why it is the formula, is run at every point.
//!
//! **Against whom.** Somebody may choose robot, scene and program freely and
//! knows this code, but primes and points follow from the SHA-256 of what was
//! chosen ([`challenge`](super::challenge)), so that all there is to do is to
//! change a choice and hope for better ones. The chance of a miss that is
//! stated is that of one such attempt ([`miss`](super::miss)); a proof for
//! which it is not below 1e-9 after 2⁶⁴ attempts is refused.
//!
//! What inverts D is not only compared with a formula that does: at every point
//! the formula's own values are put into the equation that they solve, with D
//! and the loads as written, and must solve it.
//!
//! A prime that divides a denominator, or a coefficient that is not zero, is
//! unfit, and so is a point where a divisor is zero: the next is drawn instead.

use std::cell::{Cell, RefCell};
use std::fmt;

use dalembert_model::equations::Formulation;
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::record::Recording;
use dalembert_model::scalar::residue::Residue;

use super::challenge::{Point, Transcript};
use super::degree::Degree;
use super::miss;
use super::ratio::Ratio;
use super::size::Denominators;
use crate::function::{Argument, Function};
use crate::program::{Input, Program};
use crate::scene::SceneRobot;

/// The most joints for which Lagrange–Euler itself is the reference: its cost
/// grows with n⁴ to n⁵.
pub(crate) const WRITTEN_LIMIT: usize = 10;

/// At how many primes, each with its point, a statement is proved.
pub(crate) const PRIMES: usize = 4;

/// Primes to draw before a statement is given up for want of fit ones.
pub(super) const MAX_DRAWS: usize = 64;

/// A successful proof, and the probability that it is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The formulation that the program equals; none of a load, which has its
    /// definition.
    pub reference_formulation: Option<Formulation>,
    /// At how many primes and points.
    pub primes: usize,
    /// Degree of the difference in the random parameters, from above.
    pub degree: u64,
    /// Bits of the difference's coefficients as integers, from above.
    pub height: u64,
    /// The probability of a miss is below 10 to the power of this; `i32::MIN` of
    /// what vanishes whatever the state, which nothing else can be taken for.
    pub failure_exponent: i32,
}

impl Proof {
    /// Returns the exponent, unless there is no chance of a miss.
    pub fn miss(&self) -> Option<i32> {
        (self.failure_exponent != i32::MIN).then_some(self.failure_exponent)
    }
}

/// Why a program is not the formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Disproof {
    /// An output differs at a point.
    Output {
        /// The index of the output in the flat list.
        index: usize,
        /// Its name, one-based.
        entry: String,
    },
    /// The formula does not solve its own equation of motion: a defect of this library.
    Equation,
    /// The base parameters do not give what a parameter takes of torque: a
    /// defect of this library.
    Dependence {
        /// The parameter's name.
        parameter: String,
    },
    /// The program has another number of outputs.
    Shape,
    /// Constants or divisors vanish, or have no value, modulo prime after prime.
    Unfit,
    /// Degree or coefficients are so large that a miss is not unlikely.
    Large {
        /// The degree of the difference in the random parameters.
        degree: u64,
        /// Bits of its coefficients.
        height: u64,
    },
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
            "equals {formula} at {} random points, each modulo a random prime of 63 bits \
             (degree at most {}, coefficients of at most {} bits, ",
            self.primes, self.degree, self.height
        )?;
        match self.miss() {
            Some(exponent) => write!(
                f,
                "a wrong program passes with probability below 1e{exponent})"
            ),
            None => f.write_str("no wrong program passes)"),
        }
    }
}

impl fmt::Display for Disproof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Disproof::Output { entry, .. } => {
                write!(f, "{entry} differs from the formula as written")
            }
            Disproof::Equation => f.write_str("the formula does not solve its own equation"),
            Disproof::Dependence { parameter } => write!(
                f,
                "the base parameters do not give what {parameter} takes of torque"
            ),
            Disproof::Shape => f.write_str("the number of outputs differs from the formula's"),
            Disproof::Unfit => write!(
                f,
                "constants or divisors vanish modulo too many of {MAX_DRAWS} random primes: \
                 write parameters as short decimals"
            ),
            Disproof::Large { degree, height } => write!(
                f,
                "the program is of degree {degree} with coefficients of {height} bits, \
                 which is too large to be proved: write parameters as short decimals"
            ),
        }
    }
}

impl std::error::Error for Disproof {}

/// Proves a program of a robot in its scene: against the full arm's formula with
/// constants in place of what the scene fixes, whatever was merged.
pub fn prove(scene_robot: &SceneRobot, program: &Program) -> Result<Proof, Disproof> {
    // What is read of speeds is of the robot's widths, and no other.
    let of_robot = program.clone().with_speeds(scene_robot.speeds());
    if program.rows != scene_robot.rows() || program.speeds != of_robot.speeds {
        return Err(Disproof::Shape);
    }
    let reference_formulation = if scene_robot.robot().rows().len() <= WRITTEN_LIMIT {
        Formulation::LagrangeEuler
    } else {
        Formulation::NewtonEulerLink
    };
    let mut transcript = Transcript::new("program");
    transcript.scene_robot(scene_robot);
    transcript.program(program);
    let inputs = Inputs {
        scene_robot,
        program,
    };
    let formula = Formula::new(scene_robot, program.function, reference_formulation);
    let own = |point: &Point| inputs.run(point);
    let differs = |index| differs(program, index);
    compare(transcript, own, |point| formula.at(point), differs)?;
    let denominators = RefCell::default();
    let formula = formula.degrees(&denominators);
    let own = inputs.degrees(&denominators);
    let denominators = denominators.borrow().clone();
    let (degree, height) = bounded(&own, &formula, &denominators)?;
    Ok(Proof {
        reference_formulation: (program.function != Function::Load)
            .then_some(reference_formulation),
        primes: PRIMES,
        degree,
        height,
        failure_exponent: miss::exponent(degree, height, PRIMES),
    })
}

/// Proves that two programs compute the same.
///
/// # Errors
/// The first output that differs.
pub fn prove_same(a: &Program, b: &Program) -> Result<(), Disproof> {
    if a.speeds != b.speeds {
        return Err(Disproof::Shape);
    }
    let mut transcript = Transcript::new("two programs");
    transcript.program(a);
    transcript.program(b);
    compare(
        transcript,
        |point| run(b, point),
        |point| Ok(run(a, point)),
        |index| differs(b, index),
    )?;
    let mut denominators = Denominators::default();
    let [a, b] = [a, b].map(|program| program.degrees(&mut denominators));
    bounded(&b, &a, &denominators).map(drop)
}

/// A formula over the whole arm at a motion, recorded once and run at every point: a
/// locked joint is one whose pair or position is constant and whose rates are zero.
struct Formula {
    /// The results over the scene's rows.
    results: Recording<Input, Exact>,
    /// These, and what vanishes if the results over all joints solve the equations
    /// that they are to solve: D q̈ + h + c + b∘q̇ = τ, D D⁻¹ = 1, or their slopes,
    /// with D and the loads as written. None if they solve none.
    solving: Option<Recording<Input, Exact>>,
    /// The number of results.
    length: usize,
}

impl Formula {
    fn new(
        scene_robot: &SceneRobot,
        function: Function,
        reference_formulation: Formulation,
    ) -> Self {
        let (length, residuals) = (Cell::new(0), Cell::new(0));
        let record = |with_residual: bool| {
            scene_robot.record(function, |posed, _| {
                let all = posed.all(function, reference_formulation);
                let residual = match with_residual {
                    true => {
                        function.residual(reference_formulation, &posed.arm, &posed.motion, &all)
                    }
                    false => Vec::new(),
                };
                let mut values = posed.select(scene_robot, function, all);
                length.set(values.len());
                residuals.set(residual.len());
                values.extend(residual);
                values
            })
        };
        let solving = record(true);
        let (results, solving) = match residuals.get() {
            0 => (solving, None),
            _ => (record(false), Some(solving)),
        };
        Formula {
            results,
            solving,
            length: length.get(),
        }
    }

    /// Returns the results at a point, which solve their equations there. None where they
    /// have no values.
    fn at(&self, point: &Point) -> Result<Option<Vec<Residue>>, Disproof> {
        let recording = self.solving.as_ref().unwrap_or(&self.results);
        let constant = |constant: &Exact| point.constant(constant);
        let Some(mut values) = recording.run(|input| point.input(*input), constant) else {
            return Ok(None);
        };
        for residual in values.split_off(self.length) {
            match residual.value(point.prime()) {
                None => return Ok(None),
                Some(0) => {}
                Some(_) => return Err(Disproof::Equation),
            }
        }
        Ok(Some(values))
    }

    /// Returns the degrees of the results in the variables.
    fn degrees(&self, denominators: &RefCell<Denominators>) -> Vec<Ratio> {
        let input = |input: &Input| Ratio::input(*input);
        let constant =
            |constant: &Exact| Some(Ratio::constant(constant, &mut denominators.borrow_mut()));
        self.results.run(input, constant).unwrap_or_default()
    }
}

/// Compares values with what is expected at [`PRIMES`] primes; `differs` names one by its place.
pub(super) fn compare(
    transcript: Transcript,
    run: impl Fn(&Point) -> Option<Vec<Residue>>,
    expected: impl Fn(&Point) -> Result<Option<Vec<Residue>>, Disproof>,
    differs: impl Fn(usize) -> Disproof,
) -> Result<(), Disproof> {
    let challenge = transcript.seal();
    let points = (0..MAX_DRAWS).filter_map(|index| challenge.draw(index));
    let mut good = 0;
    for point in points {
        let values = run(&point).zip(expected(&point)?);
        let Some((actual, expected)) = values else {
            continue;
        };
        if expected.len() != actual.len() {
            return Err(Disproof::Shape);
        }
        // Where a divisor is zero there is no value, and nothing to compare.
        let values = |of: &[Residue]| -> Option<Vec<u64>> {
            of.iter().map(|x| x.value(point.prime())).collect()
        };
        let Some((actual, expected)) = values(&actual).zip(values(&expected)) else {
            continue;
        };
        let mut pairs = actual.iter().zip(&expected);
        if let Some(index) = pairs.position(|(a, b)| a != b) {
            return Err(differs(index));
        }
        good += 1;
        if good == PRIMES {
            return Ok(());
        }
    }
    Err(Disproof::Unfit)
}

fn differs(program: &Program, index: usize) -> Disproof {
    let entry = program.entry(index);
    Disproof::Output { index, entry }
}

/// Bounds the degree and height of the differences between outputs, if a miss is unlikely.
pub(super) fn bounded(
    own: &[Ratio],
    others: &[Ratio],
    denominators: &Denominators,
) -> Result<(u64, u64), Disproof> {
    let differences: Vec<Ratio> = own.iter().zip(others).map(|(a, b)| a.add(b)).collect();
    let most = |of: &dyn Fn(&Degree) -> u64| {
        let bounds = differences.iter().map(|d| d.top().map_or(u64::MAX, of));
        bounds.max().unwrap_or(0)
    };
    let degree = most(&Degree::bound);
    let height = most(&|degree| degree.height(denominators));
    match miss::is_small(degree, height, PRIMES) {
        true => Ok((degree, height)),
        false => Err(Disproof::Large { degree, height }),
    }
}

/// A program whose load, if it takes one, is that of a payload of any ten
/// numbers: these are the variables of the proof.
struct Inputs<'a> {
    scene_robot: &'a SceneRobot,
    program: &'a Program,
}

impl Inputs<'_> {
    /// Returns the values of the load; none where a constant has no value.
    fn load<S: Scalar>(
        &self,
        input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> Option<S>,
    ) -> Option<Vec<S>> {
        if !self.program.arguments.contains(&Argument::Load) {
            return Some(Vec::new());
        }
        let mut is_whole = true;
        let load = self.scene_robot.load_of(input, |value| {
            constant(value).unwrap_or_else(|| {
                is_whole = false;
                S::zero()
            })
        });
        is_whole.then_some(load)
    }

    /// Returns the program at a point, as [`run`].
    fn run(&self, point: &Point) -> Option<Vec<Residue>> {
        let constant = |constant: &Exact| point.constant(constant);
        let load = self.load(|input| point.input(input), constant)?;
        let input = |input: &Input| match *input {
            Input::Entry(Argument::Load, index) => load.get(index).cloned(),
            input => Some(point.input(input)),
        };
        self.program.evaluate(input, constant)
    }

    /// Returns the degrees of every output in the variables.
    fn degrees(&self, denominators: &RefCell<Denominators>) -> Vec<Ratio> {
        let constant =
            |constant: &Exact| Some(Ratio::constant(constant, &mut denominators.borrow_mut()));
        let load = self.load(Ratio::input, constant).unwrap_or_default();
        let input = |input: &Input| match *input {
            Input::Entry(Argument::Load, index) => load.get(index).cloned(),
            input => Some(Ratio::input(input)),
        };
        self.program.evaluate(input, constant).unwrap_or_default()
    }
}

/// Returns the program at a point; `None` if a constant has no value there, or a step
/// reads one that comes later.
fn run(program: &Program, point: &Point) -> Option<Vec<Residue>> {
    let constant = |constant: &Exact| point.constant(constant);
    program.evaluate(|input| Some(point.input(*input)), constant)
}

impl Program {
    /// Returns the name of an output: `D_12`, `h_346`.
    pub fn entry(&self, mut index: usize) -> String {
        for quantity in self.function.quantities() {
            let len = quantity.len(self.sizes());
            if index < len {
                return quantity.entry_over(index, &self.rows, self.sizes());
            }
            index -= len;
        }
        format!("output {index}")
    }
}
