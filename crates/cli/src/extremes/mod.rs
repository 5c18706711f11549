//! Rounding where robots are not: the torques in every case of a table, and what inverts D where D
//! is nearest to singular.
//!
//! - [`cases`]: the table

pub mod cases;

use std::fmt;

use dalembert_codegen::workspace::{
    Argument, JointState, Quantity, Random, RunnableCode, SEED, each, positions,
};
use dalembert_codegen::{Function, GenerateError, GeneratedCode, Request, ScalarType, generate};
use dalembert_model::robot::Robot;

use crate::measure::{Bench, Code, ENTRY, VECTOR, Worst};
use cases::{CASES, Case, Change, Motion};

/// The bounds that a row is held to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundKind {
    /// [`VECTOR`] and [`ENTRY`].
    Both,
    /// [`VECTOR`]: one joint's loads say nothing about another's.
    Vector,
    /// [`ENTRY`]: next to zero torque, an error relative to the vector says nothing.
    Entries,
    /// [`ENTRY`], relative to the weight of the arm: a joint that feels none has a load next to zero, as
    /// the difference of others' weights.
    Weight,
}

/// The outcome of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Rounding is within the bound.
    Good,
    /// It is not.
    Failed,
    /// A constant or a result is beyond the scalar's range, and says so.
    OutOfRange,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Verdict::Good => "ok",
            Verdict::Failed => "FAILED",
            Verdict::OutOfRange => "out of range",
        })
    }
}

/// A function measured in a case, a row for each quantity.
#[derive(Clone, Debug)]
pub struct Row {
    /// The case.
    pub case: &'static str,
    /// The criterion that it is held to.
    pub held: BoundKind,
    /// The errors that were measured, or why nothing is generated.
    pub worst: Result<Worst, GenerateError>,
    /// The outcome against the bounds.
    pub verdict: Verdict,
}

impl Row {
    fn new(case: &'static str, held: BoundKind, worst: Result<Worst, GenerateError>) -> Row {
        let is_good = |worst: &Worst| {
            (worst.vector <= VECTOR || matches!(held, BoundKind::Entries | BoundKind::Weight))
                && (worst.entry <= ENTRY || held == BoundKind::Vector)
        };
        let verdict = match &worst {
            Ok(worst) if is_good(worst) => Verdict::Good,
            // Inside the limits no result may be out of range.
            Ok(worst) if !worst.overflows || case == INSIDE => Verdict::Failed,
            Ok(_) | Err(_) => Verdict::OutOfRange,
        };
        Row {
            case,
            held,
            worst,
            verdict,
        }
    }
}

const INSIDE: &str = "inside the limits";

/// Measures functions inside the limits.
pub fn inside<'e>(
    bench: &Bench,
    functions: impl Iterator<Item = &'e RunnableCode>,
    states: &[JointState],
) -> Vec<Row> {
    let case = (INSIDE, BoundKind::Vector);
    measured(bench, functions, case, [states, states]).collect()
}

fn measured<'e>(
    bench: &Bench,
    functions: impl Iterator<Item = &'e RunnableCode>,
    (case, held): (&'static str, BoundKind),
    [states, scales]: [&[JointState]; 2],
) -> impl Iterator<Item = Row> {
    functions
        .flat_map(move |emitted| {
            let code = Code::emitted(emitted);
            let mut samples = bench.samples(code.function, code.scalar, states, scales);
            if held == BoundKind::Weight {
                samples.relative_to_largest();
            }
            bench.compare(&code, &samples)
        })
        .map(move |worst| Row::new(case, held, Ok(worst)))
}

/// Functions as they were generated, all together or each scalar by itself.
type AskedCode = Vec<Result<GeneratedCode, GenerateError>>;

