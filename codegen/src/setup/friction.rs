//! Coulomb friction of a robot in its scene: the joints that have it, and the value 1/√(q̇² + w²).

use dalembert_model::equations::friction::per_speed;
use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Divide;

use super::Setup;
use crate::program::Speed;

impl Setup {
    fn width(&self, joint: usize) -> Option<&Rational> {
        let joint = self.robot().joints.get(joint)?;
        joint.has_coulomb().then_some(&joint.coulomb_width)
    }

    /// Returns the coordinates of joints with Coulomb friction, and the squares of their widths.
    pub fn speeds(&self) -> Vec<Speed> {
        let speed = |joint| {
            let width = self.width(joint)?;
            let square = Exact::from(width * width);
            let coordinate = self.robot().base_coordinates() + joint;
            Some(Speed { coordinate, square })
        };
        (0..self.joints()).filter_map(speed).collect()
    }

    pub fn has_coulomb(&self) -> bool {
        self.robot().joints.iter().any(|joint| joint.has_coulomb())
    }

    pub(super) fn per_speed_at_rest(&self, joint: usize) -> Option<Exact> {
        self.width(joint).map(|width| Exact::from(width.recip()))
    }

    /// Returns 1/√(q̇² + w²) of a coordinate in a scalar that has roots; zero without friction.
    pub fn per_speed<S: Divide>(
        &self,
        coordinate: usize,
        qd: &S,
        constant: impl Fn(&Exact) -> S,
        sqrt: impl Fn(&S) -> S,
    ) -> S {
        let joint = self.robot().joint_of(coordinate);
        match joint.and_then(|joint| self.width(joint)) {
            None => S::zero(),
            Some(width) => per_speed(qd, &constant(&Exact::from(width * width)), sqrt),
        }
    }
}
