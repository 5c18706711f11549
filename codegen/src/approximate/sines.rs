//! Polynomials for sines, as exact as a function's tolerance needs.
//!
//! An error of a sine counts with the largest derivative of each output with
//! respect to it. First all sines get the same error, the largest that every
//! output's allowance admits; then those of one range are made cheaper
//! together as long as the allowances hold, the range that saves most first.
//!
//! Angles of one range keep one kernel: the same operations on several numbers
//! run side by side. For a PUMA's four angles, kernels of their own took four
//! operations of 88 less and a twentieth more time.

use crate::bound::sensitivity::Sensitivity;
use crate::interval::Interval;
use crate::program::kernel::{Kernel, KernelWriter};
use crate::program::{Pair, Program, ScalarType};
use crate::sincos::choose::{Candidates, Choice};
use crate::sincos::proof::Errors;
use crate::sincos::{self, AngleKernel, Sines};
use crate::words::{Complaint, complaint};

/// An error that is small beside any sine, and large beside libm's.
const UNIT: f64 = 1e-4;

/// Returns the cheapest polynomials found with which sines and cosines cost no output
/// more than its allowance, in its unit, over the box of the
/// program's sensitivity. No sines without angles: nothing is needed then.
///
/// # Errors
/// An angle whose sine cannot be had as exactly.
pub fn within(
    program: &Program,
    scalar: ScalarType,
    positions: &[Interval],
    allowances: &[f64],
    sensitivity: &Sensitivity,
) -> Result<Sines, Complaint> {
    let error = uniform(program, scalar, allowances, sensitivity);
    let near = |error| {
        let sines = sincos::polynomials(program, scalar, positions, error);
        sines.map_err(|miss| complaint(miss.to_string()))
    };
    let mut sines = near(error)?;
    let admitted = |sines: &[AngleKernel]| {
        let costs = sensitivity.rounding(scalar, sines);
        let mut pairs = costs.iter().zip(allowances);
        pairs.all(|(cost, &allowed)| cost.sincos <= allowed)
    };
    // A larger error costs more than in proportion: with half of it they fit.
    if !admitted(&sines) {
        sines = near(error / 2.0)?;
    }
    let groups = groups(program, scalar, positions, error);
    loop {
        let mut best: Option<(usize, Sines)> = None;
        for (members, front) in &groups {
            let Some(now) = members.first().map(|&m| sines[m].kernel.operations()) else {
                continue;
            };
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
                other[member] = taken(&sines[member], choice);
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

fn uniform(
    program: &Program,
    scalar: ScalarType,
    allowances: &[f64],
    sensitivity: &Sensitivity,
) -> f64 {
    let unit = |trig: &Pair| AngleKernel {
        joint: trig.joint,
        range: Interval::ALL,
        form: String::new(),
        kernel: Kernel {
            need: trig.need,
            dag: KernelWriter::default().finish(Vec::new()),
        },
        errors: Errors {
            sin: UNIT,
            cos: UNIT,
        },
    };
    let sines: Sines = program.trig().iter().map(unit).collect();
    let costs = sensitivity.rounding(scalar, &sines);
    let pairs = costs.iter().zip(allowances);
    let admitted = pairs.filter(|(cost, _)| cost.sincos > 0.0);
    let least = admitted.map(|(cost, allowed)| UNIT * allowed / cost.sincos);
    least.fold(0.1, f64::min).max(0.0)
}

fn groups(
    program: &Program,
    scalar: ScalarType,
    positions: &[Interval],
    error: f64,
) -> Vec<(Vec<usize>, Vec<Choice>)> {
    let key = |trig: &Pair| {
        let range = sincos::range_of(trig.joint, positions);
        (range, trig.need)
    };
    let all = program.trig();
    let mut groups: Vec<(Vec<usize>, Vec<Choice>)> = Vec::new();
    for (index, trig) in all.iter().enumerate() {
        let same = |(members, _): &&mut (Vec<usize>, Vec<Choice>)| {
            let first = members.first().and_then(|&first| all.get(first));
            first.is_some_and(|first| key(first) == key(trig))
        };
        match groups.iter_mut().find(same) {
            Some((members, _)) => members.push(index),
            None => {
                let candidates = Candidates::new(trig.need, scalar, key(trig).0);
                groups.push((vec![index], candidates.front(error * MAX, error)));
            }
        }
    }
    groups
}

const MAX: f64 = 1e4;

fn taken(old: &AngleKernel, choice: &Choice) -> AngleKernel {
    AngleKernel {
        form: choice.form.to_string(),
        kernel: choice.kernel.clone(),
        errors: choice.errors,
        ..*old
    }
}
