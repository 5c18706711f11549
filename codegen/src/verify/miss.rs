//! How likely a proof is to miss a difference.
//!
//! Let Δ be the difference of an output and its formula, not zero, of degree
//! d and height H ([`degree`](super::degree)), with integer coefficients. It
//! vanishes at a prime with its point in two cases only:
//!
//! - the prime divides all of Δ's coefficients. Fewer than H/62 primes above
//!   2⁶² divide a number of H bits, and the prime is one of more than 2⁵⁵:
//!   between 2⁶² and 2⁶³ there are more than 1.35·2⁵⁵ that are 3 modulo 4
//!   (Bennett, Martin, O'Bryant, Rechnitzer 2018, corollary 1.6), and the rest
//!   of them are more than constants of 10¹⁷ bits could make unfit;
//! - or the point is a root of Δ modulo the prime, for which the chance is at
//!   most d/2⁶² (Schwartz–Zippel).
//!
//! A wrong program passes only if this happens at every prime, so the chance
//! is at most (128·⌈H/62⌉ + d)/2⁶² to the power of their number. All of its
//! other outputs would have to pass too, which makes it no likelier.

use num_bigint::BigUint;
use num_traits::One;

/// Attempts that somebody is granted who wants a wrong program to pass.
pub(crate) const ATTEMPTS_EXPONENT: u32 = 64;

/// The largest admitted exponent: after all attempts the chance of a miss must be below 10 to
/// the power of this.
pub(crate) const MAX_EXPONENT: i32 = -9;

/// The chance of a miss in one attempt is below 10 to the power of this.
pub(crate) fn exponent(degree: u64, height: u64, primes: usize) -> i32 {
    digits(degree, height, primes, 0)
}

/// Returns whether a wrong program is unlikely to pass, after all attempts.
pub(crate) fn is_small(degree: u64, height: u64, primes: usize) -> bool {
    digits(degree, height, primes, ATTEMPTS_EXPONENT) <= MAX_EXPONENT
}

/// Counts digits in integers: no libm in a stated bound.
fn digits(degree: u64, height: u64, primes: usize, attempts: u32) -> i32 {
    let shared = 128 * u128::from(height.div_ceil(62));
    let chance = BigUint::from(shared + u128::from(degree)).pow(primes as u32) << attempts;
    let all = BigUint::one() << (62 * primes);
    if chance == BigUint::ZERO {
        // Only a constant zero has neither: it differs from nothing.
        return i32::MIN;
    }
    let digits = (all / chance).to_string().len() as i32;
    1 - digits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_rounded_up() {
        // 128·17 + 34 = 2210 of 2⁶²: 4.79e-16, squared 2.296e-31.
        assert_eq!(exponent(34, 1000, 1), -15);
        assert_eq!(exponent(34, 1000, 2), -30);
        // 1/2⁶² is 2.17e-19.
        assert_eq!(exponent(1, 0, 1), -18);
        // 2⁻²⁴⁸ times 2⁶⁴ is 4.08e-56.
        assert!(is_small(1, 0, 4));
        assert!(!is_small(1 << 40, 0, 4));
        assert!(!is_small(34, 1000, 1));
        assert_eq!(exponent(u64::MAX, u64::MAX, 1), 0);
    }
}
