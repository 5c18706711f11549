//! The cost of rounding in a function: over the box where that can be bounded, else at states that a
//! hash draws.

use crate::identity::exact::Exact;
use crate::identity::number::Draws;
use crate::identity::setting::Setting;
use crate::identity::table::length;
use crate::program::{ARGUMENTS, Operand, Program, Step};
use crate::read::{self, Function, Head, Source};
use crate::rounding::{Ranges, Rounding, Value};
use crate::sines::Scalar;
use crate::tolerance::Bounded;

/// The largest rates where the robot file has no limit, per second and per second squared.
pub const RATE: f64 = 10.0;
/// The ranges of arguments that no robot file has limits of.
const WRENCH: f64 = 100.0;
const GRAVITY: f64 = 9.81;
const DAMPING: [f64; 2] = [1e-3, 1e-1];
/// The numbers of states where no bound over the box says anything, and where one does.
pub(crate) const STATES: usize = 1000;
const LOOKED_AT: usize = 100;
/// An entry below this share of its result's largest counts as zero.
const ZERO: f64 = 1e-12;

/// A function that is the robot's but for rounding, and for what a tolerance left out.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The largest cost of rounding, relative to the largest value seen of the entry, of a matrix
    /// of its row or its column; NaN where no bound is below that value.
    pub rounding: f64,
    /// The same in halves of an ulp of that value.
    pub units: f64,
    /// At how many of the states that were drawn that holds, others being near to where it divides by
    /// zero; all that were drawn where none is bounded; zero for the whole box.
    pub states: usize,
    /// `true` if it has polynomials for sines, whose error counts as rounding.
    pub has_polynomials: bool,
    /// The findings about each result, if it is under a tolerance.
    pub results: Vec<Bounded>,
}

pub(crate) fn load(own: &Program<Exact>, ranges: &Ranges, is_single: bool) -> Option<Vec<Value>> {
    let operand = |own: &Operand<Exact>| {
        Some(match own {
            Operand::Constant(constant) => Operand::Constant(constant.double()?[0]),
            Operand::Step(step) => Operand::Step(*step),
            Operand::Entry(place, index) => Operand::Entry(*place, *index),
            Operand::Sine(..) | Operand::Speed(_) => return None,
        })
    };
    let step = |(operation, [a, b]): &Step<Exact>| Some((*operation, [operand(a)?, operand(b)?]));
    let output = |(negative, own): &(bool, Operand<Exact>)| Some((*negative, operand(own)?));
    let program = Program {
        steps: own.steps.iter().map(step).collect::<Option<_>>()?,
        outputs: own.outputs.iter().map(output).collect::<Option<_>>()?,
    };
    let read = Function {
        program,
        ..Function::default()
    };
    Some(Rounding::new(&read, is_single, ranges).bounds(ranges, None))
}

pub(crate) fn cost(
    read: &Function,
    head: &Head,
    ranges: &Ranges,
    load: &[Value],
    texts: &[&str],
) -> Shown {
    let mut rounding = Rounding::new(read, head.is_single, ranges);
    rounding.load = load.to_vec();
    let mut draws = Draws::new(texts);
    let over_box = rounding.bounds(ranges, None);
    let count = over_box.len();
    // Near to where something divides by zero, a state is not bounded.
    let mut look = |states: usize, over_box: Option<&[Value]>| {
        let (mut sizes, mut errors, mut bounded) = (vec![0.0; count], vec![0.0; count], 0);
        for _ in 0..states {
            let state = drawn(ranges, &mut draws, head.is_single);
            let found = rounding.bounds(&state, None);
            if over_box.is_none() && !found.iter().all(|own| own.error.is_finite()) {
                continue;
            }
            bounded += 1;
            for (k, own) in found.iter().enumerate() {
                sizes[k] = worse(sizes[k], own.exact.least());
                errors[k] = worse(errors[k], own.error);
            }
        }
        if let Some(over_box) = over_box {
            errors = over_box.iter().map(|own| own.error).collect();
        }
        let sizes = measures(&sizes, head.fields.iter().map(|own| own.1.as_slice()));
        let relative = |(error, size): (&f64, &f64)| match *error == 0.0 {
            true => 0.0,
            false => error / size,
        };
        let cost = errors.iter().zip(&sizes).map(relative).fold(0.0, worse);
        match bounded {
            0 => (f64::NAN, states),
            _ => (cost, bounded),
        }
    };
    let is_finite = over_box.iter().all(|own| own.error.is_finite());
    let (cost, _) = match is_finite {
        true => look(LOOKED_AT, Some(&over_box)),
        false => (f64::NAN, 0),
    };
    // A bound that says nothing of the box gives way to bounds at states.
    let (cost, states) = match cost < most(read, head.is_single) {
        true => (cost, 0),
        false => look(STATES, None),
    };
    Shown {
        rounding: cost,
        units: cost / rounding.scalar.unit,
        states,
        has_polynomials: polynomials(read).next().is_some(),
        results: Vec::new(),
    }
}

