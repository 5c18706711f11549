//! Values in 256 bits, with bounds of their errors.

use dalembert_model::number::{Exact, Rational, Wide};
use dalembert_model::scalar::{Divide, Scalar};

/// 2⁻²⁰⁰: an operation in 256 bits loses at most 2⁻²⁵⁵ of its result. The rest is room for
/// the roundings of the bounds themselves, which are doubles.
const LOST: f64 = 6.3e-61;

/// A true value, with a bound of its error by Wilkinson's running error analysis.
#[derive(Clone, Debug)]
pub struct TrueValue {
    value: Wide,
    /// |value|, rounded up.
    size: f64,
    /// In units of [`LOST`].
    lost: f64,
}

impl TrueValue {
    /// Returns the distance to another true value; zero where the errors of both may explain it.
    pub(crate) fn difference(&self, other: &TrueValue) -> f64 {
        let off = other.value.sub(&self.value).magnitude();
        (off - self.doubt() - other.doubt()).max(0.0)
    }

    /// A lower bound of |x − truth|: |x − value| less the reference's own error; infinite for NaN.
    pub fn error(&self, x: f64) -> f64 {
        match Wide::from_f64(x) {
            Some(x) => (x.sub(&self.value).magnitude() - self.doubt()).max(0.0),
            None => f64::INFINITY,
        }
    }

    pub fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    /// Returns the bound of the error.
    pub fn doubt(&self) -> f64 {
        self.lost * LOST
    }

    /// Returns |value|, rounded up.
    pub fn magnitude(&self) -> f64 {
        self.value.magnitude()
    }

    /// Returns |value|, rounded up; zero if the value cannot be told from zero.
    pub fn size(&self) -> f64 {
        match self.magnitude() {
            size if size <= self.doubt() => 0.0,
            size => size,
        }
    }

    pub(crate) fn exact(value: Wide) -> TrueValue {
        let (size, lost) = (value.magnitude(), 0.0);
        TrueValue { value, size, lost }
    }

    /// A value that nothing is known of.
    pub(crate) fn unknown() -> TrueValue {
        TrueValue::rounded(Wide::zero(), f64::INFINITY)
    }

    pub(crate) fn rounded(value: Wide, carried: f64) -> TrueValue {
        let size = value.magnitude();
        let lost = carried + size;
        TrueValue { value, size, lost }
    }

    pub(crate) fn constant(constant: &Exact) -> TrueValue {
        let rational = &mut |x: &Rational| Some(TrueValue::rounded(Wide::from_rational(x), 0.0));
        // Sines and cosines, within 2⁻²⁵⁵.
        let value = constant.map(rational, &mut |angle| {
            Wide::sincos(angle).map(|x| TrueValue::rounded(*x, 1.0))
        });
        value.unwrap_or_else(|| TrueValue::rounded(Wide::from_exact(constant), f64::INFINITY))
    }

    /// For x above zero. Δx moves √x by Δx/(2 √x); the whole Δx/√x, since x is off itself.
    pub(crate) fn sqrt(&self) -> TrueValue {
        let value = self.value.sqrt();
        let carried = match value.magnitude() {
            0.0 => f64::INFINITY,
            root => self.lost / root.next_down(),
        };
        TrueValue::rounded(value, carried)
    }
}

/// Multiplies a size by an error: what is exactly zero is off by nothing, whatever the other is.
fn times(size: f64, lost: f64) -> f64 {
    match size == 0.0 || lost == 0.0 {
        true => 0.0,
        false => size * lost,
    }
}

impl Scalar for TrueValue {
    fn zero() -> Self {
        TrueValue::exact(Wide::zero())
    }
    fn one() -> Self {
        TrueValue::exact(Wide::one())
    }
    fn add(&self, other: &Self) -> Self {
        TrueValue::rounded(self.value.add(&other.value), self.lost + other.lost)
    }
    fn sub(&self, other: &Self) -> Self {
        TrueValue::rounded(self.value.sub(&other.value), self.lost + other.lost)
    }
    fn mul(&self, other: &Self) -> Self {
        let carried = times(self.size, other.lost)
            + times(other.size, self.lost)
            + times(self.lost, other.lost) * LOST;
        TrueValue::rounded(self.value.mul(&other.value), carried)
    }
    fn neg(&self) -> Self {
        let value = self.value.neg();
        TrueValue { value, ..*self }
    }
    fn half(&self) -> Self {
        let (value, size, lost) = (self.value.half(), 0.5 * self.size, 0.5 * self.lost);
        TrueValue { value, size, lost }
    }
}

impl Divide for TrueValue {
    /// Errors of x and y move x/y by (Δx + |x/y| Δy)/(|y| − Δy): at most twice that with |y|
    /// below, unless Δy is more than half of y, and nothing is known.
    fn div(&self, other: &Self) -> Self {
        let value = self.value.div(&other.value);
        let divisor = other.size.next_down();
        let carried = match other.doubt() < 0.4 * divisor {
            true => 2.0 * (self.lost + times(value.magnitude(), other.lost)) / divisor,
            false => f64::INFINITY,
        };
        TrueValue::rounded(value, carried)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn int(n: i64) -> Rational {
        Rational::from_integer(n.into())
    }

    #[test]
    fn what_cancels_is_known_less_well() {
        let known = |n: Rational| TrueValue::constant(&Exact::from(n.recip()));
        let (third, tiny) = (known(int(3)), known(int(7).pow(60)));
        let rest = third.add(&tiny).sub(&third);
        let off = rest.value.sub(&tiny.value).magnitude();
        assert!(off > 0.0 && off <= rest.lost * LOST && rest.lost < 2.0);
        let quotient = third.div(&rest);
        assert!(quotient.lost > 1e50 * third.lost && quotient.lost.is_finite());
        assert_eq!(third.div(&third.sub(&third)).lost, f64::INFINITY);
    }
}
