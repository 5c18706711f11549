//! Numbers that were meant to be others.

use std::fmt;
use std::ops::Range;

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Position;
use num_traits::{One, Signed, Zero};

use crate::meant::{NOTHING, meant, power};
use crate::model::{Model, Number, Origin, Value};
use crate::select::Selection;

/// The most that a unit of the sixteenth digit is, relative to a number: 10 to this power.
const DIGITS: i32 = -15;

/// A number that was taken for another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snap {
    /// The place in the text, in bytes.
    pub span: Range<usize>,
    /// The element and the attribute: `joint elbow, rpy`.
    pub of: String,
    /// As it stands there.
    pub from: String,
    /// The number that it was taken for, as a robot file has it.
    pub to: String,
    /// True if the arm changes: not by a limit, nor by a number that is right to 16 digits.
    pub changes: bool,
}

impl Snap {
    /// Returns a line that counts those that change nothing; `None` if there are none.
    pub fn counted(snaps: &[Snap]) -> Option<String> {
        let mut same = snaps.iter().filter(|snap| !snap.changes);
        let Snap { from, to, .. } = same.next()?;
        Some(match 1 + same.count() {
            1 => format!(
                "1 number, a limit or right to 16 digits, is written exactly: {from} as {to}"
            ),
            count => format!(
                "{count} numbers, limits or right to 16 digits, are written exactly, such as {from} as {to}"
            ),
        })
    }
}

impl fmt::Display for Snap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} is taken for {}", self.of, self.from, self.to)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reach {
    All,
    /// Those within 1e-9 of what was meant.
    Near,
    None,
}

pub(crate) fn snapped(model: &Model, selection: &Selection, reach: Reach) -> (Model, Vec<Snap>) {
    let mut model = model.clone();
    let mut snaps = Snaps {
        is_near: reach == Reach::Near,
        taken: Vec::new(),
    };
    if reach == Reach::None {
        return (model, snaps.taken);
    }
    for joint in &selection.order {
        let joint = &mut model.joints[*joint];
        let of = |what: &str| format!("joint {}, {what}", joint.name);
        snaps.origin(&mut joint.origin, &of("xyz"), &of("rpy"));
        for component in &mut joint.axis {
            snaps.component(component, &of("axis"));
        }
        for limit in joint.position.iter_mut().flatten() {
            snaps.limit(limit, &of("limit"));
        }
    }
    for &link in &selection.links {
        let link = &mut model.links[link];
        let Some(inertial) = &mut link.inertial else {
            continue;
        };
        let of = |what: &str| format!("link {}, {what}", link.name);
        let [centre, axes] = ["centre of mass", "axes of inertia"].map(of);
        snaps.origin(&mut inertial.origin, &centre, &axes);
        let tensor = &mut inertial.inertia;
        let moments = [&tensor.xx, &tensor.yy, &tensor.zz].map(|moment| moment.value.abs());
        let largest = moments.into_iter().max().unwrap_or_else(Rational::zero);
        for product in [&mut tensor.xy, &mut tensor.yz, &mut tensor.xz] {
            snaps.length(product, &(&largest * power(NOTHING)), &of("inertia"));
        }
    }
    snaps.taken.sort_by_key(|snap| snap.span.start);
    (model, snaps.taken)
}

#[derive(Default)]
struct Snaps {
    is_near: bool,
    taken: Vec<Snap>,
}

impl Snaps {
    fn meant(&self, angle: &Angle, text: &str) -> Option<Angle> {
        let off = |meant: &Angle| (angle.radians() - meant.radians()).abs();
        meant(angle, text).filter(|meant| !self.is_near || off(meant) <= power(NOTHING))
    }

    fn take<T>(&mut self, value: &mut Value<T>, meant: T, to: String, of: &str, changes: bool) {
        self.taken.push(Snap {
            span: value.at.clone(),
            of: of.to_owned(),
            from: value.text.clone(),
            to,
            changes,
        });
        value.value = meant;
    }

    fn origin(&mut self, origin: &mut Origin, xyz: &str, rpy: &str) {
        for length in &mut origin.xyz {
            self.length(length, &power(NOTHING), xyz);
        }
        if let Some(meant) = origin.meant.take().filter(|_| !self.is_near) {
            let to = meant.rpy.each_ref().map(ToString::to_string).join(" ");
            let from = origin.rpy.each_ref().map(|angle| angle.text.as_str());
            self.taken.push(Snap {
                span: origin.rpy[0].at.clone(),
                of: rpy.to_owned(),
                from: from.join(" "),
                to,
                changes: true,
            });
            for (angle, meant) in origin.rpy.iter_mut().zip(meant.rpy) {
                angle.value = meant;
            }
            // A rotation also moves the parts, so use the position that goes with it.
            for (length, meant) in origin.xyz.iter_mut().zip(meant.xyz) {
                length.value = meant;
                self.length(length, &power(NOTHING), xyz);
            }
            return;
        }
        let mut off = Rational::zero();
        for angle in &mut origin.rpy {
            if let Some(meant) = self.meant(&angle.value, &angle.text) {
                let error = (angle.value.radians() - meant.radians()).abs();
                let changes = &error / power(DIGITS) > meant.radians().abs();
                off = off.max(error);
                let to = meant.to_string();
                self.take(angle, meant, to, rpy, changes);
            }
        }
        // Smaller angles are below this error.
        for angle in &mut origin.rpy {
            let radians = angle.value.radians().abs();
            if !radians.is_zero() && radians <= off {
                self.take(angle, Angle::default(), "0".to_owned(), rpy, true);
            }
        }
    }

    fn length(&mut self, length: &mut Number, least: &Rational, of: &str) {
        if !length.value.is_zero() && length.value.abs() < *least {
            self.take(length, Rational::zero(), "0".to_owned(), of, true);
        }
    }

    fn component(&mut self, component: &mut Number, of: &str) {
        let whole = component.value.round();
        let off = (&component.value - &whole).abs();
        if !off.is_zero() && off < power(NOTHING) && whole.abs() <= Rational::one() {
            let to = whole.to_string();
            self.take(component, whole, to, of, true);
        }
    }

    fn limit(&mut self, limit: &mut Value<Position>, of: &str) {
        if let Position::Angle(angle) = &limit.value
            && let Some(meant) = self.meant(angle, &limit.text)
        {
            let to = meant.to_string();
            self.take(limit, Position::Angle(meant), to, of, false);
        }
    }
}

#[cfg(test)]
mod tests {
    use dalembert_model::number::parse::parse_decimal;

    use super::*;

    fn taken(rpy: [&str; 3]) -> [String; 3] {
        let number = |text: &str| Angle::Radians(parse_decimal(text).expect("a number"));
        let mut origin = Origin {
            rpy: rpy.map(|text| Value::new(number(text), text, &(0..0))),
            ..Origin::default()
        };
        Snaps::default().origin(&mut origin, "xyz", "rpy");
        origin.rpy.map(|angle| angle.value.to_string())
    }

    #[test]
    fn an_angle_is_nothing_beside_one_that_is_rounded_by_more() {
        let first = |rpy| taken(rpy)[1].clone();
        assert_eq!(first(["1.5708", "-5.24284e-08", "0"]), "0");
        // 3.7e-6 is what 1.5708 is off by.
        assert_eq!(first(["1.5708", "3.7e-06", "0"]), "3.7e-6");
        assert_eq!(first(["1.5707963", "-5.24284e-08", "0"]), "-5.24284e-8");
        assert_eq!(first(["0.3", "-5.24284e-08", "0"]), "-5.24284e-8");
    }
}
