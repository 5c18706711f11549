//! The cost of accuracy: variants of one function for several tolerances, each with its bounds and run at
//! states that try to refute it.
//!
//! From the smallest tolerance up: each search also starts from the program of the one before, which
//! its tolerance admits as well. So none is dearer than one before it. A search with other settings
//! may still find less for one tolerance alone.

use dalembert_codegen::workspace::{
    Budget, Fault, SearchEffort, Variant, VariantSet, attempt, each,
};
use dalembert_codegen::{Counts, Effort, GenerateError, ScalarType};

pub struct Point {
    /// Zero for the exact program.
    pub tolerance: f64,
    pub variant: Variant,
    /// The largest E of an output.
    pub bound: f64,
    /// The largest error that was seen, if it was run at any state.
    pub observed: Option<f64>,
    /// The part of rounding in the largest E.
    pub rounding: f64,
    /// True if another one is neither dearer nor worse.
    pub dominated: bool,
    /// An error above E, in words: never, unless this program is wrong.
    pub violation: Option<String>,
}

impl Point {
    pub fn name(&self) -> String {
        let Variant { scalar, sines, .. } = &self.variant;
        let by = if sines.is_empty() { "" } else { "-polynomials" };
        format!("{:e}-{scalar}{by}", self.tolerance)
    }

    /// Returns a number for the scalar and the source of sines.
    pub fn kind(&self) -> usize {
        let polynomials = !self.variant.sines.is_empty();
        let is_single = self.variant.scalar == ScalarType::F32;
        2 * usize::from(polynomials) + usize::from(is_single)
    }

    /// Counts its operations, those of its sines included.
    pub fn counts(&self) -> Counts {
        let kernels = self.variant.sines.iter().map(|sine| &sine.kernel);
        self.variant.emitted.counts().with_kernels(kernels)
    }

    pub fn cost(&self) -> usize {
        let counts = self.counts();
        let sines = match self.variant.sines.is_empty() {
            true => counts.sincos * called_sine_cost(self.variant.scalar),
            false => counts.trig_mul + counts.trig_add,
        };
        counts.operations() + sines
    }
}

/// Returns the operations that a called sine with its cosine counts as: those of libm 0.2.16 where
/// it subtracts multiples of π/2 once. Its sine, its cosine and the subtraction are 12 + 12 + 3
/// multiplications and 8 + 11 + 6 additions; in f32 8 + 7 + 3 and 4 + 4 + 4.
pub fn called_sine_cost(scalar: ScalarType) -> usize {
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
        let is_wide = point.variant.scalar == ScalarType::F64;
        ([usize::from(is_wide), point.cost()], point.bound)
    };
    let costs: Vec<([usize; 2], f64)> = points.iter().map(cost).collect();
    for (index, point) in points.iter_mut().enumerate() {
        let (mine, error) = costs[index];
        point.dominated = costs.iter().enumerate().any(|(other, &(theirs, e))| {
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
    budget: &'a Budget<'a>,
    effort: SearchEffort,
    exact: Vec<Variant>,
}

const CLIMBS: usize = 4;

impl<'a> Ladder<'a> {
    /// Makes a ladder for a function in its box; fails if no scalar's exact program has bounds.
    pub fn new(
        samples: usize,
        effort: Effort,
        budget: &'a Budget<'a>,
    ) -> Result<Ladder<'a>, GenerateError> {
        // Bounds are as tight as what is allowed asks for: a first one tells what that may be.
        let shown = |scalar: &ScalarType| {
            let rough = budget.unedited(&[*scalar], &budget.all_allowed(1.0))?;
            let bounds = rough.variants.iter().map(Variant::worst);
            let most = bounds.fold(0.0, f64::max);
            let fine = budget.unedited(&[*scalar], &budget.all_allowed(2.0 * most));
            Ok(fine.unwrap_or(rough).variants)
        };
        let variants: Vec<Result<Vec<Variant>, GenerateError>> =
            ScalarType::ALL.iter().map(shown).collect();
        if let Some(Err(why)) = variants.iter().rfind(|result| result.is_err())
            && variants.iter().all(Result::is_err)
        {
            return Err(why.clone());
        }
        Ok(Ladder {
            samples,
            budget,
            effort: SearchEffort::of(effort),
            exact: variants.into_iter().flatten().flatten().collect(),
        })
    }

    /// Returns the variants of all tolerances, which ascend; the exact program's first; `begin` hears the
    /// name of each step.
    pub fn climb(&self, tolerances: &[f64], begin: &dyn Fn(&str)) -> Result<Vec<Point>, Fault> {
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

    fn rung(
        &self,
        tolerance: f64,
        before: Option<&Point>,
        begin: &dyn Fn(&str),
    ) -> Result<Vec<Point>, Fault> {
        begin(&format!("tolerance {tolerance:e}"));
        let variants = match tolerance == 0.0 {
            true => self.exact.clone(),
            false => self.variants(tolerance, before),
        };
        begin(&format!("attempts to refute {tolerance:e}"));
        let points = each(&variants, |variant| self.point(tolerance, variant));
        points.into_iter().collect()
    }

    /// `before` is one that a smaller tolerance admits.
    fn variants(&self, tolerance: f64, before: Option<&Point>) -> Vec<Variant> {
        let budget = self.budget;
        let allowed = budget.all_allowed(tolerance);
        let mut able: Vec<&Variant> = self.exact.iter().collect();
        able.retain(|variant| variant.worst() <= tolerance);
        let mut bounds = able.iter().map(|variant| variant.worst());
        let alike = bounds.all(|bound| bound <= SHARE * tolerance);
        let groups: Vec<&[&Variant]> = match alike {
            true => vec![&able],
            false => able.chunks(1).collect(),
        };
        let program = before.map(|point| point.variant.emitted.clone());
        let from = Vec::from_iter(program.filter(|program| program != budget.exact));
        let mut variants = Vec::new();
        for group in groups.into_iter().filter(|group| !group.is_empty()) {
            let exact = VariantSet {
                exact: budget.exact.clone(),
                program: budget.exact.clone(),
                variants: group.iter().map(|variant| (*variant).clone()).collect(),
            };
            let watch = Default::default();
            let choice = budget
                .choose(&from, exact.clone(), &allowed, &self.effort, watch)
                .unwrap_or(exact);
            for variant in choice.variants {
                let candidate = budget.with_polynomials(&choice.program, &variant, &allowed);
                let polynomials = candidate.ok().filter(|other| !other.sines.is_empty());
                variants.push(variant);
                variants.extend(polynomials);
            }
        }
        variants
    }

    fn point(&self, tolerance: f64, variant: &Variant) -> Result<Point, Fault> {
        let climbs = if self.samples == 0 { 0 } else { CLIMBS };
        let attempt = attempt(self.budget.setup, variant, self.samples, climbs, 1)?;
        let largest = |errors: Vec<f64>| errors.into_iter().fold(0.0, f64::max);
        let violation = attempt.violation.map(|(index, state)| {
            format!(
                "{} errs by more than its E of {:e}, as at {state:?}",
                variant.emitted.entry(index),
                variant.bounds[index].total()
            )
        });
        let rounding = variant.bounds.iter().map(|bound| bound.rounding);
        Ok(Point {
            tolerance,
            bound: variant.worst(),
            rounding: rounding.fold(0.0, f64::max),
            variant: variant.clone(),
            observed: attempt.observed.map(largest),
            dominated: false,
            violation,
        })
    }
}
