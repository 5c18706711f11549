//! The cost of accuracy: variants of one function for several tolerances, each certified and run at
//! states that try to refute it.
//!
//! From the smallest tolerance up: each search also starts from the program of the one before, which
//! its tolerance admits as well. So none is dearer than one before it. A search with other settings
//! may still find less for one tolerance alone.

use dalembert_codegen::workspace::{
    Admitted, BoundEffort, Certificate, ErrorBudget, PruneSettings, TextError, bounded, each,
    falsify,
};
use dalembert_codegen::{Counts, Effort, Program, ScalarType};

/// One variant.
pub struct Point {
    /// Zero for the exact program.
    pub tolerance: f64,
    /// The claim about it.
    pub certificate: Certificate,
    /// The number of values that were left out.
    pub left_out: usize,
    /// The largest E of an output.
    pub certified: f64,
    /// The largest error that was seen, if it was run at any state.
    pub observed: Option<f64>,
    /// The bound of the error of operations and sines alone: of the code against its own program.
    pub rounding: f64,
    /// The largest such error that was seen; only code in f32 is run for it.
    pub rounding_observed: Option<f64>,
    /// True if another one is neither dearer nor worse.
    pub dominated: bool,
    /// An error above E, in words: never, unless this program is wrong.
    pub violation: Option<String>,
}

impl Point {
    /// Returns the name of its text.
    pub fn name(&self) -> String {
        let Certificate { scalar, sines, .. } = &self.certificate;
        let by = if sines.is_empty() { "" } else { "-polynomials" };
        format!("{:e}-{scalar}{by}", self.tolerance)
    }

    /// Returns which kind of variant it is: scalar and sines.
    pub fn kind(&self) -> usize {
        let polynomials = !self.certificate.sines.is_empty();
        let is_single = self.certificate.scalar == ScalarType::F32;
        2 * usize::from(polynomials) + usize::from(is_single)
    }

    /// Counts its operations, those of its sines included.
    pub fn counts(&self) -> Counts {
        let kernels = self.certificate.sines.iter().map(|own| &own.kernel);
        self.certificate.emitted.counts().with_kernels(kernels)
    }

    /// Returns its operations, those of its sines included.
    pub fn cost(&self) -> usize {
        let counts = self.counts();
        let sines = match self.certificate.sines.is_empty() {
            true => counts.sincos * called(self.certificate.scalar),
            false => counts.trig_mul + counts.trig_add,
        };
        counts.operations() + sines
    }
}

/// Returns the operations that a called sine with its cosine counts as: those of libm 0.2.16 where
/// it subtracts multiples of π/2 once. Its sine, its cosine and the subtraction are 12 + 12 + 3
/// multiplications and 8 + 11 + 6 additions; in f32 8 + 7 + 3 and 4 + 4 + 4.
pub fn called(scalar: ScalarType) -> usize {
    match scalar {
        ScalarType::F64 => 52,
        ScalarType::F32 => 30,
    }
}

/// Marks what is dominated: another point is no dearer, no worse, and not the
/// same; of equal points the first stays.
pub fn mark(points: &mut [Point]) {
    // A narrower scalar is less of a cost, too.
    let cost = |point: &Point| {
        let is_wide = point.certificate.scalar == ScalarType::F64;
        ([usize::from(is_wide), point.cost()], point.certified)
    };
    let all: Vec<([usize; 2], f64)> = points.iter().map(cost).collect();
    for (index, point) in points.iter_mut().enumerate() {
        let (mine, error) = all[index];
        point.dominated = all.iter().enumerate().any(|(other, &(theirs, e))| {
            let no_worse = theirs.iter().zip(&mine).all(|(a, b)| a <= b) && e <= error;
            let same = theirs == mine && e == error;
            no_worse && (!same || other < index)
        });
    }
}

/// A scalar may share the others' variant if rounding takes less than this
/// part of the tolerance.
const SHARE: f64 = 1.0 / 16.0;

/// The variants of one function, tolerance by tolerance.
pub struct Ladder<'a> {
    samples: usize,
    frame: &'a ErrorBudget<'a>,
    settings: PruneSettings,
    exact: Admitted,
}

const CLIMBS: usize = 4;

