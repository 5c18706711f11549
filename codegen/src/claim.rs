//! Programs as the document of claims and plans has them.

use std::collections::HashMap;

use dalembert_checker::claim::{Claim, FunctionClaim, VERSION};
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use crate::function::{Argument, Function, Quantity};
use crate::program::{Operand, Program, Steps};
use crate::setup::Setup;
use crate::setup::base::Parameter;

#[derive(Default)]
pub(crate) struct ConstantTable {
    texts: Vec<String>,
    places: HashMap<String, usize>,
}

impl ConstantTable {
    fn place(&mut self, constant: &Exact) -> usize {
        let text = constant.to_string();
        *self.places.entry(text).or_insert_with_key(|text| {
            self.texts.push(text.clone());
            self.texts.len() - 1
        })
    }

    pub(crate) fn document(self, functions: Vec<FunctionClaim>) -> Claim {
        Claim {
            claim: VERSION,
            constants: self.texts,
            functions,
            ..Claim::default()
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

pub(crate) fn code(program: &Program, constants: &mut ConstantTable) -> [String; 2] {
    let Steps { steps, outputs } = program.dag.steps();
    let (mut words, mut returns) = (Vec::new(), Vec::new());
    for step in &steps {
        let [left, right] = [&step.left, &step.right].map(|operand| constants.word(operand));
        words.push(format!("{left}{}{right}", step.operation.symbol()));
    }
    for output in &outputs {
        let sign = if output.negative { "-" } else { "" };
        returns.push(format!("{sign}{}", constants.word(&output.value)));
    }
    [words, returns].map(|words| words.join(" "))
}

pub(crate) fn of_setup(
    program: &Program,
    setup: &Setup,
    constants: &mut ConstantTable,
) -> FunctionClaim {
    let scene = setup.scene().map(|scene| &*scene.name);
    let claim = claimed(program, scene, constants);
    let base = setup.base_of(program.function).ok().flatten();
    let combinations = base.map_or(&[][..], |base| &base.combinations);
    let mut sums = Vec::new();
    for combination in combinations {
        let term = |(parameter, factor): &(Parameter, Exact)| match factor.is_one() {
            true => parameter.to_string(),
            false => format!("#{}*{parameter}", constants.place(factor)),
        };
        sums.push(combination.iter().map(term).collect::<Vec<_>>().join(" "));
    }
    let values = base
        .map_or_else(Vec::new, |base| base.values(&setup.arm(Exact::clone)))
        .iter()
        .map(|constant| format!("#{}", constants.place(constant)))
        .collect::<Vec<String>>();
    let takes_bodies = program.arguments.contains(&Argument::Bodies);
    let bodies = takes_bodies.then(|| setup.body_links());
    FunctionClaim {
        values: values.join(" "),
        base: sums,
        bodies: bodies.unwrap_or_default(),
        keeps_zeros: takes_bodies && !setup.zeros().is_empty(),
        ..claim
    }
}

pub(crate) fn claimed(
    program: &Program,
    scene: Option<&str>,
    constants: &mut ConstantTable,
) -> FunctionClaim {
    let [steps, returns] = code(program, constants);
    let arguments = program.arguments.iter().map(|argument| argument.name());
    let quantities = program.function.quantities().iter();
    FunctionClaim {
        function: program.function.name().to_owned(),
        scene: scene.map(str::to_owned),
        arguments: arguments.map(str::to_owned).collect(),
        results: quantities.copied().map(result).collect(),
        steps,
        returns,
        ..FunctionClaim::default()
    }
}

fn result(quantity: Quantity) -> String {
    let (of, view) = match quantity {
        Quantity::At(at) => (at.quantity(), format!("@{}", at.words())),
        quantity => (quantity, String::new()),
    };
    let mut functions = Function::ALL.iter();
    let first = functions.find(|function| function.quantities().contains(&of));
    let prefix = first.map_or_else(String::new, |function| format!("{function}."));
    format!("{prefix}{}{view}", of.field())
}
