//! Numbers of the identity: the nearest float, slopes, angles, and draws from a statement.

use std::f64::consts::FRAC_1_SQRT_2;

use dalembert_checker::identity::exact::{Angle, Exact, Point};
use dalembert_checker::identity::number::{Draws, Number};
use num_bigint::BigUint;

#[test]
fn the_nearest_float_is_told_from_its_neighbours() {
    let cases = [
        ("1/3", 1.0 / 3.0, false),
        ("1/3", f64::from(1.0f32 / 3.0), true),
        ("1*sin(1*pi/4)", FRAC_1_SQRT_2, false),
        ("1*cos(1*pi/4)^2", 0.5, false),
        ("-2*sin(1*pi/4)*cos(1*pi/4)", -1.0, false),
        ("7/10+-3/10*cos(1/3)", 0.416_512_916_105_578_7, false),
        // Half-way between two floats the even one is nearest.
        ("9007199254740993/9007199254740992", 1.0, false),
        ("16777217/16777216", 1.0, true),
        ("1e-300", 1e-300, false),
    ];
    for (text, literal, is_single) in cases {
        let number = Exact::read(text).unwrap();
        assert!(number.is_nearest(literal, is_single), "{text}");
        let next: [f64; 2] = match is_single {
            true => [(literal as f32).next_up(), (literal as f32).next_down()].map(f64::from),
            false => [literal.next_up(), literal.next_down()],
        };
        let others = next.into_iter().chain([-literal, f64::NAN, f64::INFINITY]);
        for other in others {
            assert!(!number.is_nearest(other, is_single), "{text} {other:e}");
        }
    }
    let third = Exact::read("1/3").unwrap();
    assert!(!third.is_nearest(1.0 / 3.0, true));
    // A number that vanishes in a scalar is not zero: a factor beside it may be as large as it is small.
    for (small, is_single) in [("1/2e45", true), ("1/5e323", false)] {
        assert!(!Exact::read(small).unwrap().is_nearest(0.0, is_single));
    }
    let zero = Exact::read("0").unwrap();
    assert!(zero.is_nearest(0.0, false) && !zero.is_nearest(-0.0, false));
    // Relations of sines of multiples of 15° make constants zero, and no others do.
    let sums = "-1+2*cos(1*pi/4)^2 -3+4*cos(1*pi/6)^2 -1/2+1*sin(1*pi/6)";
    for text in sums.split(' ') {
        let vanishing = Exact::read(text).unwrap();
        assert!(vanishing.is_nearest(0.0, false), "{text}");
        let off = Exact::read(&format!("{text}+1/1{}", "0".repeat(120))).unwrap();
        assert!(!off.is_nearest(0.0, false), "{text}");
    }
    // The series of a large angle has lost its digits.
    let far = Exact::read("1*sin(100)").unwrap();
    assert!(!far.is_nearest(100f64.sin(), false));
}

#[test]
fn what_is_no_constant_is_not_read() {
    let long = "1".repeat(5000);
    let others = "x 1e 1/0 1e999/1e-999/1e999 1/-2 1*tan(1) 1*sin(1 1*sin(1)^2000 \
                  1*sin(1)^600*cos(1)^600";
    for text in others.split(' ').chain(["", long.as_str()]) {
        assert!(Exact::read(text).is_none(), "{text}");
    }
}

#[test]
fn equal_angles_have_equal_sines() {
    let point = Point::new(&["angles"]);
    let pair = |text: &str| {
        let both = point.angle(&Angle::read(text).unwrap());
        both.map(|x| x.value(point.prime))
    };
    let [sine, cosine] = pair("pi/5");
    for equal in ["36deg", "1*pi/5", "-9*pi/5", "11*pi/5"] {
        assert_eq!(pair(equal), [sine, cosine], "{equal}");
    }
    assert_eq!(pair("3*pi/10"), [cosine, sine]);
    // The sines of 15°, 30°, 45°, 60°, 75° and 90° have the relations of addition.
    let turn = |parts: u32| point.angle(&Angle::read(&format!("{parts}*pi/12")).unwrap());
    for (first, second) in (1..12).flat_map(|first| (1..12).map(move |second| (first, second))) {
        let ([a, b], [c, d]) = (turn(first), turn(second));
        let sum = [a * d + b * c, b * d - a * c].map(|x| x.value(point.prime));
        let whole = turn(first + second).map(|x| x.value(point.prime));
        assert_eq!(whole, sum, "{first} + {second}");
    }
    assert_eq!(pair("1.5707963267948966"), [Some(1), Some(0)]);
    assert_eq!(pair("90deg"), [Some(1), Some(0)]);
    assert_ne!(pair("0.3"), pair("0.30000000000000001"));
    assert_ne!(pair("0.3")[0], pair("-0.3")[0]);
    assert_eq!(pair("0.3")[1], pair("-0.3")[1]);
}

/// x/y · y is x with both slopes and the mixed one, and another statement has another prime.
#[test]
fn quotients_have_slopes() {
    let mut draws = Draws::new(&["quotients"]);
    let prime = draws.prime();
    assert!(prime.value() >> 125 == 1);
    let prime_of = |texts: &[&str]| Draws::new(texts).prime().value();
    assert_ne!(prime.value(), prime_of(&["quotients "]));
    assert_ne!(prime.value(), prime_of(&["quo", "tients"]));
    let mut number = || {
        let [value, first, second] = [(); 3].map(|()| draws.residue(prime));
        value + first * Number::step(1) + second * Number::step(2)
    };
    let [x, y] = [number(), number()];
    let again = x / y * y;
    for part in 1..4 {
        assert_eq!(again.slope(part).value(prime), x.slope(part).value(prime));
    }
    assert_eq!(again.value(prime), x.value(prime));
    let zero = Number::new(prime.value(), prime);
    assert_eq!((x / zero * y).value(prime), None);
}

/// Sums of products of the least and the largest residues, against remainders of large integers.
#[test]
fn products_are_remainders() {
    let prime = Draws::new(&["products"]).prime();
    let p = prime.value();
    let ends = [0, 1, 2, p / 2, p - 2, p - 1];
    let (number, step) = (|value: u128| Number::new(value, prime), Number::step(1));
    let wide = |x: u128, y: u128| BigUint::from(x) * BigUint::from(y);
    let left = |whole: BigUint| u128::try_from(whole % BigUint::from(p)).ok();
    for case in 0..6usize.pow(4) {
        let [a, b, c, d] = [1, 6, 36, 216].map(|place| ends[case / place % 6]);
        let product = (number(a) + number(b) * step) * (number(c) + number(d) * step);
        assert_eq!(product.value(prime), left(wide(a, c)));
        let slope = product.slope(1).value(prime);
        assert_eq!(slope, left(wide(a, d) + wide(b, c)), "{a} {b} {c} {d}");
    }
    let whole = Number::from(-3) * Number::new(p - 1, prime);
    assert_eq!(whole.value(prime), Some(3));
}
