//! Torques that swing the arm up: differential dynamic programming, with the second
//! derivatives of the dynamics or without (iLQR), and with the motor's limit as in Tassa,
//! Mansard and Todorov (2014).
//!
//! Backward from the end, the cost to go is approximated by a quadratic in the state; its
//! minimum gives the change of each torque and a gain on the state. Forward, smaller and
//! smaller fractions of the changes are tried on the arm until the cost falls. Nothing is
//! random: the plan is the same on every machine.

use crate::limited;
use crate::model::{Bend, HANGING, Square, State, UPRIGHT, bends, slopes, step};

/// The period of the plan, s.
pub const PERIOD: f64 = 0.02;
/// The number of periods.
pub const STEPS: usize = 250;
/// The cost of a torque, per (N·m)² and s.
const EFFORT: f64 = 0.1;
/// The cost of a state other than upright at rest, per rad² and s, (rad/s)² and s.
const ELSEWHERE: State = State::new(0.5, 0.5, 0.05, 0.05);
/// The cost of the last state, per rad² and (rad/s)².
const END: State = State::new(1000.0, 1000.0, 100.0, 100.0);
/// The search ends when a round lowers the cost by less than this.
const ENOUGH: f64 = 1e-4;
/// The smallest extra cost of a change of the next state.
const LEAST_CAUTION: f64 = 1e-6;
const ROUNDS: usize = 400;

/// Torques, and the states that they lead to.
#[derive(Clone, Debug)]
pub struct Plan {
    /// One torque per period, N·m.
    pub torques: Vec<f64>,
    /// The state at the start of each period, and the last state.
    pub states: Vec<State>,
    /// The feedback gains, one row per period.
    pub gains: Vec<State>,
    /// The cost before each round and after the last.
    pub costs: Vec<f64>,
}

/// The derivatives of the dynamics that a plan uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivatives {
    /// First derivatives only (iLQR).
    First,
    /// First and second derivatives.
    Second,
}

/// Returns a plan from hanging at rest to upright at rest.
pub fn plan(derivatives: Derivatives) -> Plan {
    let mut plan = Plan::still(HANGING, STEPS);
    plan.costs.push(plan.cost());
    // The extra cost of a change of the next state: it keeps changes small where quadratics
    // approximate badly.
    let mut caution = LEAST_CAUTION;
    for _ in 0..ROUNDS {
        // Far from the best plan, quadratics with second derivatives may have no minimum, or a
        // useless one: then first derivatives work better.
        let bent = (derivatives == Derivatives::Second)
            .then(|| plan.better(LEAST_CAUTION, derivatives))
            .flatten()
            .filter(|(_, part)| *part > 0.1);
        let Some((better, part)) = bent.or_else(|| plan.better(caution, Derivatives::First)) else {
            if caution > 1e6 {
                break;
            }
            caution *= 10.0;
            continue;
        };
        let gained = plan.cost() - better.cost();
        plan = better;
        if part == 1.0 {
            caution = (caution / 3.0).max(LEAST_CAUTION);
        }
        if gained < ENOUGH {
            break;
        }
    }
    // Gains with first derivatives: those quadratics always have a minimum.
    if let Some((_, gains)) = plan.backward(PERIOD, LEAST_CAUTION, Derivatives::First) {
        plan.gains = gains;
    }
    plan
}

/// Returns the gain that holds the arm upright: the first one of a backward pass over 20 s at the
/// upright pose.
pub fn holding(period: f64) -> State {
    let still = Plan::still(UPRIGHT, (20.0 / period) as usize);
    let changes = still.backward(period, 0.0, Derivatives::First);
    changes.map_or(State::zeros(), |(_, gains)| gains[0])
}

impl Plan {
    fn still(state: State, steps: usize) -> Plan {
        Plan {
            torques: vec![0.0; steps],
            states: vec![state; steps + 1],
            gains: vec![State::zeros(); steps],
            costs: Vec::new(),
        }
    }

