//! The cost of rounding in a function, result by result: a bound over the box where a result does
//! not divide, else the largest bound at states.

use std::array::from_fn;

use crate::fault::Fault;
use crate::hidden::{self, MOST_RATIO};
use crate::identity::Points;
use crate::identity::exact::Exact;
use crate::identity::number::Draws;
use crate::identity::setting::Setting;
use crate::identity::table::{self, Field, length};
use crate::interval::UNIT;
use crate::load::literals;
use crate::payload::BodyRange;
use crate::program::{ARGUMENTS, GRAVITY, LOAD, Operand, Program, argument};
use crate::read::{self, Head, Source};
use crate::rounding::{Bounds, Ranges, Rounding};
use crate::sample::{FloatState, LANES, Lanes, Near, Sampler};
use crate::states::States;
use crate::tolerance::ResultBound;
use crate::work::Work;

/// The largest rates where the robot file has no limit, per second and per second squared.
pub const RATE: f64 = 10.0;
/// The ranges of arguments that no robot file has limits of.
const WRENCH: f64 = 100.0;
const EARTH: f64 = 9.81;
/// The largest armature and viscous friction, in SI units, where they are arguments.
const DRIVE: f64 = 1.0;
const DAMPING: [f64; 2] = [1e-3, 1e-1];
/// The states at which a function that divides is measured, and at which the size of the results of
/// others is.
const STATES: usize = 1000;
const LOOKED_AT: usize = 100;
const _: () = assert!(STATES.is_multiple_of(LANES) && LOOKED_AT.is_multiple_of(LANES));
/// The largest cost that is shown where the user allows no more: in f64, seven digits of sixteen; in
/// f32, and of polynomials for sines, all but two.
const MOST_DOUBLE: f64 = (1u64 << 24) as f64 * UNIT;
const MOST: f64 = 1.0 / 64.0;
/// At more than half of the states, what divides is at most this part of its largest entry off.
const SHARE: f64 = 1.0 / 8.0;
/// An entry below this share of its result's largest counts as zero.
const ZERO: f64 = 1e-12;
/// The climbs to worse states, and the states of each.
const CLIMBS: usize = 4;
const CLIMBED: usize = 148;

/// The findings about a function that is the robot's but for rounding, and for what a tolerance
/// left out.
#[derive(Clone, Debug)]
pub struct Findings {
    /// The cost of rounding, result by result; none under a tolerance.
    pub costs: Vec<Cost>,
    /// `true` if it has polynomials for sines, whose error counts as rounding.
    pub has_polynomials: bool,
    /// The findings about each entry, if it is under a tolerance.
    pub results: Vec<ResultBound>,
}

/// The cost of rounding in one result of a function.
#[derive(Clone, Debug)]
pub struct Cost {
    /// The result.
    pub name: String,
    /// `true` if it is a bound over the box: the result does not divide. Else it is the largest at
    /// states.
    pub is_bounded: bool,
    /// The largest error relative to the largest value seen of the entry, of a matrix of its row or
    /// its column; NaN where that is above one.
    pub rounding: f64,
    /// The error in halves of an ulp of that value.
    pub units: f64,
    /// `true` if errors are relative to the largest entry of the whole result.
    pub is_of_whole: bool,
    /// At how many states it was measured; zero for the whole box.
    pub states: usize,
}

impl Findings {
    /// Returns true if the cost of every result is bounded over the box.
    pub fn is_bounded(&self) -> bool {
        self.costs.iter().all(|cost| cost.is_bounded)
    }

    /// Returns the largest cost of the results that are bounded, or of those that are measured.
    pub fn worst(&self, is_bounded: bool) -> Option<&Cost> {
        let is_such = |cost: &&Cost| cost.is_bounded == is_bounded;
        let costs = self.costs.iter().filter(is_such);
        costs.max_by(|a, b| a.units.total_cmp(&b.units))
    }
}

/// A function whose text is its claimed program, and that program the robot's.
pub(crate) struct Subject<'s> {
    pub setting: &'s Setting<'s>,
    pub function: &'s table::Function,
    pub program: &'s Program<Exact>,
    pub load: Option<&'s Program<Exact>>,
    pub read: &'s read::ReadFunction,
    pub head: &'s Head<'s>,
    pub ranges: &'s Ranges,
    /// The bodies that arguments of its load are.
    pub bodies: &'s [(usize, Vec<BodyRange>)],
    /// The texts that states are drawn from.
    pub texts: &'s [&'s str],
    /// The largest cost that the user accepts, if it is larger than what is shown otherwise.
    pub worst: f64,
    pub work: &'s Work,
}

