//! A coefficient known twice: by a residue and by a value of 256 bits. For rational numbers the residue
//! decides if one is zero, and where odd angles take part, the value beside its error.

use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::recover::recovered;
use dalembert_model::number::{Angle, Exact, Rational, Wide};
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::{Scalar, SinCosPair};
use num_bigint::BigInt;

const SEED: u64 = 0x666f_726d;
const PLACES: u32 = 36;
/// The relative error of a sine or a cosine of 256 bits, with room for the operations that follow.
const ROUNDING: f64 = 1e-70;
/// The relative error of a number of 20 digits: a placement's that is neither a fraction nor a simple
/// part of a turn.
const TWENTY_DIGITS: f64 = 1e-19;
/// The most digits of a number that somebody gave: a double has 17.
const GIVEN_DIGITS: usize = 18;

/// The least common multiple of the numbers up to 16.
const COMMON_MULTIPLE: f64 = 720_720.0;

/// A real number with its residue modulo 2⁶¹ − 1 and the error of its value.
///
/// The sine and the cosine of a constant angle are a random point of the circle in the field, so that
/// a relation between two odd angles goes unseen by the residue (0.3 + 0.3 − 0.6, or three times 30°).
/// Such a number has an error, and is zero where its value is below that. Numbers that are made of
/// fractions of at most 18 digits have none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    residue: Field,
    value: Wide,
    error: f64,
}

impl Number {
    /// Converts a fraction whose denominator is a small power of two.
    pub fn of_dyadic(value: f64) -> Number {
        let mut denominator = 0;
        let mut whole = value;
        while whole.fract() != 0.0 && denominator < 60 {
            whole *= 2.0;
            denominator += 1;
        }
        let halved = (0..denominator).fold(Field::from_i64(whole as i64), |x, _| x.half());
        Number::exact(halved, Wide::from_f64(value).unwrap_or_else(Wide::zero))
    }

    fn exact(residue: Field, value: Wide) -> Number {
        Number {
            residue,
            value,
            error: 0.0,
        }
    }

    /// Returns the residue: zero if the number is.
    pub fn residue(&self) -> Field {
        match self.is_zero() {
            true => Field::ZERO,
            false => self.residue,
        }
    }

    /// Returns the nearest double.
    pub fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    /// Returns the value, to 256 bits.
    pub fn to_rational(self) -> Rational {
        self.value.to_rational()
    }

    /// Returns true below zero.
    pub fn is_negative(&self) -> bool {
        self.value.is_negative()
    }

    /// Returns |self|.
    #[must_use]
    pub fn abs(self) -> Number {
        if self.is_negative() { self.neg() } else { self }
    }

    /// Returns |self|, rounded up.
    pub fn magnitude(&self) -> f64 {
        self.value.magnitude()
    }

    /// Returns self / other, `None` if that is zero.
    pub fn over(&self, other: &Number) -> Option<Number> {
        if other.is_zero() {
            return None;
        }
        let value = self.value.over(&other.value)?;
        let relative = other.error / other.magnitude();
        Some(Number {
            residue: self.residue.mul(&other.residue.inverse()?),
            error: self.error / other.magnitude() + value.magnitude() * relative,
            value,
        })
    }

    /// Returns the fraction that it is, if that has a denominator below 2⁹⁰ or is a decimal of at most 36
    /// places. The residue decides.
    pub fn to_fraction(self) -> Option<Rational> {
        // Mostly sines and cosines of odd angles make a number with an error: few are fractions, and
        // those have small denominators.
        let multiple = self.to_f64() * COMMON_MULTIPLE;
        if self.error > 0.0 && (multiple - multiple.round()).abs() > 1e-9 * multiple.abs() {
            return None;
        }
        let is_it = |x: &Rational| Field::from_rational(x) == Some(self.residue);
        let simple = recovered(&self.value, &Rational::from_integer(1.into()));
        if is_it(&simple) {
            return Some(simple);
        }
        let scale = Rational::from_integer(BigInt::from(10).pow(PLACES));
        Some((self.to_rational() * &scale).round() / scale).filter(is_it)
    }

    /// Writes all digits of the size: the decimal where it is a short one, else so many digits that a
    /// double reads them back.
    pub fn digits(self) -> String {
        let exact = self.abs().to_fraction().and_then(|x| write_decimal(&x));
        match exact.filter(|text| text.len() <= 24) {
            Some(text) => text,
            None => plain(&format!("{:?}", self.to_f64().abs())),
        }
    }

