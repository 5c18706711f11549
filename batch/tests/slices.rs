//! From slices to lanes and back: every state once, in its place, whatever the
//! length and the number of lanes.

use dalembert_batch::{Function, columns, columns_in_lanes, states, states_in_lanes};

/// x y, x − 2 y and x/y of the first entry of one argument and the second of the
/// other.
struct Three;

impl Function<2, 2, 3> for Three {
    type Scalar = f32;
    type State = (f32, [f32; 2]);
    type Lanes<const L: usize> = [[f32; L]; 3];

    #[inline(always)]
    fn lanes<const L: usize>([x, y]: &[[[f32; L]; 2]; 2]) -> [[f32; L]; 3] {
        let mut results = [[0.0; L]; 3];
        for l in 0..L {
            let (x, y) = (x[0][l], y[1][l]);
            (results[0][l], results[1][l], results[2][l]) = (x * y, x - 2.0 * y, x / y);
        }
        results
    }

    #[inline(always)]
    fn state<const L: usize>(results: &[[f32; L]; 3], l: usize) -> (f32, [f32; 2]) {
        (results[0][l], [results[1][l], results[2][l]])
    }

    #[inline(always)]
    fn columns<const L: usize>(results: &[[f32; L]; 3]) -> [[f32; L]; 3] {
        *results
    }
}

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
fn every_length_in_every_number_of_lanes() {
    macro_rules! lanes {
        ($($lanes:literal)*) => {$(
            for count in 0..=2 * $lanes + 1 {
                check!(
                    count,
                    states_in_lanes::<Three, $lanes, 2, 2, 3>,
                    columns_in_lanes::<Three, $lanes, 2, 2, 3>
                );
            }
        )*};
    }
    lanes!(1 2 3 4 7 8 16);
}

#[test]
fn every_length_as_the_processor_has_it() {
    for count in 0..=67 {
        check!(count, states::<Three, 2, 2, 3>, columns::<Three, 2, 2, 3>);
    }
}

#[cfg(feature = "rayon")]
#[test]
fn every_length_on_all_cores() {
    use dalembert_batch::parallel;
    for count in [0, 1, 1023, 1024, 1025, 3000, 10_001] {
        check!(
            count,
            parallel::states::<Three, 2, 2, 3>,
            parallel::columns::<Three, 2, 2, 3>
        );
    }
}
