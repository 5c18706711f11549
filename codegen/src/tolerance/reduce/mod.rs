//! Smaller models: fewer inertial parameters, fitted to the torques of the robot.
//!
//! Editing the exact program one value at a time never leaves what all of its values share: the
//! wrist's sines stay as long as anything reads them. Torques are linear in the moments of the
//! links about their joints, so a model with few of them is found by linear algebra, and the exact
//! search then writes a program for it that shares nothing with the exact one:
//!
//! 1. [`terms`]: a column for each moment, armature and viscous friction of each link,
//!    at sampled positions and all motions there
//! 2. [`path`]: backward elimination. The parameter that least squares would miss least goes, weighed
//!    by the operations it saves, as long as the largest error can be fitted to be within
//!    the allowances ([`fit`])
//! 3. [`build`]: an exact search for the program of a model
//!
//! Results that are never beyond what is allowed are zero. Nothing here is shown: a model is a place
//! from which the search starts.

mod build;
mod fit;
mod path;
mod terms;

use crate::parallel;
use crate::program::Program;
use crate::tolerance::samples::Samples;
use crate::tolerance::search::Target;
use build::ReducedModel;
use fit::TermFit;
use terms::Terms;

const SEED: u64 = 0x5eed;

/// Sampled positions of an arm of up to six joints, and of a longer one.
const POSITIONS: [usize; 2] = [48, 96];

/// The parts of the allowances that tried models use: the rest is for pruning.
const USES: [f64; 8] = [0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.8, 0.93];

/// From the model that leaves most of the allowances to the smallest; empty for a function that is
/// not linear in the links' moments, or where nothing may go.
pub(super) fn programs(target: Target<'_>) -> Vec<Program> {
    let positions = POSITIONS[usize::from(target.limits.joints() > 6)];
    let samples = Samples::new(target.exact, target.limits, positions, SEED);
    let terms = Terms::new(target, samples);
    let Some(terms) = terms.filter(|terms| !terms.outputs.is_empty()) else {
        return Vec::new();
    };
    let builder = ReducedModel {
        setup: target.setup,
        exact: target.exact,
        terms: &terms,
    };
    let is_over = || target.watch.is_over();
    let fit = TermFit::new(&terms);
    let models = path::eliminate(&builder, &fit, &is_over);
    let of = |most: &f64| models.iter().rposition(|model| model.error <= *most);
    let mut places: Vec<usize> = USES.iter().filter_map(of).collect();
    places.dedup();
    let built = parallel::each(&places, |&place| match is_over() {
        true => None,
        false => {
            // As closely as can be: that leaves more to prune with.
            let from = fit.solve(&models[place].terms, 0.0);
            builder.program(&fit.refine(from, 0.0))
        }
    });
    let mut programs: Vec<Program> = built.into_iter().flatten().collect();
    programs.dedup();
    programs
}
