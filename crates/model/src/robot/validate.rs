//! Checks of robots, from files and from code.
//!
//! The robot file's reader, the macro and code that fills in a [`Robot`] by
//! hand all come through here, so that the stages after may rely on it.

use alloc::borrow::ToOwned;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use num_traits::{Signed, Zero};

use super::body::Defect;
use super::findings::{Findings, of_joint};
use super::{
    Convention, Joint, JointKind, Limit, Placement, Position, Robot, RobotWarning, reach, units,
    values,
};
use crate::diagnostic::Diagnostic;
use crate::number::parse::in_range;
use crate::number::{Angle, Rational, Rounded};

/// The widths over which the sign of Coulomb friction may be smoothed.
const WIDTHS: core::ops::RangeInclusive<f64> = 1e-9..=1e9;

/// The name by which a robot's own hand is a frame, too.
pub const HAND: &str = "hand";

/// The longest name of a frame, in bytes: functions are called after it.
const MAX_FRAME_NAME: usize = 48;

pub(crate) const ENDINGS: [&str; 2] = ["_batch", "_columns"];

impl Robot {
    /// Returns every error and warning. Every later stage accepts a robot without an error.
    pub fn validate(&self) -> Vec<Diagnostic> {
        self.validate_placed(&[])
    }

    /// `placed` are the placements of joints that have no rows yet; empty for a robot with rows.
    pub(crate) fn validate_placed(&self, placed: &[Placement]) -> Vec<Diagnostic> {
        let mut findings = Findings::default();
        let reach = reach::reach(self, placed);
        findings.robot_name(&self.name);
        for value in &self.gravity {
            findings.size("gravity", value);
        }
        findings.doubtful_gravity(&self.gravity);
        findings.upward_gravity(&self.gravity);
        for (key, placement) in self.placements() {
            if let Some(placement) = placement {
                findings.placement(key, placement);
            }
        }
        let rows = self.rows();
        if self.joints.is_empty() || rows.len() > Robot::MAX_JOINTS {
            let (most, count) = (Robot::MAX_JOINTS, rows.len());
            let message = format!("a robot has 1 to {most} joints, not {count}");
            findings.error("joint", message, "each joint is a [[joint]] table");
        }
        if !self.follow() {
            let message = "the mimic joints are out of order or inconsistent";
            let help = "each follows a joint of its kind, one that turns by a whole multiple";
            findings.error("joint", message, help);
        }
        findings.tree(self);
        findings.floating(self);
        let mut names = BTreeMap::new();
        if let Some(base) = self.floating.as_ref().and_then(|base| base.name.as_deref()) {
            names.insert(base, None);
        }
        for (index, joint) in rows.into_iter().enumerate() {
            findings.joint(index, joint);
            findings.doubtful_joint(index, joint);
            let large = reach::large_inertia(&joint.inertia, &joint.mass, &reach);
            if let Some((message, help)) = large {
                let (name, place) = (RobotWarning::LargeInertia, of_joint(index, "inertia"));
                findings.warn(name, place, message, &help);
            }
            if let Some(placement) = placed.get(index) {
                findings.placement(&of_joint(index, "placement"), placement);
            }
            if self.convention == Convention::Modified && !joint.beta.is_zero() {
                let message = "a turn about y after the twist belongs to standard DH";
                let help = "write the table in the standard convention, or leave beta out";
                findings.error(of_joint(index, "beta"), message, help);
            }
            let Some(name) = joint.name.as_deref() else {
                continue;
            };
            findings.joint_name(index + 1, name);
            if let Some(first) = names.get(name) {
                let message = match first {
                    None => format!("the base is called {name:?} already"),
                    Some(first) => format!("joint {} is called {name:?} already", first + 1),
                };
                let help = "give every joint a name of its own, or none";
                findings.error(of_joint(index, "name"), message, help);
            } else {
                names.insert(name, Some(index));
            }
        }
        findings.frames(self);
        findings.bodies("limits/payload", &self.payload_range);
        let has_control = |note: &String| values::one_line(note) != *note;
        if self.notes.iter().any(has_control) {
            let message = "a note has a character that controls text or turns its direction";
            findings.error("notes", message, "write each note in one line");
        }
        findings.0
    }
}

impl Findings {
    fn robot_name(&mut self, name: &str) {
        let message = if name.is_empty() {
            "the name is empty".to_string()
        } else if name.chars().count() > Robot::MAX_NAME {
            format!("the name has more than {} characters", Robot::MAX_NAME)
        } else if is_keyword(name) {
            format!("{name:?} is a Rust keyword")
        } else if !is_snake(name) {
            format!("{name:?} cannot name a Rust module")
        } else {
            return;
        };
        let help = match suggested_name(name) {
            Some(better) => format!("the generated module is called after the robot; write {better:?}"),
            None => "the generated module is called after the robot: lower-case letters, digits and underscores, a letter first".to_owned(),
        };
        self.error("name", message, &help);
    }