impl Subject<'_> {
    pub(crate) fn costs(&self, points: &mut Points) -> Result<Vec<Cost>, Fault> {
        let Subject { read, head, .. } = *self;
        let load = self.load.map(literals).unwrap_or_default();
        let of_load = Rounding::new(&load, head.is_single, self.ranges);
        let mut rounding = Rounding::new(read, head.is_single, self.ranges);
        let mut ranges = self.ranges.clone();
        if self.load.is_some() {
            rounding.load = of_load.bounds(&ranges, None).results;
            let exact = rounding.load.iter().map(|result| result.exact.ends());
            ranges[argument(LOAD).unwrap_or_default()] = exact.collect();
        }
        let has_quotients = read.program.has_quotients();
        let divides = |(_, operand): &(bool, Operand<f64>)| match operand {
            Operand::Step(step) => has_quotients[*step],
            _ => false,
        };
        let divides: Vec<bool> = read.program.outputs.iter().map(divides).collect();
        let is_measured = divides.contains(&true);
        if let (true, Some(points)) = (is_measured, points.first(3).first_chunk()) {
            let (program, setting, load) = (self.program, self.setting, rounding.load.len());
            hidden::check(program, &read.loops, setting, load, points, self.work)?;
        }
        let bounded = divides.iter().filter(|divides| !**divides).count();
        let steps = read.program.steps.len();
        self.work.spend(steps * (bounded + 4), 20)?;
        let over_box = rounding.bounds(&ranges, None);
        let mut arguments = self.function.arguments.clone();
        // A load is computed from what it is of.
        arguments.extend(self.load.iter().flat_map(|_| &self.setting.loading));
        let joints = self.setting.joints();
        let lengths = head.fields.iter().map(|field| field.1.iter().product());
        let mut samples = SampledSizes {
            sampler: Sampler::new(read, &rounding, joints),
            load: Sampler::new(&load, &of_load, joints),
            lengths: lengths.collect(),
            divides: &divides,
            work: self.work,
            states: 0,
            sizes: vec![0.0; divides.len()],
            errors: vec![0.0; divides.len()],
            steps: vec![0.0; steps],
            near: vec![0; head.fields.len()],
            unbounded: vec![0; head.fields.len()],
        };
        let mut states = States {
            ranges: self.ranges,
            places: &arguments,
            bodies: self.bodies,
            widths: &read.speeds,
            draws: Draws::new(self.texts),
            is_single: head.is_single,
            count: 0,
        };
        let mut worst: Vec<(f64, FloatState)> = Vec::new();
        let count = if is_measured { STATES } else { LOOKED_AT };
        for _ in 0..count / LANES {
            let drawn: [FloatState; LANES] = from_fn(|_| states.next());
            let heights = samples.look(drawn.each_ref())?;
            worst.extend(heights.into_iter().zip(drawn));
        }
        // Climbs lead to states that were not drawn.
        let (drawn, near) = (samples.states, samples.near.clone());
        if is_measured {
            self.steps_are_seen(&over_box, &has_quotients, &samples.steps)?;
            worst.sort_by(|a, b| b.0.total_cmp(&a.0));
            for start in worst.into_iter().take(CLIMBS) {
                states.climb(start, CLIMBED, |next| samples.look(next))?;
            }
        }
        let shapes = head.fields.iter().map(|field| field.1.as_slice());
        let sizes = measures(&samples.sizes, shapes);
        let (mut costs, mut first) = (Vec::new(), 0);
        for (field, (name, _)) in head.fields.iter().enumerate() {
            let entries = first..first + samples.lengths[field];
            first = entries.end;
            let is_bounded = !divides[entries.clone()].contains(&true);
            let error = |k: usize| match is_bounded {
                true => over_box.results[k].error,
                false => samples.errors[k],
            };
            let relative = |(k, size): (usize, f64)| match error(k) {
                0.0 => 0.0,
                error => error / size,
            };
            let pairs = entries.clone().map(|k| (k, sizes[k]));
            let mut rounding = pairs.map(relative).fold(0.0, worse);
            let is_of_whole = is_bounded && !(rounding < self.most());
            if is_of_whole {
                let reached = samples.sizes[entries.clone()].iter().copied();
                let whole = reached.fold(0.0, f64::max);
                rounding = entries.map(|k| (k, whole)).map(relative).fold(0.0, worse);
            }
            let unsure = |why: String| Fault::Claim(format!("`{}`: {why}", head.name));
            if is_bounded && !(rounding < self.most()) {
                let (most, of) = (self.most(), "of its largest value");
                return Err(unsure(format!(
                    "rounding of `{name}` has a bound of {rounding:.1e} {of}, over {most:.1e}"
                )));
            }
            if !is_bounded && 2 * near[field] <= drawn {
                return Err(unsure(format!(
                    "at half of the states `{name}` is off by more than an eighth of its value"
                )));
            }
            let asks = self.function.fields.get(field).map(Field::divides);
            if !is_bounded && asks != Some(true) {
                let why = format!("`{name}` divides, and does not ask for that");
                return Err(unsure(why));
            }
            let unbounded = samples.unbounded[field];
            // In f64 a result that divides must not be so near to a division by zero.
            let is_far = unbounded > 0 || !(rounding < MOST.max(self.worst));
            if !is_bounded && !head.is_single && is_far {
                let (most, of) = (MOST.max(self.worst), "of its largest value");
                let reason = match unbounded {
                    0 => format!("is {rounding:.1e} {of} at a state, over {most:.1e}"),
                    _ => "has no bound at a state of the box".to_owned(),
                };
                return Err(unsure(format!("rounding of `{name}` {reason}")));
            }
            let measured = samples.states - unbounded;
            costs.push(Cost {
                name: (*name).to_owned(),
                is_bounded,
                // A bound as large as the values says nothing.
                rounding: if rounding < 1.0 { rounding } else { f64::NAN },
                units: rounding / samples.sampler.scalar.unit,
                is_of_whole,
                states: if is_bounded { 0 } else { measured },
            });
        }
        Ok(costs)
    }

    fn most(&self) -> f64 {
        let most = match self.head.is_single || polynomials(self.read).next().is_some() {
            true => MOST,
            false => MOST_DOUBLE,
        };
        most.max(self.worst)
    }

    /// Compares the steps that no quotient reaches over the box with those at states.
    fn steps_are_seen(
        &self,
        bounds: &Bounds,
        has_quotients: &[bool],
        magnitudes: &[f64],
    ) -> Result<(), Fault> {
        let steps = bounds.steps.iter().zip(has_quotients).zip(magnitudes);
        for (step, ((bound, has_quotient), magnitude)) in steps.enumerate() {
            let most = bound.exact.magnitude();
            if !has_quotient && !self.head.is_single && !(most <= MOST_RATIO * magnitude) {
                let why =
                    format!("is at most {magnitude:.1e} at states, and {most:.1e} over the box");
                return Err(hidden::refused(step, &why));
            }
        }
        Ok(())
    }
}

