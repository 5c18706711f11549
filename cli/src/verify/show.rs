//! What was found, as text and as JSON.

use dalembert_codegen::Generated;
use dalembert_codegen::workspace::bound_of;
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use super::given::Given;
use super::{Check, Claim};
use crate::generate::json::proof;
use crate::generate::report;
use crate::{output, sines};

/// All that was found.
pub struct Found<'a> {
    pub robot: &'a Robot,
    pub generated: &'a Generated,
    pub checks: &'a [Check],
    pub claims: &'a [Claim<'a>],
    pub sines: &'a [sines::Check],
    pub given: Option<&'a Given<'a>>,
}

impl Found<'_> {
    /// Writes it for people.
    pub fn text(&self) -> String {
        let Found {
            robot,
            generated,
            checks,
            claims,
            ..
        } = self;
        let mut text = format!("robot {}, input {}\n\n", robot.name, robot.short_hash());
        for function in &generated.functions {
            text += &format!("  {} {}\n", function.function, function.proof);
        }
        for claim in *claims {
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
        }
        if checks.is_empty() {
            return text + &sines::table(self.sines);
        }
        text += "\nworst normwise error\n";
        let head = [
            "function", "scalar", "quantity", "against", "in u", "error", "bound", "",
        ];
        let mut rows = vec![head.map(String::from).to_vec()];
        for check in *checks {
            let measure = &check.measure;
            rows.push(vec![
                measure.function.to_string(),
                measure.scalar.to_string(),
                measure.quantity.symbol().to_owned(),
                format!("{} runtime", check.states),
                format!("{:.1}", measure.in_units()),
                format!("{:.1e}", measure.error),
                bound_of(check.bound, 2),
                if check.passed() { "ok" } else { "FAILED" }.to_owned(),
            ]);
        }
        rows.extend(self.given.into_iter().flat_map(Given::rows));
        text += &output::table(&rows, 1);
        for warning in &generated.warnings {
            text += &format!("warning: {warning}\n");
        }
        text + &sines::table(self.sines)
    }

    /// Writes it for programs.
    pub fn json(&self) -> Value {
        let Found {
            robot,
            generated,
            checks,
            claims,
            sines,
            given,
        } = self;
        let proofs = generated.functions.iter().map(|f| {
            let mut value = proof();
            value["function"] = json!(f.function.name());
            value["proved"] = json!(true);
            value
        });
        let errors = checks.iter().map(|check| {
            let measure = &check.measure;
            json!({
                "function": measure.function.name(),
                "scalar": measure.scalar.name(),
                "quantity": measure.quantity.symbol(),
                "against": "runtime",
                "states": check.states,
                // An infinite error has no JSON: null.
                "error": measure.error,
                "error_in_u": measure.in_units(),
                "bound": check.bound,
                "passed": check.passed(),
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
        let passed = checks.iter().all(Check::passed)
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
