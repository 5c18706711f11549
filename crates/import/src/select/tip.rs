//! Finds the end of an arm if no tip is given: the palm that holds the fingers, or the end of the
//! longest chain; and the ends of all limbs.

use std::collections::BTreeSet;

use crate::model::{Kind, Role};
use crate::problems::MAX_NAMES;
use crate::select::Select;

/// Arms have more joints that move than this before their hand.
const ARM: usize = 3;
/// The most moving joints of a finger. A hand with three or more fingers may have any number.
const FINGER: usize = 4;
/// Parts of the names of fingers; a link called gripper is the palm.
const FINGERS: [&str; 4] = ["finger", "jaw", "claw", "thumb"];
const HANDS: [&str; 7] = ["hand", "flange", "tool", "palm", "tcp", "grasp", "ee_"];

impl Select<'_, '_, '_> {
    /// Takes the first of several links that one joint moves.
    pub(crate) fn tip(&mut self, base: usize) -> Option<usize> {
        let heights = self.heights(base);
        let (tips, holds) = self.chain_ends(base, &heights, false);
        let most = heights[base];
        let name = |link: &usize| self.model.links[*link].name.as_str();
        let moved: BTreeSet<usize> = tips.iter().map(|tip| self.moved_with(*tip, base)).collect();
        if moved.len() == 1 {
            return self.first(&tips);
        }
        let message = match holds {
            true => format!("{} links could be the end of the arm", moved.len()),
            false => format!("{} chains have {most} joints", moved.len()),
        };
        // One end of each chain: those that one joint moves differ in poses alone.
        let mut chains = BTreeSet::new();
        let is_new = |tip: &&usize| chains.insert(self.moved_with(**tip, base));
        let ends = tips.iter().filter(is_new).take(MAX_NAMES).map(name);
        let mut help = Vec::from_iter(ends).join(", ");
        let stands = self.fixed_to(base);
        let is_loaded = |tip: &usize| self.is_loaded(*tip, &stands, &heights);
        if self.others.is_none() && tips.iter().any(is_loaded) {
            help += match holds {
                true => "; --lock-others 0 holds the fingers",
                false => "; --lock-others 0 holds all else that hangs on the chain",
            };
        }
        self.refuse("ends", &self.model.at, &[&message, &help])
    }

    /// Returns the first of links that one joint moves, and says so.
    fn first(&mut self, tips: &[usize]) -> Option<usize> {
        let (link, rest) = tips.split_first()?;
        let name = |link: &usize| self.model.links[*link].name.as_str();
        let others: Vec<&str> = rest.iter().take(MAX_NAMES).map(name).collect();
        let (at, end) = (&self.model.links[*link].at, name(link));
        let moves = if rest.len() == 1 { "moves" } else { "move" };
        match others.first() {
            None => self.problems.report("ends_at", at, &[&end]),
            Some(first) => {
                let names = others.join("`, `");
                self.problems
                    .report("ends_at_with", at, &[&end, &names, &moves, first]);
            }
        }
        Some(*link)
    }

    /// Returns the link of each joint that is the last to move; if that is one joint, the link at
    /// which a chain of all joints ends.
    pub(crate) fn ends(&mut self, base: usize) -> Option<Vec<usize>> {
        let mut moving = Vec::new();
        let mut open = vec![base];
        while let Some(link) = open.pop() {
            for joint in self.hanging(link) {
                let stays = self.stays(joint);
                // Behind a ball, nothing has one coordinate each.
                if stays || self.model.joints[joint].kind.has_one_axis() {
                    moving.extend((!stays).then_some(joint));
                    open.push(self.model.ends[joint][1]);
                }
            }
        }
        let way = |joint: &usize| self.model.way(self.model.ends[*joint][0]);
        let carriers: BTreeSet<usize> = moving.iter().flat_map(way).collect();
        moving.retain(|joint| !carriers.contains(joint));
        moving.sort_unstable();
        let links = moving.iter().map(|joint| self.model.ends[*joint][1]);
        let ends: Vec<usize> = links.collect();
        let heights = self.heights(base);
        let (tips, _) = self.chain_ends(base, &heights, false);
        match ends[..] {
            [] => self.refuse("no_arm", &self.model.at, &[]),
            [end] => {
                let is_moved = |tip: &usize| self.moved_with(*tip, base) == end;
                let tips: Vec<usize> = tips.into_iter().filter(is_moved).collect();
                Some(vec![self.first(&tips).unwrap_or(end)])
            }
            _ => Some(ends),
        }
    }

    /// Returns one link for each joint that is the last to move.
    pub(crate) fn tips(&mut self, base: usize) -> Option<Vec<usize>> {
        let heights = self.heights(base);
        let (mut tips, _) = self.chain_ends(base, &heights, true);
        let mut end_links = BTreeSet::new();
        tips.retain(|tip| {
            let link = self.moved_with(*tip, base);
            link != base && end_links.insert(link)
        });
        tips.sort_unstable();
        match tips.is_empty() {
            true => self.refuse("no_arm", &self.model.at, &[]),
            false => Some(tips),
        }
    }

    fn moved_with(&self, mut link: usize, base: usize) -> usize {
        while let Some(joint) = self.model.above[link].filter(|_| link != base)
            && self.stays(joint)
        {
            link = self.model.ends[joint][0];
        }
        link
    }

    /// Returns the ends, and whether there are fingers, which hold something, on some of them.
    fn chain_ends(&self, base: usize, heights: &[usize], every_arm: bool) -> (Vec<usize>, bool) {
        let mut tips = Vec::new();
        let mut palms = Vec::new();
        let mut open = vec![(base, 0)];
        while let Some((link, depth)) = open.pop() {
            let fixed = self.fixed_to(link);
            let hanging = fixed.iter().flat_map(|link| self.hanging(*link));
            let joints: Vec<usize> = hanging.filter(|joint| !self.stays(*joint)).collect();
            let left = |joint: usize| 1 + heights[self.model.ends[joint][1]];
            let leaves = fixed.iter().filter(|link| self.hanging(**link).is_empty());
            let Some(longest) = joints.iter().map(|joint| left(*joint)).max() else {
                // Fingers may be fixed, too.
                let is_finger =
                    |link: &&usize| has_one_of(&self.model.links[**link].name, &FINGERS);
                let (fingers, ends): (Vec<usize>, Vec<usize>) = leaves.partition(is_finger);
                match ends.is_empty() {
                    true => palms.extend(fingers.first().and_then(|link| self.on(*link))),
                    false => tips.extend(ends),
                }
                continue;
            };
            let is_longest = |joint: &usize| left(*joint) == longest;
            let main: Vec<usize> = joints.iter().copied().filter(is_longest).collect();
            let are_fingers = main.len() > 1 || self.is_finger(main[0]);
            let is_palm = main.len() > 2 || longest <= FINGER && are_fingers;
            if depth >= ARM && is_palm {
                palms.push(self.model.ends[main[0]][0]);
                let is_hand = |link: &&usize| has_one_of(&self.model.links[**link].name, &HANDS);
                tips.extend(leaves.filter(is_hand));
            } else {
                // A head is no arm; of what is short everywhere, the longest.
                let least = if every_arm { ARM.min(longest) } else { longest };
                let next = joints.into_iter().filter(|joint| left(*joint) >= least);
                open.extend(next.map(|joint| (self.model.ends[joint][1], depth + 1)));
            }
        }
        let holds = !palms.is_empty();
        let name = |link: &usize| self.model.links[*link].name.as_str();
        tips.sort_by_key(|link| (!has_one_of(name(link), &HANDS), *link));
        palms.sort_unstable();
        tips.splice(0..0, palms);
        (tips, holds)
    }

    /// Joints that hang on the links that stand still do not count.
    fn is_loaded(&self, tip: usize, stands: &[usize], heights: &[usize]) -> bool {
        let mut chain = vec![tip];
        let mut next = Some(tip);
        // The first of them is the base.
        while next != stands.first().copied()
            && let Some(link) = next
        {
            next = self.on(link);
            chain.extend(next);
        }
        let moves = |joint: usize| {
            let child = self.model.ends[joint][1];
            !chain.contains(&child) && (!self.stays(joint) || heights[child] > 0)
        };
        let links = chain.iter().filter(|link| !stands.contains(link));
        links.flat_map(|link| self.hanging(*link)).any(moves)
    }

    /// Counts the joints that move one behind the other from each link on.
    fn heights(&self, base: usize) -> Vec<usize> {
        let mut order = vec![base];
        let mut at = 0;
        while let Some(link) = order.get(at).copied() {
            at += 1;
            let hanging = self.hanging(link).into_iter();
            order.extend(hanging.map(|joint| self.model.ends[joint][1]));
        }
        let mut heights = vec![0; self.model.links.len()];
        for link in order.into_iter().rev() {
            let below = self.hanging(link).into_iter().map(|joint| {
                let moves = usize::from(!self.stays(joint));
                moves + heights[self.model.ends[joint][1]]
            });
            heights[link] = below.max().unwrap_or(0);
        }
        heights
    }

    fn fixed_to(&self, link: usize) -> Vec<usize> {
        let mut links = vec![link];
        let mut at = 0;
        while let Some(link) = links.get(at).copied() {
            at += 1;
            let joints = self.hanging(link).into_iter();
            let stay = joints.filter(|joint| self.stays(*joint));
            links.extend(stay.map(|joint| self.model.ends[joint][1]));
        }
        links
    }

    fn hanging(&self, link: usize) -> Vec<usize> {
        let is_part = |joint: &usize| {
            let child = self.model.ends[*joint][1];
            // A link that floats or drives away does not end an arm.
            let kind = self.model.joints[*joint].kind;
            let is_apart = matches!(kind, Kind::Floating | Kind::Planar);
            let is_mark = self.model.links[child].role == Role::Mark;
            !is_apart && !is_mark && !self.without.contains(&child)
        };
        self.below[link].iter().copied().filter(is_part).collect()
    }

    fn on(&self, link: usize) -> Option<usize> {
        self.model.above[link].map(|joint| self.model.ends[joint][0])
    }

    fn follows_beside(&self, joint: usize) -> bool {
        let Some(mimic) = &self.model.joints[joint].mimic else {
            return false;
        };
        let mut ancestors = self.model.way(self.model.ends[joint][0]);
        ancestors.all(|above| self.model.joints[above].name != mimic.leader)
    }

    fn is_finger(&self, joint: usize) -> bool {
        let follows = self.follows_beside(joint);
        let joint = &self.model.joints[joint];
        follows
            || has_one_of(&joint.name, &["grip"])
            || has_one_of(&joint.name, &FINGERS)
            || has_one_of(&joint.child.0, &FINGERS)
    }
}

fn has_one_of(name: &str, words: &[&str]) -> bool {
    let name = name.to_ascii_lowercase();
    words.iter().any(|word| name.contains(word))
}
