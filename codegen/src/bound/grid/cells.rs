//! A bound shown cell by cell, angle after angle.

use std::f64::consts::PI;

use super::layout::{LANES, Layout};
use super::{FINEST, FIRST};
use crate::bound::input_box::InputBox;
use crate::bound::work;
use crate::interval::Interval;

/// Terms that are put together in about the time of a point.
const TERMS: usize = 64;

/// A bound where so many angles are put in, from the values there.
pub(super) type Crude<'a> = dyn Fn(usize, &[f64]) -> f64 + 'a;

/// A bound to show.
pub(super) struct Cells<'a> {
    pub layout: &'a Layout,
    /// Before each joint, and after the last: columns of values, of which the
    /// last one counts.
    buffers: Vec<Vec<f64>>,
    /// Whether the value at a point is at most a bound.
    accept: &'a dyn Fn(&[f64], f64) -> bool,
    /// What the maximum over the joints from a level on is at most, no angle
    /// looked at.
    pub crude: Option<&'a Crude<'a>>,
    /// Whether what is bounded is nowhere negative.
    pub is_positive: bool,
    /// F, if the box is a part of the circles.
    whole: Option<f64>,
    ranges: Vec<Interval>,
    /// Points that may still be tried.
    pub points: usize,
    /// Of the first angle's range, the part that was shown before the cell that was
    /// looked at last.
    pub reached: f64,
}

/// The part of a joint's range around an angle.
struct Cell {
    middle: f64,
    half: f64,
}

impl<'a> Cells<'a> {
    /// Makes the cells over the whole circles, or, given F of these, over the box.
    pub(super) fn new(
        layout: &'a Layout,
        limits: &InputBox,
        whole: Option<f64>,
        accept: &'a dyn Fn(&[f64], f64) -> bool,
    ) -> Cells<'a> {
        let mut buffers = vec![Vec::new(); layout.joints.len() + 1];
        buffers[0] = layout.coefficients.clone();
        Cells {
            layout,
            buffers,
            accept,
            crude: None,
            is_positive: false,
            whole,
            ranges: layout.joints.iter().map(|&j| limits.position[j]).collect(),
            points: 0,
            reached: 0.0,
        }
    }

    /// Returns the joint's range, unless it goes round.
    pub(super) fn part(&self, level: usize) -> Option<(Interval, f64)> {
        let whole = self.whole.filter(|_| self.layout.part[level])?;
        Some((self.ranges[level], whole))
    }

    /// Returns the values before a joint, those of the angles put in last.
    pub(super) fn values(&self, level: usize) -> &[f64] {
        let buffer = &self.buffers[level];
        &buffer[buffer.len() - self.layout.len(level)..]
    }

    /// Puts an angle in.
    pub(super) fn place(&mut self, level: usize, angle: f64) {
        self.buffers[level + 1].clear();
        self.fold(level, &[angle]);
    }

    fn fold(&mut self, level: usize, angles: &[f64]) {
        let len = self.layout.len(level);
        let (before, after) = self.buffers.split_at_mut(level + 1);
        let before = &before[level];
        let before = &before[before.len() - len..];
        self.layout.fold(level, angles, before, &mut after[0]);
    }

    /// Counts what takes about as long as a point as one.
    pub(super) fn charge(&mut self, level: usize) {
        let points = 1 + self.layout.len(level) / TERMS;
        work::count(points);
        self.points = self.points.saturating_sub(points);
    }

    /// Returns whether the maximum over the joints from `level` on is at most a bound:
    /// `true` is a proof.
    pub(super) fn below(&mut self, level: usize, bound: f64) -> bool {
        if level == self.layout.joints.len() {
            return (self.accept)(self.values(level), bound);
        }
        if let Some(crude) = self.crude
            && crude(level, self.values(level)) <= bound
        {
            return true;
        }
        if bound <= 0.0 || self.points == 0 {
            return false;
        }
        let degree = f64::from(self.layout.degrees[level]);
        let part = self.part(level);
        let (from, width) = match part {
            Some((range, _)) => {
                for end in [range.low(), range.high()] {
                    self.charge(level);
                    self.place(level, end);
                    if !self.below(level + 1, bound) {
                        return false;
                    }
                }
                (range.low(), range.width())
            }
            None => (0.0, 2.0 * PI),
        };
        let rounded = 4.0 * f64::EPSILON * (from.abs() + width);
        let count = FIRST * self.layout.degrees[level] as usize;
        let mut first = (0..count).map(|k| Cell {
            middle: from + width * (k as f64 + 0.5) / count as f64,
            half: 0.5 * width / count as f64,
        });
        // Cells whose angles were put in; the last one is next.
        let mut cells: Vec<Cell> = Vec::new();
        self.buffers[level + 1].clear();
        loop {
            if cells.is_empty() {
                cells.extend(first.by_ref().take(LANES));
                cells.reverse();
                self.fold_all(level, &cells);
            }
            let Some(Cell { middle, half }) = cells.pop() else {
                return true;
            };
            if level == 0 {
                self.reached = (middle - half - from) / width;
            }
            // Half widths and middles are rounded; a little more covers that.
            let reach = degree * (half * (1.0 + 1e-12) + rounded);
            let enough = match part {
                Some((_, whole)) => {
                    (bound - 0.5 * reach * reach * whole * (1.0 + 1e-12)).next_down()
                }
                None if self.is_positive => {
                    let cos = libm::cos(0.5 * reach);
                    (bound * (cos * cos - 1e-15)).next_down()
                }
                None => (bound * (libm::cos(reach) - 1e-15)).next_down(),
            };
            self.charge(level);
            let below = self.below(level + 1, enough);
            let rest = self.buffers[level + 1].len() - self.layout.len(level + 1);
            self.buffers[level + 1].truncate(rest);
            if !below {
                if reach <= FINEST || self.points == 0 {
                    return false;
                }
                let half = half / 3.0;
                let thirds = [-2.0, 0.0, 2.0].map(|k| Cell {
                    middle: middle + k * half,
                    half,
                });
                self.fold_all(level, &thirds);
                cells.extend(thirds);
            }
        }
    }

    fn fold_all(&mut self, level: usize, cells: &[Cell]) {
        let angles: Vec<f64> = cells.iter().map(|cell| cell.middle).collect();
        self.fold(level, &angles);
    }
}
