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

/// Joints that turn, and whether their angles are subtracted.
pub type Angle = Vec<(usize, bool)>;

/// The most joints of an angle.
const MOST_SUMMED: usize = 32;

impl Program {
    /// Returns for each value the angle that it is, none of what is no signed sum of positions of
    /// joints that turn.
    pub fn angles(&self, turns: impl Fn(usize) -> bool) -> Vec<Option<Angle>> {
        let mut all: Vec<Option<Angle>> = Vec::with_capacity(self.nodes.len());
        let signed = |angle: &Option<Angle>, minus: bool| -> Option<Angle> {
            let joints = angle.as_ref()?.iter();
            Some(
                joints
                    .map(|&(joint, negative)| (joint, negative != minus))
                    .collect(),
            )
        };
        for &node in &self.nodes {
            let angle = match node {
                Node::Input(0, joint) if turns(joint) => Some(vec![(joint, false)]),
                Node::Neg(a) => signed(&all[a], true),
                Node::Add(a, b) | Node::Sub(a, b) => {
                    let other = signed(&all[b], matches!(node, Node::Sub(..)));
                    let both = all[a].clone().zip(other);
                    let sum = both.map(|(angle, other)| [angle, other].concat());
                    sum.filter(|sum| sum.len() <= MOST_SUMMED)
                }
                _ => None,
            };
            all.push(angle);
        }
        all
    }
}
