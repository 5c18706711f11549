//! Numbers that were meant to be others.

use std::fmt;
use std::ops::Range;

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Position;
use num_traits::{One, Signed, Zero};

use crate::tree::Chain;
use crate::urdf::{Number, Origin, Urdf, Value};

/// A number that was taken for another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snap {
    /// Where it is in the URDF, in bytes.
    pub span: Range<usize>,
    /// What it is of: `joint elbow, rpy`.
    pub of: String,
    /// As it stands there.
    pub from: String,
    /// What it was taken for, as a robot file has it.
    pub to: String,
}

impl Snap {
    /// The line of the URDF, from one.
    pub fn line(&self, source: &str) -> usize {
        crate::problems::place(source, self.span.start).0
    }
}

impl fmt::Display for Snap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} is taken for {}", self.of, self.from, self.to)
    }
}

/// Lengths, in metres, and angles next to multiples of π/2, in radians, that are
/// nothing; the same of axes' components and, relatively, of products of inertia.
const NOTHING: i32 = -9;
/// Angles next to multiples of π/4 and π/6, in radians.
const NEXT_TO: i32 = -12;
/// However few digits a number has: so far, in radians, it may be off.
const MAX: i32 = -5;
/// The digits that tell π/6 from a number that happens to be near it.
const TELLING: usize = 5;

/// The URDF with every number of the chain taken for what it was meant to be.
pub(crate) fn snapped(urdf: &Urdf, chain: &Chain) -> (Urdf, Vec<Snap>) {
    let mut urdf = urdf.clone();
    let mut snaps = Snaps(Vec::new());
    for joint in chain.joints() {
        let joint = &mut urdf.joints[joint];
        let of = |what: &str| format!("joint {}, {what}", joint.name);
        snaps.origin(&mut joint.origin, &of("xyz"), &of("rpy"));
        for component in &mut joint.axis {
            snaps.component(component, &of("axis"));
        }
        for limit in joint.position.iter_mut().flatten() {
            snaps.limit(limit, &of("limit"));
        }
    }
    for link in chain.links() {
        let link = &mut urdf.links[link];
        let Some(inertial) = &mut link.inertial else {
            continue;
        };
        let of = |what: &str| format!("link {}, {what}", link.name);
        snaps.origin(
            &mut inertial.origin,
            &of("centre of mass"),
            &of("axes of inertia"),
        );
        let tensor = &mut inertial.inertia;
        let moments = [&tensor.xx, &tensor.yy, &tensor.zz];
        let moments = moments.map(|moment| moment.value.abs());
        let largest = moments.into_iter().max().unwrap_or_else(Rational::zero);
        for product in [&mut tensor.xy, &mut tensor.yz, &mut tensor.xz] {
            snaps.length(product, &(&largest * power(NOTHING)), &of("inertia"));
        }
    }
    snaps.0.sort_by_key(|snap| snap.span.start);
    (urdf, snaps.0)
}

/// Collects them.
struct Snaps(Vec<Snap>);

impl Snaps {
    fn take<T>(&mut self, value: &mut Value<T>, meant: T, to: String, of: &str) {
        self.0.push(Snap {
            span: value.span.clone(),
            of: of.to_owned(),
            from: value.text.clone(),
            to,
        });
        value.value = meant;
    }

    fn origin(&mut self, origin: &mut Origin, xyz: &str, rpy: &str) {
        for length in &mut origin.xyz {
            self.length(length, &power(NOTHING), xyz);
        }
        for angle in &mut origin.rpy {
            if let Some(meant) = meant(&angle.value, &angle.text) {
                let to = meant.to_string();
                self.take(angle, meant, to, rpy);
            }
        }
    }

    /// Nothing, where it is less than this.
    fn length(&mut self, length: &mut Number, least: &Rational, of: &str) {
        if !length.value.is_zero() && length.value.abs() < *least {
            self.take(length, Rational::zero(), "0".to_owned(), of);
        }
    }

