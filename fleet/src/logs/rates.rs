//! Velocities and accelerations of positions, block by block.

use dalembert_fit::{Differentiator, differentiate};

use super::block::Block;
use crate::error::Error;

/// By how much of a period a step may be off: the filter is one for equal times.
const JITTER: f64 = 0.1;

/// Differentiates the positions of a log as its blocks come.
pub(super) struct Rates {
    frequency: f64,
    joints: usize,
    filter: Option<(Differentiator, f64)>,
    /// What later blocks need of earlier ones, at least a window less one.
    kept: Block,
}

impl Rates {
    pub(super) fn new(joints: usize, frequency: f64) -> Rates {
        Rates {
            frequency,
            joints,
            filter: None,
            kept: Block::default(),
        }
    }

    /// Takes the next block; returns the states whose window is whole.
    ///
    /// # Errors
    /// The row after which times are not equal, and motion that is too fast for them.
    pub(super) fn next(&mut self, block: Block) -> Result<Block, (Option<u64>, Error)> {
        let whole = |why: dalembert_fit::Error| (None, Error::from(why));
        let all = joined(&self.kept, &block, self.joints);
        if self.filter.is_none() && all.len() > 1 {
            let mut steps: Vec<f64> = all.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
            steps.sort_by(f64::total_cmp);
            let period = steps[steps.len() / 2];
            let filter = Differentiator::for_motion(period, self.frequency).map_err(whole)?;
            self.filter = Some((filter, period));
        }
        let Some((filter, period)) = &self.filter else {
            self.kept = all;
            return Ok(Block::default());
        };
        let from = self.kept.len().saturating_sub(1);
        for (place, pair) in all.time.windows(2).enumerate().skip(from) {
            let step = pair[1] - pair[0];
            if (step - period).abs() > JITTER * period {
                let why = format!(
                    "{step:.3e} s after the row before, and others {period:.3e} s: velocities \
                     and accelerations cannot be differentiated over this; log them, or \
                     resample"
                );
                return Err((Some(all.rows[place + 1]), Error::new(why)));
            }
        }
        let half = filter.half();
        if all.len() <= 2 * half {
            self.kept = all;
            return Ok(Block::default());
        }
        let count = all.len() - 2 * half;
        let middle = half..half + count;
        let mut out = Block {
            rows: all.rows[middle.clone()].to_vec(),
            time: all.time[middle.clone()].to_vec(),
            ..Block::default()
        };
        for joint in 0..self.joints {
            let rates = differentiate(filter, all.column(0, joint)).map_err(whole)?;
            for (to, from) in out.quantities.iter_mut().zip(rates) {
                to.extend(from);
            }
            out.quantities[3].extend_from_slice(&all.column(3, joint)[middle.clone()]);
        }
        self.kept = last(&all, 2 * half, self.joints);
        Ok(out)
    }
}

/// Returns positions and torques of two blocks, one after the other.
fn joined(first: &Block, second: &Block, joints: usize) -> Block {
    let mut all = Block {
        rows: [&first.rows[..], &second.rows].concat(),
        time: [&first.time[..], &second.time].concat(),
        ..Block::default()
    };
    for quantity in [0, 3] {
        for joint in 0..joints {
            for block in [first, second]
                .into_iter()
                .filter(|block| !block.is_empty())
            {
                all.quantities[quantity].extend_from_slice(block.column(quantity, joint));
            }
        }
    }
    all
}

/// Returns the last states of a block.
fn last(block: &Block, count: usize, joints: usize) -> Block {
    let from = block.len() - count;
    let mut kept = Block {
        rows: block.rows[from..].to_vec(),
        time: block.time[from..].to_vec(),
        ..Block::default()
    };
    for quantity in [0, 3] {
        for joint in 0..joints {
            kept.quantities[quantity].extend_from_slice(&block.column(quantity, joint)[from..]);
        }
    }
    kept
}
