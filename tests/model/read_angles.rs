//! Angles: the forms they are written in, and when a number of radians counts as a right angle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::support::ratio;
use dalembert_model::number::parse::{NumberError, parse_decimal, write_decimal};
use dalembert_model::number::{Angle, Rational, Rounded, SnappedAngle};
use dalembert_model::read::{Severity, parse};
use dalembert_model::scalar::field::Points;

#[test]
fn forms() {
    let pi = |n, d| Angle::PiTimes(ratio(n, d));
    for (text, angle, shown) in [
        ("pi", pi(1, 1), "pi"),
        ("-pi", pi(-1, 1), "-pi"),
        ("+pi/2", pi(1, 2), "pi/2"),
        ("3*pi/4", pi(3, 4), "3*pi/4"),
        ("-0.5*pi", pi(-1, 2), "-pi/2"),
        (" 2 * pi / 8 ", pi(1, 4), "pi/4"),
        ("1.5e1*pi", pi(15, 1), "15*pi"),
        ("0*pi", pi(0, 1), "0"),
        ("90deg", pi(1, 2), "pi/2"),
        ("-90 deg", pi(-1, 2), "-pi/2"),
        ("22.5deg", pi(1, 8), "pi/8"),
        ("1/3", Angle::Radians(ratio(1, 3)), "1/3"),
    ] {
        let read = Angle::parse(text);
        assert_eq!(read.as_ref(), Ok(&angle), "{text}");
        assert_eq!(angle.to_string(), shown);
        assert_eq!(Angle::parse(shown).unwrap_or_default(), angle);
    }
    let bad = "|p|pie|pi/|pi/0|pi/-2|pi/2.0|pi/0.5|2pi|*pi|--pi|-+2*pi|--2*pi|pi*2|pi pi|deg|\
        ninety deg|0x5a deg|infdeg|nan*pi|1e999*pi|1e-301*pi|1/0|π|0.5";
    for text in bad.split('|') {
        assert!(Angle::parse(text).is_err(), "{text:?} was read");
    }
}

#[test]
fn values() {
    let halves = [FRAC_PI_2, PI, 3.0 * FRAC_PI_2, TAU];
    let angles = [1, 2, 3, 4].map(|n| Angle::PiTimes(ratio(n, 2)).to_f64());
    assert_eq!(angles, halves);
    for n in -9..9 {
        let angle = Angle::right_angles(n);
        for (angle, n) in [(angle.negate(), -n), (angle, n)] {
            assert_eq!(angle.quarter_turns(), Some(n.rem_euclid(4) as u8));
        }
    }
    assert_eq!(Angle::PiTimes(ratio(1, 3)).quarter_turns(), None);
    assert_eq!(Angle::Radians(ratio(0, 1)).quarter_turns(), Some(0));
    assert_eq!(Angle::Radians(ratio(0, 1)).canonical(), Angle::default());
}

fn ulps(value: f64, steps: i64) -> f64 {
    f64::from_bits((value.to_bits() as i64 + steps) as u64)
}

fn apply(value: f64) -> SnappedAngle {
    SnappedAngle::of_radians(parse_decimal(&format!("{value:?}")).expect("a number"))
}

/// Four ulp and no more, 2e-15 and no more, 2π and no more, both signs.
#[test]
fn snapping_at_its_borders() {
    // (multiple's index, most steps down, most steps up)
    for (n, down, up) in [(1, 4, 4), (2, 4, 4), (3, 2, 2), (4, 2, 0)] {
        let double = n as f64 * FRAC_PI_2;
        for sign in [1, -1] {
            let snapped = SnappedAngle::Taken(Angle::right_angles(sign * n));
            for steps in -down - 1..=up + 1 {
                let angle = apply(sign as f64 * ulps(double, steps));
                let is_right = match (-down..=up).contains(&steps) {
                    true => angle == snapped,
                    false => matches!(angle, SnappedAngle::Near { .. }),
                };
                assert!(is_right, "{n}: {steps} ulp: {angle:?}");
            }
        }
    }
    assert!(matches!(apply(5.0 * FRAC_PI_2), SnappedAngle::Near { .. }));
}

