//! Primes below 2⁶³ that are chosen at run time, and arithmetic modulo them.
//!
//! Products are Montgomery's (Montgomery 1985): with R = 2⁶⁴ a residue x is
//! kept as x·R mod p, and a product takes three multiplications of words
//! instead of a division of two words by one.

/// An odd prime p < 2⁶³.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Prime {
    modulus: u64,
    /// −1/p modulo 2⁶⁴.
    inverse: u64,
}

impl Prime {
    /// Returns the prime; `None` for other numbers, for 2, and from 2⁶³.
    pub fn new(modulus: u64) -> Option<Prime> {
        (modulus < 1 << 63 && modulus > 2 && is_prime(modulus)).then(|| Prime::odd(modulus))
    }

    /// Makes the arithmetic of any odd modulus: Montgomery's product needs no prime.
    fn odd(modulus: u64) -> Prime {
        // Newton: x·(2 − p·x) has twice the right bits, and p has three.
        let mut inverse = modulus;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2u64.wrapping_sub(modulus.wrapping_mul(inverse)));
        }
        Prime {
            modulus,
            inverse: inverse.wrapping_neg(),
        }
    }

    /// Returns p
    pub fn modulus(self) -> u64 {
        self.modulus
    }

    /// Returns x·R mod p of a number of any size.
    pub(super) fn enter(self, x: u64) -> u64 {
        ((u128::from(x) << 64) % u128::from(self.modulus)) as u64
    }

    /// Returns x of x·R mod p.
    pub(super) fn leave(self, x: u64) -> u64 {
        self.reduce(u128::from(x))
    }

    /// Returns x/R mod p, for x < p·R.
    fn reduce(self, x: u128) -> u64 {
        let multiple = (x as u64).wrapping_mul(self.inverse);
        // Below 2·p·R < 2¹²⁸, and divisible by R.
        let sum = x + u128::from(multiple) * u128::from(self.modulus);
        self.fold((sum >> 64) as u64)
    }

    /// Returns x mod p, for x < 2·p.
    fn fold(self, x: u64) -> u64 {
        if x >= self.modulus {
            x - self.modulus
        } else {
            x
        }
    }

    pub(super) fn add(self, a: u64, b: u64) -> u64 {
        self.fold(a + b)
    }

    pub(super) fn neg(self, a: u64) -> u64 {
        if a == 0 { 0 } else { self.modulus - a }
    }

    pub(super) fn mul(self, a: u64, b: u64) -> u64 {
        self.reduce(u128::from(a) * u128::from(b))
    }

    pub(super) fn half(self, a: u64) -> u64 {
        // p is odd: one of a and a + p is even, and the sum is below 2⁶⁴.
        let even = if a & 1 == 0 { a } else { a + self.modulus };
        even >> 1
    }

    pub(super) fn pow(self, mut base: u64, mut exponent: u64) -> u64 {
        let mut power = self.enter(1);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = self.mul(power, base);
            }
            base = self.mul(base, base);
            exponent >>= 1;
        }
        power
    }
}

/// Returns whether a number below 2⁶³ is a prime.
///
/// Miller and Rabin's test with the twelve smallest primes as bases decides
/// every number below 3.1·10²³ (Sorenson, Webster 2015).
pub fn is_prime(x: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if let Some(base) = BASES.into_iter().find(|base| x.is_multiple_of(*base)) {
        return x == base;
    }
    if !(2..1 << 63).contains(&x) {
        return false;
    }
    let ring = Prime::odd(x);
    let (one, last) = (ring.enter(1), ring.enter(x - 1));
    let twos = (x - 1).trailing_zeros();
    BASES.into_iter().all(|base| {
        let mut power = ring.pow(ring.enter(base), (x - 1) >> twos);
        let mut passes = power == one || power == last;
        for _ in 1..twos {
            power = ring.mul(power, power);
            passes |= power == last;
        }
        passes
    })
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;
    use crate::scalar::field::Points;

    /// By division, and by what is known.
    #[test]
    fn tells_primes() {
        let by_division = |x: u64| {
            x > 1
                && (2..)
                    .take_while(|d| d * d <= x)
                    .all(|d| !x.is_multiple_of(d))
        };
        for x in 0..20_000 {
            assert_eq!(is_prime(x), by_division(x), "{x}");
        }
        for x in [(1 << 61) - 1, (1u64 << 63) - 25, 4_611_686_018_427_387_847] {
            assert!(is_prime(x), "{x}");
        }
        // Strong pseudoprimes to the first 4 and 9 bases, a Carmichael number,
        // a square, a product of two large primes, and from 2⁶³.
        for x in [
            3_215_031_751,
            3_825_123_056_546_413_051,
            561,
            4_294_967_291 * 2_147_483_647,
            2_147_483_647 * 2_147_483_647,
            u64::MAX - 58,
        ] {
            assert!(!is_prime(x), "{x}");
        }
        assert_eq!(Prime::new(2), None);
        assert_eq!(Prime::new(9), None);
    }

    /// Against the arithmetic of wide integers, at random and at the ends.
    #[test]
    fn is_arithmetic_modulo_the_prime() {
        let mut points = Points::new(0x9);
        for modulus in [
            3,
            7,
            (1 << 61) - 1,
            (1 << 63) - 25,
            4_611_686_018_427_387_847,
        ] {
            let prime = Prime::new(modulus).unwrap();
            let wide = u128::from(modulus);
            let ends = [0, 1, 2, modulus - 2, modulus - 1].map(|x| x % modulus);
            let random = (0..300).map(|_| points.bits() % modulus);
            let all: Vec<u64> = ends.into_iter().chain(random).collect();
            for (i, &a) in all.iter().enumerate() {
                let x = prime.enter(a);
                assert_eq!(prime.leave(x), a);
                assert_eq!(prime.add(prime.half(x), prime.half(x)), x);
                assert_eq!(prime.leave(prime.neg(x)), (modulus - a) % modulus);
                for &b in &all[i / 2..] {
                    let y = prime.enter(b);
                    let product = (u128::from(a) * u128::from(b) % wide) as u64;
                    assert_eq!(prime.leave(prime.mul(x, y)), product, "{a} {b} {modulus}");
                    let sum = ((u128::from(a) + u128::from(b)) % wide) as u64;
                    assert_eq!(prime.leave(prime.add(x, y)), sum);
                }
                let inverse = prime.pow(x, modulus - 2);
                let expected = u64::from(a != 0);
                assert_eq!(prime.leave(prime.mul(x, inverse)), expected);
            }
        }
    }
}
