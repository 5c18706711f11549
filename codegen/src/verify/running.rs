//! How far emitted code may be off at a state, from its own numbers: Wilkinson's
//! running error analysis.
//!
//! Next to each computed value stands a bound of its error. With u the unit
//! roundoff and η the least subnormal:
//!
//! - of x ± y: e_x + e_y + u·|x ± y|
//! - of x·y: |x|·e_y + |y|·e_x + e_x·e_y + u·|x·y| + η
//! - of x/y: (e_x + |x/y|·e_y)/(|y| − e_y) + u·|x/y| + η, nothing if e_y ≥ |y|
//! - of a constant: u·|c| + η, once; of a library's sine 2u·|s|, and what its angle
//!   is off where that is a sum
//! - of a polynomial's sine: the error that was proved
//!
//! It needs no box and no search. What it gives is far from what happens, but
//! nothing that is right is ever beyond it.

use std::collections::BTreeMap;

use crate::program::ScalarType;
use crate::program::machine::Machine;
use crate::program::run::angle_value;
use crate::program::{AngleSum, Input, Library};
use crate::program::{Operand, Operation, Program};
use crate::sincos::AngleKernel;
use crate::states::JointState;

/// A computed value and a bound of its error.
#[derive(Clone, Copy, Debug)]
struct Bounded<T> {
    value: T,
    error: f64,
}

/// Bounds of a program's errors at a state of the scalar's own numbers, one a
/// result; infinite where nothing can be said.
pub fn errors(
    program: &Program,
    scalar: ScalarType,
    library: Library,
    sines: &[AngleKernel],
    state: &JointState,
) -> Vec<f64> {
    match scalar {
        ScalarType::F64 => Run::<f64>::new(scalar, library, state).errors(program, sines),
        ScalarType::F32 => Run::<f32>::new(scalar, library, state).errors(program, sines),
    }
}

struct Run<'s, T> {
    scalar: ScalarType,
    library: Library,
    state: &'s JointState,
    q: Vec<T>,
    trig: BTreeMap<Input, Bounded<T>>,
}

impl<'s, T: Machine> Run<'s, T> {
    fn new(scalar: ScalarType, library: Library, state: &'s JointState) -> Self {
        Run {
            scalar,
            library,
            state,
            q: state.q.iter().map(|&x| T::literal(x)).collect(),
            trig: BTreeMap::new(),
        }
    }

    fn errors(mut self, program: &Program, sines: &[AngleKernel]) -> Vec<f64> {
        for trig in &program.trig {
            let own = sines.iter().find(|sine| sine.angle == trig.angle);
            self.pair(trig.angle, own);
        }
        let mut steps: Vec<Bounded<T>> = Vec::with_capacity(program.steps.len());
        for step in &program.steps {
            let (x, y) = (
                self.read(&step.left, &steps),
                self.read(&step.right, &steps),
            );
            steps.push(self.operate(step.operation, x, y));
        }
        let outputs = program.outputs.iter();
        outputs
            .map(|output| sound(self.read(&output.value, &steps).error))
            .collect()
    }

    fn least(&self) -> f64 {
        2.0 * self.scalar.least_normal() * self.scalar.unit_roundoff()
    }

    fn pair(&mut self, angle: AngleSum, own: Option<&AngleKernel>) {
        let (u, computed) = (self.scalar.unit_roundoff(), angle_value(angle, &self.q));
        // A sum of angles is rounded; a sine moves no more than its angle.
        let reach: f64 = angle
            .terms()
            .map(|(joint, _)| self.state.q[joint].abs())
            .sum();
        let moved = 1.01 * angle.additions() as f64 * u * reach;
        let ((sin, cos), [sin_error, cos_error]) = match own {
            None => {
                let pair = self.library.pair(computed, true, true);
                // Within one ulp, and twice that to be generous.
                (
                    pair,
                    [pair.0, pair.1].map(|x| 4.0 * u * x.to_f64().abs() + self.least()),
                )
            }
            Some(own) => {
                let at = computed.to_f64();
                let inside = own.range.low() <= at && at <= own.range.high();
                let error = |x: f64| if inside { x } else { f64::INFINITY };
                let errors = [error(own.errors.sin), error(own.errors.cos)];
                (own.kernel.run(computed), errors)
            }
        };
        let bounded = |value, error: f64| Bounded {
            value,
            error: error + moved,
        };
        self.trig.insert(Input::Sin(angle), bounded(sin, sin_error));
        self.trig.insert(Input::Cos(angle), bounded(cos, cos_error));
    }

    fn read(&self, operand: &Operand, steps: &[Bounded<T>]) -> Bounded<T> {
        let exact = |value: f64| Bounded {
            value: T::literal(value),
            error: 0.0,
        };
        match operand {
            Operand::Step(step) => steps[*step],
            Operand::Constant(constant) => {
                let value = self.scalar.round(constant);
                Bounded {
                    error: self.scalar.unit_roundoff() * value.abs() + self.least(),
                    ..exact(value)
                }
            }
            Operand::Input(Input::Entry(argument, joint)) => {
                exact(self.state.entry(*argument, *joint))
            }
            Operand::Input(input) => self.trig.get(input).copied().unwrap_or(Bounded {
                error: f64::INFINITY,
                ..exact(0.0)
            }),
        }
    }

    fn operate(&self, operation: Operation, x: Bounded<T>, y: Bounded<T>) -> Bounded<T> {
        let value = operation.apply(&x.value, &y.value);
        let (a, b) = (x.value.to_f64().abs(), y.value.to_f64().abs());
        let carried = match operation {
            Operation::Add | Operation::Sub => x.error + y.error,
            Operation::Mul => a * y.error + b * x.error + x.error * y.error + self.least(),
            // |x/y − X/Y| = |(x/y)(Y − y) + (x − X)|/|Y|, and |Y| ≥ |y| − e_y.
            Operation::Div => {
                let divisor = b - y.error;
                match divisor > 0.0 {
                    true => (x.error + a / b * y.error) / (divisor * (1.0 - 1e-15)) + self.least(),
                    false => f64::INFINITY,
                }
            }
        };
        let own = self.scalar.unit_roundoff() * value.to_f64().abs();
        Bounded {
            value,
            // The bound's own arithmetic: a handful of roundings, upward.
            error: (carried + own) * (1.0 + 1e-14) + f64::from_bits(1),
        }
    }
}

/// A bound that is no number says nothing.
fn sound(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}
