//! From slices to vectors and back: every state once, in its place, whatever the
//! length and the vectors.

use dalembert_batch::{Floats, Function, Vector, Vectors, columns, columns_in, states, states_in};

/// x y, x − 2 y and x/y of the first entry of one argument and the second of the
/// other.
struct Three;

impl Function<2, 2, 3, 0> for Three {
    type Scalar = f32;
    type State = (f32, [f32; 2]);

    #[inline(always)]
    fn angles<V: Floats<f32>>(_: &[[V; 2]; 2]) -> [V; 0] {
        []
    }

    #[inline(always)]
    fn vectors<V: Vector<f32>>([x, y]: &[[V; 2]; 2], _: &[V; 0], _: &[V; 0]) -> [V; 3] {
        let (x, y) = (x[0], y[1]);
        [x * y, x - y * 2.0, x / y]
    }

    #[inline(always)]
    fn state([product, difference, quotient]: [f32; 3]) -> (f32, [f32; 2]) {
        (product, [difference, quotient])
    }
}

/// Every operation of a vector on angles of every size, one of which is NaN.
struct Operations;

impl Function<1, 1, 8, 2> for Operations {
    type Scalar = f64;
    type State = [f64; 8];

    #[inline(always)]
    fn angles<V: Floats<f64>>([x]: &[[V; 1]; 1]) -> [V; 2] {
        [x[0], x[0] * 1e4]
    }

    #[inline(always)]
    fn vectors<V: Vector<f64>>([x]: &[[V; 1]; 1], sin: &[V; 2], cos: &[V; 2]) -> [V; 8] {
        let x = x[0];
        let (floor, fraction) = x.both(|x| (x.floor(), x - x.floor()));
        let root = (x * x)
            .sqrt()
            .mul_add(x.all(1.0 / 3.0), -x.each(f64::abs) * (1.0 / 3.0));
        [sin[0], cos[0], sin[1], cos[1], floor, fraction, root, -x]
    }

    #[inline(always)]
    fn state(results: [f64; 8]) -> [f64; 8] {
        results
    }
}

const ALL: [Vectors; 3] = [Vectors::Portable, Vectors::Avx2, Vectors::Avx512];

/// All vectors compute what one number after the other does.
#[test]
fn every_operation_in_all_vectors() {
    let odd = [f64::NAN, f64::INFINITY, -0.0, 8192.1, 5e-324, -1e300];
    let value = |k: usize| match k % 7 {
        6 => odd[k / 7 % odd.len()],
        _ => (k as f64 - 90.0) * 0.0371,
    };
    let x: Vec<[f64; 1]> = (0..200).map(|k| [value(k)]).collect();
    for vectors in ALL {
        for count in [1, 7, 64, 65, 200] {
            let mut found = vec![[0.5; 8]; count];
            states_in::<Operations, 1, 1, 8, 2>(vectors, [&x[..count]], &mut found).unwrap();
            for (found, [x]) in found.iter().zip(&x) {
                let (sin, cos) = dalembert_sines::sincos(&[*x, x * 1e4]);
                let root = f64::mul_add((x * x).sqrt(), 1.0 / 3.0, -x.abs() * (1.0 / 3.0));
                let rest = [x.floor(), x - x.floor(), root, -x];
                let expected = [sin[0], cos[0], sin[1], cos[1]].into_iter().chain(rest);
                for (found, expected) in found.iter().zip(expected) {
                    let same = found.to_bits() == expected.to_bits();
                    assert!(
                        same || (found.is_nan() && expected.is_nan()),
                        "{vectors:?}: {x:e}"
                    );
                }
            }
        }
    }
}

