//! One program with four kinds of sines: libm's, std's, those of all angles together,
//! and polynomials that a certificate admits at 1e-6 of the actuators' limits. Then six
//! angles' sines and cosines by `dalembert_sines`, against libm's for the same. Read the
//! ratios, the times are this machine's.
//!
//! `cargo bench --bench sines`

mod rounds;

use std::hint::black_box;

use dalembert_model::scalar::field::Points;
use rounds::Rounds;

#[rustfmt::skip] // As the generator writes it.
#[path = "generated/puma560_sines.rs"]
mod variants;

pub mod std_math {
    #[inline]
    pub fn sincos(x: f64) -> (f64, f64) {
        x.sin_cos()
    }
    #[inline]
    pub fn sin(x: f64) -> f64 {
        x.sin()
    }
    #[inline]
    pub fn cos(x: f64) -> f64 {
        x.cos()
    }
}

/// So many that no branch of a sine is learnt by heart: a processor remembers a thousand states.
const STATES: usize = 1 << 15;

type State = [[f64; 6]; 3];

fn states() -> Vec<State> {
    let mut points = Points::new(1);
    let reach = [
        [std::f64::consts::PI; 6],
        [2.0, 2.0, 2.0, 5.0, 5.0, 5.0],
        [10.0, 10.0, 10.0, 30.0, 30.0, 30.0],
    ];
    (0..STATES)
        .map(|_| reach.map(|row| row.map(|most| most * points.unit())))
        .collect()
}

const ROUNDS: usize = 301;

fn torques(states: &[State]) {
    let mut rounds = Rounds::of(STATES);
    for _ in 0..ROUNDS {
        macro_rules! time {
            ($($name:ident),*) => {$(
                rounds.time(stringify!($name), || {
                    for [q, qd, qdd] in black_box(states) {
                        black_box(variants::$name::inverse_dynamics(q, qd, qdd));
                    }
                });
            )*};
        }
        time!(libm_sines, std_sines, together, polynomials);
    }
    rounds.print("puma560 inverse_dynamics f64, by its sines");
}

fn six_angles(states: &[State]) {
    let single: Vec<[f32; 6]> = states.iter().map(|[q, ..]| q.map(|x| x as f32)).collect();
    let [mut double_rounds, mut single_rounds] = [(); 2].map(|()| Rounds::of(STATES));
    for _ in 0..ROUNDS {
        double_rounds.time("libm", || {
            for [q, ..] in black_box(states) {
                black_box(q.map(libm::sincos));
            }
        });
        double_rounds.time("together", || {
            for [q, ..] in black_box(states) {
                black_box(dalembert_sines::sincos(q));
            }
        });
        single_rounds.time("libm", || {
            for q in black_box(&single) {
                black_box(q.map(libm::sincosf));
            }
        });
        single_rounds.time("together", || {
            for q in black_box(&single) {
                black_box(dalembert_sines::sincosf(q));
            }
        });
    }
    double_rounds.print("six angles f64");
    single_rounds.print("six angles f32");
}

fn main() {
    let states = states();
    torques(&states);
    six_angles(&states);
}
