//! The freedom in the parameters that leaves the dynamics alone: what of a link's moments may
//! belong to the link before, where an origin lies, and the unit of length.

use alloc::vec::Vec;

use super::{Chain, ChainLink, MomentBody, Probe, Skeleton, apply};
use crate::equations::matrix::*;
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// The regrouping of one link, in metres and kilograms.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRegrouping<S> {
    /// The frame's origin from the end of the step before the joint, in the axes of the
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
    /// By how many joints with parallel axes the frame turns more than its link, as far as it can
    /// ([`Chain::freedoms`]): no parameter moves, only the axes in which the link is seen change.
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

/// A chain in metres, which another regrouping of one link changes in part.
#[derive(Clone, Debug)]
pub struct MetricChain<S> {
    /// The chain, whatever the unit of its regrouping.
    pub chain: Chain<S>,
    /// The moments that arrive from each link at the one that carries it.
    arriving: Vec<MomentBody<S>>,
}

impl<S: Scalar> MetricChain<S> {
    /// Returns the chain of a skeleton in a regrouping.
    pub fn new(skeleton: &Skeleton<S>, regrouping: &Regrouping<S>) -> Self {
        MetricChain::from_known(skeleton, regrouping, None)
    }

    /// Returns the chain after the regrouping of one link has changed: only that link, those that it
    /// carries itself and those that carry it are made anew.
    #[must_use]
    pub fn changed(&self, skeleton: &Skeleton<S>, regrouping: &Regrouping<S>, at: usize) -> Self {
        MetricChain::from_known(skeleton, regrouping, Some((self, at)))
    }

    fn from_known(
        skeleton: &Skeleton<S>,
        regrouping: &Regrouping<S>,
        known: Option<(&Self, usize)>,
    ) -> Self {
        let n = skeleton.links.len();
        let segments = skeleton.links.iter();
        let parents: Vec<Option<usize>> = segments.map(|segment| segment.link.parent).collect();
        let mut kept: Vec<Option<(&ChainLink<S>, &MomentBody<S>)>> = alloc::vec![None; n];
        if let Some((known, at)) = known {
            let links = known.chain.links.iter();
            kept = links.zip(&known.arriving).map(Some).collect();
            for i in (at..n).filter(|&i| i == at || parents[i] == Some(at)) {
                kept[i] = None;
            }
            for i in core::iter::successors(parents[at], |&i| parents[i]) {
                kept[i] = None;
            }
        }
        let links = (0..n).map(|i| match kept[i] {
            Some((link, _)) => link.clone(),
            None => placed(skeleton, regrouping, i, !parents.contains(&Some(i))),
        });
        let mut chain = Chain {
            gravity: skeleton.gravity.clone(),
            base: skeleton.base.clone(),
            base_probes: skeleton.base_probes.clone(),
            links: links.collect(),
            per_unit: S::one(),
            columns: skeleton.columns,
        };
        let arriving = from_hand(0..n, |i| {
            let arriving = match kept[i] {
                Some((_, arriving)) => arriving.clone(),
                None => chain.links[i].regroup(&regrouping.links[i]),
            };
            let carrier = match parents[i] {
                Some(parent) if kept[parent].is_some() => None,
                Some(parent) => Some(&mut chain.links[parent].body),
                None => chain.base.as_mut(),
            };
            if let Some(body) = carrier {
                *body = body.with(&arriving);
            }
            arriving
        });
        MetricChain { chain, arriving }
    }

    /// Returns the chain in the unit of a regrouping.
    pub fn in_unit(&self, regrouping: &Regrouping<S>) -> Chain<S> {
        let (unit, per_unit) = (&regrouping.unit, &regrouping.per_unit);
        let mut chain = self.chain.clone();
        if unit.is_one() {
            return chain;
        }
        chain.gravity = scaled(per_unit, &chain.gravity);
        chain.base = chain.base.as_ref().map(|body| body.in_unit(unit));
        chain.base_probes = Probe::each(&chain.base_probes, |body| body.in_unit(unit));
        for link in &mut chain.links {
            link.offset = scaled(per_unit, &link.offset);
            link.body = link.body.in_unit(unit);
            link.probes = Probe::each(&link.probes, |body| body.in_unit(unit));
        }
        chain.per_unit = per_unit.clone();
        chain
    }
}

/// Returns a link about the origin that its regrouping chooses, before any moment moves.
fn placed<S: Scalar>(
    skeleton: &Skeleton<S>,
    regrouping: &Regrouping<S>,
    i: usize,
    is_tip: bool,
) -> ChainLink<S> {
    let choices = &regrouping.links;
    let (link, origin) = (&skeleton.links[i].link, &choices[i].origin);
    // The regrouping moved the origin of the frame before by this.
    let shift = (link.parent).map_or_else(zero_vector, |parent| choices[parent].origin.clone());
    let step = match link.kind {
        JointKind::Revolute => apply(&link.rotation, origin),
        JointKind::Prismatic => origin.clone(),
    };
    let back = opposite(origin);
    let body = link.body.moved(&back);
    ChainLink {
        offset: sum(&difference(&link.offset, &shift), &step),
        probes: Probe::each(&link.probes, |body| body.moved(&back)),
        axes: choices[i].axes,
        // A frame need not turn if its link looks the same after any turn and has no probe.
        spins_freely: is_tip
            && link.kind == JointKind::Revolute
            && link.probes.is_empty()
            && body.is_axisymmetric(),
        body,
        ..link.clone()
    }
}

impl<S: Scalar> ChainLink<S> {
    /// Gives away the moments that it need not keep: returns what arrives at the link before.
    fn regroup(&mut self, keep: &LinkRegrouping<S>) -> MomentBody<S> {
        let moving = self.moving(&self.body, keep);
        let body = &self.body;
        self.free = [&body.mass, &body.first[2], &body.second.zz].map(S::clone);
        self.body = body.with(&moving.negated());
        self.arriving(&moving)
    }

    fn moving(&self, body: &MomentBody<S>, keep: &LinkRegrouping<S>) -> MomentBody<S> {
        let mut moving = MomentBody::zero();
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

    fn arriving(&self, moving: &MomentBody<S>) -> MomentBody<S> {
        match self.kind {
            JointKind::Revolute => moving.carried(&self.rotation, &self.offset),
            // Second moments without mass have no place, only axes, and these are shared.
            JointKind::Prismatic => moving.clone(),
        }
    }

    /// Splits a body into the part that the link keeps where all moves that can, and the part that
    /// arrives before it.
    pub fn split_base(&self, body: &MomentBody<S>) -> (MomentBody<S>, MomentBody<S>) {
        let moving = self.moving(body, &LinkRegrouping::base(zero_vector()));
        (body.with(&moving.negated()), self.arriving(&moving))
    }
}
