//! One function in one run, f64 and f32: a state a call, and batches of 1024 states in columns, in
//! several vectors; how many times the limit of the processor's ports each takes (`ports.rs`), and
//! what gcc -O3 makes of the same functions in C, if there is a gcc.
//!
//! `cargo bench --bench batch`, or of some functions alone, by parts of their names:
//! `cargo bench --bench batch -- torques`.

mod gcc;
mod ports;
mod rounds;

use std::hint::black_box;

use dalembert::batch::{Argument, Vectors, columns_in, parallel};
use dalembert_model::scalar::field::Points;

#[path = "generated/puma560_batch.rs"]
mod puma560;
#[path = "generated/puma560_batch_f32.rs"]
mod puma560_f32;
use gcc::Gcc;
use rounds::Rounds;

dalembert::dynamics! {
    mod derivatives = "generated/robots/puma560.toml";
    outputs: inverse_dynamics_derivatives, forward_dynamics_derivatives;
    batch: on;
    sincos: together;
    scalar: f64, f32;
}
dalembert::dynamics! {
    mod fused = "generated/robots/puma560.toml";
    outputs: inverse_dynamics, forward_dynamics;
    batch: on;
    sincos: together;
    scalar: f64, f32;
    fma: on;
}

const STATES: usize = 1024;
const MANY: usize = 16_384;
const ROUNDS: usize = 401;

/// Seeded numbers inside ±π in columns, for each argument.
fn numbers(states: usize) -> [[Vec<f64>; 6]; 3] {
    let mut points = Points::new(1);
    let mut column = || -> Vec<f64> {
        let numbers = (0..states).map(|_| std::f64::consts::PI * points.unit());
        numbers.collect()
    };
    std::array::from_fn(|_argument| std::array::from_fn(|_joint| column()))
}

/// Returns the slice that begins at a line of the cache, in a vector that is longer by one line.
fn aligned<T>(column: &mut [T], states: usize) -> &mut [T] {
    let start = column.as_ptr().align_offset(64);
    &mut column[start..start + states]
}

struct Compiled {
    wide: Option<Gcc>,
    narrow: Option<Gcc>,
}

/// One function: its module, scalar and names; the kind and sizes of its batches; its place among
/// the functions of gcc.
macro_rules! bench {
    ($what:literal, $module:ident, $scalar:ty, $function:ident, $kind:ident, $results:literal,
     $clock:ident, $compiled:ident, $place:expr, is_alone: $is_alone:expr) => {{
        type Kind = $module::$kind;
        const LINE: usize = 64 / size_of::<$scalar>();
        let padded = |states: usize| {
            let cast = |column: Vec<f64>| {
                let mut column: Vec<_> = column.into_iter().map(|x| x as $scalar).collect();
                column.extend([0.0; LINE]);
                column
            };
            numbers(states).map(|columns| columns.map(cast))
        };
        let (mut few, mut many) = (padded(STATES), padded(MANY));
        let columns = few
            .each_mut()
            .map(|argument| argument.each_mut().map(|column| &*aligned(column, STATES)));
        let many = many
            .each_mut()
            .map(|argument| argument.each_mut().map(|column| &*aligned(column, MANY)));
        let rows = columns.map(|argument| {
            let row = |k| argument.map(|column| column[k]);
            (0..STATES).map(row).collect::<Vec<_>>()
        });
        let [a, b, c] = rows.each_ref().map(|rows| &rows[..]);
        let mut in_columns: [Vec<$scalar>; $results] =
            std::array::from_fn(|_| vec![0.0; STATES + LINE]);
        let mut rounds = Rounds::of(STATES);
        let mut expected = None;
        for _ in 0..ROUNDS {
            if $is_alone {
                rounds.time("a call a state", || {
                    for k in 0..STATES {
                        black_box($module::$function(black_box(&a[k]), &b[k], &c[k]));
                    }
                });
            }
            for (vectors, name, gcc) in [
                (Vectors::Avx512, "columns, AVX-512", "gcc -O3, AVX-512"),
                (Vectors::Avx2, "columns, AVX2", "gcc -O3, AVX2"),
                (Vectors::Portable, "columns, plain", ""),
            ] {
                if !vectors.are_there() {
                    continue;
                }
                let mut slices = in_columns.each_mut().map(|column| aligned(column, STATES));
                let arguments =
                    black_box(columns.each_ref().map(|column| Argument::Columns(column)));
                rounds.time(name, || {
                    columns_in::<Kind, 18, $results, 4, 0>(vectors, &arguments, &mut slices)
                        .unwrap();
                });
                let program = match vectors {
                    Vectors::Avx512 => &mut $compiled.wide,
                    _ => &mut $compiled.narrow,
                };
                let time = program.as_mut().filter(|_| !gcc.is_empty());
                if let Some(time) = time.and_then(|program| program.run($place)) {
                    rounds.note(gcc, time);
                }
                let results = slices.each_ref().map(|column| column.to_vec());
                let expected = expected.get_or_insert_with(|| results.clone());
                assert!(results == *expected);
            }
        }
        let operations = ports::operations::<Kind, 18, $results, 4>();
        rounds.print_limits($what, |name| {
            let width = match name {
                name if name.ends_with("AVX-512") => 512,
                name if name.ends_with("AVX2") => 256,
                _ => return None,
            };
            ports::limit::<$scalar>(&operations, width, $clock)
        });
        if $is_alone {
            let mut rounds = Rounds::of(MANY);
            let mut in_columns: [Vec<$scalar>; $results] =
                std::array::from_fn(|_| vec![0.0; MANY + LINE]);
            for _ in 0..ROUNDS / 4 {
                let mut slices = in_columns.each_mut().map(|column| aligned(column, MANY));
                let many = many.each_ref().map(|column| Argument::Columns(column));
                rounds.time("one thread", || {
                    let widest = Vectors::widest();
                    columns_in::<Kind, 18, $results, 4, 0>(widest, &many, &mut slices).unwrap();
                });
                rounds.time("all cores", || {
                    parallel::columns::<Kind, 18, $results, 4, 0>(&many, &mut slices).unwrap();
                });
            }
            rounds.print(concat!($what, ", 16384 states in columns"));
        }
    }};
}

