//! The chain from the base to the tip, and what moves with its links.

use std::collections::{BTreeMap, BTreeSet};

use dalembert_model::number::Rational;
use dalembert_model::robot::{Follower, Position};
use num_traits::{Signed, Zero};

use crate::Options;
use crate::lock::{self, OTHERS};
use crate::problems::Problems;
use crate::urdf::{Joint, Kind, Mimic, Urdf};

/// A chain of joints that move. Links and joints are by their place in the URDF.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    pub(crate) base: usize,
    pub(crate) tip: usize,
    pub(crate) moving: Vec<Moving>,
    /// From the last link that moves to the tip.
    pub(crate) tool: Vec<Step>,
}

#[derive(Clone, Debug)]
pub(crate) struct Moving {
    pub(crate) joint: usize,
    /// From the link that moved before, or the base, to the joint's parent.
    pub(crate) before: Vec<Step>,
    /// Every link that is fixed to the joint's child, itself included, and the way there.
    pub(crate) links: Vec<(usize, Vec<Step>)>,
}

/// A joint that stays where it is.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub(crate) joint: usize,
    pub(crate) at: Option<Position>,
}

impl Chain {
    pub(crate) fn joints(&self) -> BTreeSet<usize> {
        let moving = self.moving.iter().flat_map(|moving| {
            let ways = moving.links.iter().flat_map(|(_, way)| way);
            let steps = moving.before.iter().chain(ways).map(|step| step.joint);
            steps.chain([moving.joint])
        });
        let tool = self.tool.iter().map(|step| step.joint);
        moving.chain(tool).collect()
    }

    pub(crate) fn links(&self) -> BTreeSet<usize> {
        let all = self.moving.iter().flat_map(|moving| &moving.links);
        all.map(|(link, _)| *link).collect()
    }
}

const MAX_STEPS: usize = 100;
const OTHER_ENDS: &str = "take another --base or --tip";

pub(crate) struct Tree<'u, 'p, 's> {
    pub(crate) urdf: &'u Urdf,
    pub(crate) problems: &'p mut Problems<'s>,
    /// The joint that a link hangs on.
    pub(crate) above: BTreeMap<usize, usize>,
    /// The joints that hang on a link.
    pub(crate) below: BTreeMap<usize, Vec<usize>>,
    pub(crate) ends: Vec<[usize; 2]>,
    pub(crate) locks: BTreeMap<usize, Position>,
    pub(crate) others: Option<String>,
    pub(crate) held: Vec<(usize, Position)>,
    pub(crate) without: BTreeSet<usize>,
}

pub(crate) fn tips(urdf: &Urdf, options: &Options, problems: &mut Problems) -> Option<Vec<String>> {
    let mut tree = Tree::new(urdf, problems)?;
    tree.options(options)?;
    let base = tree.base(options)?;
    let tips = tree.tips(base)?.into_iter();
    Some(tips.map(|tip| urdf.links[tip].name.clone()).collect())
}

pub(crate) fn chain(urdf: &Urdf, options: &Options, problems: &mut Problems) -> Option<Chain> {
    let mut tree = Tree::new(urdf, problems)?;
    let read = tree.options(options);
    let (base, ()) = tree.base(options).zip(read)?;
    let tip = match &options.tip {
        Some(name) => tree.link(name)?,
        None => tree.tip(base)?,
    };
    let path = tree.path(base, tip)?;
    let mut moving: Vec<Moving> = Vec::new();
    let mut before = Vec::new();
    let mut good = true;
    for joint in &path {
        good &= tree.can_move(*joint, &path);
        match tree.step(*joint) {
            Some(step) => before.push(step),
            None => moving.push(Moving {
                joint: *joint,
                before: std::mem::take(&mut before),
                links: Vec::new(),
            }),
        }
    }
    if moving.is_empty() {
        let [from, to] = [base, tip].map(|link| &urdf.links[link].name);
        let message = format!("no joint moves between link `{from}` and link `{to}`");
        let span = &urdf.links[tip].span;
        return tree.problems.refuse(span, message, OTHER_ENDS);
    }
    let on_path: BTreeSet<usize> = path.iter().copied().collect();
    for moving in &mut moving {
        let [_, child] = tree.ends[moving.joint];
        good &= tree.gather(child, &on_path, &mut moving.links);
    }
    good &= tree.is_free_of_ties(&moving);
    let mut all = moving.iter();
    good &= all.all(|moving| tree.leads_nothing_beside(moving.joint));
    tree.beside_the_base(base, &on_path);
    if tree.above.contains_key(&base) {
        let link = &urdf.links[base];
        let message = format!("link `{}` is the base, and not the root", link.name);
        let how = match urdf.gravity {
            None => "to pull against its z",
            Some(_) => "in its axes as it is in the world's",
        };
        let help =
            format!("gravity is taken {how}: change `gravity` in the robot file if it is tilted");
        tree.problems.difference(&link.span, message, &help);
    }
    let chain = Chain {
        base,
        tip,
        moving,
        tool: before,
    };
    tree.say_held(&chain.joints());
    good.then_some(chain)
}

