//! What products of velocities come to together, at the corners of their box.
//!
//! Each by itself is at its worst where its velocities have certain signs; all of them
//! never are if these contradict each other. A sum Σ bₖ·sₖ + Σ pₖₗ·sₖ·sₗ over velocities
//! sₖ between −1 and 1 is linear in each of them, so it is largest and smallest where all
//! are −1 or 1, and these are few enough to be tried.

/// The most factors, the constant one among them: each doubles the work.
const MOST: usize = 10;

/// Factor 0 is the constant 1, the others are velocities between −1 and 1.
#[derive(Clone, Debug)]
pub(crate) struct Corners {
    factors: usize,
    products: [[f64; MOST]; MOST],
}

impl Corners {
    pub(crate) fn new(velocities: usize) -> Option<Corners> {
        let factors = 1 + velocities;
        (factors <= MOST).then_some(Corners {
            factors,
            products: [[0.0; MOST]; MOST],
        })
    }

    /// The first factor is the smaller one.
    pub(crate) fn of(&mut self, first: usize, second: usize) -> &mut f64 {
        &mut self.products[first][second]
    }

    /// No term goes through more additions than there are terms.
    pub(crate) fn extremes(&self) -> (f64, f64) {
        // Without linear terms opposite corners are alike.
        let first = usize::from(self.products[0].iter().all(|x| *x == 0.0));
        self.beyond(first + 1, 0.0, &self.products[first])
    }

    /// Returns the extremes over the factors from one on: `sum` has the terms of those before, and
    /// `linear` what each of the others is multiplied with.
    fn beyond(&self, factor: usize, sum: f64, linear: &[f64; MOST]) -> (f64, f64) {
        if factor + 1 >= self.factors {
            let last = linear.get(factor).map_or(0.0, |x| x.abs());
            return (sum - last, sum + last);
        }
        let (mut plus, mut minus) = (*linear, *linear);
        for other in factor + 1..self.factors {
            plus[other] += self.products[factor][other];
            minus[other] -= self.products[factor][other];
        }
        let (low, high) = self.beyond(factor + 1, sum + linear[factor], &plus);
        let (least, most) = self.beyond(factor + 1, sum - linear[factor], &minus);
        (low.min(least), high.max(most))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn extremes_are_those_of_all_corners() {
        let mut random = Random::new(3);
        for velocities in 0..MOST {
            for linear in [0.0, 1.0] {
                let mut corners = Corners::new(velocities).unwrap();
                let mut terms = Vec::new();
                for first in 0..=velocities {
                    for second in first + 1..=velocities {
                        let part = if first == 0 { linear } else { 1.0 };
                        let x = part * (random.unit() - 0.5);
                        *corners.of(first, second) = x;
                        terms.push((first, second, x));
                    }
                }
                let sums = (0..1 << velocities).map(|corner: usize| {
                    let sign = |factor: usize| match factor {
                        0 => 1.0,
                        other if corner >> (other - 1) & 1 == 1 => 1.0,
                        _ => -1.0,
                    };
                    terms.iter().map(|&(a, b, x)| x * sign(a) * sign(b)).sum()
                });
                let sums: Vec<f64> = sums.collect();
                let least = sums.iter().copied().fold(f64::INFINITY, f64::min);
                let most = sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let (low, high) = corners.extremes();
                assert!((low - least).abs() < 1e-12 && (high - most).abs() < 1e-12);
                let alone: f64 = terms.iter().map(|(_, _, x)| x.abs()).sum();
                let most = if velocities < 6 { 1.0 + 1e-12 } else { 0.99 };
                assert!(high.max(-low) <= most * alone);
            }
        }
        assert!(Corners::new(MOST).is_none());
    }
}
