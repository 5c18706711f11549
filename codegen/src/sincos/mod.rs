//! Sine and cosine by polynomials with proved errors, instead of a library.
//!
//! - this file: [`SinCos`], the choice; [`Sines`], the code of each angle
//! - [`proof`]: how far a kernel is from sine and cosine
//! - [`choose`]: the cheapest kernel of [`forms`] that is near enough
//! - [`series`]: Taylor's series and near-minimax fits
//! - [`reduction`]: whole turns taken off where the range is wider than one
//! - [`routine`]: the operations of the sines that emitted code calls by default
//! - [`poly`]: exact polynomials
//!
//! A robot's joints have limits, so most angles need none of what a library's
//! sine does for large ones; and a tolerance of 1e-6 needs no sixteen digits.

pub(crate) mod choose;
pub(crate) mod forms;
pub(crate) mod poly;
pub(crate) mod proof;
pub(crate) mod reduction;
pub(crate) mod routine;
pub(crate) mod series;
#[cfg(test)]
mod tests;

use std::fmt;

use crate::interval::Interval;
use crate::program::kernel::Kernel;
use crate::program::{Code, Library, Program, ScalarType, Trig};
use crate::words::Word;
use choose::Candidates;
use dalembert_model::robot::{JointKind, Robot};
use proof::Errors;

/// How emitted code gets sines and cosines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum SinCos {
    /// By polynomials where a scene's tolerance admits them, else from the
    /// library of the way in.
    #[default]
    Auto,
    /// All angles of a function together, by `dalembert-sines`: good for every
    /// angle, and vectors of them at a time up to 8192 rad (f32: 100).
    Together,
    /// From libm, good for every angle.
    Libm,
    /// By polynomials over the joints' ranges. The code needs no libm then,
    /// and is wrong outside the ranges that its documentation names.
    Polynomial {
        /// The largest |computed − true| of each sine and cosine;
        /// [`SinCos::ERROR`] if nothing is said. A scene's tolerance says it
        /// by itself.
        error: Option<f64>,
    },
}

impl SinCos {
    /// The error of polynomials for which none is given.
    pub const ERROR: f64 = 1e-6;

    /// Returns its word.
    pub fn name(self) -> &'static str {
        match self {
            SinCos::Auto => "auto",
            SinCos::Libm => "libm",
            SinCos::Together => "together",
            SinCos::Polynomial { .. } => "polynomial",
        }
    }

    /// Returns the library of what is called, where `auto` is this one.
    pub fn library(self, auto: Library) -> Library {
        match self {
            SinCos::Auto => auto,
            SinCos::Together => Library::Together,
            // Polynomials call nothing.
            SinCos::Libm | SinCos::Polynomial { .. } => Library::Libm,
        }
    }
}

/// The error of polynomials is left open.
impl Word for SinCos {
    const WHAT: &'static str = "source of sines";

    fn all() -> Vec<(&'static str, SinCos)> {
        vec![
            ("auto", SinCos::Auto),
            ("together", SinCos::Together),
            ("libm", SinCos::Libm),
            ("polynomial", SinCos::Polynomial { error: None }),
        ]
    }
}

/// The code of one angle's sine and cosine, and what was proved of it.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleKernel {
    /// The joint whose angle it is.
    pub joint: usize,
    /// Where the errors hold: every float of the scalar in it.
    pub range: Interval,
    /// What kind of polynomials, in words.
    pub form: String,
    /// The code.
    pub kernel: Kernel,
    /// The proved errors.
    pub errors: Errors,
}

/// The code of a program's angles, one each, in the order of
/// [`Program::trig`]; none if they are a library's.
pub type Sines = Vec<AngleKernel>;

/// A wanted error that no polynomial reaches.
#[derive(Clone, Debug, PartialEq)]
pub struct TooAccurate {
    /// The joint.
    pub joint: usize,
    /// Its range.
    pub range: Interval,
    /// The scalar.
    pub scalar: ScalarType,
    /// What was wanted.
    pub wanted: f64,
    /// The least error that was proved; infinite if none was.
    pub least: f64,
}

