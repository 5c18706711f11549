//! Arms that share chosen facts with a robot and have random numbers otherwise, in a prime field.
//!
//! A coefficient that is zero there is zero for every arm with these facts, but for a chance below
//! 1e-15 (Schwartz and Zippel): it is a polynomial of low degree in the numbers that were drawn.

use dalembert_codegen::workspace::Setup;
use dalembert_model::equations::chain::MomentBody;
use dalembert_model::equations::following::FollowerLine;
use dalembert_model::equations::matrix::Columns;
use dalembert_model::equations::{Arm, JointPosition, SinCosPair};
use dalembert_model::robot::{Inertia, JointKind};
use dalembert_model::scalar::field::{Field, Points};

use super::facts::{Fact, is_right, is_zero};
use crate::arm::{SymbolicArm, mapped, posed};
use crate::entries::Coefficients;
use crate::ring::Polynomial;

/// A robot's geometry in the field.
pub(crate) struct Geometry<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) arm: Arm<Field>,
    locks: Vec<Option<JointPosition<Field>>>,
    is_moving: Vec<bool>,
}

/// The parts of a robot that a world keeps.
#[derive(Clone, Copy)]
pub(crate) struct World<'a> {
    pub(crate) facts: &'a [Fact],
    /// True if lengths and odd angles stay as they are: where conditions have numbers in them.
    pub(crate) keeps_numbers: bool,
    /// The moments of each link in the place of random bodies.
    pub(crate) bodies: Option<&'a [MomentBody<Field>]>,
    pub(crate) seed: u64,
}

fn residue(x: &Polynomial) -> Field {
    x.to_constant().map_or(Field::ZERO, |x| x.residue())
}