/// The largest values and errors at the states so far.
struct SampledSizes<'s> {
    sampler: Sampler<'s>,
    load: Sampler<'s>,
    /// The numbers of entries of each result.
    lengths: Vec<usize>,
    divides: &'s [bool],
    work: &'s Work,
    states: usize,
    sizes: Vec<f64>,
    errors: Vec<f64>,
    steps: Vec<f64>,
    /// At how many states each result is near to the exact one.
    near: Vec<usize>,
    /// At how many states it has no bound.
    unbounded: Vec<usize>,
}

impl SampledSizes<'_> {
    /// Looks at states; returns the largest error of what divides at each, relative to its result
    /// there.
    fn look(&mut self, states: [&FloatState; LANES]) -> Result<[f64; LANES], Fault> {
        self.work
            .spend(LANES, self.sampler.work() + self.load.work())?;
        let loads = self.load.run(states, &[]);
        let load: Vec<Lanes> = self.load.results(&loads).collect();
        let values = self.sampler.run(states, &load);
        let magnitudes = self.sampler.magnitudes(&values);
        let steps = self.steps.iter_mut().zip(magnitudes);
        steps.for_each(|(most, magnitude)| *most = most.max(magnitude));
        let results: Vec<Lanes> = self.sampler.results(&values).collect();
        Ok(from_fn(|lane| {
            self.states += 1;
            self.height(|k| results[k].at(lane))
        }))
    }

    /// Looks at the results at a state; returns the largest error of what divides.
    fn height(&mut self, result: impl Fn(usize) -> Near) -> f64 {
        let (mut height, mut first) = (0.0f64, 0);
        for (field, length) in self.lengths.iter().enumerate() {
            let entries = first..first + length;
            let errors = entries.clone().map(|k| result(k).error);
            let error = errors.fold(0.0, worse);
            let mut size = 0.0f64;
            for k in entries {
                let near = result(k);
                let least = near.value.abs() - near.off;
                self.sizes[k] = self.sizes[k].max(least);
                size = size.max(least);
                if error.is_finite() {
                    self.errors[k] = self.errors[k].max(near.error);
                }
            }
            self.unbounded[field] += usize::from(!error.is_finite());
            self.near[field] += usize::from(error <= SHARE * size);
            if self.divides[first..first + length].contains(&true) {
                height = height.max(error / size);
            }
            first += length;
        }
        height
    }
}

