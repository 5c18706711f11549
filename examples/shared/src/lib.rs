//! Code that the examples share: the motion of an arm, and a check that a page shows what a program
//! prints. Your own program needs none of it.
#![forbid(unsafe_code)]

use std::process::Command;

/// Positions and velocities of an arm, rad and rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<const N: usize> {
    pub q: [f64; N],
    pub qd: [f64; N],
}

impl<const N: usize> State<N> {
    /// Returns the state of an arm at rest.
    pub fn at_rest(q: [f64; N]) -> State<N> {
        State { q, qd: [0.0; N] }
    }

    /// Returns the state after `period` seconds, by one step of the classical Runge–Kutta
    /// method; `acceleration` is the forward dynamics under constant torques.
    pub fn step(&self, period: f64, acceleration: impl Fn(&State<N>) -> [f64; N]) -> State<N> {
        let (mut at, mut end) = (*self, *self);
        for (weight, ahead) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
            let (qd, qdd) = (at.qd, acceleration(&at));
            end = end.along(&qd, &qdd, weight * period / 6.0);
            at = self.along(&qd, &qdd, ahead * period);
        }
        end
    }

    fn along(&self, qd: &[f64; N], qdd: &[f64; N], time: f64) -> State<N> {
        State {
            q: core::array::from_fn(|i| self.q[i] + time * qd[i]),
            qd: core::array::from_fn(|i| self.qd[i] + time * qdd[i]),
        }
    }
}

/// Returns the largest difference, over all joints, between two vectors.
pub fn distance<const N: usize>(left: &[f64; N], right: &[f64; N]) -> f64 {
    largest(left.iter().zip(right).map(|(l, r)| l - r))
}

/// Returns the largest magnitude; NaN if a value is NaN, so that a simulation that diverged does
/// not pass for a good one.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, x: f64| if x > most || x.is_nan() { x } else { most };
    values.into_iter().map(f64::abs).fold(0.0, larger)
}

/// Runs a program; panics unless it succeeds and the page shows what it prints.
pub fn assert_shown(program: &str, page: &str) {
    let output = Command::new(program).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    let is_shown = page.contains(&*text);
    assert!(is_shown, "the page shows something else:\n{text}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_that_blew_up_is_not_near() {
        assert!(distance(&[1.0, f64::NAN, 2.0], &[0.0; 3]).is_nan());
        assert_eq!(distance(&[1.0, -3.0, 2.0], &[0.0; 3]), 3.0);
    }

    /// Fourth order: half the step gives a sixteenth of the error.
    #[test]
    fn an_oscillator_keeps_its_time() {
        let error = |steps: u32| {
            let mut state = State::at_rest([1.0]);
            for _ in 0..steps {
                state = state.step(1.0 / f64::from(steps), |state| [-state.q[0]]);
            }
            (state.q[0] - 1.0f64.cos()).abs()
        };
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
