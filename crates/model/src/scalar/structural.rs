//! Arithmetic that a structural zero or one saves: nothing needless is computed, in any scalar.

use super::{Divide, Scalar};

/// Returns `a · b`, not made when a factor is zero or one by structure.
pub fn times<S: Scalar>(a: &S, b: &S) -> S {
    if a.is_zero() || b.is_zero() {
        S::zero()
    } else if a.is_one() {
        b.clone()
    } else if b.is_one() {
        a.clone()
    } else {
        a.mul(b)
    }
}

/// Returns `a / b`, not made when the dividend is zero or the divisor one by structure.
pub fn over<S: Divide>(a: &S, b: &S) -> S {
    if a.is_zero() {
        S::zero()
    } else if b.is_one() {
        a.clone()
    } else {
        a.div(b)
    }
}

/// Returns `a + b`, not made when a term is zero by structure.
pub fn plus<S: Scalar>(a: &S, b: &S) -> S {
    if a.is_zero() {
        b.clone()
    } else if b.is_zero() {
        a.clone()
    } else {
        a.add(b)
    }
}

/// Returns `a − b`, not made when a term is zero by structure.
pub fn minus<S: Scalar>(a: &S, b: &S) -> S {
    if b.is_zero() {
        a.clone()
    } else if a.is_zero() {
        b.neg()
    } else {
        a.sub(b)
    }
}

/// Returns `−a`; a structural zero stays one.
pub fn negative<S: Scalar>(a: &S) -> S {
    if a.is_zero() { S::zero() } else { a.neg() }
}

/// Returns `2 a`; a structural zero stays one.
pub fn twice<S: Scalar>(a: &S) -> S {
    if a.is_zero() { S::zero() } else { a.double() }
}

/// Returns `a / 2`; a structural zero stays one.
pub fn halved<S: Scalar>(a: &S) -> S {
    if a.is_zero() { S::zero() } else { a.half() }
}
