//! What a number of the robot file reaches in generated code: which constants, in which lines,
//! and which results.
//!
//! - [`parameter`]: numbers of a robot file by their names
//! - this file: constants, lines and results

pub mod parameter;

use std::collections::BTreeSet;
use std::fmt;

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{Generated, GeneratedFunction, generate};
use dalembert_codegen::workspace::program::fused::fusion;
use dalembert_codegen::workspace::program::{Literal, Operand, Operation, Program, ScalarType};
use dalembert_codegen::workspace::scene::SceneError;
use dalembert_codegen::workspace::task::Request;
use dalembert_codegen::workspace::verify::reach::{Place, Unreached, reach};
use dalembert_model::robot::Robot;

use parameter::Parameter;

/// By how many thousandths a number is changed to see which constants a search changes: it may
/// find other operations.
const OTHERS: [i64; 4] = [1, 2, 5, 10];

/// What a number reaches in a function.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The function.
    pub function: Function,
    /// The results that change with the number, of how many.
    pub results: (Vec<String>, usize),
    /// The constants that follow it; none if the code has its form because of the very number.
    pub constants: Option<Vec<Follower>>,
    /// `true` if a search with another value finds the same operations, and these are the constants
    /// that it changes; else they are as few as could follow the number.
    pub is_searched: bool,
    /// How many operations what these constants are in reaches, of how many.
    pub operations: (usize, usize),
}

/// A constant that follows the number.
#[derive(Clone, Debug)]
pub struct Follower {
    /// As it is in f64.
    pub literal: String,
    /// Its line in each scalar, from one, and the text there.
    pub lines: Vec<(ScalarType, usize, String)>,
    /// The results that the line reaches.
    pub results: Vec<String>,
}

/// Why a trace cannot be had.
#[derive(Clone, Debug)]
pub enum TraceError {
    /// The robot with another value is none of the scene's.
    Scene(SceneError),
    /// What is generated for a tolerance equals no formula.
    Tolerance,
    /// It is not known of this function.
    Unreached(Function, Unreached),
}

impl fmt::Display for TraceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TraceError::Scene(error) => write!(f, "with another value: {error}"),
            TraceError::Tolerance => f.write_str(
                "a trace is of code that equals the formula, and for the scene's tolerance parts are left out: \
                 name another scene, or none",
            ),
            TraceError::Unreached(function, why) => {
                write!(f, "`{function}`: ")?;
                f.write_str(match why {
                    Unreached::Nonlinear => {
                        "the numbers of its formula do not change in proportion to this one, such as those of a \
                         link that carries the scene's payload: trace without the scene"
                    }
                    Unreached::Load => "its load is an argument, and computed elsewhere",
                    Unreached::Unfit => "constants vanish modulo a prime: write parameters as short decimals",
                })
            }
        }
    }
}

impl std::error::Error for TraceError {}

/// Traces a number of the robot file through what was generated in Rust.
///
/// # Errors
/// Functions of which it is not known.
pub fn trace(
    robot: &Robot,
    request: &Request,
    generated: &Generated,
    parameter: &Parameter,
) -> Result<Vec<Trace>, TraceError> {
    let setting = |robot: &Robot| request.scene_robot(robot).map_err(TraceError::Scene);
    let scene_robot = setting(robot)?;
    let [once, twice] = [1, 2].map(|by| setting(&parameter.with(robot, by)));
    let others = [&once?, &twice?];
    let anew = Request {
        plan: None,
        ..request.clone()
    };
    let mut changed: Vec<Vec<GeneratedFunction>> = Vec::new();
    let mut traces = Vec::new();
    for own in &generated.functions {
        if own.admitted.is_some() {
            return Err(TraceError::Tolerance);
        }
        let (function, program) = (own.function, &own.program);
        let reached = reach(&scene_robot, others, program)
            .map_err(|why| TraceError::Unreached(function, why))?;
        let scalars = generated.emitted.iter();
        let scalars = scalars.filter(|emitted| emitted.function == function);
        let scalars: Vec<ScalarType> = scalars.map(|emitted| emitted.scalar).collect();
        let bodies = bodies(&generated.text, function);
        let entries = |outputs: BTreeSet<usize>| -> Vec<String> {
            outputs.into_iter().map(|o| program.entry(o)).collect()
        };
        let mut all = BTreeSet::new();
        let follower = |&place: &Place| {
            let (steps, outputs) = flow(program, place);
            all.extend(steps);
            let found = scalars.iter().zip(&bodies).filter_map(|(&scalar, body)| {
                let (line, text) = line(program, scalar, body, place)?;
                Some((scalar, line, text.to_owned()))
            });
            Follower {
                literal: literal(program, place, ScalarType::F64),
                lines: found.collect(),
                results: entries(outputs),
            }
        };
        let mut searched = None;
        for (index, by) in OTHERS.iter().enumerate() {
            if searched.is_some() || own.planned || reached.constants.is_none() {
                break;
            }
            if changed.len() == index {
                changed.push(searched_with(&anew, parameter, robot, *by));
            }
            let mut others = changed[index].iter();
            let other = others.find(|other| other.function == function);
            searched = other.and_then(|other| differing(program, &other.program));
        }
        let constants = searched.as_ref().or(reached.constants.as_ref());
        let constants = constants.map(|all| all.iter().map(follower).collect());
        traces.push(Trace {
            function,
            results: (
                entries(reached.outputs.iter().copied().collect()),
                program.outputs.len(),
            ),
            constants,
            is_searched: searched.is_some(),
            operations: (all.len(), program.steps.len()),
        });
    }
    Ok(traces)
}

