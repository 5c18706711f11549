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

fn time<S, R>(rounds: &mut Rounds, name: &'static str, states: &[S], run: impl Fn(&S) -> R) {
    rounds.time(name, || {
        for state in black_box(states) {
            black_box(run(state));
        }
    });
}

fn torques(states: &[State]) {
    let mut rounds = Rounds::of(STATES);
    for _ in 0..ROUNDS {
        macro_rules! time {
            ($($name:ident),*) => {$(
                time(&mut rounds, stringify!($name), states, |[q, qd, qdd]| {
                    variants::$name::inverse_dynamics(q, qd, qdd)
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
        let sines = dalembert_sines::sincos::<6>;
        time(&mut double_rounds, "libm", states, |[q, ..]| {
            q.map(libm::sincos)
        });
        time(&mut double_rounds, "together", states, |[q, ..]| sines(q));
        time(&mut single_rounds, "libm", &single, |q| {
            q.map(libm::sincosf)
        });
        time(
            &mut single_rounds,
            "together",
            &single,
            dalembert_sines::sincosf,
        );
    }
    double_rounds.print("six angles f64");
    single_rounds.print("six angles f32");
}

fn main() {
    let states = states();
    torques(&states);
    six_angles(&states);
}
