//! Checks of a selection, and notes about it.

use std::collections::BTreeSet;

use dalembert_model::robot::{Position, values};

use super::position::advised;
use super::{OTHERS, Select, Selection, State};
use crate::Options;
use crate::model::{Ends, Joint, Mimic, Model, Tie};
use crate::problems::{Problems, instead};

impl<'m> Select<'m, '_, '_> {
    /// Checks that no joint which `others` holds follows one that moves.
    pub(super) fn check_followers_beside(&mut self, selection: &Selection) {
        for joint in &self.held {
            let follower = &self.model.joints[*joint];
            let mimic = follower.mimic.as_ref().filter(|mimic| {
                let mut moving = selection.moving().into_iter();
                moving.any(|leader| self.model.joints[leader].name == mimic.leader)
            });
            if let Some(Mimic { at, leader, .. }) = mimic {
                let (name, advice) = (&follower.name, advised(follower));
                self.problems
                    .report("follows_beside", at, &[name, leader, &advice]);
            }
        }
    }

    /// Checks that nothing that moves apart is tied together.
    pub(super) fn check_ties(&mut self, selection: &Selection) {
        let joints = &self.model.joints;
        for Tie { at, name, ends } in &self.model.ties {
            match ends {
                Ends::Joints(names) => {
                    let moving = selection.moving().into_iter().map(|joint| &joints[joint]);
                    let tied = moving.into_iter().find(|joint| names.contains(&joint.name));
                    if let Some(joint) = tied {
                        self.problems
                            .report("tied", at, &[&joint.name, name, &advised(joint)]);
                    }
                }
                Ends::Links(names) => {
                    let links: BTreeSet<Option<usize>> =
                        names.iter().map(|name| self.model.link(name)).collect();
                    let mover = |link: &Option<usize>| link.and_then(|link| selection.movers[link]);
                    if links.iter().map(mover).collect::<BTreeSet<_>>().len() > 1 {
                        let over = self.closed_by(&links, selection).join("`, `");
                        let names = names.join("` and `");
                        self.problems.report("loop", at, &[name, &names, &over]);
                    }
                }
            }
        }
    }

    /// Returns the names of the moving joints on the ways from links to where these meet.
    fn closed_by(&self, links: &BTreeSet<Option<usize>>, selection: &Selection) -> Vec<&'m str> {
        let mut counts = vec![0; self.model.joints.len()];
        for link in links.iter().flatten() {
            self.model.way(*link).for_each(|joint| counts[joint] += 1);
        }
        let closes = |joint: &usize| (1..links.len()).contains(&counts[*joint]);
        let moving = selection.moving().into_iter().filter(closes);
        moving
            .map(|joint| self.model.joints[joint].name.as_str())
            .collect()
    }

    pub(super) fn report_base(&mut self, base: usize) {
        let link = &self.model.links[base];
        let how = match self.model.gravity {
            None => "to pull against its z",
            Some(_) => "in its axes as it is in the world's",
        };
        self.problems
            .report("not_the_root", &link.at, &[&link.name, &how]);
    }

    pub(super) fn report_held(&mut self, selection: &Selection) {
        let mut order = selection.order.clone();
        order.sort_unstable();
        let held: Vec<(&Joint, &Position)> = order
            .iter()
            .filter_map(|joint| match &self.states[*joint] {
                State::Stays(Some(at)) => Some((&self.model.joints[*joint], at)),
                _ => None,
            })
            .collect();
        if let Some((first, _)) = held.first() {
            let name = |(joint, at): &(&Joint, &Position)| {
                let at = values::position(at).replace('"', "");
                format!("`{}` at {at}", joint.name)
            };
            let names = Vec::from_iter(held.iter().map(name)).join(", ");
            self.problems.report("held", &first.at, &[&names]);
        }
        if let Some(first) = self.without.first() {
            let links = &self.model.links;
            let name = |link: &usize| format!("`{}`", links[*link].name);
            let names = Vec::from_iter(self.without.iter().map(name)).join(", ");
            self.problems
                .report("left_away", &links[*first].at, &[&names]);
        }
    }
}

/// Checks the names of links and joints in the options.
pub(crate) fn check_names(model: &Model, options: &Options, problems: &mut Problems) {
    let base = options.base.iter().map(|name| ("--base", name));
    let tip = options.tips.iter().map(|name| ("--tip", name));
    let without = options.without.iter().map(|name| ("--without", name));
    let links = base.chain(tip).chain(without);
    for (option, name) in links.filter(|(_, name)| model.link(name).is_none()) {
        let help = match model.joints.iter().find(|joint| joint.name == *name) {
            Some(joint) => format!("`{name}` is a joint; its link is `{}`", joint.child.0),
            None => instead(name, model.links.iter().map(|link| &link.name)),
        };
        problems.report("option_link", &model.at, &[&option, name, &help]);
    }
    let joints = options.lock.iter().filter(|(name, _)| name != OTHERS);
    for (name, _) in joints.filter(|(name, _)| model.joint(name).is_none()) {
        let help = match (name.parse::<usize>(), model.moving().len()) {
            (Ok(_), count @ 1..) => {
                format!("those that move are 1 to {count}, from the root outwards")
            }
            _ => instead(name, model.joints.iter().map(|joint| &joint.name)),
        };
        problems.report("option_joint", &model.at, &[name, &help]);
    }
}
