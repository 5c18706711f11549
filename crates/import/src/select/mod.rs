//! The part of a model that is the robot: what each joint does in it, and which joint moves a link.
//!
//! - `tip`: where limbs end if no tip is given
//! - `position`: positions of joints that are held
//! - `check`: ties, followers, names in options

mod check;
pub(crate) mod position;
mod tip;

use std::collections::BTreeSet;

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Follower, Position};
use num_traits::{Signed, Zero};

use crate::Options;
use crate::model::{Joint, Kind, Mimic, Model};
use crate::problems::{Problems, Words, mass_part};
use crate::text::Span;
pub(crate) use check::check_names;
use position::advised;

/// The name that stands for every joint that hangs on the robot.
pub(crate) const OTHERS: &str = "*";

/// The joints and links of a robot, by their places in the model.
#[derive(Clone, Debug)]
pub(crate) struct Selection {
    pub(crate) base: usize,
    pub(crate) floats: bool,
    pub(crate) tips: Vec<usize>,
    /// The joints of the robot, each after the one that it hangs on.
    pub(crate) order: Vec<usize>,
    pub(crate) states: Vec<State>,
    /// The joint that moves each link: none if it is fixed to the base or not in the robot.
    pub(crate) movers: Vec<Option<usize>>,
    /// The links that move, in the order of the model: with a base that floats those that are fixed to it.
    pub(crate) links: Vec<usize>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum State {
    Moves,
    /// At a position, which a fixed joint does not have.
    Stays(Option<Position>),
}

impl Selection {
    pub(crate) fn moving(&self) -> Vec<usize> {
        let moves = |joint: &usize| self.states[*joint] == State::Moves;
        self.order.iter().copied().filter(moves).collect()
    }

    /// Returns the parts of the model that the robot has, as problems name them: a link that stands
    /// still has no mass for the robot.
    pub(crate) fn parts(&self, model: &Model) -> BTreeSet<usize> {
        let joints = self.order.iter().map(|joint| &model.joints[*joint].at);
        let links = self.links.iter().map(|link| &model.links[*link].at);
        let masses = links.clone().map(|at| mass_part(at).start);
        let parts = joints.chain(links).map(|at| at.start);
        parts.chain(masses).collect()
    }
}

pub(crate) struct Select<'m, 'p, 't> {
    pub(crate) model: &'m Model,
    pub(crate) problems: &'p mut Problems<'t>,
    /// The joints that hang on each link.
    pub(crate) below: Vec<Vec<usize>>,
    pub(crate) states: Vec<State>,
    pub(crate) others: Option<String>,
    pub(crate) without: BTreeSet<usize>,
    /// The joints that stand where `others` says.
    held: BTreeSet<usize>,
}

/// Selects the robot from its base to the tips that are given, to the one that is found, or with all
/// that moves.
pub(crate) fn select(
    model: &Model,
    options: &Options,
    problems: &mut Problems,
) -> Option<Selection> {
    let mut select = Select::new(model, options, problems)?;
    let base = select.base(options)?;
    let floats = select.floats(base, options);
    let tips = match (options.tree, options.tips.as_slice()) {
        (_, []) if options.tree || floats => select.ends(base)?,
        (true, _) => return select.refuse("tree_and_tips", &model.at, &[]),
        (false, []) => vec![select.tip(base)?],
        (false, names) => {
            let links = names.iter().map(|name| model.link(name));
            links.collect::<Option<Vec<_>>>()?
        }
    };
    let mut wanted = BTreeSet::new();
    for tip in &tips {
        wanted.extend(select.path(base, *tip)?);
    }
    if wanted.iter().all(|joint| select.stays(*joint)) {
        let [from, to] = [base, tips[0]].map(|link| &model.links[link]);
        return select.refuse("no_mover", &to.at, &[&from.name, &to.name]);
    }
    let (order, movers) = select.settle(base, floats, &wanted);
    let ends = |link: usize| order.iter().any(|joint| model.ends[*joint][1] == link);
    let is_fixed = |link: usize| floats && (link == base || ends(link));
    let links = (0..movers.len()).filter(|link| movers[*link].is_some() || is_fixed(*link));
    let selection = Selection {
        base,
        floats,
        links: links.collect(),
        tips,
        order,
        movers,
        states: select.states.clone(),
    };
    select.check_ties(&selection);
    select.check_followers_beside(&selection);
    if !floats && model.above[base].is_some() {
        select.report_base(base);
    }
    select.report_held(&selection);
    (!select.problems.has_errors()).then_some(selection)
}

