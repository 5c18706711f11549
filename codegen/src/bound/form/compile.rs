//! Which monomials a graph has, and the work that gives their coefficients.

use std::collections::BTreeMap;

use super::{Forms, Monomial, Work};
use crate::dag::{Dag, Node};
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::{Input, Operation};

/// Above this much work a product, rates are taken as plain intervals.
const MAX_PRODUCTS: usize = 400_000;

impl Forms {
    /// Returns `None` if keeping the rates apart would be too much work.
    pub(super) fn compile(graph: &Dag, joints: usize, rates: bool) -> Option<Forms> {
        let mut forms = Forms::empty(joints);
        forms.rates = rates;
        let mut slots: Vec<BTreeMap<Monomial, u32>> = Vec::with_capacity(graph.nodes.len());
        let mut factors: BTreeMap<Vec<u8>, u32> = BTreeMap::from([(Vec::new(), 0)]);
        let mut positions = vec![false; joints];
        let mut products = 0;
        for (node, reads) in graph.nodes.iter().zip(graph.reads()) {
            let mut slot: BTreeMap<Monomial, u32> = BTreeMap::new();
            let mut place = |monomial: Monomial, forms: &mut Forms| {
                *slot.entry(monomial).or_insert_with(|| {
                    forms.coefficients += 1;
                    forms.coefficients as u32 - 1
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
                    let first = forms.coefficients as u32;
                    place(forms.leaf(*input), &mut forms);
                    forms.work.push(Work::Leaf(first, *input));
                    if let Some(joint) = position_joint(*input) {
                        positions[joint] = true;
                    }
                }
                Node::Apply(Operation::Add | Operation::Sub, [a, b]) => {
                    for (&monomial, &x) in &slots[*a as usize] {
                        let out = place(monomial, &mut forms);
                        forms.work.push(Work::Add(out, x));
                    }
                    for (&monomial, &x) in &slots[*b as usize] {
                        let out = place(monomial, &mut forms);
                        let minus = matches!(node, Node::Apply(Operation::Sub, _));
                        let work = if minus { Work::Sub } else { Work::Add };
                        forms.work.push(work(out, x));
                    }
                }
                // No polynomial.
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
        for edge in &graph.outputs {
            let slot = &slots[edge.index()];
            let terms = slot.iter().map(|(&m, &x)| (m, x)).collect();
            forms.outputs.push((edge.negative, terms));
        }
        forms.positions = (0..joints).filter(|&j| positions[j]).collect();
        Some(forms)
    }

    /// Returns the monomial of an input.
    fn leaf(&self, input: Input) -> Monomial {
        let n = self.joints;
        match input {
            Input::Entry(Argument::Velocity, joint) if self.rates => [0, joint as u8 + 1],
            Input::Entry(Argument::Acceleration, joint) if self.rates => [0, (n + joint) as u8 + 1],
            _ => [0; 2],
        }
    }
}

fn position_joint(input: Input) -> Option<usize> {
    match input {
        Input::Sin(joint) | Input::Cos(joint) | Input::Entry(Argument::Position, joint) => {
            Some(joint)
        }
        _ => None,
    }
}

/// Returns the product of two monomials: what is kept, and the variables that go into
/// the coefficient.
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
