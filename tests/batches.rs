//! Functions of one state and of columns of states, compiled: of any length, in all vectors, on
//! all cores. The bits are the same.

use std::array::from_fn;

use dalembert::batch::{self, Argument, Function, Slice, Vectors};
use dalembert_model::scalar::field::Points;

#[path = "../benches/generated/puma560_batch.rs"]
mod puma560;
#[path = "../benches/generated/puma560_batch_f32.rs"]
mod puma560_f32;

/// A joint slides, another turns for ever, and both have Coulomb friction, whose root
/// stands where the arithmetic does; a struct, a number and a quotient.
macro_rules! arm {
    ($name:ident, [$($output:tt)*], $($clause:tt)*) => {
        dalembert::dynamics! {
            mod $name = r#"
                name = "arm"
                convention = "standard"
                gravity = [0, -9.81, 0]
                [[joint]]
                kind = "revolute"
                a = 1
                mass = 1
                com = [-0.5, 0, 0]
                inertia = [0, "1/12", "1/12", 0, 0, 0]
                [[joint]]
                kind = "revolute"
                a = 1
                alpha = "pi/2"
                mass = 2
                com = [-0.5, 0, 0]
                inertia = [0, "1/12", "1/12", 0, 0, 0]
                coulomb = 2.5
                coulomb_width = 0.01
                [[joint]]
                kind = "prismatic"
                mass = 1
                com = [0, 0, 0.1]
                inertia = [0.1, 0.1, 0.1, 0, 0, 0]
                viscous = 3
                coulomb = 14
                coulomb_width = "1/300"
            "#;
            outputs: $($output)*;
            batch: on;
            scalar: f64, f32;
            $($clause)*
        }
    };
    ($name:ident, $($clause:tt)*) => {
        arm!(
            $name,
            [inverse_dynamics, gravity, manipulator_equation, kinetic_energy, forward_dynamics],
            $($clause)*
        );
    };
}
arm!(together, sincos: together;);
arm!(alone, sincos: libm;);
arm!(polynomial, sincos: polynomial; sincos_error: 1e-5;);
arm!(fused, fma: on; sincos: together;);
// Arguments of other lengths than the arm has joints, with types of their names and without.
arm!(
    loaded,
    [inverse_dynamics, forward_dynamics_with_wrench],
    sincos: together; parameters: bodies, viscous, payload, gravity;
);
// Bundles: structs of the user's, with matrices of other shapes, a number and quotients.
arm!(
    bundled,
    [
        servo = inverse_dynamics + jacobian + forward_kinematics,
        task = forward_dynamics + kinetic_energy + inertia
    ],
    sincos: together;
);

/// Equal bits, or NaN in both, whichever NaN it is. Doubles have every single number.
fn same<T: Copy + Into<f64>>(one: &T, other: &T) -> bool {
    let (one, other): (f64, f64) = ((*one).into(), (*other).into());
    one.to_bits() == other.to_bits() || (one.is_nan() && other.is_nan())
}

/// Every ninth is unusual: an angle beyond the polynomials, a zero, an infinity or NaN.
fn numbers(count: usize, seed: u64) -> Vec<f64> {
    let (no, most) = (f64::NAN, f64::INFINITY);
    let odd = [1e5, -0.0, most, no, 1e300, -most, 5e-324, 1e-40];
    let mut points = Points::new(seed);
    let mut next = |index: usize| match index % 9 {
        8 => odd[(points.bits() >> 32) as usize % odd.len()],
        _ => 3.0 * points.unit(),
    };
    (0..count).map(&mut next).collect()
}

fn columns<T: Copy, const N: usize>(states: &[[T; N]]) -> [Vec<T>; N] {
    from_fn(|i| states.iter().map(|state| state[i]).collect())
}

fn array<T: std::fmt::Debug, const M: usize>(numbers: Vec<T>) -> [T; M] {
    numbers.try_into().unwrap()
}