    /// Writes the size, rounded to so many digits.
    pub fn rounded(self, digits: usize) -> String {
        rounded(self.to_f64().abs(), digits)
    }
}

/// Writes a positive number, rounded to so many digits.
pub fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..digits as i32).contains(&exponent) {
        let places = (digits as i32 - 1 - exponent).max(0) as usize;
        return trimmed(&format!("{value:.places$}")).to_owned();
    }
    format!("{}e{exponent}", trimmed(mantissa))
}

/// Drops zeros at the end of a decimal.
fn trimmed(decimal: &str) -> &str {
    match decimal.contains('.') {
        true => decimal.trim_end_matches('0').trim_end_matches('.'),
        false => decimal,
    }
}

fn plain(text: &str) -> String {
    match text.split_once('e') {
        Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
        None => trimmed(text).to_owned(),
    }
}

impl Scalar for Number {
    fn zero() -> Self {
        Number::exact(Field::ZERO, Wide::zero())
    }
    fn one() -> Self {
        Number::exact(Field::ONE, Wide::one())
    }
    fn add(&self, other: &Self) -> Self {
        let is_exact = self.error == 0.0 && other.error == 0.0;
        let rounding = match is_exact {
            true => 0.0,
            false => ROUNDING * (self.magnitude() + other.magnitude()),
        };
        Number {
            residue: self.residue.add(&other.residue),
            value: self.value.add(&other.value),
            error: self.error + other.error + rounding,
        }
    }
    fn mul(&self, other: &Self) -> Self {
        let is_exact = self.error == 0.0 && other.error == 0.0;
        let error = match is_exact {
            true => 0.0,
            false => {
                let both = self.magnitude() * other.error + other.magnitude() * self.error;
                both + self.error * other.error
            }
        };
        Number {
            residue: self.residue.mul(&other.residue),
            value: self.value.mul(&other.value),
            error,
        }
    }
    fn neg(&self) -> Self {
        Number {
            residue: self.residue.neg(),
            value: self.value.neg(),
            error: self.error,
        }
    }
    fn half(&self) -> Self {
        Number {
            residue: self.residue.half(),
            value: self.value.half(),
            error: self.error / 2.0,
        }
    }
    fn is_zero(&self) -> bool {
        self.residue == Field::ZERO || self.error > 0.0 && self.magnitude() <= self.error
    }
    fn is_one(&self) -> bool {
        self.residue == Field::ONE || self.error > 0.0 && self.sub(&Number::one()).is_zero()
    }
}

/// True for a fraction of small numbers, and for a decimal of so many digits as people write.
fn is_given(value: &Rational) -> bool {
    let is_small = |x: &BigInt| x.bits() <= 60;
    let digits = |text: String| text.bytes().filter(u8::is_ascii_digit).count();
    is_small(value.numer()) && is_small(value.denom())
        || write_decimal(value).is_some_and(|text| digits(text) <= GIVEN_DIGITS)
}

/// Converts exact constants to numbers, each constant angle always to the same point of the circle.
#[derive(Debug)]
pub struct Constants {
    points: Points,
    angles: Vec<(Angle, SinCosPair<Field>)>,
    /// False once a denominator was divisible by 2⁶¹ − 1.
    pub fits: bool,
}

impl Constants {
    pub fn new() -> Constants {
        Constants {
            points: Points::new(SEED),
            angles: Vec::new(),
            fits: true,
        }
    }

