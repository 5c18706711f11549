//! The angle that digits were meant to be.

use dalembert_model::number::{Angle, Rational};
use num_traits::{One, Signed, Zero};

/// Lengths, in metres, and angles next to multiples of π/2, in radians, that are
/// nothing; the same of axes' components and, relatively, of products of inertia.
pub(crate) const NOTHING: i32 = -9;
/// Angles next to multiples of π/4 and π/6, in radians.
const NEXT_TO: i32 = -12;
/// The largest error of a rounded angle, rad, for any number of digits.
pub(crate) const MAX: i32 = -5;
/// The digits that tell π/6 from a number that happens to be near it.
pub(crate) const TELLING: usize = 5;

pub(crate) fn meant(angle: &Angle, text: &str) -> Option<Angle> {
    let Angle::Radians(value) = angle else {
        return None;
    };
    let (unit, digits) = digits(text);
    within(value, unit, digits)
}

/// Returns the multiple of π/2, π/4 or π/6 that an angle known up to `unit` was meant to be.
pub(crate) fn within(value: &Rational, unit: Rational, digits: usize) -> Option<Angle> {
    if value.is_zero() {
        return None;
    }
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
        // Zero has no digits that show how precisely it was meant.
        let by_digits = !n.is_zero() && digits >= telling && off <= loose;
        let taken = off <= power(close) || by_digits;
        taken.then(|| Angle::PiTimes(n / Rational::from_integer(parts.into())))
    })
}

/// Returns one unit of the last digit of a decimal, and how many digits it has.
pub(crate) fn digits(text: &str) -> (Rational, usize) {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse().unwrap_or(0)),
        None => (text, 0),
    };
    let after = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let numerals = mantissa.chars().filter(char::is_ascii_digit);
    let count = numerals.skip_while(|digit| *digit == '0').count();
    let exponent: i32 = exponent;
    let unit = exponent.saturating_sub(i32::try_from(after).unwrap_or(i32::MAX));
    // Limits the exponent, so that the power stays small.
    (power(unit.clamp(-1000, 1000)), count)
}

pub(crate) fn power(exponent: i32) -> Rational {
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
        for (text, exponent, count) in [
            ("1.5708", -4, 5),
            ("-0.0120", -4, 3),
            ("1e-3", -3, 1),
            ("12", 0, 2),
            ("1.50E+2", 0, 3),
        ] {
            assert_eq!(digits(text), (power(exponent), count), "{text}");
        }
    }
}