impl<'a> Geometry<'a> {
    /// Takes the numbers of an arm without symbols.
    pub(crate) fn new(setup: &'a Setup, arm: &SymbolicArm) -> Geometry<'a> {
        let lock = |lock: &Option<_>| lock.as_ref().map(|lock| mapped(lock, residue));
        let is_moving = |joint: usize| arm.variables.iter().any(|variable| variable.joint == joint);
        Geometry {
            setup,
            arm: arm.arm.map(residue),
            locks: arm.locks.iter().map(lock).collect(),
            is_moving: (0..setup.robot().joints.len()).map(is_moving).collect(),
        }
    }

    pub(crate) fn is_locked(&self, row: usize) -> bool {
        !self.is_moving[self.setup.robot().mover_of(row)]
    }

    /// Returns the turn about its own axis of a joint that does not turn freely.
    pub(crate) fn constant_turn(&self, row: usize) -> SinCosPair<Field> {
        let theta = &self.arm.links[row].theta;
        match &self.locks[row] {
            Some(JointPosition::Revolute(pair)) => pair.compose(theta),
            _ => theta.clone(),
        }
    }

    /// Computes the coefficients of a world at a random position.
    pub(crate) fn coefficients(&self, world: World<'_>) -> Option<Coefficients<Field>> {
        let mut points = Points::new(world.seed);
        let mut arm = self.arm.clone();
        let mut locks = self.locks.clone();
        let keeps = |fact: Fact| world.facts.contains(&fact);
        let rows = arm.links.iter_mut().zip(&mut locks).enumerate();
        for (row, (link, lock)) in rows {
            let turns: [SinCosPair<Field>; 4] = [0; 4].map(|_| circle(&mut points));
            let lengths: [Field; 4] = [0; 4].map(|_| points.field());
            let angle = |pair: &mut SinCosPair<Field>, drawn: usize, is_kept: bool| {
                if !(is_kept || world.keeps_numbers && !is_right(pair)) {
                    *pair = turns[drawn].clone();
                }
            };
            let length = |x: &mut Field, drawn: usize, is_kept: bool| {
                if !(is_kept || world.keeps_numbers && !is_zero(x)) {
                    *x = lengths[drawn];
                }
            };
            let keeps_angle = keeps(Fact::Along(row)) || keeps(Fact::Across(row));
            match &mut link.place {
                Some(place) => {
                    for axis in 0..3 {
                        let is_kept = keeps(Fact::NoOrigin(row, axis));
                        length(&mut place.origin[axis], axis, is_kept);
                    }
                    let is_odd = place.axes.iter().flatten().filter(|x| is_zero(x)).count() < 4;
                    let stays = keeps(Fact::RightTurn(row)) || world.keeps_numbers && is_odd;
                    if !stays {
                        *place = turned(place, &turns, keeps_angle);
                    }
                }
                None => {
                    angle(&mut link.alpha, 0, keeps_angle);
                    if let Some(beta) = &mut link.beta {
                        angle(beta, 1, false);
                    }
                    length(&mut link.a, 0, keeps(Fact::NoLength(row)));
                    let slides = link.kind == JointKind::Prismatic && !self.is_locked(row);
                    length(&mut link.d, 1, slides || keeps(Fact::NoOffset(row)));
                }
            }
            // A placement has been turned at random already, if it is not kept.
            let is_turned = |pair: &SinCosPair<Field>| link.place.is_some() && is_right(pair);
            if link.place.is_some() && !is_zero(&link.d) {
                link.d = lengths[3];
            }
            let is_kept = keeps(Fact::RightTurn(row)) || is_turned(&self.constant_turn(row));
            if let Some(JointPosition::Revolute(pair)) = lock {
                angle(pair, 2, is_kept);
            } else if link.kind == JointKind::Prismatic {
                angle(&mut link.theta, 2, is_kept);
            }
            link.mass = points.field();
            link.com = [0; 3].map(|_| points.field());
            link.inertia = Inertia::of([0; 6].map(|_| points.field()));
            let armature = points.field();
            if !keeps(Fact::NoArmature(row)) {
                link.armature = armature;
            }
        }
        // Gravity along one axis is a fact; in another direction its numbers are part of conditions.
        let is_along_axis = arm.gravity.iter().filter(|g| !is_zero(g)).count() <= 1;
        if !keeps(Fact::Gravity) && (is_along_axis || !world.keeps_numbers) {
            arm.gravity = [0; 3].map(|_| points.field());
        }
        let position = self.position(&mut points, &arm.following, &locks);
        let posed = posed(&arm, &locks, &position);
        let mut chain = posed.chain.clone();
        let bodies = world.bodies.into_iter().flatten();
        for (link, body) in chain.links.iter_mut().zip(bodies) {
            link.body = body.clone();
        }
        let none = |_: &Field| false;
        Coefficients::new(self.setup, &arm.following, &posed, &chain, none)
    }

    fn position(
        &self,
        points: &mut Points,
        following: &[FollowerLine<Field>],
        locks: &[Option<JointPosition<Field>>],
    ) -> Vec<JointPosition<Field>> {
        let robot = self.setup.robot();
        let mut position: Vec<JointPosition<Field>> =
            vec![JointPosition::Prismatic(Field::ZERO); self.arm.links.len()];
        for (joint, line) in robot.joints.iter().enumerate() {
            let row = robot.row_of(joint);
            let drawn = match line.kind {
                JointKind::Revolute => JointPosition::Revolute(circle(points)),
                JointKind::Prismatic => JointPosition::Prismatic(points.field()),
            };
            position[row] = locks[row].clone().unwrap_or(drawn);
        }
        for follower in following {
            position[follower.row] = position[follower.leader].followed_by(follower);
        }
        position
    }
}

fn circle(points: &mut Points) -> SinCosPair<Field> {
    let (sin, cos) = points.circle();
    SinCosPair { sin, cos }
}

/// Turns a placement at random; about both axes alone if the angle between these stays.
fn turned(
    place: &Columns<Field>,
    turns: &[SinCosPair<Field>; 4],
    keeps_angle: bool,
) -> Columns<Field> {
    let mut turned = place.clone();
    if !keeps_angle {
        turned = turned.turn_x(&turns[2]);
    }
    turned = turned.turn_z(&turns[0]);
    for axis in &mut turned.axes {
        let [x, y] = turns[1].turn(&axis[0], &axis[1]);
        (axis[0], axis[1]) = (x, y);
    }
    turned
}
