//! Angles, kept exact.

use core::cmp::Ordering;
use core::fmt;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::parse::{self, NumberError};
use super::rationals::compare;
use super::recover::short;
use super::{Rational, Wide, ratio, trig};
use crate::scalar::SinCosPair;

/// An angle as the robot file gives it.
///
/// Its order is that of the form, for use as a map key; [`Angle::cmp_value`] compares sizes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Angle {
    /// A rational multiple of π: `"pi/2"` is ½, `"90deg"` is ½ as well.
    PiTimes(Rational),
    /// A rational number of radians.
    Radians(Rational),
    /// 2 atan t, whose sine 2t/(1 + t²) and cosine (1 − t²)/(1 + t²) are rational: `"2*atan(1/3)"`.
    TwiceAtan(Rational),
}

impl Ord for Angle {
    fn cmp(&self, other: &Self) -> Ordering {
        let form = |angle: &Angle| match angle {
            Angle::PiTimes(_) => 0,
            Angle::Radians(_) => 1,
            Angle::TwiceAtan(_) => 2,
        };
        let forms = form(self).cmp(&form(other));
        forms.then_with(|| compare(self.number(), other.number()))
    }
}

impl PartialOrd for Angle {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Default for Angle {
    fn default() -> Self {
        Angle::PiTimes(Rational::zero())
    }
}

impl Angle {
    /// Returns `n`·π/2, exactly.
    pub fn right_angles(n: i64) -> Self {
        Angle::PiTimes(ratio(n, 2))
    }

    /// Returns the number that its form has: the multiple of π, the radians, the tangent.
    pub fn number(&self) -> &Rational {
        match self {
            Angle::PiTimes(value) | Angle::Radians(value) | Angle::TwiceAtan(value) => value,
        }
    }

    /// True for π/4, whose sine and cosine are both √½.
    pub fn is_eighth(&self) -> bool {
        matches!(self, Angle::PiTimes(x) if x.numer().is_one() && x.denom().to_u8() == Some(4))
    }

    /// True for zero, in any form.
    pub fn is_zero(&self) -> bool {
        self.number().is_zero()
    }

    /// Returns the angle in the form that compares equal whenever the value does: zero radians
    /// become zero times π, and 2 atan 1 becomes π/2. (No other values have two forms.)
    #[must_use]
    pub fn canonical(self) -> Self {
        match self {
            Angle::TwiceAtan(tangent) if tangent.abs().is_one() => {
                Angle::PiTimes(tangent * ratio(1, 2))
            }
            angle if angle.is_zero() => Angle::default(),
            angle => angle,
        }
    }

    /// Returns the angle with rational sine and cosine that is within 2⁻⁵² rad of this one, the
    /// tangent of its half a fraction of some 27 bits; a multiple of π/2 as it is.
    #[must_use]
    pub fn on_the_circle(&self) -> Self {
        if self.quarter_turns().is_some() || matches!(self, Angle::TwiceAtan(_)) {
            return self.clone();
        }
        let SinCosPair { sin, cos } = Wide::sincos(self);
        let [sin, cos] = [sin, cos].map(|part| part.to_rational());
        let tangent = short(&(sin / (Rational::one() + cos.abs())), 53);
        let tangent_of_half = match cos.is_negative() {
            // The tangent is that of what is missing to half a turn, at most one.
            true if tangent.is_zero() => return Angle::right_angles(2),
            true => tangent.recip(),
            false => tangent,
        };
        Angle::TwiceAtan(tangent_of_half).canonical()
    }

    /// Returns the opposite angle.
    #[must_use]
    pub fn negate(&self) -> Self {
        match self {
            Angle::PiTimes(value) => Angle::PiTimes(-value),
            Angle::Radians(value) => Angle::Radians(-value),
            Angle::TwiceAtan(value) => Angle::TwiceAtan(-value),
        }
    }

    /// Returns n mod 4 if the angle is exactly n·π/2, so that its sine and cosine are 0, 1 or −1.
    pub fn quarter_turns(&self) -> Option<u8> {
        match self {
            Angle::PiTimes(value) => {
                let quarters = Some(value * ratio(2, 1)).filter(Rational::is_integer)?;
                quarters.to_integer().mod_floor(&4.into()).to_u8()
            }
            Angle::Radians(value) | Angle::TwiceAtan(value) => value.is_zero().then_some(0),
        }
    }

    /// Returns its value in radians to 400 bits; exact for [`Angle::Radians`].
    pub fn radians(&self) -> Rational {
        match self {
            Angle::PiTimes(value) => value * pi(),
            Angle::Radians(value) => value.clone(),
            Angle::TwiceAtan(value) => {
                Rational::new(trig::twice_atan(value, BITS), BigInt::one() << BITS)
            }
        }
    }