/// Rows that are moved in vectors, four numbers at a time: five to read, six to write.
macro_rules! moved {
    ($kind:ident, $float:ident) => {
        struct $kind;

        impl Function<2, 5, 6, 0> for $kind {
            type Scalar = $float;
            type State = [$float; 6];

            #[inline(always)]
            fn angles<V: Floats<$float>>(_: &[[V; 5]; 2]) -> [V; 0] {
                []
            }

            #[inline(always)]
            fn vectors<V: Vector<$float>>([x, y]: &[[V; 5]; 2], _: &[V; 0], _: &[V; 0]) -> [V; 6] {
                [x[4], y[3], x[2], y[1], x[0], x[1] + y[4]]
            }

            #[inline(always)]
            fn state(results: [$float; 6]) -> [$float; 6] {
                results
            }
        }
    };
}
moved!(MovedDoubles, f64);
moved!(MovedFloats, f32);

/// Every row comes back in its place, whatever the length and the vectors.
#[test]
fn rows_of_every_length_in_all_vectors() {
    macro_rules! check {
        ($kind:ident, $float:ident) => {
            for count in (0..=2 * 64 + 17).chain([1000]) {
                let number = |at: usize| (at as $float).sqrt();
                let row = |k: usize, from: usize| [0, 1, 2, 3, 4].map(|i| number(from + 5 * k + i));
                let x: Vec<[$float; 5]> = (0..count).map(|k| row(k, 0)).collect();
                let y: Vec<[$float; 5]> = (0..count).map(|k| row(k, 7777)).collect();
                for vectors in ALL {
                    // One more behind the results: nobody writes there.
                    let mut found = vec![[-1.0; 6]; count + 1];
                    states_in::<$kind, 2, 5, 6, 0>(vectors, [&x, &y], &mut found[..count]).unwrap();
                    for ((x, y), found) in x.iter().zip(&y).zip(&found) {
                        assert_eq!(*found, [x[4], y[3], x[2], y[1], x[0], x[1] + y[4]]);
                    }
                    assert_eq!(found[count], [-1.0; 6]);
                }
            }
        };
    }
    check!(MovedDoubles, f64);
    check!(MovedFloats, f32);
}

/// Sines in which products are fused, of one angle more than stand side by side.
macro_rules! fused {
    ($kind:ident, $float:ident, $test:ident) => {
        struct $kind;

        impl Function<1, 5, 10, 5> for $kind {
            type Scalar = $float;
            type State = [$float; 10];
            const FUSED: bool = true;

            #[inline(always)]
            fn angles<V: Floats<$float>>([x]: &[[V; 5]; 1]) -> [V; 5] {
                *x
            }

            #[inline(always)]
            fn vectors<V: Vector<$float>>(_: &[[V; 5]; 1], s: &[V; 5], c: &[V; 5]) -> [V; 10] {
                [s[0], s[1], s[2], s[3], s[4], c[0], c[1], c[2], c[3], c[4]]
            }

            #[inline(always)]
            fn state(results: [$float; 10]) -> [$float; 10] {
                results
            }
        }

        /// In all vectors they are those of the same text in numbers, and a library's of angles
        /// that it is not for.
        #[test]
        fn $test() {
            use dalembert_sines::text::{Angle, Fused, Rounded, alone};
            let odd = [$float::NAN, $float::INFINITY, 8192.5, -0.0, 1e-40, -1e30];
            let (mut far, mut others) = (0, 0);
            for vectors in ALL {
                for has_odd in [false, true] {
                    let angle = |k: usize| match k % 97 {
                        96 if has_odd => odd[k / 97 % odd.len()],
                        _ => (k as $float - 500.0) * 0.0371,
                    };
                    let x: Vec<[$float; 5]> = (0..200)
                        .map(|k| [0, 1, 2, 3, 4].map(|i| angle(5 * k + i)))
                        .collect();
                    let mut found = vec![[0.5; 10]; 200];
                    states_in::<$kind, 1, 5, 10, 5>(vectors, [&x], &mut found).unwrap();
                    for (x, found) in x.iter().zip(&found) {
                        for (i, &x) in x.iter().enumerate() {
                            let own = [found[i], found[5 + i]];
                            let pair: [$float; 2] = alone::<$float, Fused>(x).into();
                            let same = own.map($float::to_bits) == pair.map($float::to_bits);
                            assert!(same || x.is_nan() || x.is_infinite(), "{vectors:?}: {x:e}");
                            assert_eq!(own.map($float::is_nan), pair.map($float::is_nan));
                            let rounded: [$float; 2] = alone::<$float, Rounded>(x).into();
                            far += usize::from(x.abs() > $float::LARGEST && x.is_finite());
                            others += usize::from(own != rounded && x.is_finite());
                        }
                    }
                }
            }
            assert!(far > 5 && others > 10, "{far} {others}");
        }
    };
}
fused!(FusedDoubles, f64, fused_sines_are_those_of_their_text);
fused!(
    FusedFloats,
    f32,
    fused_sines_of_floats_are_those_of_their_text
);

