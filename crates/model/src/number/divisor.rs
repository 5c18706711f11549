//! The greatest common divisor of big integers by Lehmer's method: a run of Euclid's quotients is
//! read off the leading bits, and both numbers change once for all of it (Knuth, The Art of Computer
//! Programming, volume 2, section 4.5.2, algorithm L).

use num_bigint::BigUint;
use num_integer::Integer;
use num_traits::Zero;

/// Leading bits that a run of quotients is read off: with them, no cofactor leaves a word.
const LEADING: u64 = 62;

pub(super) fn greatest_common_divisor(a: &BigUint, b: &BigUint) -> BigUint {
    let (mut x, mut y) = (a.max(b).clone(), a.min(b).clone());
    while !y.is_zero() {
        if let (Ok(x), Ok(y)) = (u64::try_from(&x), u64::try_from(&y)) {
            return x.gcd(&y).into();
        }
        let below = x.bits().saturating_sub(LEADING);
        // Shifted by as much as the larger one, both fit.
        let leading = |number: &BigUint| i64::try_from(number >> below).unwrap_or(0);
        (x, y) = match cofactors(leading(&x), leading(&y)) {
            Some(rows) => {
                let [x, y] = rows.map(|[p, q]| combined(p, &x, q, &y));
                (x, y)
            }
            None => {
                let rest = &x % &y;
                (y, rest)
            }
        };
    }
    x
}

/// Returns the rows by which Euclid's steps change any two numbers that begin with `x` and `y`, as
/// far as these bits tell the quotients; `None` if they tell none.
fn cofactors(mut x: i64, mut y: i64) -> Option<[[i64; 2]; 2]> {
    let [mut first, mut second] = [[1, 0], [0, 1]];
    // The numbers lie between these bounds: the quotient is known where it is the same at both.
    while y + second[0] != 0 && y + second[1] != 0 {
        let quotient = (x + first[0]) / (y + second[0]);
        if quotient != (x + first[1]) / (y + second[1]) {
            break;
        }
        let rest = [0, 1].map(|i| first[i] - quotient * second[i]);
        (first, second) = (second, rest);
        (x, y) = (y, x - quotient * y);
    }
    (first[1] != 0).then_some([first, second])
}

/// Returns p x + q y, which is not negative; one of p and q is not positive.
fn combined(p: i64, x: &BigUint, q: i64, y: &BigUint) -> BigUint {
    let [px, qy] = [x * p.unsigned_abs(), y * q.unsigned_abs()];
    if p > 0 { px - qy } else { qy - px }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::field::Points;
    use alloc::vec::Vec;

    #[test]
    fn it_is_what_the_binary_algorithm_finds() {
        let mut points = Points::new(7);
        let mut number = |bits: u64| {
            let words = (0..bits.div_ceil(32)).map(|_| points.bits() as u32);
            BigUint::new(words.collect()) >> (bits.next_multiple_of(32) - bits)
        };
        let sizes = [0, 1, 31, 62, 63, 64, 65, 127, 128, 200, 800];
        for size in sizes {
            for other in sizes {
                for shared in [1, 30, 64, 300] {
                    let common = number(shared);
                    let [a, b] = [number(size) * &common, number(other) * &common];
                    assert_eq!(greatest_common_divisor(&a, &b), a.gcd(&b), "{a} {b}");
                }
            }
        }
        // Each quotient is one: the longest runs; and one that no leading bits tell.
        let mut fibonacci: Vec<BigUint> = Vec::from([0_u8, 1].map(BigUint::from));
        for i in 2..1_000 {
            fibonacci.push(&fibonacci[i - 1] + &fibonacci[i - 2]);
        }
        let [a, b] = [&fibonacci[999], &fibonacci[998]];
        assert_eq!(greatest_common_divisor(a, b), BigUint::from(1_u8));
        let power: BigUint = BigUint::from(1_u8) << 500;
        for a in [&power + 1_u8, &power * 3_u8] {
            assert_eq!(greatest_common_divisor(&a, &power), a.gcd(&power));
        }
    }
}
