//! One function by all its entries in one run, f64 and f32: a state a call, the
//! same with sines given, lanes, batches of 1024 states; in the vectors that the
//! processor has, in those of AVX2 and in those of a plain build. Read the ratios,
//! the times are this machine's.
//!
//! `cargo bench --bench batch`

mod rounds;

use std::hint::black_box;

use dalembert::batch::{Function, columns_in_lanes, states_in_lanes};

#[rustfmt::skip] // As the generator writes it.
#[path = "generated/puma560_batch.rs"]
mod generated;
use generated::{puma560, puma560_f32};
use rounds::Rounds;

/// States a batch.
const STATES: usize = 1024;

/// Rounds in which each variant runs once.
const ROUNDS: usize = 1001;

/// Seeded states inside ±π, arguments in the order of the function.
fn states() -> [Vec<[f64; 6]>; 3] {
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    let mut unit = || {
        bits = bits
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    [(); 3].map(|()| {
        let state = |_| [0.0; 6].map(|_: f64| std::f64::consts::PI * unit());
        (0..STATES).map(state).collect()
    })
}

/// A function over states, to be compiled for chosen vectors.
struct States<'a, F: Function<3, 6, 6>, const L: usize>(
    [&'a [[F::Scalar; 6]]; 3],
    &'a mut [F::State],
);

impl<F: Function<3, 6, 6>, const L: usize> pulp::NullaryFnOnce for States<'_, F, L> {
    type Output = bool;
    #[inline(always)]
    fn call(self) -> bool {
        states_in_lanes::<F, L, 3, 6, 6>(self.0, self.1).is_ok()
    }
}

struct Columns<'a, 'r, F: Function<3, 6, 6>, const L: usize>(
    [&'a [&'a [F::Scalar]; 6]; 3],
    &'a mut [&'r mut [F::Scalar]; 6],
);

impl<F: Function<3, 6, 6>, const L: usize> pulp::NullaryFnOnce for Columns<'_, '_, F, L> {
    type Output = bool;
    #[inline(always)]
    fn call(self) -> bool {
        columns_in_lanes::<F, L, 3, 6, 6>(self.0, self.1).is_ok()
    }
}

/// Runs what AVX2 can do by it; `None` where there is none.
#[cfg(target_arch = "x86_64")]
fn with_avx2<F: pulp::NullaryFnOnce>(f: F) -> Option<F::Output> {
    pulp::x86::V3::try_new().map(|avx2| avx2.vectorize(f))
}

#[cfg(not(target_arch = "x86_64"))]
fn with_avx2<F: pulp::NullaryFnOnce>(_: F) -> Option<F::Output> {
    None
}

macro_rules! bench {
    ($what:literal, $module:ident, $scalar:ty, $function:ident, $given:ident, $in_lanes:ident,
     $batch:ident, $columns:ident, $kind:ident, $avx2:literal) => {{
        type Kind = $module::$kind;
        let all = states().map(|states| {
            let cast = |state: [f64; 6]| state.map(|x| x as $scalar);
            states.into_iter().map(cast).collect::<Vec<_>>()
        });
        let [a, b, c] = [&all[0][..], &all[1][..], &all[2][..]];
        let columns = all.each_ref().map(|states| {
            [0, 1, 2, 3, 4, 5].map(|i| states.iter().map(|x| x[i]).collect::<Vec<_>>())
        });
        let columns = columns
            .each_ref()
            .map(|c| c.each_ref().map(|column| &column[..]));
        let sines: Vec<_> = a
            .iter()
            .map(|q| (q.map(<$scalar>::sin), q.map(<$scalar>::cos)))
            .collect();
        let single = |k: usize| $module::$function(&a[k], &b[k], &c[k]);
        let expected: Vec<[$scalar; 6]> = (0..STATES).map(single).collect();
        let mut found = vec![[0.0; 6]; STATES];
        let mut in_columns = [(); 6].map(|()| vec![0.0; STATES]);
        let mut rounds = Rounds::of(STATES);
        for _ in 0..ROUNDS {
            rounds.time("a call a state", || {
                for k in 0..STATES {
                    black_box($module::$function(black_box(&a[k]), &b[k], &c[k]));
                }
            });
            rounds.time("sines given", || {
                for (k, (sin, cos)) in sines.iter().enumerate() {
                    black_box($module::$given(black_box(&a[k]), &b[k], &c[k], sin, cos));
                }
            });
            rounds.time("8 lanes, plain", || {
                let lanes = |i: usize, k: usize| -> [[$scalar; 8]; 6] {
                    columns[i].map(|column| *column[k..].first_chunk().unwrap_or(&[0.0; 8]))
                };
                for k in (0..STATES).step_by(8) {
                    black_box($module::$in_lanes(&lanes(0, k), &lanes(1, k), &lanes(2, k)));
                }
            });
            rounds.time("batch", || {
                assert!($module::$batch(black_box(a), b, c, &mut found).is_ok());
            });
            assert!(found == expected);
            rounds.time("columns", || {
                let mut slices = in_columns.each_mut().map(|column| &mut column[..]);
                let [a, b, c] = black_box(&columns);
                assert!($module::$columns(a, b, c, &mut slices).is_ok());
            });
            rounds.time("batch, AVX2", || {
                with_avx2(States::<Kind, $avx2>(black_box([a, b, c]), &mut found));
            });
            assert!(found == expected);
            rounds.time("columns, AVX2", || {
                let mut slices = in_columns.each_mut().map(|column| &mut column[..]);
                with_avx2(Columns::<Kind, $avx2>(
                    black_box(columns.each_ref()),
                    &mut slices,
                ));
            });
            rounds.time("batch, plain", || {
                assert!(
                    states_in_lanes::<Kind, 4, 3, 6, 6>(black_box([a, b, c]), &mut found).is_ok()
                );
            });
            rounds.time("columns, plain", || {
                let mut slices = in_columns.each_mut().map(|column| &mut column[..]);
                let columns = black_box(columns.each_ref());
                assert!(columns_in_lanes::<Kind, 4, 3, 6, 6>(columns, &mut slices).is_ok());
            });
            for (k, expected) in expected.iter().enumerate() {
                assert!(in_columns.each_ref().map(|column| column[k]) == *expected);
            }
        }
        rounds.print($what);
    }};
}

fn main() {
    bench!(
        "puma560 inverse_dynamics f64",
        puma560,
        f64,
        inverse_dynamics,
        inverse_dynamics_with_sincos,
        inverse_dynamics_lanes,
        inverse_dynamics_batch,
        inverse_dynamics_columns,
        InverseDynamicsBatch,
        4
    );
    bench!(
        "puma560 inverse_dynamics f32",
        puma560_f32,
        f32,
        inverse_dynamics,
        inverse_dynamics_with_sincos,
        inverse_dynamics_lanes,
        inverse_dynamics_batch,
        inverse_dynamics_columns,
        InverseDynamicsBatch,
        8
    );
    bench!(
        "puma560 forward_dynamics f64",
        puma560,
        f64,
        forward_dynamics,
        forward_dynamics_with_sincos,
        forward_dynamics_lanes,
        forward_dynamics_batch,
        forward_dynamics_columns,
        ForwardDynamicsBatch,
        4
    );
    bench!(
        "puma560 forward_dynamics f32",
        puma560_f32,
        f32,
        forward_dynamics,
        forward_dynamics_with_sincos,
        forward_dynamics_lanes,
        forward_dynamics_batch,
        forward_dynamics_columns,
        ForwardDynamicsBatch,
        8
    );
}