/// Skips the load, which comes with whatever reads it.
fn rows(
    bench: &Bench,
    made: &AskedCode,
    case: (&'static str, BoundKind),
    states: [&[JointState]; 2],
) -> Vec<Row> {
    let mut rows = Vec::new();
    for made in made {
        match made {
            Ok(made) => {
                let emitted = made.emitted.iter();
                let asked = emitted.filter(|emitted| emitted.function != Function::Load);
                rows.extend(measured(bench, asked, case, states));
            }
            Err(reason) => rows.push(Row::new(case.0, case.1, Err(reason.clone()))),
        }
    }
    rows
}

/// Returns the request for some of its functions anywhere: its box would bound the states.
fn anywhere(request: &Request, functions: Vec<Function>) -> Request {
    Request {
        functions,
        plan: None,
        scene: None,
        ..request.clone()
    }
}

const SCALES: usize = 1000;

/// Measures the torques in every case that the robot has, at so many states each; nothing if the
/// request does not ask for `inverse_dynamics`.
///
/// # Errors
/// Those of generating the code that is run.
pub fn torques(robot: &Robot, request: &Request, states: usize) -> Result<Vec<Row>, GenerateError> {
    if !request.functions.contains(&Function::InverseDynamics) {
        return Ok(Vec::new());
    }
    let request = &anywhere(request, vec![Function::InverseDynamics]);
    let original = (request.prepare(robot)?, generated(robot, request)?);
    let case = |(case, held, change, motion): &Case| {
        let Some(changed) = change.apply(robot) else {
            return Ok(Vec::new());
        };
        let other = match change {
            Change::None => None,
            _ => Some((request.prepare(&changed)?, generated(&changed, request)?)),
        };
        let (setup, made) = other.as_ref().unwrap_or(&original);
        let draw = |motion: Motion, count| {
            let mut states = motion.draw(setup, count, SEED);
            if let Change::Weightless = change {
                states.iter_mut().for_each(|state| state.g.fill(0.0));
            }
            states
        };
        let (drawn, scales) = (draw(*motion, states), draw(motion.scales(), SCALES));
        let bench = Bench::new(setup.clone());
        Ok(rows(&bench, made, (case, *held), [&drawn, &scales]))
    };
    let rows: Result<Vec<Vec<Row>>, GenerateError> = each(&CASES, case).into_iter().collect();
    Ok(rows?.concat())
}

/// Generates each scalar by itself where one of them cannot hold a constant.
fn generated(robot: &Robot, request: &Request) -> Result<AskedCode, GenerateError> {
    let of = |scalars: &[ScalarType]| {
        let request = Request {
            scalars: scalars.to_vec(),
            is_scalar_open: false,
            ..request.clone()
        };
        match generate(robot, &request) {
            Err(error @ GenerateError::Constant { .. }) => Ok(Err(error)),
            generated => generated.map(Ok),
        }
    };
    match of(&request.scalars)? {
        Err(_) if request.scalars.len() > 1 => {
            let scalars = request.scalars.iter();
            scalars.map(|&scalar| of(&[scalar])).collect()
        }
        generated => Ok(vec![generated]),
    }
}

/// Measures the functions of a request that invert D and nothing else, at states all over the limits,
/// and at as many where D is nearest to singular.
///
/// # Errors
/// Those of generating the code that is run.
pub fn divided(robot: &Robot, request: &Request, states: usize) -> Result<Vec<Row>, GenerateError> {
    const CASE: (&str, BoundKind) = ("nearest to singular", BoundKind::Vector);
    // Damped functions invert other matrices, which are near singular at other states.
    let is_damped = |function: &Function| function.arguments().contains(&Argument::Damping);
    let mut dividing = request.functions.clone();
    dividing.retain(|function| function.inverts_inertia() && !is_damped(function));
    if dividing.is_empty() {
        return Ok(Vec::new());
    }
    let request = &anywhere(request, dividing);
    let generated = generated(robot, request)?;
    let bench = Bench::new(request.prepare(robot)?);
    let (_, q) = nearest_to_singular(&bench);
    let mut drawn = bench.setup().states(2 * states, SEED);
    for state in drawn.iter_mut().skip(states) {
        state.q.clone_from(&q);
    }
    Ok(rows(&bench, &generated, CASE, [&drawn, &drawn]))
}

/// Returns the largest condition of D that a search over the limits finds, and where: the best of
/// random positions, improved joint by joint with steps that halve.
pub fn nearest_to_singular(bench: &Bench) -> (f64, Vec<f64>) {
    let function = Function::ForwardDynamics;
    let mut state = bench.setup().states(1, SEED).remove(0);
    let mut condition = |q: &[f64]| {
        state.q = q.to_vec();
        let granted = bench.runtime().granted(function, &state);
        granted.factor(Quantity::Acceleration)
    };
    let bounds = positions(bench.setup().robot());
    let mut random = Random::new(SEED);
    let mut draw = || -> Vec<f64> {
        let within = |[low, high]: &[f64; 2]| low + (high - low) * random.unit();
        bounds.iter().map(within).collect()
    };
    let pairs = (0..1000).map(|_| draw()).map(|q| (condition(&q), q));
    let mut drawn: Vec<(f64, Vec<f64>)> = pairs.collect();
    drawn.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    drawn.truncate(8);
    for (best, q) in &mut drawn {
        for halving in 2..22 {
            for (joint, [low, high]) in bounds.iter().enumerate() {
                let step = (high - low) / f64::from(1u32 << halving);
                for step in [step, -step] {
                    let before = q[joint];
                    q[joint] = (before + step).clamp(*low, *high);
                    match condition(q) {
                        more if more > *best => *best = more,
                        _ => q[joint] = before,
                    }
                }
            }
        }
    }
    let best = drawn.into_iter().max_by(|(a, _), (b, _)| a.total_cmp(b));
    best.unwrap_or_default()
}
