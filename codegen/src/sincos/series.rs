//! Taylor's series of sine and cosine, and near-minimax fits to them.
//!
//! A fit is the Chebyshev series on the range, cut off: its error is within a few per cent of the
//! least that a polynomial of its degree can have, since the first term left out is far larger than
//! the rest. It is computed in integers from Taylor's series and rounded once, coefficient by
//! coefficient, so it is the same on every machine.

use num_bigint::BigInt;
use num_traits::One;

use dalembert_model::number::Rational;

use super::poly::Poly;
use crate::program::ScalarType;

pub(crate) const FARTHEST: f64 = 40.0;
const NEGLIGIBLE: f64 = 1e-26;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wave {
    Sin,
    Cos,
}

/// Taylor's polynomials about zero, times n!, so that they are integers.
#[derive(Clone, Debug)]
pub(crate) struct Taylor {
    pub waves: [Poly; 2],
    pub factorial: BigInt,
    /// A bound of the terms that either leaves out, before the factor n!.
    pub remainder: f64,
}

impl Taylor {
    /// Derivatives of a sine are at most one, so degree n leaves out at most reach^(n+1)/(n+1)!.
    pub(crate) fn up_to(reach: f64) -> Option<Taylor> {
        if reach.is_nan() || reach > FARTHEST {
            return None;
        }
        let (mut degree, mut remainder) = (0u32, reach);
        while remainder > NEGLIGIBLE {
            degree += 1;
            remainder = (remainder * (reach / f64::from(degree + 1)).next_up()).next_up();
        }
        let mut falling = vec![BigInt::one()];
        for k in (0..degree).rev() {
            falling.push(&falling[falling.len() - 1] * (k + 1));
        }
        falling.reverse();
        let wave = |parity: u32| {
            let term = |(k, c): (u32, &BigInt)| match (k % 2 == parity, k / 2 % 2) {
                (false, _) => BigInt::default(),
                (true, 0) => c.clone(),
                (true, _) => -c,
            };
            Poly::integers((0..).zip(&falling).map(term).collect())
        };
        Some(Taylor {
            waves: [1, 0].map(wave),
            factorial: falling[0].clone(),
            remainder,
        })
    }
}

/// The Chebyshev series of sin and cos of (centre + x/2^halvings) for |x| up to a radius.
#[derive(Clone, Debug)]
pub struct MinimaxFit {
    waves: [Poly; 2],
    factorial: BigInt,
    radius: f64,
}

impl MinimaxFit {
    /// Returns `None` beyond [`FARTHEST`].
    pub fn new(centre: f64, radius: f64, halvings: i32) -> Option<MinimaxFit> {
        let radius = coarse(radius);
        let scaled = radius * libm::exp2(-f64::from(halvings));
        let taylor = Taylor::up_to(centre.abs() + scaled)?;
        let slope = Poly::variable().mul(&Poly::constant(scaled)?);
        let inner = Poly::constant(centre)?.add(&slope);
        let series = |wave: &Poly| wave.compose(&inner).chebyshev();
        Some(MinimaxFit {
            waves: taylor.waves.each_ref().map(series),
            factorial: taylor.factorial,
            radius,
        })
    }

    /// Returns the error of cutting the series off after a degree, from above.
    pub fn tail(&self, wave: Wave, degree: usize) -> f64 {
        self.waves[wave as usize].sum_from(degree + 1, &self.factorial)
    }

    /// Returns the coefficients of factor · series up to a degree, each rounded once.
    pub fn coefficients(
        &self,
        wave: Wave,
        degree: usize,
        factor: &Rational,
        scalar: ScalarType,
    ) -> Vec<f64> {
        let cut = self.waves[wave as usize].in_powers(degree);
        let radius = Rational::from_float(self.radius).unwrap_or_else(Rational::one);
        let mut above = factor.numer().clone();
        let mut below = factor.denom() * &self.factorial;
        let coefficient = |k| {
            let c = cut.coefficient(k);
            let c = Rational::new_raw(c.numer() * &above, c.denom() * &below);
            above *= radius.denom();
            below *= radius.numer();
            scalar.round_rational(&c)
        };
        (0..=degree).map(coefficient).collect()
    }
}

/// Rounds up to a multiple of 2^−20: few bits make short integers.
pub(crate) fn coarse(x: f64) -> f64 {
    const GRID: f64 = 1_048_576.0;
    (libm::floor(x.abs() * GRID) + 1.0) / GRID
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::number::Rounded;

    #[test]
    fn taylor_is_the_sine() {
        let taylor = Taylor::up_to(3.0).unwrap();
        assert!(taylor.remainder < NEGLIGIBLE && taylor.remainder > 0.0);
        let n = Rational::from_integer(taylor.factorial.clone());
        let at = |wave: Wave| {
            let p: &Poly = &taylor.waves[wave as usize];
            let terms = (0..=p.degree()).rev().map(|k| p.coefficient(k) / &n);
            let x = Rational::new(5.into(), 2.into());
            f64::nearest_rational(&terms.fold(Rational::default(), |sum, c| sum * &x + c))
        };
        assert_eq!(at(Wave::Sin), 0.598_472_144_103_956_5);
        assert_eq!(at(Wave::Cos), -0.801_143_615_546_933_7);
        assert!(Taylor::up_to(1e3).is_none() && Taylor::up_to(f64::NAN).is_none());
    }

    #[test]
    fn a_fit_errs_as_much_as_its_tail() {
        let (centre, radius) = (0.75, 1.5);
        let fit = MinimaxFit::new(centre, radius, 1).unwrap();
        let one = Rational::one();
        for degree in 3..9 {
            let c = fit.coefficients(Wave::Cos, degree, &one, ScalarType::F64);
            let mut most = 0.0f64;
            for i in 0..=1000 {
                let x = radius * (f64::from(i) / 500.0 - 1.0);
                let value = c.iter().rev().fold(0.0, |sum, c| sum * x + c);
                most = most.max((value - libm::cos(centre + x / 2.0)).abs());
            }
            let tail = fit.tail(Wave::Cos, degree);
            let is_near = most <= tail + 1e-15 && tail <= 1.4 * most + 1e-15;
            assert!(is_near, "{most} {tail}");
        }
    }
}
