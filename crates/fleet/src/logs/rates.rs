//! Velocities and accelerations of positions, block by block.

use dalembert_fit::{Differentiator, differentiate};

use super::block::Block;
use crate::error::Error;

/// By how much of a period a step may be off: the filter is one for equal times.
const JITTER: f64 = 0.1;

/// Differentiates the positions of a log as its blocks come.
pub(super) struct Rates {
    frequency: f64,
    filter: Option<(Differentiator, f64)>,
    /// The end of earlier blocks that later ones need, at least a window less one: rows, times, and
    /// of each joint position and torque.
    rows: Vec<u64>,
    time: Vec<f64>,
    states: Vec<[Vec<f64>; 2]>,
}

impl Rates {
    pub(super) fn new(joints: usize, frequency: f64) -> Rates {
        Rates {
            frequency,
            filter: None,
            rows: Vec::new(),
            time: Vec::new(),
            states: vec![Default::default(); joints],
        }
    }

    /// Takes the next block; returns the states whose window is whole.
    ///
    /// # Errors
    /// The row after which times are not equal, and motion that is too fast for them.
    pub(super) fn next(&mut self, block: Block) -> Result<Block, Error> {
        let from = self.time.len().saturating_sub(1);
        self.rows.extend(&block.rows);
        self.time.extend(&block.time);
        for (joint, states) in self.states.iter_mut().enumerate() {
            for (own, quantity) in states.iter_mut().zip([0, 3]) {
                own.extend(block.column(quantity, joint));
            }
        }
        if self.filter.is_none() && self.time.len() > 1 {
            let steps = self.time.windows(2).map(|pair| pair[1] - pair[0]);
            let mut steps: Vec<f64> = steps.collect();
            steps.sort_by(f64::total_cmp);
            let period = steps[steps.len() / 2];
            let filter = Differentiator::for_motion(period, self.frequency)?;
            self.filter = Some((filter, period));
        }
        let Some((filter, period)) = &self.filter else {
            return Ok(Block::default());
        };
        for (place, pair) in self.time.windows(2).enumerate().skip(from) {
            let step = pair[1] - pair[0];
            if (step - period).abs() > JITTER * period {
                let why = format!(
                    "{step:.3e} s after the row before, and others {period:.3e} s: velocities \
                     and accelerations cannot be differentiated over this; log them, or \
                     resample"
                );
                return Err(Error::new(why).at_row(self.rows[place + 1]));
            }
        }
        let half = filter.half();
        if self.time.len() <= 2 * half {
            return Ok(Block::default());
        }
        let count = self.time.len() - 2 * half;
        let mut out = Block {
            rows: self.rows[half..half + count].to_vec(),
            time: self.time[half..half + count].to_vec(),
            ..Block::default()
        };
        self.rows.drain(..count);
        self.time.drain(..count);
        for [position, torque] in &mut self.states {
            let rates = differentiate(filter, position)?;
            for (to, from) in out.quantities.iter_mut().zip(rates) {
                to.extend(from);
            }
            out.quantities[3].extend_from_slice(&torque[half..half + count]);
            position.drain(..count);
            torque.drain(..count);
        }
        Ok(out)
    }
}
