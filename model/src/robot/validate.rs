//! What no robot may be, whoever made it.
//!
//! The robot file's reader, the macro and code that fills in a [`Robot`] by
//! hand all come through here, so that the stages after may rely on it.

use alloc::borrow::ToOwned;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::cmp::Ordering;

use num_traits::{Signed, Zero};

use super::body::Defect;
use super::findings::{Finding, Findings};
use super::frame::{HAND, is_frame_name};
use super::{
    Convention, Field, Joint, JointKind, Place, Placement, Position, Robot, RobotWarning, reach,
    units,
};
use crate::number::parse::in_range;
use crate::number::{Angle, Rational, Rounded};

/// The widths over which the sign of Coulomb friction may be smoothed.
const WIDTHS: core::ops::RangeInclusive<f64> = 1e-9..=1e9;

impl Robot {
    /// Returns everything that is wrong or odd about the robot; without an error among
    /// it, every later stage accepts the robot.
    pub fn validate(&self) -> Vec<Finding> {
        self.validate_placed(&[])
    }

    /// Returns the same of a robot whose joints are placed, before it has rows: what
    /// is wrong or odd about the numbers that somebody wrote, not about those that
    /// follow.
    pub(crate) fn validate_placed(&self, placed: &[Placement]) -> Vec<Finding> {
        let mut findings = Findings::default();
        let reach = reach::reach(self, placed);
        findings.robot_name(&self.name);
        for value in &self.gravity {
            findings.size(Place::Gravity, value);
        }
        findings.doubtful_gravity(&self.gravity);
        findings.upward_gravity(&self.gravity);
        for (place, _, placement) in self.placements() {
            if let Some(placement) = placement {
                findings.placement(place, placement);
                findings.doubtful_placement(place, placement);
            }
        }
        let rows = self.rows();
        if self.joints.is_empty() || rows.len() > Robot::MAX_JOINTS {
            findings.error(
                Place::Joints,
                format!(
                    "a robot has 1 to {} joints, not {}",
                    Robot::MAX_JOINTS,
                    rows.len()
                ),
                "each joint is a [[joint]] table",
            );
        }
        if !self.follow() {
            let message = "rows that follow are not in order, or cannot follow as they are to";
            let help = "each follows a joint of its kind, one that turns by a whole multiple";
            findings.error(Place::Joints, message.into(), help);
        }
        let mut names = BTreeMap::new();
        for (index, joint) in rows.into_iter().enumerate() {
            findings.joint(index, joint);
            findings.doubtful_joint(index, joint);
            findings.doubtful_inertia(index, joint, &reach);
            if let Some(placement) = placed.get(index) {
                let place = Place::Joint(index, Field::Placement);
                findings.placement(place, placement);
                findings.doubtful_placement(place, placement);
            }
            if self.convention == Convention::Modified && !joint.beta.is_zero() {
                findings.error(
                    Place::Joint(index, Field::Beta),
                    "a turn about y after the twist belongs to standard DH".to_owned(),
                    "write the table in the standard convention, or leave beta out",
                );
            }
            let Some(name) = joint.name.as_deref() else {
                continue;
            };
            let place = Place::Joint(index, Field::Name);
            findings.joint_name(place, name);
            findings.joint_number(index, name);
            if let Some(first) = names.get(name) {
                findings.error(
                    place,
                    format!("joint {} is called {name:?} already", first + 1),
                    "give every joint a name of its own, or none",
                );
            } else {
                names.insert(name, index);
            }
        }
        findings.frames(self);
        findings.into_all()
    }
}

impl Findings {
    fn robot_name(&mut self, name: &str) {
        let message = if name.is_empty() {
            "the name is empty".to_string()
        } else if name.chars().count() > Robot::MAX_NAME {
            format!("the name has more than {} characters", Robot::MAX_NAME)
        } else if KEYWORDS.contains(&name) {
            format!("{name:?} is a word of the Rust language")
        } else if !is_snake(name) {
            format!("{name:?} cannot name a Rust module")
        } else {
            return;
        };
        let help = match suggested_name(name) {
            Some(better) => format!("the generated module is called after the robot; write {better:?}"),
            None => "the generated module is called after the robot: lower-case letters, digits and underscores, a letter first".to_owned(),
        };
        self.error(Place::Name, message, &help);
    }