    /// Returns the nearest double.
    pub fn to_f64(&self) -> f64 {
        self.radians().to_f64().unwrap_or(f64::NAN)
    }

    /// Compares the two values, whatever their forms.
    pub fn cmp_value(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Angle::PiTimes(left), Angle::PiTimes(right)) => left.cmp(right),
            _ => self.radians().cmp(&other.radians()),
        }
    }

    /// Reads a text: `"[-][k*]pi[/m]"`, `"90deg"`, `"[-]2*atan(p/q)"`, or radians, `"1/3"`.
    ///
    /// # Errors
    /// [`NumberError`] if it is none of them.
    pub fn parse(text: &str) -> Result<Self, NumberError> {
        let text = text.trim();
        if text.len() > 2 * parse::MAX_LITERAL {
            return Err(NumberError::TooLong);
        }
        if let Some(degrees) = text.strip_suffix("deg") {
            let degrees = parse::parse_decimal(degrees.trim_end())?;
            return Ok(Angle::PiTimes(degrees * ratio(1, 180)));
        }
        if let Some((before, tangent)) = text.split_once("atan(") {
            let (negative, before) = parse::split_sign(before);
            let inner = tangent.strip_suffix(')').filter(|_| before.trim() == "2*");
            let tangent = match inner.ok_or(NumberError::Malformed)?.trim() {
                fraction if fraction.contains('/') => parse::parse_fraction(fraction)?,
                decimal => parse::parse_decimal(decimal)?,
            };
            let angle = Angle::TwiceAtan(if negative { -tangent } else { tangent });
            return Ok(angle.canonical());
        }
        if !text.contains("pi") {
            return parse::parse_fraction(text).map(|value| Angle::Radians(value).canonical());
        }
        let (negative, rest) = parse::split_sign(text);
        let (factor, rest) = match rest.trim_start().split_once('*') {
            Some((factor, rest)) => {
                // A second sign, as in "--2*pi", is a slip of the pen.
                if factor.starts_with(['-', '+']) {
                    return Err(NumberError::Malformed);
                }
                (parse::parse_decimal(factor.trim_end())?, rest.trim_start())
            }
            None => (Rational::one(), rest.trim_start()),
        };
        let rest = rest.strip_prefix("pi").ok_or(NumberError::Malformed)?;
        let divisor = match rest.trim_start().strip_prefix('/') {
            Some(divisor) => parse::parse_integer(divisor.trim_start())?,
            None if rest.is_empty() => BigInt::one(),
            None => return Err(NumberError::Malformed),
        };
        if divisor.is_zero() {
            return Err(NumberError::ZeroDenominator);
        }
        let value = parse::checked(factor / Rational::from_integer(divisor))?;
        Ok(Angle::PiTimes(if negative { -value } else { value }))
    }
}

/// As the robot file writes it: `pi/2`, `-3*pi/4`, `0.3`, `1/3`, `2*atan(-1/3)`.
impl fmt::Display for Angle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            _ if self.is_zero() => f.write_str("0"),
            Angle::PiTimes(value) => {
                if value.is_negative() {
                    f.write_str("-")?;
                }
                let factor = value.numer().abs();
                if !factor.is_one() {
                    write!(f, "{factor}*")?;
                }
                f.write_str("pi")?;
                if !value.denom().is_one() {
                    write!(f, "/{}", value.denom())?;
                }
                Ok(())
            }
            Angle::Radians(value) => match parse::write_decimal(value) {
                Some(text) => f.write_str(&text),
                None => write!(f, "{value}"),
            },
            Angle::TwiceAtan(value) => write!(f, "2*atan({value})"),
        }
    }
}

/// The reading of an angle.
#[derive(Clone, Debug, PartialEq)]
pub enum SnappedAngle {
    /// It stays as written, far from any right angle, or is exactly zero.
    Kept(Angle),
    /// It counts as this multiple of π/2: within 4 ulp of the multiple's double, at most 2e-15
    /// from it, and not beyond ±2π. `1.5707963267948966` is what other tools print for π/2,
    /// and taken at its word no sine or cosine of it would be 0 or 1.
    Taken(Angle),
    /// It stays as written though it is within 1e-3 of `multiple`.
    Near {
        /// The angle as written.
        angle: Angle,
        /// The multiple of π/2 next to it.
        multiple: Angle,
        /// The distance between them, rad.
        distance: f64,
    },
}

impl SnappedAngle {
    /// Returns the angle that it is read as.
    pub fn angle(self) -> Angle {
        match self {
            SnappedAngle::Kept(angle)
            | SnappedAngle::Taken(angle)
            | SnappedAngle::Near { angle, .. } => angle,
        }
    }

