//! Prints the cost of each plan and the final error of the arm; fails if it is not upright.

use swing_up::follow::follow;
use swing_up::plan::{Derivatives, plan};

fn main() {
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
    let [off, _] = follow(&plan, 3.0, 0.05);
    println!("the arm, pushed at first, ends {off:.1e} off");
    assert!(off < 1e-3, "the arm is not upright");
}
