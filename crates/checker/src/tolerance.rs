//! A function under a tolerance: at every state of the box each result of its text is within the
//! tolerance, relative to T, of the exact program's.
//!
//! The difference of the two programs is a polynomial in sines, cosines, rates and loads, of which
//! all that both have in common cancels. Its largest magnitude over the box and what rounding costs add
//! up. Box and T are not the claim's: the box is the scene's or the limits of the joints, T the
//! actuators' limit, or what the exact program reaches at a state of the box; there a payload that is an
//! argument has the largest mass, all of it in a point that the claim names.

use crate::claim::ToleranceClaim;
use crate::derivatives::Derivatives;
use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::identity::table::{Field, Function};
use crate::interval::{FARTHEST, Interval, up};
use crate::load::load_of_point;
use crate::maximum::{self, length};
use crate::payload::BodyRange;
use crate::polynomial::SLACK;
use crate::program::{ARGUMENTS, GRAVITY, LOAD, Operand, Program, argument};
use crate::read;
use crate::ring::Ring;
use crate::rounding::{Ranges, Rounding};
use crate::work::Work;
use crate::written::{PolynomialProgram, evaluate};

/// The share by which a box may be another than the file's: decimals were rounded to doubles.
pub(crate) const BOX_SLACK: f64 = 1e-9;
/// Nanoseconds for an operation of intervals, and for a term whose length is summed.
const INTERVALS: u64 = 20;
const LENGTH: u64 = 300;
/// The part of the tolerance that rounding may take by intervals, before polynomials bound it.
const SHARE: f64 = 1.0 / 16.0;
/// The largest error of a result that is always zero, relative to the largest T: differences of
/// programs are of doubles.
const ZERO: f64 = 1e-12;
const MOST_RATE: f64 = 1e30;

/// A bound of |text in its scalar − exact program| over the box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// The part of what differs in real numbers: parts that were left out, and polynomials for sines.
    pub real: f64,
    /// The part of operations, constants, and sines that are called.
    pub rounding: f64,
}

impl Bound {
    /// Returns the bound of both.
    pub fn total(self) -> f64 {
        up(self.real + self.rounding)
    }
}

/// The findings about one result, in its unit.
#[derive(Clone, Debug)]
pub struct ResultBound {
    /// The name of the vector or matrix of which it is an entry: `tau`, `d`.
    pub field: String,
    /// Its joints, from zero: of an entry of D its row and its column.
    pub joints: Vec<usize>,
    /// T: the size that errors are relative to.
    pub scale: f64,
    /// The bound of its error.
    pub bound: Bound,
    /// The user's tolerance times T.
    pub tolerated: f64,
}

impl ResultBound {
    /// Returns the bound relative to T, E; as it is if T is zero.
    pub fn relative(&self) -> Bound {
        let Bound { real, rounding } = self.bound;
        Bound {
            real: up(real / self.unit()),
            rounding: up(rounding / self.unit()),
        }
    }

    /// Returns the unit of relative errors: T, or one if T is zero.
    pub fn unit(&self) -> f64 {
        if self.scale == 0.0 { 1.0 } else { self.scale }
    }

    /// Returns true if the tolerance is shown.
    pub fn is_shown(&self) -> bool {
        self.bound.total() <= self.tolerated
    }
}

pub(crate) struct VariantSubject<'s> {
    pub(crate) setting: &'s Setting<'s>,
    pub(crate) function: &'s Function,
    pub(crate) exact: &'s Program<Exact>,
    pub(crate) emitted: &'s Program<Exact>,
    pub(crate) read: &'s read::ReadFunction,
    /// The function that makes a load, where this one takes it.
    pub(crate) load: Option<&'s Program<Exact>>,
    pub(crate) is_single: bool,
    pub(crate) claim: &'s ToleranceClaim,
    /// The tolerance of each joint, relative to T.
    pub(crate) tolerance: &'s [f64],
    pub(crate) work: &'s Work,
}

/// A result: its field and its joints, of a torque its own, of an entry of D two.
type ResultEntry<'s> = (&'s Field, Vec<usize>);

