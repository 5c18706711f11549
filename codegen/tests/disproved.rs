//! Faults planted into finished programs: the exact proof sees every one.

use dalembert_codegen::workspace::{
    Argument, Disproof, Input, Operand, Operation, Points, Setup, Step, prove,
};
use dalembert_codegen::{Function, Program};
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use crate::support;
use crate::support::case::Case;

pub(crate) fn programs() -> Vec<(Robot, Program)> {
    let functions = [
        Function::InverseDynamics,
        Function::ManipulatorEquation,
        Function::DynamicCoefficients,
    ];
    let of = |name: &str| {
        let robot = support::robot(name);
        functions.map(|function| (robot.clone(), program(&robot, function)))
    };
    ["planar3r", "stanford", "puma560"]
        .iter()
        .flat_map(|name| of(name))
        .collect()
}

fn program(robot: &Robot, function: Function) -> Program {
    support::one(robot, function).functions.remove(0).program
}

fn proof(robot: &Robot, program: &Program) -> Result<(), Disproof> {
    prove(&Setup::whole(robot), program).map(|_| ())
}

fn constant(operand: &Operand) -> Option<&Exact> {
    match operand {
        Operand::Constant(constant) => Some(constant),
        _ => None,
    }
}

/// Lists steps in place of one: with the other sign, without a term, with a constant that is off by
/// an ulp of a double, or by the prime of the search, which cannot tell that one.
fn faults(step: &Step) -> Vec<(&'static str, Step)> {
    let mut all = Vec::new();
    let with = |operation| Step {
        operation,
        ..step.clone()
    };
    match step.operation {
        Operation::Add => all.push(("sign", with(Operation::Sub))),
        Operation::Sub => all.push(("sign", with(Operation::Add))),
        Operation::Mul | Operation::Fused | Operation::Div => {}
    }
    if step.operation != Operation::Mul {
        let right = Operand::Constant(Exact::zero());
        all.push((
            "term",
            Step {
                right,
                ..step.clone()
            },
        ));
    }
    let ulp = |own: &Exact| Exact::from(Rational::from_float(f64::nearest(own).next_up()).unwrap());
    if let Some(own) = constant(&step.left) {
        let left = Operand::Constant(ulp(own));
        all.push((
            "ulp",
            Step {
                left,
                ..step.clone()
            },
        ));
    }
    if let Some(own) = constant(&step.right) {
        let false_one = own.add(&Exact::from(Rational::from_integer(Field::P.into())));
        let print = |x: &Exact| Points::SEARCH.constant(x);
        assert_eq!(print(own), print(&false_one), "no difference to the search");
        for (fault, wrong) in [("ulp", ulp(own)), ("prime", false_one)] {
            let right = Operand::Constant(wrong);
            all.push((
                fault,
                Step {
                    right,
                    ..step.clone()
                },
            ));
        }
    }
    all
}

#[test]
fn every_fault_of_a_step() {
    for (robot, program) in programs() {
        assert_eq!(proof(&robot, &program), Ok(()));
        let mut kinds = Vec::new();
        let count = program.steps.len();
        for index in (0..count).step_by((count / 60).max(1)) {
            for (fault, step) in faults(&program.steps[index]) {
                let mut wrong = program.clone();
                wrong.steps[index] = step;
                let found = proof(&robot, &wrong);
                let is_seen = matches!(found, Err(Disproof::Output { .. }));
                assert!(is_seen, "{} t{} {fault}: {found:?}", robot.name, index + 1);
                kinds.push(fault);
            }
        }
        kinds.sort_unstable();
        kinds.dedup();
        assert_eq!(kinds, ["prime", "sign", "term", "ulp"]);
    }
}

#[test]
fn every_fault_of_a_result() {
    for (robot, program) in programs() {
        for index in 0..program.outputs.len() {
            let mut wrong = program.clone();
            let output = &mut wrong.outputs[index];
            output.negative = !output.negative;
            let is_zero = constant(&output.value).is_some_and(Exact::is_zero);
            assert_eq!(
                proof(&robot, &wrong).is_ok(),
                is_zero,
                "{} {index}",
                robot.name
            );
        }
        let mut short = program;
        short.outputs.pop();
        assert_eq!(proof(&robot, &short), Err(Disproof::Shape));
    }
}

