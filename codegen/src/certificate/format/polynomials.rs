//! The code of an angle's sine and cosine, with what is claimed of it.

use serde::Serialize;

use super::Ends;
use crate::program::kernel::{Kernel, KernelStep, Term, Value};
use crate::sincos::AngleKernel;

/// One angle's.
#[derive(Serialize)]
pub(super) struct Polynomials {
    angle: String,
    range: Ends,
    /// The largest errors that are claimed; zero for what is not computed.
    sin: f64,
    cos: f64,
    /// `x1 * 0.5`: `q` is the angle, `x1` the first step.
    steps: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sine: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
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
}

fn write(term: Term) -> String {
    match term {
        Term::Input(_) => "q".into(),
        Term::Constant(value) => format!("{:?}", value.0),
        Term::Step(step) => format!("x{}", step + 1),
    }
}