/// Within 1e-3 of a right angle: kept, with a warning; zero is no exception.
#[test]
fn near_misses() {
    let near = |text: &str| match SnappedAngle::of_radians(parse_decimal(text).expect("a number")) {
        SnappedAngle::Near { multiple, .. } => Some(multiple),
        _ => None,
    };
    for (text, turns) in [
        ("1.5708", 1),
        ("-3.1416", -2),
        ("0.0009", 0),
        ("1e-300", 0),
        ("1.5717", 1),
    ] {
        assert_eq!(near(text), Some(Angle::right_angles(turns)), "{text}");
    }
    for text in ["0.00100001", "1.5718", "0", "0.3", "1e299"] {
        assert_eq!(near(text), None, "{text}");
    }
}

#[test]
fn in_a_file() {
    let head = "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n[[joint]]\n\
        kind = \"revolute\"\nmass = 0\ninertia = [0, 0, 0, 0, 0, 0]\nalpha = ";
    let double = "1.5707963267948966";
    let [quarter, eighth] = [2, 4].map(|n| Angle::PiTimes(ratio(1, n)));
    let written = Angle::Radians(parse_decimal(double).unwrap());
    assert_eq!(written.to_f64(), FRAC_PI_2);
    let near = Angle::Radians(ratio(15_708, 10_000));
    let (note, warning) = (Some(Severity::Note), Some(Severity::Warning));
    let is_read = "1.5707963267948966 is read as pi/2";
    let stays = "1.5708 is 3.7e-6 from pi/2; it stays as written";
    for (alpha, angle, severity, message) in [
        (double, quarter, note, is_read),
        ("1.5708", near, warning, stays),
        ("0", Angle::default(), None, ""),
        ("-0.0", Angle::default(), None, ""),
        ("\"45deg\"", eighth, None, ""),
    ] {
        let reading = parse(&format!("{head}{alpha}")).expect("reads");
        assert_eq!(reading.robot.joints[0].alpha, angle, "{alpha}");
        let notes = reading.notes.iter();
        let said = notes.map(|note| (note.severity, note.line().unwrap()));
        let expected = severity.map(|severity| (severity, 8));
        assert!(said.eq(expected), "{alpha}: {:?}", reading.notes);
        for note in &reading.notes {
            assert_eq!(note.message, message);
        }
    }
}

#[test]
fn decimals() {
    let power = |n: u32| Rational::from_integer(10.into()).pow(n as i32);
    for (text, value) in [
        ("0.4318", ratio(4318, 10_000)),
        ("-1_000.5", ratio(-2001, 2)),
        ("+1e-3", ratio(1, 1000)),
        ("12E+2", ratio(1200, 1)),
        ("0e999999999999999999999", ratio(0, 1)),
        ("0.000", ratio(0, 1)),
        ("1e300", power(300)),
        ("1e-300", power(300).recip()),
        ("0.1e301", power(300)),
    ] {
        assert_eq!(parse_decimal(text), Ok(value), "{text}");
    }
    let long = "1".repeat(801);
    let far = "1.1e300|-9e-301|1e99999999999999999999999|1e-99999999999999999999999";
    for (texts, error) in [
        ("|-|.5|5.|1__0|_1|1e|+-1|1.2.3|１", NumberError::Malformed),
        ("inf|-nan", NumberError::NotFinite),
        ("0xff", NumberError::Radix),
        (far, NumberError::OutOfRange),
        (&long, NumberError::TooLong),
    ] {
        for text in texts.split('|') {
            assert_eq!(parse_decimal(text), Err(error), "{text}");
        }
    }
}

#[test]
fn decimals_round_trip() {
    let mut points = Points::new(7);
    for _ in 0..2000 {
        let state = points.bits();
        let exponent = state % 1992;
        let double = f64::from_bits((state >> 12) | ((exponent + 28) << 52));
        let value = Rational::from_float(double).expect("finite");
        let text = write_decimal(&value).expect("a decimal");
        if (1e-299..1e299).contains(&double) {
            assert_eq!(parse_decimal(&text), Ok(value.clone()), "{text}");
            assert_eq!(f64::nearest_rational(&value), double);
            assert_eq!(text.parse(), Ok(double));
        }
    }
    for text in "1 -10 0.001 0.00001 9.5e-6 123456789.125 1e16 -1.5e20".split(' ') {
        let value = parse_decimal(text).expect("a number");
        assert_eq!(write_decimal(&value).as_deref(), Some(text));
    }
    assert_eq!(write_decimal(&ratio(1, 3)), None);
}
