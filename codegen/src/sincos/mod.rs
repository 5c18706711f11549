//! Sine and cosine by polynomials with proved errors, instead of a library.
//!
//! A robot's joints have limits, so most angles need none of what a library's
//! sine does for large ones; and a tolerance of 1e-6 needs no sixteen digits.
//!
//! Takes a program and the ranges of its angles; returns an [`AngleKernel`] for each joint: two
//! polynomials with their proved `Errors`. [`SinCos`] names the other sources of sines.

pub(crate) mod choose;
pub(crate) mod forms;
pub(crate) mod interval;
pub(crate) mod poly;
pub(crate) mod proof;
pub(crate) mod reach;
pub(crate) mod reduction;
pub(crate) mod routine;
pub(crate) mod series;
#[cfg(test)]
mod tests;

use crate::program::kernel::Kernel;
use crate::program::{Code, Library, Pair, Program, ScalarType};
use crate::sincos::interval::Interval;
use crate::words::words;
use choose::Candidates;
use dalembert_model::robot::{JointKind, Robot};
use proof::Errors;
use reach::OutOfReach;

words! {
    /// The way in which emitted code gets sines and cosines.
    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    #[non_exhaustive]
    pub enum SinCos: "source of sines" {
        /// By polynomials where a scene's tolerance admits them, else from the
        /// library of the way in.
        #[default]
        Auto = "auto",
        /// All angles of a function together, by `dalembert-sines`: good for every
        /// angle, and vectors of them at a time up to 8192 rad (f32: 100).
        Together = "together",
        /// From libm, good for every angle.
        Libm = "libm",
        /// By polynomials over the joints' ranges. The code needs no libm then,
        /// and is wrong outside the ranges that its documentation names.
        Polynomial = "polynomial",
    }
}

impl SinCos {
    /// The error of polynomials for which none is given, where it can be had.
    pub const ERROR: f64 = 1e-6;

    /// Returns the library whose sines are called, if any are.
    pub fn library(self) -> Library {
        match self {
            SinCos::Together => Library::Together,
            SinCos::Auto | SinCos::Libm | SinCos::Polynomial => Library::Libm,
        }
    }
}

/// The code of one angle's sine and cosine, and what was proved of it.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleKernel {
    pub joint: usize,
    /// The range in which the errors hold, for every float of the scalar.
    pub range: Interval,
    pub form: String,
    pub kernel: Kernel,
    pub errors: Errors,
}

/// The code of a program's angles, one each, in the order of
/// [`Program::trig`]; none if they are a library's.
pub(crate) type Sines = Vec<AngleKernel>;

/// Returns the largest |q| for which the polynomials of a joint without limits hold.
pub fn stated(scalar: ScalarType) -> f64 {
    scalar.of(1e6, 1e3)
}

/// The limits, or what is [`stated`] where there are none. Joints that slide have no angle.
pub(crate) fn positions(robot: &Robot, scalar: ScalarType) -> Vec<Interval> {
    let ranges = robot.joints.iter().map(|joint| {
        let range = match (&joint.limits.position, joint.kind) {
            (Some([low, high]), JointKind::Revolute) => Interval::new(low.to_f64(), high.to_f64()),
            _ => None,
        };
        range.unwrap_or(Interval::symmetric(stated(scalar)))
    });
    ranges.collect()
}

pub(crate) fn range_of(joint: usize, positions: &[Interval]) -> Interval {
    positions.get(joint).copied().unwrap_or(Interval::ALL)
}

pub(crate) fn polynomials(
    program: &Program,
    scalar: ScalarType,
    positions: &[Interval],
    error: f64,
) -> Result<Sines, OutOfReach> {
    let mut sines: Sines = Vec::new();
    for trig in &program.trig() {
        let range = range_of(trig.joint, positions);
        let is_same = |sine: &&AngleKernel| sine.range == range && sine.kernel.need == trig.need;
        let kernel = match sines.iter().find(is_same) {
            Some(known) => AngleKernel {
                joint: trig.joint,
                ..known.clone()
            },
            None => one(trig, scalar, range, error)?,
        };
        sines.push(kernel);
    }
    Ok(sines)
}

fn one(
    trig: &Pair,
    scalar: ScalarType,
    range: Interval,
    error: f64,
) -> Result<AngleKernel, OutOfReach> {
    let best = Candidates::new(trig.need, scalar, range).cheapest(error);
    let worst = best.as_ref().map(|choice| choice.errors.worst());
    let least = worst.unwrap_or(f64::INFINITY);
    match best {
        Some(choice) if least <= error => Ok(AngleKernel {
            joint: trig.joint,
            range,
            form: choice.form.to_string(),
            kernel: choice.kernel,
            errors: choice.errors,
        }),
        _ => Err(OutOfReach {
            scalar,
            joint: trig.joint,
            need: trig.need,
            range,
            wanted: error,
            least,
        }),
    }
}

impl Program {
    /// Returns the program in a scalar with these polynomials; other angles are the library's.
    pub fn code(&self, scalar: ScalarType, library: Library, sines: &[AngleKernel]) -> Code {
        Code::new(self, scalar, library, |joint| {
            let sine = sines.iter().find(|sine| sine.joint == joint)?;
            Some(sine.kernel.clone())
        })
    }
}
