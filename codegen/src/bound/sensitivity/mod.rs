//! What rounding costs.
//!
//! **Model** (named in certificates). Every operation gives (x ∘ y)(1 + δ) + η with |δ| ≤ u, |η| ≤
//! half the least subnormal for products and η = 0 for sums; literals are constants rounded once;
//! `sin` and `cos` are a library's within one ulp, which is at most u·2 relative and u absolute, or
//! within the errors that are proved of polynomials; nothing is contracted to a fused multiply-add
//! but what the program fuses: there the product has neither δ nor η, and the sum that takes it an
//! η as products have.
//!
//! **Why nothing of second order is left.** Let x̂ be the computed value of a node, x the exact
//! one, e = x̂ − x. For a product x·y the error is x̂·e_y + y·e_x + r, for a sum e_x + e_y + r,
//! where r is the node's own rounding, |r| ≤ u·|x̂ ∘ ŷ| + η. These are identities, so the error of
//! an output is exactly Σ r_node·ā_node with adjoints ā that take the partial derivatives at x̂ and
//! y instead of x and y. There are two bounds of this sum, both sound, and the smaller counts:
//!
//! - `extremes`, `magnitudes`: the largest |value| and |adjoint| of each node over the box, written
//!   out as trigonometric polynomials; their products, and what mixed adjoints can be off
//! - `intervals`: interval arithmetic over sub-boxes; for programs that are
//!   too large to be written out, narrow boxes and large errors

mod extremes;
mod intervals;
mod magnitudes;

use crate::bound::distinct::Distinct;
use crate::bound::input_box::InputBox;
use crate::bound::magnitude::BoxEffort;
use crate::dag::Node;
use crate::program::{Program, ScalarType};
use crate::sincos::AngleKernel;
use extremes::Extremes;
use intervals::Constants;
pub(crate) use intervals::overflows;

/// The fineness of a bound: a finer one is tighter and dearer. Every one is sound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundEffort {
    /// For the bound of the edits.
    pub budget: BoxEffort,
    /// Sub-boxes of the rounding bound by intervals.
    pub boxes: usize,
    /// Points of a grid for each value and adjoint that rounding counts with.
    pub points: usize,
}

impl BoundEffort {
    /// For certificates: seconds for a six-joint arm.
    pub const CERTIFY: BoundEffort = BoundEffort {
        budget: BoxEffort::CERTIFY,
        boxes: 512,
        points: 1 << 14,
    };
    /// For who waits, as a compiler does.
    pub const QUICK: BoundEffort = BoundEffort {
        budget: BoxEffort {
            boxes: 2_000,
            points: 1 << 18,
        },
        boxes: 64,
        points: 1 << 8,
    };
}

/// Bounds of one output's rounding error, in its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rounding {
    /// From operations and constants.
    pub arithmetic: f64,
    /// From sines and cosines.
    pub sincos: f64,
}

impl Rounding {
    pub(crate) fn total(self) -> f64 {
        self.arithmetic + self.sincos
    }

    fn each(self, other: Rounding, of: fn(f64, f64) -> f64) -> Rounding {
        Rounding {
            arithmetic: of(self.arithmetic, other.arithmetic),
            sincos: of(self.sincos, other.sincos),
        }
    }

    fn note(&mut self, node: &Node, error: f64) {
        match node {
            Node::Input(_) => self.sincos += error,
            Node::Constant(_) | Node::Apply(..) => self.arithmetic += error,
        }
    }
}

const FEW: usize = 64;

pub(crate) fn rounding(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
) -> Vec<Rounding> {
    intervals::rounding(&Constants::new(program, scalar, sines), limits, FEW)
}

/// The dearest part of every bound of a program's rounding over a box, for any scalar and sines.
#[derive(Clone, Debug)]
pub struct Sensitivity {
    of: Program,
    /// Equal outputs once.
    program: Program,
    distinct: Distinct,
    limits: InputBox,
    bound_effort: BoundEffort,
    extremes: Option<Extremes>,
}

impl Sensitivity {
    /// Bounds the values and adjoints of a program over a box.
    pub fn new(program: &Program, limits: &InputBox, bound_effort: BoundEffort) -> Sensitivity {
        let outputs = program.dag.outputs.iter();
        let operations = outputs.map(|output| match program.dag.node(output.node) {
            Node::Apply(..) => Some(output.node),
            Node::Constant(_) | Node::Input(_) => None,
        });
        let distinct = Distinct::by(operations);
        let mut once = program.clone();
        once.dag.outputs = distinct.pick(&program.dag.outputs);
        Sensitivity {
            extremes: Extremes::new(&once, limits, bound_effort.points),
            of: program.clone(),
            program: once,
            distinct,
            limits: limits.clone(),
            bound_effort,
        }
    }

    /// Returns whether it is of this program, over its box, and as fine.
    pub fn is_of(&self, program: &Program, limits: &InputBox, bound_effort: BoundEffort) -> bool {
        self.of == *program && self.limits == *limits && self.bound_effort == bound_effort
    }

    /// Bounds each output's rounding, with polynomials for sines, whose errors are as they are
    /// claimed; the sines of other angles are a library's, within one ulp.
    pub fn rounding(&self, scalar: ScalarType, sines: &[AngleKernel]) -> Vec<Rounding> {
        let constants = Constants::new(&self.program, scalar, sines);
        let (limits, boxes) = (&self.limits, self.bound_effort.boxes);
        let coarse = intervals::rounding(&constants, limits, boxes);
        let Some(extremes) = &self.extremes else {
            return self.distinct.scatter(&coarse);
        };
        let fine = magnitudes::rounding(&constants, limits, extremes);
        let pairs = coarse.into_iter().zip(fine);
        let least: Vec<Rounding> = pairs.map(|(a, b)| a.each(b, f64::min)).collect();
        self.distinct.scatter(&least)
    }
}
