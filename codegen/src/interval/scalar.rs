//! Intervals as a scalar, so that whatever runs in a scalar can be bounded.

use dalembert_model::scalar::{Divide, Scalar};

use super::Interval;
use super::doubles::around;

impl Scalar for Interval {
    fn zero() -> Self {
        Interval::ZERO
    }
    fn one() -> Self {
        Interval::ONE
    }
    fn add(&self, other: &Self) -> Self {
        *self + *other
    }
    fn sub(&self, other: &Self) -> Self {
        *self - *other
    }
    fn mul(&self, other: &Self) -> Self {
        *self * *other
    }
    fn neg(&self) -> Self {
        -*self
    }
    fn half(&self) -> Self {
        *self * Interval::point(0.5)
    }
    fn is_zero(&self) -> bool {
        *self == Interval::ZERO
    }
}

impl Divide for Interval {
    /// Returns every number where the divisor may vanish: there is no quotient then.
    fn div(&self, other: &Self) -> Self {
        if other.contains(0.0) {
            return Interval::ALL;
        }
        // Correctly rounded like products: one double outward encloses.
        around([
            self.low() / other.low(),
            self.low() / other.high(),
            self.high() / other.low(),
            self.high() / other.high(),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Operation;
    use crate::random::Random;
    use dalembert_model::number::Rational;

    #[test]
    fn results_enclose_exact_results() {
        let mut random = Random::new(0x1e7);
        let mut number = || {
            let scale = libm::exp2((random.bits() % 40) as f64 - 20.0);
            (random.bits() % 2001) as f64 * scale / 1000.0 - scale
        };
        let (mut bounded, mut unbounded) = (0, 0);
        for _ in 0..2000 {
            let mut interval = || {
                let (a, b) = (number(), number());
                Interval::new(a.min(b), a.max(b)).unwrap()
            };
            let (x, y) = (interval(), interval());
            let inside =
                |x: Interval| [x.low(), x.high()].map(|x| Rational::from_float(x).unwrap());
            for operation in Operation::ALL {
                let result = operation.apply(&x, &y);
                if result == Interval::ALL {
                    unbounded += 1;
                    assert!(operation == Operation::Div && y.contains(0.0));
                    continue;
                }
                bounded += 1;
                for a in inside(x) {
                    for b in inside(y) {
                        let exact = match operation {
                            Operation::Add => &a + &b,
                            Operation::Sub => &a - &b,
                            Operation::Mul | Operation::Fused => &a * &b,
                            Operation::Div => &a / &b,
                        };
                        let end = |x: f64| Rational::from_float(x).unwrap();
                        assert!(end(result.low()) <= exact && exact <= end(result.high()));
                    }
                }
            }
        }
        assert!(bounded > 6000 && unbounded > 100, "{bounded} {unbounded}");
    }
}
