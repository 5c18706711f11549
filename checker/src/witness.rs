//! States at which outputs are large: witnesses that a scale is reached.
//!
//! The search is in doubles, one coordinate after the other; only the value at its best
//! state, with a bound of what rounding costs, is relied on.

use crate::certificate::Claim;
use crate::dynamics::State;
use crate::fault::Fault;
use crate::number::Work;
use crate::polynomial::Polynomial;
use crate::program::Program;
use crate::sample::{self, Random, held, run, states};
use crate::scene::Setting;

/// How many climbs start anywhere, and how many more near the best state.
const CLIMBS: usize = 24;
const HOPS: usize = 240;
/// The most rounds of all coordinates, and the gain below which there are no more.
const ROUNDS: usize = 60;
const GAIN: f64 = 1e-9;
/// In how many places a range is looked at, and what is near, as a share of it.
const PLACES: usize = 12;
const NEAR: f64 = 1e-3;

/// A state: positions, velocities and accelerations.
type At = [Vec<f64>; 3];

/// Numbers at most the largest magnitude of each output over the setting's own box,
/// looked for until the scale of each is reached.
///
/// # Errors
/// As of [`crate::dynamics::torques`].
pub fn reached(claim: &Claim, setting: &Setting) -> Result<Vec<f64>, Fault> {
    let one = |(output, scale): (usize, &f64)| {
        let value = |at: &At| Ok(values(claim, setting, at)?[output]);
        let sure = |at: At| Ok((least(claim, setting, output, &at)?, at));
        search(setting, HOPS, scale * (1.0 - 1e-6), &value, &sure)
    };
    claim.scale.iter().enumerate().map(one).collect()
}

/// The largest error of an output that is found, looked for until one is above
/// what is claimed: it then refutes the claim.
///
/// # Errors
/// As of [`crate::dynamics::torques`].
pub fn error(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    (output, claimed): (usize, f64),
) -> Result<f64, Fault> {
    let is_single = claim.scalar == "f32";
    let value = |at: &At| {
        let off = run(program, at, is_single)[output] - values(claim, setting, at)?[output];
        Ok(if off.is_finite() { off } else { f64::MAX })
    };
    let sure = |mut at: At| {
        for (list, ranges) in at.iter_mut().zip(&setting.ranges) {
            for (value, range) in list.iter_mut().zip(ranges) {
                *value = held(*value, ends(*range), is_single);
            }
        }
        let seen = sample::at(claim, setting, program, &at, &mut Work::default())?;
        Ok((seen[output].off, at))
    };
    search(setting, 0, claimed, &value, &sure)
}

/// The largest of what is sure at states where a value is large, until it is above another.
fn search(
    setting: &Setting,
    hops: usize,
    enough: f64,
    value: &dyn Fn(&At) -> Result<f64, Fault>,
    sure: &dyn Fn(At) -> Result<(f64, At), Fault>,
) -> Result<f64, Fault> {
    let mut random = Random(2);
    let (mut most, mut best) = (0.0f64, drawn(setting, &mut random, false));
    for attempt in 0..CLIMBS + hops {
        let mut at = match attempt < CLIMBS {
            true => drawn(setting, &mut random, attempt % 2 == 0),
            false => hopped(&best, setting, &mut random),
        };
        climb(setting, &mut at, value)?;
        let (found, at) = sure(at)?;
        if found > most {
            (most, best) = (found, at);
        }
        if most > enough {
            break;
        }
    }
    Ok(most)
}

/// A state of the box, or one at its corners.
fn drawn(setting: &Setting, random: &mut Random, is_corner: bool) -> At {
    setting.ranges.each_ref().map(|list| {
        let draw = |range: &[f64; 2]| {
            let [low, high] = ends(*range);
            let share = random.next();
            low + (high - low) * if is_corner { share.round() } else { share }
        };
        list.iter().map(draw).collect()
    })
}

/// A state with some of its coordinates drawn anew.
fn hopped(from: &At, setting: &Setting, random: &mut Random) -> At {
    let mut at = from.clone();
    for _ in 0..3 {
        let mut pick = |count: usize| ((random.next() * count as f64) as usize).min(count - 1);
        let (which, joint) = (pick(3), pick(setting.joints.len()));
        let [low, high] = ends(setting.ranges[which][joint]);
        let share = random.next();
        at[which][joint] = low + (high - low) * if which > 0 { share.round() } else { share };
    }
    at
}

/// A range, of what has none a point.
fn ends([low, high]: [f64; 2]) -> [f64; 2] {
    if low <= high { [low, high] } else { [0.0; 2] }
}

fn values(claim: &Claim, setting: &Setting, at: &At) -> Result<Vec<f64>, Fault> {
    let states = states::<f64>(setting, at);
    let (rows, work) = (claim.rows(), &mut Work::default());
    claim.function()?.outputs(setting, &states, &rows, work)
}

/// Returns a lower bound of an output's magnitude at a state.
fn least(claim: &Claim, setting: &Setting, output: usize, at: &At) -> Result<f64, Fault> {
    let states: Vec<State<Polynomial>> = states(setting, at);
    let (rows, work) = (claim.rows(), &mut Work::default());
    let all = claim.function()?.outputs(setting, &states, &rows, work)?;
    let value = all[output].terms.first().map_or(0.0, |term| term.1.abs());
    Ok((value - all[output].rest).next_down())
}

/// Moves a state to where a value is larger, one coordinate after the other.
fn climb(
    setting: &Setting,
    at: &mut At,
    value: &dyn Fn(&At) -> Result<f64, Fault>,
) -> Result<(), Fault> {
    let mut own = value(at)?;
    for round in 0..ROUNDS {
        let before = own;
        for (which, joint) in (0..3).flat_map(|w| (0..setting.joints.len()).map(move |j| (w, j))) {
            let [low, high] = ends(setting.ranges[which][joint]);
            if !(low < high) {
                continue;
            }
            let (mut kept, length) = (at[which][joint], high - low);
            let mut tried: Vec<f64> = Vec::new();
            if round < 2 {
                let share = |place: usize| place as f64 / PLACES as f64;
                tried.extend((0..=PLACES).map(|place| low + length * share(place)));
            } else {
                // Where a parabola through three values nearby is largest.
                let mut found = [0.0; 3];
                for (found, step) in found.iter_mut().zip([-NEAR, 0.0, NEAR]) {
                    at[which][joint] = kept + step * length;
                    *found = value(at)?;
                }
                let [a, b, c] = found;
                tried.push(kept - 0.5 * NEAR * length * (c - a) / (a + c - 2.0 * b));
            }
            for one in tried.into_iter().filter(|one| one.is_finite()) {
                at[which][joint] = one.clamp(low, high);
                let moved = value(at)?;
                if moved.abs() > own.abs() {
                    (own, kept) = (moved, at[which][joint]);
                }
            }
            at[which][joint] = kept;
        }
        if round > 1 && own.abs() <= before.abs() * (1.0 + GAIN) {
            break;
        }
    }
    Ok(())
}
