//! Sizes and distances, rounded upward.

use dalembert_model::equations::matrix::Vector;
use dalembert_model::number::Wide;
use dalembert_model::scalar::Scalar;

/// A length that neither arm exceeds, and how far both are apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    pub(super) size: f64,
    pub(super) off: f64,
}

pub(super) fn vectors(one: &Vector<Wide>, other: &Vector<Wide>) -> Pair {
    let length = |v: &Vector<Wide>| root_of_squares(&v.each_ref().map(Wide::magnitude));
    let off: Vector<Wide> = core::array::from_fn(|i| other[i].sub(&one[i]));
    Pair::new(length(one).max(length(other)), length(&off))
}

/// Returns √(a² + b² + c²), upward: of numbers whose squares may vanish, their sum.
pub(super) fn root_of_squares(values: &[f64; 3]) -> f64 {
    let sum = values.iter().fold(0.0, |sum, x| upward_sum(sum, x.abs()));
    let squares = values.iter().map(|x| next_up_unless_zero(x * x));
    let square: f64 = squares.fold(0.0, upward_sum);
    let root = next_up_unless_zero(square.sqrt());
    if sum < 1e-140 { sum } else { root.min(sum) }
}

pub(super) fn next_up_unless_zero(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.next_up() }
}

impl Pair {
    pub(super) const ZERO: Pair = Pair::new(0.0, 0.0);

    pub(super) const fn new(size: f64, off: f64) -> Pair {
        Pair { size, off }
    }

    pub(super) fn of(size: f64) -> Pair {
        Pair::new(next_up_unless_zero(size), 0.0)
    }
}

fn upward_sum(a: f64, b: f64) -> f64 {
    next_up_unless_zero(a + b)
}

impl std::ops::Add for Pair {
    type Output = Pair;

    fn add(self, other: Pair) -> Pair {
        let size = upward_sum(self.size, other.size);
        Pair::new(size, upward_sum(self.off, other.off))
    }
}

impl std::ops::Mul for Pair {
    type Output = Pair;

    fn mul(self, other: Pair) -> Pair {
        let product = |a: f64, b: f64| match a == 0.0 || b == 0.0 {
            true => 0.0,
            // Never zero where neither factor is.
            false => (a * b).next_up(),
        };
        let [of_other, of_own] = [product(self.size, other.off), product(self.off, other.size)];
        Pair::new(product(self.size, other.size), upward_sum(of_other, of_own))
    }
}

pub(super) fn upward(x: f64) -> String {
    let text = format!("{x:.1e}");
    match text.parse::<f64>() {
        Ok(read) if read >= x => text,
        // One unit of the second digit more.
        _ => format!("{:.1e}", x * 1.06),
    }
}
