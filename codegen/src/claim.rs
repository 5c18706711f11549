//! What is claimed of generated functions: the document that the checker compares their text with.

use std::collections::HashMap;

use dalembert_checker::claim::{Claim, Claimed, Tolerated, VERSION};
use dalembert_model::number::Exact;
use dalembert_model::robot::{Robot, write};
use dalembert_model::scalar::Scalar;

use crate::certificate::Certificate;
use crate::function::{Argument, Columns, Function, Quantity};
use crate::generate::{Generated, language};
use crate::language::Language;
use crate::language::names::Names;
use crate::program::{Operand, Program, ScalarType, Steps};
use crate::setup::Setup;
use crate::task::{Job, Request};
use crate::words::Complaint;

/// Returns the claim about the functions that were generated for the robot of a file.
///
/// # Errors
/// As of [`Request::setup`].
pub fn claim(
    robot: &Robot,
    source: &str,
    request: &Request,
    generated: &Generated,
) -> Result<Claim, Complaint> {
    let request = &*language::with_short_name(robot, request);
    let setup = &request.setup(robot)?;
    let name = Job {
        robot,
        setup,
        request,
    }
    .module_name();
    let mut constants = Written::default();
    let functions = generated.functions.iter().map(|own| {
        // A header of the same functions has the same claim.
        let symbol = |&scalar| Names::new(&name, Language::C, scalar).of(own.function.name());
        Claimed {
            symbols: ScalarType::ALL.iter().map(symbol).collect(),
            tolerated: (own.admitted.as_ref())
                .and_then(|own| tolerated(&own.certificates, &mut constants)),
            ..of_setup(&own.program, setup, &mut constants)
        }
    });
    let functions = functions.collect();
    Ok(document(robot, source, functions, constants))
}

/// Returns the claim about one text that a tolerance admitted.
pub fn claim_of(robot: &Robot, source: &str, setup: &Setup, own: &Certificate) -> Claim {
    let mut constants = Written::default();
    let function = Claimed {
        tolerated: tolerated(std::slice::from_ref(own), &mut constants),
        ..of_setup(&own.emitted, setup, &mut constants)
    };
    document(robot, source, vec![function], constants)
}

fn document(robot: &Robot, source: &str, functions: Vec<Claimed>, constants: Written) -> Claim {
    Claim {
        aligned: source.contains("placement").then(|| write(robot)),
        ..constants.document(functions)
    }
}

/// The constants of all programs, each once.
#[derive(Default)]
pub(crate) struct Written {
    texts: Vec<String>,
    places: HashMap<String, usize>,
}

impl Written {
    fn place(&mut self, constant: &Exact) -> usize {
        let text = constant.to_string();
        *self.places.entry(text).or_insert_with_key(|text| {
            self.texts.push(text.clone());
            self.texts.len() - 1
        })
    }

    /// Returns the document of functions with these constants.
    pub(crate) fn document(self, functions: Vec<Claimed>) -> Claim {
        Claim {
            claim: VERSION,
            robot: String::new(),
            input: String::new(),
            aligned: None,
            constants: self.texts,
            functions,
        }
    }

    fn word(&mut self, operand: &Operand) -> String {
        match operand {
            Operand::Step(step) => format!("t{}", step + 1),
            Operand::Constant(constant) => format!("#{}", self.place(constant)),
            Operand::Input(input) => input.name(),
        }
    }
}

/// Returns the operations and the results of a program.
pub(crate) fn code(program: &Program, constants: &mut Written) -> [String; 2] {
    let Steps { steps, outputs } = program.dag.steps();
    let steps = steps.iter().map(|step| {
        let [left, right] = [&step.left, &step.right].map(|own| constants.word(own));
        format!("{left}{}{right}", step.operation.symbol())
    });
    let steps: Vec<String> = steps.collect();
    let returns = outputs.iter().map(|output| {
        let sign = if output.negative { "-" } else { "" };
        format!("{sign}{}", constants.word(&output.value))
    });
    let returns: Vec<String> = returns.collect();
    [steps, returns].map(|words| words.join(" "))
}