impl<'u, 'p, 's> Tree<'u, 'p, 's> {
    fn new(urdf: &'u Urdf, problems: &'p mut Problems<'s>) -> Option<Self> {
        let links = urdf.links.iter().enumerate();
        let links = links.map(|(index, link)| (link.name.as_str(), index));
        let links: BTreeMap<&str, usize> = links.collect();
        let mut tree = Tree {
            urdf,
            problems,
            above: BTreeMap::new(),
            below: BTreeMap::new(),
            ends: Vec::new(),
            locks: BTreeMap::new(),
            others: None,
            held: Vec::new(),
            without: BTreeSet::new(),
        };
        let mut good = true;
        for (index, joint) in urdf.joints.iter().enumerate() {
            let [parent, child] =
                [&joint.parent, &joint.child].map(|(name, _)| links.get(name.as_str()).copied());
            let (parent, child) = parent.zip(child)?;
            tree.ends.push([parent, child]);
            tree.below.entry(parent).or_default().push(index);
            if let Some(other) = tree.above.insert(child, index) {
                let (link, other) = (&joint.child.0, &urdf.joints[other].name);
                let message = format!("link `{link}` hangs on joint `{other}` already");
                let help = "a link hangs on one joint: closed loops are not read";
                tree.problems.error(&joint.child.1, message, help);
                good = false;
            }
        }
        good.then_some(tree)
    }

    fn options(&mut self, options: &Options) -> Option<()> {
        let mut good = true;
        for (name, text) in &options.lock {
            if name == OTHERS {
                self.others = Some(text.clone());
                continue;
            }
            let joint = self.urdf.joint(name)?;
            let at = lock::position(&self.urdf.joints[joint], text, self.problems);
            good &= at.is_some();
            self.locks.extend(at.map(|at| (joint, at)));
        }
        self.hold_followers();
        let without = options.without.iter().filter_map(|name| self.link(name));
        self.without = without.collect();
        good.then_some(())
    }

    fn link(&self, name: &str) -> Option<usize> {
        self.urdf.links.iter().position(|link| link.name == name)
    }

    fn base(&mut self, options: &Options) -> Option<usize> {
        match &options.base {
            Some(name) => self.link(name),
            None => self.root().map(|root| self.standing(root)),
        }
    }

    fn root(&mut self) -> Option<usize> {
        let all = 0..self.urdf.links.len();
        let roots: Vec<usize> = all.filter(|link| !self.above.contains_key(link)).collect();
        if let [root] = roots[..] {
            return Some(root);
        }
        let names = roots.iter();
        let names: Vec<&str> = names.map(|root| &*self.urdf.links[*root].name).collect();
        let (message, help) = match roots.len() {
            0 => (
                "every link hangs on another: this is no tree".to_owned(),
                "the base hangs on nothing".to_owned(),
            ),
            count => (
                format!("{count} links hang on nothing"),
                format!("choose one by --base: {}", names.join(", ")),
            ),
        };
        self.problems.refuse(&self.urdf.span, message, &help)
    }

    /// Returns the link behind the joints that let the whole robot float or drive.
    fn standing(&mut self, root: usize) -> usize {
        let (mut base, mut link) = (root, root);
        while let [joint] = self.arms_on(link)[..] {
            let Joint { name, kind, .. } = &self.urdf.joints[joint];
            link = self.ends[joint][1];
            if link == root || *kind != Kind::Fixed && kind.has_one_axis() {
                break;
            }
            if *kind != Kind::Fixed {
                let word = kind.word();
                let message = format!("the chain begins behind joint `{name}`, which is {word}");
                let help = "--base LINK chooses another beginning";
                let span = &self.urdf.joints[joint].span;
                self.problems.note(span, message, help);
                base = link;
            }
        }
        base
    }

    /// Returns the joints on a link behind which something moves: a table is no robot.
    fn arms_on(&self, link: usize) -> Vec<usize> {
        let joints = self.below.get(&link).into_iter().flatten().copied();
        joints.filter(|joint| self.moves_below(*joint)).collect()
    }

    fn moves_below(&self, joint: usize) -> bool {
        let mut open = vec![joint];
        // In a circle there is no end.
        for _ in 0..self.ends.len() {
            let Some(joint) = open.pop() else {
                return false;
            };
            let kind = self.urdf.joints[joint].kind;
            if kind.has_one_axis() && kind != Kind::Fixed {
                return true;
            }
            let below = self.below.get(&self.ends[joint][1]);
            open.extend(below.into_iter().flatten());
        }
        false
    }

