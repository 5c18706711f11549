//! A function under a tolerance: at every state of the box each result of its text is within E·T of
//! the exact program's, and T is no larger than it may be.
//!
//! The difference of the two programs is a polynomial in sines, cosines and rates, of which all
//! that both have in common cancels. Its largest magnitude over the box and what rounding costs add up.

use crate::claim::Tolerated;
use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::number::Draws;
use crate::identity::setting::Setting;
use crate::identity::table::{Field, Function};
use crate::interval::FARTHEST;
use crate::maximum;
use crate::polynomial::SLACK;
use crate::program::{ARGUMENTS, Operand, Program};
use crate::read;
use crate::ring::Ring;
use crate::rounding::{Ranges, Rounding};
use crate::work::Work;
use crate::written::{at, written};

/// The share by which a box may be another than the file's: decimals were rounded to doubles.
pub(crate) const BOX_SLACK: f64 = 1e-9;
/// The share by which T may be above the value that is reached. The tolerance is relative to that.
const SCALE_SLACK: f64 = 1e-4;
const MOST_EVALUATED: usize = 1 << 24;
const STATES: usize = 1000;
/// The largest error of a result that is always zero, relative to the largest T: differences of
/// programs are of doubles.
const ZERO: f64 = 1e-12;

/// The findings about one result, in its own unit.
#[derive(Clone, Debug)]
pub struct Bounded {
    /// Its joints, from zero: of an entry of D its row and its column.
    pub joints: Vec<usize>,
    /// T: the size that errors are relative to.
    pub scale: f64,
    /// A bound of what the text differs from the exact program in real numbers.
    pub real: f64,
    /// A bound of what rounding costs.
    pub rounding: f64,
    /// The claim, E·T.
    pub claimed: f64,
    /// The user's tolerance times T.
    pub tolerated: f64,
}

impl Bounded {
    /// Returns the bound of both.
    pub fn bound(&self) -> f64 {
        let sum = self.real + self.rounding;
        if sum == 0.0 { 0.0 } else { sum.next_up() }
    }

    /// Returns the unit of relative errors: T, or one if T is zero.
    pub fn unit(&self) -> f64 {
        if self.scale == 0.0 { 1.0 } else { self.scale }
    }

    /// Returns true if E is shown, but for one part in 10⁹ of it.
    pub fn holds(&self) -> bool {
        self.bound() <= self.claimed * (1.0 + 1e-9)
    }

    /// Returns true if the tolerance is shown.
    pub fn is_shown(&self) -> bool {
        let is_none = self.claimed == 0.0 && !self.holds();
        !is_none && self.bound() <= self.tolerated
    }
}

pub(crate) struct Subject<'s> {
    pub(crate) setting: &'s Setting<'s>,
    pub(crate) function: &'s Function,
    pub(crate) exact: &'s Program<Exact>,
    pub(crate) emitted: &'s Program<Exact>,
    pub(crate) read: &'s read::Function,
    pub(crate) is_single: bool,
    pub(crate) own: &'s Tolerated,
    /// The tolerance of each joint, relative to T.
    pub(crate) tolerance: &'s [f64],
    pub(crate) work: &'s Work,
}

/// A result: its field and its joints, of a torque its own, of an entry of D two.
type Entry<'s> = (&'s Field, Vec<usize>);

