//! Files of states: JSON with a list `states` of objects with `q`, the rates
//! `qd` and `qdd` where they matter, and any of `tau`, `D`, `h`, `c`.

use std::fmt;

use dalembert_codegen::function::{Argument, Quantity, Sizes};
use dalembert_codegen::states::JointState;
use dalembert_model::read::closest;
use serde_json::{Map, Value};

use super::GivenState;

/// The keys of quantities, in the order of the list of outputs.
fn given() -> impl Iterator<Item = (&'static str, Quantity)> {
    let all = Quantity::ALL.iter();
    all.filter_map(|&quantity| Some((quantity.given()?, quantity)))
}

/// Every key of a state.
fn keys() -> Vec<&'static str> {
    let joints = Argument::ALL.into_iter().filter_map(Argument::given);
    joints.chain(given().map(|(key, _)| key)).collect()
}

/// The results that a state may have, as a message lists them.
fn results() -> String {
    let keys: Vec<String> = given().map(|(key, _)| format!("`{key}`")).collect();
    keys.join(", ")
}

/// The torques that drive an arm, unlike those that a motion takes.
const TORQUE: &str = "torque";

/// What other libraries call the same thing.
const OTHER_WORDS: [(&str, &str); 33] = [
    ("torques", "tau"),
    ("effort", "tau"),
    ("efforts", "tau"),
    ("force", "tau"),
    ("forces", "tau"),
    ("u", "tau"),
    ("m", "D"),
    ("mass_matrix", "D"),
    ("inertia", "D"),
    ("inertia_matrix", "D"),
    ("coriolis", "h"),
    ("bias", "h"),
    ("gravity", "c"),
    ("gravity_load", "c"),
    ("g", "c"),
    ("position", "q"),
    ("positions", "q"),
    ("angles", "q"),
    ("theta", "q"),
    ("velocity", "qd"),
    ("velocities", "qd"),
    ("dq", "qd"),
    ("q_dot", "qd"),
    ("qdot", "qd"),
    ("v", "qd"),
    ("acceleration", "qdd"),
    ("accelerations", "qdd"),
    ("ddq", "qdd"),
    ("q_ddot", "qdd"),
    ("qddot", "qdd"),
    ("a", "qdd"),
    ("state", "states"),
    ("samples", "states"),
];

/// What a state may say of itself, a number each: the condition of D, by which its
/// source judged the results that need D⁻¹. No function returns it.
const REMARKS: [&str; 1] = ["condition"];

