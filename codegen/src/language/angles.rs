//! The names of angles, their sines and their cosines in printed code.

use crate::program::{Input, Need};

/// Returns the operand that sines are taken of.
pub(crate) fn operand(joint: usize) -> String {
    format!("q[{joint}]")
}

/// Returns the names that a line defines: the sine, the cosine or both.
pub(super) fn names(joint: usize, need: Need) -> String {
    let [sine, cosine] = [Input::Sin(joint), Input::Cos(joint)].map(Input::name);
    match (need.sin, need.cos) {
        (true, false) => sine,
        (false, true) => cosine,
        _ => format!("({sine}, {cosine})"),
    }
}
