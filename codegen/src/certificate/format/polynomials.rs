//! The code of an angle's sine and cosine, with what is claimed of it.

use serde::Serialize;

use super::Ends;
use crate::dag::{Id, Node};
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
        let kernel = &sine.kernel;
        let numbers = kernel.dag.numbers();
        let term = |id: Id| match kernel.dag.node(id) {
            Node::Input(_) => "q".to_owned(),
            Node::Constant(value) => format!("{:?}", value.0),
            Node::Apply(..) => format!("x{}", numbers[id as usize].unwrap_or_default()),
        };
        let steps = kernel.dag.operations();
        let steps = steps.map(|(_, operation, [left, right])| {
            format!("{} {} {}", term(left), operation.symbol(), term(right))
        });
        let [sin, cos] = kernel.results().map(|result| {
            let edge = result?;
            let sign = if edge.negative { "~" } else { "" };
            Some(format!("{sign}{}", term(edge.node)))
        });
        Polynomials {
            angle: (sine.joint + 1).to_string(),
            range: [sine.range.low(), sine.range.high()],
            sin: sine.errors.sin,
            cos: sine.errors.cos,
            steps: steps.collect(),
            sine: sin,
            cosine: cos,
        }
    }
}
