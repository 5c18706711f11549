//! How likely a random point is to miss a difference.
//!
//! A program is a polynomial in its inputs. With every sine and cosine of
//! joint j a rational function of one parameter t_j of numerator degree 2
//! over 1 + t_j², a polynomial whose degree in the pair of joint j is e_j
//! becomes, times Π (1 + t_j²)^e_j, a polynomial of degree at most Σ 2e_j +
//! (the degree in everything else). Two different ones agree at a random
//! point of the field with probability at most degree/p (Schwartz–Zippel).
//! Constant angles are parameters like any other.

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use crate::graph::Input;
use crate::schedule::{Operand, Operation, Program};

/// Degrees of a polynomial: an upper bound, cancellation is not seen.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Degree {
    zero: bool,
    /// In the sine and cosine of each joint.
    joints: Vec<u32>,
    /// In all other inputs together.
    other: u32,
    /// In the sines and cosines of constant angles together.
    angles: u32,
}

impl Degree {
    /// Of an input.
    pub fn input(input: Input) -> Degree {
        let mut degree = Degree::one();
        match input.angle() {
            Some(angle) => {
                for (joint, _) in angle.terms() {
                    degree.joints.resize(joint + 1, 0);
                    degree.joints[joint] = 1;
                }
            }
            None => degree.other = 1,
        }
        degree
    }

    /// Of a constant: its degree in the pairs of constant angles.
    pub fn constant(constant: &Exact) -> Degree {
        let generator = Degree {
            angles: 1,
            ..Degree::one()
        };
        constant
            .map(&mut |_| Some(Degree::one()), &mut |_| {
                dalembert_model::equations::Rotor {
                    sin: generator.clone(),
                    cos: generator.clone(),
                }
            })
            .unwrap_or_else(Degree::one)
    }

    /// The degree in the random parameters.
    pub fn bound(&self) -> u64 {
        let pairs: u64 = self.joints.iter().map(|&e| 2 * u64::from(e)).sum();
        pairs + u64::from(self.other) + 2 * u64::from(self.angles)
    }

    fn combine(&self, other: &Degree, f: impl Fn(u32, u32) -> u32) -> Degree {
        let n = self.joints.len().max(other.joints.len());
        let at = |degree: &Degree, i: usize| degree.joints.get(i).copied().unwrap_or(0);
        Degree {
            zero: false,
            joints: (0..n).map(|i| f(at(self, i), at(other, i))).collect(),
            other: f(self.other, other.other),
            angles: f(self.angles, other.angles),
        }
    }
}

impl Scalar for Degree {
    fn zero() -> Self {
        Degree {
            zero: true,
            ..Degree::default()
        }
    }
    fn one() -> Self {
        Degree::default()
    }
    fn add(&self, other: &Self) -> Self {
        match (self.zero, other.zero) {
            (true, _) => other.clone(),
            (_, true) => self.clone(),
            _ => self.combine(other, u32::max),
        }
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }
    fn mul(&self, other: &Self) -> Self {
        if self.zero || other.zero {
            return Degree::zero();
        }
        self.combine(other, u32::saturating_add)
    }
    fn neg(&self) -> Self {
        self.clone()
    }
    fn half(&self) -> Self {
        self.clone()
    }
    fn is_zero(&self) -> bool {
        self.zero
    }
}

impl Program {
    /// The degrees of every output.
    pub fn degrees(&self) -> Vec<Degree> {
        let mut steps: Vec<Degree> = Vec::with_capacity(self.steps.len());
        let of = |operand: &Operand, steps: &[Degree]| match operand {
            Operand::Input(input) => Degree::input(*input),
            Operand::Constant(c) if c.is_zero() => Degree::zero(),
            Operand::Constant(c) => Degree::constant(c),
            Operand::Step(index) => steps[*index].clone(),
        };
        for step in &self.steps {
            let (left, right) = (of(&step.left, &steps), of(&step.right, &steps));
            steps.push(match step.operation {
                Operation::Mul => left.mul(&right),
                Operation::Add | Operation::Sub => left.add(&right),
            });
        }
        self.outputs
            .iter()
            .map(|output| of(&output.value, &steps))
            .collect()
    }
}

/// log₁₀ of the probability that `outputs` differences of this degree are all
/// missed at `points` points, from above.
pub fn failure_exponent(degree: u64, outputs: usize, points: usize) -> i32 {
    // Decimal logarithms rounded up in integers: no libm in a stated bound.
    let digits = |x: u64| x.max(1).ilog10() as i32 + 1;
    let prime = Field::P.ilog10() as i32;
    points as i32 * (digits(degree) - prime) + digits(outputs as u64)
}
