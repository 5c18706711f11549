//! A bound shown cell by cell, angle after angle.

use std::f64::consts::PI;

use super::layout::Layout;
use super::{FINEST, FIRST};
use crate::certify::interval::Interval;

/// Terms that are put together in about the time of a point.
const TERMS: usize = 64;

/// A bound to show.
pub(super) struct Cells<'a> {
    pub layout: &'a Layout,
    pub buffers: Vec<Vec<f64>>,
    /// Whether the value at a point is at most a bound.
    pub accept: &'a dyn Fn(&[f64], f64) -> bool,
    /// Whether a value is at most what its terms are without sines.
    pub crude: bool,
    /// F, if the box is a part of the circles.
    pub whole: Option<f64>,
    pub ranges: Vec<Interval>,
    /// Points that may still be tried.
    pub points: usize,
}

impl Cells<'_> {
    /// The joint's range, unless it goes round.
    pub(super) fn part(&self, level: usize) -> Option<(Interval, f64)> {
        let whole = self.whole.filter(|_| self.layout.part[level])?;
        Some((self.ranges[level], whole))
    }

    /// Puts an angle in; what takes about as long as a point counts as one.
    pub(super) fn fold(&mut self, level: usize, angle: f64) {
        let points = 1 + self.layout.terms(level) / TERMS;
        self.points = self.points.saturating_sub(points);
        self.layout.fold(level, angle, &mut self.buffers);
    }

    /// Whether the maximum over the joints from `level` on is at most a bound:
    /// `true` is a proof.
    pub(super) fn below(&mut self, level: usize, bound: f64) -> bool {
        if level == self.layout.joints.len() {
            return (self.accept)(&self.buffers[level], bound);
        }
        if self.crude && self.layout.crude(level, &self.buffers[level]) <= bound {
            return true;
        }
        if bound <= 0.0 || self.points == 0 {
            return false;
        }
        let degree = f64::from(self.layout.degrees[level]);
        let part = self.part(level);
        let count = FIRST * self.layout.degrees[level] as usize;
        let (from, width) = match part {
            Some((range, _)) => {
                for end in [range.low(), range.high()] {
                    self.fold(level, end);
                    if !self.below(level + 1, bound) {
                        return false;
                    }
                }
                (range.low(), range.width())
            }
            None => (0.0, 2.0 * PI),
        };
        let rounded = 4.0 * f64::EPSILON * (from.abs() + width);
        let half = 0.5 * width / count as f64;
        let middle = |k: usize| from + width * (k as f64 + 0.5) / count as f64;
        let mut cells: Vec<(f64, f64)> = (0..count).rev().map(|k| (middle(k), half)).collect();
        while let Some((angle, half)) = cells.pop() {
            // Half widths and middles are rounded; a little more covers that.
            let reach = degree * (half * (1.0 + 1e-12) + rounded);
            let enough = match part {
                Some((_, whole)) => {
                    (bound - 0.5 * reach * reach * whole * (1.0 + 1e-12)).next_down()
                }
                None => (bound * (libm::cos(reach) - 1e-15)).next_down(),
            };
            self.fold(level, angle);
            if !self.below(level + 1, enough) {
                if reach <= FINEST || self.points == 0 {
                    return false;
                }
                let third = half / 3.0;
                cells.extend([-2.0, 0.0, 2.0].map(|k| (angle + k * third, third)));
            }
        }
        true
    }
}
