//! The parameters and the position of an arm in the scalar of a computation.

use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::iter::successors;

use super::factor::picked;
use super::following::FollowerLine;
use super::frames::{Axes, Frames, Rows, View};
use super::friction::Friction;
use super::matrix::{ABOUT_X, ABOUT_Y, ABOUT_Z, Columns, Vector, from_hand, plus, zero_vector};
use crate::robot::{Convention, HAND, Inertia, JointKind, Parent};
use crate::scalar::{Scalar, SinCosPair};

/// The parameters of an arm in the scalar of a computation.
#[derive(Clone, Debug)]
pub struct Arm<S> {
    /// DH convention of every row.
    pub convention: Convention,
    /// Acceleration of gravity in the axes of frame 0.
    pub gravity: [S; 3],
    /// The pose of frame 0 in base axes; `None` where these are the same.
    pub base: Option<Columns<S>>,
    /// The pose of the hand in frame n; `None` where the hand is that frame.
    pub tool: Option<Columns<S>>,
    /// True if the first six links are a base that floats, in the place of joints at position zero.
    pub floats: bool,
    /// Links from the base to the hand.
    pub links: Vec<Link<S>>,
    /// Those of them whose joints follow others.
    pub following: Vec<FollowerLine<S>>,
    /// Frames that are fixed to them, and the one that is the hand.
    pub frames: Frames<S>,
}

/// One row of the table: see [`crate::robot::Joint`] for shapes and units.
#[derive(Clone, Debug)]
pub struct Link<S> {
    /// The link that carries it, unless that is the link before, or the base's for the first.
    pub parent: Option<Parent>,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// In the place of α_i and a_i of modified DH: the joint's frame at rest, in the carrier's frame.
    pub place: Option<Columns<S>>,
    /// Twist α_i.
    pub alpha: SinCosPair<S>,
    /// The turn β_i about y after it, of standard DH.
    pub beta: Option<SinCosPair<S>>,
    /// Constant part of θ_i.
    pub theta: SinCosPair<S>,
    /// Length a_i.
    pub a: S,
    /// Constant part of d_i.
    pub d: S,
    /// Mass.
    pub mass: S,
    /// Centre of mass, link frame.
    pub com: [S; 3],
    /// About the centre of mass, link axes.
    pub inertia: Inertia<S>,
    /// The friction of the joint.
    pub friction: Friction<S>,
    /// Rotor inertia felt at the joint.
    pub armature: S,
}

/// A joint's position as the equations take it.
#[derive(Clone, Debug)]
pub enum JointPosition<S> {
    /// (sin q_i, cos q_i)
    Revolute(SinCosPair<S>),
    /// q_i
    Prismatic(S),
}

impl<S: Scalar> JointPosition<S> {
    /// Returns where a joint is that follows one here, but for its offset, which is its row's.
    #[must_use]
    pub fn followed_by(&self, follower: &FollowerLine<S>) -> JointPosition<S> {
        match self {
            JointPosition::Prismatic(q) => JointPosition::Prismatic(follower.motion(q)),
            JointPosition::Revolute(pair) => {
                let repeats = 1..follower.turns.unsigned_abs();
                let turned = repeats.fold(pair.clone(), |turned, _| turned.compose(pair));
                let is_backward = follower.turns < 0;
                JointPosition::Revolute(if is_backward {
                    turned.reversed()
                } else {
                    turned
                })
            }
        }
    }
}

/// θ_i as a pair and d_i of one row, offsets applied.
#[derive(Clone, Debug)]
pub struct DhVariables<S> {
    /// θ_i
    pub theta: SinCosPair<S>,
    /// d_i
    pub d: S,
}

/// Those of every row, at a position.
pub type At<S> = [DhVariables<S>];

/// An arm at a position.
pub(super) type Posed<S> = (Arm<S>, Vec<DhVariables<S>>);

impl<S> Arm<S> {
    /// Returns the link that carries a link; `None` where the base does.
    pub fn carrier(&self, link: usize) -> Option<usize> {
        Parent::carrier(self.links.get(link).and_then(|link| link.parent), link)
    }

