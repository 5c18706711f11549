//! Faults planted into finished programs and texts: the exact proof and the
//! text check catch every one.

use dalembert_codegen::workspace::{
    Disproof, Library, Lowered, Operand, Operation, Points, Printed, SceneRobot, prove,
    write_function,
};
use dalembert_codegen::{Function, Program, ScalarType};
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use crate::support;

const FUNCTIONS: [Function; 3] = [
    Function::InverseDynamics,
    Function::ManipulatorEquation,
    Function::DynamicCoefficients,
];

fn programs() -> Vec<(Robot, Program)> {
    let mut programs = Vec::new();
    for name in ["planar3r", "stanford", "puma560"] {
        let robot = support::robot(name);
        for function in FUNCTIONS {
            let mut generated = support::one(&robot, function);
            programs.push((robot.clone(), generated.functions.remove(0).program));
        }
    }
    programs
}

/// Returns some steps of a program, spread over all of it.
fn some(program: &Program) -> impl Iterator<Item = usize> + use<> {
    let len = program.steps.len();
    (0..len).step_by((len / 60).max(1))
}

fn refused(robot: &Robot, program: &Program) -> bool {
    matches!(
        prove(&SceneRobot::whole(robot), program),
        Err(Disproof::Output { .. })
    )
}

#[test]
fn a_wrong_sign() {
    for (robot, program) in programs() {
        assert!(prove(&SceneRobot::whole(&robot), &program).is_ok());
        for index in some(&program) {
            let mut wrong = program.clone();
            let operation = &mut wrong.steps[index].operation;
            *operation = match *operation {
                Operation::Add => Operation::Sub,
                Operation::Sub => Operation::Add,
                Operation::Mul | Operation::Fused | Operation::Div => continue,
            };
            assert!(refused(&robot, &wrong), "{} t{}", robot.name, index + 1);
        }
        for index in 0..program.outputs.len() {
            let mut wrong = program.clone();
            let output = &mut wrong.outputs[index];
            output.negative = !output.negative;
            let zero = matches!(&output.value, Operand::Constant(c) if c.is_zero());
            assert_eq!(refused(&robot, &wrong), !zero, "{} {index}", robot.name);
        }
    }
}

/// The search compares values modulo 2⁶¹ − 1, where a constant and what is that much larger are one:
/// the proof has another prime.
#[test]
fn a_constant_that_the_search_cannot_tell() {
    let prime = Exact::from(Rational::from_integer(Field::P.into()));
    for (robot, program) in programs() {
        let is_constant = |index: &usize| {
            let step = &program.steps[*index];
            step.operation != Operation::Fused && matches!(step.right, Operand::Constant(_))
        };
        let indices = (0..program.steps.len()).filter(is_constant);
        for index in indices.take(20) {
            let mut wrong = program.clone();
            let Operand::Constant(constant) = &mut wrong.steps[index].right else {
                unreachable!("filtered");
            };
            let false_one = constant.add(&prime);
            let print = |x: &Exact| Points::SEARCH.constant(x);
            assert_eq!(
                print(constant),
                print(&false_one),
                "no difference to the search"
            );
            *constant = false_one;
            assert!(refused(&robot, &wrong), "{} t{}", robot.name, index + 1);
        }
    }
}

#[test]
fn a_dropped_term() {
    for (robot, program) in programs() {
        for index in some(&program) {
            let mut wrong = program.clone();
            let step = &mut wrong.steps[index];
            if step.operation == Operation::Mul {
                continue;
            }
            step.right = Operand::Constant(Exact::zero());
            assert!(refused(&robot, &wrong), "{} t{}", robot.name, index + 1);
        }
    }
}

/// Returns the exact constant, and the double that it rounds to moved by one ulp.
fn neighbour(constant: &Exact) -> Exact {
    let next = f64::nearest(constant).next_up();
    Exact::from(Rational::from_float(next).unwrap())
}

#[test]
fn a_constant_off_by_one_ulp() {
    for (robot, program) in programs() {
        for index in some(&program) {
            for side in [false, true] {
                let mut wrong = program.clone();
                let step = &mut wrong.steps[index];
                let operand = if side {
                    &mut step.right
                } else {
                    &mut step.left
                };
                let Operand::Constant(constant) = operand else {
                    continue;
                };
                *constant = neighbour(constant);
                assert!(refused(&robot, &wrong), "{} t{}", robot.name, index + 1);
            }
        }
    }
}

#[test]
fn a_missing_output() {
    let robot = support::robot("planar2r");
    let mut program = support::one(&robot, Function::Gravity)
        .functions
        .remove(0)
        .program;
    program.outputs.pop();
    assert_eq!(
        prove(&SceneRobot::whole(&robot), &program),
        Err(Disproof::Shape)
    );
}

/// Returns the text of a program, and whether it passes for the program.
fn passes(program: &Program, scalar: ScalarType, text: &str) -> bool {
    Lowered::parse(text, program.function, scalar)
        .is_ok_and(|read| read.matches(program, Library::Libm, &[]).is_ok())
}

#[test]
fn every_slip_of_the_printer() {
    for (robot, program) in programs() {
        for scalar in ScalarType::ALL {
            let code = program.lower(scalar, |_| None);
            let text = write_function(&Printed::of(&program, &code), Library::Libm, &[]);
            assert!(passes(&program, scalar, &text));
            let lines: Vec<&str> = text.lines().collect();
            for (index, line) in lines.iter().enumerate().skip(2).step_by(7) {
                for changed in slips(line, scalar) {
                    let mut wrong = lines.clone();
                    wrong[index] = &changed;
                    let wrong = wrong.join("\n") + "\n";
                    let at = format!("{} {scalar}: {line} -> {changed}", robot.name);
                    assert!(!passes(&program, scalar, &wrong), "{at}");
                }
            }
        }
    }
}

/// Lists other lines that compile just as well.
fn slips(line: &str, scalar: ScalarType) -> Vec<String> {
    let mut slips = vec![String::new()];
    for (a, b) in [
        (" + ", " - "),
        (" - ", " + "),
        (" * ", " + "),
        ("sincos", "cossin"),
        ("qd[", "q["),
        ("= s", "= c"),
        ("let t1", "let t2"),
        ("-t", "t"),
    ] {
        if line.contains(a) {
            slips.push(line.replacen(a, b, 1));
        }
    }
    // Literals: the neighbours in the scalar.
    for word in line.split([' ', ';', ',', '[', ']']) {
        if !word.contains('.') || word.contains(':') {
            continue;
        }
        let Some(value) = scalar.parse(word) else {
            continue;
        };
        let next = match scalar {
            ScalarType::F64 => format!("{:?}", value.next_up()),
            ScalarType::F32 => format!("{:?}", (value as f32).next_down()),
        };
        slips.push(line.replacen(word, &next, 1));
    }
    slips
}
