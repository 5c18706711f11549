//! The lines that give a caller's sines and cosines their names.

use crate::backend::entries::angles::Angles;
use crate::backend::read::index_of;
use crate::program::{AngleSum, LoweredTrig};

/// What `let (s1, c1) = (sin[0], cos[0]);` says, from its names and its value;
/// `None` if it is another kind of line.
pub(super) fn read(
    names: &str,
    value: &str,
    angles: &Angles,
) -> Option<Result<LoweredTrig, String>> {
    let (names, values) = (pair(names), pair(value));
    let is_given = |value: &str| value.starts_with("sin[") || value.starts_with("cos[");
    is_given(values[0]).then(|| given(&names, &values, angles))
}

fn given(names: &[&str], values: &[&str], angles: &Angles) -> Result<LoweredTrig, String> {
    let mut found: Option<LoweredTrig> = None;
    if names.len() != values.len() {
        return Err("as many names as sines and cosines are expected".into());
    }
    for (name, value) in names.iter().zip(values) {
        let (letter, array) = match value.starts_with('s') {
            true => ('s', "sin"),
            false => ('c', "cos"),
        };
        let angle = name.strip_prefix(letter).and_then(|name| name.parse().ok());
        let angle: AngleSum = angle.ok_or_else(|| format!("`{name}` is no name of `{value}`"))?;
        if index_of(value, array).is_none_or(|at| angles.place(angle) != Some(at)) {
            return Err(format!("`{name}` does not stand in `{value}`"));
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
            return Err(format!("`{name}` is not the other one of its angle"));
        }
        *taken = true;
    }
    found.ok_or_else(|| "no sine or cosine is given".into())
}

/// `(a, b)` or `a`.
fn pair(words: &str) -> Vec<&str> {
    let inner = words.strip_prefix('(').and_then(|w| w.strip_suffix(')'));
    match inner {
        Some(inner) => inner.split(", ").collect(),
        None => vec![words],
    }
}
