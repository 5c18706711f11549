//! A log's residuals in one pass: root mean squares, quantiles, and the worst with its time.

use datafusion::error::Result;
use datafusion::scalar::ScalarValue;

use super::aggregate::{Kept, Reader};
use super::rms::{Sum, largest, squares};
use crate::arguments::Piece;
use crate::dynamics::Dynamics;
use crate::error::Error;

const VERSION: u64 = 1;
/// Bins of a factor of two: each is 1/64 wide, its middle within 0.8 % of the values in it.
const OCTAVE: usize = 64;
/// From 2⁻²⁰ N·m on, with all below in the first bin.
const LEAST: i32 = -20;
/// To 2²⁰ N·m, with all above in the last bin.
const BINS: usize = 40 * OCTAVE;

/// The sums over a joint's residuals.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    squares: Sum,
    /// The largest |residual|, N·m or N.
    pub worst: f64,
    /// When it was, in the log's time.
    pub time: f64,
    bins: Vec<u64>,
}

/// The sums over residuals of any number of states.
#[derive(Clone, Debug, PartialEq)]
pub struct Residuals {
    states: u64,
    not_finite: u64,
    joints: Vec<Joint>,
    piece: Vec<f64>,
}

fn bin(size: f64) -> usize {
    // Exponent and first six bits of what follows it; bins are of equal width within an octave.
    let key = (size.to_bits() >> 46) as i64;
    let first = (1023 + i64::from(LEAST)) * OCTAVE as i64;
    (key - first).clamp(0, BINS as i64 - 1) as usize
}

fn middle(bin: usize) -> f64 {
    let octave = libm::ldexp(1.0, LEAST + (bin / OCTAVE) as i32);
    octave * (1.0 + ((bin % OCTAVE) as f64 + 0.5) / OCTAVE as f64)
}

impl Joint {
    fn new() -> Joint {
        Joint {
            squares: Sum::default(),
            worst: 0.0,
            time: f64::NAN,
            bins: vec![0; BINS],
        }
    }

    fn add(&mut self, residuals: &[f64], squares: f64, time: &[f64]) {
        self.squares.add(squares);
        let largest = largest(residuals);
        if largest >= self.worst
            && let Some(place) = residuals.iter().position(|r| r.abs() == largest)
        {
            self.see(largest, time[place]);
        }
        for residual in residuals {
            self.bins[bin(residual.abs())] += 1;
        }
    }

    /// Keeps the larger of two, of equal ones the earliest, in whatever order they come.
    fn see(&mut self, size: f64, time: f64) {
        let is_earlier = size == self.worst && (self.time.is_nan() || time < self.time);
        if size > self.worst || is_earlier {
            (self.worst, self.time) = (size, time);
        }
    }
}

impl Residuals {
    pub fn new(joints: usize) -> Residuals {
        Residuals {
            states: 0,
            not_finite: 0,
            joints: vec![Joint::new(); joints],
            piece: Vec::new(),
        }
    }

    /// Returns the number of states, without those that are not finite.
    pub fn states(&self) -> u64 {
        self.states
    }

    /// Returns the number of states that are left out, since they or their torques are not finite.
    pub fn not_finite(&self) -> u64 {
        self.not_finite
    }

    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Computes a joint's root mean square, N·m or N.
    pub fn rms(&self, joint: usize) -> f64 {
        libm::sqrt(self.joints[joint].squares.total() / self.states as f64)
    }

    /// Returns the size that a share of a joint's residuals is below, within 0.8 %.
    pub fn quantile(&self, joint: usize, part: f64) -> f64 {
        let joint = &self.joints[joint];
        let wanted = part * self.states as f64;
        let mut below = 0;
        for (bin, count) in joint.bins.iter().enumerate() {
            below += count;
            if *count > 0 && below as f64 >= wanted {
                return middle(bin).min(joint.worst);
            }
        }
        f64::NAN
    }

