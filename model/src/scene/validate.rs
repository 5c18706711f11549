//! What no scene of a robot may be, whoever made it.
//!
//! - this file: names, joints, locks, the payload
//! - `bounds`: the box
//! - `tolerance`: the tolerance, and what it needs of the robot

mod bounds;
mod tolerance;

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::fmt;

use num_traits::Signed;

use super::Scene;
use crate::number::Rational;
use crate::number::parse::write_decimal;
use crate::robot::{Field, Joint, JointKind, Position, Robot, RobotWarning, Severity, reach};

/// A part of a scene, so that a reader can say on which line it is. Indices
/// are places in the scene's lists, zero-based.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// The scene's name.
    Name,
    /// The list of outputs.
    Outputs,
    /// An entry of `joints`; the list itself where it has no such entry.
    Joint(usize),
    /// An entry of `lock`; the table itself where it has no such entry.
    Lock(usize),
    /// The payload, by field.
    Payload(Field),
    /// An entry of a list of the box, which `Field` names.
    Box(Field, usize),
    /// An entry of the tolerance's values; the tolerance itself where it has
    /// no such entry.
    Tolerance(usize),
    /// A limit of a joint of the robot, which the scene needs to be otherwise.
    Limit(usize, Field),
}

/// Something wrong, or odd, about a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneFinding {
    /// Error or warning.
    pub severity: Severity,
    /// The name of a warning; `None` of an error.
    pub warning: Option<RobotWarning>,
    /// Which part.
    pub part: Part,
    /// A sentence that says the mistake.
    pub message: String,
    /// The likely fix.
    pub help: String,
}

impl fmt::Display for SceneFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match self.help.as_str() {
            "" => Ok(()),
            help => write!(f, " ({help})"),
        }
    }
}

impl Scene {
    /// Returns everything that is wrong or odd about the scene; without an error among
    /// it, every later stage accepts it with this robot.
    pub fn validate(&self, robot: &Robot) -> Vec<SceneFinding> {
        let mut check = Check {
            scene: self,
            robot,
            found: Vec::new(),
        };
        check.name();
        check.joints();
        check.locks();
        check.payload();
        check.bounds();
        check.tolerance();
        check.found
    }
}

struct Check<'a> {
    scene: &'a Scene,
    robot: &'a Robot,
    found: Vec<SceneFinding>,
}

impl<'a> Check<'a> {
    fn say(&mut self, part: Part, message: String, help: &str) {
        self.push(None, part, message, help);
    }

    fn warn(&mut self, warning: RobotWarning, part: Part, message: String, help: &str) {
        self.push(Some(warning), part, message, help);
    }

    fn push(&mut self, warning: Option<RobotWarning>, part: Part, message: String, help: &str) {
        self.found.push(SceneFinding {
            severity: warning.map_or(Severity::Error, |_| Severity::Warning),
            warning,
            part,
            message,
            help: help.to_owned(),
        });
    }

    fn name(&mut self) {
        let name = &self.scene.name;
        let good = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if name.is_empty() || name.len() > Robot::MAX_NAME || !name.chars().all(good) {
            self.say(
                Part::Name,
                format!("{name:?} cannot end the name of a Rust module"),
                "the generated module is called after robot and scene: lower-case letters, digits and underscores",
            );
        }
    }

