//! States at which outputs are large: witnesses that a scale is reached.
//!
//! The search is in doubles, one coordinate after the other; only the value at its best
//! state, with a bound of what rounding costs, is relied on.

use crate::certificate::Claim;
use crate::fault::Fault;
use crate::number::Work;
use crate::polynomial::Polynomial;
use crate::program::Program;
use crate::sample::{At, Random, ends, outputs, run, seen};
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

/// Numbers at most the largest magnitude of each output over the setting's own box,
/// looked for until the scale of each is reached.
///
/// # Errors
/// As of [`crate::dynamics::torques`].
pub fn reached(claim: &Claim, setting: &Setting, work: &mut Work) -> Result<Vec<f64>, Fault> {
    let one = |(output, scale): (usize, &f64)| {
        let mut value = |at: &At| Ok(outputs::<f64>(claim, setting, at, work)?[output]);
        let sure = |at: At| {
            let work = &mut Work::default();
            let found = &outputs::<Polynomial>(claim, setting, &at, work)?[output];
            Ok(((found.value().abs() - found.rest).next_down(), at))
        };
        search(setting, HOPS, scale * (1.0 - 1e-6), &mut value, &sure)
    };
    claim.scale.iter().enumerate().map(one).collect()
}

/// Returns the largest error of an output that is found, looked for until one is above
/// what is claimed: it then refutes the claim.
///
/// # Errors
/// As of [`crate::dynamics::torques`].
pub fn error(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    (output, claimed): (usize, f64),
    work: &mut Work,
) -> Result<f64, Fault> {
    let is_single = claim.scalar == "f32";
    let mut value = |at: &At| {
        let own = outputs::<f64>(claim, setting, at, work)?[output];
        let off = run(program, at, is_single)[output] - own;
        Ok(if off.is_finite() { off } else { f64::MAX })
    };
    let sure = |at: At| {
        let (seen, at) = seen(claim, setting, program, at)?;
        Ok((seen[output].off, at))
    };
    search(setting, 0, claimed, &mut value, &sure)
}

/// Returns the largest of what is sure at states where a value is large, until it is above another
/// or the work is spent.
fn search(
    setting: &Setting,
    hops: usize,
    enough: f64,
    value: &mut dyn FnMut(&At) -> Result<f64, Fault>,
    sure: &dyn Fn(At) -> Result<(f64, At), Fault>,
) -> Result<f64, Fault> {
    let mut random = Random(2);
    let (mut most, mut best) = (0.0f64, random.state(setting, [false; 3]));
    for attempt in 0..CLIMBS + hops {
        let mut at = match attempt < CLIMBS {
            true => random.state(setting, [attempt % 2 == 0; 3]),
            false => hopped(&best, setting, &mut random),
        };
        match climb(setting, &mut at, value) {
            Err(Fault::Work) => break,
            climbed => climbed?,
        }
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

/// Returns a state with some of its coordinates drawn anew.
fn hopped(from: &At, setting: &Setting, random: &mut Random) -> At {
    let mut at = from.clone();
    for _ in 0..3 {
        let mut pick = |count: usize| ((random.next() * count as f64) as usize).min(count - 1);
        let (which, joint) = (pick(3), pick(setting.joints.len()));
        at[which][joint] = random.within(setting.ranges[which][joint], which > 0);
    }
    at
}

/// Moves a state to where a value is larger, one coordinate after the other.
fn climb(
    setting: &Setting,
    at: &mut At,
    value: &mut dyn FnMut(&At) -> Result<f64, Fault>,
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
