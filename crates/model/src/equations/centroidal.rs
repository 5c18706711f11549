//! The momentum of all that moves about its common centre of mass (Orin, Goswami and Lee, "Centroidal
//! dynamics of a humanoid robot", 2013), and a robot that nothing holds.
//!
//! The momentum is the wrench on the base that an acceleration equal to the velocity takes from rest,
//! without gravity. Its rate at accelerations zero is the wrench that velocities take.

use alloc::vec::Vec;

use super::factor::{Factor, submatrix};
use super::kinematics::poses;
use super::matrix::*;
use super::newton_euler::table2;
use super::screws::Wrench;
use super::{Arm, At, BASE_COORDINATES, Formulation};
use crate::robot::Convention;
use crate::scalar::{Divide, Scalar};

/// Returns force over moment about a point, from those about the origin.
pub(super) fn about<S: Scalar>(point: &Vector<S>, wrench: &Wrench<S>) -> [S; 6] {
    let Wrench { force, moment } = wrench;
    let [a, b, c] = difference(moment, &cross(point, force));
    let [x, y, z] = force.clone();
    [x, y, z, a, b, c]
}

impl Formulation {
    /// Returns the common centre of mass of all links in base axes, from the base's origin, m.
    pub fn centre_of_mass<S: Divide>(self, arm: &Arm<S>, at: &At<S>) -> Vector<S> {
        let mass = total(arm.links.iter().map(|link| link.mass.clone()));
        three(|axis| {
            let unit = three(|i| if i == axis { S::one() } else { S::zero() });
            let pulled = arm.clone().with_gravity(&unit);
            negative(&self.potential_energy(&pulled, at)).div(&mass)
        })
    }

    /// Returns A of the momentum A q̇ about the centre of mass, base axes, 6×n: linear over angular.
    pub fn centroidal_momentum_matrix<S: Divide>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        let (centre, arm, n) = (self.centre_of_mass(arm, at), arm.weightless(), at.len());
        let rest = zeros(n);
        let columns = (0..n).map(|k| {
            let taken = self.wrench_on_base(&arm, at, [&rest, &unit(n, k)]);
            about(&centre, &taken).to_vec()
        });
        columns_of(&columns.collect::<Vec<_>>())
    }

    /// Returns Ȧ q̇, the rate of that momentum where accelerations are zero.
    pub fn centroidal_bias<S: Divide>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> [S; 6] {
        let centre = self.centre_of_mass(arm, at);
        let taken = self.wrench_on_base(&arm.weightless(), at, [qd, &zeros(qd.len())]);
        about(&centre, &taken)
    }

    /// Returns the wrench that the ground exerts on the base, about the base's origin in base axes.
    fn wrench_on_base<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, rates: [&[S]; 2]) -> Wrench<S> {
        let [qd, qdd] = rates;
        if let Some(moment) = self.moment() {
            let qdd = &*arm.accelerations(qd, qdd);
            let wrench = table2::wrench_on_base(arm, at, [qd, qdd], moment);
            let base = arm.frame_0();
            return wrench.carried(|v| base.rotate(v), &base.origin);
        }
        let (wrenches, poses) = (self.wrenches(arm, at, rates), poses(arm, at));
        let carried = (0..at.len()).filter(|&link| arm.carrier(link).is_none());
        carried.fold(Wrench::zero(), |total, link| {
            let point = match arm.convention {
                Convention::Standard => &arm.frame_0().origin,
                Convention::Modified => &poses[link].origin,
            };
            total.with(&wrenches[link].carried(Vector::clone, point))
        })
    }

    /// Returns the accelerations of the base's coordinates if nothing holds it, while the joints have
    /// theirs: those of the base among `qdd` are not read.
    pub fn free_base<S: Divide>(self, arm: &Arm<S>, at: &At<S>, [qd, qdd]: [&[S]; 2]) -> Vec<S> {
        let base: Vec<usize> = (0..BASE_COORDINATES).collect();
        let base_inertia = submatrix(&self.inertia(arm, at), &base);
        let mut rest = qdd.to_vec();
        rest[..BASE_COORDINATES].fill(S::zero());
        let taken = self.inverse_dynamics(arm, at, qd, &rest);
        let driven: Vec<S> = taken[..BASE_COORDINATES].iter().map(negative).collect();
        Factor::new(&base_inertia).solve(&driven)
    }
}
