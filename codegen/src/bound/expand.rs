//! A graph written out as a trigonometric polynomial.
//!
//! Over a sub-box, intervals forget that two values depend on the same angle. Written out, the
//! terms of a difference that cancel are gone, and each coefficient stands once:
//!
//! Σ coefficient · (product of at most two rates) · Π_j sin^a(q_j) cos^b(q_j)
//!
//! with a ∈ {0, 1}, since sin² = 1 − cos². A sliding joint is written as q = middle + radius·cos θ,
//! which takes every position of its range; θ stands where an angle would, so a graph that reads a
//! joint's position and its sine or cosine as well is not written out.
//!
//! **Soundness.** Only identities are used, and coefficients are intervals rounded outward: there
//! are coefficients inside them with which the polynomial is the output, exactly.

use crate::bound::input_box::InputBox;
use crate::bound::work;
use crate::dag::{Dag, Node};
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::{Input, Operation};

/// Powers packed: two rates (1 … 2n, sorted, 0 is none) in a byte each, then
/// five bits a joint: the power of the cosine, and the sine's on top.
pub(super) type Key = u128;

const MAX_JOINTS: usize = 22;

pub(super) type Polynomial = Vec<(Key, Interval)>;

const MAX_PRODUCTS: usize = 4_000_000;

const MAX_WORK: usize = 100_000_000;

const TERMS: usize = 16;

pub(super) fn expand(graph: &Dag, limits: &InputBox) -> Option<Vec<Polynomial>> {
    let mut found: Vec<Polynomial> = vec![Vec::new(); graph.nodes.len()];
    visit(graph, limits, &mut |node, polynomial| {
        found[node] = polynomial.clone();
    })?;
    let outputs = graph.outputs.iter().map(|edge| {
        let mut value = found[edge.index()].clone();
        if edge.negative {
            value.iter_mut().for_each(|term| term.1 = -term.1);
        }
        value
    });
    Some(outputs.collect())
}

/// Each node comes once and without a sign, and is not kept longer than others are made of it.
pub(super) fn visit(
    graph: &Dag,
    limits: &InputBox,
    show: &mut dyn FnMut(usize, &Polynomial),
) -> Option<()> {
    let reads = graph.reads();
    if limits.joints() > MAX_JOINTS || mixes(graph) {
        return None;
    }
    let mut last_use = vec![0; graph.nodes.len()];
    for (index, node) in graph.nodes.iter().enumerate() {
        if reads[index] > 0 {
            for operand in node.operands().into_iter().flatten() {
                last_use[operand as usize] = index;
            }
        }
    }
    let mut is_output = vec![false; graph.nodes.len()];
    for output in &graph.outputs {
        is_output[output.index()] = true;
    }
    let mut values: Vec<Polynomial> = Vec::with_capacity(graph.nodes.len());
    let mut work = 0;
    for (index, node) in graph.nodes.iter().enumerate() {
        let value = match node {
            _ if reads[index] == 0 => Vec::new(),
            Node::Constant(constant) => vec![(0, Interval::exact(constant))],
            Node::Input(input) => leaf(*input, limits)?,
            Node::Apply(operation @ (Operation::Add | Operation::Sub), operands) => {
                let [a, b] = operands.map(|id| &values[id as usize]);
                sum(a, b, *operation == Operation::Sub)
            }
            Node::Apply(Operation::Mul | Operation::Fused, operands) => {
                let [a, b] = operands.map(|id| &values[id as usize]);
                work += a.len() * b.len();
                work::count(1 + a.len() * b.len() / TERMS);
                if work > MAX_WORK {
                    return None;
                }
                product(a, b)?
            }
            Node::Apply(Operation::Div, _) => return None,
        };
        if is_output[index] {
            show(index, &value);
        }
        values.push(if last_use[index] > index {
            value
        } else {
            Vec::new()
        });
        if reads[index] > 0 {
            for operand in node.operands().into_iter().flatten() {
                if last_use[operand as usize] == index {
                    values[operand as usize] = Vec::new();
                }
            }
        }
    }
    Some(())
}

/// A joint's position would have the same place in a key as its sine or cosine.
fn mixes(graph: &Dag) -> bool {
    let (mut slides, mut turns) = (0u64, 0u64);
    for (_, node) in graph.live() {
        match node {
            Node::Input(Input::Entry(Argument::Position, joint)) => slides |= 1 << joint,
            Node::Input(Input::Sin(joint) | Input::Cos(joint)) => turns |= 1 << joint,
            _ => {}
        }
    }
    slides & turns != 0
}

pub(super) const fn shift(joint: usize) -> usize {
    16 + 5 * joint
}

