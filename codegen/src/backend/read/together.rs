//! The line that calls a library for all angles at once.

use crate::backend::read::error::{Kind, Mark, SineFault, TextFault, WordFault};
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
) -> Option<Result<Vec<LoweredTrig>, TextFault>> {
    let (path, arguments) = value.split_once("(&[")?;
    Some(calls(names, path, arguments, scalar, sums))
}

fn calls(
    names: &str,
    path: &str,
    arguments: &str,
    scalar: ScalarType,
    sums: &mut Vec<AngleSum>,
) -> Result<Vec<LoweredTrig>, TextFault> {
    let arguments = arguments
        .strip_suffix("])")
        .ok_or(WordFault::Lacks(Mark::Bracket))?;
    let call = path.rsplit("::").next().unwrap_or_default();
    if call.strip_suffix(scalar.math_suffix()) != Some("sincos") {
        return Err(Kind::Sincos.not(path).into());
    }
    let pair = names.strip_prefix("([").and_then(|n| n.strip_suffix("])"));
    let (sin, cos) = pair
        .and_then(|pair| pair.split_once("], ["))
        .ok_or_else(|| Kind::Pairs.not(names))?;
    let (sin, cos): (Vec<&str>, Vec<&str>) = (sin.split(", ").collect(), cos.split(", ").collect());
    let arguments: Vec<&str> = arguments.split(", ").collect();
    if sin.len() != arguments.len() || cos.len() != arguments.len() {
        return Err(SineFault::Uneven.into());
    }
    let mut formed = std::mem::take(sums).into_iter();
    let mut all = Vec::new();
    for ((argument, sin), cos) in arguments.into_iter().zip(sin).zip(cos) {
        let angle = match index_of(argument, "q") {
            Some(joint) => AngleSum::joint(joint),
            None => formed
                .next()
                .filter(|sum| argument == format!("a{sum}"))
                .ok_or_else(|| Kind::Angle.not(argument))?,
        };
        let trig = LoweredTrig {
            angle,
            sin: taken(sin, 's', angle)?,
            cos: taken(cos, 'c', angle)?,
            kernel: None,
        };
        if !trig.sin && !trig.cos {
            return Err(SineFault::Untaken(argument.to_owned()).into());
        }
        all.push(trig);
    }
    match formed.next() {
        Some(sum) => Err(SineFault::Uncalled(sum).into()),
        None => Ok(all),
    }
}

/// Whether a place has the name that it must have, or none.
fn taken(name: &str, letter: char, angle: AngleSum) -> Result<bool, SineFault> {
    if name == "_" {
        return Ok(false);
    }
    let expected = format!("{letter}{angle}");
    match name == expected {
        true => Ok(true),
        false => Err(SineFault::Name {
            expected,
            found: name.to_owned(),
        }),
    }
}