/// For what does not divide: some seven digits, and all where polynomials are for sines.
pub(crate) fn most(read: &Function, is_single: bool) -> f64 {
    match polynomials(read).next() {
        Some(_) => 1.0,
        None => Scalar::new(is_single).unit * f64::from(1 << 24),
    }
}

pub(crate) fn polynomials(read: &Function) -> impl Iterator<Item = usize> {
    let is_polynomial = |own: &&read::Sines| matches!(own.source, Source::Polynomial(_));
    read.sines.iter().filter(is_polynomial).map(|own| own.joint)
}

/// Returns the larger one; what is no number counts as larger.
fn worse(before: f64, own: f64) -> f64 {
    if own > before || own.is_nan() {
        own
    } else {
        before
    }
}

pub(crate) fn ranges(setting: &Setting) -> Result<Ranges, String> {
    let sizes = [setting.joints(), setting.links()];
    let of = |&(name, axis): &(&str, char)| {
        let rate = if name == "tau" { WRENCH } else { RATE };
        let own = setting.ranges(name, rate)?;
        let [low, high] = match name {
            "g" => [-GRAVITY, GRAVITY],
            "wrench" => [-WRENCH, WRENCH],
            "damping" => DAMPING,
            _ => [-1.0, 1.0],
        };
        Ok(own.unwrap_or_else(|| vec![[low, high]; length(axis, sizes)]))
    };
    ARGUMENTS.iter().map(of).collect()
}

pub(crate) fn drawn(ranges: &Ranges, draws: &mut Draws, is_single: bool) -> Ranges {
    let lists = ranges.iter().map(|list| {
        let points = list.iter().map(|[low, high]| {
            let own = low + (high - low) * draws.share();
            [if is_single { (own as f32).into() } else { own }; 2]
        });
        points.collect()
    });
    lists.collect()
}

/// Returns the size that each entry is measured by: its own largest value, of a matrix the smallest
/// of the largest in its row and in its column; where that is zero, the result's.
fn measures<'s>(seen: &[f64], shapes: impl Iterator<Item = &'s [usize]>) -> Vec<f64> {
    let (mut all, mut left) = (Vec::new(), seen);
    for shape in shapes {
        let count = shape.iter().product::<usize>().min(left.len());
        if count == 0 {
            continue;
        }
        let (each, behind) = left.split_at(count);
        left = behind;
        let whole = each.iter().copied().fold(0.0, f64::max);
        let (mut sizes, mut stride) = (vec![whole; count], count);
        for length in shape {
            stride /= length;
            let digit = |index: usize| index / stride % length;
            let mut most = vec![0.0f64; *length];
            for (index, own) in each.iter().enumerate() {
                most[digit(index)] = most[digit(index)].max(*own);
            }
            for (index, size) in sizes.iter_mut().enumerate() {
                let own = most[digit(index)];
                if own > ZERO * whole {
                    *size = size.min(own);
                }
            }
        }
        all.extend(sizes);
    }
    all
}
