//! Checks of scenes, from files and from code.
//!
//! - this file: names, joints, locks, the payload
//! - `bounds`: the box
//! - `tolerance`: the tolerance, and what it needs of the robot

mod bounds;
mod tolerance;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Display;

use num_traits::Signed;

use super::Scene;
use crate::diagnostic::Diagnostic;
use crate::robot::{Findings, Joint, JointKind, Parent, Robot, RobotWarning, is_plain, reach};

impl Scene {
    /// Returns every error and warning. Every later stage accepts a scene without an error.
    pub fn validate(&self, robot: &Robot) -> Vec<Diagnostic> {
        let mut check = Check {
            scene: self,
            robot,
            found: Findings::default(),
        };
        check.name();
        check.joints();
        check.locks();
        check.payload();
        check.bounds();
        check.tolerance();
        check.found.0
    }
}

struct Check<'a> {
    scene: &'a Scene,
    robot: &'a Robot,
    found: Findings,
}

impl<'a> Check<'a> {
    fn error(&mut self, key: impl Display, message: impl Into<String>, help: &str) {
        self.found.error(self.place(key), message, help);
    }

    fn warn(&mut self, warning: RobotWarning, key: impl Display, message: String, help: &str) {
        self.found.warn(warning, self.place(key), message, help);
    }

    fn place(&self, key: impl Display) -> String {
        format!("scene/{}/{key}", self.scene.name)
    }

    fn name(&mut self) {
        let name = &self.scene.name;
        if name.is_empty() || name.len() > Robot::MAX_NAME || !is_plain(name) {
            let message = format!("{name:?} cannot end the name of a Rust module");
            let help = "the generated module is called after robot and scene: lower-case letters, digits and underscores";
            self.error("", message, help);
        }
    }

    fn joint(&self, index: usize) -> Option<&'a Joint> {
        self.robot.joints.get(index)
    }

    /// The coordinates of a base that floats in the scene.
    fn base(&self) -> usize {
        self.scene.base_coordinates(self.robot)
    }

    fn list(&mut self, key: &str, joints: &[usize], twice: &str) {
        for (index, &joint) in joints.iter().enumerate() {
            let place = format!("{key}/#{}", index + 1);
            if self.joint(joint).is_none() {
                let n = self.robot.joints.len();
                let message = format!("there is no joint {}: the robot has {n}", joint + 1);
                self.error(place, message, "joints are counted from 1");
            } else if joints[..index].contains(&joint) {
                let message = format!("{} is {twice}", self.robot.joint_label(joint));
                self.error(place, message, "once is enough");
            }
        }
    }

    fn joints(&mut self) {
        if self.scene.rows(self.robot.joints.len()).is_empty() {
            let (key, message) = match self.scene.joints {
                Some(_) => ("joints", "a scene needs the torque of at least one joint"),
                None => ("lock", "every joint is locked: nothing is left to compute"),
            };
            self.error(key, message, "joints = [1, 2, 3]");
        }
        if let Some(joints) = &self.scene.joints {
            self.list("joints", joints, "in the list already");
        }
    }

    fn locks(&mut self) {
        if self.scene.lock_base && self.robot.floating.is_none() {
            let message = "the base is locked, and it does not float";
            self.error("lock", message, "leave it out: it stands still");
        }
        let joints: Vec<usize> = self.scene.lock.iter().map(|(joint, _)| *joint).collect();
        self.list("lock", &joints, "locked already");
        for (entry, (index, at)) in self.scene.lock.iter().enumerate() {
            let place = format!("lock/#{}", entry + 1);
            let Some(joint) = self.joint(*index) else {
                continue;
            };
            if !at.is_of(joint.kind) {
                let help = "an angle for a revolute joint, a length for a prismatic one";
                self.error(place, "the position has the wrong unit", help);
                continue;
            }
            let positions = self.scene.bounds.position.as_ref();
            let bound = positions.and_then(|ranges| ranges.get(*index));
            let limits = joint.limits.position.as_ref();
            for (range, whose) in [(limits, "limits"), (bound, "range in the box")] {
                let Some([low, high]) = range else { continue };
                if at.is_below(low) || high.is_below(at) {
                    let name = self.robot.joint_label(*index);
                    let message = format!("{name} is locked outside its {whose}, {low} to {high}");
                    let help = match joint.kind {
                        JointKind::Revolute => {
                            "lock it in that range; a number is in rad, degrees are written as \"90deg\""
                        }
                        JointKind::Prismatic => "lock it in that range, in m",
                    };
                    self.error(&place, message, help);
                }
            }
        }
    }

    fn payload(&mut self) {
        let Some(payload) = &self.scene.payload else {
            return;
        };
        let rows = self.robot.rows().len();
        let message = match (self.scene.payload_link, self.robot.branches()) {
            (Some(Parent::Base), _) if self.base() == 0 => {
                Some("a payload on the base, which does not move: it has no effect")
            }
            (Some(Parent::Row(link)), _) if link >= rows => {
                Some("the payload is on a link that does not exist")
            }
            (None, branches) if branches || self.robot.floating.is_some() => {
                Some("the links branch, and the payload names no link that holds it")
            }
            (Some(Parent::Row(link)), false)
                if link + 1 != rows && self.robot.floating.is_none() =>
            {
                Some("a payload on another than the last link")
            }
            _ => None,
        };
        if let Some(message) = message {
            let help = "payload = { link = \"left_hand\", mass = 2.5, com = [0, 0, 0.05] } where links \
                        branch; the last link of a serial arm holds it";
            self.error("payload/link", message, help);
        }
        if payload.mass.is_negative() {
            let message = "the payload's mass is negative";
            self.error("payload/mass", message, "a mass in kg");
        }
        if payload.inertia.defect(&payload.mass).is_some() {
            let help = "about the payload's centre of mass: Ixx, Iyy, Izz, Ixy, Iyz, Ixz";
            self.error("payload/inertia", "no body has this inertia", help);
        }
        let reach = reach::reach(self.robot, &[]);
        let odd = reach::large_inertia(&payload.inertia, &payload.mass, &reach);
        if let Some((message, help)) = odd {
            let warning = RobotWarning::LargeInertia;
            self.warn(warning, "payload/inertia", message, &help);
        }
    }
}
