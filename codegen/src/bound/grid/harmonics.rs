//! Powers of cosines written as multiples of angles.
//!
//! cos²θ = ½ + ½·cos 2θ: written in powers, terms undo each other that are
//! larger than their sum; cos kθ and sin kθ do not. And what the two come to
//! together is known: |a·cos kθ + b·sin kθ| ≤ √(a² + b²), for products of
//! several angles too, since (cos kθ, sin kθ) are vectors of length one and so
//! are their tensor products.
//!
//! **Soundness.** Identities, in coefficients that are dyadic and exact.

use crate::bound::expand::{Key, Polynomial, added_up, powers, shift};
use crate::interval::Interval;

/// Reads of a key whose joints have multiples in place of powers the multiple k of a joint's
/// angle, and whether it is sin kθ.
pub(super) fn multiple(key: Key, joint: usize) -> (u32, bool) {
    let (k, sine) = powers(key, joint);
    (k, sine == 1)
}

/// Returns the bits that tell sines from cosines.
pub(super) fn phases(joints: usize) -> Key {
    (0..joints).fold(0, |bits, joint| bits | 16u128 << shift(joint))
}

/// Returns the bits of a joint in a key.
pub(super) fn bits(joint: usize) -> Key {
    31u128 << shift(joint)
}

/// Returns the polynomial in multiples of its angles: in each key a joint's power of
/// the cosine is replaced by the multiple. `None` if a multiple does not fit.
pub(in crate::bound) fn harmonics(polynomial: &Polynomial, joints: usize) -> Option<Polynomial> {
    let mut terms = polynomial.clone();
    let mut known: [Option<Vec<(u32, f64)>>; 32] = [const { None }; 32];
    for joint in 0..joints {
        let turns = terms.iter().any(|&(key, _)| key & bits(joint) != 0);
        if !turns {
            continue;
        }
        let mut next: Polynomial = Vec::with_capacity(2 * terms.len());
        for &(key, x) in &terms {
            let (c, s) = powers(key, joint);
            let rest = key & !bits(joint);
            let place = (c + 16 * s) as usize % known.len();
            for &(k, part) in known[place].get_or_insert_with(|| of_power((c, s))).iter() {
                if k > 15 {
                    return None;
                }
                let key = rest | Key::from(k | s << 4) << shift(joint);
                let part = match part == 1.0 {
                    true => x,
                    false => x * Interval::point(part),
                };
                next.push((key, part));
            }
        }
        terms = added_up(next);
    }
    Some(terms)
}

/// Returns cos^c·sin^s, s at most 1, as Σ part·cos kθ, or Σ part·sin kθ if s is 1.
fn of_power((c, s): (u32, u32)) -> Vec<(u32, f64)> {
    if (c, s) == (0, 0) {
        return vec![(0, 1.0)];
    }
    // cos^c = Σ_k part_k·cos kθ: cos θ·cos kθ = ½ cos (k + 1)θ + ½ cos (k − 1)θ.
    let mut cosines = vec![0.0; c as usize + 2];
    cosines[0] = 1.0;
    for _ in 0..c {
        let mut next = vec![0.0; cosines.len()];
        for (k, &part) in cosines.iter().enumerate().filter(|(_, part)| **part != 0.0) {
            match k {
                0 => next[1] += part,
                _ => {
                    next[k + 1] += 0.5 * part;
                    next[k - 1] += 0.5 * part;
                }
            }
        }
        cosines = next;
    }
    let mut parts = vec![0.0; cosines.len() + 1];
    for (k, &part) in cosines.iter().enumerate() {
        match (s, k) {
            (0, _) => parts[k] += part,
            (_, 0) => parts[1] += part,
            // sin θ·cos kθ = ½ sin (k + 1)θ − ½ sin (k − 1)θ
            _ => {
                parts[k + 1] += 0.5 * part;
                parts[k - 1] -= 0.5 * part;
            }
        }
    }
    let from = s as usize;
    let all = parts.into_iter().enumerate().skip(from);
    all.filter(|(_, part)| *part != 0.0)
        .map(|(k, part)| (k as u32, part))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_sums_of_multiples() {
        for c in 0..14 {
            for s in 0..2 {
                for angle in [0.3, 1.7, -2.2, 4.0] {
                    let power = libm::pow(libm::cos(angle), f64::from(c))
                        * libm::pow(libm::sin(angle), f64::from(s));
                    let parts = of_power((c, s)).into_iter();
                    let sum: f64 = parts
                        .map(|(k, part)| {
                            let angle = f64::from(k) * angle;
                            part * if s == 1 {
                                libm::sin(angle)
                            } else {
                                libm::cos(angle)
                            }
                        })
                        .sum();
                    assert!((power - sum).abs() < 1e-14, "{c} {s} {angle}");
                }
            }
        }
    }
}
