//! Faults planted into finished programs: the exact proof sees every one.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use dalembert_codegen::workspace::{
    Argument, Dag, Disproof, Input, Node, Operation, Points, Reference, Setup, Steps, TrueValue,
    prove,
    testing::{Id, Operand, Step, run_exactly},
};
use dalembert_codegen::{Function, Program};
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use crate::support::{self, Case, in_scene, rows, says};

fn cases(robots: &str, outputs: &str) -> Vec<(Case, Program)> {
    let mut cases = Vec::new();
    for robot in robots.split(' ') {
        for output in outputs.split(' ') {
            let case = Case::in_scene(robot, "", output);
            let program = case.generated().functions.remove(0).program;
            cases.push((case, program));
        }
    }
    cases
}

static CASES: LazyLock<Vec<(Case, Program)>> = LazyLock::new(|| {
    let outputs = "inverse_dynamics manipulator_equation dynamic_coefficients";
    cases("planar3r stanford puma560", outputs)
});

fn proof(case: &Case, program: &Program) -> Result<(), Disproof> {
    let setup = case.request.prepare(case.robot()).unwrap();
    prove(&setup, program).map(|_| ())
}

/// The search cannot tell a constant that is off by its prime.
fn faults(step: &Step) -> Vec<(&'static str, Step)> {
    let mut faults = Vec::new();
    let with = |operation| Step {
        operation,
        ..step.clone()
    };
    match step.operation {
        Operation::Add => faults.push(("sign", with(Operation::Sub))),
        Operation::Sub => faults.push(("sign", with(Operation::Add))),
        Operation::Mul | Operation::Fused | Operation::Div => {}
    }
    let with_right = |constant| Step {
        right: Operand::Constant(constant),
        ..step.clone()
    };
    if step.operation != Operation::Mul {
        faults.push(("term", with_right(Exact::zero())));
    }
    let ulp = |constant: &Exact| {
        Exact::from(Rational::from_float(f64::nearest(constant).next_up()).unwrap())
    };
    if let Operand::Constant(constant) = &step.left {
        let mut wrong = step.clone();
        wrong.left = Operand::Constant(ulp(constant));
        faults.push(("ulp", wrong));
    }
    if let Operand::Constant(constant) = &step.right {
        let false_one = constant.add(&Exact::from(Rational::from_integer(Field::P.into())));
        let [right, wrong] = [constant, &false_one].map(|x| Points::SEARCH.constant(x));
        assert_eq!(right, wrong, "no difference to the search");
        faults.push(("ulp", with_right(ulp(constant))));
        faults.push(("prime", with_right(false_one)));
    }
    faults
}

#[test]
fn every_fault_of_a_step() {
    for (case, program) in CASES.iter() {
        assert_eq!(proof(case, program), Ok(()));
        let mut kinds = BTreeSet::new();
        let steps = program.dag.steps();
        let count = steps.steps.len();
        for index in (0..count).step_by((count / 60).max(1)) {
            for (fault, step) in faults(&steps.steps[index]) {
                let wrong = with_step(program, &steps, index, step);
                let outcome = proof(case, &wrong);
                let is_seen = matches!(outcome, Err(Disproof::Output { .. }));
                let name = &case.robot().name;
                assert!(is_seen, "{name} step {index} {fault}: {outcome:?}");
                kinds.insert(fault);
            }
        }
        assert!(kinds.into_iter().eq(["prime", "sign", "term", "ulp"]));
    }
}

#[test]
fn every_fault_of_a_result() {
    for (case, program) in CASES.iter() {
        for index in 0..program.dag.outputs.len() {
            let mut wrong = program.clone();
            wrong.dag.outputs[index].negative ^= true;
            let is_zero = program.dag.is_zero(program.dag.outputs[index]);
            let outcome = proof(case, &wrong);
            assert_eq!(outcome.is_ok(), is_zero, "{} {index}", case.robot().name);
        }
        let mut short = program.clone();
        short.dag.outputs.pop();
        assert_eq!(proof(case, &short), Err(Disproof::Shape));
    }
}

#[test]
fn every_fault_of_a_quotient() {
    let outputs = "forward_dynamics inertia_inverse forward_dynamics_derivatives \
        forward_dynamics_second_derivatives";
    for (case, right) in cases("planar3r", outputs) {
        assert_eq!(proof(&case, &right), Ok(()));
        let steps = right.dag.steps();
        for (index, step) in steps.steps.iter().enumerate() {
            if step.operation != Operation::Div {
                continue;
            }
            let (dividend, divisor) = (&step.left, &step.right);
            let (first, zero) = (Operand::Step(0), Operand::Constant(Exact::zero()));
            for (operation, left, other) in [
                (Operation::Div, divisor, dividend),
                (Operation::Mul, dividend, divisor),
                (Operation::Div, dividend, &first),
                (Operation::Div, dividend, &zero),
            ] {
                let step = Step {
                    operation,
                    left: left.clone(),
                    right: other.clone(),
                };
                let wrong = with_step(&right, &steps, index, step);
                let outcome = proof(&case, &wrong);
                assert!(outcome.is_err(), "{} t{index}", right.function);
            }
        }
    }
}

