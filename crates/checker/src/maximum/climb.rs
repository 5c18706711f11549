//! Climbs to large F from fixed starts, angle by angle.

use std::f64::consts::PI;

use super::search::{Level, Search};

const SEED: u64 = 0x9d1d;
/// The first and the last stride of a climb, and the factor between two.
const STRIDES: [f64; 2] = [0.7, 1e-3];
const SHORTER: f64 = 0.4;

impl Search {
    /// Returns the largest F that climbs from so many starts reach.
    pub(super) fn climb(&mut self, starts: usize) -> f64 {
        let ranges: Vec<[f64; 2]> = self.ranges();
        let mut seed = SEED;
        let mut best = 0.0f64;
        let mut top = Vec::new();
        for _ in 0..starts {
            let draw = |[low, high]: &[f64; 2]| low + (high - low) * next(&mut seed);
            let height = self.climb_from(ranges.iter().map(draw).collect());
            if height >= best {
                best = height;
                top.clone_from(&self.top);
            }
        }
        self.top = top;
        best
    }

    /// Climbs on from where a bound was refuted.
    pub(super) fn climb_on(&mut self) -> f64 {
        self.climb_from(self.above.clone())
    }

    pub(super) fn ranges(&self) -> Vec<[f64; 2]> {
        let range = |level: &Level| level.range.unwrap_or([-PI, PI]);
        self.levels.iter().map(range).collect()
    }

    /// Returns F less what doubles may lose, with the angles from a level on put in anew.
    fn height(&mut self, angles: &[f64], from: usize) -> f64 {
        for (level, angle) in angles.iter().enumerate().skip(from) {
            self.fix(level, *angle);
        }
        self.worst() - 2.0 * self.slack
    }

    fn climb_from(&mut self, mut angles: Vec<f64>) -> f64 {
        let count = self.levels.len();
        let mut highest = self.height(&angles, 0);
        let [mut stride, last] = STRIDES;
        // The levels below are as the angles are.
        let mut known = count;
        while stride > last && self.steps > 0 {
            let mut has_moved = false;
            for level in 0..count {
                for way in [-stride, stride] {
                    let before = angles[level];
                    let next = before + way;
                    angles[level] = match self.levels[level].range {
                        Some([low, high]) => next.clamp(low, high),
                        None => next,
                    };
                    let height = self.height(&angles, known.min(level));
                    if height > highest {
                        (highest, has_moved, known) = (height, true, count);
                    } else {
                        (angles[level], known) = (before, level);
                    }
                }
            }
            if !has_moved {
                stride *= SHORTER;
            }
        }
        self.top = angles;
        highest.max(0.0)
    }
}

/// Draws the next number from zero to one, by the upper 53 bits.
pub(super) fn next(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005);
    *seed = seed.wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}
