//! How far the sines of `dalembert-sines` are from the true ones: proved from that
//! crate's own text.
//!
//! Its formulas are generic over numbers, so they are recorded here, operation by
//! operation with the literals that they have (`trace`): what is bounded is what
//! runs, and who changes it changes the bound. For angles up to its `LARGEST`,
//!
//! - `reduction`: x = k·π/2 + r − ℓ + ε, with bounds of |r|, |ℓ| and |ε|
//! - `rest`: sine and cosine computed from r and ℓ, against those of r − ℓ
//!
//! and a sine moves no more than its angle. Of which of the two a result is, and of
//! which sign, two bits of k say: exchanging and negating rounds nothing. So a result
//! errs by no more than the worse of both; and one that is small is a sine of a small r,
//! whose error is smaller.

mod reduction;
mod rest;
#[cfg(test)]
mod tests;
pub(crate) mod trace;

use std::sync::OnceLock;

use dalembert_sines::text::Rounded;

use crate::program::ScalarType;
use crate::program::kernel::Kernel;

/// Where |r| is below this, cosines are above [`SINE_ALONE`].
const WIDEST: f64 = 0.79;

/// What is smaller is computed as the sine of what is left of the angle.
const SINE_ALONE: f64 = 0.7;

/// Bounds the error of sines and cosines with fused products, in unit roundoffs: it is proved, and
/// below that of rounded products at every size (`tests`), so certificates for those hold here.
pub(crate) const FUSED_ERROR: f64 = 0.83;

/// Parts of the range of r with a bound each: as wide as each other, then narrower
/// towards zero, so many for each half.
const CELLS: usize = 96;
const HALVINGS: usize = 16;
const EACH: usize = 4;

/// Proved bounds of |computed − true|.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Called {
    /// Of sines where |r| is up to this: the worst so far.
    sines: Vec<(f64, f64)>,
    /// Of cosines.
    cosine: f64,
    /// How much larger |r| can be than the angle that it stands for.
    beyond: f64,
}

impl Called {
    /// Returns the errors of a scalar, found once; `None` if the text is not what can be bounded.
    pub(crate) fn of(scalar: ScalarType) -> Option<&'static Called> {
        static FOUND: [OnceLock<Option<Called>>; 2] = [OnceLock::new(), OnceLock::new()];
        let place = match scalar {
            ScalarType::F64 => 0,
            ScalarType::F32 => 1,
        };
        FOUND[place]
            .get_or_init(|| Called::prove_of(&trace::trace::<Rounded>(scalar), scalar))
            .as_ref()
    }

    /// Up to this magnitude angles are computed by what is proved.
    pub(crate) fn largest(scalar: ScalarType) -> f64 {
        match scalar {
            ScalarType::F64 => dalembert_sines::LARGEST,
            ScalarType::F32 => dalembert_sines::LARGEST_F32.into(),
        }
    }

    fn prove_of(kernel: &Kernel, scalar: ScalarType) -> Option<Called> {
        let (parts, left) = reduction::split(kernel, scalar)?;
        let reduced = reduction::bound(&parts, scalar, Called::largest(scalar))?;
        if reduced.rest.is_nan() || reduced.rest > WIDEST {
            return None;
        }
        let narrow = (1..=HALVINGS * EACH).rev();
        let narrow = narrow.map(|k| libm::exp2(-(k as f64) / EACH as f64) / CELLS as f64);
        let wide = (1..=CELLS).map(|k| k as f64 / CELLS as f64);
        let (mut sines, mut worst) = (Vec::new(), rest::Errors::default());
        let mut from = 0.0;
        for part in narrow.chain(wide) {
            let to = reduced.rest * part;
            let here = rest::bound(&left, scalar, [from, to], reduced.lacks)?;
            worst.sin = worst.sin.max((here.sin + reduced.error).next_up());
            worst.cos = worst.cos.max((here.cos + reduced.error).next_up());
            sines.push((to, worst.sin));
            from = to;
        }
        worst.worst().is_finite().then_some(Called {
            sines,
            cosine: worst.cos,
            beyond: (reduced.lacks + reduced.error).next_up(),
        })
    }

    /// Bounds the error of a sine or cosine that is at most so large.
    pub(crate) fn error(&self, size: f64) -> f64 {
        let last = self.sines.last().map_or(f64::INFINITY, |(_, error)| *error);
        if size.is_nan() || size > SINE_ALONE {
            return last.max(self.cosine);
        }
        // libm's inverse sine is within an ulp or two.
        let reach = libm::asin(size) * (1.0 + 1e-12) + 2.0 * self.beyond;
        let mut enough = self.sines.iter().filter(|(to, _)| reach <= *to);
        enough.next().map_or(last, |(_, error)| *error)
    }
}
