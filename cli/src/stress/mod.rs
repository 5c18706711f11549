//! `dalembert stress`: the matrix of extremes on the user's robot.
//!
//! - this file: the table
//! - `singular`: functions that divide, where D is nearest to singular

mod singular;

use dalembert_codegen::Request;
use dalembert_model::robot::Robot;
use dalembert_report::stress::category::{Criterion, NORMWISE, PER_JOINT};
use dalembert_report::stress::report::{self, Options, Row, Verdict};
use dalembert_report::stress::singular::{self as divided, Divided};
use serde_json::{Value, json};

use crate::args::StressArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Runs the subcommand.
pub fn run(args: &StressArgs) -> Outcome {
    let robot = input::robot(&args.robot)?;
    let options = Options {
        states: args.states.max(1),
        request: Request::default(),
        ..Options::default()
    };
    let rows = report::run(&robot, &options, |name| output::note(&format!("… {name}")))?;
    output::note("… functions that divide");
    let divided = divided::run(&robot, &options)?;
    if args.json {
        output::print_json(&json(&robot, &rows, &divided))?;
    } else {
        output::print(&(text(&robot, &rows) + &singular::text(&divided)))?;
    }
    let verdicts = rows.iter().map(|row| row.verdict);
    let verdicts = verdicts.chain(divided.rows.iter().map(|row| row.verdict));
    let verdicts: Vec<Verdict> = verdicts.collect();
    let failed = verdicts.iter().filter(|verdict| **verdict == Verdict::Fail);
    match failed.count() {
        0 => Ok(()),
        failed => Err(Failure::Check(format!(
            "error: {failed} of {} checks failed",
            verdicts.len()
        ))),
    }
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "ok",
        Verdict::Fail => "FAILED",
        Verdict::OutOfRange => "out of range",
    }
}

/// Returns an error that no criterion asks for stands in brackets.
fn cell(error: f64, asked: bool) -> String {
    if asked {
        format!("{error:.1}")
    } else {
        format!("({error:.1})")
    }
}

fn text(robot: &Robot, rows: &[Row]) -> String {
    let mut text = format!("robot {}, input {}\n\n", robot.name, robot.short_hash());
    text +=
        &format!("worst error of τ in u; bounds: {NORMWISE} normwise, {PER_JOINT} of a joint\n");
    let head = [
        "category", "scalar", "normwise", "joint", "no.", "cond D", "scaled", "code", "",
    ];
    let mut table = vec![head.map(String::from).to_vec()];
    for row in rows {
        let singular = match (row.condition.indefinite, row.condition.singular) {
            (true, _) => ", D indefinite",
            (false, true) => ", D singular",
            (false, false) => "",
        };
        table.push(vec![
            row.category.to_owned(),
            row.scalar.to_string(),
            cell(row.worst.normwise, row.criterion != Criterion::PerJoint),
            cell(row.worst.per_joint, row.criterion != Criterion::Normwise),
            (row.worst.joint + 1).to_string(),
            format!("{:.1e}", row.condition.raw),
            format!("{:.1e}", row.condition.scaled),
            row.subject.to_string(),
            format!("{}{singular}", word(row.verdict)),
        ]);
    }
    text += &output::table(&table, 2);
    for row in rows {
        let place = format!("{} in {}, {}", row.category, row.scalar, row.subject);
        match row.verdict {
            Verdict::Pass => {}
            Verdict::Fail => {
                let state = &row.state;
                text += &format!(
                    "\nFAILED: {place}, at\n  q   {:?}\n  qd  {:?}\n  qdd {:?}\n",
                    state.q, state.qd, state.qdd
                );
            }
            Verdict::OutOfRange => {
                let reason = row.reason.as_ref();
                let reason = reason.map_or_else(String::new, ToString::to_string);
                text += &format!("\nout of range: {place}: {reason}\n");
            }
        }
    }
    if rows.iter().any(|row| row.condition.indefinite) {
        text += "\nwarning: where D is indefinite, a motion has a negative kinetic energy: a link has an \
                 inertia that no body has, and what is computed is the dynamics of no arm\n";
    }
    let singular = |row: &Row| row.condition.singular && !row.condition.indefinite;
    if rows.iter().any(singular) {
        text += "\nwarning: where D is singular to rounding (a pivot below n·u·max D_ii), \
                 forward dynamics cannot be solved; τ is not affected\n";
    }
    text
}

fn json(robot: &Robot, rows: &[Row], divided: &Divided) -> Value {
    let rows_json = rows.iter().map(|row| {
        json!({
            "category": row.category,
            "scalar": row.scalar.name(),
            "code": row.subject.to_string(),
            "criterion": match row.criterion {
                Criterion::Both => "normwise and per joint",
                Criterion::Normwise => "normwise",
                Criterion::PerJoint => "per joint",
            },
            // What is infinite has no JSON: null.
            "normwise_in_u": row.worst.normwise,
            "per_joint_in_u": row.worst.per_joint,
            "joint": row.worst.joint + 1,
            "state": { "q": row.state.q, "qd": row.state.qd, "qdd": row.state.qdd },
            "condition": row.condition.raw,
            "condition_scaled": row.condition.scaled,
            "singular": row.condition.singular,
            "indefinite": row.condition.indefinite,
            "verdict": word(row.verdict).to_lowercase(),
            "reason": row.reason.as_ref().map(ToString::to_string),
        })
    });
    json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "bounds_in_u": { "normwise": NORMWISE, "per_joint": PER_JOINT },
        "rows": rows_json.collect::<Vec<_>>(),
        "near_singular": singular::json(divided),
        "passed": rows.iter().all(|row| row.verdict != Verdict::Fail)
            && divided.rows.iter().all(|row| row.verdict != Verdict::Fail),
    })
}
