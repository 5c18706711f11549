//! Powers of cosines written as multiples of angles.
//!
//! cos²θ = ½ + ½·cos 2θ: written in powers, terms undo each other that are larger than their sum;
//! cos kθ and sin kθ do not. And what the two come to together is known: |a·cos kθ + b·sin kθ| ≤
//! √(a² + b²), for products of several angles too, since (cos kθ, sin kθ) are vectors of length one
//! and so are their tensor products.
//!
//! **Soundness.** Identities, in coefficients that are dyadic and exact.

use crate::bound::expand::{Key, Polynomial, added_up, powers, shift};
use crate::interval::Interval;

/// The multiple k of a joint's angle, and `true` for sin kθ.
pub(super) fn multiple(key: Key, joint: usize) -> (u32, bool) {
    let (k, sine) = powers(key, joint);
    (k, sine == 1)
}

pub(super) fn phases(joints: usize) -> Key {
    (0..joints).fold(0, |bits, joint| bits | 16u128 << shift(joint))
}

pub(super) fn bits(joint: usize) -> Key {
    31u128 << shift(joint)
}

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

/// Returns cos^c·sin^s, s at most 1, as Σ part·cos kθ, or Σ part·sin kθ if s is 1: by
/// cos^c = Σ_j (c over j)/2^c·cos (c − 2j)θ.
fn of_power((c, s): (u32, u32)) -> Vec<(u32, f64)> {
    let mut parts = vec![0.0; c as usize + 2];
    let mut part = libm::exp2(-f64::from(c));
    for j in 0..=c {
        let k = f64::from(c) - 2.0 * f64::from(j);
        match s {
            0 => parts[k.abs() as usize] += part,
            // sin θ·cos kθ = ½ sin (k + 1)θ − ½ sin (k − 1)θ
            _ => {
                for (k, half) in [(k + 1.0, 0.5), (k - 1.0, -0.5)] {
                    parts[k.abs() as usize] += half * part * k.signum();
                }
                parts[0] = 0.0;
            }
        }
        part = part * f64::from(c - j) / f64::from(j + 1);
    }
    let all = (0..).zip(parts);
    all.filter(|(_, part)| *part != 0.0).collect()
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
