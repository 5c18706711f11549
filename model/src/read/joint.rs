//! One `[[joint]]` table.

use alloc::format;
use alloc::string::ToString;
use core::ops::Range;

use num_traits::{One, Zero};
use toml_span::Value;

use super::places::Places;
use super::table::Keys;
use super::value::{Context, first_line};
use crate::number::{Angle, Rational};
use crate::placed::Placed;
use crate::robot::{Field, Inertia, Joint, JointKind, Limits, Place, Placement, Position};

/// The keys of a joint, in the order that robot files have them.
const KEYS: [&str; 20] = [
    "name",
    "kind",
    "alpha",
    "beta",
    "a",
    "d",
    "theta",
    "offset",
    "placement",
    "axis",
    "mass",
    "com",
    "inertia",
    "viscous",
    "coulomb",
    "coulomb_width",
    "armature",
    "frame",
    "limits",
    "mimic",
];
/// Those of a row of the DH table.
const ROW: [Field; 6] = [
    Field::Alpha,
    Field::Beta,
    Field::A,
    Field::D,
    Field::Theta,
    Field::Offset,
];
/// The keys of its limits.
const LIMITS: [&str; 4] = ["position", "velocity", "acceleration", "torque"];

/// Reads the fields of one joint in turn.
struct Fields<'r, 's, 'k, 'v, 'de> {
    cx: &'r mut Context<'s, 'k>,
    places: &'r mut Places,
    keys: &'r Keys<'v, 'de>,
    index: usize,
}

/// Reads joint `index`, counted from zero; what cannot be read is reported and
/// made up.
pub(super) fn read(
    cx: &mut Context,
    places: &mut Places,
    keys: &Keys,
    index: usize,
) -> (Joint, Option<Placed>) {
    keys.reject_unknown(&KEYS, cx.sink);
    let mut fields = Fields {
        cx,
        places,
        keys,
        index,
    };
    let name = keys.get("name").map(|value| {
        let text = fields.cx.string(value);
        fields.keep(Field::Name, value, text, Default::default)
    });
    let kind = fields.kind();
    let placed = fields.placed();
    let alpha = fields.angle(Field::Alpha);
    let beta = fields.angle(Field::Beta);
    let a = fields.number(Field::A);
    let (d, theta) = fields.variable(kind);
    let (mass, is_massless) = fields.mass();
    let com = fields.com(is_massless);
    let inertia = fields.inertia(is_massless);
    let joint = Joint {
        name,
        kind: kind.unwrap_or(JointKind::Revolute),
        alpha,
        beta,
        a,
        d,
        theta,
        mass,
        com,
        inertia,
        viscous: fields.number(Field::Viscous),
        coulomb: fields.number(Field::Coulomb),
        coulomb_width: fields.coulomb_width(),
        armature: fields.number(Field::Armature),
        frame: fields.frame(),
        limits: fields.limits(kind),
    };
    (joint, placed)
}