    pub(crate) fn step(&self, joint: usize) -> Option<Step> {
        let at = self.locks.get(&joint).cloned();
        let stays = at.is_some() || self.urdf.joints[joint].kind == Kind::Fixed;
        stays.then_some(Step { joint, at })
    }

    fn can_move(&mut self, joint: usize, path: &[usize]) -> bool {
        let own = &self.urdf.joints[joint];
        let (name, kind, child) = (&own.name, own.kind, &own.child.0);
        if !kind.has_one_axis() {
            let message = format!("joint `{name}` of the chain is {}", kind.word());
            let help = format!(
                "joints turn about or slide along one axis: begin behind it, --base {child}"
            );
            self.problems.error(&own.span, message, &help);
            return false;
        }
        let mimic = own.mimic.as_ref().filter(|_| self.step(joint).is_none());
        let why = mimic.and_then(|mimic| self.cannot_follow(joint, mimic, path));
        let Some((mimic, why)) = mimic.zip(why) else {
            return true;
        };
        let message = format!("joint `{name}` of the chain mimics `{}`{why}", mimic.joint);
        let at = lock::advised(own);
        let help = format!("hold it, --lock {name}={at}, or end before it");
        self.problems.error(&mimic.span, message, &help);
        false
    }

    fn cannot_follow(&self, joint: usize, mimic: &Mimic, path: &[usize]) -> Option<String> {
        let on_path = |other: &&usize| self.urdf.joints[**other].name == mimic.joint;
        let Some(leader) = path.iter().find(on_path) else {
            return Some(", which is not in the chain".to_owned());
        };
        let [own, other] = [joint, *leader].map(|joint| self.urdf.joints[joint].kind);
        let Some([multiplier, _]) = &mimic.line else {
            return Some(", and not along a line".to_owned());
        };
        let slides = own == Kind::Prismatic;
        if slides != (other == Kind::Prismatic) {
            let [own, other] =
                [slides, !slides].map(|slides| if slides { "slides" } else { "turns" });
            return Some(format!(", and {own} where that {other}"));
        }
        let most = Rational::from_integer(Follower::MAX_TURNS.into());
        let is_whole = multiplier.is_integer() && multiplier.abs() <= most;
        if multiplier.is_zero() || !slides && !is_whole {
            return Some(format!(
                ", {multiplier} times as far: sines are of whole multiples of an angle, up to {most}"
            ));
        }
        None
    }

    fn path(&mut self, base: usize, tip: usize) -> Option<Vec<usize>> {
        let mut path = Vec::new();
        let mut at = tip;
        while at != base {
            let above = self.above.get(&at).copied();
            // In a circle there is no end.
            let Some(joint) = above.filter(|_| path.len() <= self.ends.len()) else {
                let [base, tip] = [base, tip].map(|link| &self.urdf.links[link]);
                let message = format!("link `{}` does not hang on link `{}`", tip.name, base.name);
                return self.problems.refuse(&tip.span, message, OTHER_ENDS);
            };
            path.push(joint);
            if self.without.contains(&at) {
                let link = &self.urdf.links[at];
                let message = format!("--without {}: the chain passes through it", link.name);
                let help = "take another --tip, or leave it in";
                return self.problems.refuse(&link.span, message, help);
            }
            at = self.ends[joint][0];
        }
        path.reverse();
        Some(path)
    }

    /// Anything that moves by itself and is not part of the chain is an error.
    fn gather(
        &mut self,
        link: usize,
        path: &BTreeSet<usize>,
        links: &mut Vec<(usize, Vec<Step>)>,
    ) -> bool {
        let mut good = true;
        let mut open = vec![(link, Vec::new())];
        while let Some((link, way)) = open.pop() {
            if way.len() > MAX_STEPS {
                let message = format!("more than {MAX_STEPS} joints in a row do not move");
                let help = "is this a robot? cut out the arm";
                self.problems
                    .error(&self.urdf.links[link].span, message, help);
                return false;
            }
            for joint in self.below.get(&link).cloned().unwrap_or_default() {
                let [_, child] = self.ends[joint];
                if self.without.contains(&child) {
                    continue;
                }
                let stays = self.step(joint);
                if stays.is_none() && path.contains(&joint) {
                    continue;
                }
                match stays.or_else(|| self.hold(joint)) {
                    Some(step) => open.push((child, [&way[..], &[step]].concat())),
                    None => good = false,
                }
            }
            links.push((link, way));
        }
        links.sort_by_key(|(link, _)| *link);
        good
    }
}
