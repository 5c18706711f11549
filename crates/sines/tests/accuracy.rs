//! The error in ulps: of f64 against pairs of doubles, of f32 against libm's f64 (to 2⁻²⁸ ulp).
//!
//! Some points always; a hundred million, and every f32, by hand:
//! `cargo test --release -p dalembert-sines -- --ignored --nocapture`.

mod reference;

use dalembert_model::number::Wide;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Points;
use dalembert_sines::{LARGEST, LARGEST_F32, sincos, sincosf};
use reference::{Reference, ulp, ulps};

/// The bounds of the documentation, of sines and cosines.
const PROVED: [f64; 2] = [0.90, 0.85];

const TOGETHER: usize = 8;

#[derive(Clone, Copy, Default)]
struct Worst {
    sin: (f64, f64),
    cos: (f64, f64),
    points: u64,
}

impl Worst {
    fn add(&mut self, x: f64, sin: f64, cos: f64) {
        self.points += 1;
        for (worst, error) in [(&mut self.sin, sin), (&mut self.cos, cos)] {
            // Nothing is below a NaN.
            if error > worst.0 || error.is_nan() {
                *worst = (error, x);
            }
        }
    }

    fn is_as_proved(&self, what: &str) {
        let ((sin, at), (cos, cos_at)) = (self.sin, self.cos);
        let points = self.points;
        println!(
            "{what}: {points} points, sine {sin:.4} ulp at {at:e}, cosine {cos:.4} at {cos_at:e}"
        );
        assert!(sin <= PROVED[0] && cos <= PROVED[1], "{what}");
    }
}

fn doubles(what: &str, points: impl Iterator<Item = f64>) {
    let (reference, mut worst) = (Reference::new(), Worst::default());
    let mut points = points.filter(|x| x.abs() <= LARGEST).peekable();
    while points.peek().is_some() {
        let x: [f64; TOGETHER] = std::array::from_fn(|_| points.next().unwrap_or_default());
        let (sin, cos) = sincos(&x);
        for (x, (sin, cos)) in x.into_iter().zip(sin.into_iter().zip(cos)) {
            let (true_sin, true_cos) = reference.sincos(x);
            worst.add(x, ulps(sin, true_sin), ulps(cos, true_cos));
        }
    }
    worst.is_as_proved(what);
}

/// Neighbours of multiples of π/4: there the remainder is small, or the quarter turn changes.
fn near_quarters(neighbours: u64) -> impl Iterator<Item = f64> {
    (1..=10430u64).flat_map(move |k| {
        let middle = (k as f64 * core::f64::consts::FRAC_PI_4).to_bits();
        (middle - neighbours..=middle + neighbours).map(f64::from_bits)
    })
}

fn within(reach: f64, points: u64, seed: u64) -> impl Iterator<Item = f64> {
    let mut random = Points::new(seed);
    (0..points).map(move |_| random.unit() * reach)
}

/// Returns points of every size from 2⁻⁴⁰ on.
fn of_every_size(points: u64) -> impl Iterator<Item = f64> {
    let mut random = Points::new(7);
    let (least, most) = ((-40f64).exp2().to_bits(), LARGEST.to_bits());
    (0..points).map(move |_| f64::from_bits(least + random.bits() % (most - least)))
}

fn measure_doubles(points: u64, neighbours: u64) {
    doubles("half a turn either way", within(3.2, points, 1));
    doubles("a quarter of it", within(0.8, points / 4, 2));
    doubles("the whole range", within(LARGEST, points / 4, 3));
    doubles("every size", of_every_size(points / 4));
    doubles("next to multiples of pi/4", near_quarters(neighbours));
}

/// Checks as well that −x has the same bits but for the sine's sign.
fn singles(bits: impl Iterator<Item = u32>) {
    let (mut worst, mut bits) = (Worst::default(), bits.peekable());
    while bits.peek().is_some() {
        let x: [f32; TOGETHER] =
            std::array::from_fn(|_| f32::from_bits(bits.next().unwrap_or_default()));
        let (sin, cos) = sincosf(&x);
        let (other_sin, other_cos) = sincosf(&x.map(|x| -x));
        assert!(sin.map(|s| (-s).to_bits()) == other_sin.map(f32::to_bits));
        assert!(cos.map(f32::to_bits) == other_cos.map(f32::to_bits));
        for (x, (sin, cos)) in x.into_iter().zip(sin.into_iter().zip(cos)) {
            let (true_sin, true_cos) = libm::sincos(x.into());
            let error = |result: f32, exact: f64| {
                let near = (exact as f32).abs();
                let size = f64::from(near.next_up()) - f64::from(near);
                // Where rounding to f32 reaches the next power of two, an ulp below is half of it.
                let below = f64::from(near) > exact.abs() && near.to_bits().is_multiple_of(1 << 23);
                let size = if below { size / 2.0 } else { size };
                (f64::from(result) - exact).abs() / size
            };
            worst.add(x.into(), error(sin, true_sin), error(cos, true_cos));
        }
    }
    worst.is_as_proved("f32");
}

#[test]
fn some_doubles() {
    measure_doubles(40_000, 1);
}

#[test]
fn some_singles() {
    singles((0..=LARGEST_F32.to_bits()).step_by(4001));
}

#[test]
#[ignore = "a minute with --release: by hand"]
fn by_hand_a_hundred_million_doubles() {
    measure_doubles(60_000_000, 100);
}

#[test]
#[ignore = "a minute with --release: by hand"]
fn by_hand_every_single_in_range() {
    singles(0..=LARGEST_F32.to_bits());
}

#[test]
fn against_the_wide_float() {
    let reference = Reference::new();
    let hard = near_quarters(0).step_by(40).chain(within(LARGEST, 300, 4));
    let hardest = 29.0 * core::f64::consts::FRAC_PI_2;
    for x in hard.chain(within(1.0, 300, 5)).chain([hardest, 0.0, 1e-20]) {
        let (sin, cos) = reference.sincos(x);
        let exact = Wide::sincos_of(x).unwrap();
        for (pair, exact) in [(sin, exact.sin), (cos, exact.cos)] {
            let part = |x: f64| Wide::from_f64(x).unwrap();
            let error = part(pair.0).add(&part(pair.1)).sub(&exact).magnitude();
            assert!(error <= ulp(pair.0) * (-16f64).exp2(), "{x:e}: {error:e}");
        }
    }
}
