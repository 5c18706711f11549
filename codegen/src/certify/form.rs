//! A program over a box as polynomials in the rates.
//!
//! Torques are polynomials of low degree in velocities and accelerations,
//! whose coefficients depend on the positions. Plain intervals forget that
//! two values contain the same velocity; so every node is kept as
//!
//! Σ coefficient · monomial,
//!
//! the monomials being products of at most two rates and at most one position
//! variable e_j ∈ \[−1, 1\] (q_j = middle + radius·e_j), the coefficients
//! intervals that hold for every position in the sub-box. What a product has
//! beyond that degree is put into its coefficient as an interval.
//!
//! **Soundness.** The claim kept by every operation: for each state in the
//! sub-box there are coefficients in the intervals with which the polynomial
//! has the node's value. Sums and products of polynomials keep it, since
//! interval arithmetic does; replacing a variable by its range keeps it;
//! sin(c + δ) = sin c + δ·cos c − δ²/2·sin ξ (Taylor) gives it for sines.
//!
//! Which monomials occur is decided once, from the graph alone; a sub-box is
//! then a flat run over arrays.

use std::collections::BTreeMap;

use super::input_box::InputBox;
use super::interval::Interval;
use crate::graph::{AngleSum, Graph, Input, Node};

/// At most two rates and one position; 0 is none. Rates are 1 … 2n, sorted.
type Monomial = ([u8; 2], u8);

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
pub struct Forms {
    joints: usize,
    work: Vec<Work>,
    /// Ranges that products put into coefficients, by what they are made of.
    factors: Vec<Vec<u8>>,
    coefficients: usize,
    /// Of each output: its sign, and monomial and coefficient index.
    outputs: Vec<(bool, Vec<(Monomial, u32)>)>,
    /// Position joints that matter.
    pub(super) positions: Vec<usize>,
    /// Whether positions are variables.
    linear: bool,
    /// Whether rates are variables.
    rates: bool,
}

/// Room for one evaluation.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    values: Vec<Interval>,
    factors: Vec<Interval>,
}

/// Where the Taylor polynomial of a sine is worse than its range.
const FARTHEST: f64 = 0.8;

/// Above this much work a product, rates are taken as plain intervals.
const MOST_PRODUCTS: usize = 400_000;

