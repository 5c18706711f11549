//! The rounding error of a program: an estimate that no single digit decides.
//!
//! Every rounded operation and every rounded constant is an independent error of at most u of its
//! value; its effect on an output is the derivative of the output by that value, found by one
//! backward pass. The root of the sum of squares is what the sum of such errors is of the size of.
//! It depends smoothly on the robot, whereas errors that are observed at some states depend on how
//! the last digits of its parameters happen to fall.

use std::cell::Cell;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use dalembert_model::number::{Exact, Rounded};
use dalembert_model::scalar::{Divide, Scalar};
use num_traits::Signed;

use crate::dag::lanes::{LANES, Lanes};
use crate::dag::{Dag, Edge, Id, Node};
use crate::program::{Input, Operation, Program};
use crate::setup::Setup;
use crate::states::JointState;

const STATES: usize = 64;
const SEED: u64 = 0xacc;

/// The largest estimated errors over the states, in units of u, one a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounding {
    /// max_i error_i / max_i |result_i|.
    pub normwise: Vec<f64>,
    /// error_i / the largest |result_i| over the states, the worst i.
    pub per_output: Vec<f64>,
}

impl Rounding {
    /// Estimates the rounding error of a program inside the limits of the scene's robot.
    pub fn estimate(setup: &Setup, program: &Program) -> Rounding {
        Rounding::until(setup, program, &Cell::default(), |_| false)
    }

    /// Begins with the chunk `first`, set to the last one: more states only make the error larger.
    pub(crate) fn until(
        setup: &Setup,
        program: &Program,
        first: &Cell<usize>,
        is_enough: impl Fn(&Rounding) -> bool,
    ) -> Rounding {
        let dag = &program.dag;
        let is_exact: Vec<bool> = dag.nodes.iter().map(|node| is_exact(dag, node)).collect();
        let states = setup.states(STATES, SEED);
        let run = |states: &[JointState]| values(setup, dag, states);
        let mut runs: Vec<_> = states.chunks(LANES).map(run).enumerate().collect();
        let size = |output: &Edge| {
            let values = runs.iter().flat_map(|(_, values)| values[output.index()].0);
            largest(values.map(|value| value.0.abs()))
        };
        let sizes: Vec<f64> = dag.outputs.iter().map(size).collect();
        let mut ranges = Vec::new();
        for quantity in program.function.quantities() {
            let start = ranges.last().map_or(0, |range: &Range<usize>| range.end);
            ranges.push(start..start + quantity.len(program.sizes()));
        }
        let mut rounding = Rounding {
            normwise: vec![0.0; ranges.len()],
            per_output: vec![0.0; ranges.len()],
        };
        let ratio = |error: f64, size: f64| if size > 0.0 { error / size } else { 0.0 };
        runs.sort_by_key(|(index, _)| *index != first.get());
        // Several outputs are one node: zeros, both halves of a symmetric matrix.
        let tops: BTreeSet<Id> = dag.outputs.iter().map(|output| output.node).collect();
        let needed: Vec<(Id, Vec<Id>)> = tops.iter().map(|top| (*top, dag.needed(*top))).collect();
        let mut adjoints = vec![Lanes::<Sticky>::zero(); dag.nodes.len()];
        for (index, values) in runs {
            let error = |(top, needed): &(Id, Vec<Id>)| {
                (*top, error(dag, needed, &values, &is_exact, &mut adjoints))
            };
            let by_node: HashMap<Id, [f64; LANES]> = needed.iter().map(error).collect();
            let of_output = |output: &Edge| by_node[&output.node];
            let errors: Vec<[f64; LANES]> = dag.outputs.iter().map(of_output).collect();
            for (quantity, range) in ranges.iter().enumerate() {
                let normwise = (0..LANES).map(|lane| {
                    let results = dag.outputs[range.clone()].iter();
                    let size = results.map(|output| values[output.index()].0[lane].0.abs());
                    let error = errors[range.clone()].iter().map(|error| error[lane]);
                    ratio(largest(error), largest(size))
                });
                let worst = &mut rounding.normwise[quantity];
                *worst = worst.max(largest(normwise));
                let pairs = errors[range.clone()].iter().zip(&sizes[range.clone()]);
                let per_output = pairs
                    .map(|(lane_errors, size)| ratio(largest(lane_errors.iter().copied()), *size));
                let worst = &mut rounding.per_output[quantity];
                *worst = worst.max(largest(per_output));
            }
            if is_enough(&rounding) {
                first.set(index);
                break;
            }
        }
        rounding
    }