impl VariantSubject<'_> {
    pub(crate) fn bounded(&self) -> Result<Vec<ResultBound>, Fault> {
        let count = self.emitted.outputs.len();
        let are_alike = self.exact.outputs.len() == count;
        ensure(are_alike, "its two programs have different results")?;
        let fields = self.results();
        ensure(fields.len() == count, "results that are not the function's")?;
        let mut loading = self.setting.loading.iter();
        let is_of_payload = loading.all(|place| argument("payload") == Some(*place));
        let why = "a tolerance where bodies or drives are arguments";
        ensure(is_of_payload, why)?;
        let places = &self.function.arguments;
        let (ranges, load) = (self.setting).loaded_box(places, self.is_single, self.load)?;
        let ranges = &ranges;
        let work = self.work;
        work.spend((self.exact.steps.len() + count) * count, INTERVALS)?;
        let scales = self.scales(&fields, ranges)?;
        let ring = Ring::new(self.setting, ranges, work)?;
        let mut rounding = Rounding::new(self.read, self.is_single, ranges);
        rounding.load = load;
        let errors = |joint, is_sine| rounding.polynomial(joint, is_sine);
        let emitted = PolynomialProgram::new(self.emitted, &ring, Some(&errors), work)?;
        let exact = PolynomialProgram::new(self.exact, &ring, None, work)?;
        let steps = self.read.program.steps.len();
        let size = |step: usize| {
            let polynomial = emitted.step(step);
            polynomial.map_or(f64::INFINITY, |p| ring.size(p) * SLACK)
        };
        let mut sizes: Vec<f64> = (0..steps).map(size).collect();
        work.spend(steps * (count + 4), INTERVALS)?;
        let bounds = rounding.bounds(ranges, Some(&sizes)).results;
        let mut costs: Vec<f64> = bounds.iter().map(|bound| bound.error).collect();
        // Where intervals leave little of the tolerance.
        let allowed = |k: usize| self.tolerance_of(&fields[k].1) * scales[k];
        let is_dear = |k: &usize| costs[*k] > SHARE * allowed(*k);
        let dear: Vec<usize> = (0..count).filter(is_dear).collect();
        if !dear.is_empty() {
            for (step, size) in sizes.iter_mut().enumerate() {
                if let Some(polynomial) = emitted.step(step) {
                    work.spend(polynomial.terms.len(), LENGTH)?;
                    *size = size.min(length(polynomial, &ring) * SLACK);
                }
            }
            let derivatives = Derivatives {
                text: &self.read.program,
                program: self.emitted,
                written: &emitted,
                ring: &ring,
                rounding: &rounding,
                sizes: &sizes,
                work,
            };
            for (k, cost) in dear.iter().zip(derivatives.bounds(&dear)?) {
                costs[*k] = costs[*k].min(cost);
            }
        }
        let (emitted, exact) = (&emitted.outputs, &exact.outputs);
        let largest = scales.iter().copied().fold(0.0, f64::max);
        let mut results = Vec::new();
        for (k, (field, joints)) in fields.into_iter().enumerate() {
            let scale = scales[k];
            let rounding = if self.is_literal(k) { 0.0 } else { costs[k] };
            // A result that is not always zero has a state where it is not.
            let is_zero = exact[k].terms.is_empty() && exact[k].rest == 0.0;
            let why = "T of zero of a result that is not always zero";
            ensure(scale > 0.0 || is_zero, why)?;
            let tolerated = match scale > 0.0 {
                true => below(self.tolerance_of(&joints) * scale),
                false => ZERO * largest,
            };
            let difference = emitted[k].plus(&exact[k].negated());
            let wanted = (tolerated - rounding).next_down().next_down();
            results.push(ResultBound {
                field: field.name.clone(),
                joints,
                scale,
                bound: Bound {
                    real: maximum::largest(&difference, &ring, wanted, work),
                    rounding,
                },
                tolerated,
            });
        }
        Ok(results)
    }

    fn is_literal(&self, result: usize) -> bool {
        let text = self.read.program.outputs.get(result);
        match (text, self.emitted.outputs.get(result)) {
            (Some((_, Operand::Constant(literal))), Some((_, Operand::Constant(exact)))) => {
                exact.double() == Some([*literal, 0.0])
            }
            _ => false,
        }
    }

    fn results(&self) -> Vec<ResultEntry<'_>> {
        let mut entries = Vec::new();
        for field in &self.function.fields {
            let lengths = field.lengths(self.setting, 0);
            for index in 0..lengths.iter().product::<usize>() {
                let (mut left, mut joints) = (index, Vec::new());
                for (axis, length) in field.axes.bytes().zip(&lengths).rev() {
                    joints.extend((axis == b'n').then(|| self.setting.rows[left % length]));
                    left /= length;
                }
                joints.reverse();
                entries.push((field, joints));
            }
        }
        entries
    }

    /// Returns the tolerance of a result: of several joints, and of none, the strictest.
    fn tolerance_of(&self, joints: &[usize]) -> f64 {
        let mut lists = [joints, &self.setting.rows].into_iter();
        let held = lists.find(|list| !list.is_empty());
        let is_held = |joint: &usize| held.is_none_or(|list| list.contains(joint));
        let held_joints = (0..self.tolerance.len()).filter(is_held);
        let tolerances = held_joints.map(|joint| self.tolerance[joint]);
        tolerances.fold(f64::INFINITY, f64::min)
    }

    fn scales(&self, results: &[ResultEntry], ranges: &Ranges) -> Result<Vec<f64>, Fault> {
        match self.claim.relative_to.as_str() {
            "actuator" => self.actuator(results),
            "range" => self.reached(ranges),
            _ => {
                let why = "tolerance: `relative_to` is neither actuator nor range";
                Err(Fault::Claim(why.into()))
            }
        }
    }

    /// Returns the limits of the actuators; of an entry of D the inertia that takes all of a limit at
    /// the largest acceleration, of h_ikm the coefficient at the largest velocities.
    fn actuator(&self, results: &[ResultEntry]) -> Result<Vec<f64>, Fault> {
        let limit = |joint: usize, name: &str| {
            let bound = self.setting.limit(joint, name).filter(|limit| *limit > 0.0);
            bound.unwrap_or(f64::NAN)
        };
        let torque = |joint: usize| limit(joint, "torque");
        let inertia = |i: usize, k: usize| torque(i) / limit(k, "acceleration");
        let measure = |(field, joints): &ResultEntry| match *joints.as_slice() {
            _ if !field.is_measured() => None,
            [i] => Some(torque(i)),
            [i, k] => Some(inertia(i, k).min(inertia(k, i))),
            [i, k, m] => Some(torque(i) / (limit(k, "velocity") * limit(m, "velocity"))),
            _ => None,
        };
        let measures = results.iter().map(measure).collect::<Option<_>>();
        let why = "the actuators' limits are no measure of this function";
        measures.ok_or_else(|| Fault::Claim(why.into()))
    }

    /// Returns T, which the exact program reaches at the claim's state of each result: positions, rates,
    /// and the point where a payload is.
    fn reached(&self, ranges: &Ranges) -> Result<Vec<f64>, Fault> {
        let states = &self.claim.reached;
        let of_robot = |why| Fault::Robot("limits".into(), why);
        let BodyRange { mass, radius } = self.setting.body().map_err(of_robot)?.unwrap_or_default();
        let places = &self.function.arguments;
        let wrong = "`reached`: expected a state of the box for each result";
        ensure(states.len() == self.exact.outputs.len(), wrong)?;
        let of_state = |place: &usize| *place < 3 || Some(*place) == argument(GRAVITY);
        let places: Vec<usize> = places.iter().copied().filter(of_state).collect();
        let count = |place: &usize| self.setting.entries(*place);
        let total = places.iter().map(count).sum::<usize>();
        let gravity = self.setting.gravity().unwrap_or_default();
        let least = |(result, state): (usize, &Vec<f64>)| {
            let mut arguments = vec![Vec::new(); ARGUMENTS.len()];
            let (mut state, point) = state.split_at(state.len().min(total));
            let mut is_inside = state.len() == total;
            for place in &places {
                let (list, others) = state.split_at(count(place).min(state.len()));
                state = others;
                let mut pairs = list.iter().zip(&ranges[*place]);
                is_inside &= pairs.all(|(at, range)| is_within(*at, *range));
                // Ranges of its entries are those of a ball.
                let square = list.iter().map(|x| x * x).sum::<f64>();
                is_inside &= *place < 3 || is_within(square.sqrt(), [0.0, gravity]);
                arguments[*place] = list.iter().copied().map(Interval::point).collect();
            }
            match (self.load, <[f64; 3]>::try_from(point)) {
                (None, _) => is_inside &= point.is_empty(),
                (Some(_), Err(_)) => is_inside = false,
                (Some(load), Ok(point)) => {
                    is_inside &= point.iter().map(|x| x * x).sum::<f64>().sqrt() <= radius;
                    let load = load_of_point(load, mass[1], point)?;
                    arguments[argument(LOAD).unwrap_or_default()] = load;
                }
            }
            ensure(is_inside, wrong)?;
            let values = evaluate(self.exact, &arguments).unwrap_or_default();
            let interval = values.get(result).ok_or(Fault::Claim(wrong.into()))?;
            Ok(interval.low.max(-interval.high).max(0.0))
        };
        states.iter().enumerate().map(least).collect()
    }
}