    /// Adds the residuals of another log.
    pub fn merge(&mut self, other: &Residuals) {
        self.states += other.states;
        self.not_finite += other.not_finite;
        for (joint, other) in self.joints.iter_mut().zip(&other.joints) {
            joint.squares.merge(other.squares);
            joint.see(other.worst, other.time);
            for (bin, other) in joint.bins.iter_mut().zip(&other.bins) {
                *bin += other;
            }
        }
    }

    /// Reads what an aggregate returned.
    pub fn from_bytes(bytes: &[u8]) -> Result<Residuals, Error> {
        let mut reader = Reader(bytes);
        if reader.count()? != VERSION {
            return Err(Error::new("residuals of another version"));
        }
        let joints = reader.count()?;
        let mut read = Residuals::new(0);
        (read.states, read.not_finite) = (reader.count()?, reader.count()?);
        for _ in 0..joints {
            let mut joint = Joint::new();
            joint.squares = Sum::read(&mut reader)?;
            (joint.worst, joint.time) = (reader.float()?, reader.float()?);
            for _ in 0..reader.count()? {
                let (bin, count) = (reader.count()? as usize, reader.count()?);
                let place = joint.bins.get_mut(bin);
                *place.ok_or_else(|| Error::new("residuals are damaged"))? = count;
            }
            read.joints.push(joint);
        }
        Ok(read)
    }
}

impl Kept for Residuals {
    fn add(&mut self, robot: &dyn Dynamics, piece: &Piece) -> Result<(), Error> {
        let mut residuals = std::mem::take(&mut self.piece);
        robot.residuals(piece.count, &piece.quantities, &mut residuals)?;
        let count = piece.count;
        // One that is not finite makes its sum so.
        let sums: Vec<f64> = residuals.chunks_exact(count).map(squares).collect();
        let mut totals = sums.iter().copied().chain([squares(&piece.time)]);
        if totals.all(f64::is_finite) {
            let columns = residuals.chunks_exact(count).zip(sums);
            for (joint, (column, squares)) in self.joints.iter_mut().zip(columns) {
                joint.add(column, squares, &piece.time);
            }
            self.states += count as u64;
        } else {
            let fine = |s: &usize| {
                let mut row = residuals.iter().skip(*s).step_by(count);
                row.all(|r| r.is_finite()) && piece.time[*s].is_finite()
            };
            let kept: Vec<usize> = (0..count).filter(fine).collect();
            let time: Vec<f64> = kept.iter().map(|s| piece.time[*s]).collect();
            for (joint, column) in self.joints.iter_mut().zip(residuals.chunks_exact(count)) {
                let entries: Vec<f64> = kept.iter().map(|s| column[*s]).collect();
                joint.add(&entries, squares(&entries), &time);
            }
            self.states += kept.len() as u64;
            self.not_finite += (count - kept.len()) as u64;
        }
        self.piece = residuals;
        Ok(())
    }

    fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut put = |word: u64| bytes.extend(word.to_le_bytes());
        put(VERSION);
        put(self.joints.len() as u64);
        put(self.states);
        put(self.not_finite);
        for joint in &self.joints {
            let Sum { value, rest } = joint.squares;
            for number in [value, rest, joint.worst, joint.time] {
                put(number.to_bits());
            }
            let bins = joint.bins.iter().enumerate();
            let filled = bins.filter(|(_, count)| **count > 0);
            put(filled.clone().count() as u64);
            for (bin, count) in filled {
                put(bin as u64);
                put(*count);
            }
        }
        bytes
    }

    fn merge(&mut self, _: &dyn Dynamics, bytes: &[u8]) -> Result<(), Error> {
        Residuals::merge(self, &Residuals::from_bytes(bytes)?);
        Ok(())
    }

    fn value(&self) -> Result<ScalarValue> {
        let any = self.states + self.not_finite > 0;
        Ok(ScalarValue::Binary(any.then(|| self.to_bytes())))
    }

    fn size(&self) -> usize {
        size_of_val(self) + self.joints.len() * (size_of::<Joint>() + 8 * BINS)
    }
}
