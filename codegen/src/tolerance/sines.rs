//! Polynomials for sines, as exact as a function's tolerance needs.
//!
//! An error of a sine counts with the largest derivative of each result by it at sampled states: the
//! engine decides afterwards. First all sines get the same error, the largest that is allowed; then
//! those of one range are made cheaper together as long as the allowances hold, the range that saves
//! most first.
//!
//! Angles of one range keep one kernel: the same operations on several numbers
//! run side by side. For a PUMA's four angles, kernels of their own took four
//! operations of 88 less and a twentieth more time.

use dalembert_model::diagnostic::Diagnostic;

use super::input_box::InputBox;
use super::net::Net;
use super::samples::Samples;
use crate::program::{Input, Program, ScalarType};
use crate::sincos::choose::{Candidates, KernelChoice};
use crate::sincos::interval::Interval;
use crate::sincos::{self, AngleKernel, Sines};

const POSITIONS: usize = 64;
const SEED: u64 = 0x51e5;

/// The largest derivatives of the results by the sines and cosines, at sampled states.
pub(super) struct Slopes {
    inputs: Vec<Input>,
    /// One a result and input.
    sizes: Vec<Vec<f64>>,
}

impl Slopes {
    pub(super) fn new(program: &Program, limits: &InputBox) -> Slopes {
        let samples = Samples::new(program, limits, POSITIONS, SEED);
        let net = Net::new(program);
        let (m, state) = (samples.len(), net.unedited());
        let values = net.run(&state, &net.columns(&samples), m);
        let outputs = 0..net.outputs.len();
        let sizes = outputs.map(|output| {
            let mut adjoints = Vec::new();
            net.adjoints(&state, &values, (output, m), &mut adjoints);
            samples.coefficients(&mut adjoints);
            let columns = adjoints.chunks_exact(m.max(1)).take(net.inputs.len());
            let largest = |column| samples.blocks(column).into_iter().fold(0.0, f64::max);
            columns.map(largest).collect()
        });
        Slopes {
            sizes: sizes.collect(),
            inputs: net.inputs.clone(),
        }
    }

    fn costs(&self, error: impl Fn(Input) -> f64) -> Vec<f64> {
        let errors: Vec<f64> = self.inputs.iter().map(|input| error(*input)).collect();
        let cost = |sizes: &Vec<f64>| sizes.iter().zip(&errors).map(|(x, e)| x * e).sum();
        self.sizes.iter().map(cost).collect()
    }

    fn of(&self, sines: &[AngleKernel]) -> Vec<f64> {
        self.costs(|input| {
            let mut kernels = sines.iter();
            let kernel = kernels.find(|kernel| input.angle() == Some(kernel.joint));
            kernel.map_or(0.0, |kernel| match input {
                Input::Sin(_) => kernel.errors.sin,
                _ => kernel.errors.cos,
            })
        })
    }
}

/// Returns the cheapest polynomials found with which sines and cosines cost no output
/// more than its allowance, in its unit. No sines without angles: nothing is needed then.
pub(super) fn within(
    program: &Program,
    scalar: ScalarType,
    positions: &[Interval],
    allowances: &[f64],
    slopes: &Slopes,
) -> Result<Sines, Diagnostic> {
    let error = uniform(allowances, slopes);
    let near = |error| {
        let sines = sincos::polynomials(program, scalar, positions, error);
        sines.map_err(|miss| Diagnostic::error(miss.to_string()))
    };
    let mut sines = near(error)?;
    let admitted = |sines: &[AngleKernel]| {
        let mut pairs = slopes.of(sines).into_iter().zip(allowances);
        pairs.all(|(cost, allowed)| cost <= *allowed)
    };
    // A larger error costs more than in proportion: with half of it they fit.
    if !admitted(&sines) {
        sines = near(error / 2.0)?;
    }
    let groups = groups(program, scalar, positions, error);
    loop {
        let mut best: Option<(usize, Sines)> = None;
        for (members, front) in &groups {
            let now = sines[members[0]].kernel.operations();
            let mut cheaper = front.iter().filter(|c| c.kernel.operations() < now);
            let Some(choice) = cheaper.next_back() else {
                continue;
            };
            let saved = members.len() * (now - choice.kernel.operations());
            if best.as_ref().is_some_and(|(most, _)| *most >= saved) {
                continue;
            }
            let mut other = sines.clone();
            for &member in members {
                let sine = &mut other[member];
                (sine.kernel, sine.errors) = (choice.kernel.clone(), choice.errors);
                sine.form = choice.form.to_string();
            }
            if admitted(&other) {
                best = Some((saved, other));
            }
        }
        match best {
            Some((_, better)) => sines = better,
            None => return Ok(sines),
        }
    }
}

fn uniform(allowances: &[f64], slopes: &Slopes) -> f64 {
    let costs = slopes.costs(|input| f64::from(u8::from(input.angle().is_some())));
    let pairs = costs.iter().zip(allowances).filter(|pair| *pair.0 > 0.0);
    let least = pairs.map(|(cost, allowed)| allowed / cost);
    least.fold(0.1, f64::min).max(0.0)
}

fn groups(
    program: &Program,
    scalar: ScalarType,
    positions: &[Interval],
    error: f64,
) -> Vec<(Vec<usize>, Vec<KernelChoice>)> {
    let mut keys = Vec::new();
    let mut groups: Vec<(Vec<usize>, Vec<KernelChoice>)> = Vec::new();
    for (index, trig) in program.trig().into_iter().enumerate() {
        let key = (sincos::range_of(trig.joint, positions), trig.need);
        match keys.iter().position(|known| *known == key) {
            Some(group) => groups[group].0.push(index),
            None => {
                let candidates = Candidates::new(trig.need, scalar, key.0);
                groups.push((vec![index], candidates.front(error * MAX, error)));
                keys.push(key);
            }
        }
    }
    groups
}

const MAX: f64 = 1e4;