/// Each line ends in the numbers of a result in the order of its text.
macro_rules! check {
    ($module:ident, $single:ident; $($function:ident $columns:ident $kind:ident
      $arguments:tt $result:ident => $numbers:expr;)*) => {$(
        check!(@ $module, f64, $function, $columns, $kind, $arguments, $result, $numbers);
        check!(@ $single, f32, $function, $columns, $kind, $arguments, $result, $numbers);
    )*};
    (@ $module:ident, $scalar:ty, $function:ident, $columns:ident, $kind:ident,
     [$($argument:ident)*], $result:ident, $numbers:expr) => {{
        type Kind = $module::$kind;
        const N: usize = $module::N;
        const MOST: usize = 2 * 64 + 17;
        let mut seed = 1;
        $(
            seed += 1;
            let values = numbers(MOST * N, seed);
            let $argument: Vec<[$scalar; N]> =
                (0..MOST).map(|k| from_fn(|i| values[k * N + i] as $scalar)).collect();
        )*
        let single = |k: usize| -> Vec<$scalar> {
            let found = $module::$function($(&$argument[k]),*);
            let $result = &found;
            $numbers
        };
        let single: Vec<Vec<$scalar>> = (0..MOST).map(single).collect();
        // Some of it are numbers, or nothing would be compared.
        assert!(single.iter().any(|numbers| numbers.iter().all(|x| x.is_finite())));
        let of = |vectors: Option<Vectors>, count: usize| -> Vec<Vec<$scalar>> {
            $(let $argument = columns(&$argument[..count]);
              let $argument = $argument.each_ref().map(|column| column.as_slice());)*
            let mut found = array(single[0].iter().map(|_| vec![0.0; count]).collect());
            let mut slices = found.each_mut().map(|column| column.as_mut_slice());
            match vectors {
                None => $module::$columns($(&$argument,)* &mut slices),
                Some(vectors) => {
                    let arguments = [$(Argument::Columns(&$argument)),*];
                    batch::columns_in::<Kind, _, _, _, 0>(vectors, &arguments, &mut slices)
                }
            }
            .unwrap();
            (0..count).map(|k| found.iter().map(|column| column[k]).collect()).collect()
        };

        // Where products are fused, batches have sines of their own: those of the portable vectors,
        // of numbers one after the other, next to those of a state alone.
        let mut many = single.clone();
        if <Kind as Function<_, _, _>>::FUSED {
            many = of(Some(Vectors::Portable), MOST);
            for (k, (single, many)) in single.iter().zip(&many).enumerate() {
                let is_usual = [$($argument[k]),*].as_flattened().iter().all(|x| x.abs() < 4.0);
                let most = single.iter().fold(1.0, |most: $scalar, x| most.max(x.abs()));
                for (single, many) in single.iter().zip(many) {
                    let near = (single - many).abs() <= 500.0 * <$scalar>::EPSILON * most;
                    assert!(near || !is_usual, "{single} {many}");
                }
            }
        }
        for count in (0..=33).chain([63, 64, 65, 127, 128, MOST]) {
            let all = [Vectors::Portable, Vectors::Avx2, Vectors::Avx512].map(Some);
            for vectors in all.into_iter().chain([None]) {
                for (found, expected) in of(vectors, count).iter().zip(&many) {
                    assert!(found.iter().zip(expected).all(|(a, b)| same(a, b)), "{count}");
                }
            }
        }
    }};
}

macro_rules! check_dynamics {
    ($module:ident, $single:ident) => {
        check! { $module, $single;
            inverse_dynamics inverse_dynamics_columns InverseDynamicsBatch
                [q qd qdd] x => x.to_vec();
            forward_dynamics forward_dynamics_columns ForwardDynamicsBatch
                [q qd tau] x => x.to_vec();
        }
    };
}

macro_rules! check_arm {
    ($module:ident, $single:ident) => {
        check_dynamics!($module, $single);
        check! { $module, $single;
            gravity gravity_columns GravityBatch [q] x => x.to_vec();
            kinetic_energy kinetic_energy_columns KineticEnergyBatch [q qd] x => vec![*x];
            manipulator_equation manipulator_equation_columns ManipulatorEquationBatch
                [q qd] x => [x.d.as_flattened(), &x.h, &x.c].concat();
        }
    };
}

#[test]
fn bundles_of_many_states() {
    check! { bundled, bundled_f32;
        servo servo_columns ServoBatch [q qd qdd] x =>
            [&x.tau[..], x.jacobian.as_flattened(), x.pose.as_flattened()].concat();
        task task_columns TaskBatch [q qd tau] x =>
            [&x.qdd[..], &[x.kinetic], x.d.as_flattened()].concat();
    }
}

