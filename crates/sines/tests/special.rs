//! Unusual angles, and that each is computed for itself: the same bits alone and among others.

use dalembert_sines::{LARGEST, LARGEST_F32, sincos, sincosf};

fn bits<const N: usize>((sin, cos): ([f64; N], [f64; N])) -> [(u64, u64); N] {
    std::array::from_fn(|i| (sin[i].to_bits(), cos[i].to_bits()))
}

fn bitsf<const N: usize>((sin, cos): ([f32; N], [f32; N])) -> [(u32, u32); N] {
    std::array::from_fn(|i| (sin[i].to_bits(), cos[i].to_bits()))
}

fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn what_polynomials_are_not_for_is_libms() {
    let large = [LARGEST.next_up(), 1e5, 1e22, f64::MAX, f64::INFINITY];
    let doubles = large.into_iter().chain([f64::NAN]);
    for x in doubles.flat_map(|x| [x, -x]) {
        let ([sin], [cos]) = sincos(&[x]);
        let (libm_sin, libm_cos) = libm::sincos(x);
        assert!(same(sin, libm_sin) && same(cos, libm_cos), "{x:e}");
    }
    let large = [LARGEST_F32.next_up(), 1e5, 1e22, f32::MAX, f32::INFINITY];
    let singles = large.into_iter().chain([f32::NAN]);
    for x in singles.flat_map(|x| [x, -x]) {
        let ([sin], [cos]) = sincosf(&[x]);
        let (libm_sin, libm_cos) = libm::sincosf(x);
        let all_same = same(sin.into(), libm_sin.into()) && same(cos.into(), libm_cos.into());
        assert!(all_same, "{x:e}");
    }
}

#[test]
fn what_is_tiny_is_its_own_sine() {
    let tiny = [0.0f64, 5e-324, f64::MIN_POSITIVE, 1e-300, 1e-30, 1e-9];
    for x in tiny.into_iter().flat_map(|x| [x, -x]) {
        assert_eq!(bits(sincos(&[x])), [(x.to_bits(), 1f64.to_bits())], "{x:e}");
    }
    let tiny = [0.0f32, 1e-45, f32::MIN_POSITIVE, 1e-30, 1e-13, 1e-5];
    for x in tiny.into_iter().flat_map(|x| [x, -x]) {
        let expected = [(x.to_bits(), 1f32.to_bits())];
        assert_eq!(bitsf(sincosf(&[x])), expected, "{x:e}");
    }
}

#[test]
fn the_ends_of_the_range_are_computed() {
    for x in [LARGEST, -LARGEST] {
        let ([sin], [cos]) = sincos(&[x]);
        assert!((sin - libm::sin(x)).abs() < 1e-15 && (cos - libm::cos(x)).abs() < 1e-15);
    }
    for x in [LARGEST_F32, -LARGEST_F32] {
        let ([sin], [cos]) = sincosf(&[x]);
        assert!((sin - libm::sinf(x)).abs() < 1e-6 && (cos - libm::cosf(x)).abs() < 1e-6);
    }
}

fn are_computed_for_themselves<const N: usize>() {
    for odd in 0..N {
        let mut angles: [f64; N] = std::array::from_fn(|i| 0.7 * i as f64 - 2.3 * odd as f64);
        for unusual in [0.1, f64::NAN, 1e18, f64::INFINITY] {
            angles[odd] = unusual;
            let (together, singles) = (sincos(&angles), angles.map(|x| x as f32));
            let together_f32 = bitsf(sincosf(&singles));
            for (i, pair) in bits(together).into_iter().enumerate() {
                assert_eq!(pair, bits(sincos(&[angles[i]]))[0], "{angles:?}");
                assert_eq!(together_f32[i], bitsf(sincosf(&[singles[i]]))[0]);
            }
        }
    }
}

#[test]
fn every_number_of_angles() {
    assert_eq!(sincos::<0>(&[]), ([], []));
    are_computed_for_themselves::<1>();
    are_computed_for_themselves::<2>();
    are_computed_for_themselves::<6>();
    are_computed_for_themselves::<7>();
    are_computed_for_themselves::<8>();
    are_computed_for_themselves::<9>();
    are_computed_for_themselves::<16>();
    are_computed_for_themselves::<21>();
}

/// Fingerprints many results; found on x86-64 in a debug and in a release build.
#[test]
fn the_same_bits_everywhere() {
    let mut print = 0u64;
    let mut add =
        |bits: u64| print = (print.rotate_left(5) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut x = 1e-6;
    while x < LARGEST {
        let ((sin, cos), (sinf, cosf)) = (sincos(&[x, -x]), sincosf(&[x as f32 / 64.0]));
        add(sin[0].to_bits());
        add(cos[1].to_bits());
        add(sinf[0].to_bits().into());
        add(cosf[0].to_bits().into());
        x *= 1.0001;
    }
    assert_eq!(print, 0x7ffe_044f_1428_81c2, "{print:#x}");
}