/// Why a file of states cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileError {
    /// It is no JSON.
    Syntax {
        /// What the parser says.
        message: String,
        /// From one.
        line: usize,
        /// From one.
        column: usize,
    },
    /// It is JSON, but not states of this robot.
    Content(String),
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileError::Syntax { message, .. } => f.write_str(message),
            FileError::Content(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for FileError {}

/// Reads the states of a robot with n joints.
///
/// # Errors
/// The text is no JSON, has no states, or a state has an unknown key, lacks one,
/// or has a wrong number of values.
pub fn read(bytes: &[u8], n: usize) -> Result<Vec<GivenState>, FileError> {
    let json: Value = serde_json::from_slice(bytes).map_err(|error| FileError::Syntax {
        message: error.to_string(),
        line: error.line(),
        column: error.column(),
    })?;
    let list = json.get("states").and_then(Value::as_array);
    let list = list.ok_or_else(|| FileError::Content(without_states(&json)))?;
    if list.is_empty() {
        return Err(FileError::Content("the list `states` is empty".into()));
    }
    let state = |(index, value)| {
        state(value, n).map_err(|why| FileError::Content(format!("state {}: {why}", index + 1)))
    };
    list.iter().enumerate().map(state).collect()
}

fn without_states(json: &Value) -> String {
    let keys = json.as_object().into_iter().flat_map(Map::keys);
    let mut meant = keys.filter(|key| likely(key, &["states"]).is_some());
    match meant.next() {
        Some(key) => format!("there is no list `states`; is `{key}` meant?"),
        None => "there is no list `states`: a file of states is \
                 {\"states\": [{\"q\": […], \"qd\": […], \"qdd\": […], \"tau\": […]}, …]}"
            .into(),
    }
}

fn state(value: &Value, n: usize) -> Result<GivenState, String> {
    let keys = value.as_object().ok_or_else(|| {
        let results = results();
        format!("a state is an object with `q`, `qd`, `qdd` and any of {results}")
    })?;
    let known = self::keys();
    for (key, value) in keys {
        match (
            known.contains(&key.as_str()),
            REMARKS.contains(&key.as_str()),
        ) {
            (true, _) => {}
            (_, true) if value.is_number() => {}
            (_, true) => return Err(format!("`{key}` is a number")),
            (false, false) => return Err(unknown(key)),
        }
    }
    let need = |key: &str| vector(keys, key, n)?.ok_or_else(|| format!("`{key}` is missing"));
    let q = need("q")?;
    let mut given = GivenState {
        state: JointState {
            q,
            qd: vector(keys, "qd", n)?.unwrap_or_else(|| vec![0.0; n]),
            qdd: vector(keys, "qdd", n)?.unwrap_or_else(|| vec![0.0; n]),
            tau: vector(keys, TORQUE, n)?.unwrap_or_default(),
            ..JointState::default()
        },
        known: Default::default(),
    };
    for (key, quantity) in self::given() {
        let Some(values) = vector(keys, key, quantity.len(Sizes::whole(n)))? else {
            continue;
        };
        let arguments = quantity.arguments().iter();
        let mut needs = arguments.filter_map(|argument| argument.given());
        if let Some(missing) = needs.find(|need| !keys.contains_key(*need)) {
            return Err(format!("`{missing}` is missing, which `{key}` depends on"));
        }
        given.known.insert(quantity, values);
    }
    let mut read = given.known.keys().flat_map(|quantity| quantity.arguments());
    if keys.contains_key(TORQUE) && !read.any(|argument| *argument == Argument::Torque) {
        return Err(format!(
            "`{TORQUE}` is what `forward_dynamics` reads, and the state does not give that\n  \
             = help: torques that q, qd and qdd give are `tau`"
        ));
    }
    Ok(given)
}

fn unknown(key: &str) -> String {
    let shown: String = key.chars().take(40).map(plain).collect();
    let meant = likely(key, &keys());
    let meant = meant.map_or_else(String::new, |word| format!("did you mean `{word}`? "));
    format!(
        "`{shown}` is no key of a state\n  = help: {meant}a state has `q`, `qd`, `qdd` and any of {}",
        results()
    )
}

/// A control character would move the cursor of whoever reads the message.
fn plain(c: char) -> char {
    if c.is_control() { '\u{fffd}' } else { c }
}

fn likely<'k>(word: &str, keys: &[&'k str]) -> Option<&'k str> {
    let small = word.to_ascii_lowercase();
    let same = keys.iter().find(|key| key.eq_ignore_ascii_case(&small));
    let other = OTHER_WORDS.iter().find(|(other, _)| *other == small);
    let other = other.and_then(|(_, meant)| keys.iter().find(|key| *key == meant));
    same.or(other).copied().or_else(|| closest(word, keys))
}

/// A list of numbers, or a matrix as rows or row by row.
fn vector(keys: &Map<String, Value>, key: &str, len: usize) -> Result<Option<Vec<f64>>, String> {
    let Some(value) = keys.get(key) else {
        return Ok(None);
    };
    let list = match value {
        Value::Array(list) => list.as_slice(),
        // A result that is one number.
        Value::Number(_) if len == 1 => std::slice::from_ref(value),
        _ => return Err(format!("`{key}` is not a list")),
    };
    let mut numbers = Vec::new();
    for item in list {
        match item {
            Value::Array(row) => numbers.extend(row.iter().map(Value::as_f64)),
            other => numbers.push(other.as_f64()),
        }
    }
    let numbers: Option<Vec<f64>> = numbers.into_iter().collect();
    let numbers = numbers.ok_or_else(|| format!("`{key}` has an entry that is no number"))?;
    if numbers.len() != len {
        return Err(format!("`{key}` has {} numbers, not {len}", numbers.len()));
    }
    Ok(Some(numbers))
}