macro_rules! tests {
    ($($name:ident: $check:ident $module:ident $single:ident;)*) => {$(
        #[test]
        fn $name() {
            $check!($module, $single);
        }
    )*};
}
// Products are fused also where the processor has no instruction for both.
tests! {
    sines_of_all_angles_together: check_arm together together_f32;
    sines_of_libm: check_arm alone alone_f32;
    fused_products: check_arm fused fused_f32;
    sines_by_polynomials: check_arm polynomial polynomial_f32;
    a_whole_arm: check_dynamics puma560 puma560_f32;
}

#[test]
fn slices_of_different_lengths_are_refused() {
    let (column, short) = ([0.5; 5], [0.5; 2]);
    let q = [&column[..]; 3];
    let mut results = [[7.0; 5]; 3];
    let mut slices = results.each_mut().map(|x| x.as_mut_slice());
    let qd = [&column[..], &column, &short];
    let error = together::inverse_dynamics_columns(&q, &qd, &q, &mut slices).unwrap_err();
    let (slice, found, expected) = (error.slice, error.found, error.expected);
    assert_eq!((slice, found, expected), (Slice::Entry(2, 3), 2, 5));
    let text = "entry 3 of argument 2 has 2 states, the results have 5";
    assert_eq!(error.to_string(), text);
    slices[1] = &mut [];
    let error = together::inverse_dynamics_columns(&q, &q, &q, &mut slices).unwrap_err();
    let text = "column 2 of the results has 0 states, the first has 5";
    assert_eq!(error.to_string(), text);
    assert_eq!(results, [[7.0; 5]; 3]);
}

/// Halves of halves: who computes a state does not matter.
#[test]
fn all_cores_have_the_same_bits() {
    for count in [0, 1, 8192, 8193, 20_000] {
        let values = numbers(3 * count, 11);
        let q: Vec<[f64; 3]> = (0..count).map(|k| from_fn(|i| values[3 * k + i])).collect();
        let positions = columns(&q);
        let q = positions.each_ref().map(|column| column.as_slice());
        let mut one = [(); 3].map(|()| vec![0.0; count]);
        let mut slices = one.each_mut().map(|column| column.as_mut_slice());
        together::inverse_dynamics_columns(&q, &q, &q, &mut slices).unwrap();
        let mut parallel = [(); 3].map(|()| vec![1.0; count]);
        let mut slices = parallel.each_mut().map(|column| column.as_mut_slice());
        type Kind = together::InverseDynamicsBatch;
        let arguments = [Argument::Columns(&q); 3];
        batch::parallel::columns::<Kind, 9, 3, _, 0>(&arguments, &mut slices).unwrap();
        let mut pairs = one.iter().flatten().zip(parallel.iter().flatten());
        assert!(pairs.all(|(one, parallel)| same(one, parallel)), "{count}");
    }
}

