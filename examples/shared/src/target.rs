//! A point of a reference trajectory.

/// A point of a trajectory of joints.
#[derive(Clone, Copy, Debug)]
pub struct Target<const N: usize> {
    /// Positions, rad.
    pub q: [f64; N],
    /// Velocities, rad/s.
    pub qd: [f64; N],
    /// Accelerations, rad/s².
    pub qdd: [f64; N],
}

impl<const N: usize> Target<N> {
    /// At rest.
    pub fn resting(q: [f64; N]) -> Target<N> {
        Target {
            q,
            qd: [0.0; N],
            qdd: [0.0; N],
        }
    }

    /// This and a swing by twice `amplitude` and back, rad, which starts at rest:
    /// amplitude (1 − cos ωt) of every joint, ω in rad/s and the time in s.
    #[must_use]
    pub fn swinging(mut self, amplitude: &[f64; N], frequency: &[f64; N], time: f64) -> Self {
        for i in 0..N {
            let (amplitude, frequency) = (amplitude[i], frequency[i]);
            let (sin, cos) = libm::sincos(frequency * time);
            self.q[i] += amplitude * (1.0 - cos);
            self.qd[i] += amplitude * frequency * sin;
            self.qdd[i] += amplitude * frequency * frequency * cos;
        }
        self
    }
}
