//! What accuracy costs: variants of one function for several tolerances, each
//! certified and run at states that try to refute it.
//!
//! - this file: a variant, and which variants another one beats
//! - [`ladder`]: the variants, tolerance by tolerance

pub mod ladder;

use dalembert_codegen::workspace::{Certificate, sincos_counts};
use dalembert_codegen::{Counts, ScalarType};

/// One variant.
pub struct Point {
    /// Zero for the exact program.
    pub tolerance: f64,
    /// The claim about it.
    pub certificate: Certificate,
    /// The largest E of an output.
    pub certified: f64,
    /// The largest error that was seen, if it was run at any state.
    pub observed: Option<f64>,
    /// The error of operations and sines by themselves, in the same measure: the code
    /// against its own program in double precision. Nothing in double.
    pub rounding: f64,
    /// The largest such error that was seen.
    pub rounding_observed: Option<f64>,
    /// True if another one is neither dearer nor worse.
    pub dominated: bool,
    /// An error above E, in words: never, unless this program is wrong.
    pub violation: Option<String>,
}

impl Point {
    /// Returns a variant that was not run yet.
    pub fn new(tolerance: f64, certificate: Certificate) -> Point {
        let largest = |certificate: &Certificate| {
            let totals = certificate.bounds.iter().map(|bound| bound.total());
            totals.fold(0.0, f64::max)
        };
        Point {
            tolerance,
            certified: largest(&certificate),
            observed: None,
            rounding: largest(&certificate.of_rounding()),
            rounding_observed: None,
            certificate,
            dominated: false,
            violation: None,
        }
    }

    /// Returns where its certificate goes.
    pub fn file(&self) -> String {
        let Certificate { scalar, sines, .. } = &self.certificate;
        let by = if sines.is_empty() { "" } else { "-polynomials" };
        format!("{:e}-{scalar}{by}.json", self.tolerance)
    }

    /// Returns which kind of variant it is: scalar and sines.
    pub fn kind(&self) -> usize {
        let polynomials = !self.certificate.sines.is_empty();
        2 * usize::from(polynomials)
            + match self.certificate.scalar {
                ScalarType::F64 => 0,
                ScalarType::F32 => 1,
            }
    }

    /// Returns what it costs, with the operations of its sines.
    pub fn counts(&self) -> Counts {
        let (trig_mul, trig_add) = sincos_counts(&self.certificate.sines);
        Counts {
            trig_mul,
            trig_add,
            ..self.certificate.emitted.counts()
        }
    }

    /// Returns how many values were replaced.
    pub fn edits(&self) -> usize {
        let stages = self.certificate.stages.iter();
        stages.map(|stage| stage.edits.len()).sum()
    }

    /// Returns what it costs, dimension by dimension: a narrower scalar is one too.
    fn cost(&self) -> [usize; 3] {
        let counts = self.counts();
        let bits = match self.certificate.scalar {
            ScalarType::F64 => 64,
            ScalarType::F32 => 32,
        };
        // Polynomials are operations like others; what libm does is not known.
        match self.certificate.sines.is_empty() {
            true => [bits, counts.sincos, counts.operations()],
            false => [
                bits,
                0,
                counts.operations() + counts.trig_mul + counts.trig_add,
            ],
        }
    }
}

/// Marks what is dominated: another point is no dearer, no worse, and not the
/// same; of equal points the first stays.
pub fn mark(points: &mut [Point]) {
    let all: Vec<([usize; 3], f64)> = points.iter().map(|p| (p.cost(), p.certified)).collect();
    for (index, point) in points.iter_mut().enumerate() {
        let (mine, error) = all[index];
        point.dominated = all.iter().enumerate().any(|(other, &(theirs, e))| {
            let no_worse = theirs.iter().zip(&mine).all(|(a, b)| a <= b) && e <= error;
            let same = theirs == mine && e == error;
            no_worse && (!same || other < index)
        });
    }
}