/// Returns what a search finds with another value of a number.
fn searched_with(
    anew: &Request,
    parameter: &Parameter,
    robot: &Robot,
    by: i64,
) -> Vec<GeneratedFunction> {
    // It may be that nothing can be generated with it: then no search says anything.
    let changed = generate(&parameter.with(robot, by), anew).ok();
    changed.map_or(Vec::new(), |changed| changed.functions)
}

/// Returns where the constants of two programs differ; `None` if they differ otherwise.
fn differing(program: &Program, other: &Program) -> Option<Vec<Place>> {
    let mut shape = program.clone();
    let mut places = Vec::new();
    let mut same = |own: &mut Operand, other: &Operand, place: Place| {
        if let (Operand::Constant(own), Operand::Constant(other)) = (own, other)
            && own != other
        {
            *own = other.clone();
            places.push(place);
        }
    };
    for (index, (own, other)) in shape.steps.iter_mut().zip(&other.steps).enumerate() {
        same(&mut own.left, &other.left, Place::Step(index, 0));
        same(&mut own.right, &other.right, Place::Step(index, 1));
    }
    for (index, (own, other)) in shape.outputs.iter_mut().zip(&other.outputs).enumerate() {
        same(&mut own.value, &other.value, Place::Output(index));
    }
    (shape == *other).then_some(places)
}

/// Returns the steps and results that read a place, or read what reads it.
fn flow(program: &Program, place: Place) -> (BTreeSet<usize>, BTreeSet<usize>) {
    let (mut steps, mut outputs) = (BTreeSet::new(), BTreeSet::new());
    match place {
        Place::Step(step, _) => _ = steps.insert(step),
        Place::Output(output) => _ = outputs.insert(output),
    }
    let reads = |operand: &Operand, steps: &BTreeSet<usize>| match operand {
        Operand::Step(step) => steps.contains(step),
        _ => false,
    };
    for (index, step) in program.steps.iter().enumerate() {
        if reads(&step.left, &steps) || reads(&step.right, &steps) {
            steps.insert(index);
        }
    }
    for (index, output) in program.outputs.iter().enumerate() {
        if reads(&output.value, &steps) {
            outputs.insert(index);
        }
    }
    (steps, outputs)
}

fn literal(program: &Program, place: Place, scalar: ScalarType) -> String {
    let operand = match place {
        Place::Step(step, 0) => &program.steps[step].left,
        Place::Step(step, _) => &program.steps[step].right,
        Place::Output(output) => &program.outputs[output].value,
    };
    match operand {
        Operand::Constant(value) => Literal(scalar.round(value)).text(scalar),
        _ => String::new(),
    }
}

/// Returns the lines of a function with their numbers, in each scalar.
fn bodies(text: &str, function: Function) -> Vec<Vec<(usize, &str)>> {
    let lines: Vec<(usize, &str)> = text.lines().enumerate().map(|(i, l)| (i + 1, l)).collect();
    let head = format!("pub fn {function}(");
    let starts = lines.iter().enumerate();
    let starts = starts.filter(|(_, (_, line))| line.trim_start().starts_with(&head));
    let body = |(start, (_, first)): (usize, &(usize, &str))| {
        let margin = &first[..first.len() - first.trim_start().len()];
        let end = format!("{margin}}}");
        let rest = lines[start..].iter();
        rest.copied().take_while(|(_, line)| *line != end).collect()
    };
    starts.map(body).collect()
}

/// Returns the line in which a constant is.
fn line<'t>(
    program: &Program,
    scalar: ScalarType,
    body: &[(usize, &'t str)],
    place: Place,
) -> Option<(usize, &'t str)> {
    let lines = || body.iter().map(|(number, line)| (*number, line.trim()));
    match place {
        Place::Step(step, _) => {
            // A product that is fused is in the line of its sum.
            let is_fused = program.steps[step].operation == Operation::Fused;
            let mut after = step..program.steps.len();
            let step = match is_fused {
                true => after.find(|&step| fusion(&program.steps, step).is_some())?,
                false => step,
            };
            let head = format!("let t{} = ", step + 1);
            lines().find(|(_, line)| line.starts_with(&head))
        }
        Place::Output(_) => {
            let literal = literal(program, place, scalar);
            let last = lines().rfind(|(_, line)| line.starts_with("let "));
            let behind = last.map_or(0, |(number, _)| number);
            lines().find(|(number, line)| *number > behind && line.contains(&literal))
        }
    }
}
