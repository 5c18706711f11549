//! A robot in its scene: what that fixes, and what it asks for.
//!
//! Every stage works on a [`Setup`]; without a scene it is the whole robot.
//! Four things a scene changes, each in its own place:
//!
//! - payload and gravity are parameters: the scene's [`robot`](Setup::robot)
//!   has them, exactly, before anything is traced;
//! - a base that is locked is a fixed one: the scene's robot has none that floats;
//! - locked joints and zero rates are inputs that are constants:
//!   [`Setup::motion`] puts them in the place of the state's;
//! - joints that nobody asks for are results that are left out
//!   ([`Setup::select`]), and what only they needed is dead.
//!
//! Gravity, a payload, bodies and drives may also be arguments ([`Setup::taking`]): then
//! [`Task::posed`] has the arm with them, and [`load`] the parameters that depend on them.
//!
//! Arguments keep an entry for every joint, so that callers need not repack their state; entries of
//! locked joints are not read. Results are over the [`rows`](Setup::rows), in the order of the
//! scene: τ, h and c have an entry a row, D is rows × rows (symmetric and, unlike rows × n,
//! invertible), h_ikm rows × rows × rows.
//!
//! Takes a `Robot` and a `Scene`; returns a [`Setup`], and a [`Task`] for each function.

pub(crate) mod base;
mod friction;
mod key;
pub(crate) mod load;
mod states;
mod task;