    /// Lists a link and those that carry it, to the base.
    pub(super) fn way(&self, from: usize) -> impl Iterator<Item = usize> {
        successors(Some(from), |&link| self.carrier(link))
    }

    /// Walks from the base to the tips: returns what follows for each link from what its carrier has.
    pub(super) fn outward<T>(&self, base: &T, mut next: impl FnMut(usize, &T) -> T) -> Vec<T> {
        let mut results: Vec<T> = Vec::with_capacity(self.links.len());
        for link in 0..self.links.len() {
            let before = self.carrier(link).map_or(base, |carrier| &results[carrier]);
            results.push(next(link, before));
        }
        results
    }

    /// Walks from the tips to the base: `whole` takes what the links that a link carries have sent,
    /// with their places, and returns what it sends, and its entry. Returns the entries in order.
    pub(super) fn inward<T, J>(
        &self,
        mut whole: impl FnMut(usize, Vec<(usize, T)>) -> (T, J),
    ) -> Vec<J> {
        let mut arrived: Vec<Vec<(usize, T)>> = self.links.iter().map(|_| Vec::new()).collect();
        from_hand(0..self.links.len(), |link| {
            let (sent, entry) = whole(link, core::mem::take(&mut arrived[link]));
            if let Some(carrier) = self.carrier(link) {
                arrived[carrier].push((link, sent));
            }
            entry
        })
    }
}

impl<S: Scalar> Arm<S> {
    /// Returns θ_i and d_i of every row at a position.
    pub fn at(&self, position: &[JointPosition<S>]) -> Vec<DhVariables<S>> {
        let links = self.links.iter().zip(position);
        links.map(|(link, q)| link.at(q)).collect()
    }

    pub(super) fn steps<'a>(
        &'a self,
        at: &'a At<S>,
    ) -> impl DoubleEndedIterator<Item = Step<'a, S>> + ExactSizeIterator {
        (0..at.len().min(self.links.len())).map(move |link| self.step(link, at))
    }

    pub(super) fn step<'a>(&'a self, link: usize, at: &'a At<S>) -> Step<'a, S> {
        Step {
            convention: self.convention,
            link: &self.links[link],
            at: &at[link],
        }
    }

    /// Returns the pose of frame 0 in base axes.
    pub(super) fn frame_0(&self) -> Columns<S> {
        self.base.clone().unwrap_or_else(Columns::identity)
    }

    /// Returns the pose of the hand in the last frame.
    pub(super) fn in_last_frame(&self) -> Columns<S> {
        self.tool.clone().unwrap_or_else(Columns::identity)
    }

    /// Replaces gravity, in base axes.
    #[must_use]
    pub fn with_gravity(mut self, gravity: &Vector<S>) -> Arm<S> {
        self.gravity = match &self.base {
            None => gravity.clone(),
            Some(base) => base.rotate_back(gravity),
        };
        self
    }

    pub(super) fn weightless(&self) -> Arm<S> {
        let mut arm = self.clone();
        arm.gravity = zero_vector();
        arm
    }

    /// Leaves out the friction of all joints.
    #[must_use]
    pub fn without_friction(mut self) -> Arm<S> {
        for link in &mut self.links {
            link.friction = Friction::none();
        }
        self
    }
}

impl<S: Scalar> Link<S> {
    /// The offset enters as a product of pairs: a sum of angles would lose |q|·u, or |offset|·u.
    pub(super) fn at(&self, position: &JointPosition<S>) -> DhVariables<S> {
        let (theta, d) = match position {
            JointPosition::Revolute(pair) => (pair.compose(&self.theta), self.d.clone()),
            JointPosition::Prismatic(q) => (self.theta.clone(), plus(q, &self.d)),
        };
        DhVariables { theta, d }
    }