impl<'m, 'p, 't> Select<'m, 'p, 't> {
    pub(crate) fn new(
        model: &'m Model,
        options: &Options,
        problems: &'p mut Problems<'t>,
    ) -> Option<Self> {
        let kinds = model.joints.iter().map(|joint| match joint.kind {
            Kind::Fixed => State::Stays(None),
            _ => State::Moves,
        });
        let without = options.without.iter().filter_map(|name| model.link(name));
        let mut select = Select {
            model,
            problems,
            below: vec![Vec::new(); model.links.len()],
            states: kinds.collect(),
            others: None,
            without: without.collect(),
            held: BTreeSet::new(),
        };
        for (joint, [parent, _]) in model.ends.iter().enumerate() {
            select.below[*parent].push(joint);
        }
        for (name, text) in &options.lock {
            if name == OTHERS {
                select.others = Some(text.clone());
            } else if let Some(joint) = model.joint(name) {
                let at = position::within(&model.joints[joint], text, select.problems);
                select.states[joint] = State::Stays(at);
            }
        }
        select.hold_followers();
        (!select.problems.has_errors()).then_some(select)
    }

    pub(crate) fn stays(&self, joint: usize) -> bool {
        self.states[joint] != State::Moves
    }

    pub(crate) fn base(&mut self, options: &Options) -> Option<usize> {
        let base = match &options.base {
            Some(name) => self.model.link(name)?,
            None => self.root().map(|root| self.standing(root, options))?,
        };
        // Behind a link that is in no circle, there is none.
        let mut way = self.model.way(base);
        match way.any(|joint| self.model.ends[joint][0] == base) {
            true => self.refuse("circle", &self.model.links[base].at, &[]),
            false => Some(base),
        }
    }

    fn refuse<T>(&mut self, id: &str, at: &Span, words: &Words) -> Option<T> {
        self.problems.refuse(id, at, words)
    }

    fn root(&mut self) -> Option<usize> {
        let is_root = |link: &usize| self.model.above[*link].is_none();
        let roots: Vec<usize> = (0..self.model.links.len()).filter(is_root).collect();
        let name = |root: &usize| self.model.links[*root].name.as_str();
        let names = Vec::from_iter(roots.iter().map(name)).join(", ");
        match roots[..] {
            [root] => Some(root),
            [] => self.refuse("no_root", &self.model.at, &[]),
            _ => self.refuse("roots", &self.model.at, &[&roots.len(), &names]),
        }
    }

    /// Returns the link behind the joints that let the whole robot float or drive.
    fn standing(&mut self, root: usize, options: &Options) -> usize {
        let (mut base, mut link) = (root, root);
        while let [joint] = self.arms_on(link)[..] {
            let Joint { name, kind, at, .. } = &self.model.joints[joint];
            link = self.model.ends[joint][1];
            if *kind != Kind::Fixed && kind.has_one_axis() {
                break;
            }
            if *kind != Kind::Fixed {
                let is_free = *kind == Kind::Floating;
                if !(is_free && self.floats(link, options)) {
                    self.problems
                        .report("begins_behind", at, &[name, &kind.word()]);
                }
                base = link;
            }
        }
        base
    }

    /// Returns true if a base floats: it was asked for, or a free joint of the model carries it and it
    /// has more than one limb, none of which was asked for by itself.
    fn floats(&mut self, base: usize, options: &Options) -> bool {
        if options.floating || !self.is_carried_freely(base) {
            return options.floating;
        }
        let is_chosen = options.base.is_some() || !options.tips.is_empty() || self.others.is_some();
        // `ends` refuses a link on which nothing moves.
        if is_chosen || self.arms_on(base).is_empty() {
            return options.tree;
        }
        options.tree || self.ends(base).is_some_and(|ends| ends.len() > 1)
    }

    fn is_carried_freely(&self, link: usize) -> bool {
        let above = self.model.above[link];
        above.is_some_and(|joint| self.model.joints[joint].kind == Kind::Floating)
    }

