//! A coefficient known twice: by a residue, which decides if it is zero, and by a value of 256 bits,
//! which is printed.

use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::recover::recovered;
use dalembert_model::number::{Angle, Exact, Rational, Wide};
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::{Scalar, SinCosPair};
use num_bigint::BigInt;

const SEED: u64 = 0x666f_726d;
const PLACES: u32 = 36;

/// A real number with its residue modulo 2⁶¹ − 1.
///
/// The sine and the cosine of a constant angle are a random point of the circle in the field, so that
/// a relation between two odd angles goes unseen: the number then looks different from zero, and its
/// value tells ([`Number::is_negligible`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    residue: Field,
    value: Wide,
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
        Number {
            residue: halved,
            value: Wide::from_f64(value).unwrap_or_else(Wide::zero),
        }
    }

    /// Returns the residue.
    pub fn residue(&self) -> Field {
        self.residue
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

    /// True below 1e-60 of a size: zero as far as 256 bits tell.
    pub fn is_negligible(&self, size: f64) -> bool {
        self.magnitude() <= 1e-60 * size
    }

    /// Returns self / other, `None` if that is zero.
    pub fn over(&self, other: &Number) -> Option<Number> {
        Some(Number {
            residue: self.residue.mul(&other.residue.inverse()?),
            value: self.value.over(&other.value)?,
        })
    }

    /// Returns the fraction that it is, if that has a denominator below 2⁹⁰ or is a decimal of at most 36
    /// places. The residue decides.
    pub fn to_fraction(self) -> Option<Rational> {
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
        let value = self.to_f64().abs();
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let exponent: i32 = exponent.parse().unwrap_or(0);
        if (-4..digits as i32).contains(&exponent) {
            let places = (digits as i32 - 1 - exponent).max(0) as usize;
            return trimmed(&format!("{value:.places$}")).to_owned();
        }
        format!("{}e{exponent}", trimmed(mantissa))
    }
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
        let (residue, value) = (Field::ZERO, Wide::zero());
        Number { residue, value }
    }
    fn one() -> Self {
        let (residue, value) = (Field::ONE, Wide::one());
        Number { residue, value }
    }
    fn add(&self, other: &Self) -> Self {
        Number {
            residue: self.residue.add(&other.residue),
            value: self.value.add(&other.value),
        }
    }
    fn mul(&self, other: &Self) -> Self {
        Number {
            residue: self.residue.mul(&other.residue),
            value: self.value.mul(&other.value),
        }
    }
    fn neg(&self) -> Self {
        Number {
            residue: self.residue.neg(),
            value: self.value.neg(),
        }
    }
    fn half(&self) -> Self {
        Number {
            residue: self.residue.half(),
            value: self.value.half(),
        }
    }
    fn is_zero(&self) -> bool {
        self.residue == Field::ZERO
    }
    fn is_one(&self) -> bool {
        self.residue == Field::ONE
    }
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
    /// Makes an empty list of angles.
    pub fn new() -> Constants {
        Constants {
            points: Points::new(SEED),
            angles: Vec::new(),
            fits: true,
        }
    }

    /// Converts one constant.
    pub fn number(&mut self, constant: &Exact) -> Number {
        let (points, angles) = (&mut self.points, &mut self.angles);
        let mut point = |angle: &Angle| {
            if let Some((_, pair)) = angles.iter().find(|(known, _)| known == angle) {
                return pair.clone();
            }
            // Of an eighth of a turn both are √½, which the field has: 2³⁰.
            let eighth = Angle::PiTimes(Rational::new(1.into(), 4.into()));
            let root = Field::new(1 << 30);
            let (sin, cos) = if *angle == eighth {
                (root, root)
            } else {
                points.circle()
            };
            angles.push((angle.clone(), SinCosPair { sin, cos }));
            SinCosPair { sin, cos }
        };
        let residue = constant.map(&mut |x: &Rational| Field::from_rational(x), &mut point);
        self.fits &= residue.is_some();
        Number {
            residue: residue.unwrap_or(Field::ZERO),
            value: Wide::from_exact(constant),
        }
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
        for ((n, d), six, all) in cases {
            assert_eq!(number(n, d).rounded(6), six);
            assert_eq!(number(n, d).digits(), all);
        }
    }

    #[test]
    fn fractions_are_confirmed_by_the_residue() {
        assert_eq!(number(22, 7).to_fraction(), Some(ratio(22, 7)));
        assert_eq!(number(7, 300).to_fraction(), Some(ratio(7, 300)));
        let decimal = ratio(-123_456_789_123, 1_000_000_000_000);
        let square = number(-123_456_789_123, 1_000_000_000_000);
        let square = square.mul(&square);
        assert_eq!(square.to_fraction(), Some(&decimal * &decimal));
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
}
