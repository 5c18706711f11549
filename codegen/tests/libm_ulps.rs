//! Every bound takes this for granted of libm: sine and cosine are within one ulp, here of the
//! version that is locked. Samples, not a proof; hard cases among them.

use dalembert_codegen::workspace::Random;
use dalembert_model::number::Wide;
use dalembert_model::scalar::{Scalar, SinCosPair};

use crate::support::text;

/// The version that the bounds were tested with; the README has it, too.
const TESTED: &str = "0.2.16";

#[test]
fn the_locked_version_is_the_tested_one() {
    let lock = text("../Cargo.lock");
    let locked = lock.split_once("name = \"libm\"\nversion = \"").unwrap().1;
    assert!(locked.starts_with(&format!("{TESTED}\"")));
}

fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

fn ulps(approx: f64, exact: &Wide) -> f64 {
    let error = Wide::from_f64(approx).unwrap().sub(exact);
    error.magnitude() / ulp(exact.to_f64())
}

fn worst(x: f64) -> f64 {
    let SinCosPair { sin, cos } = Wide::sincos_of(x).unwrap();
    let both = libm::sincos(x);
    let sines = ulps(libm::sin(x), &sin).max(ulps(both.0, &sin));
    let cosines = ulps(libm::cos(x), &cos).max(ulps(both.1, &cos));
    sines.max(cosines)
}

fn is_within_an_ulp(what: &str, points: impl Iterator<Item = f64>) {
    let mut most = (0.0, 0.0);
    for x in points {
        let error = worst(x);
        assert!(error <= 1.0, "{what}: {error} ulps at {x:e}");
        if error > most.0 {
            most = (error, x);
        }
    }
    println!("{what}: {:.4} ulps at {:e}", most.0, most.1);
}

#[test]
fn doubles_anywhere() {
    let mut random = Random::new(0x11b);
    let turns = |random: &mut Random, most: f64| (2.0 * random.unit() - 1.0) * most;
    is_within_an_ulp("a turn", (0..6000).map(|_| turns(&mut random, 3.15)));
    is_within_an_ulp("many turns", (0..3000).map(|_| turns(&mut random, 1e6)));
    let any = |_| 10f64.powf(616.0 * random.unit() - 308.0);
    is_within_an_ulp("any size", (0..3000).map(any));
}

/// The reduced argument is small near multiples of π/4, or changes its interval.
#[test]
fn doubles_where_it_is_hard() {
    let quarters = (1..2000).flat_map(|k| {
        let x = f64::from(k) * std::f64::consts::FRAC_PI_4;
        [x.next_down(), x, x.next_up()]
    });
    is_within_an_ulp("quarters", quarters);
    let nearest = 6_381_956_970_095_103.0 * 2f64.powi(797);
    let small = [f64::MIN_POSITIVE, 5e-324, 0.0, 1e-9, 2f64.powi(-27)];
    let hard = [nearest, -nearest, f64::MAX].into_iter().chain(small);
    is_within_an_ulp("hard cases", hard);
}

/// Double precision is exact enough to compare with.
#[test]
fn singles_everywhere() {
    let mut most = 0f64;
    for bits in (0..f32::INFINITY.to_bits()).step_by(1009) {
        let x = f32::from_bits(bits);
        let (exact, both) = (libm::sincos(f64::from(x)), libm::sincosf(x));
        let sines = [libm::sinf(x), both.0].map(|sine| (sine, exact.0));
        let cosines = [libm::cosf(x), both.1].map(|cosine| (cosine, exact.1));
        for (approx, exact) in sines.into_iter().chain(cosines) {
            let near = (exact as f32).abs();
            let ulp = f64::from(near.next_up()) - f64::from(near);
            let error = (f64::from(approx) - exact).abs() / ulp;
            assert!(error <= 1.0, "{error} ulps at {x:e}");
            most = most.max(error);
        }
    }
    println!("singles: {most:.4} ulps");
}