impl<'a> Ladder<'a> {
    /// Makes a ladder for a function in its box.
    pub fn new(samples: usize, effort: Effort, frame: &'a ErrorBudget<'a>) -> Ladder<'a> {
        Ladder {
            samples,
            frame,
            settings: PruneSettings::of(effort),
            exact: frame.unedited(&ScalarType::ALL, BoundEffort::CERTIFY),
        }
    }

    /// Returns the variants of all tolerances, which ascend; the exact program's first; `begin` hears the
    /// name of each step.
    ///
    /// # Errors
    /// A variant cannot be run.
    pub fn climb(&self, tolerances: &[f64], begin: &dyn Fn(&str)) -> Result<Vec<Point>, TextError> {
        let mut points: Vec<Point> = Vec::new();
        for tolerance in tolerances.iter().copied().chain([0.0]) {
            points.extend(self.rung(tolerance, points.last(), begin)?);
        }
        points.sort_by(|a, b| {
            let order = a.tolerance.total_cmp(&b.tolerance);
            order.then(a.kind().cmp(&b.kind()))
        });
        Ok(points)
    }

    fn polynomials(&self, tolerance: f64, certificate: &Certificate) -> Option<Certificate> {
        let tolerances = vec![tolerance; self.frame.scales.len()];
        let frame = self.frame;
        let found = frame.with_polynomials(certificate, &tolerances, BoundEffort::CERTIFY);
        found.ok().filter(|found| !found.sines.is_empty())
    }

    fn rung(
        &self,
        tolerance: f64,
        before: Option<&Point>,
        begin: &dyn Fn(&str),
    ) -> Result<Vec<Point>, TextError> {
        begin(&format!("tolerance {tolerance:e}"));
        let exact = tolerance == 0.0;
        let variants = match exact {
            true => vec![self.exact.clone()],
            false => self.variants(tolerance, before),
        };
        begin(&format!("attempts to refute {tolerance:e}"));
        let mut certificates = Vec::new();
        for variant in variants {
            let left_out = variant.left_out.len();
            for certificate in variant.certificates {
                let polynomials = match exact {
                    true => None,
                    false => self.polynomials(tolerance, &certificate),
                };
                let both = [Some(certificate), polynomials].into_iter().flatten();
                certificates.extend(both.map(|own| (left_out, own)));
            }
        }
        let samples = self.samples;
        // Of what the checker does not show there is no point.
        let points = each(&certificates, |(left_out, own)| {
            // Of the exact program the checker bounds rounding as finely as the search did.
            let most = if exact { 16.0 * worst(own) } else { tolerance };
            let shown = bounded(self.frame.setup, own, Some(most)).ok()?;
            Some(point(samples, tolerance, *left_out, own, shown))
        });
        points.into_iter().flatten().collect()
    }

    /// `before` is one that a smaller tolerance admits.
    fn variants(&self, tolerance: f64, before: Option<&Point>) -> Vec<Admitted> {
        let tolerances = vec![tolerance; self.frame.scales.len()];
        let able = self.exact.certificates.iter();
        let able: Vec<_> = able.filter(|c| worst(c) <= tolerance).collect();
        let alike = able.iter().all(|c| worst(c) <= SHARE * tolerance);
        let groups: Vec<Vec<ScalarType>> = match alike {
            true => vec![able.iter().map(|c| c.scalar).collect()],
            false => able.iter().map(|c| vec![c.scalar]).collect(),
        };
        let groups = groups.into_iter().filter(|scalars| !scalars.is_empty());
        let from = before.map(|point| point.certificate.emitted.clone());
        let from = from.filter(|program| program != self.frame.exact);
        let from: Vec<Program> = from.into_iter().collect();
        groups
            .map(|scalars| {
                let (frame, settings, effort) = (self.frame, &self.settings, BoundEffort::CERTIFY);
                let found = frame.choose(&from, &tolerances, &scalars, settings, effort);
                found.unwrap_or_else(|_| {
                    let mut exact = self.exact.clone();
                    exact.certificates.retain(|c| scalars.contains(&c.scalar));
                    exact
                })
            })
            .collect()
    }
}

fn point(
    samples: usize,
    tolerance: f64,
    left_out: usize,
    found: &Certificate,
    certificate: Certificate,
) -> Result<Point, TextError> {
    let (observed, mut violation) = falsified(samples, &certificate)?;
    let rounding = found.of_rounding();
    let mut rounding_observed = None;
    if certificate.scalar == ScalarType::F32 {
        let (observed, other) = falsified(samples, &rounding)?;
        rounding_observed = observed;
        violation = violation.or(other);
    }
    Ok(Point {
        tolerance,
        left_out,
        certified: worst(&certificate),
        certificate,
        observed,
        rounding: worst(&rounding),
        rounding_observed,
        dominated: false,
        violation,
    })
}

fn falsified(
    samples: usize,
    certificate: &Certificate,
) -> Result<(Option<f64>, Option<String>), TextError> {
    let falsification = falsify(certificate, samples, CLIMBS, 1)?;
    let largest = || falsification.observed.iter().copied().fold(0.0, f64::max);
    let observed = (falsification.states > 0).then(largest);
    let violation = falsification.violation.map(|(index, state)| {
        format!(
            "{} errs up to {:e}, which is more than its E of {:e}, as at {state:?}",
            certificate.emitted.entry(index),
            falsification.observed[index],
            certificate.bounds[index].total()
        )
    });
    Ok((observed, violation))
}

fn worst(certificate: &Certificate) -> f64 {
    let totals = certificate.bounds.iter().map(|bound| bound.total());
    totals.fold(0.0, f64::max)
}
