//! How far emitted code may be off at a state, from its own numbers: Wilkinson's
//! running error analysis.
//!
//! Next to each computed value stands a bound of its error. With u the unit
//! roundoff and η the least subnormal:
//!
//! - of x ± y: e_x + e_y + u·|x ± y|
//! - of x·y: |x|·e_y + |y|·e_x + e_x·e_y + u·|x·y| + η
//! - of x·y + z, fused: that of x·y without its u·|x·y|, e_z and u·|x·y + z|
//! - of x/y: (e_x + |x/y|·e_y)/(|y| − e_y) + u·|x/y| + η, nothing if e_y ≥ |y|
//! - of a constant: u·|c| + η, once; of a library's sine 2u·|s|, and what its angle
//!   is off where that is a sum
//! - of a polynomial's sine: the error that was proved
//! - of 1/√(q̇² + w²): 4u of it
//!
//! It needs no box and no search. What it gives is far from what happens, but
//! nothing that is right is ever beyond it.

use std::collections::BTreeMap;

use dalembert_model::equations::friction::per_speed;
use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

use crate::function::Argument;
use crate::program::machine::Machine;
use crate::program::run::angle_value;
use crate::program::{AngleSum, Input, Library, Program, ScalarType, Speed};
use crate::sincos::AngleKernel;
use crate::states::JointState;

/// A computed value and a bound of its error: a scalar, so that a program runs in
/// it as in any other.
#[derive(Clone, Copy, Debug)]
struct Bounded<T> {
    value: T,
    error: f64,
}

impl<T: Machine> Bounded<T> {
    fn exact(value: T) -> Self {
        Bounded { value, error: 0.0 }
    }

    /// Returns the magnitude of the computed value.
    fn size(&self) -> f64 {
        self.value.to_f64().abs()
    }

    /// Returns a computed value with what its operands' errors make of it and what it
    /// rounds itself.
    fn rounded(value: T, carried: f64) -> Self {
        let own = T::SCALAR.unit_roundoff() * value.to_f64().abs();
        Bounded {
            value,
            // The bound's own arithmetic: a handful of roundings, upward.
            error: (carried + own) * (1.0 + 1e-14) + f64::from_bits(1),
        }
    }
}

/// Returns the least subnormal.
fn least(scalar: ScalarType) -> f64 {
    2.0 * scalar.least_normal() * scalar.unit_roundoff()
}

impl<T: Machine> Scalar for Bounded<T> {
    fn zero() -> Self {
        Bounded::exact(T::zero())
    }
    fn one() -> Self {
        Bounded::exact(T::one())
    }
    fn add(&self, other: &Self) -> Self {
        Bounded::rounded(self.value.add(&other.value), self.error + other.error)
    }
    fn sub(&self, other: &Self) -> Self {
        Bounded::rounded(self.value.sub(&other.value), self.error + other.error)
    }
    fn mul(&self, other: &Self) -> Self {
        let carried = self.size() * other.error
            + other.size() * self.error
            + self.error * other.error
            + least(T::SCALAR);
        Bounded::rounded(self.value.mul(&other.value), carried)
    }
    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        let carried = self.size() * factor.error
            + factor.size() * self.error
            + self.error * factor.error
            + addend.error
            + least(T::SCALAR);
        Bounded::rounded(self.value.mul_add(&factor.value, &addend.value), carried)
    }
    fn neg(&self) -> Self {
        Bounded {
            value: self.value.neg(),
            ..*self
        }
    }
    fn half(&self) -> Self {
        self.mul(&Bounded::exact(T::literal(0.5)))
    }
}

impl<T: Machine> Divide for Bounded<T> {
    /// |x/y − X/Y| = |(x/y)(Y − y) + (x − X)|/|Y|, and |Y| ≥ |y| − e_y.
    fn div(&self, other: &Self) -> Self {
        let divisor = other.size() - other.error;
        let carried = match divisor > 0.0 {
            true => {
                let both = self.error + self.size() / other.size() * other.error;
                both / (divisor * (1.0 - 1e-15)) + least(T::SCALAR)
            }
            false => f64::INFINITY,
        };
        Bounded::rounded(self.value.div(&other.value), carried)
    }
}

