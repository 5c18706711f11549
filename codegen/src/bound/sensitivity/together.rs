//! What an output's nodes cost together: where one is at its largest, others are
//! not.
//!
//! The first order of an output's error is at most u·Σ w·|value|·|adjoint|, all
//! of them at one state: a sum of magnitudes of products, bounded as
//! such ([`Squares`]). w is 1 for an operation that rounds, and what the
//! literal that it multiplies by is off, relative to u, comes on top. Where a
//! value is near its largest, its rounding is at most half an ulp of that: F in
//! place of |value|.
//!
//! It does not depend on the scalar: a literal counts with the larger of what
//! it is off in either.

use super::gradient::{Adjoints, Gradient};
use super::intervals::{Constants, is_exact, read};
use crate::bound::expand::Polynomial;
use crate::bound::grid::{GridEffort, Largest, Product, Squares};
use crate::bound::input_box::InputBox;
use crate::graph::Edge;
use crate::interval::Interval;
use crate::interval::rounding::binade;
use crate::parallel;
use crate::program::{Input, Operand, Operation, Program, ScalarType};

/// How close a bound is to come to a sum that is taken.
const CLOSE: f64 = 0.04;

/// Places to climb from.
const STARTS: usize = 6;

/// Outputs that may have all their points; more share what these have.
const OUTPUTS: usize = 8;

/// Fewer points than this for an output tell nothing.
const FEWEST: usize = 1 << 12;

/// Terms of all polynomials for each point of an output.
const TERMS: usize = 4;

/// Over ranges narrower than this, values hardly move: their largest are taken
/// about together.
const NARROW: f64 = 2.0;

/// A value may be this much larger by errors and still round as if it were not.
const GROWTH: f64 = 1.0 + 1e-4;

/// The bounds of one output.
#[derive(Clone, Debug, Default)]
pub(super) struct Together {
    /// Of the operations and literals, in u, if there is one.
    pub arithmetic: Option<f64>,
    /// Of each step, what its rounding counts with in place of its value, in u.
    pub caps: Vec<Option<f64>>,
    /// Of the sines and cosines, in u.
    pub sines: Option<f64>,
    /// What the error of each of these counts with there, in u, in the order of
    /// the adjoints.
    pub weights: Vec<f64>,
}

/// Values and adjoints written out, by the graph's nodes.
pub(super) struct Written<'a> {
    limits: &'a InputBox,
    closeness: GridEffort,
    /// `None` where nothing is to be found.
    squares: Option<Squares>,
    /// How many terms were kept.
    terms: usize,
}

impl<'a> Written<'a> {
    /// Makes room for so many nodes of a program's gradient, with so many points for each output.
    pub(super) fn new(
        program: &Program,
        nodes: usize,
        limits: &'a InputBox,
        sliding: &[bool],
        points: usize,
    ) -> Written<'a> {
        let mut whole = limits.clone();
        let mut is_narrow = false;
        for joint in (0..sliding.len()).filter(|&joint| !sliding[joint] && turns(program, joint)) {
            is_narrow |= limits.position[joint].width() < NARROW;
            // Means are over whole circles, and so is what comes of them.
            whole.position[joint] = Interval::symmetric(4.0);
        }
        let each = points.min(OUTPUTS * points / program.outputs.len().max(1));
        let squares = match !is_narrow && each >= FEWEST {
            true => Squares::new(nodes, whole, sliding),
            false => None,
        };
        Written {
            limits,
            closeness: GridEffort {
                points: each,
                close: CLOSE,
                starts: STARTS,
            },
            squares,
            terms: 0,
        }
    }

    /// Returns whether there is something to be found.
    pub(super) fn is_wanted(&self) -> bool {
        self.squares.is_some()
    }

    /// Keeps a node's value in multiples of its angles.
    pub(super) fn keep(&mut self, node: usize, harmonics: &Polynomial) {
        self.terms += harmonics.len();
        // What is too long for its points is not even kept.
        if self.terms > TERMS * self.closeness.points {
            self.squares = None;
        }
        if let Some(squares) = &mut self.squares {
            squares.set(node, harmonics);
        }
    }

    /// Returns the bounds of each output; `most` of each node over the box.
    pub(super) fn together(
        &self,
        program: &Program,
        gradient: &Gradient,
        most: &[f64],
    ) -> Vec<Together> {
        let Some(squares) = &self.squares else {
            return vec![Together::default(); program.outputs.len()];
        };
        let constants = ScalarType::ALL.map(|scalar| (scalar, Constants::of(program, scalar, &[])));
        parallel::each(&gradient.adjoints, |adjoints| {
            let (steps, list) = arithmetic(program, gradient, adjoints, most, &constants);
            let found = squares.sum(&list, self.closeness);
            let (arithmetic, caps) = of_steps(program, &steps, &list, found);
            let weights: Vec<f64> = (adjoints.sines.iter())
                .map(|(input, _)| weight(*input, self.limits, &constants))
                .collect();
            let list: Vec<Product> = (adjoints.sines.iter().zip(&weights))
                .map(|((_, edge), &weight)| alone(weight, edge))
                .collect();
            let sines = squares.sum(&list, self.closeness);
            Together {
                arithmetic,
                caps,
                sines: sines.map(|found| found.sum),
                weights,
            }
        })
    }
}