impl Fields<'_, '_, '_, '_, '_> {
    fn keep<T>(
        &mut self,
        field: Field,
        value: &Value,
        read: Option<T>,
        or: impl FnOnce() -> T,
    ) -> T {
        let span = first_line(self.cx.source, Context::span(value));
        self.keep_at(field, span, read, or)
    }

    fn keep_at<T>(
        &mut self,
        field: Field,
        span: Range<usize>,
        read: Option<T>,
        or: impl FnOnce() -> T,
    ) -> T {
        let place = Place::Joint(self.index, field);
        self.places.keep(place, span, read, or)
    }

    /// Returns where the link is, if that is given instead of a row.
    fn placed(&mut self) -> Option<Placed> {
        const AXIS: &str = "axis = [0, 0, 1]: the joint's axis in the axes of its link's frame";
        let given = self.keys.get("placement").or(self.keys.get("axis"))?;
        let span = first_line(self.cx.source, Context::span(given));
        let row = ROW
            .iter()
            .find(|field| self.keys.get(field.key()).is_some());
        if let (None, Some(row)) = (self.keys.get("placement"), row) {
            let message = format!("`axis` beside `{}`, and no `placement`", row.key());
            let help = "an axis belongs to a joint that is placed; in a DH table joints act along \
                        z: leave `axis` out";
            self.cx.sink.error(Context::span(given), message, help);
            return None;
        }
        for field in ROW {
            if let Some(value) = self.keys.get(field.key()) {
                let message = format!("`{}` of a joint that is placed", field.key());
                let help = "a placement takes the place of the DH row: leave the one or the other";
                self.cx.sink.error(Context::span(value), message, help);
            }
            // What is odd about the row is so because of the placement.
            self.keep_at(field, span.clone(), Some(()), || ());
        }
        let placement = match self.keys.get("placement") {
            None => Some(Placement::default()),
            Some(value) => self.cx.placement(value, "placement"),
        };
        let axis = self.keys.require("axis", AXIS, self.cx.sink);
        let axis = axis.and_then(|value| {
            let read = self.cx.array(value, AXIS, Context::number)?;
            if read.iter().all(Zero::is_zero) {
                let span = first_line(self.cx.source, Context::span(value));
                let message = "an axis of length zero has no direction".to_string();
                self.cx.sink.error(span, message, AXIS);
                return None;
            }
            Some(read)
        });
        // Without one of them nothing is said of what would follow.
        let read = placement.zip(axis);
        let (placement, axis) = self.keep_at(Field::Placement, span, read, || {
            let axis = [0, 0, 1].map(|x: i64| Rational::from_integer(x.into()));
            (Placement::default(), axis)
        });
        Some(Placed { placement, axis })
    }

    fn kind(&mut self) -> Option<JointKind> {
        let help = "kind = \"revolute\" or \"prismatic\"";
        let value = self.keys.require("kind", help, self.cx.sink)?;
        self.cx.word(value, &JointKind::WORDS)
    }

    /// Reads the link's own frame, in that of its row or of its placement.
    fn frame(&mut self) -> Option<Placement> {
        let value = self.keys.get(Field::Frame.key())?;
        let read = self.cx.placement(value, Field::Frame.key());
        self.keep(Field::Frame, value, read, Placement::default)
            .unless_identity()
    }

    /// Reads a number that is zero unless given.
    fn number(&mut self, field: Field) -> Rational {
        let Some(value) = self.keys.get(field.key()) else {
            return Rational::zero();
        };
        let read = self.cx.number(value);
        self.keep(field, value, read, Rational::zero)
    }

    /// Reads the width of Coulomb friction; of one that cannot be read nothing is said
    /// but that, and one that is missing is missing where the friction stands.
    fn coulomb_width(&mut self) -> Rational {
        let field = Field::CoulombWidth;
        let Some(value) = self.keys.get(field.key()) else {
            let coulomb = self.keys.get(Field::Coulomb.key());
            let span = coulomb.map_or(self.keys.span.clone(), Context::span);
            return self.keep_at(field, span, Some(Rational::zero()), Rational::zero);
        };
        let read = self.cx.number(value);
        self.keep(field, value, read, Rational::one)
    }

    /// Reads an angle that is zero unless given.
    fn angle(&mut self, field: Field) -> Angle {
        let Some(value) = self.keys.get(field.key()) else {
            return Angle::default();
        };
        let read = self.cx.angle(value);
        self.keep(field, value, read, Angle::default)
    }

    /// Reads the constant parts of d and theta: one of them belongs to the joint's
    /// variable, and is called `offset`.
    fn variable(&mut self, kind: Option<JointKind>) -> (Rational, Angle) {
        match kind {
            Some(JointKind::Revolute) => {
                let theta = self.angle(Field::Theta);
                self.no_variable(Field::Theta, theta.is_zero(), "revolute");
                (self.number(Field::D), self.angle(Field::Offset))
            }
            Some(JointKind::Prismatic) => {
                let d = self.number(Field::D);
                self.no_variable(Field::D, d.is_zero(), "prismatic");
                (self.number(Field::Offset), self.angle(Field::Theta))
            }
            // Without a kind there is no saying what the offset is.
            None => (self.number(Field::D), self.angle(Field::Theta)),
        }
    }

    fn no_variable(&mut self, field: Field, zero: bool, kind: &str) {
        let key = field.key();
        if let (false, Some(value)) = (zero, self.keys.get(key)) {
            let message = format!("`{key}` of a {kind} joint is its variable, so it must be 0");
            let help = "a constant that is added to it is called `offset`";
            self.cx.sink.error(Context::span(value), message, help);
        }
    }

    /// Reads the mass, and whether the file says that there is none.
    fn mass(&mut self) -> (Rational, bool) {
        let help = "mass = 4.8, in kg; a link without mass has mass = 0";
        let value = self.keys.require("mass", help, self.cx.sink);
        let read = value.and_then(|value| self.cx.number(value));
        let is_massless = read.as_ref().is_some_and(Zero::is_zero);
        let span = value.map_or(self.keys.span.clone(), Context::span);
        let mass = self.keep_at(Field::Mass, span, read, Rational::zero);
        (mass, is_massless)
    }

    /// Reads the centre of mass; what has no mass has none.
    fn com(&mut self, is_massless: bool) -> [Rational; 3] {
        let zeros = || [(); 3].map(|()| Rational::zero());
        const COM: &str = "com = [x, y, z]: the centre of mass in the link frame, in m; only a link with mass = 0 may leave it out";
        let value = match self.keys.get("com") {
            None if is_massless => return zeros(),
            _ => self.keys.require("com", COM, self.cx.sink),
        };
        let read = value.and_then(|value| self.cx.array(value, COM, Context::number));
        match value {
            Some(value) => self.keep(Field::Com, value, read, zeros),
            None => zeros(),
        }
    }

    /// Reads the inertia; what has no mass has none unless the file says so.
    fn inertia(&mut self, is_massless: bool) -> Inertia<Rational> {
        const HELP: &str = "inertia = [Ixx, Iyy, Izz, Ixy, Iyz, Ixz] about the centre of mass, in kg·m²; only a link with mass = 0 may leave it out";
        let value = match self.keys.get("inertia") {
            None if is_massless => None,
            _ => self.keys.require("inertia", HELP, self.cx.sink),
        };
        let Some(value) = value else {
            return Inertia::default();
        };
        let read = self.cx.inertia(value);
        self.keep(Field::Inertia, value, read, Inertia::default)
    }

    fn limits(&mut self, kind: Option<JointKind>) -> Limits {
        let Some(value) = self.keys.get("limits") else {
            return Limits::default();
        };
        let help =
            "limits = { position = [-2.8, 2.8], velocity = 8, acceleration = 20, torque = 97.6 }";
        let Some(table) = self.cx.table(value, help) else {
            return Limits::default();
        };
        let keys = Keys {
            table,
            span: first_line(self.cx.source, Context::span(value)),
            what: "limits".to_string(),
        };
        keys.reject_unknown(&LIMITS, self.cx.sink);
        let mut inner = Fields {
            cx: self.cx,
            places: self.places,
            keys: &keys,
            index: self.index,
        };
        Limits {
            position: inner.position(kind),
            velocity: inner.rate(Field::Velocity, kind),
            acceleration: inner.rate(Field::Acceleration, kind),
            torque: inner.limit(Field::Torque),
        }
    }

    /// Reads a limit of velocity or acceleration: of a joint that turns in radians, as a
    /// number.
    fn rate(&mut self, field: Field, kind: Option<JointKind>) -> Option<Rational> {
        let value = self.keys.get(field.key())?;
        let read = match kind {
            Some(JointKind::Revolute) => self.cx.rate(value, field.key()),
            _ => self.cx.number(value),
        };
        Some(self.keep(field, value, read, Rational::zero))
    }

    fn limit(&mut self, field: Field) -> Option<Rational> {
        self.keys.get(field.key())?;
        Some(self.number(field))
    }

    fn position(&mut self, kind: Option<JointKind>) -> Option<[Position; 2]> {
        let value = self.keys.get("position")?;
        let help = "position = [lowest, highest], or leave it out";
        let read = match kind? {
            JointKind::Revolute => self
                .cx
                .array(value, help, |cx, item| cx.angle(item).map(Position::Angle)),
            JointKind::Prismatic => self.cx.array(value, help, |cx, item| {
                cx.length(item).map(Position::Length)
            }),
        };
        let read = read?;
        Some(self.keep(Field::Position, value, Some(read.clone()), || read))
    }
}
