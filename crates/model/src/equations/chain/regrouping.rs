//! The freedom in the parameters that leaves the dynamics alone: what of a link's moments may
//! belong to the link before, where an origin lies, and the unit of length.

use alloc::vec::Vec;

use super::{Body, Chain, ChainLink, Probe, Skeleton};
use crate::equations::matrix::{Vector, scaled, zero_vector};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// The regrouping of one link, in metres and kilograms.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRegrouping<S> {
    /// Where the frame's origin lies, from the end of the step before the joint, in the axes of the
    /// frame: on the axis for a revolute joint, anywhere for a prismatic one.
    pub origin: Vector<S>,
    /// The mass that a revolute link keeps.
    pub mass: S,
    /// The first moment along the axis that it keeps.
    pub first: S,
    /// The second moment along the axis, Σzz, that it keeps.
    pub second: S,
    /// True if a prismatic link keeps its second moments.
    pub keep_seconds: bool,
    /// By how many joints with parallel axes the frame turns more than its
    /// link (less if negative), as far as it can ([`Chain::freedoms`]): no
    /// parameter moves, only the axes in which the link is seen change.
    pub axes: i32,
}

impl<S: Scalar> LinkRegrouping<S> {
    fn base(origin: Vector<S>) -> Self {
        LinkRegrouping {
            origin,
            mass: S::zero(),
            first: S::zero(),
            second: S::zero(),
            keep_seconds: false,
            axes: 0,
        }
    }
}

/// The regrouping of a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Regrouping<S> {
    /// One a link.
    pub links: Vec<LinkRegrouping<S>>,
    /// The unit of length, in metres.
    pub unit: S,
    /// Its inverse.
    pub per_unit: S,
}

impl<S: Scalar> Regrouping<S> {
    /// Makes base parameters in metres: a revolute link keeps nothing that can move, and its
    /// origin lies after the constant step along the axis.
    pub fn base(skeleton: &Skeleton<S>) -> Self {
        let links = skeleton.links.iter().map(|segment| {
            LinkRegrouping::base(match segment.link.kind {
                JointKind::Revolute => [S::zero(), S::zero(), segment.d.clone()],
                JointKind::Prismatic => zero_vector(),
            })
        });
        Regrouping {
            links: links.collect(),
            unit: S::one(),
            per_unit: S::one(),
        }
    }
}

impl<S: Scalar> Chain<S> {
    pub(super) fn regroup(&mut self, regrouping: &Regrouping<S>) {
        for i in (0..self.links.len()).rev() {
            let link = &self.links[i];
            let moving = link.moving(&link.body, &regrouping.links[i]);
            let arriving = link.arriving(&moving);
            let link = &mut self.links[i];
            let body = &link.body;
            link.free = [
                body.mass.clone(),
                body.first[2].clone(),
                body.second.zz.clone(),
            ];
            link.body = body.with(&moving.negated());
            let carrier = match link.parent {
                Some(parent) => Some(&mut self.links[parent].body),
                None => self.base.as_mut(),
            };
            if let Some(body) = carrier {
                *body = body.with(&arriving);
            }
        }
    }

    pub(super) fn change_unit(&mut self, unit: &S, per_unit: &S) {
        if unit.is_one() {
            return;
        }
        self.gravity = scaled(per_unit, &self.gravity);
        self.base = self.base.as_ref().map(|body| body.in_unit(unit));
        for link in &mut self.links {
            link.offset = scaled(per_unit, &link.offset);
            link.body = link.body.in_unit(unit);
            link.probes = Probe::each(&link.probes, |body| body.in_unit(unit));
        }
        self.per_unit = per_unit.clone();
    }
}

impl<S: Scalar> ChainLink<S> {
    fn moving(&self, body: &Body<S>, keep: &LinkRegrouping<S>) -> Body<S> {
        let mut moving = Body::zero();
        match self.kind {
            JointKind::Revolute => {
                moving.mass = body.mass.sub(&keep.mass);
                moving.first[2] = body.first[2].sub(&keep.first);
                moving.second.zz = body.second.zz.sub(&keep.second);
            }
            JointKind::Prismatic if keep.keep_seconds => {}
            JointKind::Prismatic => moving.second = body.second.clone(),
        }
        moving
    }

    fn arriving(&self, moving: &Body<S>) -> Body<S> {
        match self.kind {
            JointKind::Revolute => moving.carried(&self.rotation, &self.offset),
            // Second moments without mass have no place, only axes, and these are shared.
            JointKind::Prismatic => moving.clone(),
        }
    }

    /// Returns what the link keeps of a body where all moves that can, and what arrives before it.
    pub fn split_base(&self, body: &Body<S>) -> (Body<S>, Body<S>) {
        let moving = self.moving(body, &LinkRegrouping::base(zero_vector()));
        (body.with(&moving.negated()), self.arriving(&moving))
    }
}