use std::sync::OnceLock;

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::equations::chain::MomentBody;
use dalembert_model::equations::following::FollowerLine;
use dalembert_model::equations::regressor::{Column, of_links};
use dalembert_model::equations::{JointPosition, SinCosPair, base_position};
use dalembert_model::number::Exact;
use dalembert_model::outputs::{Motion, RegressorColumns, RuntimeParameter, Sizes};
use dalembert_model::robot::{JointKind, Position, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scene::Scene;

use base::BaseParameters;
pub(crate) use key::ParametersKey;
pub use key::{SceneKey, input_hash};
use load::LoadParameters;
pub(crate) use task::{Task, TaskArm};

use crate::function::{Argument, Function, Quantity};
use crate::program::Input;

/// A robot, whole or in a scene.
#[derive(Clone, Debug)]
pub struct Setup {
    robot: Robot,
    scene: Option<Scene>,
    rows: Vec<usize>,
    /// The joints that a chain needs: those that move, and locked ones whose torque is asked for
    /// (what their brakes hold).
    chained: Vec<usize>,
    locks: Vec<Option<JointPosition<Exact>>>,
    parameters: Vec<RuntimeParameter>,
    /// The rows of the arm whose bodies are arguments, where bodies are.
    bodies: Vec<usize>,
    /// The numbers of these that stay zero; empty if any may be another.
    zeros: Vec<bool>,
    base: Bases,
    load: Option<LoadParameters>,
    fitted: Option<Vec<FittedLink>>,
}

/// A search chose it, and it need not be physical.
#[derive(Clone, Debug)]
pub(crate) struct FittedLink {
    /// About the origin and in the axes of the joint's segment.
    pub body: MomentBody<Exact>,
    pub armature: Exact,
    pub viscous: Exact,
}

type Bases = [OnceLock<Result<BaseParameters, Diagnostic>>; Quantity::ALL.len()];

impl Setup {
    pub fn whole(robot: &Robot) -> Setup {
        let n = robot.joints.len();
        Setup {
            robot: robot.clone(),
            scene: None,
            rows: (0..robot.coordinates()).collect(),
            chained: (0..n).collect(),
            locks: vec![None; n],
            parameters: always_taken(robot).collect(),
            bodies: Vec::new(),
            zeros: Vec::new(),
            base: no_bases(),
            load: None,
            fitted: None,
        }
    }

    /// Returns a robot in a scene, if there is one. Fails with the errors of [`Scene::validate`].
    pub fn in_scene(robot: &Robot, scene: Option<&Scene>) -> Result<Setup, Diagnostic> {
        let Some(scene) = scene else {
            return Ok(Setup::whole(robot));
        };
        let mut findings = scene.validate(robot);
        findings.retain(Diagnostic::is_error);
        if !findings.is_empty() {
            let findings: Vec<String> = findings.iter().map(Diagnostic::to_string).collect();
            let message = format!("scene `{}`: {}", scene.name, findings.join("; "));
            return Err(Diagnostic::error(message));
        }
        let n = robot.joints.len();
        let locks: Vec<_> = (0..n).map(|i| scene.locked(i).map(position)).collect();
        let joints = scene.rows(n);
        let is_chained = |i: &usize| locks[*i].is_none() || joints.contains(i);
        let base = scene.base_coordinates(robot);
        let rows = (0..base).chain(joints.iter().map(|joint| base + joint));
        Ok(Setup {
            scene: Some(scene.clone()),
            rows: rows.collect(),
            chained: (0..n).filter(is_chained).collect(),
            locks,
            ..Setup::whole(&scene.apply(robot))
        })
    }

    /// Returns the robot with these parameters as arguments of its functions; gravity always is one
    /// where the base floats.
    #[must_use]
    pub fn taking(self, parameters: &[RuntimeParameter]) -> Setup {
        let taken = RuntimeParameter::ALL.into_iter().filter(|parameter| {
            parameters.contains(parameter)
                || always_taken(&self.robot).any(|always| always == *parameter)
        });
        let bodies = match parameters.contains(&RuntimeParameter::Bodies) {
            true if self.bodies.is_empty() => self.rows_with_bodies().collect(),
            true => self.bodies.clone(),
            false => Vec::new(),
        };
        let is_kept = bodies == self.bodies;
        Setup {
            parameters: taken.collect(),
            zeros: if is_kept { self.zeros } else { Vec::new() },
            bodies,
            base: no_bases(),
            load: None,
            ..self
        }
    }

    /// Returns the robot with the bodies of these links alone as arguments, where bodies are: links are
    /// counted from one, a base that floats is zero; all if there are none. Numbers of these that are zero
    /// may stay zero.
    pub fn taking_bodies(self, links: &[usize], keeps_zeros: bool) -> Result<Setup, Diagnostic> {
        if !self.has(RuntimeParameter::Bodies) {
            return Ok(self);
        }
        let mut setup = self.of_links(links)?;
        if keeps_zeros {
            let defaults = setup.exact_defaults(RuntimeParameter::Bodies);
            setup.zeros = defaults.iter().map(task::is_nothing).collect();
        }
        Ok(setup)
    }

    fn of_links(self, links: &[usize]) -> Result<Setup, Diagnostic> {
        if links.is_empty() {
            return Ok(self);
        }
        let known: Vec<usize> = self.rows_with_bodies().collect();
        let mut bodies = Vec::new();
        for &link in links {
            // Links count from one behind the rows of a base that floats, whose last is link 0.
            let row_from_one = link.checked_add(self.robot.base_coordinates());
            let row = row_from_one.and_then(|row| row.checked_sub(1));
            let Some(row) = row.filter(|row| known.contains(row)) else {
                let first = usize::from(self.robot.floating.is_none());
                let help = format!("links are {first} to {}", self.robot.rows().len());
                let message = format!("bodies: there is no link {link}");
                return Err(Diagnostic::error(message).with_help(help));
            };
            bodies.push(row);
        }
        bodies.sort_unstable();
        bodies.dedup();
        Ok(Setup { bodies, ..self })
    }

    /// The rows of the arm that have a body: those of joints, and the last of a base that floats.
    fn rows_with_bodies(&self) -> impl Iterator<Item = usize> {
        let base = self.robot.base_coordinates();
        base.saturating_sub(1)..base + self.robot.rows().len()
    }

    pub fn zeros(&self) -> &[bool] {
        &self.zeros
    }

    /// Returns the links whose bodies are arguments, counted from one; a base that floats is zero.
    pub fn body_links(&self) -> Vec<usize> {
        let base = self.robot.base_coordinates();
        self.bodies.iter().map(|row| row + 1 - base).collect()
    }

    /// The textbook formulations do not know of these links.
    #[must_use]
    pub(crate) fn fitted(&self, links: Vec<FittedLink>, rows: &[usize]) -> Setup {
        Setup {
            fitted: Some(links),
            rows: rows.to_vec(),
            base: no_bases(),
            ..self.clone()
        }
    }

    pub(crate) fn fitted_links(&self) -> Option<&[FittedLink]> {
        self.fitted.as_deref()
    }

    /// Returns the robot with any velocities and accelerations and the torques of all joints
    /// that move, which is all that any function may depend on.
    #[must_use]
    pub fn in_full_motion(&self) -> Setup {
        let mut full = self.clone().taking(&self.parameters);
        let base = full.robot.base_coordinates();
        let joints = full.chained.iter().map(|joint| base + joint);
        full.rows = (0..base).chain(joints).collect();
        if let Some(scene) = &mut full.scene {
            (scene.velocity_zero, scene.acceleration_zero) = (false, false);
        }
        full
    }

    pub fn has(&self, parameter: RuntimeParameter) -> bool {
        self.parameters.contains(&parameter)
    }

    pub fn takes(&self, function: Function, parameter: RuntimeParameter) -> bool {
        self.has(parameter) && function.depends_on(parameter)
    }

    fn taken(&self, function: Function) -> impl Iterator<Item = Argument> {
        let parameters = RuntimeParameter::ALL.into_iter();
        let taken = parameters.filter(move |&parameter| self.takes(function, parameter));
        taken.map(RuntimeParameter::argument)
    }

    /// True if functions take some parameter by their load.
    pub fn has_load(&self) -> bool {
        let mut parameters = RuntimeParameter::LOADING.into_iter();
        parameters.any(|parameter| self.has(parameter))
    }

    pub fn takes_load(&self, function: Function) -> bool {
        let mut parameters = RuntimeParameter::LOADING.into_iter();
        parameters.any(|parameter| self.takes(function, parameter))
    }

    pub fn takes_any(&self, function: Function) -> bool {
        function == Function::Load || self.taken(function).next().is_some()
    }

    /// Returns the robot with the scene's payload and gravity, the box as its limits.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Returns the scene, unless the robot is whole.
    pub fn scene(&self) -> Option<&Scene> {
        self.scene.as_ref()
    }

    /// Returns true without a scene, and with one that gives only a box and a tolerance.
    pub fn has_whole_model(&self) -> bool {
        let changes = |scene: &Scene| {
            let still = scene.velocity_zero || scene.acceleration_zero;
            still || scene.lock_base || scene.gravity.is_some() || scene.payload.is_some()
        };
        let same = !self.scene.as_ref().is_some_and(changes);
        same && self.rows.iter().copied().eq(0..self.coordinates())
            && self.locks.iter().all(Option::is_none)
    }

    pub fn joints(&self) -> usize {
        self.robot.joints.len()
    }

    /// Returns the number of coordinates of a velocity: those of a base that floats, then n.
    pub fn coordinates(&self) -> usize {
        self.robot.coordinates()
    }

    /// Returns the coordinates that results are over, zero-based, in their order.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Returns the joints that follow others, multipliers sent through `scalar`.
    pub fn following<S>(&self, mut scalar: impl FnMut(&Exact) -> S) -> Vec<FollowerLine<S>> {
        FollowerLine::of(&self.robot, &mut scalar)
    }

    /// Returns the rows of the arm that a chain needs: those of a base that floats, of its joints, and
    /// of what follows them.
    pub fn chained_rows(&self) -> Vec<usize> {
        let (base, rows) = (self.robot.base_coordinates(), 0..self.robot.rows().len());
        let rows = rows.filter(|&row| self.chained.contains(&self.robot.mover_of(row)));
        (0..base).chain(rows.map(|row| base + row)).collect()
    }

    /// Returns the locks that merge links, one a row of the arm: of joints without a torque to show.
    pub fn merged(&self) -> Vec<Option<JointPosition<Exact>>> {
        let is_chained = |i: usize| self.chained.contains(&i);
        let merges = |(i, lock): (usize, &Option<_>)| lock.clone().filter(|_| !is_chained(i));
        let base = std::iter::repeat_n(None, self.robot.base_coordinates());
        let locks = self.locks.iter().enumerate().map(merges);
        let mut merged: Vec<_> = base.chain(locks).collect();
        let following = self.following(Exact::clone);
        for follower in &following {
            merged.insert(follower.row, None);
        }
        for follower in &following {
            let leader = merged[follower.leader].as_ref();
            merged[follower.row] = leader.map(|leader| leader.followed_by(follower));
        }
        merged
    }

    pub fn lock(&self, joint: usize) -> Option<&JointPosition<Exact>> {
        self.locks.get(joint).and_then(Option::as_ref)
    }

    /// Returns the arguments that a function keeps: rates that are zero need none.
    pub fn arguments(&self, function: Function) -> Vec<Argument> {
        let candidates = function.arguments().into_iter();
        let is_there = |argument: &Argument| {
            let mut loading = RuntimeParameter::LOADING.into_iter();
            let parameter = loading.find(|parameter| parameter.given() == Some(*argument));
            parameter.is_none_or(|parameter| self.has(parameter)) && !self.has_zero(*argument)
        };
        let mut arguments: Vec<Argument> = candidates.filter(is_there).collect();
        arguments.extend(self.taken(function));
        arguments.sort();
        arguments.dedup();
        arguments
    }

    /// True if the scene holds an argument at zero.
    pub fn has_zero(&self, argument: Argument) -> bool {
        self.scene.as_ref().is_some_and(|scene| match argument {
            Argument::Velocity => scene.velocity_zero,
            Argument::Acceleration => scene.acceleration_zero,
            _ => false,
        })
    }

    /// Returns the motion of all rows from a program's inputs, with the scene's constants.
    pub fn motion<S: Scalar>(
        &self,
        input: impl FnMut(Input) -> S,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> Motion<S> {
        let mut motion = motion(&self.robot, input);
        for coordinate in 0..self.coordinates() {
            let joint = self.robot.joint_of(coordinate);
            let lock = joint.and_then(|joint| self.lock(joint));
            match lock {
                None => {}
                Some(JointPosition::Revolute(pair)) => {
                    motion.q[coordinate] = JointPosition::Revolute(pair.map(&mut constant));
                }
                Some(JointPosition::Prismatic(q)) => {
                    motion.q[coordinate] = JointPosition::Prismatic(constant(q));
                }
            }
            motion.moves[coordinate] = lock.is_none();
            // Zero by structure: what it multiplies is gone.
            let is_zero = |argument| lock.is_some() || self.has_zero(argument);
            if is_zero(Argument::Velocity) {
                let at_rest = joint.and_then(|joint| self.per_speed_at_rest(joint));
                motion.per_speed[coordinate] = at_rest.map(|x| constant(&x));
            }
            for (argument, entries) in motion.vectors_mut() {
                if is_zero(argument) {
                    entries[coordinate] = S::zero();
                }
            }
        }
        motion.of_rows(&self.following(constant))
    }

    /// Returns the base parameters that a quantity is over, which are those of its own
    /// equation: where a scene has rates that are zero, one may feel what another
    /// does not. None of other quantities.
    ///
    /// # Errors
    /// Why there are none that could be written down.
    pub fn base(&self, quantity: Quantity) -> Result<&BaseParameters, &Diagnostic> {
        // Nothing at a frame is over base parameters.
        let place = quantity.index().unwrap_or_default();
        let base = self.base[place].get_or_init(|| BaseParameters::find(self, quantity));
        base.as_ref()
    }

    /// Returns the base parameters that a function is over, if it is over any; fails as [`Setup::base`].
    pub fn base_of(&self, function: Function) -> Result<Option<&BaseParameters>, &Diagnostic> {
        match function.columns() {
            RegressorColumns::Base(quantity) => self.base(quantity).map(Some),
            RegressorColumns::Links | RegressorColumns::None => Ok(None),
        }
    }

    /// Returns the numbers of the regrouped chain that depend on arguments, once they are chosen.
    pub fn load(&self) -> Option<&LoadParameters> {
        self.load.as_ref()
    }

    /// Returns the columns of a function's regressor; none for others, and without base parameters.
    pub fn columns<S: Scalar>(
        &self,
        function: Function,
        mut constant: impl FnMut(&Exact) -> S,
    ) -> Vec<Column<S>> {
        let columns = match function.columns() {
            RegressorColumns::Links => of_links(&self.arm(Exact::clone)),
            _ => match self.base_of(function) {
                Ok(Some(base)) => base.columns.clone(),
                Ok(None) | Err(_) => Vec::new(),
            },
        };
        columns.iter().map(|c| c.map(&mut constant)).collect()
    }

    /// Returns the numbers that the lengths of a function's results follow from.
    pub fn sizes(&self, function: Function) -> Sizes {
        let base = self.base_of(function).ok().flatten();
        let is_loaded = function == Function::Load || self.takes_load(function);
        let load = self.load().filter(|_| is_loaded);
        Sizes {
            base: base.map_or(0, |base| base.columns.len()),
            load: load.map_or(0, |load| load.rows.len()),
            bodies: self.bodies.len(),
            ..Sizes::of(&self.robot).over(&self.rows)
        }
    }

    /// Returns the joints of each limb of a base that floats, of those that results are over.
    pub fn limbs(&self) -> Vec<Vec<usize>> {
        let limbs = Sizes::of(&self.robot).of_limbs(&self.rows).into_iter();
        let joint = |place: usize| self.robot.joint_of(self.rows[place]);
        let joints = |places: Vec<usize>| places.into_iter().filter_map(joint).collect();
        limbs.map(joints).collect()
    }

    fn arm_row(&self, coordinate: usize) -> usize {
        match self.robot.joint_of(coordinate) {
            None => coordinate,
            Some(joint) => self.robot.base_coordinates() + self.robot.row_of(joint),
        }
    }

    /// Returns one quantity's entries over the scene's joints. Loads of joints that follow are
    /// gathered.
    pub fn select<S: Scalar>(
        &self,
        quantity: Quantity,
        sizes: Sizes,
        rows: &[usize],
        following: &[FollowerLine<S>],
        values: Vec<S>,
    ) -> Vec<S> {
        let arm_rows: Vec<usize> = self.rows.iter().map(|&row| self.arm_row(row)).collect();
        quantity.selected(values, [rows, &arm_rows], following, sizes)
    }
}

fn always_taken(robot: &Robot) -> impl Iterator<Item = RuntimeParameter> {
    robot.floating.iter().map(|_| RuntimeParameter::Gravity)
}

fn no_bases() -> Bases {
    [const { OnceLock::new() }; Quantity::ALL.len()]
}

fn motion<S: Scalar>(robot: &Robot, mut input: impl FnMut(Input) -> S) -> Motion<S> {
    let joints = || robot.joints.iter().enumerate();
    let base = robot.base_coordinates();
    let positions = joints().map(|(i, joint)| match joint.kind {
        JointKind::Revolute => JointPosition::Revolute(SinCosPair {
            sin: input(Input::Sin(i)),
            cos: input(Input::Cos(i)),
        }),
        JointKind::Prismatic => {
            JointPosition::Prismatic(input(Input::Entry(Argument::Position, i)))
        }
    });
    let of_base = base_position().into_iter().take(base);
    let q = of_base.chain(positions).collect();
    let speeds = joints().map(|(i, joint)| {
        let speed = Input::PerSpeed(base + i);
        joint.has_coulomb().then(|| input(speed))
    });
    let none = std::iter::repeat_with(|| None).take(base);
    let per_speed = none.chain(speeds).collect();
    let sizes = Sizes::of(robot);
    let entries = |argument: Argument| {
        let entries = 0..argument.length(sizes);
        entries.map(|i| input(Input::Entry(argument, i))).collect()
    };
    Motion {
        per_speed,
        ..Motion::new(q, entries)
    }
}

fn position(at: &Position) -> JointPosition<Exact> {
    match at {
        Position::Angle(angle) => JointPosition::Revolute(Exact::sincos(angle)),
        Position::Length(length) => JointPosition::Prismatic(Exact::from(length.clone())),
    }
}