#[test]
fn every_fault_of_an_argument() {
    let asked = "inverse_dynamics; parameters: payload, gravity";
    let case = Case::in_scene("planar3r", "", asked);
    let generated = case.generated();
    let mut planted = 0;
    for function in &generated.functions {
        let program = &function.program;
        assert!(proof(&case, program).is_ok());
        for argument in [Argument::Load, Argument::Gravity, Argument::Payload] {
            let length = argument.length(program.sizes());
            for entry in 0..length {
                let [right, other] =
                    [entry, (entry + 1) % length].map(|entry| Input::Entry(argument, entry));
                let change = |input: &Input| if *input == right { other } else { *input };
                let wrong = with_code(program, program.dag.map(Exact::clone, change));
                if wrong != *program {
                    assert!(proof(&case, &wrong).is_err(), "{argument:?} {entry}");
                    planted += 1;
                }
            }
        }
        let mut swapped = program.clone();
        swapped.dag.outputs.swap(0, 1);
        assert!(proof(&case, &swapped).is_err());
    }
    assert!(planted > 10, "{planted}");
}

fn with_step(program: &Program, steps: &Steps, index: usize, step: Step) -> Program {
    let mut steps = steps.clone();
    steps.steps[index] = step;
    with_code(program, steps.dag())
}

fn with_code(program: &Program, dag: Dag) -> Program {
    let mut program = program.clone();
    program.dag = dag;
    program
}

/// A robot file, the lines of a scene, what is asked, and words of the file with their changes.
const CHANGED: &str = r#"
LEADERS := multiplier = 0.75 → multiplier = 1.75 … multiplier = -2 → multiplier = -1 … multiplier = 1 → multiplier = 2 … joint = 4, multiplier = 1 → joint = 1, multiplier = 1
wafer | | inverse_dynamics | LEADERS
wafer | | forward_dynamics | LEADERS
coulomb | | inverse_dynamics | coulomb_width = 0.01 → coulomb_width = 0.02 … coulomb = 2.5 → coulomb = 2.6 … coulomb = 14 → coulomb = 15
puma560 | joints = [1, 2]; lock = { 3 = "pi/2" }; payload = { mass = 2, com = [0, 0, 0.05] } | gravity | 3 = "pi/2" } → 3 = "pi/3" } … mass = 2, → mass = 3, … joints = [1, 2] → joints = [2, 1]
"#;

#[test]
fn another_arm_or_scene() {
    for [file, scene, asked, changes] in rows(CHANGED) {
        let (source, asked) = in_scene(&file, &scene, &asked);
        let case = Case::read(&source, &asked);
        let program = &case.generated().functions[0].program;
        assert_eq!(proof(&case, program), Ok(()));
        for change in changes.split(" … ") {
            let (from, to) = change.split_once(" → ").unwrap();
            let other = source.replacen(from, to, 1);
            assert_ne!(other, source, "{from}");
            let outcome = proof(&Case::read(&other, &asked), program);
            assert!(outcome.is_err(), "{file} {change}");
        }
    }
}

/// A proved program is run, too: at a random state a digit far beyond a double's shows.
#[test]
fn a_wrong_digit_shows_at_a_state() {
    let case = Case::in_scene("planar2r", "", "inverse_dynamics");
    let reference = Reference::new(&Setup::whole(case.robot()));
    let mut function = case.generated().functions.remove(0);
    assert_eq!(run_exactly(&reference, &function), Ok(()));
    let tiny = Exact::from(Rational::from_integer(10.into()).pow(-40));
    let mut planted = 0;
    for index in 0..function.program.dag.nodes.len() {
        let program = function.program.clone();
        let Node::Constant(constant) = &mut function.program.dag.nodes[index] else {
            continue;
        };
        *constant = constant.add(&tiny);
        let error = run_exactly(&reference, &function).unwrap_err().to_string();
        says(&error, "it passed its proof");
        function.program = program;
        planted += 1;
    }
    assert!(planted >= 5, "{planted} constants");
    let mut other = function.clone();
    other.program.dag.outputs[0].node = Id::MAX;
    assert!(run_exactly(&reference, &other).is_err());
    function.program.dag.outputs.pop();
    assert!(run_exactly(&reference, &function).is_err());
}

/// An error of emitted code could hide where the reference knew less.
#[test]
fn every_result_is_known_far_beyond_a_double() {
    for name in ["planar3r", "stanford", "ur10", "panda"] {
        let robot = support::robot(name);
        let setup = Setup::whole(&robot);
        let reference = Reference::new(&setup);
        for function in Function::of(&robot) {
            for state in setup.states(3, 5) {
                let truth = reference.run(function, &state);
                let largest = truth.iter().map(TrueValue::magnitude).fold(0.0, f64::max);
                let lost = truth.iter().map(TrueValue::doubt).fold(0.0, f64::max);
                let what = format!("{name} {function}: {lost:e} of {largest:e}");
                assert!(lost <= 1e-45 * largest, "{what}");
            }
        }
    }
}