    /// Returns a link without mass on a slide whose frame, at position zero, is the one before.
    pub fn still() -> Link<S> {
        Link {
            parent: None,
            kind: JointKind::Prismatic,
            place: None,
            alpha: SinCosPair::straight(),
            beta: None,
            theta: SinCosPair::straight(),
            a: S::zero(),
            d: S::zero(),
            mass: S::zero(),
            com: zero_vector(),
            inertia: Inertia::symmetric(|_, _| S::zero()),
            friction: Friction::none(),
            armature: S::zero(),
        }
    }

    /// Returns Ry(−β) v: from the axes after the twist into those of frame i.
    pub(super) fn tilt_back(&self, v: Vector<S>) -> Vector<S> {
        match &self.beta {
            None => v,
            Some(beta) => beta.turn_back_in(ABOUT_Y, v),
        }
    }
}

impl<S> Arm<S> {
    /// Returns every parameter of the arm through `f`. Pairs are converted entry by entry: a
    /// conversion that rounds leaves them on the circle only to its own accuracy.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Arm<T> {
        // Compiled once for each scalar.
        let mut f: &mut dyn FnMut(&S) -> T = &mut f;
        Arm {
            convention: self.convention,
            gravity: self.gravity.each_ref().map(&mut f),
            base: self.base.as_ref().map(|pose| pose.map(&mut f)),
            tool: self.tool.as_ref().map(|pose| pose.map(&mut f)),
            floats: self.floats,
            links: self.links.iter().map(|link| link.map(&mut f)).collect(),
            following: self.following.iter().map(|line| line.map(&mut f)).collect(),
            frames: self.frames.map(f),
        }
    }
}

impl<S> Link<S> {
    /// Returns every parameter of the link through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Link<T> {
        Link {
            parent: self.parent,
            kind: self.kind,
            place: self.place.as_ref().map(|place| place.map(&mut f)),
            alpha: self.alpha.map(&mut f),
            theta: self.theta.map(&mut f),
            beta: self.beta.as_ref().map(|beta| beta.map(&mut f)),
            a: f(&self.a),
            d: f(&self.d),
            mass: f(&self.mass),
            com: self.com.each_ref().map(&mut f),
            inertia: self.inertia.map(&mut f),
            friction: self.friction.map(&mut f),
            armature: f(&self.armature),
        }
    }
}

/// The step from frame i−1 to frame i, ⁱ⁻¹A_i, factor by factor: plane rotations and shifts.
pub(super) struct Step<'a, S> {
    pub(super) convention: Convention,
    pub(super) link: &'a Link<S>,
    pub(super) at: &'a DhVariables<S>,
}

impl<S: Scalar> Step<'_, S> {
    /// Returns M ⁱ⁻¹A_i (eq. 2.1), with the turn about y where a link has one.
    pub(super) fn append(&self, before: &Columns<S>) -> Columns<S> {
        let (link, at, m) = (self.link, self.at, before.clone());
        match self.convention {
            Convention::Standard => {
                let moved = m.turn_z(&at.theta).shift_z(&at.d);
                let twisted = moved.shift_x(&link.a).turn_x(&link.alpha);
                match &link.beta {
                    None => twisted,
                    Some(beta) => twisted.turn_y(beta),
                }
            }
            Convention::Modified => self.before(m).turn_z(&at.theta).shift_z(&at.d),
        }
    }

    /// Returns M with what comes before the joint moves, of modified DH.
    pub(super) fn before(&self, m: Columns<S>) -> Columns<S> {
        match &self.link.place {
            None => m.turn_x(&self.link.alpha).shift_x(&self.link.a),
            Some(place) => m.then(place),
        }
    }

    /// Returns the origin of frame i in frame i−1.
    pub(super) fn lever(&self) -> Vector<S> {
        self.append(&Columns::identity()).origin
    }

    /// Returns ⁱR_{i−1} v: components from frame i−1 into frame i.
    pub(super) fn to_link(&self, v: &Vector<S>) -> Vector<S> {
        let twist_back = |v| match &self.link.place {
            None => self.link.alpha.turn_back_in(ABOUT_X, v),
            Some(place) => place.rotate_back(&v),
        };
        let turn_back = |v| self.at.theta.turn_back_in(ABOUT_Z, v);
        match self.convention {
            Convention::Standard => self.link.tilt_back(twist_back(turn_back(v.clone()))),
            Convention::Modified => turn_back(twist_back(v.clone())),
        }
    }

    /// Returns ⁱ⁻¹R_i v: components from frame i into frame i−1.
    pub(super) fn to_previous(&self, v: &Vector<S>) -> Vector<S> {
        let twist = |v| match &self.link.place {
            None => self.link.alpha.turn_in(ABOUT_X, v),
            Some(place) => place.rotate(&v),
        };
        let turn = |v| self.at.theta.turn_in(ABOUT_Z, v);
        match (self.convention, &self.link.beta) {
            (Convention::Standard, None) => turn(twist(v.clone())),
            (Convention::Standard, Some(beta)) => turn(twist(beta.turn_in(ABOUT_Y, v.clone()))),
            (Convention::Modified, _) => twist(turn(v.clone())),
        }
    }

    /// Returns which of two is of the joint's frame: i−1 in standard DH, i in modified.
    pub(super) fn at_joint<T>(&self, before: T, after: T) -> T {
        match self.convention {
            Convention::Standard => before,
            Convention::Modified => after,
        }
    }
}

