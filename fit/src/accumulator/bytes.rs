//! Accumulators as bytes: a version, the model's fingerprint and the triangles.

use super::Accumulator;
use crate::error::Error;
use crate::model::Model;
use crate::triangle::Triangle;

/// The first bytes of what [`Accumulator::to_bytes`] writes.
const MAGIC: &[u8; 6] = b"DLBFIT";
/// The version of these bytes.
const VERSION: u16 = 1;

impl Accumulator {
    /// Writes the accumulator: a version, the model's fingerprint and the triangles.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(self.fingerprint);
        bytes.extend(self.states.to_le_bytes());
        for row in self.factors() {
            let width = row.columns.len() + 1;
            for (i, r) in row.factor.chunks(width).enumerate() {
                r[i..].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            }
        }
        bytes
    }

    /// Reads what [`Accumulator::to_bytes`] wrote.
    ///
    /// # Errors
    /// [`Error::Bytes`] and, of another robot or other options, [`Error::OtherModel`].
    pub fn from_bytes(model: &Model, bytes: &[u8]) -> Result<Accumulator, Error> {
        let mut read = Accumulator::new(model);
        let rest = bytes.strip_prefix(MAGIC.as_slice());
        let rest = rest.ok_or(Error::Bytes("they do not begin with DLBFIT"))?;
        let short = Error::Bytes("they end too early");
        let (version, rest) = rest.split_first_chunk().ok_or(short.clone())?;
        if u16::from_le_bytes(*version) != VERSION {
            return Err(Error::Bytes("they are of another version than 1"));
        }
        let (fingerprint, rest) = rest.split_first_chunk::<32>().ok_or(short.clone())?;
        if fingerprint != model.fingerprint() {
            return Err(Error::OtherModel);
        }
        let (states, rest) = rest.split_first_chunk().ok_or(short.clone())?;
        read.states = u64::from_le_bytes(*states);
        let (numbers, surplus) = rest.as_chunks::<8>();
        let mut numbers = numbers.iter().map(|x| f64::from_le_bytes(*x));
        for triangle in &mut read.triangles {
            let width = triangle.columns();
            let mut r = vec![0.0; width * width];
            for i in 0..width {
                for x in &mut r[i * width + i..(i + 1) * width] {
                    *x = numbers.next().ok_or(short.clone())?;
                    if !x.is_finite() {
                        return Err(Error::Bytes("a number is not finite"));
                    }
                }
            }
            *triangle = Triangle::of(width, r);
        }
        if numbers.next().is_some() || !surplus.is_empty() {
            return Err(Error::Bytes("there are more than the robot's columns need"));
        }
        Ok(read)
    }
}
