//! Straight-line code: what a text says, without its names.

/// Where a sine or cosine comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A library that gives both within one ulp: libm, or dalembert-sines.
    Library,
    /// A block of arithmetic, of its index, and which of its values.
    Block(usize, usize),
}

/// A value; operands are indices of values before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node {
    /// A literal as the scalar holds it.
    Constant(f64),
    /// An entry of an argument, both counted from zero.
    Input(usize, usize),
    /// A sum.
    Add(usize, usize),
    /// A difference.
    Sub(usize, usize),
    /// A product.
    Mul(usize, usize),
    /// A quotient.
    Div(usize, usize),
    /// A product and a sum, rounded once.
    Fused(usize, usize, usize),
    /// The opposite, which is exact.
    Neg(usize),
    /// What stands for the sine of a value, or else for its cosine.
    Sine(usize, bool, Source),
}

/// A function.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// All values, in order.
    pub nodes: Vec<Node>,
    /// Blocks that compute sines; value 0 of each is the angle.
    pub blocks: Vec<Vec<Node>>,
    /// The values returned, of a matrix row by row.
    pub outputs: Vec<usize>,
}
