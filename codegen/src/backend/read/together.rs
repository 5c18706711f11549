//! The line that calls a library for all angles at once.

use crate::backend::read::index_of;
use crate::program::{AngleSum, LoweredTrig, ScalarType};

/// What `let ([s1, _], [c1, c1p2]) = dalembert_sines::sincos(&[q[0], a1p2]);`
/// says, from its names and its value; `None` if it is another kind of line.
/// Sums of angles are those that lines before formed, in their order.
pub(super) fn read(
    names: &str,
    value: &str,
    scalar: ScalarType,
    sums: &mut Vec<AngleSum>,
) -> Option<Result<Vec<LoweredTrig>, String>> {
    let (path, arguments) = value.split_once("(&[")?;
    Some(calls(names, path, arguments, scalar, sums))
}

fn calls(
    names: &str,
    path: &str,
    arguments: &str,
    scalar: ScalarType,
    sums: &mut Vec<AngleSum>,
) -> Result<Vec<LoweredTrig>, String> {
    let arguments = arguments.strip_suffix("])").ok_or("no `])`")?;
    let call = path.rsplit("::").next().unwrap_or_default();
    if call.strip_suffix(scalar.math_suffix()) != Some("sincos") {
        return Err(format!("`{path}` is not `sincos` of this scalar"));
    }
    let pair = names.strip_prefix("([").and_then(|n| n.strip_suffix("])"));
    let (sin, cos) = pair
        .and_then(|pair| pair.split_once("], ["))
        .ok_or_else(|| format!("`{names}` are no sines and cosines"))?;
    let (sin, cos): (Vec<&str>, Vec<&str>) = (sin.split(", ").collect(), cos.split(", ").collect());
    let arguments: Vec<&str> = arguments.split(", ").collect();
    if sin.len() != arguments.len() || cos.len() != arguments.len() {
        return Err("as many sines, cosines and angles are expected".into());
    }
    let mut formed = std::mem::take(sums).into_iter();
    let mut all = Vec::new();
    for ((argument, sin), cos) in arguments.into_iter().zip(sin).zip(cos) {
        let angle = match index_of(argument, "q") {
            Some(joint) => AngleSum::joint(joint),
            None => formed
                .next()
                .filter(|sum| argument == format!("a{sum}"))
                .ok_or_else(|| format!("`{argument}` is no angle"))?,
        };
        let trig = LoweredTrig {
            angle,
            sin: taken(sin, 's', angle)?,
            cos: taken(cos, 'c', angle)?,
            kernel: None,
        };
        if !trig.sin && !trig.cos {
            return Err(format!("neither sine nor cosine of `{argument}` is taken"));
        }
        all.push(trig);
    }
    match formed.next() {
        Some(sum) => Err(format!("the sine of `a{sum}` is not called")),
        None => Ok(all),
    }
}

/// Whether a place has the name that it must have, or none.
fn taken(name: &str, letter: char, angle: AngleSum) -> Result<bool, String> {
    if name == "_" {
        return Ok(false);
    }
    let expected = format!("{letter}{angle}");
    match name == expected {
        true => Ok(true),
        false => Err(format!("`{expected}` or `_` expected, not `{name}`")),
    }
}
