//! Why a tolerance is not met, or polynomials are not to be had.

use std::fmt;

use crate::bound::definite::Indefinite;
use crate::bound::input_box::MissingLimit;
use crate::bound::ranges::Overflow;
use crate::bound::scale;
use crate::function::{Argument, Columns, Function};
use crate::program::{Program, ScalarType};
use crate::split::ErrorByCause;

/// Why no variant meets a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub enum ToleranceError {
    /// Errors of such a function have no bound.
    Function(Unbounded),
    /// A limit that a bound needs.
    Missing(MissingLimit),
    /// The actuators are no measure of its outputs.
    Scale(scale::NoScale),
    /// The full model's D cannot be shown to be positive definite.
    Indefinite(Indefinite),
    /// What is computed inside the box may be more than the scalar holds.
    Overflow {
        /// In which scalar.
        scalar: ScalarType,
        /// The first step that may.
        first: Overflow,
    },
    /// It would take more work than may be done.
    Work {
        /// Units of work that were allowed.
        limit: u64,
        /// The scene's name.
        scene: String,
    },
    /// Already what sines and rounding cost cannot be shown to be less.
    Above {
        /// The output's name.
        entry: String,
        /// In which scalar.
        scalar: ScalarType,
        /// The output's tolerance.
        tolerance: f64,
        /// What can be shown of the exact program.
        bound: ErrorByCause,
    },
}

/// Why errors of a function have no bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unbounded {
    /// It reads an argument that no box bounds.
    Reads(Argument),
    /// Its program divides.
    Divides,
    /// It has Coulomb friction in it.
    Friction,
    /// It is a regressor: what multiplies its entries is not known.
    Parameters,
    /// Joints of the robot follow others.
    Follows,
}

impl Unbounded {
    /// Returns what a function is, whatever its program.
    pub fn of(function: Function) -> Option<Unbounded> {
        let mut arguments = function.arguments().into_iter();
        let other = arguments.find(|argument| !Argument::STATE.contains(argument));
        if function.columns() != Columns::None {
            return Some(Unbounded::Parameters);
        }
        match function.inverts_inertia() {
            true => Some(Unbounded::Divides),
            false => other.map(Unbounded::Reads),
        }
    }

    pub(super) fn find(program: &Program) -> Option<Unbounded> {
        let divides = program.divides().then_some(Unbounded::Divides);
        let rubs = !program.speeds.is_empty();
        let rubs = rubs.then_some(Unbounded::Friction);
        divides.or(rubs).or_else(|| Unbounded::of(program.function))
    }
}

impl fmt::Display for Unbounded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unbounded::Friction => {
                return f.write_str(
                    "it has Coulomb friction in it, which divides by a root, so its errors have \
                     no certified bound: leave `coulomb` out of the robot file and add the friction \
                     to the torques yourself, or leave the tolerance out of the scene",
                );
            }
            Unbounded::Follows => {
                return f.write_str(
                    "joints of the robot follow others (`mimic`), and what may be left out of \
                     links that share a coordinate is not bounded: leave the tolerance out of the \
                     scene",
                );
            }
            Unbounded::Divides => f.write_str("it divides by what depends on the state")?,
            Unbounded::Parameters => f.write_str("its entries multiply parameters of any size")?,
            Unbounded::Reads(argument) => {
                write!(f, "no box bounds its argument `{}`", argument.name())?;
            }
        }
        f.write_str(
            ", so its errors have no certified bound; what has one is what it is made of: give \
             the tolerance to `inverse_dynamics`, or to `manipulator_equation` for D, h and c",
        )
    }
}

impl fmt::Display for ToleranceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ToleranceError::Function(why) => why.fmt(f),
            ToleranceError::Missing(missing) => missing.fmt(f),
            ToleranceError::Scale(why) => why.fmt(f),
            ToleranceError::Overflow { scalar, first } => write!(
                f,
                "inside the box {first} in {scalar}, and no error is certified of what overflows: \
                 bound the box, choose other units{}",
                wider(*scalar)
            ),
            ToleranceError::Work { limit, scene } => write!(
                f,
                "the search for a program within the tolerance was stopped: it takes too long for a \
                 compilation (more than {limit} units of work). Run `dalembert generate ROBOT.toml \
                 --scene {scene} --effort thorough --save-plan` once: macro and build script then take the \
                 program from its plan"
            ),
            ToleranceError::Indefinite(why) => {
                write!(f, "the full model: {why}")?;
                match why {
                    Indefinite::Negative { .. } => f.write_str(
                        ", so a link that they move has an inertia that no body has: correct its \
                         `inertia`, `mass` or `com`",
                    ),
                    _ => Ok(()),
                }
            }
            ToleranceError::Above {
                entry,
                scalar,
                tolerance,
                bound,
            } => write!(
                f,
                "no variant in {scalar} can be certified to keep {entry} within {tolerance:.1e}: with nothing \
                 left out, the bound is {:.1e} for rounding and {:.1e} for sines and cosines; \
                 allow more{}",
                bound.rounding,
                bound.sincos,
                wider(*scalar)
            ),
        }
    }
}

fn wider(scalar: ScalarType) -> &'static str {
    match scalar {
        ScalarType::F32 => ", or choose a wider scalar",
        ScalarType::F64 => "",
    }
}

impl std::error::Error for ToleranceError {}
