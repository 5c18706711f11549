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

use crate::backend::place::Place;
use crate::backend::{MathPath, sines};
use crate::program::{Library, Program, ScalarType, Trig};
use crate::sincos::AngleKernel;

/// Prints them; angles that are not among `sines` are `math`'s.
pub(super) fn write(
    text: &mut String,
    program: &Program,
    scalar: ScalarType,
    math: &MathPath,
    sines: &[AngleKernel],
) {
    for trig in &program.trig {
        let place = Place::STATE;
        if trig.angle.additions() > 0 {
            let sum = place.sum(trig.angle);
            // Writing to a string cannot fail.
            let _ = writeln!(text, "    let a{} = {sum};", trig.angle);
        }
        if !is_together(trig, math, sines) {
            alone(text, trig, place, scalar, math, sines);
        }
    }
    let angle = |trig: &Trig| Place::STATE.angle(trig.angle);
    together(text, program, scalar, math, sines, "", angle);
}

/// Whether an angle's sines are of those that one call gives.
pub(super) fn is_together(trig: &Trig, math: &MathPath, sines: &[AngleKernel]) -> bool {
    math.library == Library::Together && own(trig, sines).is_none()
}

fn own<'k>(trig: &Trig, sines: &'k [AngleKernel]) -> Option<&'k AngleKernel> {
    sines.iter().find(|sine| sine.angle == trig.angle)
}

/// One angle's by polynomials or a call of its own.
pub(super) fn alone(
    text: &mut String,
    trig: &Trig,
    place: Place,
    scalar: ScalarType,
    math: &MathPath,
    sines: &[AngleKernel],
) {
    if let Some(own) = own(trig, sines) {
        let (pair, angle) = (place.pair(trig), place.angle(trig.angle));
        return sines::write(text, place, &pair, &angle, &own.kernel, scalar);
    }
    let call = match (trig.sin, trig.cos) {
        (true, false) => "sin",
        (false, true) => "cos",
        _ => "sincos",
    };
    let (path, suffix) = (&math.path, scalar.math_suffix());
    let (pair, angle) = (place.pair(trig), place.angle(trig.angle));
    let Place {
        indent, binding, ..
    } = place;
    let _ = writeln!(
        text,
        "{indent}{binding}{pair} = {path}::{call}{suffix}({angle});"
    );
}

/// One call for all of them; what is not needed gets no name. In lanes, names
/// and angles are arrays, and the function has another name.
pub(super) fn together(
    text: &mut String,
    program: &Program,
    scalar: ScalarType,
    math: &MathPath,
    sines: &[AngleKernel],
    lanes: &str,
    angle: impl Fn(&Trig) -> String,
) {
    let called = || {
        let trigs = program.trig.iter();
        trigs.filter(|trig| is_together(trig, math, sines))
    };
    if called().next().is_none() {
        return;
    }
    let name = |needed: bool, letter: char, trig: &Trig| match needed {
        true => format!("{letter}{}", trig.angle),
        false => "_".to_owned(),
    };
    let sin: Vec<String> = called().map(|trig| name(trig.sin, 's', trig)).collect();
    let cos: Vec<String> = called().map(|trig| name(trig.cos, 'c', trig)).collect();
    let angles: Vec<String> = called().map(angle).collect();
    let (path, suffix) = (&math.path, scalar.math_suffix());
    let (sin, cos, angles) = (sin.join(", "), cos.join(", "), angles.join(", "));
    let _ = writeln!(
        text,
        "    let ([{sin}], [{cos}]) = {path}::sincos{suffix}{lanes}(&[{angles}]);"
    );
}
