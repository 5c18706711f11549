//! F ≤ B shown angle by angle, with the coefficients that are left at each level.

use std::f64::consts::PI;

use super::corners::{Factor, Table, corners, length};
use super::definite::exceeds;
use super::terms::{TermKey, Terms, bits, group, multiple, without_phases};
use crate::interval::sin_cos;
use crate::ring::Ring;

/// Angles that are put in side by side.
const LANES: usize = 8;
/// The part of B that is lost in one of the first cells, and in the last that is cut.
const FIRST_LOSS: f64 = 0.08;
const LEAST_LOSS: f64 = 0.003;
const MOST_CELLS: f64 = 64.0;
/// Below this no sum of terms is infinite. Infinite sums would leave NaN, which a maximum ignores.
const MOST_MASS: f64 = 1e300;

/// One angle's turn: what its multiples are multiplied with, and where that is added to.
pub(super) struct Level {
    pub(super) joint: usize,
    pub(super) range: Option<[f64; 2]>,
    pub(super) degree: f64,
    /// The multiples and phases that there are.
    bases: Vec<(u32, bool)>,
    /// The values that add up to each one of the next level, with their bases, and the end of each sum.
    pub(super) parts: Vec<(u32, u32)>,
    ends: Vec<u32>,
    /// The end of each run of values that differ by phases, the square of its multiple, and its group.
    pub(super) runs: Vec<(u32, f64, u32)>,
    /// The values that depend on no angle that is left.
    pub(super) constants: Vec<u32>,
    table: Option<Table>,
}

/// The finding about one B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    Yes,
    /// F is above B at `above`.
    Refuted,
    /// The steps are used up, or cells have become too narrow.
    Unknown,
}

/// The meaning of F behind the last level.
#[derive(Clone, Copy, Default)]
pub(super) enum Aim {
    /// The magnitude at the worst rates.
    #[default]
    Magnitude,
    /// A bound of a matrix's magnitude, less its least eigenvalue; it has so many rows.
    Eigenvalue { size: usize, largest: f64 },
}

#[derive(Default)]
pub(super) struct Search {
    pub(super) aim: Aim,
    /// The loss in the last cell that is cut, if it is not a part of B.
    pub(super) least_loss: Option<f64>,
    pub(super) levels: Vec<Level>,
    /// The values of each level, one state behind the other: the last ones are those of the state
    /// that is looked at.
    pub(super) columns: Vec<Vec<f64>>,
    /// The factor of each value behind the last level.
    pub(super) factors: Vec<Factor>,
    /// A bound of terms left out, and of what sums and sines lose in doubles.
    pub(super) slack: f64,
    pub(super) angles: Vec<f64>,
    /// The point at which the last climb ended.
    pub(super) top: Vec<f64>,
    /// The last point at which F was above a B.
    pub(super) above: Vec<f64>,
    pub(super) steps: u64,
    pub(super) corner: Vec<f64>,
    sums: Vec<f64>,
}

