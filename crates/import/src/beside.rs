//! What hangs beside the chain: held, tied to it, or left out.

use std::collections::{BTreeMap, BTreeSet};

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Position;
use dalembert_model::robot::values::position;
use num_traits::Zero;

use crate::lock;
use crate::tree::{Moving, Step, Tree};
use crate::urdf::{Kind, Tied};

impl Tree<'_, '_, '_> {
    pub(crate) fn hold(&mut self, joint: usize) -> Option<Step> {
        let own = &self.urdf.joints[joint];
        let is_held = own.kind.has_one_axis() || own.kind == Kind::Ball;
        let Some(text) = self.others.clone().filter(|_| is_held) else {
            self.moves_beside(joint);
            return None;
        };
        if own.kind == Kind::Ball {
            let message = format!("joint `{}` is held where the model has it", own.name);
            let help = "a ball turns about any axis: --without LINK leaves its link away";
            self.problems.difference(&own.span, message, help);
            return Some(Step { joint, at: None });
        }
        let at = match self.follows(joint) {
            Some(at) => at,
            None => lock::nearest(own, &text, self.problems)?,
        };
        self.held.push((joint, at.clone()));
        let at = Some(at);
        Some(Step { joint, at })
    }

    fn follows(&mut self, joint: usize) -> Option<Position> {
        let (leader, lines) = self.leader(joint)?;
        let text = self.others.clone()?;
        let at = lock::nearest(&self.urdf.joints[leader], &text, self.problems)?;
        Some(self.along(joint, at, &lines))
    }

    pub(crate) fn hold_followers(&mut self) {
        let free = 0..self.urdf.joints.len();
        let follows = |joint: usize| {
            let (leader, lines) = self.leader(joint)?;
            let at = self.locks.get(&leader)?.clone();
            Some((joint, self.along(joint, at, &lines)))
        };
        let free = free.filter(|joint| !self.locks.contains_key(joint));
        let held: Vec<(usize, Position)> = free.filter_map(follows).collect();
        self.locks.extend(held);
    }

    /// The first that is held or follows none, and the lines on the way there.
    fn leader(&self, joint: usize) -> Option<(usize, Vec<[Rational; 2]>)> {
        let mut lines: Vec<[Rational; 2]> = Vec::new();
        let mut leader = joint;
        while let Some(mimic) = &self.urdf.joints[leader].mimic {
            if leader != joint && self.locks.contains_key(&leader) {
                break;
            }
            // Longer than all joints is a circle, in which nothing leads.
            if lines.len() > self.urdf.joints.len() {
                return None;
            }
            let mut joints = self.urdf.joints.iter();
            lines.push(mimic.line.clone()?);
            leader = joints.position(|other| other.name == mimic.joint)?;
        }
        (leader != joint).then_some((leader, lines))
    }

    fn along(&self, joint: usize, at: Position, lines: &[[Rational; 2]]) -> Position {
        let along = |at: Rational| {
            let lines = lines.iter().rev();
            lines.fold(at, |at, [multiplier, offset]| multiplier * at + offset)
        };
        let kind = self.urdf.joints[joint].kind;
        let value = match at {
            // A multiple of a multiple of π, but for an offset, is one.
            Position::Angle(Angle::PiTimes(value)) if kind != Kind::Prismatic => {
                if along(Rational::zero()).is_zero() {
                    return Position::Angle(Angle::PiTimes(along(value)));
                }
                along(Angle::PiTimes(value).radians())
            }
            Position::Angle(angle) => along(angle.radians()),
            Position::Length(length) => along(length),
        };
        kind.position(value)
    }

    pub(crate) fn leads_nothing_beside(&mut self, leader: usize) -> bool {
        let name = &self.urdf.joints[leader].name;
        let follower = self.held.iter().find_map(|(held, _)| {
            let own = &self.urdf.joints[*held];
            let mimic = own.mimic.as_ref()?;
            (mimic.joint == *name).then_some((own, &mimic.span))
        });
        let Some((joint, span)) = follower else {
            return true;
        };
        let (own, at) = (&joint.name, lock::advised(joint));
        let message = format!("joint `{own}` hangs on the chain and follows `{name}`, which moves");
        let help = format!(
            "it cannot be held as the others are: add --lock {own}={at} to have it stand still all the same"
        );
        self.problems.error(span, message, &help);
        false
    }

    pub(crate) fn is_free_of_ties(&mut self, moving: &[Moving]) -> bool {
        let mover = |name: &String| {
            let has_it = |link: usize| self.urdf.links[link].name == *name;
            moving
                .iter()
                .position(|own| own.links.iter().any(|(link, _)| has_it(*link)))
        };
        let mut found = Vec::new();
        for tie in &self.urdf.ties {
            match &tie.ends {
                Tied::Joints(names) => {
                    let own =
                        |moving: &&Moving| names.contains(&self.urdf.joints[moving.joint].name);
                    found.extend(moving.iter().find(own).map(|moving| {
                        let joint = &self.urdf.joints[moving.joint];
                        let (joint, at) = (&joint.name, lock::advised(joint));
                        let message = format!("joint `{joint}` of the chain is tied by {}", tie.name);
                        let help = format!("each joint moves by itself: add --lock {joint}={at}, end before it by --tip, or leave the tie out by --ignore-ties");
                        (&tie.span, message, help)
                    }));
                }
                Tied::Links(names) => {
                    let movers: BTreeSet<Option<usize>> = names.iter().map(mover).collect();
                    if movers.len() > 1 {
                        let (tie_name, names) = (&tie.name, names.join("` and `"));
                        let message = format!("{tie_name} ties `{names}`, which move apart");
                        let help = "closed loops are not read: hold what moves between them by --lock, or leave the tie out by --ignore-ties".to_owned();
                        found.push((&tie.span, message, help));
                    }
                }
            }
        }
        let is_free = found.is_empty();
        for (span, message, help) in found {
            self.problems.error(span, message, &help);
        }
        is_free
    }

    pub(crate) fn say_held(&mut self, joints: &BTreeSet<usize>) {
        let locked = self.locks.iter().map(|(joint, at)| (*joint, at));
        let mut held: BTreeMap<usize, &Position> = locked.collect();
        held.retain(|joint, _| joints.contains(joint));
        held.extend(self.held.iter().map(|(joint, at)| (*joint, at)));
        if let Some(first) = held.keys().next() {
            let name = |(joint, at): (&usize, &&Position)| {
                let name = &self.urdf.joints[*joint].name;
                format!("`{name}` at {}", position(at).replace('"', ""))
            };
            let names: Vec<String> = held.iter().map(name).collect();
            let message = format!("joints are held: {}", names.join(", "));
            let help = "--lock JOINT=VALUE holds one elsewhere, --without LINK leaves it away";
            let span = &self.urdf.joints[*first].span;
            self.problems.difference(span, message, help);
        }
        if let Some(first) = self.without.first() {
            let name = |link: &usize| format!("`{}`", self.urdf.links[*link].name);
            let names: Vec<String> = self.without.iter().map(name).collect();
            let names = names.join(", ");
            let message = format!("links are left away, with all that hangs on them: {names}");
            let span = &self.urdf.links[*first].span;
            self.problems.difference(span, message, "");
        }
    }

    fn moves_beside(&mut self, joint: usize) {
        let own = &self.urdf.joints[joint];
        let (name, kind, child, at) = (&own.name, own.kind, &own.child.0, lock::advised(own));
        let follows = own.mimic.as_ref().map(|mimic| &mimic.joint);
        let follows = follows.map_or_else(String::new, |other| format!(", mimics `{other}`"));
        let message = format!(
            "joint `{name}` is {}{follows} and hangs on the chain without being part of it",
            kind.word()
        );
        let help = match kind.has_one_axis() {
            false => format!("leave its link away: --without {child}"),
            true => format!(
                "add --lock {name}={at}, or leave its link away: --without {child}; \
                 --lock-others 0 holds all that hangs on the chain"
            ),
        };
        self.problems.error(&own.span, message, &help);
    }

    /// Says what hangs on the base: it moves no joint of the chain, and is left out.
    pub(crate) fn beside_the_base(&mut self, base: usize, path: &BTreeSet<usize>) {
        let mut open = vec![base];
        let mut others = Vec::new();
        while let Some(link) = open.pop() {
            for joint in self.below.get(&link).into_iter().flatten() {
                let [_, child] = self.ends[*joint];
                match self.step(*joint) {
                    Some(_) if !self.without.contains(&child) => open.push(child),
                    None if !path.contains(joint) => others.push(*joint),
                    _ => {}
                }
            }
        }
        others.sort_unstable();
        let [first, ..] = others[..] else { return };
        let name = |joint: &usize| self.urdf.joints[*joint].name.as_str();
        let names: Vec<&str> = others.iter().map(name).collect();
        let message = format!("what hangs on the base is left out: {}", names.join(", "));
        let help = "a base that stands still feels nothing of it";
        let span = &self.urdf.joints[first].span;
        self.problems.note(span, message, help);
    }
}