    /// Returns the joints on a link behind which something moves: a table is not a robot.
    fn arms_on(&self, link: usize) -> Vec<usize> {
        let moves = |joint: &&usize| self.moves_from(**joint);
        self.below[link].iter().filter(moves).copied().collect()
    }

    fn moves_from(&self, joint: usize) -> bool {
        let mut open = vec![joint];
        // Behind a root there is no circle.
        while let Some(joint) = open.pop() {
            let kind = self.model.joints[joint].kind;
            if kind.has_one_axis() && kind != Kind::Fixed {
                return true;
            }
            open.extend(&self.below[self.model.ends[joint][1]]);
        }
        false
    }

    /// Returns the joints from the tip back to the base.
    fn path(&mut self, base: usize, tip: usize) -> Option<Vec<usize>> {
        let mut path = Vec::new();
        let mut link = tip;
        while link != base {
            let above = self.model.above[link];
            // In a circle there is no end.
            let Some(joint) = above.filter(|_| path.len() <= self.model.ends.len()) else {
                let [base, tip] = [base, tip].map(|link| &self.model.links[link]);
                return self.refuse("not_on", &tip.at, &[&tip.name, &base.name]);
            };
            path.push(joint);
            if self.without.contains(&link) {
                let link = &self.model.links[link];
                return self.refuse("passes_through", &link.at, &[&link.name]);
            }
            link = self.model.ends[joint][0];
        }
        Some(path)
    }

    /// Decides what each joint behind the base does. Returns the joints of the robot and the joint
    /// that moves each link; what moves by itself and leads to no tip is held or an error.
    fn settle(
        &mut self,
        base: usize,
        floats: bool,
        wanted: &BTreeSet<usize>,
    ) -> (Vec<usize>, Vec<Option<usize>>) {
        let mut movers = vec![None; self.model.links.len()];
        let (mut order, mut left) = (Vec::new(), Vec::new());
        let mut open: Vec<usize> = self.below[base].iter().rev().copied().collect();
        while let Some(joint) = open.pop() {
            let [parent, child] = self.model.ends[joint];
            let is_wanted = wanted.contains(&joint);
            if self.without.contains(&child) {
                continue;
            }
            if is_wanted {
                self.check_axis(joint, wanted);
            } else if !self.stays(joint) {
                if movers[parent].is_none() && !floats {
                    // The base feels nothing of what hangs on it.
                    left.push(joint);
                    continue;
                }
                match self.hold(joint) {
                    Some(state) => self.states[joint] = state,
                    None => continue,
                }
            }
            movers[child] = match self.stays(joint) {
                true => movers[parent],
                false => Some(joint),
            };
            if floats || is_wanted || movers[child].is_some() {
                order.push(joint);
            }
            open.extend(self.below[child].iter().rev());
        }
        left.sort_unstable();
        if let Some(first) = left.first() {
            let name = |joint: &usize| self.model.joints[*joint].name.as_str();
            let names = Vec::from_iter(left.iter().map(name)).join(", ");
            let at = &self.model.joints[*first].at;
            self.problems.report("on_the_base", at, &[&names]);
        }
        (order, movers)
    }

    /// Holds a joint that leads to no tip.
    fn hold(&mut self, joint: usize) -> Option<State> {
        let model_joint = &self.model.joints[joint];
        let Joint { name, kind, at, .. } = model_joint;
        let is_held = kind.has_one_axis() || *kind == Kind::Ball;
        let Some(text) = self.others.clone().filter(|_| is_held) else {
            let follows = match &model_joint.mimic {
                Some(mimic) => format!(", mimics `{}`", mimic.leader),
                None => String::new(),
            };
            let id = match kind.has_one_axis() {
                true => "hangs_beside",
                false => "ball_beside",
            };
            let (advice, link) = (advised(model_joint), &model_joint.child.0);
            return self.refuse(id, at, &[name, &kind.word(), &follows, &advice, link]);
        };
        if *kind == Kind::Ball {
            self.problems.report("ball_held", at, &[name]);
            return Some(State::Stays(None));
        }
        let at = match self.leader(joint) {
            Some((leader, lines)) => {
                let leader = &self.model.joints[leader];
                let at = position::nearest(leader, &text, self.problems)?;
                along(*kind, at, &lines)
            }
            None => position::nearest(model_joint, &text, self.problems)?,
        };
        self.held.insert(joint);
        Some(State::Stays(Some(at)))
    }

