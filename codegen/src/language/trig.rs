//! The sines and cosines at the start of a function: called angle by angle, or
//! together, or as polynomials.
//!
//! ```text
//! let (s1, c1) = libm::sincos(q[0]);
//!
//! let a1p2 = q[0] + q[1];
//! let ([s1, s1p2], [c1, _]) = dalembert_sines::sincos(&[q[0], a1p2]);
//! ```

use std::fmt::Write;

use crate::language::dialect::Dialect;
use crate::language::{angles, sines};
use crate::program::{Library, Lowered, LoweredTrig};

/// Prints them.
pub(super) fn write(text: &mut String, code: &Lowered) {
    let dialect = Dialect::rust(code.scalar);
    for trig in &code.trig {
        if trig.angle.additions() > 0 {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "    let a{} = {};",
                trig.angle,
                angles::sum(trig.angle)
            );
        }
        if is_together(trig, code) {
            continue;
        }
        let (pair, angle) = (angles::pair(trig), angles::operand(trig.angle));
        match &trig.kernel {
            Some(kernel) => sines::write(text, &pair, &angle, kernel, dialect),
            None => {
                let value = dialect.call("libm", called(trig), &angle);
                let _ = writeln!(text, "    let {pair} = {value};");
            }
        }
    }
    together(text, code);
}

/// Returns whether an angle's sines are of those that one call gives.
pub(super) fn is_together(trig: &LoweredTrig, code: &Lowered) -> bool {
    code.library == Library::Together && trig.kernel.is_none()
}

/// Returns the name of the function that gives what is taken of an angle.
pub(super) fn called(trig: &LoweredTrig) -> &'static str {
    match (trig.sin, trig.cos) {
        (true, false) => "sin",
        (false, true) => "cos",
        _ => "sincos",
    }
}

/// Prints one call for all of them; what is not needed gets no name.
fn together(text: &mut String, code: &Lowered) {
    let called = || code.trig.iter().filter(|trig| is_together(trig, code));
    if called().next().is_none() {
        return;
    }
    let name = |needed: bool, letter: char, trig: &LoweredTrig| match needed {
        true => format!("{letter}{}", trig.angle),
        false => "_".to_owned(),
    };
    let sin: Vec<String> = called().map(|trig| name(trig.sin, 's', trig)).collect();
    let cos: Vec<String> = called().map(|trig| name(trig.cos, 'c', trig)).collect();
    let angles: Vec<String> = called().map(|trig| angles::operand(trig.angle)).collect();
    let suffix = code.scalar.math_suffix();
    let (sin, cos, angles) = (sin.join(", "), cos.join(", "), angles.join(", "));
    let _ = writeln!(
        text,
        "    let ([{sin}], [{cos}]) = dalembert_sines::sincos{suffix}(&[{angles}]);"
    );
}
