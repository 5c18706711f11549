//! Sines and cosines to 2⁻⁶⁹ relative in pairs of doubles: a double and what it
//! lacks. Fast enough for a hundred million points, exact enough for 2⁻¹⁶ ulp.
//!
//! Sums and products of two doubles are exact as pairs (Knuth, Dekker). The rest of the angle
//! has an error of 2⁻¹⁰⁴, and the series, whose first terms are in pairs, 2⁻⁷⁰: a term in doubles is
//! at most z⁴/8! < 2⁻¹⁸ with an error of 2⁻⁵². `against_the_wide_float` measures it.

/// A double and what it lacks.
#[derive(Clone, Copy, Debug)]
pub struct Pair(pub f64, pub f64);

fn sum(a: f64, b: f64) -> Pair {
    let s = a + b;
    let of_b = s - a;
    Pair(s, (a - (s - of_b)) + (b - of_b))
}

/// Returns a in halves of 26 bits.
fn halves(a: f64) -> (f64, f64) {
    let shifted = a * 134217729.0;
    let high = shifted - (shifted - a);
    (high, a - high)
}

fn product(a: f64, b: f64) -> Pair {
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    Pair(p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Pair {
    fn add(self, other: Pair) -> Pair {
        let Pair(high, low) = sum(self.0, other.0);
        sum(high, low + (self.1 + other.1))
    }

    fn mul(self, other: Pair) -> Pair {
        let Pair(high, low) = product(self.0, other.0);
        sum(high, low + (self.0 * other.1 + self.1 * other.0))
    }

    fn negative(self) -> Pair {
        Pair(-self.0, -self.1)
    }
}

/// π/2 in three parts of at most 40 bits and the rest to 2⁻¹⁷².
const QUARTER: [f64; 4] = [
    1.5707963267941523,
    7.443547480480255e-13,
    6.368317163513703e-25,
    -2.7529965190440717e-37,
];

fn reduced(x: f64) -> (i64, Pair) {
    let k = (x * core::f64::consts::FRAC_2_PI).round();
    let first = sum(x - k * QUARTER[0], -(k * QUARTER[1]));
    let second = sum(first.0, -(k * QUARTER[2]));
    let low = first.1 + (second.1 - k * QUARTER[3]);
    (k as i64, sum(second.0, low))
}

/// Returns Σ c_k z^k, the terms after the first in doubles.
fn series(z: Pair, first: [Pair; 3], others: [f64; 7]) -> Pair {
    let tail = others.iter().rev().fold(0.0, |sum, c| sum * z.0 + c);
    let terms = first.iter().rev();
    terms.fold(Pair(tail, 0.0), |sum, c| sum.mul(z).add(*c))
}

/// Returns ±1/n! for every second n.
fn inverse_factorials(from: u32) -> [f64; 7] {
    core::array::from_fn(|k| {
        let n = from + 2 * k as u32;
        let factorial = (2..=n).fold(1.0, |product, k| product * f64::from(k));
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        sign / factorial
    })
}

/// Sine and cosine of |x| ≤ 8192.
pub struct Reference {
    sine: [f64; 7],
    cosine: [f64; 7],
}

impl Reference {
    pub fn new() -> Reference {
        let [sine, cosine] = [9, 8].map(inverse_factorials);
        Reference { sine, cosine }
    }

    pub fn sincos(&self, x: f64) -> (Pair, Pair) {
        let (k, r) = reduced(x);
        let z = r.mul(r);
        // 1/6, 1/120 and 1/5040; 1/2, 1/24 and 1/720.
        let sine = [
            Pair(-0.16666666666666666, -9.25185853854297e-18),
            Pair(0.008333333333333333, 1.1564823173178714e-19),
            Pair(-0.0001984126984126984, -1.7209558293420705e-22),
        ];
        let cosine = [
            Pair(-0.5, 0.0),
            Pair(0.041666666666666664, 2.3129646346357427e-18),
            Pair(-0.001388888888888889, 5.300543954373577e-20),
        ];
        let sin = r.add(r.mul(z).mul(series(z, sine, self.sine)));
        let cos = Pair(1.0, 0.0).add(z.mul(series(z, cosine, self.cosine)));
        match k.rem_euclid(4) {
            0 => (sin, cos),
            1 => (cos, sin.negative()),
            2 => (sin.negative(), cos.negative()),
            _ => (cos.negative(), sin),
        }
    }
}

/// Returns the distance between neighbours where the true value is.
pub fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

pub fn ulps(result: f64, exact: Pair) -> f64 {
    // Just below a power of two an ulp is half as large as at it.
    let power = exact.0.to_bits().is_multiple_of(1 << 52);
    let below = power && exact.1 != 0.0 && (exact.1 < 0.0) == (exact.0 > 0.0);
    let size = ulp(exact.0) / if below { 2.0 } else { 1.0 };
    ((result - exact.0) / size - exact.1 / size).abs()
}
