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
use crate::language::scope::Scope;
use crate::language::sines;
use crate::program::{Library, Lowered, LoweredTrig};

/// Prints them; `path` is where those are that are called.
pub(super) fn write(text: &mut String, code: &Lowered, path: &str) {
    for trig in &code.trig {
        let scope = Scope::STATE;
        if trig.angle.additions() > 0 {
            let sum = scope.sum(trig.angle);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "    let a{} = {sum};", trig.angle);
        }
        if !is_together(trig, code) {
            alone(text, trig, scope, code, path);
        }
    }
    let angle = |trig: &LoweredTrig| Scope::STATE.angle(trig.angle);
    together(text, code, path, "", angle);
}

/// Returns whether an angle's sines are of those that one call gives.
pub(super) fn is_together(trig: &LoweredTrig, code: &Lowered) -> bool {
    code.library == Library::Together && trig.kernel.is_none()
}

/// Writes one angle's sines by polynomials or a call of its own.
pub(super) fn alone(
    text: &mut String,
    trig: &LoweredTrig,
    scope: Scope,
    code: &Lowered,
    path: &str,
) {
    let (pair, angle) = (scope.pair(trig), scope.angle(trig.angle));
    let dialect = Dialect::rust(code.scalar);
    if let Some(kernel) = &trig.kernel {
        return sines::write(text, scope, &pair, &angle, kernel, dialect);
    }
    let Scope {
        indent, binding, ..
    } = scope;
    let value = dialect.call(path, called(trig), &angle);
    let _ = writeln!(text, "{indent}{binding}{pair} = {value};");
}

/// Returns the name of the function that gives what is taken of an angle.
pub(super) fn called(trig: &LoweredTrig) -> &'static str {
    match (trig.sin, trig.cos) {
        (true, false) => "sin",
        (false, true) => "cos",
        _ => "sincos",
    }
}

/// Returns one call for all of them; what is not needed gets no name. In lanes, names
/// and angles are arrays, and the function has another name.
pub(super) fn together(
    text: &mut String,
    code: &Lowered,
    path: &str,
    lanes: &str,
    angle: impl Fn(&LoweredTrig) -> String,
) {
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
    let angles: Vec<String> = called().map(angle).collect();
    let suffix = code.scalar.math_suffix();
    let (sin, cos, angles) = (sin.join(", "), cos.join(", "), angles.join(", "));
    let _ = writeln!(
        text,
        "    let ([{sin}], [{cos}]) = {path}::sincos{suffix}{lanes}(&[{angles}]);"
    );
}
