//! Files of states: JSON with a list `states` of objects with `q`, the rates
//! `qd` and `qdd` where they matter, and any of `tau`, `D`, `h`, `c`.
//!
//! - this file: reading them
//! - `words`: the keys, and what others call them
//! - `error`: why they cannot be used

mod error;
mod words;

use dalembert_codegen::workspace::{Argument, JointState, Sizes};
use serde_json::{Map, Value};

use super::GivenState;
pub use error::{ContentFault, FileError, StateFault};
use words::{TORQUE, likely};

/// Keys that a state may have about itself, a number each: the condition of D, by which its
/// source judged the results that need D⁻¹. No function returns it.
const REMARKS: [&str; 1] = ["condition"];

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
        return Err(FileError::Content(ContentFault::Empty));
    }
    let state = |(index, value)| {
        state(value, n).map_err(|fault| FileError::Content(ContentFault::State(index + 1, fault)))
    };
    list.iter().enumerate().map(state).collect()
}

fn without_states(json: &Value) -> ContentFault {
    let keys = json.as_object().into_iter().flat_map(Map::keys);
    let mut meant = keys.filter(|key| likely(key, &["states"]).is_some());
    ContentFault::NoStates(meant.next().cloned())
}

fn state(value: &Value, n: usize) -> Result<GivenState, StateFault> {
    let keys = value.as_object().ok_or(StateFault::NoObject)?;
    let known = words::keys();
    for (key, value) in keys {
        match (
            known.contains(&key.as_str()) || words::at_frame(key).is_some(),
            REMARKS.contains(&key.as_str()),
        ) {
            (true, _) => {}
            (_, true) if value.is_number() => {}
            (_, true) => return Err(StateFault::Remark(key.clone())),
            (false, false) => return Err(unknown(key)),
        }
    }
    let need = |key| vector(keys, key, n)?.ok_or(StateFault::Missing(key));
    let sizes = Sizes::whole(n);
    let other = |argument: Argument| {
        let key = argument.given().unwrap_or_default();
        Ok(vector(keys, key, argument.length(sizes))?.unwrap_or_default())
    };
    let q = need("q")?;
    let mut given = GivenState {
        state: JointState {
            q,
            qd: vector(keys, "qd", n)?.unwrap_or_else(|| vec![0.0; n]),
            qdd: vector(keys, "qdd", n)?.unwrap_or_else(|| vec![0.0; n]),
            tau: vector(keys, TORQUE, n)?.unwrap_or_default(),
            wrench: other(Argument::Wrench)?,
            damping: other(Argument::Damping)?,
            multiplier: other(Argument::Multiplier)?,
            ..JointState::default()
        },
        known: Default::default(),
    };
    let at_frames = keys.keys().filter_map(|key| words::at_frame(key));
    for (key, quantity) in words::given().chain(at_frames) {
        let Some(values) = vector(keys, key, quantity.len(sizes))? else {
            continue;
        };
        let arguments = quantity.arguments().iter();
        let mut needs = arguments.filter_map(|argument| argument.given());
        if let Some(missing) = needs.find(|need| !keys.contains_key(*need)) {
            let result = key;
            return Err(StateFault::MissingFor { missing, result });
        }
        given.known.insert(quantity, values);
    }
    let mut read = given.known.keys().flat_map(|quantity| quantity.arguments());
    if keys.contains_key(TORQUE) && !read.any(|argument| *argument == Argument::Torque) {
        return Err(StateFault::IdleTorque);
    }
    Ok(given)
}

fn unknown(key: &str) -> StateFault {
    StateFault::Unknown {
        key: key.chars().take(40).map(plain).collect(),
        meant: likely(key, &words::keys()),
    }
}

/// A control character would move the cursor of whoever reads the message.
fn plain(c: char) -> char {
    if c.is_control() { '\u{fffd}' } else { c }
}

/// Returns a list of numbers, or a matrix as rows or row by row.
fn vector(
    keys: &Map<String, Value>,
    key: &'static str,
    len: usize,
) -> Result<Option<Vec<f64>>, StateFault> {
    let Some(value) = keys.get(key) else {
        return Ok(None);
    };
    let list = match value {
        Value::Array(list) => list.as_slice(),
        // A result that is one number.
        Value::Number(_) if len == 1 => std::slice::from_ref(value),
        _ => return Err(StateFault::NoList(key)),
    };
    let mut numbers = Vec::new();
    for item in list {
        match item {
            Value::Array(row) => numbers.extend(row.iter().map(Value::as_f64)),
            other => numbers.push(other.as_f64()),
        }
    }
    let numbers: Option<Vec<f64>> = numbers.into_iter().collect();
    let numbers = numbers.ok_or(StateFault::NoNumber(key))?;
    if numbers.len() != len {
        return Err(StateFault::Length {
            key,
            expected: len,
            found: numbers.len(),
        });
    }
    Ok(Some(numbers))
}
