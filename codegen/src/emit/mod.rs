//! The module of a robot: header, documentation, functions.
//!
//! Takes a `Job` and its [`GeneratedFunction`]s; returns the text of a file in Rust, C or CUDA. A
//! function under a tolerance is printed from its `Variant`.

pub(crate) mod arguments;
mod c_sines;
mod escape;
pub(crate) mod header;
pub(crate) mod module;
mod parameters;
mod said;
mod state_box;
mod variant;

use crate::function::Function;
use crate::program::{Code, Counts, Library, Program, ScalarType};
use crate::search::Pass;
use crate::seeds::Source;
use crate::setup::ParametersKey;
use crate::sincos::{AngleKernel, Sines};
use crate::tolerance::variant::{Variant, VariantSet};
use crate::verify::accuracy::RefusedProgram;
use crate::verify::exact::Proof;

/// A generated and proved function.
#[derive(Clone, Debug)]
pub struct GeneratedFunction {
    /// The function.
    pub function: Function,
    /// The formulation that the search started from.
    pub source: Source,
    /// The robot's parameters that it takes as arguments, if it does.
    pub parameters: Option<ParametersKey>,
    /// `true` if it is the plan's, and nothing was searched for.
    pub planned: bool,
    /// The final program, with exact constants; [`GeneratedFunction::code`] rounds them.
    pub program: Program,
    /// The program before its operations were reordered or products fused: a plan keeps it.
    pub found: Option<Program>,
    /// The polynomials of its sines in each scalar, if they are not libm's.
    pub sines: Vec<(ScalarType, Sines)>,
    /// Counts of the formula as executed, then after each step.
    pub passes: Vec<Pass>,
    /// The proof of the exact program, from which a tolerance may have made another `program`.
    pub proof: Proof,
    /// A cheaper program that the limit on rounding errors refused, if it did.
    pub refused: Option<RefusedProgram>,
    /// With a tolerance: the variants that meet it.
    pub admitted: Option<VariantSet>,
}

impl GeneratedFunction {
    /// Returns the polynomials of its sines in a scalar; none if they are libm's.
    pub fn sines(&self, scalar: ScalarType) -> &[AngleKernel] {
        let entry = self.sines.iter().find(|(known, _)| *known == scalar);
        entry.map_or(&[], |(_, sines)| sines)
    }

    pub(crate) fn variant(&self, scalar: ScalarType) -> Option<&Variant> {
        let mut variants = self.admitted.as_ref()?.variants.iter();
        variants.find(|variant| variant.scalar == scalar)
    }

    /// Rounds the constants to a scalar; sines without polynomials are the library's.
    pub fn code(&self, scalar: ScalarType, library: Library) -> Code {
        self.program.code(scalar, library, self.sines(scalar))
    }

    /// Returns its counts, without the polynomials of sines.
    pub fn counts(&self) -> Counts {
        self.program.counts()
    }

    /// Returns its counts with the polynomials of its sines in a scalar.
    pub fn counts_in(&self, scalar: ScalarType) -> Counts {
        let kernels = self.sines(scalar).iter().map(|sine| &sine.kernel);
        self.counts().with_kernels(kernels)
    }
}

fn paragraph<const N: usize>(lines: [&str; N]) -> [String; N] {
    lines.map(String::from)
}