    /// Joints are counted from one; a base that floats is zero.
    pub(super) fn joint_name(&mut self, joint: usize, name: &str) {
        let place = format!("joint/#{joint}/name");
        let length = name.chars().count();
        if length == 0 || length > Robot::MAX_NAME || name.chars().any(char::is_control) {
            let most = Robot::MAX_NAME;
            let message = format!(
                "a joint's name has 1 to {most} characters, none of them a control character"
            );
            self.error(place, message, "leave the name out if the joint has none");
        } else if name.chars().any(units::turns_text) {
            let message = "a joint's name contains a character that turns the direction of text";
            self.error(place, message, &units::without_turns(name));
        } else if let Ok(number) = name.trim().parse::<i64>()
            && usize::try_from(number) != Ok(joint)
        {
            // Scenes name joints by either.
            let message = format!(
                "joint {joint} is called {name:?}, which is a joint's number and not its own"
            );
            self.error(place, message, &format!("write \"joint_{number}\""));
        }
    }

    fn frames(&mut self, robot: &Robot) {
        if robot.frames.len() > Robot::MAX_FRAMES {
            let message = format!("a robot has {} frames at most", Robot::MAX_FRAMES);
            self.error("frame", message, "leave out the frames that are not used");
        }
        let mut names = BTreeMap::new();
        for (index, frame) in robot.frames.iter().enumerate() {
            let place = format!("frame/#{}/name", index + 1);
            let (place, name) = (place.as_str(), frame.name.as_str());
            if name == HAND {
                let message = format!("`{HAND}` is the name of the robot's own hand");
                self.error(place, message, "give the frame another name");
            } else if !is_frame_name(name) {
                let message = format!("{name:?} cannot name a frame");
                let help = match suggested_name(name).filter(|name| is_frame_name(name)) {
                    Some(better) => {
                        format!("functions are called after it, `jacobian_{better}`; write {better:?}")
                    }
                    None => "functions are called after it: small letters, digits and single `_` between them".to_owned(),
                };
                self.error(place, message, &help);
            } else if let Some(first) = names.insert(name, index) {
                let message = format!("frame {} is called {name:?} already", first + 1);
                self.error(place, message, "give every frame a name of its own");
            }
            let rows = robot.rows().len();
            if frame.row.is_some_and(|row| row >= rows)
                || frame.row.is_none() && robot.floating.is_none()
            {
                let message = format!("frame {name:?} is fixed to a link that does not exist");
                let help = format!("links are counted from 1 to {rows}");
                self.error(place, message, &help);
            }
            self.placement(place, &frame.placement);
        }
    }

    pub(super) fn placement(&mut self, place: &str, placement: &Placement) {
        for value in &placement.xyz {
            self.size(place, value);
        }
        for value in &placement.rpy {
            self.angle(place, value);
        }
        self.doubtful_placement(place, placement);
    }

    fn joint(&mut self, index: usize, joint: &Joint) {
        let at = |key: &str| of_joint(index, key);
        // The constant part of the variable is called offset in the file.
        let (d, theta) = match joint.kind {
            JointKind::Revolute => ("d", "offset"),
            JointKind::Prismatic => ("offset", "theta"),
        };
        self.angle(&at("alpha"), &joint.alpha);
        self.angle(&at("beta"), &joint.beta);
        self.angle(&at(theta), &joint.theta);
        self.size(&at("a"), &joint.a);
        self.size(&at(d), &joint.d);
        self.inertial(&at, joint);
        self.not_negative(&at("viscous"), &joint.viscous);
        self.coulomb(index, joint);
        self.not_negative(&at("armature"), &joint.armature);
        if let Some(frame) = &joint.frame {
            self.placement(&at("frame"), frame);
        }
        for rate in [Limit::Velocity, Limit::Acceleration, Limit::Torque] {
            if let Some(limit) = joint.limits.rate(rate) {
                self.not_negative(&at(&format!("limits/{}", rate.key())), limit);
            }
        }
        self.bodies(at("limits/body"), &joint.limits.body);
        if let Some(range) = &joint.limits.position {
            self.range(&at("limits/position"), joint.kind, range);
        }
    }

    pub(super) fn inertial(&mut self, at: &dyn Fn(&str) -> String, joint: &Joint) {
        for value in &joint.com {
            self.size(&at("com"), value);
        }
        for value in joint.inertia.rows().iter().flatten() {
            self.size(&at("inertia"), value);
        }
        self.not_negative(&at("mass"), &joint.mass);
        self.body(&at("inertia"), joint);
    }