    /// Returns the largest factor by which a quantity is worse than another program's,
    /// where an error of `floor` units is as good as none.
    pub fn factor(&self, than: &Rounding, floor: f64) -> f64 {
        let worst = |errors: &[f64], other: &[f64]| {
            let pairs = errors.iter().zip(other);
            largest(pairs.map(|(error, other)| error / other.max(floor)))
        };
        worst(&self.normwise, &than.normwise).max(worst(&self.per_output, &than.per_output))
    }

    pub fn worst(&self) -> f64 {
        largest(self.normwise.iter().copied())
    }
}

/// Zero times anything is zero, infinity and NaN too: an error that does not arrive does not count.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sticky(f64);

impl Scalar for Sticky {
    fn zero() -> Self {
        Sticky(0.0)
    }
    fn one() -> Self {
        Sticky(1.0)
    }
    fn add(&self, other: &Self) -> Self {
        Sticky(self.0 + other.0)
    }
    fn mul(&self, other: &Self) -> Self {
        match self.0 == 0.0 || other.0 == 0.0 {
            true => Sticky(0.0),
            false => Sticky(self.0 * other.0),
        }
    }
    fn neg(&self) -> Self {
        Sticky(-self.0)
    }
    fn half(&self) -> Self {
        Sticky(0.5 * self.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl Divide for Sticky {
    fn div(&self, other: &Self) -> Self {
        match self.0 == 0.0 {
            true => Sticky(0.0),
            false => Sticky(self.0 / other.0),
        }
    }
}

/// Returns the value of every node at a few states; lanes beyond them repeat the last one.
fn values(setup: &Setup, dag: &Dag, states: &[JointState]) -> Vec<Lanes<Sticky>> {
    let constant = |constant: &Exact| Lanes([Sticky(f64::nearest(constant)); LANES]);
    let input = |input: Input| {
        let value = |state: &JointState| Sticky(setup.input_at(input, state));
        let lanes = Lanes::new(&states.iter().map(value).collect::<Vec<_>>());
        lanes.unwrap_or(Lanes([Sticky(f64::NAN); LANES]))
    };
    dag.values(&(constant, input))
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// Returns the root of the sum of squares of all errors as they reach the last of the nodes that it
/// needs, in units of u.
fn error(
    dag: &Dag,
    needed: &[Id],
    values: &[Lanes<Sticky>],
    is_exact: &[bool],
    adjoints: &mut [Lanes<Sticky>],
) -> [f64; LANES] {
    dag.adjoints_of(needed, values, adjoints);
    let mut squares = Lanes::<Sticky>::zero();
    for index in needed.iter().map(|id| *id as usize) {
        let adjoint = &adjoints[index];
        if !is_exact[index] && !adjoint.is_zero() {
            let error = adjoint.mul(&values[index]);
            squares = squares.add(&error.mul(&error));
        }
    }
    squares.0.map(|square| libm::sqrt(square.0))
}

/// Powers of two, products with one, fused products and entries are exact; sines are rounded.
fn is_exact(dag: &Dag, node: &Node) -> bool {
    let is_power = |id: &Id| matches!(dag.node(*id), Node::Constant(c) if is_power_of_two(c));
    match node {
        Node::Constant(constant) => is_power_of_two(constant),
        Node::Input(input) => input.angle().is_none(),
        Node::Apply(Operation::Fused, _) => true,
        Node::Apply(Operation::Mul, operands) => operands.iter().any(is_power),
        Node::Apply(..) => false,
    }
}

fn is_power_of_two(value: &Exact) -> bool {
    let Some(value) = value.as_rational() else {
        return false;
    };
    [value.numer(), value.denom()].into_iter().all(|part| {
        let part = part.abs();
        part.bits() > 0 && part.trailing_zeros() == Some(part.bits() - 1)
    })
}
