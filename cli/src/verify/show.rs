//! What was found, as text and as JSON.

use crate::extremes::{Held, Row, Verdict};
use crate::measure::{ENTRY, VECTOR};
use dalembert_codegen::Generated;
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use super::Claim;
use super::given::Given;
use crate::generate::json::proof;
use crate::generate::report;
use crate::{output, sines};

/// All that was found.
pub struct Found<'a> {
    pub robot: &'a Robot,
    pub generated: &'a Generated,
    /// The states of each row.
    pub states: usize,
    pub rows: &'a [Row],
    pub claims: &'a [Claim<'a>],
    pub sines: &'a [sines::Check],
    pub given: Option<&'a Given<'a>>,
}

impl Found<'_> {
    /// Writes it for people.
    pub fn text(&self) -> String {
        let Found {
            robot, generated, ..
        } = self;
        let mut text = format!("robot {}, input {}\n\n", robot.name, robot.short_hash());
        for function in &generated.functions {
            text += &format!("  {} {}\n", function.function, function.proof);
        }
        for claim in self.claims {
            let certificate = claim.certificate;
            text += &format!(
                "\n{} in {}, certified, and the largest errors at {} states\n",
                certificate.emitted.function, certificate.scalar, claim.falsification.states
            );
            let mut rows = report::bounds(certificate);
            rows[0].push("observed".into());
            for (row, observed) in rows[1..].iter_mut().zip(&claim.falsification.observed) {
                row.push(format!("{observed:.3e}"));
            }
            text += &output::table(&rows, 0);
        }
        if let Some(given) = self.given {
            text += &given.summary();
            text += &output::table(&given.rows(), 1);
        }
        if !self.rows.is_empty() {
            text += &self.rounding();
        }
        for warning in &generated.warnings {
            text += &format!("warning: {warning}\n");
        }
        text + &sines::table(self.sines)
    }

    /// Writes the table of rounding errors, then the states of the rows that failed.
    fn rounding(&self) -> String {
        let mut text = format!(
            "\nlargest rounding errors at {} states, against 256-bit arithmetic, in u (f64 2^-53, f32 2^-24):\n\
             of a vector up to {VECTOR} of its largest entry, of an entry up to {ENTRY} of its own largest value\n",
            self.states
        );
        let has_cases = self.rows.iter().any(|row| row.case != self.rows[0].case);
        let mut table = vec![
            [
                "case", "function", "result", "scalar", "vector", "entry", "",
            ]
            .map(String::from)
            .to_vec(),
        ];
        for row in self.rows {
            let Row { held, verdict, .. } = row;
            // What a row is not held to stands in brackets.
            let cell = |error: f64, other: Held| match *held == other {
                true => format!("({error:.1})"),
                false => format!("{error:.1}"),
            };
            table.push(match &row.worst {
                Some(worst) => vec![
                    row.case.to_owned(),
                    worst.function.to_string(),
                    worst.quantity.symbol().to_owned(),
                    worst.scalar.to_string(),
                    cell(worst.vector, Held::Entries),
                    cell(worst.entry, Held::Vector),
                    verdict.to_string(),
                ],
                None => {
                    let mut cells = vec![String::new(); 7];
                    (cells[0], cells[6]) = (row.case.to_owned(), verdict.to_string());
                    cells
                }
            });
        }
        if !has_cases {
            table.iter_mut().for_each(|row| drop(row.remove(0)));
        }
        text += &output::table(&table, 1);
        for row in self.rows {
            if let Some(reason) = &row.reason {
                text += &format!("\n{}: {}: {reason}\n", row.case, row.verdict);
            }
            if let (Verdict::Failed, Some(worst)) = (row.verdict, &row.worst) {
                let (state, scalar) = (&worst.state, worst.scalar);
                text += &format!(
                    "\nFAILED: {} of {} in {scalar}, at\n  q   {:?}\n  qd  {:?}\n  qdd {:?}\n  tau {:?}\n",
                    row.case, worst.function, state.q, state.qd, state.qdd, state.tau
                );
            }
        }
        text
    }

    /// Writes it for programs.
    pub fn json(&self) -> Value {
        let Found {
            robot,
            generated,
            rows,
            claims,
            sines,
            given,
            ..
        } = self;
        let proofs = generated.functions.iter().map(|f| {
            let mut value = proof();
            value["function"] = json!(f.function.name());
            value["proved"] = json!(true);
            value
        });
        let errors = rows.iter().map(|row| {
            let worst = row.worst.as_ref();
            let state = worst.map(|worst| &worst.state);
            json!({
                "case": row.case,
                "function": worst.map(|worst| worst.function.name()),
                "scalar": worst.map(|worst| worst.scalar.name()),
                "quantity": worst.map(|worst| worst.quantity.symbol()),
                "against": "256 bits",
                "states": self.states,
                // An infinite error has no JSON: null.
                "vector_in_u": worst.map(|worst| worst.vector),
                "vector_bound_in_u": (row.held != Held::Entries).then_some(VECTOR),
                "entry_in_u": worst.map(|worst| worst.entry),
                "entry_bound_in_u": (row.held != Held::Vector).then_some(ENTRY),
                "condition": worst.map(|worst| worst.condition),
                "state": state.map(|s| json!({ "q": s.q, "qd": s.qd, "qdd": s.qdd, "tau": s.tau })),
                "verdict": row.verdict.to_string().to_lowercase(),
                "reason": row.reason.as_ref().map(ToString::to_string),
                "passed": row.verdict != Verdict::Failed,
            })
        });
        let errors = errors.chain(given.iter().flat_map(|given| given.errors()));
        let claims = claims.iter().map(|claim| {
            let bounds = claim.certificate.bounds.iter();
            json!({
                "function": claim.certificate.emitted.function.name(),
                "scalar": claim.certificate.scalar.name(),
                "certified": bounds.map(|bound| bound.total()).collect::<Vec<_>>(),
                "observed": claim.falsification.observed,
                "states": claim.falsification.states,
                "passed": claim.passed(),
            })
        });
        let claims: Vec<Value> = claims.collect();
        let passed = rows.iter().all(|row| row.verdict != Verdict::Failed)
            && claims.iter().all(|c| c["passed"] == true)
            && sines.iter().all(sines::Check::passed)
            && given.is_none_or(Given::agrees);
        let sines: Vec<Value> = sines.iter().map(sines::Check::json).collect();
        json!({
            "robot": robot.name,
            "input": robot.short_hash(),
            "proofs": proofs.collect::<Vec<_>>(),
            "errors": errors.collect::<Vec<_>>(),
            "given": given.map(|given| given.json(robot)),
            "certificates": claims,
            "sines": sines,
            "warnings": generated.warnings,
            "passed": passed,
        })
    }
}
