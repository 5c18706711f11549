//! Given states compared with generated code.

use std::collections::BTreeMap;
use std::iter;
use std::path::Path;

use crate::states::compare::{Compared, compare, quantities};
use crate::states::{BOUND, GivenState};
use dalembert_codegen::workspace::{Quantity, Runtime};
use dalembert_codegen::{Generated, Request, ScalarType};
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use crate::input;
use crate::outcome::Failure;

/// An error of every value below this is one of digits, not of units or signs.
const FEW_DIGITS: f64 = 1e-4;

/// The states of a file, before and after they were compared.
pub struct Given<'a> {
    file: &'a Path,
    states: Vec<GivenState>,
    pub compared: Vec<Compared>,
}

impl<'a> Given<'a> {
    /// Reads them.
    ///
    /// # Errors
    /// They cannot be read, or nothing in them can be compared with what the
    /// request generates.
    pub fn read(file: &'a Path, robot: &Robot, request: &Request) -> Result<Given<'a>, Failure> {
        let given = Given {
            file,
            states: input::states(file, robot.joints.len())?,
            compared: Vec::new(),
        };
        let fail = |why: String| {
            let file = file.display();
            Err(Failure::Input(format!(
                "error: {file}: nothing is compared: {why}"
            )))
        };
        let keys = given.keys();
        if keys.is_empty() {
            return fail("no state has any of `tau`, `D`, `h`, `c`".into());
        }
        let mut returned = request.functions.iter().copied().flat_map(quantities);
        if !returned.any(|quantity| keys.contains_key(&quantity)) {
            let keys: Vec<String> = keys.keys().map(|key| format!("`{}`", word(*key))).collect();
            return fail(format!(
                "the states have {}, which no function of --outputs returns",
                keys.join(", ")
            ));
        }
        if !request.scalars.contains(&ScalarType::F64) {
            return fail(
                "states are doubles, and only f32 code is generated\n  = help: --scalar f64".into(),
            );
        }
        Ok(given)
    }

    /// Runs the code at them; only double precision, since a state rounded to
    /// f32 is another state.
    pub fn compare(&mut self, runtime: &Runtime, generated: &Generated) {
        let double = generated.emitted.iter();
        let double = double.filter(|emitted| emitted.scalar == ScalarType::F64);
        self.compared = double
            .flat_map(|emitted| compare(emitted, runtime, &self.states))
            .collect();
    }

    /// Returns what the states give, and how many of them give it.
    fn keys(&self) -> BTreeMap<Quantity, usize> {
        let mut keys = BTreeMap::new();
        for quantity in self.states.iter().flat_map(|state| state.known.keys()) {
            *keys.entry(*quantity).or_default() += 1;
        }
        keys
    }

    /// Returns what was compared, in one line or two.
    pub fn summary(&self) -> String {
        let named = |compared: bool| {
            let keys = self.keys().into_iter().filter(|(quantity, _)| {
                let mut all = self.compared.iter();
                all.any(|one| one.quantity == *quantity) == compared
            });
            let words = keys.map(|(quantity, states)| format!("{} at {states}", word(quantity)));
            words.collect::<Vec<_>>().join(", ")
        };
        let mut text = format!(
            "\n{} states in {}; compared: {}\n",
            self.states.len(),
            self.file.display(),
            named(true)
        );
        let missed = named(false);
        if !missed.is_empty() {
            text += &format!("not compared, since no function of --outputs returns it: {missed}\n");
        }
        text
    }

    /// Returns the rows of the table of errors.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let head = [
            "function", "scalar", "result", "against", "in u", "error", "bound", "",
        ];
        let rows = self.compared.iter().map(|one| {
            let u = ScalarType::F64.unit_roundoff();
            vec![
                one.function.to_string(),
                ScalarType::F64.to_string(),
                one.quantity.symbol().to_owned(),
                format!("{} states", one.states),
                format!("{:.1}", one.worst.error / u),
                format!("{:.1e}", one.worst.error),
                format!("{BOUND:.1e}"),
                if one.agrees() { "ok" } else { "DISAGREES" }.to_owned(),
            ]
        });
        iter::once(head.map(str::to_owned).to_vec())
            .chain(rows)
            .collect()
    }

    /// Writes them for programs.
    pub fn errors(&self) -> impl Iterator<Item = Value> {
        self.compared.iter().map(|one| {
            json!({
                "function": one.function.name(),
                "scalar": ScalarType::F64.name(),
                "quantity": one.quantity.symbol(),
                "against": "states",
                "states": one.states,
                "error": one.worst.error,
                "error_in_u": one.worst.error / ScalarType::F64.unit_roundoff(),
                "bound": BOUND,
                "passed": one.agrees(),
            })
        })
    }

    /// Returns the comparison and its disagreements as JSON.
    pub fn json(&self, robot: &Robot) -> Value {
        let keys = self.keys().into_iter();
        let compared = self.compared.iter().map(|one| one.quantity);
        let compared: Vec<Quantity> = compared.collect();
        let (used, unused): (Vec<_>, Vec<_>) = keys.partition(|(key, _)| compared.contains(key));
        let object = |keys: Vec<(Quantity, usize)>| {
            let keys = keys
                .into_iter()
                .map(|(key, states)| (word(key).to_owned(), states.into()));
            Value::Object(keys.collect())
        };
        let disagreements = self.compared.iter().filter(|one| !one.agrees());
        let disagreements = disagreements.map(|one| {
            json!({
                "function": one.function.name(),
                "quantity": one.quantity.symbol(),
                "states": one.disagreeing,
                "state": one.worst.state + 1,
                "entry": one.worst.entry + 1,
                "given": one.worst.given,
                "found": one.worst.found,
                "text": one.describe(robot),
            })
        });
        json!({
            "file": self.file.display().to_string(),
            "states": self.states.len(),
            "compared": object(used),
            "not_compared": object(unused),
            "disagreements": disagreements.collect::<Vec<_>>(),
            "help": (!self.agrees()).then(|| self.help()),
        })
    }

    pub fn agrees(&self) -> bool {
        self.compared.iter().all(Compared::agrees)
    }

    /// Names the usual causes of a disagreement, or the digits that agree where most do.
    fn help(&self) -> String {
        let errors = self.compared.iter().map(|one| one.worst.error);
        let worst = errors.fold(0.0, f64::max);
        if worst < FEW_DIGITS {
            return format!(
                "all values agree to {:.1} digits: were they written with fewer than 17, \
                 or with another value of a parameter?",
                -worst.log10()
            );
        }
        "the usual causes are units (degrees, mm, g), signs and axes of gravity, the DH convention, \
         inertia about the origin instead of the centre of mass, products of inertia, axes and \
         zeros of single joints, damping and armature; compare `c` at q = 0 first, then `D`, \
         then `h`"
            .into()
    }

    /// Lists the quantities that disagree, each at its worst state.
    pub fn disagreement(&self, robot: &Robot) -> Option<String> {
        if self.agrees() {
            return None;
        }
        let mut text = format!(
            "error: {}: the robot disagrees with the states",
            self.file.display()
        );
        // Several functions return the same quantity: it is named once.
        let mut named = Vec::new();
        for one in self.compared.iter().filter(|one| !one.agrees()) {
            if !named.contains(&one.quantity) {
                named.push(one.quantity);
                text += &format!(
                    "\n  {}; {} of {} states disagree",
                    one.describe(robot),
                    one.disagreeing,
                    one.states
                );
            }
        }
        Some(text + "\n  = help: " + &self.help())
    }
}

/// Returns the key of a quantity in a file.
fn word(quantity: Quantity) -> &'static str {
    quantity.given().unwrap_or_else(|| quantity.symbol())
}
