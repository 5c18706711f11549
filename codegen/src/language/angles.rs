//! The names of angles, their sines and their cosines in printed code.

use crate::program::{AngleSum, LoweredTrig};

/// Returns the operand that sines are taken of; a sum stands in a line of its own.
pub(crate) fn operand(angle: AngleSum) -> String {
    match (angle.additions(), angle.terms().next()) {
        (0, Some((joint, _))) => format!("q[{joint}]"),
        _ => format!("a{angle}"),
    }
}

/// Returns a sum of angles, term by term.
pub(crate) fn sum(angle: AngleSum) -> String {
    let mut sum = String::new();
    for (index, (joint, negative)) in angle.terms().enumerate() {
        sum += match (index, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        sum += &format!("q[{joint}]");
    }
    sum
}

/// Returns the names that a line defines: the sine, the cosine or both.
pub(super) fn pair(trig: &LoweredTrig) -> String {
    let angle = trig.angle;
    match (trig.sin, trig.cos) {
        (true, false) => format!("s{angle}"),
        (false, true) => format!("c{angle}"),
        _ => format!("(s{angle}, c{angle})"),
    }
}
