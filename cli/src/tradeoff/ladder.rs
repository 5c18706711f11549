//! The variants, tolerance by tolerance.
//!
//! From the largest tolerance down: where nothing more can be left out, less
//! tolerance leaves out nothing either, and no search is needed.

use dalembert_codegen::certify::attack::attack;
use dalembert_codegen::certify::certificate::Certificate;
use dalembert_codegen::certify::certificate::subject::Fineness;
use dalembert_codegen::certify::choose::{Admitted, Frame};
use dalembert_codegen::certify::prune::Settings;
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::graph::Counts;
use dalembert_codegen::sincos;

use crate::args::TradeoffArgs;
use crate::outcome::Failure;
use crate::progress::Steps;

/// One variant.
pub struct Point {
    /// Zero for the exact program.
    pub tolerance: f64,
    pub certificate: Certificate,
    /// The largest E of an output, and the largest error that was seen if it
    /// was run at any state.
    pub certified: f64,
    pub observed: Option<f64>,
    /// What operations and sines cost by themselves, the same way: the code
    /// against its own program in double precision. Nothing in double.
    pub rounding: f64,
    pub rounding_observed: Option<f64>,
    /// Time of a call, and as a ratio to the exact f64 variant's.
    pub time: Option<Time>,
    /// Whether another one is neither dearer nor worse.
    pub dominated: bool,
    /// An error above E, in words: never, unless this program is wrong.
    pub violation: Option<String>,
}

/// How long a call takes.
#[derive(Clone, Copy)]
pub struct Time {
    pub nanoseconds: f64,
    pub ratio: f64,
}

impl Point {
    /// Where its certificate goes.
    pub fn file(&self) -> String {
        let Certificate { scalar, sines, .. } = &self.certificate;
        let by = if sines.is_empty() { "" } else { "-polynomials" };
        format!("{:e}-{scalar}{by}.json", self.tolerance)
    }

    /// Which kind of variant it is: scalar and sines.
    pub fn kind(&self) -> usize {
        let polynomials = !self.certificate.sines.is_empty();
        2 * usize::from(polynomials)
            + match self.certificate.scalar {
                ScalarType::F64 => 0,
                ScalarType::F32 => 1,
            }
    }

    /// What it costs, with the operations of its sines.
    pub fn counts(&self) -> Counts {
        let (trig_mul, trig_add) = sincos::counts(&self.certificate.sines);
        Counts {
            trig_mul,
            trig_add,
            ..self.certificate.emitted.counts()
        }
    }

    /// How many values were replaced.
    pub fn edits(&self) -> usize {
        let stages = self.certificate.stages.iter();
        stages.map(|stage| stage.edits.len()).sum()
    }
}

/// A scalar may share the others' variant if rounding takes less than this
/// part of the tolerance.
const SHARE: f64 = 1.0 / 16.0;

pub struct Ladder<'a> {
    args: &'a TradeoffArgs,
    frame: &'a Frame<'a>,
    steps: &'a Steps,
    settings: Settings,
    /// The exact program in every scalar.
    exact: Admitted,
}

