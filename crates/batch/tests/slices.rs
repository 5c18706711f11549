//! From columns to vectors and back: every state once, in its place, at any length.

use std::array::from_fn;

use dalembert_batch::Argument::{Columns, Rows};
#[cfg(feature = "rayon")]
use dalembert_batch::parallel;
use dalembert_batch::{Argument, Floats, Function, Unequal, Vector, Vectors, columns, columns_in};

/// x y, x − 2 y and x/y of the first entry of one argument and the second of the other.
struct Three;

impl Function<4, 3, 0> for Three {
    type Scalar = f32;

    #[inline(always)]
    fn angles<V: Floats<f32>>(_: &[V; 4]) -> [V; 0] {
        []
    }

    #[inline(always)]
    fn vectors<V: Vector<f32>>(&[x, _, _, y]: &[V; 4], _: &[V; 0], _: &[V; 0]) -> [V; 3] {
        [x * y, x - y * 2.0, x / y]
    }
}

/// Every operation of a vector on angles of every size, one of which is NaN.
struct Operations;

impl Function<1, 8, 2> for Operations {
    type Scalar = f64;

    #[inline(always)]
    fn angles<V: Floats<f64>>(&[x]: &[V; 1]) -> [V; 2] {
        [x, x * 1e4]
    }

    #[inline(always)]
    fn vectors<V: Vector<f64>>(&[x]: &[V; 1], sin: &[V; 2], cos: &[V; 2]) -> [V; 8] {
        let (floor, fraction) = x.both(|x| (x.floor(), x - x.floor()));
        let less = -x.each(f64::abs) * (1.0 / 3.0);
        let root = (x * x).sqrt().mul_add(x.all(1.0 / 3.0), less);
        [sin[0], cos[0], sin[1], cos[1], floor, fraction, root, -x]
    }
}

const ALL: [Vectors; 3] = [Vectors::Portable, Vectors::Avx2, Vectors::Avx512];

fn computed<F, const N: usize, const M: usize, const K: usize>(
    vectors: Vectors,
    x: &[Vec<F::Scalar>; N],
    count: usize,
) -> [Vec<F::Scalar>; M]
where
    F: Function<N, M, K>,
{
    let x = x.each_ref().map(|column| &column[..count]);
    let mut results = from_fn(|_| vec![F::Scalar::default(); count]);
    let mut slices = results.each_mut().map(Vec::as_mut_slice);
    columns_in::<F, N, M, K, 0>(vectors, &[Columns(&x)], &mut slices).unwrap();
    results
}

#[test]
fn every_operation_in_all_vectors() {
    let odd = [f64::NAN, f64::INFINITY, -0.0, 8192.1, 5e-324, -1e300];
    let value = |k: usize| match k % 7 {
        6 => odd[k / 7 % odd.len()],
        _ => (k as f64 - 90.0) * 0.0371,
    };
    let x = [(0..200).map(value).collect()];
    for vectors in ALL {
        for count in [1, 7, 64, 65, 200] {
            let found: [_; 8] = computed::<Operations, 1, 8, 2>(vectors, &x, count);
            for (k, &x) in x[0][..count].iter().enumerate() {
                let (sin, cos) = dalembert_sines::sincos(&[x, x * 1e4]);
                let root = f64::mul_add((x * x).sqrt(), 1.0 / 3.0, -x.abs() * (1.0 / 3.0));
                let rest = [x.floor(), x - x.floor(), root, -x];
                let expected = [sin[0], cos[0], sin[1], cos[1]].into_iter().chain(rest);
                for (column, expected) in found.iter().zip(expected) {
                    let same = column[k].to_bits() == expected.to_bits()
                        || (column[k].is_nan() && expected.is_nan());
                    assert!(same, "{vectors:?}: {x:e}");
                }
            }
        }
    }
}

/// Sines in which products are fused, of one angle more than stand side by side.
macro_rules! fused {
    ($kind:ident, $float:ident, $test:ident) => {
        struct $kind;

        impl Function<5, 10, 5> for $kind {
            type Scalar = $float;
            const FUSED: bool = true;

            #[inline(always)]
            fn angles<V: Floats<$float>>(x: &[V; 5]) -> [V; 5] {
                *x
            }

            #[inline(always)]
            fn vectors<V: Vector<$float>>(_: &[V; 5], s: &[V; 5], c: &[V; 5]) -> [V; 10] {
                [s[0], s[1], s[2], s[3], s[4], c[0], c[1], c[2], c[3], c[4]]
            }
        }

        /// In all vectors they are those of the same text in numbers, and a library's of angles
        /// that it is not for; those of a zero have its sign.
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
                    let x = from_fn(|i| (0..200).map(|k| angle(5 * k + i)).collect());
                    let found: [_; 10] = computed::<$kind, 5, 10, 5>(vectors, &x, 200);
                    for k in 0..200 {
                        for i in 0..5 {
                            let x: $float = x[i][k];
                            let vector = [found[i][k], found[5 + i][k]];
                            let pair: [$float; 2] = alone::<$float, Fused>(x).into();
                            let same = vector.map($float::to_bits) == pair.map($float::to_bits);
                            assert!(same || x.is_nan() || x.is_infinite(), "{vectors:?}: {x:e}");
                            assert_eq!(vector.map($float::is_nan), pair.map($float::is_nan));
                            let has_sign = vector[0].is_sign_negative() == x.is_sign_negative();
                            let is_itself = has_sign && vector == [x, 1.0];
                            assert!(x != 0.0 || is_itself, "{x:?}: {vector:?}");
                            let rounded: [$float; 2] = alone::<$float, Rounded>(x).into();
                            far += usize::from(x.abs() > $float::LARGEST && x.is_finite());
                            others += usize::from(vector != rounded && x.is_finite());
                        }
                    }
                }
            }
            assert!(far > 5 && others > 10, "{far} {others}");
        }
    };
}
fused!(FusedDoubles, f64, fused_sines_of_doubles);
fused!(FusedFloats, f32, fused_sines_of_floats);

