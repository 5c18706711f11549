//! A program over a box as polynomials in the rates.
//!
//! Torques are polynomials of low degree in velocities and accelerations,
//! whose coefficients depend on the positions. Plain intervals forget that
//! two values contain the same velocity; so every node is kept as
//!
//! Σ coefficient · monomial,
//!
//! the monomials being products of at most two rates, the coefficients
//! intervals that hold for every position in the sub-box. What a product has
//! beyond that degree is put into its coefficient as an interval.
//!
//! **Soundness.** The claim kept by every operation: for each state in the
//! sub-box there are coefficients in the intervals with which the polynomial
//! has the node's value. Sums and products of polynomials keep it, since
//! interval arithmetic does, and so does replacing a variable by its range.
//!
//! Which monomials occur is decided once, from the graph alone; a sub-box is
//! then a flat run over arrays. That run is no
//! [`Program`](crate::program::Program): a coefficient is the sum of up to
//! hundreds of products, and adding them in place keeps one interval for it,
//! where straight-line code would keep two for each product. And the product of
//! a coefficient with itself is its square, which an operation on two values
//! that do not know each other cannot see.
//!
//! - `compile`: which monomials occur
//! - `evaluate`: their coefficients over a sub-box

mod compile;
mod evaluate;

use crate::dag::Dag;
use crate::interval::Interval;
use crate::program::Input;

/// At most two rates, 1 … 2n and sorted; 0 is none.
type Monomial = [u8; 2];

/// One accumulation into a coefficient.
#[derive(Clone, Copy, Debug)]
enum Work {
    /// out += x
    Add(u32, u32),
    /// out −= x
    Sub(u32, u32),
    /// out += x·y·factor; factor 0 is one.
    Mul(u32, u32, u32, u32),
    /// An input's coefficients.
    Leaf(u32, Input),
    /// A constant.
    Constant(u32, Interval),
}

/// A graph compiled to polynomials.
#[derive(Clone, Debug)]
pub(crate) struct Forms {
    joints: usize,
    work: Vec<Work>,
    /// Ranges that products put into coefficients, by what they are made of.
    factors: Vec<Vec<u8>>,
    coefficients: usize,
    /// Of each output: its sign, and monomial and coefficient index.
    outputs: Vec<(bool, Vec<(Monomial, u32)>)>,
    /// Position joints that matter.
    pub(super) positions: Vec<usize>,
    /// Whether rates are variables.
    rates: bool,
}

/// Room for one evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    values: Vec<Interval>,
    factors: Vec<Interval>,
}

impl Forms {
    /// Compiles a graph's live part.
    pub(crate) fn new(graph: &Dag, joints: usize) -> Forms {
        Forms::compile(graph, joints, true)
            .or_else(|| Forms::compile(graph, joints, false))
            .unwrap_or_else(|| Forms::empty(joints))
    }

    fn empty(joints: usize) -> Forms {
        Forms {
            joints,
            work: Vec::new(),
            factors: vec![Vec::new()],
            coefficients: 0,
            outputs: Vec::new(),
            positions: Vec::new(),
            rates: false,
        }
    }
}