/// Another divisor, a quotient upside down, a product in its place; 0/0 is nothing.
#[test]
fn every_fault_of_a_quotient() {
    let robot = support::robot("planar3r");
    for function in [
        Function::ForwardDynamics,
        Function::InertiaInverse,
        Function::ForwardDynamicsDerivatives,
        Function::ForwardDynamicsSecondDerivatives,
    ] {
        let right = program(&robot, function);
        assert_eq!(proof(&robot, &right), Ok(()));
        let quotients = right.steps.iter().enumerate();
        for (index, step) in quotients.filter(|(_, step)| step.operation == Operation::Div) {
            let Step {
                left,
                right: divisor,
                ..
            } = step.clone();
            let zero = Operand::Constant(Exact::zero());
            for (operation, left, right_one) in [
                (Operation::Div, divisor.clone(), left.clone()),
                (Operation::Mul, left.clone(), divisor),
                (Operation::Div, left.clone(), Operand::Step(0)),
                (Operation::Div, left, zero),
            ] {
                let mut wrong = right.clone();
                wrong.steps[index] = Step {
                    operation,
                    left,
                    right: right_one,
                };
                assert!(proof(&robot, &wrong).is_err(), "{function} t{}", index + 1);
            }
        }
    }
}

/// A program that reads another number of the load, or of gravity, is refused; so
/// is a load that is another.
#[test]
fn every_fault_of_an_argument() {
    let asked = "outputs: inverse_dynamics; parameters: payload, gravity";
    let case = Case::new("planar3r", "", asked);
    let setup = case.request.setup(case.robot()).unwrap();
    let generated = case.generated();
    let mut planted = 0;
    for function in &generated.functions {
        let program = &function.program;
        assert!(prove(&setup, program).is_ok());
        for argument in [Argument::Load, Argument::Gravity, Argument::Payload] {
            let length = argument.length(program.sizes());
            for entry in 0..length {
                let other = |input: Input| match input {
                    Input::Entry(own, index) if (own, index) == (argument, entry) => {
                        Input::Entry(own, (index + 1) % length)
                    }
                    input => input,
                };
                let wrong = with_inputs(program, other);
                if wrong != *program {
                    assert!(prove(&setup, &wrong).is_err(), "{argument:?} {entry}");
                    planted += 1;
                }
            }
        }
        let mut swapped = program.clone();
        swapped.outputs.swap(0, 1);
        assert!(prove(&setup, &swapped).is_err());
    }
    assert!(planted > 10, "{planted}");
}

/// Returns the program with other inputs.
fn with_inputs(program: &Program, other: impl Fn(Input) -> Input) -> Program {
    let mut program = program.clone();
    let change = |operand: &mut Operand| {
        if let Operand::Input(input) = operand {
            *input = other(*input);
        }
    };
    for step in &mut program.steps {
        change(&mut step.left);
        change(&mut step.right);
    }
    program
        .outputs
        .iter_mut()
        .for_each(|o| change(&mut o.value));
    program
}

/// Words of a robot file, and what they are changed to.
type Changes = &'static [(&'static str, &'static str)];

/// A robot file, more tables of it, what is asked, and changes.
type Changed = (&'static str, &'static str, &'static str, Changes);

const FOLLOWERS: Changes = &[
    ("multiplier = 0.75", "multiplier = 1.75"),
    ("multiplier = -2", "multiplier = -1"),
    ("multiplier = 1", "multiplier = 2"),
    ("joint = 4, multiplier = 1", "joint = 1, multiplier = 1"),
];

const WIDTHS: Changes = &[
    ("coulomb_width = 0.01", "coulomb_width = 0.02"),
    ("coulomb = 2.5", "coulomb = 2.6"),
    ("coulomb = 14", "coulomb = 15"),
];

/// A program is of its arm and its scene: of another multiplier or leader, another width or force
/// of friction, another lock, payload or order of rows it is disproved.
#[test]
fn another_arm_or_scene() {
    let scene = "\n[scene.pick]\njoints = [1, 2]\nlock = { 3 = \"pi/2\" }\n\
                 payload = { mass = 2, com = [0, 0, 0.05] }\n";
    let friction = "outputs: inverse_dynamics";
    let rows: [Changed; 4] = [
        ("wafer", "", "outputs: inverse_dynamics", FOLLOWERS),
        ("wafer", "", "outputs: forward_dynamics", FOLLOWERS),
        ("coulomb", "", friction, WIDTHS),
        (
            "puma560",
            scene,
            "outputs: gravity; scene: pick",
            &[
                ("pi/2\" }\npay", "pi/3\" }\npay"),
                ("mass = 2,", "mass = 3,"),
                ("[1, 2]\nlock", "[2, 1]\nlock"),
            ],
        ),
    ];
    for (file, more, asked, changes) in rows {
        let source = Case::source(file, more);
        let own = Case::of(&source, asked);
        let program = &own.generated().functions[0].program;
        let proof = |case: &Case| {
            let setup = case.request.setup(case.robot()).unwrap();
            prove(&setup, program).map(|_| ())
        };
        assert_eq!(proof(&own), Ok(()));
        for (from, to) in changes {
            let other = source.replacen(from, to, 1);
            assert_ne!(other, source, "{from}");
            let found = proof(&Case::of(&other, asked));
            assert!(found.is_err(), "{file} {from} -> {to}");
        }
    }
}
