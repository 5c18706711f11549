//! States that try to break a bound: corners, random states, hill climbing.

use super::input_box::InputBox;
use crate::function::Argument;
use crate::random::Random;
use crate::sincos::interval::Interval;
use crate::states::JointState;

/// Returns a state of the box: each coordinate at an end, in the middle or anywhere.
/// Errors are largest at the ends of the rates far more often than inside.
pub fn draw(limits: &InputBox, random: &mut Random) -> JointState {
    let corners = random.below(4) > 0;
    let mut entry = |argument, x: Interval| match argument {
        Argument::Position => match random.below(16) {
            0 => x.low(),
            1 => x.high(),
            2 => quarter(x, random),
            _ => inside(x, random.unit()),
        },
        _ => match random.below(8) {
            _ if !corners => inside(x, random.unit()),
            0 => x.mid(),
            k if k % 2 == 1 => x.low(),
            _ => x.high(),
        },
    };
    let mut state = JointState::new(|argument| {
        let ranges = limits.of_argument(argument).iter();
        ranges.map(|&range| entry(argument, range)).collect()
    });
    limits.hold(&mut state);
    if let Some(body) = limits.payload {
        state.payload = body.draw(&mut || random.unit());
    }
    state
}

fn quarter(x: Interval, random: &mut Random) -> f64 {
    let turns = random.below(5) as f64 - 2.0;
    (turns * std::f64::consts::FRAC_PI_2).clamp(x.low(), x.high())
}

fn inside(x: Interval, t: f64) -> f64 {
    (x.low() + (x.high() - x.low()) * t).clamp(x.low(), x.high())
}

/// Climbs from a state: one coordinate at a time to its ends or by a shrinking
/// step, as long as the error grows. Returns the state and its error.
pub fn climb(
    limits: &InputBox,
    from: JointState,
    moves: usize,
    random: &mut Random,
    error: &mut impl FnMut(&JointState) -> f64,
) -> (JointState, f64) {
    let (mut best, mut most) = (from.clone(), error(&from));
    let (n, entries) = (limits.joints(), limits.entries());
    let mut reach = 0.5;
    for step in 0..moves {
        let (argument, index) = entries[random.below(entries.len())];
        let range = limits.of_argument(argument)[index];
        let mut next = best.clone();
        let x = &mut next.entries_mut(argument)[index];
        *x = match random.below(4) {
            0 => range.low(),
            1 => range.high(),
            _ => *x + reach * range.width() * (random.unit() - 0.5),
        }
        .clamp(range.low(), range.high());
        limits.hold(&mut next);
        if next != best {
            let value = error(&next);
            if value > most {
                (best, most) = (next, value);
            }
        }
        if step % n.max(1) == 0 {
            reach *= 0.97;
        }
    }
    (best, most)
}