pub(crate) fn polynomials(read: &read::ReadFunction) -> impl Iterator<Item = usize> {
    let is_polynomial = |sine: &&read::SinePair| matches!(sine.source, Source::Polynomial(_));
    let sines = read.sines.iter().filter(is_polynomial);
    sines.map(|sine| sine.joint)
}

/// Returns the larger one; what is no number counts as larger.
fn worse(before: f64, error: f64) -> f64 {
    let is_worse = error > before || error.is_nan();
    if is_worse { error } else { before }
}

pub(crate) fn bodies_of<'b>(bodies: &'b [(usize, Vec<BodyRange>)], name: &str) -> &'b [BodyRange] {
    let entry = bodies
        .iter()
        .find(|(place, _)| argument(name) == Some(*place));
    entry.map_or(&[], |(_, ranges)| ranges)
}

pub(crate) fn ranges(
    setting: &Setting,
    bodies: &[(usize, Vec<BodyRange>)],
) -> Result<Ranges, String> {
    let (sizes, gravity) = (setting.sizes(), setting.gravity().unwrap_or(EARTH));
    let of = |&(name, axis): &(&str, char)| {
        let rate = if name == "tau" { WRENCH } else { RATE };
        let ranges = setting.ranges(name, rate)?;
        let [low, high] = match name {
            GRAVITY => [-gravity, gravity],
            "wrench" => [-WRENCH, WRENCH],
            "damping" => DAMPING,
            "payload" | "bodies" => {
                let ranges = bodies_of(bodies, name).iter().map(|body| body.ranges());
                return Ok(ranges.flatten().collect());
            }
            "armature" | "viscous" => {
                let defaults = setting.file.defaults(name, &[])?;
                let most = |x: &Exact| DRIVE.max(2.0 * x.nearest());
                return Ok(defaults.iter().map(|x| [0.0, most(x)]).collect());
            }
            _ => [-1.0, 1.0],
        };
        Ok(ranges.unwrap_or_else(|| vec![[low, high]; length(axis, sizes)]))
    };
    ARGUMENTS.iter().map(of).collect()
}

/// Returns the size that each entry is measured by: its own largest value, of a matrix the smallest
/// of the largest in its row and in its column; where that is zero, the result's.
fn measures<'s>(values: &[f64], shapes: impl Iterator<Item = &'s [usize]>) -> Vec<f64> {
    let (mut entry_sizes, mut left) = (Vec::new(), values);
    for shape in shapes {
        let count = shape.iter().product::<usize>().min(left.len());
        if count == 0 {
            continue;
        }
        let (entries, behind) = left.split_at(count);
        left = behind;
        let whole = entries.iter().copied().fold(0.0, f64::max);
        let (mut sizes, mut stride) = (vec![whole; count], count);
        for length in shape {
            stride /= length;
            let digit = |index: usize| index / stride % length;
            let mut most = vec![0.0f64; *length];
            for (index, entry) in entries.iter().enumerate() {
                most[digit(index)] = most[digit(index)].max(*entry);
            }
            for (index, size) in sizes.iter_mut().enumerate() {
                let largest = most[digit(index)];
                if largest > ZERO * whole {
                    *size = size.min(largest);
                }
            }
        }
        entry_sizes.extend(sizes);
    }
    entry_sizes
}
