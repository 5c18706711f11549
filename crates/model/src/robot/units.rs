//! Sizes that no arm has in SI units: what was probably meant.
//!
//! They are taken as they stand. A crane is longer than ten metres and an excavator heavier than a
//! tonne, but a user who types millimetres or degrees learns of it here, not from the torques.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};

use num_traits::{Signed, Zero};

use super::findings::{Findings, of_joint};
use super::{Joint, JointKind, Limit, Placement, Position, RobotWarning};
use crate::number::parse::write_decimal;
use crate::number::{Angle, Rational, Rounded};

/// Longer links, in metres, were probably given in millimetres.
const MAX_LENGTH: i64 = 10;
/// Heavier links, in kilograms, were probably given in grams.
const MAX_MASS: i64 = 1000;
/// Limits of position beyond this many radians (five turns) were probably given in degrees.
const MAX_POSITION: i64 = 31;
/// Larger velocities, in rad/s or m/s, were probably given in degrees or millimetres.
const MAX_VELOCITY: i64 = 100;
/// From the Moon's gravity to Jupiter's, in m/s², with some room.
const GRAVITY: [f64; 2] = [1.5, 30.0];

pub(super) fn whole(value: i64) -> Rational {
    Rational::from_integer(value.into())
}

pub(crate) fn shown(value: &Rational) -> String {
    write_decimal(value).unwrap_or_else(|| value.to_string())
}

fn thousandth(value: &Rational) -> String {
    shown(&(value / whole(1000)))
}

fn degrees(value: &str) -> String {
    format!("angles are in rad: of degrees, write \"{value}deg\"")
}

impl Findings {
    fn warning(&mut self, warning: RobotWarning, place: &str, message: String, help: &str) {
        let help = format!("{help}; it is taken as it stands");
        self.warn(warning, place, message, &help);
    }

    pub(super) fn doubtful_gravity(&mut self, gravity: &[Rational; 3]) {
        let square: Rational = gravity.iter().map(|g| g * g).sum();
        let size = libm::sqrt(f64::nearest_rational(&square));
        // Without gravity: in space, or of an arm that moves in a horizontal plane.
        if square.is_zero() || (GRAVITY[0]..=GRAVITY[1]).contains(&size) {
            return;
        }
        let near = |unit: f64| (size / unit - 1.0).abs() < 0.03;
        let units = [
            (9810.0, "this looks like mm/s²"),
            (981.0, "this looks like cm/s²"),
            (32.17, "this looks like ft/s²"),
            (386.1, "this looks like in/s²"),
            (1.0, "this looks like a direction without its size"),
        ];
        let meant = units.iter().find(|(unit, _)| near(*unit));
        let meant = meant.map_or("gravity is in m/s²", |(_, meant)| *meant);
        let message =
            format!("the acceleration of gravity is {size:.4} m/s², far from the Earth's 9.81");
        let help = format!("{meant}: on the Earth it is [0, 0, -9.81] if z points up");
        self.warning(RobotWarning::UnusualGravity, "gravity", message, &help);
    }

    pub(super) fn upward_gravity(&mut self, [x, y, z]: &[Rational; 3]) {
        if !z.is_positive() || x.abs() > *z || y.abs() > *z {
            return;
        }
        let message = "gravity points upwards, along the base's z".to_owned();
        let help = "the acceleration of a falling body, [0, 0, -9.81] if z points up; of an arm \
                    that hangs, say base = { rpy = [\"pi\", 0, 0] }";
        self.warning(RobotWarning::UpwardGravity, "gravity", message, help);
    }

    pub(super) fn doubtful_placement(&mut self, place: &str, placement: &Placement) {
        if let Some(longest) = placement.xyz.iter().max_by_key(|x| x.abs()) {
            self.doubtful_length(place, "xyz", longest);
        }
        for angle in &placement.rpy {
            self.doubtful_angle(place, "rpy", angle);
        }
    }

    pub(super) fn doubtful_joint(&mut self, index: usize, joint: &Joint) {
        let at = |key| of_joint(index, key);
        let (d, theta) = match joint.kind {
            JointKind::Revolute => ("d", "offset"),
            JointKind::Prismatic => ("offset", "theta"),
        };
        self.doubtful_angle(&at("alpha"), "alpha", &joint.alpha);
        self.doubtful_angle(&at("beta"), "beta", &joint.beta);
        self.doubtful_angle(&at(theta), theta, &joint.theta);
        self.doubtful_length(&at("a"), "a", &joint.a);
        self.doubtful_length(&at(d), d, &joint.d);
        if let Some(longest) = joint.com.iter().max_by_key(|x| x.abs()) {
            self.doubtful_length(&at("com"), "com", longest);
        }
        if joint.mass >= whole(MAX_MASS) {
            let mass = &joint.mass;
            let message = format!("the link's mass is {} kg: a tonne or more", shown(mass));
            let help = format!("masses are in kg: of grams, write {}", thousandth(mass));
            self.warning(RobotWarning::LargeMass, &at("mass"), message, &help);
        }
        self.doubtful_limits(index, joint);
        self.doubtful_width(index, joint);
    }