    /// Returns the cost: ½∫ (r τ² + xᵀ Q x) dt + ½ xᵀ W x at the end, with x the distance from
    /// upright at rest.
    pub fn cost(&self) -> f64 {
        let square = |off: &State, weights: &State| off.component_mul(weights).dot(off);
        let mut along = 0.0;
        for (torque, state) in self.torques.iter().zip(&self.states) {
            along += EFFORT * torque * torque + square(&(state - UPRIGHT), &ELSEWHERE);
        }
        (PERIOD * along + square(&self.off(), &END)) / 2.0
    }

    /// Returns the difference between the end and upright at rest.
    pub fn off(&self) -> State {
        self.states[self.torques.len()] - UPRIGHT
    }

    /// Returns the changes of the torques at the minima of the quadratics, and the gains on the
    /// states; `None` if a quadratic has no minimum.
    fn backward(
        &self,
        period: f64,
        caution: f64,
        derivatives: Derivatives,
    ) -> Option<(Vec<f64>, Vec<State>)> {
        let mut slope = self.off().component_mul(&END);
        let mut bend = Square::from_diagonal(&END);
        let mut changes = vec![0.0; self.torques.len()];
        let mut gains = vec![State::zeros(); self.torques.len()];
        for k in (0..self.torques.len()).rev() {
            let (state, torque) = (&self.states[k], self.torques[k]);
            let slopes = slopes(state, torque, period);
            let (by_state, by_torque) = (slopes.fixed_columns::<4>(0), slopes.column(4));
            let carried = bend * by_torque;
            let of_torque = EFFORT * period * torque + by_torque.dot(&slope);
            let bent = match derivatives {
                Derivatives::First => Bend::zeros(),
                Derivatives::Second => bends(state, torque, period, &slope),
            };
            let of_torques = EFFORT * period + by_torque.dot(&carried) + bent[(4, 4)];
            let mixed = by_state.transpose() * carried + bent.fixed_view::<4, 1>(0, 4);
            let wary = by_state.transpose() * by_torque * caution + mixed;
            let lowest = of_torques + caution * by_torque.dot(&by_torque);
            if lowest <= 0.0 {
                return None;
            }
            let free = torque - of_torque / lowest;
            let change = limited(free) - torque;
            // A torque at its limit has no feedback.
            let gain = match limited(free) == free {
                true => wary * (-1.0 / lowest),
                false => State::zeros(),
            };
            let weights = ELSEWHERE * period;
            slope = (state - UPRIGHT).component_mul(&weights)
                + by_state.transpose() * slope
                + gain * (of_torques * change + of_torque)
                + mixed * change;
            bend = Square::from_diagonal(&weights)
                + by_state.transpose() * bend * by_state
                + bent.fixed_view::<4, 4>(0, 0)
                + gain * gain.transpose() * of_torques
                + gain * mixed.transpose()
                + mixed * gain.transpose();
            // Rounding makes it asymmetric; this would grow, since upright is unstable.
            bend = (bend + bend.transpose()) / 2.0;
            (changes[k], gains[k]) = (change, gain);
        }
        Some((changes, gains))
    }

    /// Returns a better plan, and its fraction of the changes: 1, halved until the cost falls.
    /// `None` if it does not fall.
    fn better(&self, caution: f64, derivatives: Derivatives) -> Option<(Plan, f64)> {
        let (changes, gains) = self.backward(PERIOD, caution, derivatives)?;
        let mut part = 1.0;
        while part > 1e-4 {
            let mut tried = Plan {
                torques: Vec::new(),
                states: vec![HANGING],
                gains: gains.clone(),
                costs: self.costs.clone(),
            };
            for (k, change) in changes.iter().enumerate() {
                let off = tried.states[k] - self.states[k];
                let torque = limited(self.torques[k] + part * change + gains[k].dot(&off));
                tried.states.push(step(&tried.states[k], torque, PERIOD));
                tried.torques.push(torque);
            }
            if tried.cost() < self.cost() {
                tried.costs.push(tried.cost());
                return Some((tried, part));
            }
            part /= 2.0;
        }
        None
    }
}
