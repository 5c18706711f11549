//! D, h, c and h_ikm from any τ(q, q̇, q̈): the recursions give them as torques
//! of chosen motions.
//!
//! The chosen rates and accelerations are zeros and ones by structure, so that
//! a symbolic scalar folds what they switch off.

use alloc::vec::Vec;

use super::matrix::{halved, minus, plus, symmetric, zero_vector, zeros};
use super::{Arm, DhVariables};
use crate::scalar::Scalar;

/// Returns D, n×n: its column k is τ of q̈ = e_k at rest, without gravity.
///
/// Only the rows i ≥ k of a column are taken, the others by symmetry.
pub fn inertia<S: Scalar>(
    torques: impl Fn(&Arm<S>, &[DhVariables<S>], &[S], &[S]) -> Vec<S>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
) -> Vec<Vec<S>> {
    let n = arm.links.len();
    let arm = weightless(arm);
    let column = |k: usize| torques(&arm, at, &zeros(n), &unit(n, k));
    let columns: Vec<Vec<S>> = (0..n).map(column).collect();
    symmetric(n, |i, k| columns[k][i].clone())
}

/// Returns h: τ of q̈ = 0 without gravity and damping.
pub fn velocity_terms<S: Scalar>(
    torques: impl Fn(&Arm<S>, &[DhVariables<S>], &[S], &[S]) -> Vec<S>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
) -> Vec<S> {
    torques(
        &weightless(arm).without_friction(),
        at,
        qd,
        &zeros(qd.len()),
    )
}

/// Returns D a + C v + c without damping: C v is bilinear in q̇ and v, so h of half
/// their sum less h of half their difference, and τ has D a and c besides.
pub fn passivity<S: Scalar>(
    torques: impl Fn(&Arm<S>, &[DhVariables<S>], &[S], &[S]) -> Vec<S>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    [v, a]: [&[S]; 2],
) -> Vec<S> {
    let of = |combine: fn(&S, &S) -> S| -> Vec<S> {
        let rates = qd.iter().zip(v);
        rates.map(|(qd, v)| halved(&combine(qd, v))).collect()
    };
    let with = torques(&arm.clone().without_friction(), at, &of(plus), a);
    let without = velocity_terms(torques, arm, at, &of(minus));
    let pairs = with.iter().zip(&without);
    pairs.map(|(with, without)| minus(with, without)).collect()
}

/// Returns c: τ at rest.
pub fn gravity<S: Scalar>(
    torques: impl Fn(&Arm<S>, &[DhVariables<S>], &[S], &[S]) -> Vec<S>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
) -> Vec<S> {
    let n = arm.links.len();
    torques(arm, at, &zeros(n), &zeros(n))
}

/// Returns `h[i][k][m]` = h_ikm by polarisation: h_ikk = h_i(e_k) and
/// h_ikm = (h_i(e_k + e_m) − h_i(e_k) − h_i(e_m)) / 2.
pub fn christoffel<S: Scalar>(
    torques: impl Fn(&Arm<S>, &[DhVariables<S>], &[S], &[S]) -> Vec<S>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
) -> Vec<Vec<Vec<S>>> {
    let n = arm.links.len();
    let arm = weightless(arm).without_friction();
    let velocity_terms = |qd: &[S]| torques(&arm, at, qd, &zeros(n));
    let squares: Vec<Vec<S>> = (0..n).map(|k| velocity_terms(&unit(n, k))).collect();
    // [m][k], k < m: h(e_k + e_m)
    let pair = |k: usize, m: usize| {
        let mut both = unit(n, k);
        both[m] = S::one();
        velocity_terms(&both)
    };
    let pairs: Vec<Vec<Vec<S>>> = (0..n)
        .map(|m| (0..m).map(|k| pair(k, m)).collect())
        .collect();
    let entry = |i: usize, m: usize, k: usize| {
        if m == k {
            return squares[k][i].clone();
        }
        let mixed = minus(&minus(&pairs[m][k][i], &squares[k][i]), &squares[m][i]);
        halved(&mixed)
    };
    (0..n)
        .map(|i| symmetric(n, |m, k| entry(i, m, k)))
        .collect()
}

/// Returns e_k
fn unit<S: Scalar>(n: usize, k: usize) -> Vec<S> {
    let mut e = zeros(n);
    e[k] = S::one();
    e
}

/// Returns the arm without gravity.
pub(super) fn weightless<S: Scalar>(arm: &Arm<S>) -> Arm<S> {
    Arm {
        gravity: zero_vector(),
        ..arm.clone()
    }
}