    fn joint_name(&mut self, place: Place, name: &str) {
        let length = name.chars().count();
        if length == 0 || length > Robot::MAX_NAME || name.chars().any(char::is_control) {
            self.error(
                place,
                format!(
                    "a joint's name has 1 to {} characters, none of them a control character",
                    Robot::MAX_NAME
                ),
                "leave the name out if the joint has none",
            );
        } else if name.chars().any(units::turns_text) {
            self.error(
                place,
                "a joint's name has no character that turns the direction of text".to_owned(),
                &units::without_turns(name),
            );
        }
    }

    /// Refuses a name that is another joint's number: scenes name joints by either.
    fn joint_number(&mut self, index: usize, name: &str) {
        let Ok(number) = name.trim().parse::<i64>() else {
            return;
        };
        if usize::try_from(number) != Ok(index + 1) {
            let message = format!(
                "joint {} is called {name:?}, which is a joint's number and not its own",
                index + 1
            );
            let help = format!("write \"joint_{number}\"");
            self.error(Place::Joint(index, Field::Name), message, &help);
        }
    }

    fn frames(&mut self, robot: &Robot) {
        if robot.frames.len() > Robot::MAX_FRAMES {
            let message = format!("a robot has {} frames at most", Robot::MAX_FRAMES);
            self.error(
                Place::Frames,
                message,
                "leave out those that nothing asks for",
            );
        }
        let mut names = BTreeMap::new();
        for (index, frame) in robot.frames.iter().enumerate() {
            let (place, name) = (Place::Frame(index), frame.name.as_str());
            if name == HAND {
                let message = format!("`{HAND}` is the name of the robot's own hand");
                self.error(place, message, "call the frame otherwise");
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
            if frame.joint >= rows {
                let message = format!("frame {name:?} is fixed to no link of the robot");
                let help = format!("links are counted from 1 to {rows}");
                self.error(place, message, &help);
            }
            self.placement(place, &frame.placement);
            self.doubtful_placement(place, &frame.placement);
        }
    }

    fn placement(&mut self, place: Place, placement: &Placement) {
        for value in &placement.xyz {
            self.size(place, value);
        }
        for value in &placement.rpy {
            self.angle(place, value);
        }
    }

    fn joint(&mut self, index: usize, joint: &Joint) {
        let at = |field| Place::Joint(index, field);
        // What the file calls offset is the constant part of the variable.
        let (d, theta) = match joint.kind {
            JointKind::Revolute => (Field::D, Field::Offset),
            JointKind::Prismatic => (Field::Offset, Field::Theta),
        };
        self.angle(at(Field::Alpha), &joint.alpha);
        self.angle(at(Field::Beta), &joint.beta);
        self.angle(at(theta), &joint.theta);
        self.size(at(Field::A), &joint.a);
        self.size(at(d), &joint.d);
        for value in &joint.com {
            self.size(at(Field::Com), value);
        }
        for value in joint.inertia.rows().iter().flatten() {
            self.size(at(Field::Inertia), value);
        }
        self.not_negative(at(Field::Mass), "mass", &joint.mass);
        self.not_negative(at(Field::Viscous), "viscous", &joint.viscous);
        self.coulomb(index, joint);
        self.not_negative(at(Field::Armature), "armature", &joint.armature);
        if let Some(frame) = &joint.frame {
            self.placement(at(Field::Frame), frame);
        }
        let limits = &joint.limits;
        for (field, limit) in [
            (Field::Velocity, &limits.velocity),
            (Field::Acceleration, &limits.acceleration),
            (Field::Torque, &limits.torque),
        ] {
            if let Some(limit) = limit {
                self.not_negative(at(field), field.key(), limit);
            }
        }
        if let Some(range) = &limits.position {
            self.range(at(Field::Position), joint.kind, range);
        }
        self.body(at(Field::Inertia), joint);
    }

    /// Checks the width of Coulomb friction: without one it would jump where a joint stands
    /// still, and have no slope there; the square of one is a number in f32, too.
    fn coulomb(&mut self, index: usize, joint: &Joint) {
        let at = |field| Place::Joint(index, field);
        let unit = match joint.kind {
            JointKind::Revolute => "rad/s",
            JointKind::Prismatic => "m/s",
        };
        let help = format!(
            "coulomb_width = 0.01, in {unit}: at this speed the friction is 1/√2 of `coulomb`, at \
             ten times as much less than 0.5 % below it"
        );
        self.not_negative(at(Field::Coulomb), "coulomb", &joint.coulomb);
        let width = &joint.coulomb_width;
        if width.is_negative() {
            let message = "coulomb_width is negative".to_owned();
            self.error(at(Field::CoulombWidth), message, &help);
        } else if width.is_zero() {
            if joint.coulomb.is_positive() {
                let message = "Coulomb friction without a `coulomb_width` above zero".to_owned();
                self.error(at(Field::CoulombWidth), message, &help);
            }
        } else if !WIDTHS.contains(&f64::nearest_rational(width)) {
            let message = "a coulomb_width too large or too small".to_owned();
            self.error(at(Field::CoulombWidth), message, &help);
        }
    }

    fn size(&mut self, place: Place, value: &Rational) {
        if !in_range(value) {
            self.error(
                place,
                "a number too large or too small".to_owned(),
                "zero, or a size from 1e-300 to 1e300",
            );
        }
    }

    fn angle(&mut self, place: Place, value: &Angle) {
        let (Angle::PiTimes(value) | Angle::Radians(value)) = value;
        self.size(place, value);
    }

    fn not_negative(&mut self, place: Place, what: &str, value: &Rational) {
        self.size(place, value);
        if value.is_negative() {
            let help = match what {
                "mass" => "a mass is zero or more, in kg",
                "viscous" => "damping takes energy out: zero or more",
                "coulomb" => "friction takes energy out: zero or more, in N·m or N",
                "armature" => "a rotor's inertia is zero or more",
                _ => "a limit bounds the size, in both directions: zero or more",
            };
            self.error(place, format!("{what} is negative"), help);
        }
    }

    fn range(&mut self, place: Place, kind: JointKind, range: &[Position; 2]) {
        for position in range {
            match position {
                Position::Angle(angle) => self.angle(place, angle),
                Position::Length(length) => self.size(place, length),
            }
        }
        let order = match (kind, range) {
            (JointKind::Revolute, [Position::Angle(low), Position::Angle(high)]) => {
                low.cmp_value(high)
            }
            (JointKind::Prismatic, [Position::Length(low), Position::Length(high)]) => {
                low.cmp(high)
            }
            _ => {
                self.error(
                    place,
                    "the limits are not of the joint's kind".to_owned(),
                    "angles for a revolute joint, lengths for a prismatic one",
                );
                return;
            }
        };
        if order != Ordering::Less {
            self.error(
                place,
                "the lowest position is not below the highest".to_owned(),
                "write [lowest, highest]",
            );
        }
    }

    fn body(&mut self, place: Place, joint: &Joint) {
        let Some(defect) = joint.inertia.defect(&joint.mass) else {
            return;
        };
        let help = match defect {
            Defect::NegativeMoment => {
                let help = "the order is Ixx, Iyy, Izz, Ixy, Iyz, Ixz about the centre of mass";
                return self.error(place, defect.message().to_owned(), help);
            }
            Defect::Triangle => {
                "expected for a link whose other moments were left out; taken as it stands"
            }
            Defect::Massless => "expected for a link whose mass was left out; taken as it stands",
        };
        // A missing mass that leaves the tensor a possible one is usual in
        // published tables, and so is a broken one: either way only a warning.
        let message = defect.message().to_owned();
        self.warn(RobotWarning::ImpossibleInertia, place, message, help);
    }
}

/// Words that cannot name a module, of all editions, reserved ones included.
const KEYWORDS: [&str; 54] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "union", "unsafe", "unsized", "use", "virtual", "where", "while", "yield", "core", "std",
];

fn is_snake(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

/// Returns the nearest name that a robot can have: `"UR-10 e"` gives `ur_10_e`; none
/// where there is no letter or digit.
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
        _ if KEYWORDS.contains(&better) => format!("{better}_robot"),
        _ => better.to_owned(),
    };
    (better.len() <= Robot::MAX_NAME).then_some(better)
}