/// Bounds of a program's errors at a state of the scalar's own numbers, one a
/// result; infinite where nothing can be said.
pub(crate) fn errors(
    program: &Program,
    scalar: ScalarType,
    library: Library,
    sines: &[AngleKernel],
    state: &JointState,
) -> Vec<f64> {
    match scalar {
        ScalarType::F64 => errors_in::<f64>(program, library, sines, state),
        ScalarType::F32 => errors_in::<f32>(program, library, sines, state),
    }
}

fn errors_in<T: Machine>(
    program: &Program,
    library: Library,
    sines: &[AngleKernel],
    state: &JointState,
) -> Vec<f64> {
    let q: Vec<T> = state.q.iter().map(|&x| T::literal(x)).collect();
    let mut trig: BTreeMap<Input, Bounded<T>> = BTreeMap::new();
    for angle in program.trig.iter().map(|trig| trig.angle) {
        let own = sines.iter().find(|sine| sine.angle == angle);
        let [sin, cos] = pair(angle, own, library, &q);
        trig.insert(Input::Sin(angle), sin);
        trig.insert(Input::Cos(angle), cos);
    }
    for own in &program.speeds {
        trig.insert(Input::PerSpeed(own.joint), speed::<T>(own, state));
    }
    let input = |input: &Input| match *input {
        Input::Entry(argument, joint) => {
            let value = T::literal(state.entry(argument, joint));
            Some(match argument {
                // Rounded from exact numbers, and once more to the scalar.
                Argument::Load => Bounded {
                    value,
                    error: 2.0 * T::SCALAR.unit_roundoff() * value.to_f64().abs()
                        + least(T::SCALAR),
                },
                _ => Bounded::exact(value),
            })
        }
        Input::Sin(_) | Input::Cos(_) | Input::PerSpeed(_) => trig.get(input).copied(),
    };
    let constant = |constant: &Exact| {
        let value = T::SCALAR.round(constant);
        Some(Bounded {
            value: T::literal(value),
            error: T::SCALAR.unit_roundoff() * value.abs() + least(T::SCALAR),
        })
    };
    match program.evaluate(input, constant) {
        Some(results) => results.iter().map(|result| sound(result.error)).collect(),
        None => vec![f64::INFINITY; program.outputs.len()],
    }
}

/// Returns one over a smoothed speed: a product, a constant and a sum of positive numbers,
/// half of whose relative errors a root keeps, then a root and a quotient that
/// round: 3 u, and a little more than that.
fn speed<T: Machine>(own: &Speed, state: &JointState) -> Bounded<T> {
    let qd = T::literal(state.entry(Argument::Velocity, own.joint));
    let square = T::literal(T::SCALAR.round(&own.square));
    let sum = qd.mul(&qd).add(&square).to_f64();
    let value = per_speed(&qd, &square, |x| x.root());
    let error = match square.to_f64() >= T::SCALAR.least_normal() && sum.is_finite() {
        true => 4.0 * T::SCALAR.unit_roundoff() * value.to_f64() + least(T::SCALAR),
        false => f64::INFINITY,
    };
    Bounded { value, error }
}

/// Returns sine and cosine of an angle, by a library or by a polynomial of its own.
fn pair<T: Machine>(
    angle: AngleSum,
    own: Option<&AngleKernel>,
    library: Library,
    q: &[T],
) -> [Bounded<T>; 2] {
    let (u, computed) = (T::SCALAR.unit_roundoff(), angle_value(angle, q));
    // A sum of angles is rounded; a sine moves no more than its angle.
    let terms = angle.terms().map(|(joint, _)| q[joint].to_f64().abs());
    let moved = 1.01 * angle.additions() as f64 * u * terms.sum::<f64>();
    let ((sin, cos), [sin_error, cos_error]) = match own {
        None => {
            let (sin, cos) = library.pair(computed, true, true);
            // Within one ulp, and twice that to be generous.
            let error = |x: T| 4.0 * u * x.to_f64().abs() + least(T::SCALAR);
            ((sin, cos), [sin, cos].map(error))
        }
        Some(own) => {
            let at = computed.to_f64();
            let inside = own.range.low() <= at && at <= own.range.high();
            let error = |x: f64| if inside { x } else { f64::INFINITY };
            let errors = [own.errors.sin, own.errors.cos].map(error);
            (own.kernel.run(computed), errors)
        }
    };
    let bounded = |value, error: f64| Bounded {
        value,
        error: error + moved,
    };
    [bounded(sin, sin_error), bounded(cos, cos_error)]
}

/// Returns a bound that is no number says nothing.
fn sound(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}
