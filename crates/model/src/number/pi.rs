//! π to any number of bits, in integers.

use num_bigint::{BigInt, Sign};
use num_traits::{One, Zero};

const KEPT: usize = 512;

/// ⌊π·2^512⌋, the least significant words first.
const PI: [u32; 17] = [
    0xb547_0917,
    0x3f84_d5b5,
    0xc97c_50dd,
    0xc0ac_29b7,
    0x34e9_0c6c,
    0xbe54_66cf,
    0x38d0_1377,
    0x4528_21e6,
    0xec4e_6c89,
    0x082e_fa98,
    0x299f_31d0,
    0xa409_3822,
    0x0370_7344,
    0x1319_8a2e,
    0x85a3_08d3,
    0x243f_6a88,
    0x0000_0003,
];

/// Series of some hundred bits are asked for thousands of times, so as many are kept.
pub(super) fn pi(w: usize) -> BigInt {
    match KEPT.checked_sub(w) {
        Some(more) => BigInt::from_slice(Sign::Plus, &PI) >> more,
        None => machin(w),
    }
}

/// Computes π by Machin's formula: π = 16 atan(1/5) − 4 atan(1/239).
fn machin(w: usize) -> BigInt {
    let guard = 32;
    let one = BigInt::one() << (w + guard);
    let atan_inverse = |n: u32| {
        let square = BigInt::from(n) * n;
        let mut power = &one / n;
        let mut sum = power.clone();
        let mut k = 1u32;
        while !power.is_zero() {
            power = -(power / &square);
            k += 2;
            sum += &power / k;
        }
        sum
    };
    (atan_inverse(5) * 16 - atan_inverse(239) * 4) >> guard
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_of_pi_is_what_the_series_gives() {
        for w in [1, 240, KEPT - 1, KEPT, KEPT + 1, 1000] {
            let (kept, series) = (pi(w), machin(w + 64) >> 64u32);
            assert_eq!(kept, series, "{w}");
        }
    }
}