fn turns(program: &Program, joint: usize) -> bool {
    let mut angles = program.trig.iter().flat_map(|trig| trig.angle.terms());
    angles.any(|(turned, _)| turned == joint)
}

fn alone(weight: f64, edge: &Edge) -> Product {
    Product {
        weight,
        left: None,
        cap: f64::INFINITY,
        right: edge.node().index(),
    }
}

type Both = [(ScalarType, Constants); 2];

/// Returns the products of an output's operations and literals, and which of them are
/// steps' own.
fn arithmetic(
    program: &Program,
    gradient: &Gradient,
    adjoints: &Adjoints,
    most: &[f64],
    constants: &Both,
) -> (Vec<Option<usize>>, Vec<Product>) {
    let (mut steps, mut list) = (Vec::new(), Vec::new());
    for &(index, adjoint) in &adjoints.steps {
        let step = &program.steps[index];
        let value = gradient.values[index].node().index();
        // What the literal is off, at most, relative to itself and in u.
        let mut literal = 0.0;
        let mut rounds = false;
        for (scalar, constants) in constants {
            let u = scalar.unit_roundoff();
            rounds |= !is_exact(step, &constants.steps()[index]);
            for (known, error) in constants.steps()[index].into_iter().flatten() {
                let size = match step.operation {
                    Operation::Mul | Operation::Fused => known.mignitude(),
                    _ => 1.0,
                };
                if error > 0.0 {
                    literal = f64::max(literal, (error / (u * size)) * (1.0 + 1e-12));
                }
            }
        }
        if rounds {
            steps.push(Some(index));
            list.push(Product {
                weight: 1.0,
                left: Some(value),
                cap: binade(most[value] * GROWTH),
                right: adjoint.node().index(),
            });
        }
        if literal > 0.0 {
            steps.push(None);
            list.push(match step.operation {
                Operation::Mul | Operation::Fused => Product {
                    weight: literal,
                    left: Some(value),
                    cap: f64::INFINITY,
                    right: adjoint.node().index(),
                },
                _ => alone(literal, &adjoint),
            });
        }
    }
    (steps, list)
}

fn of_steps(
    program: &Program,
    steps: &[Option<usize>],
    list: &[Product],
    found: Option<Largest>,
) -> (Option<f64>, Vec<Option<f64>>) {
    let mut caps = vec![None; program.steps.len()];
    let Some(found) = found else {
        return (None, caps);
    };
    for ((step, product), capped) in steps.iter().zip(list).zip(&found.capped) {
        if let (Some(step), true) = (step, capped) {
            caps[*step] = Some(product.cap);
        }
    }
    (Some(found.sum), caps)
}

/// Returns what a sine is off at most, in u, in either scalar.
fn weight(input: Input, limits: &InputBox, constants: &Both) -> f64 {
    let each = constants.iter().map(|(scalar, constants)| {
        let (_, error) = read(&Operand::Input(input), &[], *scalar, constants, limits);
        (error / scalar.unit_roundoff()).next_up()
    });
    each.fold(0.0, f64::max)
}
