//! The range table: how large each intermediate can become over a box.
//!
//! The intervals are those of the rounding bound, so they contain what is
//! computed, not only what is exact.

use crate::bound::input_box::InputBox;
use crate::bound::sensitivity::{Constants, forward};
use crate::bound::subdivide::sub_boxes;
use crate::dag::Node;
use crate::program::{Program, ScalarType};
use crate::sincos::AngleKernel;

/// Sub-boxes of the range table of a certificate.
pub(crate) const RANGE_BOXES: usize = 256;

/// The largest magnitude of each step, and what is wrong with them.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranges {
    /// Of each step.
    pub magnitudes: Vec<f64>,
    /// What the scalar cannot hold.
    pub findings: Vec<Finding>,
}

/// What a scalar cannot hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// A step may overflow; its bound.
    Overflow {
        /// Which, from zero.
        step: usize,
        /// How large it can become.
        magnitude: f64,
    },
    /// A constant of a step is no finite number of the scalar, or rounds to
    /// zero: an error.
    Constant {
        /// Which step reads it.
        step: usize,
        /// What it rounds to.
        rounded: f64,
    },
    /// A constant is subnormal, so its relative error may exceed u: a
    /// warning. The rounding bound takes its true error.
    Subnormal {
        /// Which step reads it.
        step: usize,
        /// What it rounds to.
        rounded: f64,
    },
}

impl Finding {
    /// Returns whether code with it must not be emitted.
    pub fn is_error(self) -> bool {
        !matches!(self, Finding::Subnormal { .. })
    }
}

impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Finding::Overflow { step, magnitude } => {
                write!(f, "t{} may reach {magnitude:e}: it may overflow", step + 1)
            }
            Finding::Constant { step, rounded } => {
                write!(f, "a constant of t{} rounds to {rounded:e}", step + 1)
            }
            Finding::Subnormal { step, rounded } => {
                write!(f, "a constant of t{} is subnormal: {rounded:e}", step + 1)
            }
        }
    }
}

/// Returns the range table over a box, from at most `boxes` sub-boxes; sines are
/// libm's where there are no polynomials for them.
pub fn ranges(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
    boxes: usize,
) -> Ranges {
    let dag = &program.dag;
    let operations: Vec<_> = dag.operations().collect();
    let mut magnitudes = vec![0.0f64; operations.len()];
    let constants = Constants::new(program, scalar, sines);
    for sub in sub_boxes(program, limits, boxes) {
        let run = forward(&constants, &sub);
        for (most, (id, ..)) in magnitudes.iter_mut().zip(&operations) {
            *most = most.max(run.values[*id as usize].magnitude());
        }
    }
    let largest = match scalar {
        ScalarType::F64 => f64::MAX,
        ScalarType::F32 => f64::from(f32::MAX),
    };
    let mut findings = Vec::new();
    for (step, ((.., operands), &magnitude)) in operations.iter().zip(&magnitudes).enumerate() {
        if magnitude > largest {
            findings.push(Finding::Overflow { step, magnitude });
        }
        for operand in operands {
            use dalembert_model::scalar::Scalar;
            let Node::Constant(constant) = dag.node(*operand) else {
                continue;
            };
            let rounded = scalar.round(constant);
            if !rounded.is_finite() || (rounded == 0.0 && !constant.is_zero()) {
                findings.push(Finding::Constant { step, rounded });
            } else if rounded != 0.0 && rounded.abs() < scalar.least_normal() {
                findings.push(Finding::Subnormal { step, rounded });
            }
        }
    }
    Ranges {
        magnitudes,
        findings,
    }
}
