//! A chain at a position, and the axes in which each link is seen: along parallel axes a frame
//! may stay behind its link or run ahead by whole joints.

use alloc::vec;
use alloc::vec::Vec;

use super::{Chain, ChainLink, Probe, Rotation};
use crate::equations::matrix::{ABOUT_Z, times};
use crate::equations::{JointPosition, SinCosPair};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// A joint's position: the pair of θ_i, or the displacement of a slide.
#[derive(Clone, Debug)]
pub enum Displacement<S> {
    /// (sin θ_i, cos θ_i)
    Turn(SinCosPair<S>),
    /// q_i in the chain's unit of length.
    Slide(S),
}

/// A link's place among links that turn about parallel axes.
#[derive(Clone, Debug, PartialEq, Eq)]
struct FramePlacement {
    /// The first link of the group and the last that turns.
    group: [usize; 2],
    /// True if the axis points against that of the first.
    opposite: bool,
    /// The group's revolute links up to and with this one.
    index: usize,
    /// The number of revolute links of the group.
    count: usize,
}

impl<S: Scalar> Chain<S> {
    /// Returns by how many joints the frame of each link may turn less, and more, than its link.
    pub fn freedoms(&self) -> Vec<[i32; 2]> {
        let bounds = |(i, place): (usize, &Option<FramePlacement>)| match place {
            Some(place) => self.bounds(i, place),
            None => [0, 0],
        };
        self.places().iter().enumerate().map(bounds).collect()
    }

    /// Returns the links that turn about parallel axes, group by group, and whether
    /// each turns against the first of its group.
    pub fn parallel(&self) -> Vec<Vec<(usize, bool)>> {
        let mut groups: Vec<Vec<(usize, bool)>> = Vec::new();
        let links = self.links.iter().enumerate();
        for (i, link) in links.filter(|(_, link)| link.kind == JointKind::Revolute) {
            match (sense(&link.rotation), groups.last_mut()) {
                (Some(opposite), Some(group)) => {
                    let (_, before) = group[group.len() - 1];
                    group.push((i, before != opposite));
                }
                _ => groups.push(vec![(i, false)]),
            }
        }
        groups
    }

    fn bounds(&self, i: usize, place: &FramePlacement) -> [i32; 2] {
        let [_, last] = place.group;
        let followed = self.links[last + 1..]
            .iter()
            .any(|link| link.kind == JointKind::Revolute);
        if self.links[i].spins_freely || (followed && i == last) {
            return [0, 0];
        }
        [-(place.index as i32), (place.count - place.index) as i32]
    }

    fn places(&self) -> Vec<Option<FramePlacement>> {
        let mut places = vec![None; self.links.len()];
        for group in self.parallel() {
            let count = group.len();
            for (before, &(i, opposite)) in group.iter().enumerate() {
                places[i] = Some(FramePlacement {
                    group: [group[0].0, group[count - 1].0],
                    opposite,
                    index: before + 1,
                    count,
                });
            }
        }
        places
    }

    /// Returns the chain at a position, every constant in the axes in which its link
    /// is seen, and how those turn: θ_i as pairs, and slides in its unit.
    pub fn posed(&self, position: &[JointPosition<S>]) -> (Chain<S>, Vec<Displacement<S>>) {
        let places = self.places();
        let angles: Vec<Option<SinCosPair<S>>> = self
            .links
            .iter()
            .zip(position)
            .map(|(link, q)| match q {
                JointPosition::Revolute(_) if link.spins_freely => Some(SinCosPair::straight()),
                JointPosition::Revolute(pair) => Some(pair.compose(&link.theta)),
                JointPosition::Prismatic(_) => None,
            })
            .collect();
        // θ_a + … + θ_b about the axis of link a, of the group's links only.
        let sum = |from: usize, to: usize, place: &FramePlacement| {
            let members = (place.group[0]..=place.group[1]).filter_map(|j| {
                let member = places[j].as_ref()?;
                (member.index > from && member.index <= to).then_some((j, member))
            });
            members.fold(None, |sum: Option<SinCosPair<S>>, (j, member)| {
                let angle = angles[j].clone()?;
                let angle = match member.opposite {
                    true => angle.reversed(),
                    false => angle,
                };
                Some(match sum {
                    Some(sum) => sum.compose(&angle),
                    None => angle,
                })
            })
        };
        // The turn from joint `from` to joint `to` of the group, about the
        // axis of the place.
        let between = |from: usize, to: usize, place: &FramePlacement| {
            let turn = match from <= to {
                true => sum(from, to, place),
                false => sum(to, from, place).map(|turn| turn.reversed()),
            };
            turn.map(|turn| {
                if place.opposite {
                    turn.reversed()
                } else {
                    turn
                }
            })
        };
        let mut chain = self.clone();
        let mut at = Vec::with_capacity(position.len());
        // Which turn of the group the frame before has made; its own.
        let mut before: Option<(usize, FramePlacement)> = None;
        for (i, (q, place)) in position.iter().zip(&places).enumerate() {
            let link = &mut chain.links[i];
            if let Some((seen, own)) = &before
                && let Some(turn) = between(*seen, own.index, own)
            {
                link.offset = turn.turn_in(ABOUT_Z, link.offset.clone());
                if link.kind == JointKind::Prismatic {
                    link.axis = turn.turn_in(ABOUT_Z, link.axis.clone());
                    link.turn_bodies(&turn);
                }
            }
            let place = match (q, place) {
                (JointPosition::Prismatic(q), _) => {
                    at.push(Displacement::Slide(times(q, &self.per_unit)));
                    continue;
                }
                (JointPosition::Revolute(_), Some(place)) => place,
                (JointPosition::Revolute(_), None) => continue,
            };
            let [less, more] = self.bounds(i, place);
            let seen = (place.index as i32 + link.axes.clamp(less, more)) as usize;
            if let Some(turn) = between(seen, place.index, place) {
                link.turn_bodies(&turn);
            }
            let from = match &before {
                Some((seen, own)) if own.group == place.group => *seen,
                _ => 0,
            };
            at.push(Displacement::Turn(
                between(from, seen, place).unwrap_or_else(SinCosPair::straight),
            ));
            before = Some((seen, place.clone()));
        }
        (chain, at)
    }
}

impl<S: Scalar> ChainLink<S> {
    /// Turns all that is fixed to the link about z.
    fn turn_bodies(&mut self, turn: &SinCosPair<S>) {
        self.body = self.body.turned_z(turn);
        self.probes = Probe::each(&self.probes, |body| body.turned_z(turn));
    }
}

/// Returns whether an axis points against the one before; `None` if they are
/// not parallel. R = Rz(β) leaves a turn about z as it is; past R = Rz(β) Rx(π)
/// it turns the other way.
pub(super) fn sense<S: Scalar>(rotation: &Rotation<S>) -> Option<bool> {
    let along = &rotation[2][2];
    if along.is_one() {
        Some(false)
    } else if along.neg().is_one() {
        Some(true)
    } else {
        None
    }
}