    /// Checks the width of Coulomb friction: without one it would jump where a joint stands
    /// still, and have no slope there; the square of one is a number in f32, too.
    fn coulomb(&mut self, index: usize, joint: &Joint) {
        let unit = match joint.kind {
            JointKind::Revolute => "rad/s",
            JointKind::Prismatic => "m/s",
        };
        self.not_negative(&of_joint(index, "coulomb"), &joint.coulomb);
        let width = &joint.coulomb_width;
        let message = if width.is_negative() {
            "coulomb_width is negative"
        } else if width.is_zero() && joint.coulomb.is_positive() {
            "Coulomb friction without a `coulomb_width` above zero"
        } else if !width.is_zero() && !WIDTHS.contains(&f64::nearest_rational(width)) {
            "a coulomb_width too large or too small"
        } else {
            return;
        };
        let help = format!(
            "coulomb_width = 0.01, in {unit}: at this speed the friction is 1/√2 of `coulomb`, at \
             ten times as much less than 0.5 % below it"
        );
        self.error(of_joint(index, "coulomb_width"), message, &help);
    }

    fn size(&mut self, place: &str, value: &Rational) {
        if !in_range(value) {
            let message = "a number too large or too small";
            self.error(place, message, "zero, or a size from 1e-300 to 1e300");
        }
    }

    fn angle(&mut self, place: &str, value: &Angle) {
        self.size(place, value.number());
    }

    pub(super) fn not_negative(&mut self, place: &str, value: &Rational) {
        self.size(place, value);
        if value.is_negative() {
            let (_, key) = place.rsplit_once('/').unwrap_or(("", place));
            let help = match key {
                "mass" => "a mass is zero or more, in kg",
                "viscous" => "damping takes energy out: zero or more",
                "coulomb" => "friction takes energy out: zero or more, in N·m or N",
                "armature" => "a rotor's inertia is zero or more",
                _ => "a limit bounds the size, in both directions: zero or more",
            };
            self.error(place, format!("{key} is negative"), help);
        }
    }

    fn range(&mut self, place: &str, kind: JointKind, range: &[Position; 2]) {
        for position in range {
            match position {
                Position::Angle(angle) => self.angle(place, angle),
                Position::Length(length) => self.size(place, length),
            }
        }
        let [low, high] = range;
        if !low.is_of(kind) || !high.is_of(kind) {
            let message = "the limits have the wrong unit";
            let help = "angles for a revolute joint, lengths for a prismatic one";
            self.error(place, message, help);
        } else if !low.is_below(high) {
            let message = "the lowest position is not below the highest";
            self.error(place, message, "write [lowest, highest]");
        }
    }

    fn body(&mut self, place: &str, joint: &Joint) {
        let Some(defect) = joint.inertia.defect(&joint.mass) else {
            return;
        };
        let help = match defect {
            Defect::NegativeMoment => {
                let help = "the order is Ixx, Iyy, Izz, Ixy, Iyz, Ixz about the centre of mass";
                return self.error(place, defect.message(), help);
            }
            Defect::Triangle => {
                "expected for a link whose other moments were left out; taken as it stands"
            }
            Defect::Massless => "expected for a link whose mass was left out; taken as it stands",
        };
        // Published tables miss masses and have broken tensors: either way only a warning.
        let warning = RobotWarning::ImpossibleInertia;
        self.warn(warning, place, defect.message(), help);
    }
}

/// Words of Rust, of all editions, reserved ones included.
pub(crate) const WORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

fn is_keyword(name: &str) -> bool {
    WORDS.contains(&name) || ["union", "core", "std"].contains(&name)
}

/// Small letters, digits and `_` only.
pub(crate) fn is_plain(name: &str) -> bool {
    let known = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.chars().all(known)
}

pub(crate) fn is_snake(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase()) && is_plain(name)
}

/// True if a frame may have this name: `[a-z0-9]` and single `_` inside, no ending of functions.
pub fn is_frame_name(name: &str) -> bool {
    let is_own = ENDINGS.iter().any(|ending| name.ends_with(ending));
    let bars = name.starts_with('_') || name.ends_with('_') || name.contains("__");
    (1..=MAX_FRAME_NAME).contains(&name.len()) && is_plain(name) && !bars && !is_own
}

/// Returns the nearest name that a robot can have, `ur_10_e` for `"UR-10 e"`; none of signs alone.
pub fn suggested_name(name: &str) -> Option<String> {
    let mut better = String::new();
    for c in name.chars() {
        if c.is_ascii_alphanumeric() {
            better.push(c.to_ascii_lowercase());
        } else if !better.is_empty() && !better.ends_with('_') {
            better.push('_');
        }
        if better.len() == Robot::MAX_NAME {
            break;
        }
    }
    let better = better.trim_end_matches('_');
    let better = match better.chars().next()? {
        '0'..='9' => format!("robot_{better}"),
        _ if is_keyword(better) => format!("{better}_robot"),
        _ => better.to_owned(),
    };
    (better.len() <= Robot::MAX_NAME).then_some(better)
}
