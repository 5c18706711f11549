//! What `stress` says of functions that divide.

use dalembert_report::stress::category::NORMWISE;
use dalembert_report::stress::report::Verdict;
use dalembert_report::stress::singular::Divided;
use serde_json::{Value, json};

use super::word;
use crate::output;

/// Returns the part of the text after the matrix.
pub fn text(divided: &Divided) -> String {
    let nearest = &divided.nearest;
    let mut text = format!(
        "\nfunctions that divide, where D is nearest to singular: {nearest}, at\n  q   {:?}\n",
        nearest.q
    );
    if let Some(refused) = &divided.refused {
        return text + &format!("not generated: {refused}\n");
    }
    text += &format!(
        "worst error there and all over the limits, in u × cond D with a unit diagonal; bound: {NORMWISE}\n"
    );
    let head = [
        "function", "scalar", "u cond D", "u", "cond D", "scaled", "code", "",
    ];
    let mut table = vec![head.map(String::from).to_vec()];
    for row in &divided.rows {
        table.push(vec![
            row.function.to_string(),
            row.scalar.to_string(),
            format!("{:.2}", row.error),
            format!("{:.1}", row.normwise),
            format!("{:.1e}", row.condition.raw),
            format!("{:.1e}", row.condition.scaled),
            row.subject.to_string(),
            word(row.verdict).to_owned(),
        ]);
    }
    text += &output::table(&table, 2);
    for row in &divided.rows {
        let place = format!("{} in {}, {}", row.function, row.scalar, row.subject);
        let state = &row.state;
        match (row.verdict, &row.reason) {
            (Verdict::Pass, _) => {}
            (Verdict::Fail, _) => {
                text += &format!(
                    "\nFAILED: {place}, at\n  q   {:?}\n  qd  {:?}\n  tau {:?}\n",
                    state.q, state.qd, state.tau
                );
            }
            (Verdict::OutOfRange, reason) => {
                let reason = reason
                    .as_ref()
                    .map_or_else(String::new, ToString::to_string);
                text += &format!("\nout of range: {place}: {reason}\n");
            }
        }
    }
    text
}

/// Writes it as JSON.
pub fn json(divided: &Divided) -> Value {
    let nearest = &divided.nearest;
    let rows = divided.rows.iter().map(|row| {
        let state = &row.state;
        json!({
            "function": row.function.name(),
            "scalar": row.scalar.name(),
            "code": row.subject.to_string(),
            // What is infinite has no JSON: null.
            "error_in_u_condition": row.error,
            "normwise_in_u": row.normwise,
            "state": { "q": state.q, "qd": state.qd, "tau": state.tau },
            "condition": row.condition.raw,
            "condition_scaled": row.condition.scaled,
            "verdict": word(row.verdict).to_lowercase(),
            "reason": row.reason.as_ref().map(ToString::to_string),
        })
    });
    json!({
        "q": nearest.q,
        "condition": nearest.condition.raw,
        "condition_scaled": nearest.condition.scaled,
        "singular": nearest.condition.singular,
        "indefinite": nearest.condition.indefinite,
        "bound_in_u_condition": NORMWISE,
        "refused": divided.refused.as_ref().map(ToString::to_string),
        "functions": rows.collect::<Vec<_>>(),
    })
}