impl fmt::Display for TooAccurate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let angle = format!("q{}", self.joint + 1);
        let (low, high) = (self.range.low(), self.range.high());
        let (scalar, wanted) = (self.scalar, self.wanted);
        if wanted.is_nan() || wanted <= 0.0 {
            return write!(
                f,
                "the error of a sine must be above zero, not {wanted:e}: write 1e-9, or take libm"
            );
        }
        if self.least.is_infinite() {
            return write!(
                f,
                "no polynomial in {scalar} is known for {angle} in [{low:?}, {high:?}]: \
                 narrow the joints' limits of position, or take libm"
            );
        }
        let wanted = format!("{wanted:.2e}").replace(".00e", "e");
        write!(
            f,
            "no polynomial in {scalar} is proved to give the sines of {angle} in \
             [{low:?}, {high:?}] to {wanted}, at best to {:.2e}: ask for that, \
             for a wider scalar, or for libm",
            self.least
        )
    }
}

impl std::error::Error for TooAccurate {}

/// Returns the largest |q| for which the polynomials of a joint without limits hold.
pub fn stated(scalar: ScalarType) -> f64 {
    match scalar {
        ScalarType::F64 => 1e6,
        ScalarType::F32 => 1e3,
    }
}

/// Returns the positions of a robot's joints: their limits, or what is
/// [`stated`] where there are none. Joints that slide have no angle.
pub(crate) fn positions(robot: &Robot, scalar: ScalarType) -> Vec<Interval> {
    let joints = robot.joints.iter();
    let ranges = joints.map(|joint| match (&joint.limits.position, joint.kind) {
        (Some([low, high]), JointKind::Revolute) => Interval::new(low.to_f64(), high.to_f64()),
        _ => None,
    });
    ranges
        .map(|range| range.unwrap_or(Interval::symmetric(stated(scalar))))
        .collect()
}

/// Returns the positions that a joint takes.
pub(crate) fn range_of(joint: usize, positions: &[Interval]) -> Interval {
    positions.get(joint).copied().unwrap_or(Interval::ALL)
}

/// Returns the cheapest polynomials for a program whose every sine and cosine errs
/// by no more than `error`, proved. `positions` are the joints' ranges.
///
/// # Errors
/// The first angle for which there are none.
pub(crate) fn polynomials(
    program: &Program,
    scalar: ScalarType,
    positions: &[Interval],
    error: f64,
) -> Result<Sines, TooAccurate> {
    let mut sines: Sines = Vec::new();
    for trig in &program.trig() {
        let range = range_of(trig.joint, positions);
        // Joints with the same limits share the search.
        let known = sines.iter().find(|known| {
            known.range == range && known.kernel.need == trig.need && known.errors.worst() <= error
        });
        let kernel = match known {
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
    trig: &Trig,
    scalar: ScalarType,
    range: Interval,
    error: f64,
) -> Result<AngleKernel, TooAccurate> {
    let best = match error > 0.0 {
        true => Candidates::new(trig.need, scalar, range).cheapest(error),
        false => None,
    };
    match best {
        Some(choice) if choice.errors.worst() <= error => Ok(AngleKernel {
            joint: trig.joint,
            range,
            form: choice.form.to_string(),
            kernel: choice.kernel,
            errors: choice.errors,
        }),
        best => Err(TooAccurate {
            joint: trig.joint,
            range,
            scalar,
            wanted: error,
            least: best.map_or(f64::INFINITY, |choice| choice.errors.worst()),
        }),
    }
}

/// Returns the polynomials of one scalar; none if its sines are a library's.
pub(crate) fn of(all: &[(ScalarType, Sines)], scalar: ScalarType) -> &[AngleKernel] {
    let found = all.iter().find(|(known, _)| *known == scalar);
    found.map_or(&[], |(_, sines)| sines)
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