    /// Holds the joints that follow one that is locked.
    fn hold_followers(&mut self) {
        let is_locked = |state: &State| matches!(state, State::Stays(Some(_)));
        let locked: Vec<bool> = self.states.iter().map(is_locked).collect();
        let free = (0..locked.len()).filter(|joint| !locked[*joint]);
        let held = free.filter_map(|joint| {
            let (leader, lines) = self.leader(joint)?;
            let State::Stays(Some(at)) = &self.states[leader] else {
                return None;
            };
            let kind = self.model.joints[joint].kind;
            Some((joint, State::Stays(Some(along(kind, at.clone(), &lines)))))
        });
        for (joint, state) in held.collect::<Vec<_>>() {
            if self.model.joints[joint].kind != Kind::Fixed {
                self.states[joint] = state;
            }
        }
    }

    /// Returns the first leader that is locked or follows none, and the lines on the way there.
    fn leader(&self, joint: usize) -> Option<(usize, Vec<[Rational; 2]>)> {
        let mut lines: Vec<[Rational; 2]> = Vec::new();
        let mut leader = joint;
        while let Some(mimic) = &self.model.joints[leader].mimic {
            let is_locked = matches!(self.states[leader], State::Stays(Some(_)));
            if leader != joint && is_locked && !self.held.contains(&leader) {
                break;
            }
            // Longer than all joints is a circle, in which nothing leads.
            if lines.len() > self.model.joints.len() {
                return None;
            }
            lines.push(mimic.line.clone()?);
            let mut joints = self.model.joints.iter();
            leader = joints.position(|other| other.name == mimic.leader)?;
        }
        (leader != joint).then_some((leader, lines))
    }

    /// Checks that a joint of the robot has one axis, and a coordinate if it follows another.
    fn check_axis(&mut self, joint: usize, wanted: &BTreeSet<usize>) {
        let model_joint = &self.model.joints[joint];
        let (name, kind) = (&model_joint.name, model_joint.kind);
        if !kind.has_one_axis() {
            let (at, link) = (&model_joint.at, &model_joint.child.0);
            self.problems
                .report("more_axes", at, &[name, &kind.word(), link]);
        } else if let Some(mimic) = model_joint.mimic.as_ref().filter(|_| !self.stays(joint))
            && let Some(why) = self.cannot_follow(joint, mimic, wanted)
        {
            let (at, leader, advice) = (&mimic.at, &mimic.leader, advised(model_joint));
            self.problems
                .report("mimics", at, &[name, leader, &why, &advice]);
        }
    }

    fn cannot_follow(
        &self,
        joint: usize,
        mimic: &Mimic,
        wanted: &BTreeSet<usize>,
    ) -> Option<String> {
        let joints = &self.model.joints;
        let is_leader = |other: &&usize| joints[**other].name == mimic.leader;
        let Some(leader) = wanted.iter().find(is_leader) else {
            return Some(", which is not part of the robot".to_owned());
        };
        if self.stays(*leader) {
            return Some(", which does not move".to_owned());
        }
        if mimic.line.is_some() && self.leader(joint).is_none() {
            return Some(", in a circle of joints that follow each other".to_owned());
        }
        let Some([multiplier, _]) = &mimic.line else {
            return Some(", and not along a line".to_owned());
        };
        let [slides, other] = [joint, *leader].map(|joint| joints[joint].kind == Kind::Prismatic);
        if slides != other {
            let [moves, other] =
                [slides, other].map(|slides| if slides { "slides" } else { "turns" });
            return Some(format!(", and {moves} where that {other}"));
        }
        let most = Rational::from_integer(Follower::MAX_TURNS.into());
        let is_whole = multiplier.is_integer() && multiplier.abs() <= most;
        (multiplier.is_zero() || !slides && !is_whole).then(|| {
            format!(
                ", {multiplier} times as far: sines are of whole multiples of an angle, up to {most}"
            )
        })
    }
}

/// Returns the position of a follower whose leader is at one.
fn along(kind: Kind, at: Position, lines: &[[Rational; 2]]) -> Position {
    let along = |at: Rational| {
        let lines = lines.iter().rev();
        lines.fold(at, |at, [multiplier, offset]| multiplier * at + offset)
    };
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
