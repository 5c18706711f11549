//! One program with three kinds of sines in one run: libm's, std's, and
//! polynomials that a certificate admits at 1e-6 of the actuators' limits.
//! Read the ratios, the times are this machine's.
//!
//! `cargo bench --bench sines`

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

#[rustfmt::skip] // As the generator writes it.
#[path = "generated/puma560_sines.rs"]
mod variants;

/// std's sine and cosine by libm's names.
pub mod std_math {
    /// Both.
    #[inline]
    pub fn sincos(x: f64) -> (f64, f64) {
        x.sin_cos()
    }
    /// The sine.
    #[inline]
    pub fn sin(x: f64) -> f64 {
        x.sin()
    }
    /// The cosine.
    #[inline]
    pub fn cos(x: f64) -> f64 {
        x.cos()
    }
}

/// So many different states that no branch of a sine is learnt by heart: of a
/// thousand, a processor remembers them all.
const STATES: usize = 1 << 15;

type State = [[f64; 6]; 3];

/// States all over the robot's limits, by a linear congruence.
fn states() -> Vec<State> {
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    let mut unit = || {
        bits = bits
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let reach = [
        [std::f64::consts::PI; 6],
        [2.0, 2.0, 2.0, 5.0, 5.0, 5.0],
        [10.0, 10.0, 10.0, 30.0, 30.0, 30.0],
    ];
    (0..STATES)
        .map(|_| reach.map(|row| row.map(|most| most * unit())))
        .collect()
}

fn sines(criterion: &mut Criterion) {
    let states = states();
    let mut group = criterion.benchmark_group("puma560/inverse_dynamics/sines");
    group.throughput(Throughput::Elements(STATES as u64));
    macro_rules! variant {
        ($name:ident) => {
            group.bench_function(stringify!($name), |b| {
                b.iter(|| {
                    for [q, qd, qdd] in black_box(&states) {
                        black_box(variants::$name::inverse_dynamics(q, qd, qdd));
                    }
                })
            });
        };
    }
    variant!(libm_sines);
    variant!(std_sines);
    variant!(polynomials);
    group.finish();
}

criterion_group!(benches, sines);
criterion_main!(benches);