/// Returns the part of a claim about a tolerance, from the certificates of its scalars.
fn tolerated(certificates: &[Certificate], constants: &mut Written) -> Option<Tolerated> {
    let first = certificates.first()?;
    let program = &first.emitted;
    let exact = Some(&first.exact).filter(|exact| *exact != program);
    let [steps, returns] = exact.map_or_else(Default::default, |own| code(own, constants));
    let limits = &first.limits;
    let lists = [&limits.position, &limits.velocity, &limits.acceleration];
    let given = [
        Argument::Position,
        Argument::Velocity,
        Argument::Acceleration,
    ]
    .map(|own| program.arguments.contains(&own));
    let ranges = [0, 1, 2].map(|place| {
        let list = lists[place].iter().filter(|_| given[place]);
        list.map(|range| [range.low(), range.high()]).collect()
    });
    let reached = first.reached.iter().map(|at| {
        let lists = [&at.q, &at.qd, &at.qdd].into_iter().zip(given);
        let lists = lists.filter(|own| own.1);
        lists.flat_map(|own| own.0.iter().copied()).collect()
    });
    let bounds = |scalar: ScalarType| {
        let own = certificates.iter().find(|own| own.scalar == scalar);
        let bounds = own.map_or(&[][..], |own| &own.bounds);
        bounds.iter().map(|own| own.total()).collect()
    };
    Some(Tolerated {
        steps,
        returns,
        relative_to: (first.relative_to).map_or_else(String::new, |own| own.word().to_owned()),
        ranges,
        scales: first.scales.clone(),
        reached: reached.collect(),
        f64: bounds(ScalarType::F64),
        f32: bounds(ScalarType::F32),
    })
}

/// Returns the claim of a program of a robot in a scene.
fn of_setup(own: &Program, setup: &Setup, constants: &mut Written) -> Claimed {
    let scene = setup.scene().map(|scene| &*scene.name);
    let claimed = claimed(own, scene, constants);
    let base = match own.function.columns() {
        Columns::Base(quantity) => setup.base(quantity).ok(),
        Columns::Links | Columns::None => None,
    };
    let combinations = base.map_or(&[][..], |base| &base.combinations);
    let terms = combinations.iter().map(|terms| {
        let terms = terms
            .iter()
            .map(|(parameter, factor)| match *factor == Exact::one() {
                true => parameter.to_string(),
                false => format!("#{}*{parameter}", constants.place(factor)),
            });
        terms.collect::<Vec<String>>().join(" ")
    });
    let terms = terms.collect();
    let values = base.map_or_else(Vec::new, |base| base.values(&setup.arm(Exact::clone)));
    let values = values
        .iter()
        .map(|own| format!("#{}", constants.place(own)));
    Claimed {
        values: values.collect::<Vec<String>>().join(" "),
        base: terms,
        ..claimed
    }
}

/// Returns the claim of a program.
pub(crate) fn claimed(own: &Program, scene: Option<&str>, constants: &mut Written) -> Claimed {
    let [steps, returns] = code(own, constants);
    Claimed {
        function: own.function.name().to_owned(),
        scene: scene.map(str::to_owned),
        arguments: own
            .arguments
            .iter()
            .map(|own| own.name().to_owned())
            .collect(),
        results: own
            .function
            .quantities()
            .iter()
            .map(|own| result(*own))
            .collect(),
        steps,
        returns,
        ..Claimed::default()
    }
}

/// Returns a result by the function that is first to have it, and its name there.
fn result(quantity: Quantity) -> String {
    let (of, view) = match quantity {
        Quantity::At(at) => (at.quantity(), format!("@{}", at.words())),
        own => (own, String::new()),
    };
    let mut all = Function::ALL.iter();
    let first = all.find(|function| function.quantities().contains(&of));
    // The load of a payload is a result of its own.
    let first = first.map_or_else(String::new, |function| format!("{function}."));
    format!("{first}{}{view}", of.field())
}
