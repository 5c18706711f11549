//! A bound shown cell by cell, angle after angle.

use std::f64::consts::{FRAC_PI_2, PI};

use super::FINEST;
use super::layout::{LANES, Layout};
use crate::bound::input_box::InputBox;
use crate::bound::work;
use crate::interval::Interval;

const TERMS: usize = 64;

/// The part of a bound that one of the first cells may cost. Smaller cells are more of them; of
/// larger ones what was shown of the other angles is more often in vain.
const FIRST: f64 = 0.077;

const MOST_FIRST: f64 = 64.0;

pub(super) struct Cells<'a> {
    pub layout: &'a Layout,
    /// Before each joint, and after the last: columns of values, of which the last one counts.
    buffers: Vec<Vec<f64>>,
    accept: &'a dyn Fn(&[f64], f64) -> bool,
    /// True if the values are terms of one polynomial, of which something is known before all of
    /// its angles are put in.
    pub is_sum: bool,
    /// F, if the box is a part of the circles.
    whole: Option<f64>,
    ranges: Vec<Interval>,
    pub points: usize,
    /// The part of the first angle's range that was shown before the cell that was looked at last.
    pub reached: f64,
    angles: Vec<f64>,
    above: Vec<f64>,
}

struct Cell {
    middle: f64,
    half: f64,
}

impl<'a> Cells<'a> {
    /// Covers the box if F over the whole circles is given, else the whole circles.
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
            is_sum: false,
            whole,
            ranges: layout.joints.iter().map(|&j| limits.position[j]).collect(),
            points: 0,
            reached: 0.0,
            angles: vec![0.0; layout.joints.len()],
            above: Vec::new(),
        }
    }

    pub(super) fn part(&self, level: usize) -> Option<(Interval, f64)> {
        let whole = self.whole.filter(|_| self.layout.part[level])?;
        Some((self.ranges[level], whole))
    }

    pub(super) fn span(&self, level: usize) -> (f64, f64) {
        self.part(level)
            .map_or((0.0, 2.0 * PI), |(range, _)| (range.low(), range.width()))
    }

    pub(super) fn values(&self, level: usize) -> &[f64] {
        let buffer = &self.buffers[level];
        &buffer[buffer.len() - self.layout.len(level)..]
    }

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

    pub(super) fn charge(&mut self, level: usize) {
        let points = 1 + self.layout.len(level) / TERMS;
        work::count(points);
        self.points = self.points.saturating_sub(points);
    }

    /// Over the joints from `level` on; `true` is a proof.
    pub(super) fn below(&mut self, level: usize, bound: f64) -> bool {
        if level == self.layout.joints.len() {
            let below = (self.accept)(self.values(level), bound);
            if !below {
                self.above.clone_from(&self.angles);
            }
            return below;
        }
        let mut bend = f64::INFINITY;
        if self.is_sum {
            let crude = self.layout.crude(level, self.values(level));
            if crude.most <= bound {
                return true;
            }
            bend = crude.bend;
        }
        if bound <= 0.0 || self.points == 0 {
            return false;
        }
        let degree = f64::from(self.layout.degrees[level]);
        let part = self.part(level);
        if let Some((range, _)) = part {
            for end in [range.low(), range.high()] {
                self.charge(level);
                self.place(level, end);
                if !self.below(level + 1, bound) {
                    return false;
                }
            }
        }
        let (from, width) = self.span(level);
        let rounded = 4.0 * f64::EPSILON * (from.abs() + width);
        let lost = |half: f64| {
            // Half widths and middles are rounded; a little more covers that.
            let half = half * (1.0 + 1e-12) + rounded;
            let (bent, reach) = (0.5 * half * half * bend, degree * half);
            let known = match part {
                Some((_, whole)) => 0.5 * reach * reach * whole,
                None if reach > FRAC_PI_2 => f64::INFINITY,
                None => bound * (1.0 - libm::cos(reach) + 1e-15),
            };
            bent.min(known) * (1.0 + 1e-12)
        };
        let finest = FINEST * bound;
        let count = self.first(level, width, bound, bend);
        let mut first = (0..count).map(|k| Cell {
            middle: from + width * (k as f64 + 0.5) / count as f64,
            half: 0.5 * width / count as f64,
        });
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
            let lost = lost(half);
            let enough = (bound - lost).next_down();
            self.charge(level);
            self.angles[level] = middle;
            let below = !self.is_above(level + 1, enough) && self.below(level + 1, enough);
            let rest = self.buffers[level + 1].len() - self.layout.len(level + 1);
            self.buffers[level + 1].truncate(rest);
            if !below {
                if lost <= finest || self.points == 0 {
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

    /// A bound that is refuted at the angles where one was last need not be looked at.
    fn is_above(&mut self, level: usize, bound: f64) -> bool {
        let last = self.layout.joints.len();
        if level == last || self.above.is_empty() {
            return false;
        }
        for next in level..last {
            self.charge(next);
            self.place(next, self.above[next]);
        }
        !(self.accept)(self.values(last), bound)
    }

    fn first(&self, level: usize, width: f64, bound: f64, bend: f64) -> usize {
        // By the degree or by the second derivative, whichever is wider.
        let degree = f64::from(self.layout.degrees[level]);
        let most = self.part(level).map_or(bound, |(_, whole)| whole);
        let widest = (2.0 * FIRST * bound / bend.min(degree * degree * most)).sqrt();
        (0.5 * width / widest).ceil().clamp(1.0, MOST_FIRST) as usize
    }

    fn fold_all(&mut self, level: usize, cells: &[Cell]) {
        let angles: Vec<f64> = cells.iter().map(|cell| cell.middle).collect();
        self.fold(level, &angles);
    }
}