impl Search {
    pub(super) fn new(expansion: &Terms, ring: &Ring) -> Search {
        let place = |key: TermKey| (without_phases(key), key);
        let mut terms = expansion.terms.clone();
        terms.sort_by_key(|term| place(term.0));
        let mass: f64 = terms.iter().map(|term| term.1.abs()).sum();
        let mut keys: Vec<TermKey> = terms.iter().map(|term| term.0).collect();
        let mut longest = keys.len() + expansion.factors.len() + 64;
        let mut search = Search {
            columns: vec![terms.iter().map(|term| term.1).collect()],
            corner: vec![0.0; 1 << expansion.velocities],
            ..Search::default()
        };
        for joint in order(&expansion.terms, ring.angles.len()) {
            let of_joint = |key: &TermKey| multiple(*key, joint);
            let mut bases: Vec<(u32, bool)> = keys.iter().map(of_joint).collect();
            bases.sort_unstable();
            bases.dedup();
            let degree = bases.last().map_or(0, |base| base.0);
            if degree == 0 {
                continue;
            }
            let constant = |(key, at): (&TermKey, u32)| {
                let is_constant = without_phases(*key) >> 16 == 0;
                is_constant.then_some(at)
            };
            let constants = keys.iter().zip(0..).filter_map(constant).collect();
            let mut end = 0;
            let same = |a: &TermKey, b: &TermKey| without_phases(*a) == without_phases(*b);
            let ended = |run: &[TermKey]| {
                end += run.len() as u32;
                let square = f64::from(multiple(run[0], joint).0).powi(2);
                (end, square, group(run[0]) as u32)
            };
            let runs: Vec<(u32, f64, u32)> = keys.chunk_by(same).map(ended).collect();
            let moved = |(key, at): (&TermKey, u32)| {
                let base = bases.binary_search(&of_joint(key));
                (place(key & !bits(joint)), at, base.unwrap_or(0) as u32)
            };
            let mut moves: Vec<((TermKey, TermKey), u32, u32)> =
                keys.iter().zip(0..).map(moved).collect();
            moves.sort_unstable();
            let mut end = 0;
            let sums = moves.chunk_by(|a, b| a.0 == b.0).map(|run| {
                end += run.len() as u32;
                (end, run[0].0.1)
            });
            let (ends, next) = sums.unzip();
            search.levels.push(Level {
                joint,
                range: ring.angles[joint],
                degree: f64::from(degree),
                ends,
                parts: moves.iter().map(|entry| (entry.1, entry.2)).collect(),
                bases,
                constants,
                table: Table::new(&keys, &runs, expansion, joint),
                runs,
            });
            search.columns.push(Vec::new());
            // Sines are 1e-15 off, multiples so many times as much.
            longest += 16 * degree as usize + 4;
            keys = next;
        }
        let factor = |key: &TermKey| expansion.factors[group(*key)];
        search.factors = keys.iter().map(factor).collect();
        search.angles = vec![0.0; search.levels.len()];
        search.slack = match mass < MOST_MASS {
            true => (expansion.rest + mass * longest as f64 * f64::EPSILON) * (1.0 + 1e-9),
            false => f64::INFINITY,
        };
        search
    }

    pub(super) fn is_constant(&self) -> bool {
        self.levels.is_empty()
    }

    /// Returns a bound without looking at any angle.
    pub(super) fn plain_bound(&mut self) -> f64 {
        match self.is_constant() {
            true => self.worst(),
            false => self.crude(0).0,
        }
    }

    fn len(&self, level: usize) -> usize {
        let layout = self.levels.get(level);
        layout.map_or(self.factors.len(), |layout| layout.parts.len())
    }

    fn values(&self, level: usize) -> &[f64] {
        let column = &self.columns[level];
        &column[column.len() - self.len(level)..]
    }

    /// Returns bounds of F and of its second derivative by the level's angle, which is not put in.
    fn crude(&self, level: usize) -> (f64, f64) {
        let layout = &self.levels[level];
        let values = self.values(level);
        let (mut most, mut bend) = (self.slack, layout.degree.powi(2) * self.slack);
        let mut from = 0;
        for &(end, square, _) in &layout.runs {
            let length = length(&values[from..end as usize]);
            most += length;
            bend += length * square;
            from = end as usize;
        }
        (most * (1.0 + 1e-9), bend * (1.0 + 1e-9))
    }

    /// Bounds F over all angles that are not put in, corner by corner. Returns true if it is at most so
    /// much, and the smaller bound of the second derivative.
    fn at_corners(&mut self, level: usize, most: f64, bend: f64) -> (bool, f64) {
        let layout = &self.levels[level];
        let Some(table) = &layout.table else {
            return (false, bend);
        };
        let mut sums = std::mem::take(&mut self.sums);
        let (bound, bent) = table.bound(self.values(level), &mut sums);
        self.steps = self.steps.saturating_sub(sums.len() as u64);
        self.sums = sums;
        let bent = bent + layout.degree.powi(2) * self.slack;
        let is_small = (bound + self.slack) * (1.0 + 1e-9) <= most;
        (is_small, bend.min(bent * (1.0 + 1e-9)))
    }