/// Compares batches with single calls: each state has its body, payload and gravity.
macro_rules! loads {
    ($module:ident, $scalar:ty, $count:expr) => {{
        let count: usize = $count;
        let mut points = Points::new(5);
        let mut unit = || points.unit() as $scalar;
        let states: Vec<[[$scalar; 3]; 3]> = (0..count)
            .map(|_| from_fn(|_| from_fn(|_| 3.0 * unit())))
            .collect();
        let load = |k: usize| {
            let mass = 1.0 + k as $scalar;
            let inertia = [0.3, 0.4, 0.5, 0.0, 0.01, 0.0];
            let body = $module::Body::new(mass, [0.1, 0.0, -0.2], inertia).unwrap();
            let bodies = $module::BODIES.with(k % 3, body);
            let payload = $module::Payload::new(0.1 * mass, [0.2, 0.1, 0.3], inertia).unwrap();
            $module::load(&payload, &bodies, &[0.1 * mass, 2.0, 3.0])
        };
        let loads: Vec<$module::Load> = (0..count).map(load).collect();
        let gravity = |k: usize| $module::Gravity([k as $scalar, 1.0, -9.81]);
        let gravity: Vec<$module::Gravity> = (0..count).map(gravity).collect();
        let wrenches: Vec<[$scalar; 6]> = (0..count).map(|_| from_fn(|_| 9.0 * unit())).collect();
        let [q, qd, qdd] =
            [0, 1, 2].map(|i| columns(&states.iter().map(|x| x[i]).collect::<Vec<_>>()));
        let [q, qd, qdd] = [&q, &qd, &qdd].map(|columns| columns.each_ref().map(Vec::as_slice));
        let by_entry = columns(&wrenches);
        let wrench = by_entry.each_ref().map(Vec::as_slice);
        for (loads, gravity) in [
            (&loads[..], &gravity[..]),
            (&loads[..1], &gravity[..]),
            (&loads[1.min(count - 1)..][..1], &gravity[..1]),
        ] {
            let mut found = [(); 3].map(|()| vec![0.0; count]);
            let mut slices = found.each_mut().map(Vec::as_mut_slice);
            $module::inverse_dynamics_columns(&q, &qd, &qdd, gravity, loads, &mut slices).unwrap();
            let at = |k: usize| (&gravity[k % gravity.len()], &loads[k % loads.len()]);
            for (k, [q, qd, qdd]) in states.iter().enumerate() {
                let (gravity, load) = at(k);
                let tau = $module::inverse_dynamics(q, qd, qdd, gravity, load);
                assert!((0..3).all(|i| same(&tau[i], &found[i][k])), "{k}");
            }
            let mut slices = found.each_mut().map(Vec::as_mut_slice);
            $module::forward_dynamics_with_wrench_columns(
                &q,
                &qd,
                &qdd,
                gravity,
                loads,
                &wrench,
                &mut slices,
            )
            .unwrap();
            for (k, [q, qd, tau]) in states.iter().enumerate() {
                let (gravity, load) = at(k);
                let qdd =
                    $module::forward_dynamics_with_wrench(q, qd, tau, gravity, load, &wrenches[k]);
                assert!((0..3).all(|i| same(&qdd[i], &found[i][k])), "{k}");
            }
        }
    }};
}

#[test]
fn loads_are_of_a_state_or_of_all() {
    for count in [1, 2, 64, 131] {
        loads!(loaded, f64, count);
        loads!(loaded_f32, f32, count);
    }
}

dalembert::dynamics! {
    mod swimmer = r#"
        name = "swimmer"
        gravity = [0, 0, -9.81]
        [[joint]]
        kind = "floating"
        mass = 5
        com = [0.1, 0, 0]
        inertia = [0.1, 0.2, 0.3, 0, 0, 0]
        [[joint]]
        kind = "revolute"
        placement = { xyz = [0.3, 0, 0], rpy = ["pi/2", 0, 0] }
        axis = [0, 0, 1]
        mass = 1
        com = [0.2, 0, 0]
        inertia = [0.01, 0.02, 0.03, 0, 0, 0]
    "#;
    outputs: inverse_dynamics;
    batch: on;
}

/// If the base floats, velocities have six entries more than positions, and gravity is an argument.
#[test]
fn bases_that_float_have_batches() {
    const COUNT: usize = 70;
    let numbers = numbers(15 * COUNT, 3);
    let state = |k: usize| -> [f64; 15] { from_fn(|i| numbers[15 * k + i]) };
    let states: Vec<[f64; 15]> = (0..COUNT).map(state).collect();
    let by_entry = columns(&states);
    let slices = by_entry.each_ref().map(Vec::as_slice);
    let (q, rest) = slices.split_first_chunk().unwrap();
    let (qd, qdd) = rest.split_at(7);
    let mut results = [(); 7].map(|()| vec![0.0; COUNT]);
    let mut slices = results.each_mut().map(Vec::as_mut_slice);
    let gravity = swimmer::Gravity([0.0, 1.0, -9.81]);
    let [qd, qdd] = [qd, qdd].map(|part| part.first_chunk().unwrap());
    swimmer::inverse_dynamics_columns(q, qd, qdd, &[gravity], &mut slices).unwrap();
    for (k, state) in states.iter().enumerate() {
        let [qd, qdd] = [1, 8].map(|from| *state[from..].first_chunk().unwrap());
        let tau = swimmer::inverse_dynamics(&[state[0]], &qd, &qdd, &gravity);
        assert!((0..7).all(|i| same(&tau[i], &results[i][k])), "{k}");
    }
}
