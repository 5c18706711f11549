//! The code of an angle's sine and cosine, with what is claimed of it.

use serde::{Deserialize, Serialize};

use super::Ends;
use super::error::{FormatFault, PolynomialFault};
use crate::interval::Interval;
use crate::program::AngleSum;
use crate::program::Operation;
use crate::program::ScalarType;
use crate::program::kernel::{ANGLE, Kernel, KernelStep, Term, Value, literal};
use crate::sincos::AngleKernel;
use crate::sincos::proof::Errors;

/// One angle's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Polynomials {
    angle: String,
    range: Ends,
    /// The largest errors that are claimed; zero for what is not computed.
    sin: f64,
    cos: f64,
    /// `x1 * 0.5`: `q` is the angle, `x1` the first step.
    steps: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sine: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cosine: Option<String>,
}

impl Polynomials {
    pub(super) fn of(sine: &AngleKernel) -> Polynomials {
        let Kernel { steps, sin, cos } = &sine.kernel;
        let line = |step: &KernelStep| {
            let symbol = step.operation.symbol();
            format!("{} {symbol} {}", write(step.left), write(step.right))
        };
        let result = |value: &Option<Value>| {
            value.map(|value| {
                let sign = if value.negative { "~" } else { "" };
                format!("{sign}{}", write(value.value))
            })
        };
        Polynomials {
            angle: sine.angle.to_string(),
            range: [sine.range.low(), sine.range.high()],
            sin: sine.errors.sin,
            cos: sine.errors.cos,
            steps: steps.iter().map(line).collect(),
            sine: result(sin),
            cosine: result(cos),
        }
    }

    /// The claim. What kind of polynomials they are is for people; the proof
    /// is of the steps.
    pub(super) fn sines(&self, scalar: ScalarType) -> Result<AngleKernel, FormatFault> {
        let of = &self.angle;
        let fail = |fault| FormatFault::Polynomials(of.clone(), fault);
        let angle: AngleSum = of.parse().map_err(|()| fail(PolynomialFault::Angle))?;
        let [low, high] = self.range;
        let mut kernel = Kernel::default();
        for (index, line) in self.steps.iter().enumerate() {
            let step = read_step(line, index, scalar);
            let step = step.ok_or_else(|| fail(PolynomialFault::Step(index + 1, line.clone())))?;
            kernel.steps.push(step);
        }
        let result = |word: &Option<String>| match word {
            None => Ok(None),
            Some(word) => read_value(word, kernel.steps.len(), scalar)
                .map(Some)
                .ok_or_else(|| fail(PolynomialFault::Value(word.clone()))),
        };
        let (sin, cos) = (result(&self.sine)?, result(&self.cosine)?);
        Ok(AngleKernel {
            angle,
            range: Interval::new(low, high).ok_or_else(|| fail(PolynomialFault::Range))?,
            form: String::new(),
            kernel: Kernel { sin, cos, ..kernel },
            errors: Errors {
                sin: self.sin,
                cos: self.cos,
            },
        })
    }
}

fn write(term: Term) -> String {
    match term {
        Term::Input(_) => "q".into(),
        Term::Constant(value) => format!("{:?}", value.0),
        Term::Step(step) => format!("x{}", step + 1),
    }
}

fn read_step(line: &str, before: usize, scalar: ScalarType) -> Option<KernelStep> {
    let words: Vec<&str> = line.split(' ').collect();
    let &[left, symbol, right] = words.as_slice() else {
        return None;
    };
    let mut operations = [Operation::Add, Operation::Sub, Operation::Mul].into_iter();
    Some(KernelStep {
        operation: operations.find(|op| symbol.chars().eq([op.symbol()]))?,
        left: read_term(left, before, scalar)?,
        right: read_term(right, before, scalar)?,
    })
}

fn read_value(word: &str, before: usize, scalar: ScalarType) -> Option<Value> {
    let (negative, word) = match word.strip_prefix('~') {
        Some(rest) => (true, rest),
        None => (false, word),
    };
    let value = read_term(word, before, scalar)?;
    Some(Value { negative, value })
}

fn read_term(word: &str, before: usize, scalar: ScalarType) -> Option<Term> {
    if word == "q" {
        return Some(ANGLE);
    }
    if let Some(step) = word.strip_prefix('x') {
        let step = step.parse::<usize>().ok()?.checked_sub(1)?;
        return (step < before).then_some(Term::Step(step));
    }
    let value: f64 = word.parse().ok()?;
    let held = value.is_finite() && scalar.nearest(value) == value;
    held.then(|| literal(value))
}
