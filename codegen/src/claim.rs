//! What is claimed of generated functions: the document that the checker compares their text with.

use std::collections::HashMap;

use dalembert_checker::claim::{Claim, Claimed, VERSION};
use dalembert_model::number::Exact;
use dalembert_model::robot::{Robot, write};
use dalembert_model::scalar::Scalar;

use crate::emit::GeneratedFunction;
use crate::function::{Columns, Function, Quantity};
use crate::generate::{Generated, language};
use crate::language::Language;
use crate::language::names::Names;
use crate::program::text::input_name;
use crate::program::{Operand, ScalarType, Steps};
use crate::setup::Setup;
use crate::task::{Job, Request};
use crate::words::Complaint;

/// Returns what is claimed of the functions that were generated for the robot of a file, but for those from
/// which a tolerance left something out, whose certificates say how much.
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
    let mut constants = Constants::default();
    let exact = generated.functions.iter();
    let exact = exact.filter(|own| own.admitted.is_none());
    let functions = exact.map(|own| {
        // A header of the same functions has the same claim.
        let symbol = |&scalar| Names::new(&name, Language::C, scalar).of(own.function.name());
        Claimed {
            symbols: ScalarType::ALL.iter().map(symbol).collect(),
            ..claimed(own, setup, &mut constants)
        }
    });
    Ok(Claim {
        claim: VERSION,
        aligned: source.contains("placement").then(|| write(robot)),
        functions: functions.collect(),
        constants: constants.texts,
    })
}

/// The constants of all programs, each once.
#[derive(Default)]
struct Constants {
    texts: Vec<String>,
    places: HashMap<String, usize>,
}

impl Constants {
    fn place(&mut self, constant: &Exact) -> usize {
        let text = constant.to_string();
        *self.places.entry(text).or_insert_with_key(|text| {
            self.texts.push(text.clone());
            self.texts.len() - 1
        })
    }

    fn word(&mut self, operand: &Operand) -> String {
        match operand {
            Operand::Step(step) => format!("t{}", step + 1),
            Operand::Constant(constant) => format!("#{}", self.place(constant)),
            Operand::Input(input) => input_name(*input),
        }
    }
}

fn claimed(own: &GeneratedFunction, setup: &Setup, constants: &mut Constants) -> Claimed {
    let Steps { steps, outputs } = own.program.dag.steps();
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
        function: own.function.name().to_owned(),
        symbols: Vec::new(),
        scene: setup.scene().map(|scene| scene.name.clone()),
        arguments: own
            .program
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
        steps: steps.join(" "),
        returns: returns.join(" "),
        values: values.collect::<Vec<String>>().join(" "),
        base: terms,
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
