//! Polynomials against libm's sine and cosine: what was seen and what was
//! proved.

use dalembert_codegen::workspace::{AngleSum, JointState, angle_name, bound_of};
use dalembert_codegen::{Function, Generated, ScalarType};
use serde_json::{Value, json};

use crate::output;

/// The largest distance met of an angle's polynomials from sine and cosine.
pub struct Check {
    function: Function,
    scalar: ScalarType,
    angle: AngleSum,
    error: f64,
    bound: f64,
}

impl Check {
    /// Returns whether that is no more than was proved.
    pub fn passed(&self) -> bool {
        self.error <= self.bound
    }

    /// Writes it as JSON.
    pub fn json(&self) -> Value {
        json!({
            "function": self.function.name(),
            "scalar": self.scalar.name(),
            "angle": angle_name(self.angle),
            "seen": self.error,
            "proved": self.bound,
            "passed": self.passed(),
        })
    }
}

/// Returns the angles that are not libm's, at some states.
pub fn checks(generated: &Generated, states: &[JointState]) -> Vec<Check> {
    let mut checks = Vec::new();
    for emitted in &generated.emitted {
        let mut functions = generated.functions.iter();
        let Some(function) = functions.find(|f| f.function == emitted.function) else {
            continue;
        };
        let proved = function.sines(emitted.scalar).iter();
        let seen = emitted.sines(states).into_iter().zip(proved);
        checks.extend(seen.map(|((angle, error), proved)| Check {
            function: emitted.function,
            scalar: emitted.scalar,
            angle,
            error,
            // The sine that it is held against has an ulp of its own.
            bound: proved.errors.worst() + f64::EPSILON,
        }));
    }
    checks
}

/// Returns the checks as a table with its title; nothing if there are none.
pub fn table(checks: &[Check]) -> String {
    if checks.is_empty() {
        return String::new();
    }
    let head = ["function", "scalar", "angle", "seen", "proved", ""];
    let mut rows = vec![head.map(String::from).to_vec()];
    for check in checks {
        rows.push(vec![
            check.function.to_string(),
            check.scalar.to_string(),
            angle_name(check.angle),
            format!("{:.1e}", check.error),
            bound_of(check.bound, 2),
            if check.passed() { "ok" } else { "FAILED" }.to_owned(),
        ]);
    }
    let title = "\npolynomials against libm's sine and cosine, absolute\n";
    title.to_owned() + &output::table(&rows, 1)
}