impl Setting<'_> {
    /// Returns the box: ranges of q, q̇ and q̈, of zero where they are no argument. Refuses a joint
    /// that the file does not limit.
    pub(crate) fn state_box(&self, places: &[usize], is_single: bool) -> Result<Ranges, Fault> {
        let gravity = self.gravity();
        let is_bounded = |place: &usize| match ARGUMENTS[*place].0 {
            "q" | "qd" | "qdd" | LOAD => true,
            name => name == GRAVITY && gravity.is_some(),
        };
        let are_bounded = places.iter().all(is_bounded);
        ensure(are_bounded, "an argument that no box bounds")?;
        let of_robot = |why: String| Fault::Robot("limits".into(), why);
        let mut ranges: Ranges = vec![Vec::new(); ARGUMENTS.len()];
        if let (Some(place), Some(most)) = (argument(GRAVITY), gravity) {
            ranges[place] = vec![[-most, most]; 3];
        }
        for place in 0..3 {
            if !places.contains(&place) {
                ranges[place].resize(self.entries(place), [0.0; 2]);
                continue;
            }
            let name = ARGUMENTS[place].0;
            let known = self.ranges(name, f64::INFINITY).map_err(of_robot)?;
            let joint_ranges = known.unwrap_or_default();
            let mut ends = joint_ranges.iter().flatten();
            if !ends.all(|end| end.abs() < MOST_RATE) {
                let why = format!("a tolerance needs the range of `{name}` of every joint");
                return Err(of_robot(why));
            }
            // The decimal, or the multiple of π, may be on either side of the double, and the end of
            // a box in f32 on either side of a point.
            let outward = |[low, high]: [f64; 2]| match (low == high, is_single) {
                (true, _) if low == 0.0 => [low, high],
                (true, true) => [(low as f32).next_down(), (high as f32).next_up()].map(f64::from),
                _ => [low.next_down(), high.next_up()],
            };
            ranges[place] = joint_ranges.into_iter().map(outward).collect();
        }
        let is_far = |(joint, range): (usize, &[f64; 2])| {
            self.turns_by(joint) && range.iter().any(|end| end.abs() >= FARTHEST)
        };
        let is_near = !ranges[0].iter().enumerate().any(is_far);
        ensure(is_near, "the sine of an angle beyond 1000 rad")?;
        Ok(ranges)
    }
}

/// Returns true if a number is in a range, but for what decimals of the file's may be in doubles.
fn is_within(value: f64, [low, high]: [f64; 2]) -> bool {
    let slack = BOX_SLACK * (low.abs() + high.abs()) + f64::MIN_POSITIVE;
    low - slack <= value && value <= high + slack
}

fn ensure(holds: bool, why: &str) -> Result<(), Fault> {
    let fault = || Fault::Claim(format!("tolerance: {why}"));
    holds.then_some(()).ok_or_else(fault)
}

/// Returns a number that a rounded one is not below; zero is exact.
fn below(x: f64) -> f64 {
    if x > 0.0 { x.next_down() } else { x }
}
