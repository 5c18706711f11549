//! Velocities and accelerations of positions, or accelerations of velocities, block by block.

use dalembert_fit::{Differentiator, differentiate};

use super::block::Block;
use super::mapping::QUANTITIES;
use crate::error::Error;

/// By how much of a period a step may be off: the filter is one for equal times.
const JITTER: f64 = 0.1;
/// The part of the squares of the positions' rates by which velocities may differ from them.
const WRONG: f64 = 0.25;
/// Joints that move by less of the fastest one's squares are not judged.
const STILL: f64 = 1e-4;

pub(super) struct Rates {
    frequency: f64,
    filter: Option<(Differentiator, f64)>,
    /// Measured rates are filtered as positions are, so that all belong to the same instant.
    measured: [bool; 2],
    /// The end of earlier blocks, at least a window less one: rows, times, each joint's quantities.
    rows: Vec<u64>,
    time: Vec<f64>,
    states: Vec<[Vec<f64>; 4]>,
    /// For each joint: the squares of the positions' rates, and of the measured velocities less these.
    squares: Vec<[f64; 2]>,
}

impl Rates {
    pub(super) fn new(joints: usize, frequency: f64, measured: [bool; 2]) -> Rates {
        Rates {
            frequency,
            filter: None,
            measured,
            rows: Vec::new(),
            time: Vec::new(),
            states: vec![Default::default(); joints],
            squares: vec![[0.0; 2]; joints],
        }
    }

    pub(super) fn told(&self) -> String {
        let what = match self.measured {
            [true, _] => "accelerations are differentiated from measured velocities",
            [false, true] => "velocities are differentiated from positions",
            [false, false] => "velocities and accelerations are differentiated from positions",
        };
        what.to_owned()
    }

    pub(super) fn disagreeing(&self) -> Option<usize> {
        let rates = self.squares.iter().map(|[rate, _]| *rate);
        let most = rates.fold(0.0, f64::max);
        let is_wrong = |[rate, other]: &[f64; 2]| *rate > STILL * most && *other > WRONG * rate;
        self.squares.iter().position(is_wrong)
    }

    /// Takes the next block; returns the states whose window is whole.
    pub(super) fn next(&mut self, block: Block) -> Result<Block, Error> {
        let from = self.time.len().saturating_sub(1);
        let [velocity, acceleration] = self.measured;
        let used = [true, velocity, acceleration, true];
        for (quantity, name) in QUANTITIES.iter().enumerate() {
            if used[quantity] && !block.has(quantity) && !block.is_empty() {
                let why = format!("there is no {name} from here on: log it always, or never");
                return Err(Error::new(why).at_row(block.rows[0]));
            }
        }
        self.rows.extend(&block.rows);
        self.time.extend(&block.time);
        for (joint, states) in self.states.iter_mut().enumerate() {
            for (quantity, column) in states.iter_mut().enumerate() {
                if used[quantity] && !block.is_empty() {
                    column.extend(block.column(quantity, joint));
                }
            }
        }
        if self.filter.is_none() && self.time.len() > 1 {
            let mut steps: Vec<f64> = self.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
            steps.sort_by(f64::total_cmp);
            let period = steps[steps.len() / 2];
            self.filter = Some((self.differentiator(period)?, period));
        }
        let Some((filter, period)) = &self.filter else {
            return Ok(Block::default());
        };
        for (place, pair) in self.time.windows(2).enumerate().skip(from) {
            let step = pair[1] - pair[0];
            if (step - period).abs() > JITTER * period {
                let why = format!(
                    "{step:.3e} s after the row before, and others {period:.3e} s: velocities and \
                     accelerations cannot be differentiated over this; log them, or resample"
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
        for (states, squares) in self.states.iter_mut().zip(&mut self.squares) {
            let [q, mut qd, mut qdd] = differentiate(filter, &states[0])?;
            if velocity {
                let [smooth, slope, _] = differentiate(filter, &states[1])?;
                for (rate, speed) in qd.iter().zip(&smooth) {
                    squares[0] += rate * rate;
                    squares[1] += (speed - rate).powi(2);
                }
                (qd, qdd) = (smooth, slope);
            }
            if acceleration {
                [qdd, ..] = differentiate(filter, &states[2])?;
            }
            let torque = states[3][half..half + count].to_vec();
            for (to, from) in out.quantities.iter_mut().zip([q, qd, qdd, torque]) {
                to.extend(from);
            }
            for column in states.iter_mut() {
                column.drain(..count.min(column.len()));
            }
        }
        Ok(out)
    }

    fn differentiator(&self, period: f64) -> Result<Differentiator, Error> {
        let filter = Differentiator::for_motion(period, self.frequency);
        filter.map_err(|why| match why {
            dalembert_fit::Error::TooFast {
                rate,
                most,
                frequency,
            } => Error::new(format!(
                "{rate:.0} states a second carry motion up to {most:.2} Hz, and --motion-frequency \
                 is {frequency}: set it to the fastest motion in the log"
            )),
            other => Error::new(other),
        })
    }
}
