//! Exact programs that are not the robot's, against the equations of the checker.

use std::ops::Range;

use dalembert_checker::claim::Claim;
use dalembert_checker::identity::exact::Exact;
use dalembert_checker::identity::table::Function;
use dalembert_checker::identity::{Base, Points, Statement, check, robot};
use dalembert_checker::program::{Operand as Checked, Program as Straight};
use dalembert_checker::work::Work;
use dalembert_model::robot::Robot;

use crate::certified::Certified;
use crate::support::{all_but_one_in, daily_and_campaign, every_output, one_in, source};

struct Findings {
    source: String,
    function: Function,
    program: Straight<Exact>,
    base: Base,
}

impl Findings {
    fn check(&self, program: &Straight<Exact>) -> Result<(), String> {
        let file = robot::read(&self.source)?;
        let setting = file.setting(None)?;
        let statement = Statement {
            function: &self.function,
            program,
            base: &self.base,
            load: None,
        };
        let mut points = Points::new(&setting, &[&self.source, &format!("{program:?}")]);
        check(statement, &mut points)
    }

    #[track_caller]
    fn are_shown(&self) {
        let outcome = self.check(&self.program);
        assert_eq!(outcome, Ok(()), "{}", self.function.name);
    }

    #[track_caller]
    fn refuse(&self, program: &Straight<Exact>, what: &str) {
        let outcome = self.check(program);
        assert!(outcome.is_err(), "{}: {what}", self.function.name);
    }
}

fn shown(file: &Certified) -> Vec<Findings> {
    let claim = Claim::read(&file.claim).unwrap();
    let constants = claim.constants(&Work::default()).unwrap();
    let shown = claim.functions.iter().map(|function| Findings {
        // Axes of length one, where those of the file are not.
        source: claim.aligned.clone().unwrap_or_else(|| file.robot.clone()),
        function: Function::named(&function.function, &function.arguments, &function.results)
            .unwrap(),
        program: function.program(&constants).unwrap(),
        base: function.base(&constants, Robot::MAX_JOINTS, false).unwrap(),
    });
    shown.collect()
}

fn of_trees(robots: &[&str], functions: &str) -> Vec<Findings> {
    let asked = format!("outputs: {functions}; scalar: f64; prefer: operations");
    let findings = |name: &&str| shown(&Certified::of(&source(name, ""), None, &asked)[0]);
    robots.iter().flat_map(findings).collect()
}

daily_and_campaign! {
    every_mutant_of_a_program_is_refused: (one_in::<4>), (all_but_one_in::<4>);
    every_changed_sign_of_a_tree_is_refused:
        (&of_trees(&["g1_hand", "two_legs"], TORQUES), 40, 120),
        (&of_trees(&["panda_gripper", "baxter_both_arms", "g1_hand", "two_legs"], DYNAMICS), 100, 1300);
}

fn every_mutant_of_a_program_is_refused(is_tried: fn(usize) -> bool) {
    let file = Certified::planar2r(&format!("{}; scalar: f64", every_output()));
    let count = refused_mutants(&shown(&file), 40, 0..4, is_tried);
    assert!(count > 250, "{count}");
}

/// The base's force and moment, or linear and angular velocity, in each other's place, or two legs.
#[test]
fn another_order_of_coordinates_is_refused() {
    let places = |from: usize, to: usize, count: usize| {
        move |k: usize| match k {
            k if (from..from + count).contains(&k) => to + (k - from),
            k if (to..to + count).contains(&k) => from + (k - to),
            k => k,
        }
    };
    for findings in of_trees(&["two_legs"], "inverse_dynamics, gravity, forward_dynamics") {
        findings.are_shown();
        for (from, to, count) in [(0, 3, 3), (6, 8, 2)] {
            let other = places(from, to, count);
            let mut results = findings.program.clone();
            let outputs = findings.program.outputs.len();
            let moved = |k: usize| findings.program.outputs[other(k)].clone();
            results.outputs = (0..outputs).map(moved).collect();
            findings.refuse(&results, &format!("results {from}"));
            let mut read = findings.program.clone();
            let mut is_read = false;
            for operand in read.steps.iter_mut().flat_map(|step| &mut step.1) {
                if let Checked::Entry(1..=3, index) = operand {
                    (*index, is_read) = (other(*index), true);
                }
            }
            if is_read {
                findings.refuse(&read, &format!("entries {from}"));
            }
        }
    }
}

const TORQUES: &str = "inverse_dynamics, inertia";
const DYNAMICS: &str = "inverse_dynamics, gravity, coriolis, inertia, forward_dynamics";

fn every_changed_sign_of_a_tree_is_refused(shown: &[Findings], tries: usize, least: usize) {
    shown.iter().for_each(Findings::are_shown);
    let count = refused_mutants(shown, tries, 0..1, |_| true);
    assert!(count >= least, "{count}");
}

fn refused_mutants(
    shown: &[Findings],
    tries: usize,
    kinds: Range<usize>,
    is_tried: fn(usize) -> bool,
) -> usize {
    let mut count = 0;
    for findings in shown {
        let steps = findings.program.steps.len();
        let places = (0..steps).step_by(steps / tries + 1).enumerate();
        for (_, index) in places.filter(|(number, _)| is_tried(*number)) {
            for kind in kinds.clone() {
                if let Some(mutant) = mutant(&findings.program, index, kind) {
                    count += 1;
                    findings.refuse(&mutant, &format!("step {index} {kind}"));
                }
            }
        }
    }
    count
}

fn mutant(program: &Straight<Exact>, index: usize, kind: usize) -> Option<Straight<Exact>> {
    let mut other = program.clone();
    let (operation, operands) = &mut other.steps[index];
    match (kind, *operation) {
        (0, '-') => *operation = '+',
        (0, _) => *operation = '-',
        (1, '-' | '/') if operands[0] != operands[1] => operands.swap(0, 1),
        (2, _) => {
            let is_later = |operand: &&mut Checked<Exact>| matches!(operand, Checked::Step(1..));
            if let Checked::Step(step) = operands.iter_mut().find(is_later)? {
                *step -= 1;
            }
        }
        (3, _) => {
            let constant = operands.iter_mut().find_map(|operand| match operand {
                Checked::Constant(constant) => Some(constant),
                _ => None,
            })?;
            *constant = Exact::read(&format!("{}+1/100000000000000000", constant.fraction()?))?;
        }
        _ => return None,
    }
    Some(other)
}
