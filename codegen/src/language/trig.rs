//! The sines and cosines at the start of a function: called angle by angle, or
//! together, or as polynomials.
//!
//! ```text
//! let (s1, c1) = libm::sincos(q[0]);
//!
//! let ([s1, s2], [c1, _]) = dalembert_sines::sincos(&[q[0], q[1]]);
//! ```

use std::fmt::Write;

use crate::language::dialect::Dialect;
use crate::language::{angles, sines};
use crate::program::{Code, Input, Library, Need, Pair};

/// Prints them.
pub(super) fn write(text: &mut String, code: &Code) {
    let dialect = Dialect::rust(code.scalar);
    for pair in &code.pairs {
        if is_together(pair, code) {
            continue;
        }
        let (names, angle) = (
            angles::names(pair.joint, pair.need),
            angles::operand(pair.joint),
        );
        match &pair.kernel {
            Some(kernel) => sines::write(text, &names, &angle, kernel, dialect),
            None => {
                let value = dialect.call("libm", called(pair.need), &angle);
                // Writing to a string cannot fail.
                let _ = writeln!(text, "    let {names} = {value};");
            }
        }
    }
    together(text, code);
}

/// Returns whether an angle's sines are of those that one call gives.
pub(super) fn is_together(pair: &Pair, code: &Code) -> bool {
    code.library == Library::Together && pair.kernel.is_none()
}

/// Returns the name of the function that gives what is taken of an angle.
pub(super) fn called(need: Need) -> &'static str {
    match (need.sin, need.cos) {
        (true, false) => "sin",
        (false, true) => "cos",
        _ => "sincos",
    }
}

/// Lists the angles whose sines one call gives.
pub(super) fn taken(code: &Code) -> impl Iterator<Item = &Pair> {
    code.pairs.iter().filter(|pair| is_together(pair, code))
}

/// Lists the names of the sines, and of the cosines, of angles that one call gives; what is not
/// needed gets no name.
pub(super) fn taken_names(code: &Code) -> [String; 2] {
    let each = |name: &dyn Fn(&Pair) -> Option<String>| {
        let names = taken(code).map(|pair| name(pair).unwrap_or_else(|| "_".to_owned()));
        names.collect::<Vec<String>>().join(", ")
    };
    [
        each(&|pair| pair.need.sin.then(|| Input::Sin(pair.joint).name())),
        each(&|pair| pair.need.cos.then(|| Input::Cos(pair.joint).name())),
    ]
}

/// Prints one call for all of them.
fn together(text: &mut String, code: &Code) {
    let angles: Vec<String> = taken(code)
        .map(|pair| angles::operand(pair.joint))
        .collect();
    if angles.is_empty() {
        return;
    }
    let (suffix, angles) = (code.scalar.math_suffix(), angles.join(", "));
    let [sin, cos] = taken_names(code);
    let _ = writeln!(
        text,
        "    let ([{sin}], [{cos}]) = dalembert_sines::sincos{suffix}(&[{angles}]);"
    );
}