fn check(
    count: usize,
    run: impl FnOnce(&[Argument<'_, f32>], &mut [&mut [f32]; 3]) -> Result<(), Unequal>,
) {
    let x: Vec<f32> = (0..count).map(|k| k as f32 + 0.5).collect();
    let y: Vec<f32> = (0..count).map(|k| 3.0 - k as f32).collect();
    let unread = vec![f32::NAN; count];
    let mut results = [(); 3].map(|()| vec![7.0; count + 1]);
    let mut slices = results.each_mut().map(|column| &mut column[..count]);
    run(
        &[Columns(&[&x, &unread]), Columns(&[&unread, &y])],
        &mut slices,
    )
    .unwrap();
    for (k, (x, y)) in x.iter().zip(&y).enumerate() {
        let expected = [x * y, x - 2.0 * y, x / y];
        assert_eq!([results[0][k], results[1][k], results[2][k]], expected);
    }
    assert!(results.iter().all(|column| column[count] == 7.0));
}

#[test]
fn every_length_in_all_vectors() {
    for vectors in ALL {
        for count in (0..=2 * 64 + 17).chain([1000]) {
            check(count, |arguments, results| {
                columns_in::<Three, 4, 3, 0, 0>(vectors, arguments, results)
            });
        }
    }
}

#[cfg(feature = "rayon")]
#[test]
fn every_length_on_all_cores() {
    // Tasks begin at 3 MiB, and a state has 28 bytes.
    for count in [0, 1, 112_347, 112_348, 200_001] {
        check(count, parallel::columns::<Three, 4, 3, 0, 0>);
    }
}

/// Entries that generated code takes by a type.
struct Pair([f32; 2]);

impl std::ops::Deref for Pair {
    type Target = [f32; 2];
    fn deref(&self) -> &[f32; 2] {
        &self.0
    }
}

/// Runs the function with its last two entries in rows.
fn run(
    vectors: Option<Vectors>,
    arguments: &[Argument<'_, f32>],
    results: &mut [&mut [f32]; 3],
) -> Result<(), Unequal> {
    match vectors {
        Some(vectors) => columns_in::<Three, 4, 3, 0, 2>(vectors, arguments, results),
        #[cfg(feature = "rayon")]
        None => parallel::columns::<Three, 4, 3, 0, 2>(arguments, results),
        #[cfg(not(feature = "rayon"))]
        None => columns::<Three, 4, 3, 0, 2>(arguments, results),
    }
}

/// Rows hold for their states, and one for all, in blocks, in the rest of a batch and in tasks.
#[test]
fn rows_are_of_a_state_or_of_all() {
    let counts = [1, 63, 64, 65, 200].into_iter();
    let cases = counts.flat_map(|count| ALL.map(|vectors| (count, Some(vectors))));
    for (count, vectors) in cases.chain([(200_001, None)]) {
        let x: Vec<f32> = (0..count).map(|k| k as f32 + 0.5).collect();
        let row = |k: usize| Pair([f32::NAN, 3.0 - k as f32]);
        let rows: Vec<Pair> = (0..count).map(row).collect();
        for pairs in [&rows[..], &rows[..1]] {
            let mut results = [(); 3].map(|()| vec![7.0; count]);
            let mut slices = results.each_mut().map(Vec::as_mut_slice);
            run(vectors, &[Columns(&[&x, &x]), Rows(&pairs)], &mut slices).unwrap();
            for (k, x) in x.iter().enumerate() {
                let y = pairs[k.min(pairs.len() - 1)][1];
                let expected = [x * y, x - 2.0 * y, x / y].map(f32::to_bits);
                let bits = [0, 1, 2].map(|column| results[column][k].to_bits());
                assert_eq!(bits, expected, "{vectors:?} {k}");
            }
        }
    }
}

#[test]
fn arguments_of_other_lengths_are_refused() {
    let column = [0.0; 5];
    let rows = [(); 4].map(|()| Pair([0.0; 2]));
    let refused = |arguments: &[Argument<'_, f32>]| {
        let mut results = [[7.0; 5]; 3];
        let mut slices = results.each_mut().map(|column| &mut column[..]);
        let error = columns::<Three, 4, 3, 0, 2>(arguments, &mut slices).unwrap_err();
        assert_eq!(results, [[7.0; 5]; 3]);
        error.to_string()
    };
    let (four, none, short) = (&rows[..], &rows[..0], [&column[..3]]);
    let two = Columns(&[&column, &column]);
    let cases = [
        (
            vec![two, Rows(&four)],
            "argument 2 has 4 rows, and 5 states take 1 row or 5",
        ),
        (
            vec![two, Rows(&none)],
            "argument 2 has 0 rows, and 5 states take 1 row or 5",
        ),
        (
            vec![two],
            "the arguments have 2 entries, and the function takes 4",
        ),
        (
            vec![two, two, two],
            "the arguments have 6 entries, and the function takes 4",
        ),
        (
            vec![two, two],
            "0 entries come in rows, and the call is for 2",
        ),
        (
            vec![Columns(&short)],
            "entry 1 of argument 1 has 3 states, the results have 5",
        ),
    ];
    for (arguments, message) in cases {
        assert_eq!(refused(&arguments), message);
    }
}
