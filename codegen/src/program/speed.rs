//! The reciprocal speed of a joint, r = 1/√(q̇² + w²), which code reads beside the velocity: it
//! smooths Coulomb friction over a width w.

use dalembert_model::equations::friction::per_speed;
use dalembert_model::number::Exact;

use super::Literal;
use super::machine::Machine;

/// A joint whose r may be read. The code squares the velocity, adds the square of
/// the width, takes the root and divides one by it.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed<C = Exact> {
    /// The joint, zero-based.
    pub joint: usize,
    /// w²: exact, or the literal that it was rounded to.
    pub square: C,
}

impl Speed<Literal> {
    /// Returns r as the code computes it, from the velocities; none if there is none of
    /// the joint.
    pub fn run<T: Machine>(&self, qd: &[T]) -> Option<T> {
        let qd = qd.get(self.joint)?;
        Some(per_speed(qd, &T::literal(self.square.0), |x| x.root()))
    }
}
