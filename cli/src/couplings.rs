//! `dalembert couplings`: which coefficients vanish or repeat, and why.

use dalembert_codegen::workspace::function::Quantity;
use dalembert_model::robot::Robot;
use dalembert_report::couplings::{Coupling, Couplings, Finding};
use serde_json::{Map, Value, json};

use crate::args::CouplingsArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

const QUANTITIES: [Quantity; 3] = [Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity];

/// Runs the subcommand.
pub fn run(args: &CouplingsArgs) -> Outcome {
    let robot = input::robot(&args.robot)?;
    let couplings = Couplings::of(&robot).ok_or_else(|| {
        Failure::Input(format!(
            "error: {} joints have too many h_ikm to list",
            robot.joints.len()
        ))
    })?;
    if args.json {
        output::print_json(&json(&robot, &couplings))
    } else {
        output::print(&text(&robot, &couplings))
    }
}

fn text(robot: &Robot, couplings: &Couplings) -> String {
    let mut text = format!(
        "robot {}, input {}\nD_ik with i ≤ k, h_ikm = h_imk with k ≤ m, c_i\n\n",
        robot.name,
        robot.short_hash()
    );
    let head = ["", "all", "zero", "not zero", "distinct up to sign"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for quantity in QUANTITIES {
        let summary = couplings.summary(quantity);
        rows.push(vec![
            quantity.symbol().to_owned(),
            summary.total.to_string(),
            summary.zero.to_string(),
            (summary.total - summary.zero).to_string(),
            summary.distinct.to_string(),
        ]);
    }
    text += &output::table(&rows, 0);
    for quantity in QUANTITIES {
        let rows: Vec<_> = couplings
            .entries
            .iter()
            .filter(|entry| entry.quantity == quantity)
            .map(|entry| row(couplings, entry))
            .collect();
        text.push('\n');
        text += &output::table(&rows, 2);
    }
    text
}

fn row(couplings: &Couplings, entry: &Coupling) -> Vec<String> {
    let (value, why) = match entry.finding {
        Finding::Zero(reason) => ("0".to_owned(), reason.to_string()),
        Finding::Repeats {
            entry,
            opposite,
            reason,
        } => {
            let sign = if opposite { "−" } else { "" };
            let other = couplings.name(&couplings.entries[entry]);
            (format!("{sign}{other}"), reason.to_string())
        }
        Finding::Distinct if entry.constant => ("constant".to_owned(), String::new()),
        Finding::Distinct => ("·".to_owned(), String::new()),
    };
    vec![couplings.name(entry), value, why]
}

fn json(robot: &Robot, couplings: &Couplings) -> Value {
    let summaries: Map<String, Value> = QUANTITIES
        .into_iter()
        .map(|quantity| {
            let summary = couplings.summary(quantity);
            let value = json!({
                "total": summary.total,
                "zero": summary.zero,
                "distinct": summary.distinct,
            });
            (key(quantity).to_owned(), value)
        })
        .collect();
    let entries = couplings.entries.iter().map(|entry| {
        // One-based, as in the equations.
        let joints: Vec<usize> = entry.joints.iter().map(|joint| joint + 1).collect();
        let mut value = json!({
            "name": couplings.name(entry),
            "quantity": key(entry.quantity),
            "joints": joints,
            "constant": entry.constant,
        });
        match entry.finding {
            Finding::Zero(reason) => {
                value["zero"] = json!(true);
                value["reason"] = json!(reason.name());
            }
            Finding::Repeats {
                entry,
                opposite,
                reason,
            } => {
                let other = couplings.name(&couplings.entries[entry]);
                let relation = if opposite { "opposite_of" } else { "equals" };
                value["zero"] = json!(false);
                value[relation] = json!(other);
                value["reason"] = json!(reason.name());
            }
            Finding::Distinct => value["zero"] = json!(false),
        }
        value
    });
    json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "summary": summaries,
        "entries": entries.collect::<Vec<_>>(),
    })
}

fn key(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Inertia => "D",
        Quantity::Gravity => "c",
        _ => "h",
    }
}
