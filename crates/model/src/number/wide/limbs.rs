//! Integers of 256 bits in limbs of 64, the least first: significands, whose highest bit is one.

use core::cmp::Ordering;

use num_bigint::{BigInt, BigUint, Sign};

pub(super) const LIMBS: usize = 4;

pub(super) type Limbs = [u64; LIMBS];

const BITS: u32 = u64::BITS;

/// The limbs of a product, or of a significand with as many bits again below it.
type Double = [u64; 2 * LIMBS];

/// Returns the top of a × b with its highest bit set, and true if that took a shift by one.
pub(super) fn product(a: &Limbs, b: &Limbs) -> (Limbs, bool) {
    let mut limbs: Double = [0; 2 * LIMBS];
    for (i, &x) in a.iter().enumerate() {
        let mut carry = 0u128;
        for (j, &y) in b.iter().enumerate() {
            carry += u128::from(x) * u128::from(y) + u128::from(limbs[i + j]);
            limbs[i + j] = carry as u64;
            carry >>= BITS;
        }
        limbs[i + LIMBS] = carry as u64;
    }
    let shift = limbs[2 * LIMBS - 1].leading_zeros();
    (top(&limbs, shift), shift > 0)
}

/// Returns the top of a + b·2⁻ᵍ, and true if the sum has one bit more. The gap is at most a
/// significand's bits, so nothing is lost before the cut.
pub(super) fn sum(a: &Limbs, b: &Limbs, gap: u32) -> (Limbs, bool) {
    let (mut limbs, below) = (wide(a), lowered(b, gap));
    let mut carry = false;
    for (x, y) in limbs.iter_mut().zip(below) {
        let (sum, first) = x.overflowing_add(y);
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        (*x, carry) = (sum, first || second);
    }
    let mut kept = top(&limbs, 0);
    if carry {
        for i in 0..LIMBS {
            let above = kept.get(i + 1).copied().unwrap_or(1);
            kept[i] = (kept[i] >> 1) | (above << (BITS - 1));
        }
    }
    (kept, carry)
}

/// Returns the top of |a − b·2⁻ᵍ|, by how many bits it is shifted up, and which of both is larger.
pub(super) fn difference(a: &Limbs, b: &Limbs, gap: u32) -> (Limbs, u32, Ordering) {
    let (left, right) = (wide(a), lowered(b, gap));
    let order = left.iter().rev().cmp(right.iter().rev());
    let (mut limbs, less) = match order {
        Ordering::Less => (right, left),
        _ => (left, right),
    };
    let mut borrow = false;
    for (x, y) in limbs.iter_mut().zip(less) {
        let (rest, first) = x.overflowing_sub(y);
        let (rest, second) = rest.overflowing_sub(u64::from(borrow));
        (*x, borrow) = (rest, first || second);
    }
    let empty = limbs.iter().rev().take_while(|x| **x == 0).count();
    let Some(&first) = limbs.iter().rev().nth(empty) else {
        return ([0; LIMBS], 0, Ordering::Equal);
    };
    let shift = empty as u32 * BITS + first.leading_zeros();
    (top(&limbs, shift), shift, order)
}

fn wide(a: &Limbs) -> Double {
    let mut limbs = [0; 2 * LIMBS];
    limbs[LIMBS..].copy_from_slice(a);
    limbs
}

fn lowered(a: &Limbs, by: u32) -> Double {
    let (whole, part) = ((by / BITS) as usize, by % BITS);
    let mut limbs = [0; 2 * LIMBS];
    for (i, &x) in a.iter().enumerate() {
        let place = (LIMBS + i).saturating_sub(whole);
        limbs[place] |= x >> part;
        if part > 0 && place > 0 {
            limbs[place - 1] |= x << (BITS - part);
        }
    }
    limbs
}

fn top(limbs: &Double, shift: u32) -> Limbs {
    let (whole, part) = ((shift / BITS) as usize, shift % BITS);
    let limb = |place: usize| (place.checked_sub(whole)).map_or(0, |place| limbs[place]);
    core::array::from_fn(|i| {
        let (upper, below) = (limb(LIMBS + i), limb(LIMBS + i - 1));
        match part {
            0 => upper,
            _ => (upper << part) | (below >> (BITS - part)),
        }
    })
}

/// |x| cut to a significand, and the power of two that it is multiplied by; nothing of zero.
pub(super) fn cut(x: &BigInt) -> Option<(Limbs, i64)> {
    let bits = x.bits();
    let width = LIMBS as u64 * u64::from(BITS);
    let magnitude = x.magnitude();
    let digits = match bits {
        0 => return None,
        _ if bits > width => magnitude >> (bits - width),
        _ => magnitude << (width - bits),
    };
    let mut limbs = [0; LIMBS];
    for (limb, digit) in limbs.iter_mut().zip(digits.iter_u64_digits()) {
        *limb = digit;
    }
    Some((limbs, bits as i64 - width as i64))
}

pub(super) fn whole(limbs: &Limbs, negative: bool) -> BigInt {
    let mut bytes = [0; LIMBS * size_of::<u64>()];
    for (part, limb) in bytes.chunks_mut(size_of::<u64>()).zip(limbs) {
        part.copy_from_slice(&limb.to_le_bytes());
    }
    let sign = if negative { Sign::Minus } else { Sign::Plus };
    BigInt::from_biguint(sign, BigUint::from_bytes_le(&bytes))
}