    /// Returns true if F is at most so much where all angles are put in: at first by magnitudes, then at the
    /// worst corner.
    pub(super) fn is_at_most(&mut self, most: f64) -> bool {
        if let Aim::Eigenvalue { size, largest } = self.aim {
            self.put_in_place();
            let least = (largest - most).next_up() + self.slack;
            return exceeds(self.corner.clone(), size, least);
        }
        let values = self.values(self.levels.len());
        let plain = values.iter().map(|x| x.abs()).sum::<f64>() + self.slack;
        plain <= most || self.worst() <= most
    }

    /// Returns F where all angles are put in.
    pub(super) fn worst(&mut self) -> f64 {
        let column = &self.columns[self.levels.len()];
        let values = &column[column.len() - self.factors.len()..];
        let (mut sum, mut other) = (0.0f64, 0.0);
        self.corner.fill(0.0);
        for (value, factor) in values.iter().zip(&self.factors) {
            match *factor {
                Factor::One => sum += value,
                Factor::Other => other += value.abs(),
                Factor::Place(set) => self.corner[set as usize] += value,
            }
        }
        let [low, high] = corners(&mut self.corner);
        other + (sum + high).max(-(sum + low)) + self.slack
    }

    /// Puts angles in, side by side: the values of the next level for each, one behind the other.
    fn put(&mut self, level: usize, angles: &[f64]) {
        let work = (self.len(level) + 20) * angles.len();
        self.steps = self.steps.saturating_sub(work as u64);
        for some in angles.chunks(LANES) {
            match some.len() {
                1 => self.lanes::<1>(level, some),
                2..=4 => self.lanes::<4>(level, some),
                _ => self.lanes::<LANES>(level, some),
            }
        }
    }

    fn lanes<const W: usize>(&mut self, level: usize, angles: &[f64]) {
        let layout = &self.levels[level];
        let mut rows = [[0.0; W]; 32];
        for (lane, angle) in angles.iter().enumerate() {
            let (sin, cos) = sin_cos(*angle);
            let mut multiples = [(0.0, 1.0); 16];
            for k in 1..=(layout.degree as usize).min(15) {
                let (s, c) = multiples[k - 1];
                multiples[k] = (s * cos + c * sin, c * cos - s * sin);
            }
            for (row, &(k, is_sine)) in rows.iter_mut().zip(&layout.bases) {
                let (s, c) = multiples[k as usize & 15];
                row[lane] = if is_sine { s } else { c };
            }
        }
        let (before, behind) = self.columns.split_at_mut(level + 1);
        let column = &before[level];
        let values = &column[column.len() - layout.parts.len()..];
        let next = &mut behind[0];
        let (start, count) = (next.len(), layout.ends.len());
        next.resize(start + count * angles.len(), 0.0);
        let next = &mut next[start..];
        let mut from = 0;
        for (to, end) in layout.ends.iter().enumerate() {
            let mut sums = [0.0; W];
            for &(at, base) in &layout.parts[from..*end as usize] {
                let (value, row) = (values[at as usize], &rows[base as usize & 31]);
                for lane in 0..W {
                    sums[lane] += value * row[lane];
                }
            }
            from = *end as usize;
            for lane in 0..angles.len() {
                next[lane * count + to] = sums[lane];
            }
        }
    }

    /// Puts one angle in, in place of what was put in there.
    pub(super) fn fix(&mut self, level: usize, angle: f64) {
        self.columns[level + 1].clear();
        self.put(level, &[angle]);
    }

    pub(super) fn shows_all(&mut self, most: f64) -> Verdict {
        self.above.clear();
        (1..self.columns.len()).for_each(|level| self.columns[level].clear());
        let shown = self.shows(0, most);
        match (shown, self.above.is_empty()) {
            (Verdict::Refuted, true) => Verdict::Unknown,
            _ => shown,
        }
    }

