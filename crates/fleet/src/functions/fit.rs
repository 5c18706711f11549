//! What identification keeps of states: dalembert-fit's triangles.

use datafusion::error::Result;
use datafusion::scalar::ScalarValue;

use super::aggregate::Kept;
use crate::arguments::Piece;
use crate::dynamics::{Dynamics, States, no_model};
use crate::error::Error;
use dalembert_fit::Accumulator;

/// Fewer than other pieces: of each state there is a whole regressor.
const PIECE: usize = 128;

/// The triangles of all joints; read by [`Accumulator::from_bytes`].
#[derive(Debug)]
pub(super) struct Parameters {
    kept: Accumulator,
    parts: [Vec<f64>; 4],
    room: Vec<f64>,
}

impl Parameters {
    pub(super) fn new(robot: &dyn Dynamics) -> Result<Parameters> {
        Ok(Parameters {
            kept: Accumulator::new(robot.model().ok_or_else(no_model)?),
            parts: Default::default(),
            room: Vec::new(),
        })
    }
}

impl Kept for Parameters {
    fn add(&mut self, robot: &dyn Dynamics, piece: &Piece) -> Result<(), Error> {
        let Parameters { kept, parts, room } = self;
        for first in (0..piece.count).step_by(PIECE) {
            let last = piece.count.min(first + PIECE);
            for (part, all) in parts.iter_mut().zip(&piece.quantities) {
                part.clear();
                for column in all.chunks_exact(piece.count) {
                    part.extend_from_slice(&column[first..last]);
                }
            }
            let [q, qd, qdd, tau] = &*parts;
            let count = last - first;
            robot.accumulate(States { count, q, qd, qdd }, tau, room, kept)?;
        }
        Ok(())
    }

    fn to_bytes(&self) -> Vec<u8> {
        self.kept.to_bytes()
    }

    fn merge(&mut self, robot: &dyn Dynamics, bytes: &[u8]) -> Result<(), Error> {
        let model = robot.model().ok_or_else(no_model)?;
        let other = Accumulator::from_bytes(model, bytes)?;
        Ok(self.kept.merge(&other)?)
    }

    fn value(&self) -> Result<ScalarValue> {
        let bytes = (self.kept.states() > 0).then(|| self.kept.to_bytes());
        Ok(ScalarValue::Binary(bytes))
    }

    fn size(&self) -> usize {
        // The triangles, and 64 rows that each of them waits with.
        4 * self.kept.to_bytes().len() + 8 * self.room.capacity()
    }
}
