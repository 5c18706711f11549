//! Straight-line code over literals: what is printed, read back and run.

use dalembert_model::number::Exact;

use super::kernel::Kernel;
use super::{AngleSum, Counts, Input, Library, Literal, Output, Program, ScalarType, Speed, Step};

/// A program lowered to a scalar: every constant rounded once, and how each
/// angle's sine and cosine are computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Lowered {
    /// The scalar.
    pub scalar: ScalarType,
    /// Who computes the sines that are called; libm where none is.
    pub library: Library,
    /// Sines and cosines.
    pub trig: Vec<LoweredTrig>,
    /// The joints of which r is read, ascending.
    pub speeds: Vec<Speed<Literal>>,
    /// The arithmetic.
    pub steps: Vec<Step<Literal>>,
    /// The results.
    pub outputs: Vec<Output<Literal>>,
}

/// The sine and cosine of an angle.
#[derive(Clone, Debug, PartialEq)]
pub struct LoweredTrig {
    /// The angle.
    pub angle: AngleSum,
    /// `true` if the sine is taken.
    pub sin: bool,
    /// `true` if the cosine is taken.
    pub cos: bool,
    /// The polynomials, unless a library is called.
    pub kernel: Option<Kernel>,
}

impl Program {
    /// Returns the program in a scalar; an angle without a kernel calls libm.
    pub fn lower<'k>(
        &self,
        scalar: ScalarType,
        kernel: impl Fn(AngleSum) -> Option<&'k Kernel>,
    ) -> Lowered {
        let rounded = |value: &Exact| Literal(scalar.round(value));
        let same = |input: &Input| *input;
        let trig = self.trig.iter().map(|trig| LoweredTrig {
            angle: trig.angle,
            sin: trig.sin,
            cos: trig.cos,
            kernel: kernel(trig.angle).cloned(),
        });
        let speeds = self.speeds.iter().map(|own| Speed {
            joint: own.joint,
            square: Literal(scalar.round(&own.square)),
        });
        let steps = self.steps.iter().map(|step| step.map(rounded, same));
        let outputs = self.outputs.iter();
        let outputs = outputs.map(|output| output.map(rounded, same));
        Lowered {
            scalar,
            library: Library::Libm,
            trig: trig.collect(),
            speeds: speeds.collect(),
            steps: steps.collect(),
            outputs: outputs.collect(),
        }
    }
}

impl Lowered {
    /// Returns the program with another library for the angles that call one. A library that
    /// takes all angles together is called after the sines that are computed alone.
    #[must_use]
    pub fn calling(mut self, library: Library) -> Lowered {
        let calls = |trig: &LoweredTrig| trig.kernel.is_none();
        if self.trig.iter().any(calls) {
            self.library = library;
        }
        if self.library == Library::Together {
            self.trig.sort_by_key(calls);
        }
        self
    }

    /// Returns the program with libm's sines in place of all others, to measure what rounding
    /// costs the rest.
    #[must_use]
    pub fn with_libm(&self) -> Lowered {
        let mut other = self.clone();
        other.library = Library::Libm;
        for trig in &mut other.trig {
            trig.kernel = None;
        }
        other
    }

    /// Counts the operations, with those of the polynomials for sines.
    pub fn counts(&self) -> Counts {
        let steps = Counts::of_steps(&self.steps);
        let angles: usize = self.trig.iter().map(|t| t.angle.additions()).sum();
        let kernels = self.trig.iter().filter_map(|t| t.kernel.as_ref());
        let trig = kernels.map(Kernel::counts);
        let (trig_mul, trig_add) = trig.fold((0, 0), |(m, a), (mul, add)| (m + mul, a + add));
        let own = Counts {
            add: steps.add + angles,
            sincos: self.trig.len(),
            trig_mul,
            trig_add,
            ..steps
        };
        own.with_speeds(self.speeds.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::Argument;
    use crate::program::{Operand, Operation, evaluate};

    fn code() -> Lowered {
        let step = |left, right| Step {
            operation: Operation::Sub,
            left,
            right,
        };
        Lowered {
            scalar: ScalarType::F64,
            library: Library::Libm,
            trig: Vec::new(),
            speeds: Vec::new(),
            steps: vec![
                step(
                    Operand::Input(Input::Entry(Argument::Velocity, 0)),
                    Operand::Constant(Literal(0.0)),
                ),
                step(
                    Operand::Step(0),
                    Operand::Input(Input::Entry(Argument::Acceleration, 1)),
                ),
            ],
            outputs: vec![Output {
                negative: true,
                value: Operand::Step(1),
            }],
        }
    }

    /// Whatever is changed, it is another program, and said where.
    #[test]
    fn another_program_differs() {
        type Change = (fn(&mut Lowered), &'static str);
        let changes: [Change; 7] = [
            (|c| c.scalar = ScalarType::F32, "the scalars differ"),
            (
                |c| c.library = Library::Together,
                "the libraries of sines differ",
            ),
            (
                |c| c.steps[0].right = Operand::Constant(Literal(-0.0)),
                "operation t1 differs",
            ),
            (
                |c| c.steps[1].operation = Operation::Add,
                "operation t2 differs",
            ),
            (|c| c.steps.truncate(1), "the number of operations differs"),
            (|c| c.outputs[0].negative = false, "result 0 differs"),
            (|c| c.outputs.clear(), "the number of results differs"),
        ];
        assert_eq!(code().difference(&code()), None);
        for (change, words) in changes {
            let mut other = code();
            change(&mut other);
            let found = code().difference(&other).map(|found| found.to_string());
            assert_eq!(found.as_deref(), Some(words));
        }
    }

    /// −((3 − 0) − 5), and no number where a value is missing or comes later.
    #[test]
    fn what_cannot_be_read_has_no_value() {
        let input = |input: &Input| match input {
            Input::Entry(Argument::Velocity, 0) => Some(3.0),
            Input::Entry(Argument::Acceleration, 1) => Some(5.0),
            _ => None,
        };
        let constant = |literal: &Literal| Some(literal.0);
        let run = |code: &Lowered| evaluate(&code.steps, &code.outputs, input, constant);
        assert_eq!(run(&code()), Some(vec![2.0]));
        for (left, right) in [
            (Operand::Step(1), Operand::Step(0)),
            (
                Operand::Input(Input::Entry(Argument::Velocity, 7)),
                Operand::Step(0),
            ),
            (Operand::Step(usize::MAX), Operand::Step(0)),
        ] {
            let mut other = code();
            (other.steps[1].left, other.steps[1].right) = (left, right);
            assert_eq!(run(&other), None);
        }
    }
}
