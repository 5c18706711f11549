//! The freedom in the parameters that leaves the dynamics alone.
//!
//! A mass distribution on the axis of a revolute joint moves the same way
//! whether it belongs to the link or to the one before: its mass, its first
//! moment along the axis and its second moment along the axis may be moved
//! over in any amount. The links of a slide never turn against each other, so
//! the second moments of the sliding link may move over whole. Nothing that
//! reaches the base matters at all.

use alloc::vec::Vec;

use super::{Body, Chain};
use crate::equations::matrix::{plus, scaled};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// What of a revolute link's second moment along its axis stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Axial {
    /// Nothing: Σzz = 0.
    None,
    /// All of it.
    All,
    /// Σzz = −Σxx: then I_yy = 0.
    MinusXx,
    /// Σzz = −Σyy: then I_xx = 0.
    MinusYy,
}

/// The gauge of one link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LinkGauge {
    /// Whether the origin lies after the constant part of the step along the
    /// axis (revolute), or at the next joint (prismatic).
    pub far_origin: bool,
    /// Whether the link keeps its mass.
    pub keep_mass: bool,
    /// Whether the link keeps its first moment along the axis.
    pub keep_first: bool,
    /// What it keeps of its second moments (prismatic: all or none).
    pub axial: Axial,
}

impl Default for LinkGauge {
    /// Base parameters.
    fn default() -> Self {
        LinkGauge {
            far_origin: true,
            keep_mass: false,
            keep_first: false,
            axial: Axial::None,
        }
    }
}

/// The gauge of a chain.
#[derive(Clone, Debug)]
pub struct Gauge<S> {
    /// One a link.
    pub links: Vec<LinkGauge>,
    /// The unit of length, in metres.
    pub unit: S,
    /// Its inverse.
    pub per_unit: S,
}

impl<S: Scalar> Gauge<S> {
    /// Base parameters in metres.
    pub fn base(n: usize) -> Self {
        Gauge {
            links: (0..n).map(|_| LinkGauge::default()).collect(),
            unit: S::one(),
            per_unit: S::one(),
        }
    }
}

impl<S: Scalar> Chain<S> {
    /// Moves over what each link does not keep, from the hand to the base.
    pub(super) fn regroup(&mut self, gauge: &Gauge<S>) {
        for i in (0..self.links.len()).rev() {
            let link = &self.links[i];
            let moving = match link.kind {
                JointKind::Revolute => on_axis(&link.body, &gauge.links[i]),
                JointKind::Prismatic => second_moments(&link.body, &gauge.links[i]),
            };
            let arriving = match link.kind {
                JointKind::Revolute => moving.carried(&link.rotation, &link.offset),
                // Second moments without mass have no place, only axes, and
                // these are shared.
                JointKind::Prismatic => moving.clone(),
            };
            self.links[i].body = self.links[i].body.with(&moving.negated());
            if i > 0 {
                self.links[i - 1].body = self.links[i - 1].body.with(&arriving);
            }
        }
    }

    /// Lengths in another unit.
    pub(super) fn change_unit(&mut self, unit: &S, per_unit: &S) {
        if unit.is_one() {
            return;
        }
        self.gravity = scaled(per_unit, &self.gravity);
        for link in &mut self.links {
            link.offset = scaled(per_unit, &link.offset);
            link.body = link.body.in_unit(unit);
        }
        self.per_unit = per_unit.clone();
    }
}

fn on_axis<S: Scalar>(body: &Body<S>, gauge: &LinkGauge) -> Body<S> {
    let mut moving = Body::zero();
    if !gauge.keep_mass {
        moving.mass = body.mass.clone();
    }
    if !gauge.keep_first {
        moving.first = [S::zero(), S::zero(), body.first[2].clone()];
    }
    let second = &body.second;
    moving.second.zz = match gauge.axial {
        Axial::None => second.zz.clone(),
        Axial::All => S::zero(),
        Axial::MinusXx => plus(&second.zz, &second.xx),
        Axial::MinusYy => plus(&second.zz, &second.yy),
    };
    moving
}

fn second_moments<S: Scalar>(body: &Body<S>, gauge: &LinkGauge) -> Body<S> {
    let mut moving = Body::zero();
    if gauge.axial != Axial::All {
        moving.second = body.second.clone();
    }
    moving
}