impl Subject<'_> {
    pub(crate) fn bounded(&self) -> Result<Vec<Bounded>, Fault> {
        let (own, count) = (self.own, self.emitted.outputs.len());
        let errors = if self.is_single { &own.f32 } else { &own.f64 };
        let is_error = |error: &f64| (0.0..1.0).contains(error);
        unless(
            errors.len() == count && errors.iter().all(is_error),
            "expected E of each result, from zero to below one",
        )?;
        unless(
            own.scales.len() == count && own.scales.iter().all(|own| *own >= 0.0),
            "expected T of each result",
        )?;
        unless(
            self.exact.outputs.len() == count,
            "two programs of other results",
        )?;
        let fields = self.results();
        unless(fields.len() == count, "results that are not the function's")?;
        let [ranges, file] = &self.ranges()?;
        if (self.exact.steps.len() + count) * count > MOST_EVALUATED {
            return Err(Fault::Work);
        }
        let most = self.attainable(&fields, file)?;
        let work = self.work;
        let ring = Ring::new(self.setting, ranges, work)?;
        let rounding = Rounding::new(self.read, self.is_single, ranges);
        let (mut sizes, emitted) = written(self.emitted, &ring, Some(&rounding), work)?;
        let (_, exact) = written(self.exact, &ring, None, work)?;
        sizes.iter_mut().for_each(|size| *size *= SLACK);
        let rounding = rounding.bounds(ranges, Some(&sizes)).results;
        let largest = own.scales.iter().copied().fold(0.0, f64::max);
        let mut found = Vec::new();
        for (k, (_, joints)) in fields.into_iter().enumerate() {
            let scale = own.scales[k];
            let rounding = match self.is_literal(k) {
                true => 0.0,
                false => rounding[k].error,
            };
            let is_nothing = scale == 0.0 && most[k] == 0.0;
            // Of a result that is not always zero there is a state where it is not.
            let is_zero = exact[k].terms.is_empty() && exact[k].rest == 0.0;
            unless(
                !is_nothing || is_zero,
                "T of zero of a result that is not always zero",
            )?;
            let (claimed, tolerated) = match is_nothing {
                true => (ZERO * largest, ZERO * largest),
                false => (
                    below(errors[k] * scale),
                    below(self.held(&joints) * scale.min(most[k])),
                ),
            };
            let difference = emitted[k].plus(&exact[k].negated());
            let wanted = (claimed - rounding).next_down().next_down();
            found.push(Bounded {
                joints,
                scale,
                real: maximum::largest(&difference, &ring, wanted, work).bound,
                rounding,
                claimed,
                tolerated,
            });
        }
        self.tried(&found, ranges)?;
        Ok(found)
    }

    fn is_literal(&self, result: usize) -> bool {
        let text = self.read.program.outputs.get(result);
        match (text, self.emitted.outputs.get(result)) {
            (Some((_, Operand::Constant(own))), Some((_, Operand::Constant(exact)))) => {
                exact.double() == Some([*own, 0.0])
            }
            _ => false,
        }
    }

    /// Refuses an E that is not shown where a state of the box refutes it.
    fn tried(&self, found: &[Bounded], ranges: &Ranges) -> Result<(), Fault> {
        if found.iter().all(Bounded::holds) {
            return Ok(());
        }
        let mut draws = Draws::new(&["states"]);
        for count in 0..STATES {
            let mut point = |[low, high]: &[f64; 2]| {
                let share = draws.share();
                // Of every second state all are ends of their ranges.
                low + (high - low) * if count % 2 == 0 { share } else { share.round() }
            };
            let lists = ranges.iter();
            let given = lists.map(|list| list.iter().map(&mut point).collect());
            let given: Vec<Vec<f64>> = given.collect();
            let both = [self.emitted, self.exact].map(|own| at(own, &given).unwrap_or_default());
            for (k, (a, b)) in both[0].iter().zip(&both[1]).enumerate() {
                let off = *a + -*b;
                let is_refuted = off.low.max(-off.high) > found[k].claimed;
                let why = format!("E of result {} is refuted at a state", k + 1);
                unless(!is_refuted, &why)?;
            }
        }
        Ok(())
    }

    fn results(&self) -> Vec<Entry<'_>> {
        let mut all = Vec::new();
        for field in &self.function.fields {
            let lengths = field.lengths(self.setting, 0);
            for index in 0..lengths.iter().product::<usize>() {
                let (mut left, mut joints) = (index, Vec::new());
                for (axis, length) in field.axes.bytes().zip(&lengths).rev() {
                    joints.extend((axis == b'n').then(|| self.setting.rows[left % length]));
                    left /= length;
                }
                joints.reverse();
                all.push((field, joints));
            }
        }
        all
    }

    /// Returns the tolerance of a result: of several joints, and of none, the strictest.
    fn held(&self, joints: &[usize]) -> f64 {
        let mut lists = [joints, &self.setting.rows].into_iter();
        let held = lists.find(|list| !list.is_empty());
        let is_held = |joint: &usize| held.is_none_or(|list| list.contains(joint));
        let each = (0..self.tolerance.len()).filter(is_held);
        let each = each.map(|joint| self.tolerance[joint]);
        each.fold(f64::INFINITY, f64::min)
    }

    /// Returns the box of the claim, once it has all states of the file's, and that one; no ranges
    /// of what is no argument. Refuses a joint that the file does not limit.
    fn ranges(&self) -> Result<[Ranges; 2], Fault> {
        let places = &self.function.arguments;
        let is_bounded = places.iter().all(|place| *place < 3);
        unless(is_bounded, "an argument that no box bounds")?;
        let of_robot = |why: String| Fault::Robot("limits".into(), why);
        let none: Ranges = vec![Vec::new(); ARGUMENTS.len()];
        let (mut all, mut file) = (none.clone(), none);
        for place in 0..3 {
            if !places.contains(&place) {
                all[place].resize(self.setting.joints(), [0.0; 2]);
                continue;
            }
            let name = ARGUMENTS[place].0;
            let own = self.setting.ranges(name, f64::INFINITY).map_err(of_robot)?;
            let own = own.unwrap_or_default();
            if !own.iter().flatten().all(|end| end.is_finite()) {
                let why = format!("a tolerance needs the range of `{name}` of every joint");
                return Err(of_robot(why));
            }
            let claimed = &self.own.ranges[place];
            let is_range =
                |own: &[f64; 2]| own[0] <= own[1] && own.iter().all(|end| end.abs() < 1e30);
            let is_finite = claimed.iter().all(is_range);
            let mut pairs = own.iter().zip(claimed);
            let has_all = claimed.len() == own.len()
                && pairs.all(|(own, claimed)| is_within(*own, *claimed, *own));
            unless(
                is_finite && has_all,
                "the box lacks states of the scene, or of the joints' limits",
            )?;
            all[place].clone_from(claimed);
            file[place] = own;
        }
        let is_far = |(joint, range): (usize, &[f64; 2])| {
            self.setting.turns_by(joint) && range.iter().any(|end| end.abs() >= FARTHEST)
        };
        let is_near = !all[0].iter().enumerate().any(is_far);
        unless(is_near, "the sine of an angle beyond 1000 rad")?;
        Ok([all, file])
    }

    /// Refuses a T above the largest of each result: E would look smaller than it is.
    fn attainable(&self, results: &[Entry], file: &Ranges) -> Result<Vec<f64>, Fault> {
        let most = match self.own.relative_to.as_str() {
            "actuator" => self.actuator(results)?,
            "range" => self.reached(file)?,
            _ => {
                let why = "tolerance: `relative_to` is neither actuator nor range";
                return Err(Fault::Claim(why.into()));
            }
        };
        for (scale, most) in self.own.scales.iter().zip(&most) {
            let is_reached = *scale <= most * (1.0 + SCALE_SLACK) || *scale == 0.0;
            let why = format!("T of {scale:e} is above {most:e}, the largest that is reached");
            unless(is_reached, &why)?;
        }
        Ok(most)
    }

    /// Returns the limits of the actuators; of an entry of D the inertia that takes all of a limit at
    /// the largest acceleration, of h_ikm the coefficient at the largest velocities.
    fn actuator(&self, results: &[Entry]) -> Result<Vec<f64>, Fault> {
        let limit = |joint: usize, name: &str| {
            let own = self.setting.limit(joint, name).filter(|own| *own > 0.0);
            own.unwrap_or(f64::NAN)
        };
        let torque = |joint: usize| limit(joint, "torque");
        let inertia = |i: usize, k: usize| torque(i) / limit(k, "acceleration");
        let measure = |(field, joints): &Entry| match *joints.as_slice() {
            _ if !field.is_measured() => None,
            [i] => Some(torque(i)),
            [i, k] => Some(inertia(i, k).min(inertia(k, i))),
            [i, k, m] => Some(torque(i) / (limit(k, "velocity") * limit(m, "velocity"))),
            _ => None,
        };
        let own = results.iter().map(measure).collect::<Option<_>>();
        let why = "the actuators' limits are no measure of this function";
        own.ok_or_else(|| Fault::Claim(why.into()))
    }

    fn reached(&self, file: &Ranges) -> Result<Vec<f64>, Fault> {
        let (states, count) = (&self.own.reached, self.setting.joints());
        let places = &self.function.arguments;
        let wrong = "`reached`: expected a state of the box for each result";
        unless(states.len() == self.exact.outputs.len(), wrong)?;
        let least = |(result, state): (usize, &Vec<f64>)| {
            let mut given = vec![Vec::new(); 3];
            for (place, list) in places.iter().zip(state.chunks(count.max(1))) {
                given[*place] = list.to_vec();
            }
            let is_whole = state.len() == count * places.len();
            let mut pairs = given.iter().flatten().zip(file.iter().flatten());
            let is_inside = pairs.all(|(at, own)| is_within([*at; 2], *own, *own));
            unless(is_whole && is_inside, wrong)?;
            let values = at(self.exact, &given).unwrap_or_default();
            let found = values.get(result);
            let found = found.ok_or_else(|| Fault::Claim(wrong.into()))?;
            Ok(found.low.max(-found.high).max(0.0))
        };
        states.iter().enumerate().map(least).collect()
    }
}

/// Returns true if a range is within another one, but for what decimals of the file's may be in
/// doubles: of a point by their least.
fn is_within([low, high]: [f64; 2], outer: [f64; 2], file: [f64; 2]) -> bool {
    let slack = BOX_SLACK * (file[0].abs() + file[1].abs()) + f64::MIN_POSITIVE;
    outer[0] - slack <= low && high <= outer[1] + slack
}

fn unless(holds: bool, why: &str) -> Result<(), Fault> {
    holds
        .then_some(())
        .ok_or_else(|| Fault::Claim(format!("tolerance: {why}")))
}

/// Returns a number that a rounded one is not below; zero is exact.
fn below(value: f64) -> f64 {
    match value > 0.0 {
        true => value.next_down(),
        false => value,
    }
}