    fn joint(&self, index: usize) -> Option<&'a Joint> {
        self.robot.joints.get(index)
    }

    /// Checks that there are such joints, and none twice.
    fn list(&mut self, part: fn(usize) -> Part, joints: &[usize], twice: &str) {
        for (place, &joint) in joints.iter().enumerate() {
            if self.joint(joint).is_none() {
                let n = self.robot.joints.len();
                let message = format!("there is no joint {}: the robot has {n}", joint + 1);
                self.say(part(place), message, "joints are counted from 1");
            } else if joints[..place].contains(&joint) {
                let message = format!("joint {} is {twice}", self.called(joint));
                self.say(part(place), message, "once is enough");
            }
        }
    }

    /// Returns `4`, or `4 (wrist)`.
    fn called(&self, joint: usize) -> String {
        match self.joint(joint).and_then(|j| j.name.as_deref()) {
            Some(name) => format!("{} ({name})", joint + 1),
            None => format!("{}", joint + 1),
        }
    }

    fn joints(&mut self) {
        let rows = self.scene.rows(self.robot.joints.len());
        if rows.is_empty() {
            let message = match self.scene.joints {
                Some(_) => "a scene wants the torque of one joint at least",
                None => "every joint is locked: nothing is left to compute",
            };
            let part = match self.scene.joints {
                Some(_) => Part::Joint(usize::MAX),
                None => Part::Lock(usize::MAX),
            };
            self.say(part, message.to_owned(), "joints = [1, 2, 3]");
        }
        if let Some(joints) = &self.scene.joints {
            self.list(Part::Joint, joints, "in the list already");
        }
    }

    fn locks(&mut self) {
        let joints: Vec<usize> = self.scene.lock.iter().map(|(joint, _)| *joint).collect();
        self.list(Part::Lock, &joints, "locked already");
        for (place, (index, at)) in self.scene.lock.iter().enumerate() {
            let Some(joint) = self.joint(*index) else {
                continue;
            };
            if !of_kind(joint.kind, at) {
                let help = "an angle for a revolute joint, a length for a prismatic one";
                let message = "the position is not of the joint's kind".to_owned();
                self.say(Part::Lock(place), message, help);
                continue;
            }
            let scene = self.scene;
            let own = scene.bounds.position.as_ref();
            for (range, whose) in [
                (joint.limits.position.as_ref(), "limits"),
                (own.and_then(|all| all.get(*index)), "range in the box"),
            ] {
                let Some([low, high]) = range else { continue };
                let outside = compare(at, low) == Some(Ordering::Less)
                    || compare(at, high) == Some(Ordering::Greater);
                if outside {
                    let message = format!(
                        "joint {} is locked outside its {whose}, {} to {}",
                        self.called(*index),
                        shown(low),
                        shown(high)
                    );
                    let help = match joint.kind {
                        JointKind::Revolute => {
                            "lock it where it can be; a number is in rad, degrees are written as \"90deg\""
                        }
                        JointKind::Prismatic => "lock it where it can be, in m",
                    };
                    self.say(Part::Lock(place), message, help);
                }
            }
        }
    }

    fn payload(&mut self) {
        let Some(payload) = &self.scene.payload else {
            return;
        };
        if payload.mass.is_negative() {
            let message = "the payload's mass is negative".to_owned();
            self.say(Part::Payload(Field::Mass), message, "a mass in kg");
        }
        if payload.inertia.defect(&payload.mass).is_some() {
            let message = "no body has this inertia".to_owned();
            let help = "about the payload's centre of mass: Ixx, Iyy, Izz, Ixy, Iyz, Ixz";
            self.say(Part::Payload(Field::Inertia), message, help);
        }
        let reach = reach::reach(self.robot, &[]);
        let odd = reach::large_inertia(&payload.inertia, &payload.mass, &reach);
        if let Some((message, help)) = odd {
            let part = Part::Payload(Field::Inertia);
            self.warn(RobotWarning::LargeInertia, part, message, &help);
        }
    }
}

fn of_kind(kind: JointKind, at: &Position) -> bool {
    matches!(
        (kind, at),
        (JointKind::Revolute, Position::Angle(_)) | (JointKind::Prismatic, Position::Length(_))
    )
}

fn compare(a: &Position, b: &Position) -> Option<Ordering> {
    match (a, b) {
        (Position::Angle(a), Position::Angle(b)) => Some(a.cmp_value(b)),
        (Position::Length(a), Position::Length(b)) => Some(a.cmp(b)),
        _ => None,
    }
}

fn shown(at: &Position) -> String {
    match at {
        Position::Angle(angle) => format!("{angle}"),
        Position::Length(length) => decimal(length),
    }
}

fn decimal(value: &Rational) -> String {
    write_decimal(value).unwrap_or_else(|| format!("{value}"))
}
