//! Integrates the motion of an arm under torques.

/// Positions and velocities of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<const N: usize> {
    /// Positions, rad.
    pub q: [f64; N],
    /// Velocities, rad/s.
    pub qd: [f64; N],
}

impl<const N: usize> State<N> {
    /// Returns the state after `period` seconds, by one step of the classical Runge–Kutta
    /// method; `acceleration` is the forward dynamics under torques that stay the same.
    pub fn step(&self, period: f64, acceleration: impl Fn(&State<N>) -> [f64; N]) -> State<N> {
        let rate = |state: &State<N>| State {
            q: state.qd,
            qd: acceleration(state),
        };
        let k1 = rate(self);
        let k2 = rate(&self.along(&k1, period / 2.0));
        let k3 = rate(&self.along(&k2, period / 2.0));
        let k4 = rate(&self.along(&k3, period));
        let mean = |of: fn(&State<N>) -> &[f64; N]| {
            core::array::from_fn(|i| {
                (of(&k1)[i] + 2.0 * of(&k2)[i] + 2.0 * of(&k3)[i] + of(&k4)[i]) / 6.0
            })
        };
        let rate = State {
            q: mean(|k| &k.q),
            qd: mean(|k| &k.qd),
        };
        self.along(&rate, period)
    }

    fn along(&self, rate: &State<N>, time: f64) -> State<N> {
        State {
            q: core::array::from_fn(|i| self.q[i] + time * rate.q[i]),
            qd: core::array::from_fn(|i| self.qd[i] + time * rate.qd[i]),
        }
    }
}

/// Returns the largest distance of a joint.
pub fn distance<const N: usize>(left: &[f64; N], right: &[f64; N]) -> f64 {
    largest(left.iter().zip(right).map(|(l, r)| (l - r).abs()))
}

/// Returns the largest of magnitudes; NaN if one is, so that a motion that blew up is not taken
/// for a good one.
pub fn largest(magnitudes: impl Iterator<Item = f64>) -> f64 {
    magnitudes.fold(0.0, |most, x| if x > most || x.is_nan() { x } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_blew_up_is_no_small_distance() {
        assert!(distance(&[1.0, f64::NAN, 2.0], &[0.0; 3]).is_nan());
        assert_eq!(distance(&[1.0, -3.0, 2.0], &[0.0; 3]), 3.0);
    }

    /// Fourth order: half the step gives a sixteenth of the error.
    #[test]
    fn an_oscillator_keeps_its_time() {
        let error = |steps: u32| {
            let period = 1.0 / f64::from(steps);
            let mut state = State {
                q: [1.0],
                qd: [0.0],
            };
            for _ in 0..steps {
                state = state.step(period, |state| [-state.q[0]]);
            }
            (state.q[0] - libm::cos(1.0)).abs()
        };
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
