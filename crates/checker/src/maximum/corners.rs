//! Products of velocities at the worst corner of their box.
//!
//! A sum of f q̇ᵢq̇ⱼ and g q̇ᵢ, with each velocity from −1 to 1, is linear in each, so that its ends
//! are where all are −1 or 1. The sign of a product is the parity of a set of velocities: a Walsh
//! transform gives the sum at all corners.

/// The most velocities whose corners are tried: beyond, each product counts by itself.
pub(super) const MOST_VELOCITIES: usize = 12;

/// A factor of a group of terms: none, a product of velocities by its set or an entry of a matrix by
/// its place, or any monomial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Factor {
    One,
    Place(u32),
    Other,
}

/// Returns the least and the largest value at all corners; the sums are by set, and are lost.
pub fn corners(sums: &mut [f64]) -> [f64; 2] {
    // By places: where half is one, an iterator over pairs takes longer than its sum.
    let mut half = 1;
    while half < sums.len() {
        for from in (0..sums.len()).step_by(2 * half) {
            for k in from..from + half {
                let (x, y) = (sums[k], sums[k + half]);
                (sums[k], sums[k + half]) = (x + y, x - y);
            }
        }
        half *= 2;
    }
    sums.iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], own| {
            [low.min(*own), high.max(*own)]
        })
}
