//! The lines that give a caller's sines and cosines their names.

use crate::backend::entries::angles::Angles;
use crate::backend::read::error::SineFault;
use crate::backend::read::index_of;
use crate::program::{AngleSum, LoweredTrig};

/// What `let (s1, c1) = (sin[0], cos[0]);` says, from its names and its value;
/// `None` if it is another kind of line.
pub(super) fn read(
    names: &str,
    value: &str,
    angles: &Angles,
) -> Option<Result<LoweredTrig, SineFault>> {
    let (names, values) = (pair(names), pair(value));
    let is_given = |value: &str| value.starts_with("sin[") || value.starts_with("cos[");
    is_given(values[0]).then(|| given(&names, &values, angles))
}

fn given(names: &[&str], values: &[&str], angles: &Angles) -> Result<LoweredTrig, SineFault> {
    let mut found: Option<LoweredTrig> = None;
    if names.len() != values.len() {
        return Err(SineFault::UnevenNames);
    }
    for (name, value) in names.iter().zip(values) {
        let (letter, array) = match value.starts_with('s') {
            true => ('s', "sin"),
            false => ('c', "cos"),
        };
        let angle = name.strip_prefix(letter).and_then(|name| name.parse().ok());
        let given = || ((*name).to_owned(), (*value).to_owned());
        let angle: AngleSum = angle.ok_or_else(|| {
            let (name, value) = given();
            SineFault::GivenName { name, value }
        })?;
        if index_of(value, array).is_none_or(|at| angles.place(angle) != Some(at)) {
            let (name, value) = given();
            return Err(SineFault::GivenPlace { name, value });
        }
        let trig = found.get_or_insert(LoweredTrig {
            angle,
            sin: false,
            cos: false,
            kernel: None,
        });
        let taken = match letter {
            's' => &mut trig.sin,
            _ => &mut trig.cos,
        };
        if trig.angle != angle || *taken {
            return Err(SineFault::GivenPair((*name).to_owned()));
        }
        *taken = true;
    }
    found.ok_or(SineFault::NoneGiven)
}

/// `(a, b)` or `a`.
fn pair(words: &str) -> Vec<&str> {
    let inner = words.strip_prefix('(').and_then(|w| w.strip_suffix(')'));
    match inner {
        Some(inner) => inner.split(", ").collect(),
        None => vec![words],
    }
}