    pub fn number(&mut self, constant: &Exact) -> Number {
        let Constants { points, angles, .. } = self;
        let mut pair = |angle: &Angle| {
            let residues = match angles.iter().find(|(known, _)| known == angle) {
                Some((_, residues)) => residues.clone(),
                None => {
                    let drawn = Field::of_angle(angle, || points.circle());
                    angles.push((angle.clone(), drawn.clone()));
                    drawn
                }
            };
            let SinCosPair { sin, cos } = Wide::sincos(angle);
            let error = match is_given(angle.number()) {
                true => ROUNDING,
                false => TWENTY_DIGITS,
            };
            let number = |residue: Field, value: Wide| Number {
                residue,
                value,
                error,
            };
            SinCosPair {
                sin: number(residues.sin, sin),
                cos: number(residues.cos, cos),
            }
        };
        let mut rational = |x: &Rational| {
            let value = Wide::from_rational(x);
            let error = match is_given(x) {
                true => 0.0,
                false => TWENTY_DIGITS * value.magnitude(),
            };
            Some(Number {
                residue: Field::from_rational(x)?,
                value,
                error,
            })
        };
        let number = constant.map(&mut rational, &mut pair);
        self.fits &= number.is_some();
        number.unwrap_or_else(Number::zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    fn number(n: i64, d: i64) -> Number {
        Constants::new().number(&Exact::from(ratio(n, d)))
    }

    #[test]
    fn numbers_are_written_for_reading_or_whole() {
        let cases = [
            ((200_000, 120_000), "1.66667", "1.6666666666666667"),
            ((1, 2), "0.5", "0.5"),
            ((20216, 100_000_000), "0.00020216", "0.00020216"),
            ((58464, 1_000_000_000), "5.8464e-5", "0.000058464"),
            ((-76_975_268, 100_000_000), "0.769753", "0.76975268"),
            ((123_456_789, 1), "1.23457e8", "123456789"),
            ((1, 1), "1", "1"),
            ((100, 1), "100", "100"),
        ];
        for ((n, d), six, whole) in cases {
            assert_eq!(number(n, d).rounded(6), six);
            assert_eq!(number(n, d).digits(), whole);
        }
    }

    #[test]
    fn fractions_are_confirmed_by_the_residue() {
        assert_eq!(number(22, 7).to_fraction(), Some(ratio(22, 7)));
        assert_eq!(number(7, 300).to_fraction(), Some(ratio(7, 300)));
        let decimal = ratio(-123_456_789_123, 1_000_000_000_000);
        let long = number(-123_456_789_123, 1_000_000_000_000);
        assert_eq!(long.mul(&long).to_fraction(), Some(&decimal * &decimal));
        let pair = Exact::sincos(&Angle::PiTimes(ratio(1, 3)));
        let odd = Constants::new().number(&pair.sin);
        assert_eq!(odd.to_fraction(), None);
        assert_eq!(odd.rounded(6), "0.866025");
        let eighth = Exact::sincos(&Angle::PiTimes(ratio(1, 4)));
        let mut constants = Constants::new();
        let [sin, cos] = [&eighth.sin, &eighth.cos].map(|x| constants.number(x));
        assert!(sin.sub(&cos).is_zero() && sin.mul(&sin).double().is_one());
        assert_eq!(Number::of_dyadic(-0.375), number(-3, 8));
    }

    /// Returns sin(a + b + c) of angles whose sum is zero.
    fn sine_of_sum(angles: [Angle; 3]) -> Number {
        let mut constants = Constants::new();
        let pairs = angles.map(|angle| Exact::sincos(&angle).map(|x| constants.number(x)));
        let [a, b, c] = &pairs;
        a.compose(b).compose(c).sin
    }

    #[test]
    fn relations_of_odd_angles_are_zero_by_value() {
        let radians = |n: i64, d: i64| Angle::Radians(ratio(n, d));
        let thirty = || Angle::PiTimes(ratio(1, 6));
        let twenty_digits = |n: i128| {
            let whole = Rational::from_integer(n.into());
            Angle::Radians(whole / Rational::from_integer(10_i128.pow(20).into()))
        };
        let third = 33_333_333_333_333_333_333;
        let zeros = [
            [radians(3, 10), radians(3, 10), radians(-6, 10)],
            [thirty(), thirty(), Angle::PiTimes(ratio(-1, 3))],
            [radians(1, 3), radians(-2, 3), twenty_digits(third)],
        ];
        for angles in zeros {
            let sine = sine_of_sum(angles);
            assert!(sine.is_zero() && sine.residue() == Field::ZERO);
        }
        let near = radians(-600_000_000_001, 1_000_000_000_000);
        let others = [
            [radians(3, 10), radians(3, 10), near],
            [radians(1, 3), radians(-2, 3), twenty_digits(third + 1000)],
        ];
        for angles in others {
            assert!(!sine_of_sum(angles).is_zero());
        }
        let tiny = number(1, 1_000_000_000);
        assert!(tiny.mul(&tiny).residue() != Field::ZERO);
    }
}