impl<'a> Ladder<'a> {
    pub fn new(args: &'a TradeoffArgs, frame: &'a Frame<'a>, steps: &'a Steps) -> Ladder<'a> {
        steps.begin("exact");
        Ladder {
            args,
            frame,
            steps,
            settings: Settings::of(args.effort),
            exact: frame.unedited(&ScalarType::ALL, Fineness::CERTIFY),
        }
    }

    /// The points of all tolerances, which ascend; the exact program's first.
    pub fn climb(&self, tolerances: &[f64]) -> Result<Vec<Point>, Failure> {
        let mut rungs = Vec::new();
        let mut fruitful = true;
        for &tolerance in tolerances.iter().rev() {
            self.steps.begin(&format!("tolerance {tolerance:e}"));
            let variants = self.variants(tolerance, fruitful);
            fruitful = variants.iter().any(|variant| !variant.stages.is_empty());
            rungs.push((tolerance, variants));
        }
        rungs.push((0.0, vec![self.exact.clone()]));
        rungs.reverse();
        let mut points = Vec::new();
        for (tolerance, variants) in rungs {
            let tolerances = vec![tolerance; self.frame.scales.len()];
            self.steps
                .begin(&format!("attempts to refute {tolerance:e}"));
            for certificate in variants.into_iter().flat_map(|v| v.certificates) {
                let polynomials = (tolerance > 0.0).then(|| {
                    self.frame
                        .with_polynomials(&certificate, &tolerances, Fineness::CERTIFY)
                });
                points.push(self.point(tolerance, certificate)?);
                let found = polynomials.and_then(Result::ok);
                if let Some(certificate) = found.filter(|found| !found.sines.is_empty()) {
                    points.push(self.point(tolerance, certificate)?);
                }
            }
        }
        points.sort_by(|a, b| {
            let order = a.tolerance.total_cmp(&b.tolerance);
            order.then(a.kind().cmp(&b.kind()))
        });
        Ok(points)
    }

    /// The cheapest variants that a tolerance admits, in each scalar that can
    /// be that exact at all.
    fn variants(&self, tolerance: f64, fruitful: bool) -> Vec<Admitted> {
        let tolerances = vec![tolerance; self.frame.scales.len()];
        let worst = |certificate: &Certificate| {
            let totals = certificate.bounds.iter().map(|bound| bound.total());
            totals.fold(0.0, f64::max)
        };
        let able = self.exact.certificates.iter();
        let able: Vec<_> = able.filter(|c| worst(c) <= tolerance).collect();
        let alike = able.iter().all(|c| worst(c) <= SHARE * tolerance);
        let groups: Vec<Vec<ScalarType>> = match alike {
            true => vec![able.iter().map(|c| c.scalar).collect()],
            false => able.iter().map(|c| vec![c.scalar]).collect(),
        };
        let groups = groups.into_iter().filter(|scalars| !scalars.is_empty());
        groups
            .map(|scalars| {
                let found = fruitful.then(|| {
                    self.frame
                        .choose(&tolerances, &scalars, &self.settings, Fineness::CERTIFY)
                });
                match found {
                    Some(Ok(found)) => found,
                    _ => self.exact_in(&scalars),
                }
            })
            .collect()
    }

    fn exact_in(&self, scalars: &[ScalarType]) -> Admitted {
        let mut exact = self.exact.clone();
        exact.certificates.retain(|c| scalars.contains(&c.scalar));
        exact
    }

    fn point(&self, tolerance: f64, certificate: Certificate) -> Result<Point, Failure> {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let (observed, mut violation) = self.attacked(&certificate)?;
        let own = certificate.of_rounding();
        let mut rounding_observed = None;
        if certificate.scalar == ScalarType::F32 {
            let (observed, other) = self.attacked(&own)?;
            rounding_observed = observed;
            violation = violation.or(other);
        }
        Ok(Point {
            tolerance,
            certified: largest(&mut certificate.bounds.iter().map(|b| b.total())),
            observed,
            rounding: largest(&mut own.bounds.iter().map(|b| b.total())),
            rounding_observed,
            certificate,
            time: None,
            dominated: false,
            violation,
        })
    }

    /// The largest error that is seen, and one above E.
    fn attacked(
        &self,
        certificate: &Certificate,
    ) -> Result<(Option<f64>, Option<String>), Failure> {
        let attack = attack(certificate, self.args.samples, self.args.climbs, 1)
            .map_err(|error| Failure::Check(format!("error: {error}")))?;
        let largest = || attack.observed.iter().copied().fold(0.0, f64::max);
        let observed = (attack.states > 0).then(largest);
        let violation = attack.violation.map(|(index, state)| {
            format!(
                "{} errs up to {:e}, which is more than its E of {:e}, as at {state:?}",
                certificate.emitted.entry(index),
                attack.observed[index],
                certificate.bounds[index].total()
            )
        });
        Ok((observed, violation))
    }
}
