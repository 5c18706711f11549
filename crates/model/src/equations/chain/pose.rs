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

/// The displacements of a chain's joints.
pub type Posture<S> = [Displacement<S>];

#[derive(Clone, Copy)]
struct FramePlacement {
    group: usize,
    index: usize,
}

impl<S: Scalar> Chain<S> {
    /// Returns by how many joints the frame of each link may turn less, and more, than its link.
    pub fn freedoms(&self) -> Vec<[i32; 2]> {
        let groups = self.parallel();
        let mut freedoms = vec![[0, 0]; self.links.len()];
        // A link from which another group goes on needs all turns.
        let mut is_followed = vec![false; self.links.len()];
        for first in groups.iter().filter_map(|group| self.turning(group[0].0)) {
            is_followed[first] = true;
        }
        for group in &groups {
            for (index, &(i, _)) in (1..).zip(group) {
                if !is_followed[i] && !self.links[i].spins_freely {
                    freedoms[i] = [-(index as i32), (group.len() - index) as i32];
                }
            }
        }
        freedoms
    }

    /// Returns the links that turn about parallel axes, and whether against the first of a group.
    pub fn parallel(&self) -> Vec<Vec<(usize, bool)>> {
        let mut groups: Vec<Vec<(usize, bool)>> = Vec::new();
        let links = self.links.iter().enumerate();
        for (i, link) in links.filter(|(_, link)| link.kind == JointKind::Revolute) {
            // At a branch the first goes on with the group.
            let before = self.turning(i);
            let group = groups.iter_mut().find(|group| {
                let last = group[group.len() - 1].0;
                before == Some(last)
            });
            match (sense(&link.rotation), group) {
                (Some(opposite), Some(group)) => {
                    let (_, before) = group[group.len() - 1];
                    group.push((i, before != opposite));
                }
                _ => groups.push(vec![(i, false)]),
            }
        }
        groups
    }

    /// Returns the last link that turns before a link.
    fn turning(&self, link: usize) -> Option<usize> {
        let mut way = self.way(link).skip(1);
        way.find(|&i| self.links[i].kind == JointKind::Revolute)
    }

    /// Returns the chain at a position, every constant in the axes in which its link
    /// is seen, and how those turn: θ_i as pairs, and slides in its unit.
    pub fn posed(&self, position: &[JointPosition<S>]) -> (Chain<S>, Vec<Displacement<S>>) {
        let (groups, freedoms) = (self.parallel(), self.freedoms());
        let mut places = vec![None; self.links.len()];
        for (group, links) in groups.iter().enumerate() {
            for (index, &(i, _)) in (1..).zip(links) {
                places[i] = Some(FramePlacement { group, index });
            }
        }
        let links = self.links.iter().zip(position);
        let thetas = links.map(|(link, q)| match q {
            JointPosition::Revolute(_) if link.spins_freely => Some(SinCosPair::straight()),
            JointPosition::Revolute(pair) => Some(pair.compose(&link.theta)),
            JointPosition::Prismatic(_) => None,
        });
        let angles: Vec<Option<SinCosPair<S>>> = thetas.collect();
        let angle = |&(j, opposite): &(usize, bool)| {
            let angle = angles[j].clone()?;
            Some(if opposite { angle.reversed() } else { angle })
        };
        let sum = |links: &[(usize, bool)]| {
            let angles = links.iter().filter_map(angle);
            angles.reduce(|sum, angle| sum.compose(&angle))
        };
        let between = |from: usize, to: usize, place: FramePlacement| {
            let links = &groups[place.group];
            let turn = match from <= to {
                true => sum(&links[from..to]),
                false => sum(&links[to..from]).map(|turn| turn.reversed()),
            };
            let (_, opposite) = links[place.index - 1];
            turn.map(|turn| if opposite { turn.reversed() } else { turn })
        };
        let mut chain = self.clone();
        let mut at = Vec::with_capacity(position.len());
        // For each link that turns: the turn of the group that its frame has made, and its place.
        let mut turns: Vec<Option<(usize, FramePlacement)>> = vec![None; self.links.len()];
        for (i, (q, place)) in position.iter().zip(places).enumerate() {
            let before = self.turning(i).and_then(|link| turns[link]);
            let link = &mut chain.links[i];
            if let Some((carrier_target, carrier_place)) = before
                && let Some(turn) = between(carrier_target, carrier_place.index, carrier_place)
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
            let [less, more] = freedoms[i];
            let target = (place.index as i32 + link.axes.clamp(less, more)) as usize;
            if let Some(turn) = between(target, place.index, place) {
                link.turn_bodies(&turn);
            }
            let in_group = before.filter(|(_, carrier_place)| carrier_place.group == place.group);
            let from = in_group.map_or(0, |(carrier_target, _)| carrier_target);
            let turn = between(from, target, place).unwrap_or_else(SinCosPair::straight);
            at.push(Displacement::Turn(turn));
            turns[i] = Some((target, place));
        }
        (chain, at)
    }
}

impl<S: Scalar> ChainLink<S> {
    fn turn_bodies(&mut self, turn: &SinCosPair<S>) {
        self.body = self.body.turned_z(turn);
        self.probes = Probe::each(&self.probes, |body| body.turned_z(turn));
    }
}

/// R = Rz(β) leaves a turn about z as it is; past R = Rz(β) Rx(π) it turns the other way.
pub(super) fn sense<S: Scalar>(rotation: &Rotation<S>) -> Option<bool> {
    match &rotation[2][2] {
        along if along.is_one() => Some(false),
        along if along.neg().is_one() => Some(true),
        _ => None,
    }
}
