//! Root mean squares of residuals.

use std::sync::Arc;

use datafusion::error::Result;
use datafusion::scalar::ScalarValue;

use super::aggregate::{Kept, Reader};
use crate::arguments::{Piece, list, lists};
use crate::dynamics::Dynamics;
use crate::error::Error;

/// Carries each rounding along (Neumaier 1974): the same to the last digits in whatever parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sum {
    pub(super) value: f64,
    pub(super) rest: f64,
}

impl Sum {
    pub(super) fn add(&mut self, term: f64) {
        let sum = self.value + term;
        self.rest += match self.value.abs() >= term.abs() {
            true => (self.value - sum) + term,
            false => (term - sum) + self.value,
        };
        self.value = sum;
    }

    pub(super) fn merge(&mut self, other: Sum) {
        self.add(other.value);
        self.rest += other.rest;
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Sum, Error> {
        let [value, rest] = [reader.float()?, reader.float()?];
        Ok(Sum { value, rest })
    }

    pub(super) fn total(&self) -> f64 {
        self.value + self.rest
    }
}

/// Eight parts take vectors. A NaN counts as zero.
pub(super) fn largest(values: &[f64]) -> f64 {
    let mut parts = [0.0f64; 8];
    let larger = |part: f64, x: f64| if x.abs() > part { x.abs() } else { part };
    let (eights, rest) = values.as_chunks::<8>();
    for eight in eights {
        for (part, x) in parts.iter_mut().zip(eight) {
            *part = larger(*part, *x);
        }
    }
    parts.iter().chain(rest).copied().fold(0.0, larger)
}

pub(super) fn squares(values: &[f64]) -> f64 {
    let mut parts = [0.0; 8];
    let (eights, rest) = values.as_chunks::<8>();
    for eight in eights {
        for (part, x) in parts.iter_mut().zip(eight) {
            *part += x * x;
        }
    }
    let [a, b, c, d, e, f, g, h] = parts;
    let rest: f64 = rest.iter().map(|x| x * x).sum();
    ((a + e) + (c + g)) + ((b + f) + (d + h)) + rest
}

#[derive(Debug)]
pub(super) struct Rms {
    states: u64,
    sums: Vec<Sum>,
    residuals: Vec<f64>,
}

impl Rms {
    pub(super) fn new(joints: usize) -> Rms {
        Rms {
            states: 0,
            sums: vec![Sum::default(); joints],
            residuals: Vec::new(),
        }
    }
}

impl Kept for Rms {
    fn add(&mut self, robot: &dyn Dynamics, piece: &Piece) -> Result<(), Error> {
        robot.residuals(piece.count, &piece.quantities, &mut self.residuals)?;
        let columns = self.residuals.chunks_exact(piece.count);
        for (sum, column) in self.sums.iter_mut().zip(columns) {
            sum.add(squares(column));
        }
        self.states += piece.count as u64;
        Ok(())
    }

    fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.states.to_le_bytes().to_vec();
        for sum in &self.sums {
            bytes.extend(sum.value.to_le_bytes());
            bytes.extend(sum.rest.to_le_bytes());
        }
        bytes
    }

    fn merge(&mut self, _: &dyn Dynamics, bytes: &[u8]) -> Result<(), Error> {
        let mut reader = Reader(bytes);
        self.states += reader.count()?;
        for sum in &mut self.sums {
            sum.merge(Sum::read(&mut reader)?);
        }
        Ok(())
    }

    fn value(&self) -> Result<ScalarValue> {
        if self.states == 0 {
            return ScalarValue::try_new_null(&list(self.sums.len()));
        }
        let mean = |sum: &Sum| libm::sqrt(sum.total() / self.states as f64);
        let values: Vec<f64> = self.sums.iter().map(mean).collect();
        let lists = lists(values.len(), values, None)?;
        Ok(ScalarValue::FixedSizeList(Arc::new(lists)))
    }

    fn size(&self) -> usize {
        size_of_val(self) + size_of_val(&self.sums[..]) + 8 * self.residuals.capacity()
    }
}