    fn doubtful_width(&mut self, index: usize, joint: &Joint) {
        let width = &joint.coulomb_width;
        let Some(limit) = &joint.limits.velocity else {
            return;
        };
        if !joint.has_coulomb() || !limit.is_positive() || width < limit {
            return;
        }
        let unit = match joint.kind {
            JointKind::Revolute => "rad/s",
            JointKind::Prismatic => "m/s",
        };
        let (place, width, limit) = (of_joint(index, "coulomb_width"), shown(width), shown(limit));
        let message = format!(
            "the sign of Coulomb friction is smoothed over {width} {unit}, and the joint reaches \
             {limit}"
        );
        let help = "at such speeds it is a damping: take a tenth of the slowest speed that matters";
        self.warning(RobotWarning::LargeWidth, &place, message, help);
    }

    fn doubtful_limits(&mut self, index: usize, joint: &Joint) {
        let at = |key: &str| of_joint(index, &format!("limits/{key}"));
        for rate in [Limit::Velocity, Limit::Acceleration] {
            if joint.limits.rate(rate).is_some_and(Zero::is_zero) {
                let key = rate.key();
                let message = format!("the limit of {key} is 0: the joint never moves");
                let help =
                    "leave it out if it is not known; to hold a joint still, lock it in a scene";
                self.warning(RobotWarning::ZeroLimit, &at(key), message, help);
            }
        }
        for position in joint.limits.position.iter().flatten() {
            match position {
                Position::Angle(Angle::Radians(value)) if value.abs() > whole(MAX_POSITION) => {
                    let (place, value) = (at("position"), shown(value));
                    let message = format!("a limit of {value} rad is more than five turns");
                    self.warning(RobotWarning::LargeLimit, &place, message, &degrees(&value));
                    break;
                }
                Position::Length(value) if value.abs() > whole(MAX_LENGTH) => {
                    self.doubtful_length(&at("position"), "position", value);
                    break;
                }
                _ => {}
            }
        }
        let limit = joint.limits.velocity.as_ref();
        let Some(velocity) = limit.filter(|limit| **limit > whole(MAX_VELOCITY)) else {
            return;
        };
        let (unit, of, meant) = match joint.kind {
            JointKind::Revolute => {
                let radians = f64::nearest_rational(velocity) * core::f64::consts::PI / 180.0;
                ("rad/s", "degrees", format!("{radians:.4}"))
            }
            JointKind::Prismatic => ("m/s", "millimetres", thousandth(velocity)),
        };
        let help = format!("velocities are in {unit}: of {of} a second, write {meant}");
        let message = format!("a joint that reaches {} {unit} is fast", shown(velocity));
        self.warning(RobotWarning::LargeVelocity, &at("velocity"), message, &help);
    }

    fn doubtful_angle(&mut self, place: &str, what: &str, angle: &Angle) {
        // A value written as 5*pi/2 or "450deg" has an intended unit.
        let Angle::Radians(value) = angle else {
            return;
        };
        let size = Angle::Radians(value.abs());
        if size.cmp_value(&Angle::right_angles(4)).is_gt() {
            let value = shown(value);
            let message = format!("{what} is {value} rad: more than a turn");
            self.warning(RobotWarning::LargeAngle, place, message, &degrees(&value));
        }
    }

    fn doubtful_length(&mut self, place: &str, what: &str, length: &Rational) {
        if length.abs() > whole(MAX_LENGTH) {
            let (metres, less) = (shown(length), thousandth(length));
            let message = format!("{what} is {metres} m: longer than {MAX_LENGTH} m");
            let help = format!("lengths are in m: of millimetres, write {less}");
            self.warning(RobotWarning::LargeLength, place, message, &help);
        }
    }
}

/// Controls that turn the direction of text: a name with one of them reads otherwise than it is.
pub(super) fn turns_text(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

pub(super) fn without_turns(name: &str) -> String {
    let plain: String = name.chars().filter(|c| !turns_text(*c)).collect();
    match plain.is_empty() {
        true => "leave the name out if the joint has none".to_owned(),
        false => format!("write {plain:?}"),
    }
}
