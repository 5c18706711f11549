//! The states for which a bound holds.

use std::collections::BTreeMap;

use dalembert_checker::certify::BodyRange;
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::number::Rounded;
use dalembert_model::robot::{FloatingBase, Joint, JointKind, Limit, Position, Robot};

use crate::function::{Argument, Function};
use crate::program::ScalarType;
use crate::setup::Setup;
use crate::sincos::interval::Interval;
use crate::sincos::stated;
use crate::states::JointState;

/// Intervals of joint positions, of velocities and accelerations, one a coordinate, and of a load.
#[derive(Clone, Debug, PartialEq)]
pub struct InputBox {
    /// q, rad or m.
    pub position: Vec<Interval>,
    /// q̇
    pub velocity: Vec<Interval>,
    /// q̈
    pub acceleration: Vec<Interval>,
    /// The entries of gravity in the axes of a base that floats: those of a ball; none on a fixed base.
    pub gravity: Vec<Interval>,
    /// The bodies that a payload may be, where it is an argument.
    pub payload: Option<BodyRange>,
    /// The entries of the load that it makes; [`Budget`](super::budget::Budget) knows them.
    pub load: Vec<Interval>,
}

/// Refuses a box without these limits, each with the joints that lack it; `None` is a base that floats.
pub(super) fn missing(
    limits: impl IntoIterator<Item = (&'static str, Vec<Option<usize>>)>,
) -> Diagnostic {
    let of = |(limit, owners): (&str, Vec<Option<usize>>)| {
        let base = owners.contains(&None).then(|| "the base".to_owned());
        let joints = owners.iter().flatten();
        let numbers: Vec<String> = joints.map(|joint| (joint + 1).to_string()).collect();
        let joints = match numbers.as_slice() {
            [] => None,
            [one] => Some(format!("joint {one}")),
            numbers => Some(format!("joints {}", numbers.join(", "))),
        };
        let is_one = numbers.len() + usize::from(base.is_some()) == 1;
        let have = if is_one { "has" } else { "have" };
        let both: Vec<String> = base.into_iter().chain(joints).collect();
        format!("{} {have} no limit `{limit}`", both.join(" and "))
    };
    let limits: Vec<String> = limits.into_iter().map(of).collect();
    Diagnostic::error(format!("a bound needs a box: {}", limits.join("; ")))
}

/// Returns the bodies that a payload may be.
pub(crate) fn payloads(setup: &Setup) -> BodyRange {
    let payload_range = setup.robot().payload_range.as_ref();
    payload_range.map_or_else(BodyRange::default, |range| BodyRange {
        mass: range.mass.each_ref().map(f64::nearest_rational),
        radius: f64::nearest_rational(&range.radius),
    })
}

impl InputBox {
    /// Returns the robot's limits. A revolute joint without any of position may stand anywhere: one turn.
    pub fn of(robot: &Robot) -> Result<InputBox, Diagnostic> {
        InputBox::within(&Setup::whole(robot), Function::InverseDynamics)
    }

    /// Returns the states of a robot in its scene that a function reads: its box, or the robot's
    /// limits. Locked joints stand still where they are; a rate that is no argument is zero.
    pub fn within(setup: &Setup, function: Function) -> Result<InputBox, Diagnostic> {
        let arguments = setup.arguments(function);
        let mut limits = InputBox {
            position: Vec::new(),
            velocity: Vec::new(),
            acceleration: Vec::new(),
            gravity: Vec::new(),
            payload: arguments.contains(&Argument::Load).then(|| payloads(setup)),
            load: Vec::new(),
        };
        let mut lacking: BTreeMap<&'static str, Vec<Option<usize>>> = BTreeMap::new();
        limits.add_base(setup, &arguments, &mut lacking);
        for (joint, row) in setup.robot().joints.iter().enumerate() {
            // Where a limit is missing, the box is not returned.
            let mut or_missing = |range: Option<Interval>, limit: Limit| {
                range.unwrap_or_else(|| {
                    lacking.entry(limit.key()).or_default().push(Some(joint));
                    Interval::ZERO
                })
            };
            if let Some(at) = setup.scene().and_then(|scene| scene.locked(joint)) {
                limits.position.push(around(at));
                limits.velocity.push(Interval::ZERO);
                limits.acceleration.push(Interval::ZERO);
                continue;
            }
            let range = or_missing(position(row), Limit::Position);
            limits.position.push(range);
            let mut rate = |argument, limit| {
                if !arguments.contains(&argument) {
                    return Interval::ZERO;
                }
                let most = row.limits.rate(limit).map(f64::nearest_rational);
                or_missing(most.map(Interval::symmetric), limit)
            };
            let velocity = rate(Argument::Velocity, Limit::Velocity);
            let acceleration = rate(Argument::Acceleration, Limit::Acceleration);
            limits.velocity.push(velocity);
            limits.acceleration.push(acceleration);
        }
        match lacking.is_empty() {
            true => Ok(limits),
            false => Err(missing(lacking.into_iter().rev())),
        }
    }

    fn add_base(
        &mut self,
        setup: &Setup,
        arguments: &[Argument],
        lacking: &mut BTreeMap<&'static str, Vec<Option<usize>>>,
    ) {
        let Some(base) = &setup.robot().floating else {
            return;
        };
        let gravity = setup.robot().gravity.each_ref().map(f64::nearest_rational);
        let length = libm::sqrt(gravity.iter().map(|x| x * x).sum());
        self.gravity = vec![Interval::symmetric(length); 3];
        let (velocity, acceleration) = (&mut self.velocity, &mut self.acceleration);
        for (argument, limit, intervals) in [
            (Argument::Velocity, Limit::Velocity, velocity),
            (Argument::Acceleration, Limit::Acceleration, acceleration),
        ] {
            let is_read = arguments.contains(&argument);
            let most = base.limits.rate(limit).filter(|_| is_read);
            if is_read && most.is_none() {
                lacking.entry(limit.key()).or_default().push(None);
            }
            let range = |k: usize| most.map_or(0.0, |most| f64::nearest_rational(&most[k]));
            let ranges = (0..FloatingBase::COORDINATES).map(range);
            intervals.extend(ranges.map(Interval::symmetric));
        }
    }

    /// Returns the ranges of an argument; none of one that a box does not bound.
    pub fn of_argument(&self, argument: Argument) -> &[Interval] {
        match argument {
            Argument::Position => &self.position,
            Argument::Velocity => &self.velocity,
            Argument::Acceleration => &self.acceleration,
            Argument::Gravity => &self.gravity,
            Argument::Load => &self.load,
            _ => &[],
        }
    }

    /// Lists the entries of the state, with gravity where the base floats.
    pub(super) fn entries(&self) -> Vec<(Argument, usize)> {
        let arguments = Argument::STATE.into_iter().chain([Argument::Gravity]);
        let of =
            |argument| (0..self.of_argument(argument).len()).map(move |index| (argument, index));
        arguments.flat_map(of).collect()
    }

    /// Shortens gravity to the length that it has.
    pub(super) fn hold(&self, state: &mut JointState) {
        let most = self.gravity.first().map_or(0.0, |range| range.high());
        let length = libm::sqrt(state.g.iter().map(|x| x * x).sum());
        if length > most {
            state.g.iter_mut().for_each(|entry| *entry *= most / length);
        }
    }

    pub fn joints(&self) -> usize {
        self.position.len()
    }

    /// Returns the positions over which sines must be good: those of the box, and [`stated`] angles
    /// of a joint that [turns freely](turns_freely).
    pub(crate) fn sine_positions(&self, robot: &Robot, scalar: ScalarType) -> Vec<Interval> {
        let range = |(joint, range): (usize, &Interval)| match turns_freely(robot, joint) {
            true => Interval::symmetric(stated(scalar)),
            false => *range,
        };
        self.position.iter().enumerate().map(range).collect()
    }
}

/// Returns true if a joint may stand anywhere, however many turns: it has no limits. Everything
/// reads its sine and cosine, so that what holds over one turn holds wherever those two are good.
pub(crate) fn turns_freely(robot: &Robot, joint: usize) -> bool {
    let turns = |of: &Joint| of.kind == JointKind::Revolute && of.limits.position.is_none();
    robot.joints.get(joint).is_some_and(turns)
}

fn around(at: &Position) -> Interval {
    let near = at.to_f64();
    Interval::new(near.next_down(), near.next_up()).unwrap_or(Interval::point(near))
}

fn position(joint: &Joint) -> Option<Interval> {
    match (&joint.limits.position, joint.kind) {
        (Some([low, high]), _) => Interval::new(low.to_f64(), high.to_f64()),
        (None, JointKind::Revolute) => Some(Interval::symmetric(std::f64::consts::PI)),
        (None, JointKind::Prismatic) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::Sizes;
    use crate::program::Program;
    use crate::tolerance::scale;
    use dalembert_model::read::parse;

    #[test]
    fn limits_that_are_missing_and_limits_of_zero() {
        let of = |limits: &str| {
            let source = format!(
                "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n[[joint]]\n\
                 kind = \"revolute\"\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
                 limits = {{ {limits} }}\n"
            );
            parse(&source).unwrap().robot
        };
        let program = |function| Program::empty(function, Sizes::whole(1));
        let still = of("velocity = 0, acceleration = 0, torque = 0");
        let at_rest = InputBox::of(&still).unwrap();
        assert_eq!(at_rest.velocity, [Interval::ZERO]);
        for (limits, function, words) in [
            ("", Function::Gravity, "joint 1 has no limit `torque`"),
            (
                "torque = 0",
                Function::Gravity,
                "the limit `torque` of joint 1 is 0",
            ),
            (
                "torque = 1, acceleration = 0",
                Function::Inertia,
                "the limit `acceleration` of joint 1 is 0",
            ),
        ] {
            let error = scale::actuator(&of(limits), &program(function)).unwrap_err();
            assert!(error.to_string().contains(words), "{limits}: {error}");
        }
    }
}
