//! Generated functions against the generic recursion, and against that recursion in
//! symbols, unsimplified; f64 against f32; in one run: read the ratios, the times are
//! this machine's.
//!
//! `cargo bench --bench dynamics`

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use dalembert_generated::{panda, puma560, puma560_f32, stanford, ur10};
use dalembert_model::read;
use dalembert_model::reference::Reference;
use nalgebra::DVector;

#[rustfmt::skip] // As the generator writes it.
#[path = "generated/recursion.rs"]
mod symbolic;

/// The generic runtime of a checked-in robot.
fn reference(name: &str) -> Reference<f64> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = root
        .join("generated/robots")
        .join(name)
        .with_extension("toml");
    let source = std::fs::read_to_string(file).expect("a checked-in robot");
    let reading = read::parse(&source, &read::Options::default()).expect("a good robot");
    Reference::from_robot(&reading.robot)
}

/// A state that no constant folds.
fn state<const N: usize>(offset: f64) -> [f64; N] {
    std::array::from_fn(|i| offset + 0.37 * i as f64)
}

macro_rules! inverse_dynamics {
    ($criterion:expr, $robot:ident) => {
        let mut group =
            $criterion.benchmark_group(concat!(stringify!($robot), "/inverse_dynamics"));
        let (q, qd, qdd) = (
            state::<{ $robot::N }>(0.3),
            state::<{ $robot::N }>(-0.5),
            state::<{ $robot::N }>(1.1),
        );
        group.bench_function("generated f64", |b| {
            b.iter(|| $robot::inverse_dynamics(black_box(&q), black_box(&qd), black_box(&qdd)))
        });
        group.bench_function("symbolic recursion f64, unsimplified", |b| {
            b.iter(|| {
                symbolic::$robot::inverse_dynamics(black_box(&q), black_box(&qd), black_box(&qdd))
            })
        });
        let generic = reference(stringify!($robot));
        let [q, qd, qdd] = [q, qd, qdd].map(|x| DVector::from_column_slice(&x));
        group.bench_function("generic recursion f64", |b| {
            b.iter(|| generic.inverse_dynamics(black_box(&q), black_box(&qd), black_box(&qdd)))
        });
        group.finish();
    };
}

fn against_the_recursion(criterion: &mut Criterion) {
    inverse_dynamics!(criterion, puma560);
    inverse_dynamics!(criterion, stanford);
    inverse_dynamics!(criterion, ur10);
    inverse_dynamics!(criterion, panda);
}

/// What sharing D, h and c saves, and what f32 does.
fn variants(criterion: &mut Criterion) {
    let (q, qd, qdd) = (state::<6>(0.3), state::<6>(-0.5), state::<6>(1.1));
    let mut group = criterion.benchmark_group("puma560/variants");
    group.bench_function("manipulator_equation", |b| {
        b.iter(|| puma560::manipulator_equation(black_box(&q), black_box(&qd)))
    });
    group.bench_function("inertia, coriolis, gravity", |b| {
        b.iter(|| {
            let q = black_box(&q);
            let h = puma560::coriolis(q, black_box(&qd));
            (puma560::inertia(q), h, puma560::gravity(q))
        })
    });
    group.bench_function("dynamic_coefficients", |b| {
        b.iter(|| puma560::dynamic_coefficients(black_box(&q)))
    });
    let [q, qd, qdd] = [q, qd, qdd].map(|x| x.map(|x| x as f32));
    group.bench_function("inverse_dynamics f32", |b| {
        b.iter(|| puma560_f32::inverse_dynamics(black_box(&q), black_box(&qd), black_box(&qdd)))
    });
    group.finish();
}

criterion_group!(benches, against_the_recursion, variants);
criterion_main!(benches);
