//! A chain before its regrouping is chosen: one segment a joint that moves. A joint that is
//! locked is a constant step like any other, and its body joins the link before it.

use alloc::vec::Vec;

use super::pose::sense;
use super::regressor::{Column, Probe, probes};
use super::{ChainLink, MomentBody, Rotation, apply, product, turn};
use crate::equations::matrix::*;
use crate::equations::{Arm, DhVariables, JointPosition, SinCosPair};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

/// The bodies that move, and what is constant between them.
#[derive(Clone, Debug)]
pub struct Skeleton<S> {
    /// Acceleration of gravity in base axes.
    pub gravity: Vector<S>,
    /// The body of a base that floats.
    pub base: Option<MomentBody<S>>,
    /// The probes that are fixed to it, a column of a regressor each.
    pub base_probes: Vec<Probe<S>>,
    /// The joints that move, each after the one that carries it; none of them are those of a base.
    pub links: Vec<Segment<S>>,
    /// The number of columns of a regressor that the links' probes are.
    pub columns: usize,
}

/// One joint that moves, with everything that is fixed to it.
#[derive(Clone, Debug)]
pub struct Segment<S> {
    /// Its place in the arm, from zero.
    pub joint: usize,
    /// The constant step along the axis of a revolute joint.
    pub d: S,
    /// The axes and the origin of the joint's own DH frame, in the frame.
    pub dh: (Rotation<S>, Vector<S>),
    /// The joint and what moves with it, before anything of it is regrouped.
    pub link: ChainLink<S>,
}

impl<S: Scalar> Skeleton<S> {
    /// Returns the skeleton of an arm; a joint with a lock stays where the lock says.
    pub fn new(arm: &Arm<S>, locks: &[Option<JointPosition<S>>]) -> Skeleton<S> {
        Skeleton::with_columns(arm, locks, &[])
    }

    /// Returns the skeleton of an arm, with the columns of a regressor fixed to its links.
    pub fn with_columns(
        arm: &Arm<S>,
        locks: &[Option<JointPosition<S>>],
        columns: &[Column<S>],
    ) -> Skeleton<S> {
        let mut links: Vec<Segment<S>> = Vec::with_capacity(arm.links.len());
        let base = SegmentFrame {
            carrier: None,
            turned: identity(),
            moved: zero_vector(),
            merged: false,
        };
        let floating = arm.base_joints().checked_sub(1);
        let mut base_body = floating.map(|body| MomentBody::of(&arm.links[body]));
        let mut base_probes = Vec::new();
        if let Some(body) = floating {
            base_probes.extend(probes(columns, body, &identity(), &zero_vector()));
        }
        arm.outward(&base, |joint, before: &SegmentFrame<S>| {
            if Some(joint) <= floating {
                return base.clone();
            }
            let (link, mut frame) = (&arm.links[joint], before.clone());
            let twist = match &link.beta {
                None => turn(&link.alpha, ABOUT_X),
                Some(beta) => product(&turn(&link.alpha, ABOUT_X), &turn(beta, ABOUT_Y)),
            };
            let along = [link.a.clone(), S::zero(), S::zero()];
            if let Some(place) = &link.place {
                frame.moved = sum(&frame.moved, &apply(&frame.turned, &place.origin));
                frame.turned = product(&frame.turned, &transposed(&place.axes));
            } else if arm.convention == Convention::Modified {
                frame.moved = sum(&frame.moved, &apply(&frame.turned, &along));
                frame.turned = product(&frame.turned, &twist);
            }
            let (rest, reach) = match arm.convention {
                Convention::Standard => (twist, along),
                Convention::Modified => (identity(), zero_vector()),
            };
            let body = MomentBody::of(link);
            if let Some(Some(lock)) = locks.get(joint) {
                let DhVariables { theta, d } = link.at(lock);
                let step = apply(&frame.turned, &[S::zero(), S::zero(), d]);
                frame.moved = sum(&frame.moved, &step);
                frame.turned = product(&frame.turned, &turn(&theta, ABOUT_Z));
                frame.moved = sum(&frame.moved, &apply(&frame.turned, &reach));
                frame.turned = product(&frame.turned, &rest);
                let carrying = match frame.carrier {
                    None => base_body.as_mut().map(|body| (body, &mut base_probes)),
                    Some(carrier) => {
                        let ChainLink { body, probes, .. } = &mut links[carrier].link;
                        Some((body, probes))
                    }
                };
                if let Some((carrying, others)) = carrying {
                    *carrying = carrying.with(&body.carried(&frame.turned, &frame.moved));
                    // A drive that is locked feels nothing.
                    let joint_probes = probes(columns, joint, &frame.turned, &frame.moved);
                    others.extend(joint_probes.filter(Probe::is_body));
                }
                frame.merged = true;
                return frame;
            }
            let slide = [S::zero(), S::zero(), link.d.clone()];
            let mut chain_link = ChainLink {
                parent: frame.carrier,
                kind: link.kind,
                rotation: identity(),
                offset: frame.moved.clone(),
                axis: unit_z(),
                theta: link.theta.clone(),
                body: MomentBody::zero(),
                probes: Vec::new(),
                free: zero_vector(),
                armature: link.armature.clone(),
                friction: link.friction.clone(),
                spins_freely: false,
                axes: 0,
            };
            match link.kind {
                JointKind::Revolute => {
                    chain_link.rotation = frame.turned;
                    if frame.merged && frame.carrier.is_some() {
                        chain_link.absorb_turn();
                    }
                    (frame.moved, frame.turned) = (sum(&slide, &reach), rest);
                }
                JointKind::Prismatic => {
                    chain_link.axis = apply(&frame.turned, &unit_z());
                    chain_link.offset = sum(&frame.moved, &apply(&frame.turned, &slide));
                    let turned = product(&frame.turned, &turn(&link.theta, ABOUT_Z));
                    chain_link.theta = SinCosPair::straight();
                    frame.moved = apply(&turned, &reach);
                    frame.turned = product(&turned, &rest);
                }
            }
            chain_link.body = body.carried(&frame.turned, &frame.moved);
            let joint_probes = probes(columns, joint, &frame.turned, &frame.moved);
            chain_link.probes.extend(joint_probes);
            (frame.carrier, frame.merged) = (Some(links.len()), false);
            links.push(Segment {
                joint,
                d: link.d.clone(),
                dh: (frame.turned.clone(), frame.moved.clone()),
                link: chain_link,
            });
            frame
        });
        Skeleton {
            gravity: arm.gravity.clone(),
            base: base_body,
            base_probes,
            links,
            columns: columns.len(),
        }
    }
}

/// The frame of a row in the frame of the segment that carries it, or of the base, and
/// whether rows that are locked lie between.
#[derive(Clone)]
struct SegmentFrame<S> {
    carrier: Option<usize>,
    turned: Rotation<S>,
    moved: Vector<S>,
    merged: bool,
}

impl<S: Scalar> ChainLink<S> {
    /// R = Rz(β) only offsets θ, and R = Rz(β) Rx(π) is Rx(π) Rz(−β); composed once.
    fn absorb_turn(&mut self) {
        let r = &self.rotation;
        let Some(opposite) = sense(r) else { return };
        let (sin, cos) = (r[1][0].clone(), r[0][0].clone());
        let mut angle = SinCosPair { sin, cos };
        let mut straight = identity();
        if opposite {
            straight[1][1] = S::one().neg();
            straight[2][2] = S::one().neg();
            angle = angle.reversed();
        }
        self.theta = angle.compose(&self.theta);
        self.rotation = straight;
    }
}
