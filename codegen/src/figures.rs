//! Numbers in documentation and messages: short, and rounded to the side on which they stay true.

/// The distance that a figure may have from the number, in units of its last digit.
const ABOVE: i64 = 1;
const BELOW: i64 = -1;

fn rounded(x: f64, digits: usize, side: i64) -> f64 {
    let near = format!("{x:.*e}", digits.saturating_sub(1));
    let read = near.parse().unwrap_or(x);
    let good = if side == ABOVE { read >= x } else { read <= x };
    let parts = near
        .split_once('e')
        .map(|(digits, power)| (digits.replace('.', ""), power.parse::<i32>()));
    let (false, Some((mantissa, Ok(power)))) = (good, parts) else {
        return read;
    };
    let last = power - digits.saturating_sub(1) as i32;
    let mantissa = mantissa.parse::<i64>().map(|units| units + side);
    let moved = mantissa.map(|units| format!("{units}e{last}").parse());
    moved.ok().and_then(Result::ok).unwrap_or(x)
}

pub(crate) fn above(x: f64, digits: usize) -> f64 {
    rounded(x, digits, ABOVE)
}

fn plain(x: f64) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// Writes five digits, not below: an error relative to it stays a bound.
pub(crate) fn at_least(x: f64) -> String {
    plain(above(x, 5))
}

pub(crate) fn decimal(value: &dalembert_model::number::Rational) -> String {
    dalembert_model::number::parse::write_decimal(value).unwrap_or_else(|| value.to_string())
}

pub(crate) fn placed(placement: &dalembert_model::robot::Placement) -> String {
    let xyz = placement.xyz.each_ref().map(decimal).join(", ");
    let rpy = placement.rpy.each_ref().map(ToString::to_string).join(", ");
    format!("xyz ({xyz}) m, rpy ({rpy})")
}

pub(crate) fn bound(x: f64) -> String {
    bound_of(x, 3)
}

/// Writes so many digits, not below.
pub fn bound_of(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    format!("{:.*e}", digits.saturating_sub(1), above(x, digits))
}

/// Returns a range of seven digits inside a range, or all its digits if it is that narrow.
pub(crate) fn inside(low: f64, high: f64) -> String {
    let ends = (above(low, 7), rounded(high, 7, BELOW));
    let (low, high) = if ends.0 < ends.1 { ends } else { (low, high) };
    format!("{} to {}", plain(low), plain(high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn figures_are_on_their_side() {
        let mut random = Random::new(0xf16);
        for _ in 0..2000 {
            let x = (random.unit() - 0.5) * 10f64.powi((random.unit() * 40.0) as i32 - 20);
            let (a, b) = (x.min(2.0 * x), x.max(2.0 * x));
            let range = inside(a, b);
            let (low, high) = range.split_once(" to ").unwrap();
            let (low, high): (f64, f64) = (low.parse().unwrap(), high.parse().unwrap());
            assert!(a <= low && low < high && high <= b, "{a} {b}: {range}");
            assert!(low - a <= 1e-6 * a.abs() && b - high <= 1e-6 * b.abs());
            for (text, slack) in [(at_least(x.abs()), 1e-4), (bound(x.abs()), 1e-2)] {
                let read: f64 = text.parse().unwrap();
                assert!(
                    read >= x.abs() && read <= x.abs() * (1.0 + slack),
                    "{x}: {text}"
                );
            }
        }
    }

    #[test]
    fn as_people_write_them() {
        assert_eq!(inside(0.0, FRAC_PI_2), "0 to 1.570796");
        assert_eq!(inside(-PI, PI), "-3.141592 to 3.141592");
        assert_eq!(inside(-2.175, 0.3048), "-2.175 to 0.3048");
        assert_eq!(inside(1e-5, 2e6), "1e-5 to 2e6");
        let narrow = 1.0f64.next_up();
        assert_eq!(inside(1.0, narrow), format!("1 to {narrow}"));
        assert_eq!(inside(narrow, narrow), format!("{narrow} to {narrow}"));
        assert_eq!(at_least(97.6f64.next_down()), "97.6");
        assert_eq!(at_least(18.00001), "18.001");
        assert_eq!(bound(9.999e-3), "1.00e-2");
        assert_eq!(bound(8.0601e-3), "8.07e-3");
        assert_eq!(bound(0.0), "0");
    }
}