fn main() {
    use dalembert_codegen::Function as Output;
    let words = std::env::args().skip(1);
    let chosen: Vec<String> = words.filter(|word| !word.starts_with('-')).collect();
    let is_chosen =
        |name: &str| chosen.is_empty() || chosen.iter().any(|part| name.contains(part.as_str()));
    let clock = ports::clock();
    println!("clock: {clock:.3} GHz");
    let compile = |name: &str, functions: &[Output], fma: bool| {
        // Else gcc makes no vectors of 256 bits.
        let narrow = ["-march=x86-64-v3", "-fno-tree-pre"];
        let wide = ["-march=x86-64-v4", "-mprefer-vector-width=512"];
        let start = |vectors: Vectors, end: &str, options: &[&str]| match vectors.are_there() {
            true => Gcc::start(&format!("{name}_{end}"), functions, fma, options),
            false => None,
        };
        Compiled {
            wide: start(Vectors::Avx512, "avx512", &wide),
            narrow: start(Vectors::Avx2, "avx2", &narrow),
        }
    };
    let dynamics = [Output::InverseDynamics, Output::ForwardDynamics];
    if is_chosen("torques") || is_chosen("accelerations") {
        let mut gcc = compile("batch", &dynamics, false);
        if is_chosen("torques") {
            bench!("torques, f64", puma560, f64, inverse_dynamics,
                InverseDynamicsBatch, 6, clock, gcc, 0, is_alone: true);
            bench!("torques, f32", puma560_f32, f32, inverse_dynamics,
                InverseDynamicsBatch, 6, clock, gcc, 2, is_alone: true);
        }
        if is_chosen("accelerations") {
            bench!("accelerations, f64", puma560, f64, forward_dynamics,
                ForwardDynamicsBatch, 6, clock, gcc, 1, is_alone: true);
            bench!("accelerations, f32", puma560_f32, f32, forward_dynamics,
                ForwardDynamicsBatch, 6, clock, gcc, 3, is_alone: true);
        }
    }
    if is_chosen("fused") {
        let mut gcc = compile("fused", &dynamics, true);
        bench!("fused torques, f64", fused, f64, inverse_dynamics,
            InverseDynamicsBatch, 6, clock, gcc, 0, is_alone: false);
        bench!("fused torques, f32", fused_f32, f32, inverse_dynamics,
            InverseDynamicsBatch, 6, clock, gcc, 2, is_alone: false);
        bench!("fused accelerations, f64", fused, f64, forward_dynamics,
            ForwardDynamicsBatch, 6, clock, gcc, 1, is_alone: false);
        bench!("fused accelerations, f32", fused_f32, f32, forward_dynamics,
            ForwardDynamicsBatch, 6, clock, gcc, 3, is_alone: false);
    }
    if is_chosen("derivatives") {
        let functions = [
            Output::InverseDynamicsDerivatives,
            Output::ForwardDynamicsDerivatives,
        ];
        let mut gcc = compile("derivatives", &functions, false);
        bench!("derivatives of torques, f64", derivatives, f64, inverse_dynamics_derivatives,
            InverseDynamicsDerivativesBatch, 108, clock, gcc, 0, is_alone: false);
        bench!("derivatives of torques, f32", derivatives_f32, f32, inverse_dynamics_derivatives,
            InverseDynamicsDerivativesBatch, 108, clock, gcc, 2, is_alone: false);
        bench!("derivatives of accelerations, f64", derivatives, f64, forward_dynamics_derivatives,
            ForwardDynamicsDerivativesBatch, 108, clock, gcc, 1, is_alone: false);
        bench!("derivatives of accelerations, f32", derivatives_f32, f32, forward_dynamics_derivatives,
            ForwardDynamicsDerivativesBatch, 108, clock, gcc, 3, is_alone: false);
    }
}