impl Forms {
    /// Compiles a graph's live part. `linear` keeps one position variable a
    /// monomial, which costs more and converges faster.
    pub fn new(graph: &Graph, joints: usize, linear: bool) -> Forms {
        Forms::compile(graph, joints, linear, true)
            .or_else(|| Forms::compile(graph, joints, false, false))
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
            linear: false,
            rates: false,
        }
    }

    /// `None` if keeping the rates apart would be too much work.
    fn compile(graph: &Graph, joints: usize, linear: bool, rates: bool) -> Option<Forms> {
        let mut forms = Forms::empty(joints);
        (forms.linear, forms.rates) = (linear, rates);
        let mut slots: Vec<BTreeMap<Monomial, u32>> = Vec::with_capacity(graph.nodes.len());
        let mut factors: BTreeMap<Vec<u8>, u32> = BTreeMap::from([(Vec::new(), 0)]);
        let mut positions = vec![false; joints];
        let mut products = 0;
        for (node, live) in graph.nodes.iter().zip(graph.live()) {
            let mut slot: BTreeMap<Monomial, u32> = BTreeMap::new();
            let mut place = |monomial: Monomial, forms: &mut Forms| {
                *slot.entry(monomial).or_insert_with(|| {
                    forms.coefficients += 1;
                    forms.coefficients as u32 - 1
                })
            };
            match *node {
                _ if !live => {}
                Node::Constant(c) => {
                    let out = place(([0; 2], 0), &mut forms);
                    let value = Interval::exact(&graph.constants[c as usize]);
                    forms.work.push(Work::Constant(out, value));
                }
                Node::Input(input) => {
                    let first = forms.coefficients as u32;
                    for monomial in forms.leaf(input) {
                        place(monomial, &mut forms);
                    }
                    forms.work.push(Work::Leaf(first, input));
                    for joint in position_joints(input) {
                        positions[joint] = true;
                    }
                }
                Node::Sum(a, b) | Node::Difference(a, b) => {
                    for (&monomial, &x) in &slots[a.index()] {
                        let out = place(monomial, &mut forms);
                        forms.work.push(Work::Add(out, x));
                    }
                    for (&monomial, &x) in &slots[b.index()] {
                        let out = place(monomial, &mut forms);
                        let minus = matches!(node, Node::Difference(..));
                        let work = if minus { Work::Sub } else { Work::Add };
                        forms.work.push(work(out, x));
                    }
                }
                Node::Product(a, b) => {
                    products += slots[a.index()].len() * slots[b.index()].len();
                    if rates && products > MOST_PRODUCTS {
                        return None;
                    }
                    for (left, &x) in &slots[a.index()] {
                        for (right, &y) in &slots[b.index()] {
                            let (monomial, rest) = multiply(left, right, joints);
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
            let slot = &slots[edge.node().index()];
            let terms = slot.iter().map(|(&m, &x)| (m, x)).collect();
            forms.outputs.push((edge.is_negative(), terms));
        }
        forms.positions = (0..joints).filter(|&j| positions[j]).collect();
        Some(forms)
    }

    /// The monomials of an input in the order of its coefficients.
    fn leaf(&self, input: Input) -> Vec<Monomial> {
        let n = self.joints;
        match input {
            Input::Velocity(joint) if self.rates => vec![([0, joint as u8 + 1], 0)],
            Input::Acceleration(joint) if self.rates => vec![([0, (n + joint) as u8 + 1], 0)],
            Input::Velocity(_) | Input::Acceleration(_) => vec![([0; 2], 0)],
            _ => {
                let mut monomials = vec![([0; 2], 0)];
                if self.linear {
                    let joints = position_joints(input);
                    monomials.extend(joints.map(|joint| ([0; 2], joint as u8 + 1)));
                }
                monomials
            }
        }
    }

    /// Evaluates over a sub-box.
    pub fn evaluate(&self, sub: &InputBox, scratch: &mut Scratch) {
        let Scratch { values, factors } = scratch;
        values.clear();
        values.resize(self.coefficients, Interval::ZERO);
        factors.clear();
        factors.extend(self.factors.iter().map(|rest| self.range(rest, sub)));
        for work in &self.work {
            match *work {
                Work::Add(out, x) => {
                    let x = values[x as usize];
                    accumulate(&mut values[out as usize], x);
                }
                Work::Sub(out, x) => {
                    let x = -values[x as usize];
                    accumulate(&mut values[out as usize], x);
                }
                Work::Mul(out, x, y, factor) => {
                    let mut product = if x == y {
                        values[x as usize].square()
                    } else {
                        values[x as usize] * values[y as usize]
                    };
                    if factor != 0 {
                        product = product * factors[factor as usize];
                    }
                    accumulate(&mut values[out as usize], product);
                }
                Work::Constant(out, value) => values[out as usize] = value,
                Work::Leaf(out, input) => self.evaluate_leaf(out as usize, input, sub, values),
            }
        }
    }

    fn evaluate_leaf(&self, out: usize, input: Input, sub: &InputBox, values: &mut [Interval]) {
        match input {
            Input::Velocity(_) | Input::Acceleration(_) => {
                // As a variable its coefficient is one.
                values[out] = if self.rates {
                    Interval::ONE
                } else {
                    sub.input(input)
                };
            }
            Input::Position(joint) if self.linear => {
                let q = sub.position[joint];
                values[out] = Interval::point(q.mid());
                values[out + 1] = Interval::point(q.radius());
            }
            Input::Sin(angle) | Input::Cos(angle) if self.linear => {
                let (centre, reach) = centre(angle, sub);
                if reach > FARTHEST {
                    values[out] = sub.input(input);
                    return;
                }
                let (sin, cos) = (centre.sin(), centre.cos());
                let whole = sub.input(input);
                let (value, slope) = match input {
                    Input::Sin(_) => (sin, cos),
                    _ => (cos, -sin),
                };
                // −δ²/2·f(ξ), with |δ| at most the reach.
                let squared = Interval::new(0.0, (0.5 * reach * reach).next_up());
                let rest = -(whole * squared.unwrap_or(Interval::ALL));
                values[out] = value + rest;
                for (k, (joint, negative)) in angle.terms().enumerate() {
                    let radius = Interval::point(sub.position[joint].radius());
                    let slope = slope * radius;
                    values[out + 1 + k] = if negative { -slope } else { slope };
                }
            }
            _ => values[out] = sub.input(input),
        }
    }

    /// The range of a product of variables.
    fn range(&self, variables: &[u8], sub: &InputBox) -> Interval {
        let mut product = Interval::ONE;
        let mut at = 0;
        while at < variables.len() {
            let variable = variables[at];
            let power = variables[at..]
                .iter()
                .take_while(|&&v| v == variable)
                .count();
            let x = self.variable(variable, sub);
            for _ in 0..power / 2 {
                product = product * x.square();
            }
            if power % 2 == 1 {
                product = product * x;
            }
            at += power;
        }
        product
    }

    fn variable(&self, variable: u8, sub: &InputBox) -> Interval {
        let (n, index) = (self.joints, usize::from(variable));
        match index {
            0 => Interval::ONE,
            _ if index <= n => sub.velocity[index - 1],
            _ if index <= 2 * n => sub.acceleration[index - 1 - n],
            _ => Interval::symmetric(1.0),
        }
    }
}

impl Forms {
    /// The range of each output over the sub-box evaluated last.
    pub fn outputs(&self, sub: &InputBox, scratch: &Scratch) -> Vec<Interval> {
        self.outputs
            .iter()
            .map(|(negative, terms)| {
                let mut sum = Interval::ZERO;
                for &((rates, position), x) in terms {
                    let mut term = scratch.values[x as usize];
                    if rates[1] != 0 {
                        term = term * self.range(&rates, sub);
                    }
                    if position != 0 {
                        term = term * Interval::symmetric(1.0);
                    }
                    accumulate(&mut sum, term);
                }
                if *negative { -sum } else { sum }
            })
            .collect()
    }

    /// How much an output moves with each position variable, to first order.
    pub fn slopes(&self, output: usize, sub: &InputBox, scratch: &Scratch) -> Vec<f64> {
        let mut slopes = vec![0.0; self.joints];
        for &((rates, position), x) in &self.outputs[output].1 {
            if position != 0 {
                let mut term = scratch.values[x as usize];
                if rates[1] != 0 {
                    term = term * self.range(&rates, sub);
                }
                slopes[usize::from(position) - 1] += term.magnitude();
            }
        }
        slopes
    }

    /// How many multiplications and additions one evaluation takes.
    pub fn work(&self) -> usize {
        self.work.len()
    }
}

/// A sum that starts from zero stays exact.
#[inline]
fn accumulate(sum: &mut Interval, term: Interval) {
    *sum = if *sum == Interval::ZERO {
        term
    } else {
        *sum + term
    };
}

fn position_joints(input: Input) -> impl Iterator<Item = usize> {
    let (angle, slide) = match input {
        Input::Sin(angle) | Input::Cos(angle) => (Some(angle), None),
        Input::Position(joint) => (None, Some(joint)),
        _ => (None, None),
    };
    let turned = angle.into_iter().flat_map(AngleSum::terms);
    turned.map(|(joint, _)| joint).chain(slide)
}

/// An enclosure of the angle at the sub-box's middle, and how far at most it
/// is from there.
fn centre(angle: AngleSum, sub: &InputBox) -> (Interval, f64) {
    let mut centre = Interval::ZERO;
    let mut reach = 0.0;
    for (index, (joint, negative)) in angle.terms().enumerate() {
        let q = sub.position[joint];
        let mid = Interval::point(q.mid());
        let mid = if negative { -mid } else { mid };
        (centre, reach) = if index == 0 {
            (mid, q.radius())
        } else {
            (centre + mid, (reach + q.radius()).next_up())
        };
    }
    (centre, reach)
}

/// The product of two monomials: what is kept, and the variables that go into
/// the coefficient.
fn multiply(left: &Monomial, right: &Monomial, joints: usize) -> (Monomial, Vec<u8>) {
    let mut rates: Vec<u8> = [left.0, right.0].concat();
    rates.retain(|&v| v != 0);
    rates.sort_unstable();
    let mut rest = rates.split_off(rates.len().min(2));
    let kept = match rates[..] {
        [] => [0, 0],
        [a] => [0, a],
        [a, b, ..] => [a, b],
    };
    let position = match (left.1, right.1) {
        (0, p) | (p, 0) => p,
        (p, q) => {
            rest.extend([p, q].map(|p| p + 2 * joints as u8));
            0
        }
    };
    rest.sort_unstable();
    ((kept, position), rest)
}