    fn component(&mut self, component: &mut Number, of: &str) {
        let whole = component.value.round();
        let off = (&component.value - &whole).abs();
        if !off.is_zero() && off < power(NOTHING) && whole.abs() <= Rational::one() {
            let to = whole.to_string();
            self.take(component, whole, to, of);
        }
    }

    fn limit(&mut self, limit: &mut Value<Position>, of: &str) {
        let Position::Angle(angle) = &limit.value else {
            return;
        };
        if let Some(meant) = meant(angle, &limit.text) {
            let to = meant.to_string();
            self.take(limit, Position::Angle(meant), to, of);
        }
    }
}

/// The multiple of π/2, π/4 or π/6 that an angle was meant to be.
fn meant(angle: &Angle, text: &str) -> Option<Angle> {
    let Angle::Radians(value) = angle else {
        return None;
    };
    if value.is_zero() {
        return None;
    }
    let (unit, digits) = digits(text);
    let loose = unit.min(power(MAX));
    let pi = Angle::PiTimes(Rational::one()).radians();
    [
        (2, NOTHING, 1),
        (4, NEXT_TO, TELLING),
        (6, NEXT_TO, TELLING),
    ]
    .into_iter()
    .find_map(|(parts, close, telling)| {
        let part = &pi / Rational::from_integer(parts.into());
        let n = (value / &part).round();
        let off = (value - &n * &part).abs();
        // Nothing has no digits that could tell how near it was meant.
        let by_digits = !n.is_zero() && digits >= telling && off <= loose;
        let taken = off <= power(close) || by_digits;
        taken.then(|| Angle::PiTimes(n / Rational::from_integer(parts.into())))
    })
}

/// One unit of the last digit of a decimal, and how many digits it has.
fn digits(text: &str) -> (Rational, usize) {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse().unwrap_or(0)),
        None => (text, 0),
    };
    let after = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let all = mantissa.chars().filter(char::is_ascii_digit);
    let digits = all.skip_while(|digit| *digit == '0').count();
    let exponent: i32 = exponent;
    let unit = exponent.saturating_sub(i32::try_from(after).unwrap_or(i32::MAX));
    // Of a number that could be read; its size is what bounds it.
    (power(unit.clamp(-1000, 1000)), digits)
}

fn power(exponent: i32) -> Rational {
    Rational::from_integer(10.into()).pow(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::number::parse::parse_decimal;

    fn taken(text: &str) -> Option<String> {
        let value = parse_decimal(text).expect("a number");
        meant(&Angle::Radians(value), text).map(|angle| angle.to_string())
    }

    /// The rules of the crate's documentation, on both sides of each.
    #[test]
    fn angles() {
        for (text, expected) in [
            ("1.57079632679", Some("pi/2")),
            ("-1.5708", Some("-pi/2")),
            ("1.5707", None),
            ("1.57", None),
            ("3.14159", Some("pi")),
            ("6.28318530718", Some("2*pi")),
            ("1.570796326794897", Some("pi/2")),
            ("1.5707963267948963", Some("pi/2")),
            ("1.5707964", Some("pi/2")),
            ("1.57079700000", None),
            ("1.5708000", None),
            ("7.7e-34", Some("0")),
            ("-9e-10", Some("0")),
            ("2e-9", None),
            ("1e-5", None),
            ("0", None),
            ("0.78539816339", Some("pi/4")),
            ("0.5236", None),
            ("0.52360", Some("pi/6")),
            ("1.04719755", Some("pi/3")),
            ("-0.785398", Some("-pi/4")),
            ("0.785", None),
            ("0.7853981", Some("pi/4")),
            ("0.7853", None),
        ] {
            assert_eq!(taken(text).as_deref(), expected, "{text}");
        }
    }

    #[test]
    fn digits_and_their_unit() {
        let one = |exponent| power(exponent);
        for (text, unit, count) in [
            ("1.5708", one(-4), 5),
            ("-0.0120", one(-4), 3),
            ("1e-3", one(-3), 1),
            ("12", one(0), 2),
            ("1.50E+2", one(0), 3),
        ] {
            assert_eq!(digits(text), (unit, count), "{text}");
        }
    }
}
