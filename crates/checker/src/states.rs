//! States at which a function is tried: special ones, random ones, and where climbs end.

use crate::fault::Fault;
use crate::identity::number::Draws;
use crate::payload::BodyRange;
use crate::program::{ARGUMENTS, GRAVITY, argument};
use crate::rounding::Ranges;
use crate::sample::{FloatState, LANES};

/// One state in so many has nothing but zeros, ends and middles of ranges, and quarter turns.
const SPECIAL: usize = 5;
/// The parts of a range by which a climb goes on, those of a row at once.
const STRIDES: [[f64; LANES]; 2] = [[-0.2, 0.2, -0.05, 0.05], [-0.05, 0.05, -0.01, 0.01]];

pub(crate) struct States<'s> {
    pub ranges: &'s Ranges,
    /// The places of the arguments that are read.
    pub places: &'s [usize],
    /// The bodies that each argument is of: a payload, and those of links.
    pub bodies: &'s [(usize, Vec<BodyRange>)],
    /// The squares of the speeds over which friction of joints is smoothed: near to these it bends.
    pub widths: &'s [(usize, f64)],
    pub draws: Draws,
    pub is_single: bool,
    /// The number of states that were drawn.
    pub count: usize,
}

impl States<'_> {
    /// Draws the next state: at zero, in the middle, at the lower and the upper ends of all ranges,
    /// then special ones among random ones.
    pub(crate) fn next(&mut self) -> FloatState {
        let mut state = vec![Vec::new(); ARGUMENTS.len()];
        let count = self.count;
        self.count += 1;
        for &place in self.places {
            let Some(list) = self.ranges.get(place) else {
                continue;
            };
            let of_bodies = self.bodies.iter().find(|(argument, _)| *argument == place);
            state[place] = match of_bodies {
                Some((_, bodies)) => {
                    let draw = |body: &BodyRange| body.draw(&mut || self.draws.share());
                    bodies.iter().flat_map(draw).collect()
                }
                None => (list.iter().enumerate().map(|(index, range)| match count {
                    0 => 0f64.clamp(range[0], range[1]),
                    1 => 0.5 * (range[0] + range[1]),
                    2 => range[0],
                    3 => range[1],
                    _ if count.is_multiple_of(SPECIAL) => self.special(place, index, *range),
                    _ => range[0] + (range[1] - range[0]) * self.draws.share(),
                }))
                .collect(),
            };
        }
        self.rounded(state)
    }

    fn special(&mut self, place: usize, index: usize, [low, high]: [f64; 2]) -> f64 {
        let middle = 0.5 * (low + high);
        let mut candidates = vec![0f64.clamp(low, high), low, high, middle];
        if place == 0 {
            let quarters = [-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0];
            let turns = quarters.map(|quarter| quarter * std::f64::consts::FRAC_PI_2);
            candidates.extend(turns.into_iter().filter(|turn| (low..=high).contains(turn)));
        }
        if let (1, Some((_, square))) = (place, self.widths.iter().find(|entry| entry.0 == index)) {
            let width = square.sqrt();
            let bends = [-width, -0.5 * width, 0.5 * width, width];
            candidates.extend(bends.into_iter().filter(|bend| (low..=high).contains(bend)));
        }
        let index = (self.draws.share() * candidates.len() as f64) as usize;
        candidates[index.min(candidates.len() - 1)]
    }

    fn rounded(&self, mut state: FloatState) -> FloatState {
        if let Some(place) = argument(GRAVITY) {
            // The ends of its ranges are those of a ball.
            let ends = self.ranges.get(place).into_iter().flatten();
            let most = ends.fold(0.0, |most: f64, range| most.max(range[1]));
            let length = state[place].iter().map(|x| x * x).sum::<f64>().sqrt();
            if length > most {
                state[place]
                    .iter_mut()
                    .for_each(|entry| *entry *= most / length);
            }
        }
        if self.is_single {
            let entries = state.iter_mut().flatten();
            entries.for_each(|entry| *entry = f64::from(*entry as f32));
        }
        state
    }

    /// Climbs from a state, and its height, to where something is larger, entry by entry, with so
    /// many tries. A body stays as it is.
    pub(crate) fn climb(
        &self,
        (mut highest, mut state): (f64, FloatState),
        mut tries: usize,
        mut heights: impl FnMut([&FloatState; LANES]) -> Result<[f64; LANES], Fault>,
    ) -> Result<(), Fault> {
        let is_body = |place: &usize| self.bodies.iter().any(|(argument, _)| argument == place);
        for ways in STRIDES {
            let mut has_moved = true;
            while has_moved {
                has_moved = false;
                for &place in self.places.iter().filter(|place| !is_body(place)) {
                    for index in 0..state[place].len() {
                        let Some([low, high]) = self.ranges[place].get(index).copied() else {
                            continue;
                        };
                        if tries < LANES {
                            return Ok(());
                        }
                        tries -= LANES;
                        let neighbours = ways.map(|way| {
                            let mut next = state.clone();
                            let entry = &mut next[place][index];
                            *entry = (*entry + way * (high - low)).clamp(low, high);
                            self.rounded(next)
                        });
                        let reached = heights(neighbours.each_ref())?;
                        for (height, next) in reached.into_iter().zip(neighbours) {
                            if height > highest {
                                (state, highest, has_moved) = (next, height, true);
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
