//! Exact programs against the equations of the checker, which shares nothing with the generator:
//! modulo primes that follow from robot and program.

use dalembert_checker::identity::exact::Exact;
use dalembert_checker::identity::outputs::{argument, functions};
use dalembert_checker::identity::program::{Operand as Checked, Program as Straight};
use dalembert_checker::identity::{Combination, check, robot};
use dalembert_codegen::workspace::{BaseParameters, Columns, Input, Operand};
use dalembert_codegen::{Function, Program};

use crate::support::{Case, dose, every_output, source};

/// Arms of two and three joints, one of them with a base and a tool at odd angles, then larger
/// ones for optimised tests.
const ROBOTS: [&str; 6] = [
    "planar2r",
    "base_and_tool",
    "planar3r",
    "scara",
    "stanford",
    "puma560",
];

/// A function's program as the checker has it, and the parameters that its columns add up.
struct Shown {
    source: String,
    function: Function,
    program: Straight<Exact>,
    base: Vec<Combination>,
}

impl Shown {
    /// Reads a program.
    fn new(source: &str, program: &Program, base: Option<&BaseParameters>) -> Shown {
        let steps = program.dag.steps();
        let operations = steps.steps.iter().map(|step| {
            let operands = [&step.left, &step.right].map(operand);
            (step.operation.symbol(), operands)
        });
        let outputs = steps.outputs.iter();
        let outputs = outputs.map(|output| (output.negative, operand(&output.value)));
        let joints = program.joints;
        let base = base.map_or(&[][..], |base| &base.combinations);
        let base = base.iter().map(|terms| {
            let column = |name: &str| column(name, joints);
            let terms = terms.iter();
            let terms = terms.map(|(own, factor)| (column(&own.to_string()), constant(factor)));
            terms.collect()
        });
        Shown {
            source: source.to_owned(),
            function: program.function,
            program: Straight {
                steps: operations.collect(),
                outputs: outputs.collect(),
            },
            base: base.collect(),
        }
    }

    /// Has the checker show a program of the function.
    fn check(&self, program: &Straight<Exact>) -> Result<(), String> {
        let file = robot::read(&self.source)?;
        let name = self.function.name();
        let function = functions().into_iter().find(|own| own.name == name);
        let function = function.ok_or("no such function")?;
        let statement = [self.source.as_str(), &format!("{program:?}")];
        check(&file, &statement, &function, program, &self.base)
    }
}

fn operand(own: &Operand) -> Checked<Exact> {
    match own {
        Operand::Step(step) => Checked::Step(*step),
        Operand::Constant(own) => Checked::Constant(constant(own)),
        Operand::Input(Input::Sin(joint)) => Checked::Sine(vec![(*joint, false)], true),
        Operand::Input(Input::Cos(joint)) => Checked::Sine(vec![(*joint, false)], false),
        Operand::Input(Input::Entry(own, index)) => {
            Checked::Entry(argument(own.name()).unwrap(), *index)
        }
        Operand::Input(Input::PerSpeed(_)) => unreachable!("no arm here has Coulomb friction"),
    }
}

fn constant(own: &dalembert_model::number::Exact) -> Exact {
    let text = own.to_string();
    Exact::read(&text).unwrap_or_else(|| panic!("{text}"))
}

/// Returns the place of a parameter such as `Izz2` among those of links, rotors and friction.
fn column(name: &str, joints: usize) -> usize {
    const NAMES: [&str; 10] = [
        "m", "mx", "my", "mz", "Ixx", "Iyy", "Izz", "Ixy", "Iyz", "Ixz",
    ];
    let digits = name.find(|c: char| c.is_ascii_digit()).unwrap();
    let joint = name[digits..].parse::<usize>().unwrap() - 1;
    match &name[..digits] {
        "armature" => 10 * joints + joint,
        "viscous" => 11 * joints + joint,
        own => 10 * joint + NAMES.iter().position(|name| *name == own).unwrap(),
    }
}

/// Generates all functions of a robot.
fn all(name: &str) -> Vec<Shown> {
    let case = Case::new(
        name,
        "",
        &format!("outputs: {}; scalar: f64", every_output()),
    );
    let setup = case.request.setup(case.robot()).unwrap();
    let (source, functions) = (source(name, ""), case.generated().functions);
    let shown = functions.iter().map(|own| {
        let base = match own.function.columns() {
            Columns::Base(quantity) => Some(setup.base(quantity).unwrap()),
            Columns::Links | Columns::None => None,
        };
        Shown::new(&source, &own.program, base)
    });
    shown.collect()
}

#[test]
fn every_function_equals_the_checkers_equations() {
    for name in dose(&ROBOTS, 3) {
        let all = all(name);
        assert_eq!(all.len(), 35);
        for own in all {
            let found = own.check(&own.program);
            assert_eq!(found, Ok(()), "{name} {}", own.function);
        }
    }
}

/// Another sign, operand or order, and a constant that is off by 1e-17.
#[test]
fn every_mutant_of_a_program_is_refused() {
    let most = if cfg!(debug_assertions) { 5 } else { 40 };
    let mut count = 0;
    for own in all("planar2r") {
        let steps = own.program.steps.len();
        for index in (0..steps).step_by(steps / most + 1) {
            for kind in 0..4 {
                let Some(mutant) = mutant(&own.program, index, kind) else {
                    continue;
                };
                count += 1;
                let found = own.check(&mutant);
                assert!(found.is_err(), "{}: t{} {kind}", own.function, index + 1);
            }
        }
    }
    assert!(count > 250, "{count}");
}

fn mutant(program: &Straight<Exact>, index: usize, kind: usize) -> Option<Straight<Exact>> {
    let mut other = program.clone();
    let (operation, operands) = &mut other.steps[index];
    match (kind, *operation) {
        (0, '-') => *operation = '+',
        (0, _) => *operation = '-',
        (1, '-' | '/') if operands[0] != operands[1] => operands.swap(0, 1),
        (2, _) => {
            let is_later = |own: &&mut Checked<Exact>| matches!(own, Checked::Step(1..));
            if let Checked::Step(step) = operands.iter_mut().find(is_later)? {
                *step -= 1;
            }
        }
        (3, _) => {
            let constants = operands.iter_mut().find_map(|own| match own {
                Checked::Constant(own) => Some(own),
                _ => None,
            });
            let own = constants?;
            *own = Exact::read(&format!("{}+1/100000000000000000", own.text()?))?;
        }
        _ => return None,
    }
    Some(other)
}