impl<S: Clone> Arm<S> {
    /// Returns the arm at velocities of these r_i, where joints have Coulomb friction.
    #[must_use]
    pub fn at_speeds(mut self, per_speed: &[Option<S>]) -> Arm<S> {
        for (link, per_speed) in self.links.iter_mut().zip(per_speed) {
            link.friction.take_speed(per_speed.as_ref());
        }
        self
    }

    /// Returns the arm with the frame of this name for a hand, seen like this, or with several in
    /// contact; `None` without one.
    pub fn seen(&self, view: &View) -> Option<Arm<S>> {
        let mut arm = self.clone();
        if view.frames().count() > 1 {
            let is_named = |name: &str| self.frames.named.iter().any(|frame| frame.name == name);
            view.frames().all(is_named).then_some(())?;
            arm.frames.contacts = view.frames().collect();
        } else if view.frame != HAND {
            let mut named = self.frames.named.iter();
            let frame = named.find(|frame| frame.name == view.frame)?;
            arm.tool = Some(frame.pose.clone());
            arm.frames.joint = Some(frame.joint);
        }
        (arm.frames.axes, arm.frames.rows) = (view.axes, view.rows);
        Some(arm)
    }

    /// Returns the arm with each frame in contact for a hand, of which linear components are asked for.
    pub fn in_contact(&self) -> Vec<Arm<S>> {
        let (axes, rows) = (Axes::Mixed, Rows::LINEAR);
        let frames: &[&'static str] = match self.frames.contacts.as_slice() {
            [] => &[HAND],
            frames => frames,
        };
        let at_frame = |frame: &&'static str| self.seen(&View { frame, axes, rows });
        frames.iter().filter_map(at_frame).collect()
    }

    /// Returns the links on the way to the hand, with those of a list.
    pub(super) fn to_hand<'a>(&'a self, at: &'a At<S>) -> (Cow<'a, Arm<S>>, Cow<'a, At<S>>) {
        let way = self.way_to_hand();
        if way.len() == self.links.len() {
            return (Cow::Borrowed(self), Cow::Borrowed(at));
        }
        let mut arm = self.clone();
        arm.frames.joint = None;
        arm.links = picked(&self.links, &way);
        for link in &mut arm.links {
            link.parent = None;
        }
        (Cow::Owned(arm), Cow::Owned(picked(at, &way)))
    }

    /// Returns the joints that move the hand, from the base on.
    pub(super) fn way_to_hand(&self) -> Vec<usize> {
        let last = self.frames.joint.or(self.links.len().checked_sub(1));
        let mut way: Vec<usize> = last.into_iter().flat_map(|last| self.way(last)).collect();
        way.reverse();
        way
    }
}
