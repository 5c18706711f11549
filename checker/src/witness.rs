//! States at which outputs are large: witnesses that a scale is reached.
//!
//! Coordinate by coordinate an output is a polynomial of degree two in a rate or a
//! position, a trigonometric one of degree two in an angle: a few values say where it is
//! largest. The search is in doubles; only the value at its best state, with a bound of
//! what rounding costs, is relied on.

use std::f64::consts::TAU;

use crate::certificate::Claim;
use crate::dynamics::State;
use crate::fault::Fault;
use crate::interval::sin_cos;
use crate::polynomial::{Polynomial, Work};
use crate::sample::{Random, states};
use crate::scene::Setting;

/// At how many states the search looks before it climbs, and from how many it climbs.
const STATES: usize = 2048;
const CLIMBS: usize = 16;
/// The number of further climbs that start near the best state.
const HOPS: usize = 240;
/// The most rounds of all coordinates, and the gain below which there are no more.
const ROUNDS: usize = 60;
const GAIN: f64 = 1e-9;
/// In how many places an angle's range is looked at.
const PLACES: usize = 48;

/// Numbers at most the largest magnitude of each output over the setting's own box,
/// looked for until the scale of each is reached.
///
/// # Errors
/// As of [`crate::dynamics::torques`].
pub fn reached(claim: &Claim, setting: &Setting) -> Result<Vec<f64>, Fault> {
    let count = claim.scale.len();
    let mut random = Random(2);
    let mut best: Vec<Vec<(f64, [Vec<f64>; 3])>> = vec![Vec::new(); count];
    for index in 0..STATES {
        let at = setting.ranges.each_ref().map(|list| {
            let draw = |range: &[f64; 2]| {
                let [low, high] = ends(*range);
                let share = random.next();
                let share = if index % 2 == 0 { share.round() } else { share };
                low + (high - low) * share
            };
            list.iter().map(draw).collect::<Vec<f64>>()
        });
        for (list, value) in best.iter_mut().zip(values(claim, setting, &at)?) {
            let value = if value.is_finite() { value } else { 0.0 };
            let place = list.partition_point(|(before, _)| *before >= value.abs());
            if place < CLIMBS {
                list.insert(place, (value.abs(), at.clone()));
                list.truncate(CLIMBS);
            }
        }
    }
    let mut reached = Vec::new();
    for (output, list) in best.into_iter().enumerate() {
        let mut top = (
            0.0f64,
            setting.ranges.clone().map(|list| vec![0.0; list.len()]),
        );
        for attempt in 0..CLIMBS + HOPS {
            let mut at = match list.get(attempt) {
                Some((_, at)) => at.clone(),
                None => hopped(&top.1, setting, &mut random),
            };
            climb(claim, setting, output, &mut at)?;
            let value = least(claim, setting, output, &at)?;
            if value > top.0 {
                top = (value, at);
            }
            if top.0 >= claim.scale[output] {
                break;
            }
        }
        reached.push(top.0);
    }
    Ok(reached)
}

/// A state with some of its coordinates drawn anew.
fn hopped(from: &[Vec<f64>; 3], setting: &Setting, random: &mut Random) -> [Vec<f64>; 3] {
    let mut at = from.clone();
    let joints = setting.joints.len() as f64;
    for _ in 0..3 {
        let (which, joint) = (
            (random.next() * 3.0) as usize,
            (random.next() * joints) as usize,
        );
        let [low, high] = ends(setting.ranges[which.min(2)][joint.min(setting.joints.len() - 1)]);
        let share = random.next();
        let share = if which > 0 { share.round() } else { share };
        at[which.min(2)][joint.min(setting.joints.len() - 1)] = low + (high - low) * share;
    }
    at
}

/// A range, of what has none a point.
fn ends([low, high]: [f64; 2]) -> [f64; 2] {
    if low <= high { [low, high] } else { [0.0; 2] }
}

fn values(claim: &Claim, setting: &Setting, at: &[Vec<f64>; 3]) -> Result<Vec<f64>, Fault> {
    let states = states::<f64>(setting, at);
    let (rows, work) = (claim.rows(), &mut Work::default());
    claim.function()?.outputs(setting, &states, &rows, work)
}

