//! One program with four kinds of sines in one run: libm's, std's, those of all
//! angles together, and polynomials that a certificate admits at 1e-6 of the actuators' limits.
//! Read the ratios, the times are this machine's. The first line has those of
//! rounds in turn, which hold on a busy machine too.
//!
//! `cargo bench --bench sines`: polynomials take 0.53 of libm's time, all angles
//! together 0.69, std's sines 1.24 (x86-64; the 0.69 from the same functions in a loop of
//! its own, not yet from this bench).
//!
//! Then six angles' sines and cosines by `dalembert_sines`, of libm's time for
//! the same: f64 0.29 and f32 0.20 in a plain build, 0.22 and 0.19 with
//! `-C target-cpu=native` (AVX-512).

use std::hint::black_box;
use std::time::Instant;

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

/// Rounds in which each variant runs once.
const ROUNDS: usize = 301;

/// Each variant's time over that of libm's sines in the same round, the median:
/// what slows the machine down for a while slows all of them down.
fn ratios(states: &[State]) {
    let mut rounds = vec![Vec::new(); 3];
    for _ in 0..ROUNDS {
        macro_rules! time {
            ($name:ident) => {{
                let start = Instant::now();
                for [q, qd, qdd] in black_box(states) {
                    black_box(variants::$name::inverse_dynamics(q, qd, qdd));
                }
                start.elapsed().as_secs_f64()
            }};
        }
        let libm = time!(libm_sines);
        rounds[0].push(time!(std_sines) / libm);
        rounds[1].push(time!(together) / libm);
        rounds[2].push(time!(polynomials) / libm);
    }
    let [std, together, polynomials] = [0, 1, 2].map(|variant| {
        rounds[variant].sort_by(f64::total_cmp);
        rounds[variant][ROUNDS / 2]
    });
    println!("of libm's time: std {std:.3}, together {together:.3}, polynomials {polynomials:.3}");
}

/// Six sines and cosines together, of libm's time: f64 and f32.
fn together(states: &[State]) {
    macro_rules! ratio {
        ($scalar:ty, $together:path, $alone:path) => {{
            #[inline(never)]
            fn own(angles: &[$scalar; 6]) -> ([$scalar; 6], [$scalar; 6]) {
                $together(angles)
            }
            #[inline(never)]
            fn libms(angles: &[$scalar; 6]) -> ([$scalar; 6], [$scalar; 6]) {
                let (mut sines, mut cosines) = ([0.0; 6], [0.0; 6]);
                for ((angle, sin), cos) in angles.iter().zip(&mut sines).zip(&mut cosines) {
                    (*sin, *cos) = $alone(*angle);
                }
                (sines, cosines)
            }
            let angles: Vec<_> = states
                .iter()
                .map(|[q, ..]| q.map(|x| x as $scalar))
                .collect();
            let mut rounds = Vec::new();
            for _ in 0..ROUNDS {
                let start = Instant::now();
                for q in black_box(&angles) {
                    black_box(libms(q));
                }
                let libm = start.elapsed().as_secs_f64();
                let start = Instant::now();
                for q in black_box(&angles) {
                    black_box(own(q));
                }
                rounds.push(start.elapsed().as_secs_f64() / libm);
            }
            rounds.sort_by(f64::total_cmp);
            rounds[ROUNDS / 2]
        }};
    }
    let double = ratio!(f64, dalembert_sines::sincos, libm::sincos);
    let single = ratio!(f32, dalembert_sines::sincosf, libm::sincosf);
    println!("six angles together, of libm's time: f64 {double:.3}, f32 {single:.3}");
}

fn sines(criterion: &mut Criterion) {
    let states = states();
    ratios(&states);
    together(&states);
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
    variant!(together);
    variant!(polynomials);
    group.finish();
}

criterion_group!(benches, sines);
criterion_main!(benches);
