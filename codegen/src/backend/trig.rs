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

use crate::backend::{MathPath, sines};
use crate::program::{AngleSum, Library, Program, ScalarType, Trig};
use crate::sincos::AngleKernel;

/// Prints them; angles that are not among `sines` are `math`'s.
pub(super) fn write(
    text: &mut String,
    program: &Program,
    scalar: ScalarType,
    math: &MathPath,
    sines: &[AngleKernel],
) {
    let mut called = Vec::new();
    for trig in &program.trig {
        let argument = argument(text, trig.angle);
        let own = sines.iter().find(|sine| sine.angle == trig.angle);
        match (own, math.library) {
            (Some(own), _) => sines::write(text, &names(trig), &argument, &own.kernel, scalar),
            (None, Library::Libm) => alone(text, trig, &argument, scalar, math),
            (None, Library::Together) => called.push((trig, argument)),
        }
    }
    if !called.is_empty() {
        together(text, &called, scalar, math);
    }
}

/// How the code names an angle; a sum is formed first.
fn argument(text: &mut String, angle: AngleSum) -> String {
    let mut terms = angle.terms();
    if angle.additions() == 0 {
        return terms
            .next()
            .map_or_else(String::new, |(joint, _)| format!("q[{joint}]"));
    }
    let mut sum = String::new();
    for (index, (joint, negative)) in terms.enumerate() {
        let sign = match (index, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        // Writing to a string cannot fail.
        let _ = write!(sum, "{sign}q[{joint}]");
    }
    let _ = writeln!(text, "    let a{angle} = {sum};");
    format!("a{angle}")
}

/// What a line gives names to.
fn names(trig: &Trig) -> String {
    let angle = trig.angle;
    match (trig.sin, trig.cos) {
        (true, false) => format!("s{angle}"),
        (false, true) => format!("c{angle}"),
        _ => format!("(s{angle}, c{angle})"),
    }
}

fn alone(text: &mut String, trig: &Trig, argument: &str, scalar: ScalarType, math: &MathPath) {
    let call = match (trig.sin, trig.cos) {
        (true, false) => "sin",
        (false, true) => "cos",
        _ => "sincos",
    };
    let (path, suffix) = (&math.path, scalar.math_suffix());
    let names = names(trig);
    let _ = writeln!(
        text,
        "    let {names} = {path}::{call}{suffix}({argument});"
    );
}

/// One call for all of them; what is not needed gets no name.
fn together(text: &mut String, called: &[(&Trig, String)], scalar: ScalarType, math: &MathPath) {
    let name = |needed: bool, letter: char, trig: &Trig| match needed {
        true => format!("{letter}{}", trig.angle),
        false => "_".to_owned(),
    };
    let trigs = || called.iter().map(|(trig, _)| *trig);
    let sin: Vec<String> = trigs().map(|trig| name(trig.sin, 's', trig)).collect();
    let cos: Vec<String> = trigs().map(|trig| name(trig.cos, 'c', trig)).collect();
    let arguments: Vec<&str> = called
        .iter()
        .map(|(_, argument)| argument.as_str())
        .collect();
    let (path, suffix) = (&math.path, scalar.math_suffix());
    let (sin, cos, arguments) = (sin.join(", "), cos.join(", "), arguments.join(", "));
    let _ = writeln!(
        text,
        "    let ([{sin}], [{cos}]) = {path}::sincos{suffix}(&[{arguments}]);"
    );
}
