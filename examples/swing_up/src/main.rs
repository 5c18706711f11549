//! Prints what the plan costs and where the arm ends; fails if it is not upright.

use std::process::ExitCode;

use swing_up::follow;
use swing_up::plan::{Derivatives, plan};

fn main() -> ExitCode {
    let [_, plan] = [Derivatives::First, Derivatives::Second].map(|derivatives| {
        let plan = plan(derivatives);
        let rounds = plan.costs.len() - 1;
        let (first, last) = (plan.costs[0], plan.cost());
        println!(
            "{derivatives:?} derivatives: {rounds} rounds, cost {first:.1} to {last:.4}, \
             the plan ends {:.1e} off",
            plan.off().abs().max()
        );
        plan
    });
    let run = follow(&plan, 3.0, 0.05);
    println!("the arm, pushed at first, ends {:.1e} off", run.off());
    match run.off() < 1e-3 {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}
