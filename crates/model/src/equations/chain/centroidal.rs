//! The momentum of a floating robot about its centre of mass, and its motion if nothing holds it.

use alloc::vec::Vec;

use super::body::{MomentBody, entry};
use super::composite::Composite;
use super::floating::unit_twists;
use super::form::Form;
use super::recursion::{LinkMotion, Motions};
use crate::equations::BASE_COORDINATES;
use crate::equations::centroidal::about;
use crate::equations::factor::Factor;
use crate::equations::matrix::*;
use crate::equations::screws::{Twist, Wrench};
use crate::robot::Inertia;
use crate::scalar::Divide;

/// A robot as one body: 1/mass, the centre of mass in the chain's unit, and the tensor about it.
struct Whole<S> {
    per_mass: S,
    centre: Vector<S>,
    tensor: Inertia<S>,
}

impl<S: Divide> Whole<S> {
    fn new(body: &MomentBody<S>) -> Whole<S> {
        let per_mass = S::one().div(&body.mass);
        let centre = scaled(&per_mass, &body.first);
        let [first, second] = [&body.first, &centre];
        let mut about_centre = MomentBody::zero();
        about_centre.second = Inertia::symmetric(|i, j| {
            minus(entry(&body.second, i, j), &times(&first[i], &second[j]))
        });
        Whole {
            per_mass,
            centre,
            tensor: about_centre.tensor(),
        }
    }

    fn row(&self, axis: usize) -> Vector<S> {
        three(|k| entry(&self.tensor, axis, k).clone())
    }

    /// Returns the acceleration that a wrench about the origin gives.
    fn driven(&self, wrench: &Wrench<S>) -> Twist<S> {
        let moment = difference(&wrench.moment, &cross(&self.centre, &wrench.force));
        let tensor: Matrix<S> = (0..3).map(|axis| self.row(axis).to_vec()).collect();
        let turn = Factor::new(&tensor).solve(&moment);
        let turn = three(|axis| turn[axis].clone());
        let by_force = scaled(&self.per_mass, &wrench.force);
        let shift = sum(&by_force, &cross(&self.centre, &turn));
        Twist { turn, shift }
    }
}

impl<S: Divide> Composite<'_, S> {
    /// Returns the centre of mass of a floating robot, m; none on a fixed base.
    pub fn centre_of_mass(&self) -> Option<Vector<S>> {
        let whole = Whole::new(self.base.as_ref()?);
        let in_metres = |x: &S| x.div(&self.chain.per_unit);
        Some(whole.centre.each_ref().map(in_metres))
    }

    /// Returns the momentum of each coordinate about the centre of mass, linear over angular, 6×n.
    pub fn centroidal_momentum_matrix(&self) -> Option<Matrix<S>> {
        let body = self.base.as_ref()?;
        let (whole, chain) = (Whole::new(body), self.chain);
        let units = unit_twists().into_iter().enumerate();
        let of_base = units.map(|(k, unit)| {
            let (force, moment) = match k < 3 {
                true => (scaled(&body.mass, &unit.shift), zero_vector()),
                false => (cross(&unit.turn, &body.first), whole.row(k - 3)),
            };
            Wrench { force, moment }
        });
        let of_joints = (0..chain.links.len()).map(|k| {
            let Wrench { force, moment } = self.push_on_base(k);
            let moment = difference(&moment, &cross(&whole.centre, &force));
            Wrench { force, moment }
        });
        let columns = of_base.chain(of_joints).enumerate().map(|(k, momentum)| {
            let six = chain.on_base(&momentum);
            six.map(|x| chain.coordinate_in_metres(k, x)).to_vec()
        });
        Some(columns_of(&columns.collect::<Vec<_>>()))
    }

    /// Returns the rate of that momentum, from h.
    pub fn centroidal_bias(&self, h: &[S]) -> Option<[S; 6]> {
        let centre = self.centre_of_mass()?;
        let [force, moment] = parts(h);
        Some(about(&centre, &Wrench { force, moment }))
    }

    /// Returns the torques of a floating robot that nothing holds, and the accelerations of its base:
    /// it falls, and what joints do to the base then accelerates it further. None on a fixed base.
    pub fn in_flight(&self, [qd, qdd]: [&[S]; 2], form: Form) -> Option<(Vec<S>, [S; 6])> {
        let (chain, at) = (self.chain, self.at);
        let whole = Whole::new(self.base.as_ref()?);
        let (rates, accelerations) = (chain.rates(qd), chain.rates(qdd));
        let (fall, base) = chain.falling(qd);
        let links = chain.outward(base.clone(), |i, before: &LinkMotion<S>| {
            let (rate, acceleration) = (&rates[i], &accelerations[i]);
            before.next(&chain.links[i], &at[i], rate, acceleration, form.spin)
        });
        let drive = |i: usize| chain.drive(i, qd, qdd);
        let motions = Motions { base, links };
        let loads = chain.torques(at, &motions, form.couple, &zero_vector(), drive);
        let driven = |from: usize, scale: &S| three(|i| negative(&loads[from + i]).div(scale));
        let (force, moment) = (driven(0, &chain.per_unit), driven(3, &S::one()));
        let pushed = whole.driven(&Wrench { force, moment });
        let felt = chain.outward(pushed.clone(), |i, before: &Twist<S>| {
            chain.links[i].twist_outward(&at[i], before)
        });
        let mut torques = zeros(BASE_COORDINATES);
        torques.extend(felt.iter().enumerate().map(|(k, twist)| {
            let more = chain.rescaled(k, self.momentum(k).along(twist));
            plus(&loads[BASE_COORDINATES + k], &more)
        }));
        let metres = pushed.shift.each_ref().map(|x| x.div(&chain.per_unit));
        let more: Vec<S> = metres.into_iter().chain(pushed.turn).collect();
        let base = core::array::from_fn(|k| plus(&fall[k], &more[k]));
        Some((torques, base))
    }
}