    /// Shows F ≤ B, the angles of the levels before being put in. A point above an inner B, which is
    /// less by what cells lose, refutes that alone.
    fn shows(&mut self, level: usize, most: f64) -> Verdict {
        if level == self.levels.len() {
            if self.is_at_most(most) {
                return Verdict::Yes;
            }
            self.above.clone_from(&self.angles);
            return Verdict::Refuted;
        }
        let (is_small, bend) = match self.aim {
            Aim::Magnitude => {
                let (crude, bend) = self.crude(level);
                match crude <= most {
                    true => (true, bend),
                    false => self.at_corners(level, most, bend),
                }
            }
            Aim::Eigenvalue { size, largest } => self.crude_matrix(level, size, largest - most),
        };
        if is_small {
            return Verdict::Yes;
        }
        if self.steps == 0 {
            return Verdict::Unknown;
        }
        if !(most > 0.0) || level > 0 && self.is_above(level, most) {
            return Verdict::Refuted;
        }
        let Level { degree, range, .. } = self.levels[level];
        let [low, high] = range.unwrap_or([-PI, PI]);
        for end in range.into_iter().flatten() {
            self.fix(level, end);
            self.angles[level] = end;
            match self.shows(level + 1, most) {
                Verdict::Yes => {}
                other => return other,
            }
        }
        let widest = (2.0 * FIRST_LOSS * most / bend.min(degree * degree * most)).sqrt();
        let count = (0.5 * (high - low) / widest).ceil().clamp(1.0, MOST_CELLS);
        let half = (0.5 * (high - low) / count) * (1.0 + 1e-12) + 1e-15 * low.abs();
        let cell = |k: usize| (low + (high - low) * (k as f64 + 0.5) / count, half);
        let least = self.least_loss.unwrap_or(LEAST_LOSS * most);
        let mut first = (0..count as usize).map(cell);
        let mut cells: Vec<(f64, f64)> = Vec::new();
        self.columns[level + 1].clear();
        loop {
            if cells.is_empty() {
                cells.extend(first.by_ref().take(LANES));
                cells.reverse();
                let middles: Vec<f64> = cells.iter().map(|cell| cell.0).collect();
                self.put(level, &middles);
            }
            let Some((middle, half)) = cells.pop() else {
                return Verdict::Yes;
            };
            let turn = degree * half * (1.0 + 1e-12);
            let bent = 0.5 * half * half * bend;
            let lost = match range {
                None if turn < 1.5 => bent.min(most * (1.0 - sin_cos(turn).1 + 2e-15)),
                _ => bent,
            };
            // One part in 10¹² for the roundings of all this.
            let enough = most - lost * (1.0 + 1e-12) - 1e-12 * most;
            self.angles[level] = middle;
            let verdict = self.shows(level + 1, enough);
            let length = self.columns[level + 1].len() - self.len(level + 1);
            self.columns[level + 1].truncate(length);
            match verdict {
                Verdict::Yes => continue,
                Verdict::Unknown => return Verdict::Unknown,
                Verdict::Refuted if lost <= least => return Verdict::Refuted,
                Verdict::Refuted => {}
            }
            if self.steps == 0 {
                return Verdict::Unknown;
            }
            let third = half / 3.0;
            let cut = [-2.0, 0.0, 2.0].map(|k| middle + k * third);
            self.put(level, &cut);
            cells.extend(cut.map(|middle| (middle, third * (1.0 + 1e-12))));
        }
    }

    /// Tries the angles that refuted the last B: mostly they refute this one, too.
    fn is_above(&mut self, level: usize, most: f64) -> bool {
        if self.above.is_empty() {
            return false;
        }
        for next in level..self.levels.len() {
            self.fix(next, self.above[next]);
        }
        !self.is_at_most(most)
    }
}

/// Orders the angles by Σ |c| k²: those that bend most come first.
fn order(terms: &[(TermKey, f64)], joints: usize) -> Vec<usize> {
    let bend = |joint: usize| -> f64 {
        let entries = terms.iter();
        entries
            .map(|(key, value)| value.abs() * f64::from(multiple(*key, joint).0).powi(2))
            .sum()
    };
    let bends: Vec<f64> = (0..joints).map(bend).collect();
    let mut order: Vec<usize> = (0..joints).collect();
    order.sort_by(|&a, &b| bends[b].total_cmp(&bends[a]));
    order
}