fn arguments(count: usize) -> [Vec<[f32; 2]>; 2] {
    let first = (0..count).map(|k| [k as f32 + 0.5, f32::NAN]).collect();
    let second = (0..count).map(|k| [f32::NAN, 3.0 - k as f32]).collect();
    [first, second]
}

fn expected(count: usize) -> Vec<(f32, [f32; 2])> {
    let state = |k: usize| {
        let (x, y) = (k as f32 + 0.5, 3.0 - k as f32);
        (x * y, [x - 2.0 * y, x / y])
    };
    (0..count).map(state).collect()
}

/// By either driver: `$states` and `$columns` take arguments and results.
macro_rules! check {
    ($count:expr, $states:expr, $columns:expr) => {{
        let [first, second] = arguments($count);
        // One more behind the results: nobody writes there.
        let mut results = vec![(7.0, [7.0; 2]); $count + 1];
        $states([&first, &second], &mut results[..$count]).unwrap();
        assert_eq!(results[..$count], expected($count));
        assert_eq!(results[$count], (7.0, [7.0; 2]));

        let column = |from: &[[f32; 2]], i: usize| from.iter().map(|x| x[i]).collect::<Vec<_>>();
        let first = [column(&first, 0), column(&first, 1)];
        let second = [column(&second, 0), column(&second, 1)];
        let first = first.each_ref().map(|column| column.as_slice());
        let second = second.each_ref().map(|column| column.as_slice());
        let mut results = [(); 3].map(|()| vec![7.0; $count + 1]);
        let mut slices = results.each_mut().map(|column| &mut column[..$count]);
        $columns([&first, &second], &mut slices).unwrap();
        for (k, (x, [y, z])) in expected($count).into_iter().enumerate() {
            assert_eq!([results[0][k], results[1][k], results[2][k]], [x, y, z]);
        }
        assert!(results.iter().all(|column| column[$count] == 7.0));
    }};
}

#[test]
fn every_length_in_all_vectors() {
    for vectors in ALL {
        for count in 0..=2 * 64 + 17 {
            check!(
                count,
                |arguments, results| states_in::<Three, 2, 2, 3, 0>(vectors, arguments, results),
                |arguments, results| columns_in::<Three, 2, 2, 3, 0>(vectors, arguments, results)
            );
        }
    }
}

#[test]
fn every_length_as_the_processor_has_it() {
    for count in 0..=67 {
        check!(
            count,
            states::<Three, 2, 2, 3, 0>,
            columns::<Three, 2, 2, 3, 0>
        );
    }
}

#[cfg(feature = "rayon")]
#[test]
fn every_length_on_all_cores() {
    use dalembert_batch::parallel;
    // Tasks begin at 3 MiB, and a state has 28 bytes.
    for count in [0, 1, 112_347, 112_348, 200_001] {
        check!(
            count,
            parallel::states::<Three, 2, 2, 3, 0>,
            parallel::columns::<Three, 2, 2, 3, 0>
        );
    }
}