/// Returns a lower bound of an output's magnitude at a state.
fn least(
    claim: &Claim,
    setting: &Setting,
    output: usize,
    at: &[Vec<f64>; 3],
) -> Result<f64, Fault> {
    let states: Vec<State<Polynomial>> = states(setting, at);
    let (rows, work) = (claim.rows(), &mut Work::default());
    let all = claim.function()?.outputs(setting, &states, &rows, work)?;
    let value = all[output].terms.first().map_or(0.0, |term| term.1.abs());
    Ok((value - all[output].rest).next_down())
}

/// Moves a state to where an output is larger, one coordinate after the other.
fn climb(
    claim: &Claim,
    setting: &Setting,
    output: usize,
    at: &mut [Vec<f64>; 3],
) -> Result<(), Fault> {
    let mut own = values(claim, setting, at)?[output];
    for _ in 0..ROUNDS {
        let before = own;
        for (which, joint) in (0..3).flat_map(|w| (0..setting.joints.len()).map(move |j| (w, j))) {
            let [low, high] = ends(setting.ranges[which][joint]);
            if !(low < high) {
                continue;
            }
            let is_angle = which == 0 && setting.joints[joint].turns;
            let kept = at[which][joint];
            let samples: Vec<f64> = match is_angle {
                true => (0..5).map(|k| kept + TAU / 5.0 * f64::from(k)).collect(),
                false => vec![low, 0.5 * low + 0.5 * high, high],
            };
            let mut found = Vec::new();
            for &sample in &samples {
                at[which][joint] = sample;
                found.push(values(claim, setting, at)?[output]);
            }
            let place = match is_angle {
                true => turned(&found, kept, [low, high], own),
                false => parabola(&found, [low, high], own),
            };
            at[which][joint] = place;
            let value = values(claim, setting, at)?[output];
            match value.abs() > own.abs() {
                true => own = value,
                false => at[which][joint] = kept,
            }
        }
        if own.abs() <= before.abs() * (1.0 + GAIN) {
            break;
        }
    }
    Ok(())
}

/// Where a parabola with these values at both ends and between them is largest, of the
/// sign of another value.
fn parabola(found: &[f64], [low, high]: [f64; 2], sign: f64) -> f64 {
    let &[first, middle, last] = found else {
        return low;
    };
    let curve = first + last - 2.0 * middle;
    let vertex = -0.5 * (last - first) / (2.0 * curve);
    let at = |share: f64| middle + (last - first) * share + 2.0 * curve * share * share;
    // Shares go from −½ to ½ of the range.
    let shares = [-0.5, vertex.clamp(-0.5, 0.5), 0.5];
    let mut best = (f64::NEG_INFINITY, -0.5);
    for share in shares.into_iter().filter(|share| share.is_finite()) {
        let value = at(share) * sign.signum();
        if value > best.0 {
            best = (value, share);
        }
    }
    (0.5 * low + 0.5 * high + (high - low) * best.1).clamp(low, high)
}

/// The same of a sum of two harmonics with these values at five places of a turn.
fn turned(found: &[f64], from: f64, [low, high]: [f64; 2], sign: f64) -> f64 {
    let wave = |n: f64, shift: f64| -> f64 {
        let terms = found.iter().enumerate();
        let terms = terms.map(|(k, value)| value * sin_cos(n * TAU / 5.0 * k as f64 + shift).0);
        0.4 * terms.sum::<f64>()
    };
    let quarter = 0.25 * TAU;
    let harmonics = [1.0, 2.0].map(|n| (n, wave(n, 0.0), wave(n, quarter)));
    let at = |angle: f64| {
        let of = |&(n, sin, cos): &(f64, f64, f64)| {
            let (s, c) = sin_cos(n * (angle - from));
            sin * s + cos * c
        };
        harmonics.iter().map(of).sum::<f64>() * sign.signum()
    };
    let mut step = (high - low) / PLACES as f64;
    let mut best = low;
    for k in 1..=PLACES {
        let angle = (low + step * k as f64).min(high);
        if at(angle) > at(best) {
            best = angle;
        }
    }
    while step > 1e-9 {
        step *= 0.5;
        for angle in [best - step, best + step] {
            if (low..=high).contains(&angle) && at(angle) > at(best) {
                best = angle;
            }
        }
    }
    best
}