pub(super) fn powers(key: Key, joint: usize) -> (u32, u32) {
    let bits = (key >> shift(joint)) as u32 & 31;
    (bits & 15, bits >> 4)
}

pub(super) fn rates(key: Key) -> [u8; 2] {
    [(key >> 8) as u8, key as u8]
}

fn leaf(input: Input, limits: &InputBox) -> Option<Polynomial> {
    let n = limits.joints();
    let cosine = |joint: usize| 1u128 << shift(joint);
    let sine = |joint: usize| 16u128 << shift(joint);
    Some(match input {
        Input::Entry(Argument::Velocity, joint) => vec![(joint as u128 + 1, Interval::ONE)],
        Input::Entry(Argument::Acceleration, joint) => {
            vec![((n + joint) as u128 + 1, Interval::ONE)]
        }
        Input::Entry(Argument::Position, joint) => {
            let q = limits.position[joint];
            let middle = (0, Interval::point(q.mid()));
            vec![middle, (cosine(joint), Interval::point(q.radius()))]
        }
        Input::Sin(joint) => vec![(sine(joint), Interval::ONE)],
        Input::Cos(joint) => vec![(cosine(joint), Interval::ONE)],
        // No box bounds it.
        Input::PerSpeed(_) | Input::Entry(..) => return None,
    })
}

fn sum(a: &Polynomial, b: &Polynomial, minus: bool) -> Polynomial {
    let signed = |&(key, x): &(Key, Interval)| (key, if minus { -x } else { x });
    let mut terms = Vec::with_capacity(a.len() + b.len());
    terms.extend_from_slice(a);
    terms.extend(b.iter().map(signed));
    added_up(terms)
}

fn product(a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
    if a.len() * b.len() > MAX_PRODUCTS {
        return None;
    }
    let mut terms = Vec::with_capacity(a.len() * b.len());
    for (x, p) in a {
        for (y, q) in b {
            let coefficient = if *p == Interval::ONE {
                *q
            } else if *q == Interval::ONE {
                *p
            } else {
                *p * *q
            };
            multiply(*x, *y, coefficient, &mut terms)?;
            // A pair is more than one term if it has sines in common.
            if terms.len() > MAX_PRODUCTS {
                return None;
            }
        }
    }
    Some(added_up(terms))
}

pub(super) fn added_up(mut terms: Polynomial) -> Polynomial {
    // Stable: the sums are rounded in that order, and runs that are sorted are merged.
    terms.sort_by_key(|&(key, _)| key);
    terms.dedup_by(|next, sum| {
        let same = next.0 == sum.0;
        if same {
            sum.1 = sum.1 + next.1;
        }
        same
    });
    terms.shrink_to_fit();
    terms
}

fn multiply(x: Key, y: Key, coefficient: Interval, out: &mut Polynomial) -> Option<()> {
    let [a, b] = rates(x);
    let [c, d] = rates(y);
    let mut kept = [a, b, c, d];
    kept.sort_unstable();
    if kept[1] != 0 {
        return None;
    }
    let mut key = u128::from(kept[2]) << 8 | u128::from(kept[3]);
    let (mut x, mut y) = (x >> 16, y >> 16);
    let mut joint = 0;
    let mut squares = [0usize; MAX_JOINTS];
    let mut count = 0;
    while x != 0 || y != 0 {
        let cos = (x & 15) + (y & 15);
        // Two more may come from a squared sine.
        if cos > 13 {
            return None;
        }
        let (s, t) = (x >> 4 & 1, y >> 4 & 1);
        key |= (cos | (s ^ t) << 4) << shift(joint);
        if s & t == 1 {
            squares[count] = joint;
            count += 1;
        }
        (x, y, joint) = (x >> 5, y >> 5, joint + 1);
    }
    for choice in 0..1u32 << count {
        let mut split = key;
        for (bit, &joint) in squares[..count].iter().enumerate() {
            if choice >> bit & 1 == 1 {
                split += 2 << shift(joint);
            }
        }
        let negative = choice.count_ones() % 2 == 1;
        out.push((split, if negative { -coefficient } else { coefficient }));
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::{Builder, Folding};

    #[test]
    fn an_angle_that_is_read_as_a_number_is_not_written_out() {
        let limits = InputBox::symmetric(&[3.2; 2], &[0.0; 2], &[0.0; 2]);
        let written = |slides: usize| {
            let mut builder = Builder::new(Folding::Syntactic);
            let sine = builder.input(Input::Sin(0));
            let position = builder.input(Input::Entry(Argument::Position, slides));
            let output = builder.sub(sine, position);
            expand(&builder.finish(vec![output]), &limits)
        };
        assert_eq!(written(0), None);
        assert_eq!(written(1).unwrap()[0].len(), 3);
    }
}
