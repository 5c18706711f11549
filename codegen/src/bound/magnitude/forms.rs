//! A graph over a box as polynomials in the rates.
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
//! Which monomials occur is decided once, from the graph alone; a sub-box is then a flat run over
//! arrays. That run is no [`Program`](crate::program::Program): a coefficient is the sum of up to
//! hundreds of products, and adding them in place keeps one interval for it, where straight-line
//! code would keep two for each product. And the product of a coefficient with itself is its
//! square, which an operation on two values that do not know each other cannot see.

use std::collections::{BTreeMap, BTreeSet};

use crate::bound::input_box::InputBox;
use crate::dag::{Dag, Node};
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::{Input, Operation};

/// Above this much work a product, rates are taken as plain intervals.
const MAX_PRODUCTS: usize = 400_000;

/// At most two rates, 1 … 2n and sorted; 0 is none.
type Monomial = [u8; 2];

#[derive(Clone, Copy, Debug)]
enum Work {
    Constant(u32, Interval),
    Input(u32, Input),
    Add(u32, u32),
    Sub(u32, u32),
    /// x·y·factor; factor 0 is one.
    Mul(u32, u32, u32, u32),
}

#[derive(Clone, Debug, Default)]
pub(super) struct Forms {
    work: Vec<Work>,
    factors: Vec<Vec<u8>>,
    coefficients: u32,
    outputs: Vec<Vec<(Monomial, u32)>>,
    pub positions: BTreeSet<usize>,
}

impl Forms {
    pub(super) fn new(graph: &Dag, joints: usize) -> Option<Forms> {
        Forms::compile(graph, joints, true).or_else(|| Forms::compile(graph, joints, false))
    }

    fn compile(graph: &Dag, joints: usize, rates: bool) -> Option<Forms> {
        let mut forms = Forms::default();
        let mut slots: Vec<BTreeMap<Monomial, u32>> = Vec::with_capacity(graph.nodes.len());
        forms.factors.push(Vec::new());
        let mut factors: BTreeMap<Vec<u8>, u32> = BTreeMap::from([(Vec::new(), 0)]);
        let mut products = 0;
        for (node, reads) in graph.nodes.iter().zip(graph.reads()) {
            let mut slot: BTreeMap<Monomial, u32> = BTreeMap::new();
            let mut place = |monomial: Monomial, forms: &mut Forms| {
                *slot.entry(monomial).or_insert_with(|| {
                    forms.coefficients += 1;
                    forms.coefficients - 1
                })
            };
            match node {
                _ if reads == 0 => {}
                Node::Constant(constant) => {
                    let out = place([0; 2], &mut forms);
                    let value = Interval::exact(constant);
                    forms.work.push(Work::Constant(out, value));
                }
                Node::Input(input) => {
                    let rate = match *input {
                        Input::Entry(Argument::Velocity, joint) if rates => joint as u8 + 1,
                        Input::Entry(Argument::Acceleration, joint) if rates => {
                            (joints + joint) as u8 + 1
                        }
                        _ => 0,
                    };
                    let out = place([0, rate], &mut forms);
                    forms.work.push(match rate {
                        0 => Work::Input(out, *input),
                        _ => Work::Constant(out, Interval::ONE),
                    });
                    if let Input::Sin(joint)
                    | Input::Cos(joint)
                    | Input::Entry(Argument::Position, joint) = *input
                    {
                        forms.positions.insert(joint);
                    }
                }
                Node::Apply(operation @ (Operation::Add | Operation::Sub), operands) => {
                    for (index, id) in operands.iter().enumerate() {
                        let minus = index == 1 && *operation == Operation::Sub;
                        let work = if minus { Work::Sub } else { Work::Add };
                        for (&monomial, &x) in &slots[*id as usize] {
                            let out = place(monomial, &mut forms);
                            forms.work.push(work(out, x));
                        }
                    }
                }
                Node::Apply(Operation::Div, _) => return None,
                Node::Apply(Operation::Mul | Operation::Fused, [a, b]) => {
                    products += slots[*a as usize].len() * slots[*b as usize].len();
                    if rates && products > MAX_PRODUCTS {
                        return None;
                    }
                    for (left, &x) in &slots[*a as usize] {
                        for (right, &y) in &slots[*b as usize] {
                            let (monomial, rest) = multiply(left, right);
                            let next = factors.len() as u32;
                            let factor = *factors.entry(rest.clone()).or_insert_with(|| {
                                forms.factors.push(rest);
                                next
                            });
                            let out = place(monomial, &mut forms);
                            forms.work.push(Work::Mul(out, x, y, factor));
                        }
                    }
                }
            }
            slots.push(slot);
        }
        let outputs = graph.outputs.iter().map(|edge| &slots[edge.index()]);
        let terms = |slot: &BTreeMap<Monomial, u32>| slot.iter().map(|(&m, &x)| (m, x)).collect();
        forms.outputs = outputs.map(terms).collect();
        Some(forms)
    }

    pub(super) fn magnitudes(&self, sub: &InputBox) -> Vec<f64> {
        let factors: Vec<_> = self.factors.iter().map(|rest| range(rest, sub)).collect();
        let mut values = vec![Interval::ZERO; self.coefficients as usize];
        for work in &self.work {
            let value = |x: u32| values[x as usize];
            let (out, term) = match *work {
                Work::Constant(out, constant) => (out, constant),
                Work::Input(out, input) => (out, sub.input(input)),
                Work::Add(out, x) => (out, value(x)),
                Work::Sub(out, x) => (out, -value(x)),
                Work::Mul(out, x, y, factor) => {
                    let product = match x == y {
                        true => value(x).square(),
                        false => value(x) * value(y),
                    };
                    match factor {
                        0 => (out, product),
                        _ => (out, product * factors[factor as usize]),
                    }
                }
            };
            accumulate(&mut values[out as usize], term);
        }
        let magnitude = |terms: &Vec<(Monomial, u32)>| {
            let mut sum = Interval::ZERO;
            for &(rates, x) in terms {
                let mut term = values[x as usize];
                if rates[1] != 0 {
                    term = term * range(&rates, sub);
                }
                accumulate(&mut sum, term);
            }
            sum.magnitude()
        };
        self.outputs.iter().map(magnitude).collect()
    }
}

/// The monomial that is kept, and the variables that go into the coefficient.
fn multiply(left: &Monomial, right: &Monomial) -> (Monomial, Vec<u8>) {
    let mut rates: Vec<u8> = [*left, *right].concat();
    rates.retain(|&v| v != 0);
    rates.sort_unstable();
    let rest = rates.split_off(rates.len().min(2));
    let kept = match rates[..] {
        [] => [0, 0],
        [a] => [0, a],
        [a, b, ..] => [a, b],
    };
    (kept, rest)
}

fn range(variables: &[u8], sub: &InputBox) -> Interval {
    let mut product = Interval::ONE;
    for power in variables.chunk_by(|a, b| a == b) {
        let x = sub.rate(power[0]);
        for _ in 0..power.len() / 2 {
            product = product * x.square();
        }
        if power.len() % 2 == 1 {
            product = product * x;
        }
    }
    product
}

/// Adds to a sum; one that starts from zero stays exact.
#[inline]
fn accumulate(sum: &mut Interval, term: Interval) {
    *sum = if *sum == Interval::ZERO {
        term
    } else {
        *sum + term
    };
}