    /// Reads a number of radians.
    pub fn of_radians(radians: Rational) -> Self {
        // Beyond 1e15 doubles are further apart than the warning's distance.
        let Some(value) = radians.to_f64().filter(|v| v.abs() < 1e15) else {
            return SnappedAngle::Kept(Angle::Radians(radians));
        };
        if radians.is_zero() {
            return SnappedAngle::Kept(Angle::default());
        }
        // Multiples up to ±2π, against their doubles: differences of doubles this close are exact.
        for n in [1i8, 2, 3, 4] {
            let multiple = f64::from(n) * core::f64::consts::FRAC_PI_2;
            let ulp = f64::from_bits(multiple.to_bits() + 1) - multiple;
            let off = (value.abs() - multiple).abs();
            if off <= 4.0 * ulp && off <= 2e-15 && value.abs() <= core::f64::consts::TAU {
                let n = if value < 0.0 { -n } else { n };
                return SnappedAngle::Taken(Angle::right_angles(n.into()));
            }
        }
        Self::near(Angle::Radians(radians))
    }

    /// Reads an angle that stays as written, and notes a right angle close to it.
    pub fn near(angle: Angle) -> Self {
        let radians = angle.radians();
        let quarter = pi() * ratio(1, 2);
        let n = (&radians / &quarter).round();
        let multiple = Angle::PiTimes(&n * ratio(1, 2));
        let distance = (radians - n * quarter).abs();
        if angle.quarter_turns().is_some() || distance >= ratio(1, 1000) {
            return SnappedAngle::Kept(angle.canonical());
        }
        let distance = distance.to_f64().unwrap_or(0.0);
        SnappedAngle::Near {
            angle,
            multiple,
            distance,
        }
    }
}

/// So many round any angle of a robot file, and order any two that are not absurdly close.
const BITS: usize = 400;

fn pi() -> Rational {
    Rational::new(trig::pi(BITS), BigInt::one() << BITS)
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::*;
    use crate::scalar::Scalar;

    #[test]
    fn angles_of_rational_points_read_back() {
        for (text, other, numerator, denominator) in [
            ("2*atan(-1/3)", "-2*atan(1/3)", -1, 3),
            ("2*atan(7)", " 2*atan( 14/2 )", 7, 1),
            ("-pi/2", "2*atan(-1)", -1, 1),
        ] {
            let angle = Angle::TwiceAtan(ratio(numerator, denominator)).canonical();
            for text in [text, other] {
                assert_eq!(Angle::parse(text), Ok(angle.clone()), "{text}");
            }
            assert_eq!(angle.to_string(), text);
        }
        assert_eq!(Angle::parse("2*atan(0)"), Ok(Angle::default()));
        for text in [
            "atan(1/3)",
            "3*atan(1/3)",
            "2*atan(1/3",
            "2*atan(pi)",
            "2*atan()",
        ] {
            assert!(Angle::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn their_radians_are_right() {
        for (tangent, radians) in [
            (ratio(1, 3), 0.643_501_108_793_284_4),
            (ratio(-9, 2), -2.704_254_761_841_909_3),
        ] {
            let angle = Angle::TwiceAtan(tangent);
            assert_eq!(angle.to_f64(), radians);
            // As exactly as the series of sine and cosine: 240 bits.
            let [here, there] =
                [angle.clone(), Angle::Radians(angle.radians())].map(|angle| Wide::sincos(&angle));
            let off = here.sin.sub(&there.sin).to_rational().abs()
                + here.cos.sub(&there.cos).to_rational().abs();
            assert!(off < Rational::new(BigInt::one(), BigInt::one() << 240u32));
        }
    }

    /// Within 2⁻⁵² rad, in few bits, on both halves of the circle.
    #[test]
    fn any_angle_has_a_rational_point_beside_it() {
        let least = Rational::new(BigInt::one(), BigInt::one() << 52u32);
        for thousandths in [-3141, -2200, -1571, -300, 0, 1, 812, 1570, 1572, 2500, 3140] {
            let angle = Angle::Radians(ratio(thousandths, 1000)).canonical();
            let point = angle.on_the_circle();
            let off = (angle.radians() - point.radians()).abs();
            assert!(off <= least, "{angle}");
            let bits = point.number().denom().bits() + point.number().numer().bits();
            assert!(bits <= 60, "{point}");
            assert_eq!(point.on_the_circle(), point);
        }
        // Three half turns, to thirty digits: nothing is missing.
        let turned =
            Angle::parse("9424777960769379715387930149839/1000000000000000000000000000000");
        assert_eq!(turned.unwrap().on_the_circle(), Angle::right_angles(2));
    }
}
