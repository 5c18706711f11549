//! What rounding costs a program: an estimate that no single digit decides.
//!
//! Every rounded operation and every rounded constant is an independent error
//! of at most u of its value; its effect on an output is the derivative of the
//! output by that value, found by one backward pass. The root of the sum of
//! squares is what the sum of such errors is of the size of. It depends
//! smoothly on the robot, whereas errors that are observed at some states
//! depend on how the last digits of its parameters happen to fall.

use std::array::from_fn;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::Range;

use dalembert_model::equations::friction::per_speed;
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::scalar::Scalar;
use num_traits::Signed;

use super::lanes::{LANES, Lanes};
use crate::program::adjoint::{Leaf, backward};
use crate::program::{Input, Operand, Operation, Program};
use crate::scene::SceneRobot;
use crate::states::JointState;

/// The number of states.
const STATES: usize = 64;

/// A seed of its own.
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
    pub fn estimate(scene_robot: &SceneRobot, program: &Program) -> Rounding {
        Rounding::until(scene_robot, program, &Cell::default(), |_| false)
    }

    /// Estimates the rounding error until `is_enough` says so of the states so far: more states only
    /// make it larger. It begins with the chunk of states `first`, which is then the last one.
    pub(crate) fn until(
        scene_robot: &SceneRobot,
        program: &Program,
        first: &Cell<usize>,
        is_enough: impl Fn(&Rounding) -> bool,
    ) -> Rounding {
        let network = Network::new(program);
        let states = scene_robot.states(STATES, SEED);
        let runs = states.chunks(LANES).map(|states| network.run(states));
        let mut runs: Vec<(usize, Run)> = runs.enumerate().collect();
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let size = |output: usize| {
            let values = runs.iter().flat_map(|(_, run)| run.outputs[output].0);
            largest(&mut values.map(f64::abs))
        };
        let sizes: Vec<f64> = (0..program.outputs.len()).map(size).collect();
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
        for (index, run) in runs {
            let errors = network.errors(&run);
            for (quantity, range) in ranges.iter().enumerate() {
                let (values, own) = (&run.outputs[range.clone()], &errors[range.clone()]);
                let normwise = largest(&mut (0..LANES).map(|lane| {
                    let size = largest(&mut values.iter().map(|value| value.0[lane].abs()));
                    ratio(largest(&mut own.iter().map(|error| error.0[lane])), size)
                }));
                let each = own.iter().zip(&sizes[range.clone()]);
                let per_output = largest(
                    &mut each.flat_map(|(error, size)| error.0.map(|error| ratio(error, *size))),
                );
                let worst = [
                    &mut rounding.normwise[quantity],
                    &mut rounding.per_output[quantity],
                ];
                for (worst, own) in worst.into_iter().zip([normwise, per_output]) {
                    *worst = worst.max(own);
                }
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
        let worst = |own: &[f64], other: &[f64]| {
            let pairs = own.iter().zip(other);
            pairs.fold(0.0, |worst: f64, (own, other)| {
                worst.max(own / other.max(floor))
            })
        };
        worst(&self.normwise, &than.normwise).max(worst(&self.per_output, &than.per_output))
    }

    /// Returns the largest normwise error of a quantity.
    pub fn worst(&self) -> f64 {
        self.normwise.iter().copied().fold(0.0, f64::max)
    }
}

/// A program whose constants are shared: one rounding each, wherever it is used.
struct Network<'a> {
    program: &'a Program,
    /// The rounded constants; whether each is a power of two, which costs no
    /// digit as it stands and none as a factor.
    constants: Vec<(f64, bool)>,
    /// The constants that each step reads.
    shared: Vec<[Option<usize>; 2]>,
}

/// A program's values at a few states.
struct Run {
    values: Vec<Lanes>,
    /// The operands of each step.
    operands: Vec<[Lanes; 2]>,
    /// The sine and the cosine of each angle, in the order of `trig`.
    pairs: Vec<(Lanes, Lanes)>,
    outputs: Vec<Lanes>,
}

impl<'a> Network<'a> {
    fn new(program: &'a Program) -> Self {
        let mut known: BTreeMap<&'a Exact, usize> = BTreeMap::new();
        let mut constants = Vec::new();
        let mut place = |operand: &'a Operand| match operand {
            Operand::Constant(value) => Some(*known.entry(value).or_insert_with(|| {
                constants.push((f64::nearest(value), is_power_of_two(value)));
                constants.len() - 1
            })),
            Operand::Input(_) | Operand::Step(_) => None,
        };
        let steps = program.steps.iter();
        let shared = steps.map(|step| [place(&step.left), place(&step.right)]);
        Network {
            shared: shared.collect(),
            program,
            constants,
        }
    }

    /// Computes the values at a few states; lanes beyond repeat the last of them.
    fn run(&self, states: &[JointState]) -> Run {
        let each = |of: &dyn Fn(&JointState) -> f64| {
            Lanes(from_fn(|lane| {
                let state = states.get(lane).or(states.last());
                state.map_or(f64::NAN, of)
            }))
        };
        let steps = &self.program.steps;
        // The sine and the cosine of each angle, in the order of `trig`.
        let trig = &self.program.trig;
        let angles = trig.iter().map(|trig| {
            let angle = each(&|state| {
                let signed = |(joint, negative): (usize, bool)| match negative {
                    true => -state.q[joint],
                    false => state.q[joint],
                };
                trig.angle.terms().map(signed).sum()
            });
            let pairs = angle.0.map(libm::sincos);
            (
                Lanes(pairs.map(|pair| pair.0)),
                Lanes(pairs.map(|pair| pair.1)),
            )
        });
        let pairs: Vec<(Lanes, Lanes)> = angles.collect();
        let place = |angle| trig.iter().position(|trig| trig.angle == angle);
        let pair = |angle| place(angle).and_then(|place| pairs.get(place));
        let speed = |joint: usize, state: &JointState| {
            let own = self.program.speeds.iter().find(|own| own.joint == joint)?;
            let (qd, square) = (state.qd.get(joint)?, f64::nearest(&own.square));
            Some(per_speed(qd, &square, |x| libm::sqrt(*x)))
        };
        let input = |input: Input| match input {
            Input::PerSpeed(joint) => each(&|state| speed(joint, state).unwrap_or(f64::NAN)),
            Input::Entry(argument, joint) => each(&|state| state.entry(argument, joint)),
            Input::Sin(angle) => pair(angle).map_or(Lanes::zero(), |pair| pair.0),
            Input::Cos(angle) => pair(angle).map_or(Lanes::one(), |pair| pair.1),
        };
        let mut values: Vec<Lanes> = Vec::with_capacity(steps.len());
        let mut operands: Vec<[Lanes; 2]> = Vec::with_capacity(steps.len());
        for (step, shared) in steps.iter().zip(&self.shared) {
            let read = |(operand, shared): (&Operand, Option<usize>)| match (operand, shared) {
                (_, Some(constant)) => Lanes::all(self.constants[constant].0),
                (operand, None) => value(operand, &values, input),
            };
            let [x, y] = [(&step.left, shared[0]), (&step.right, shared[1])].map(read);
            operands.push([x, y]);
            values.push(step.operation.apply(&x, &y));
        }
        let outputs = self.program.outputs.iter();
        let outputs = outputs.map(|output| value(&output.value, &values, input));
        Run {
            outputs: outputs.collect(),
            values,
            operands,
            pairs,
        }
    }

    /// Returns each output's error, in units of u.
    fn errors(&self, run: &Run) -> Vec<Lanes> {
        let outputs = self.program.outputs.iter();
        let errors = outputs.map(|output| self.error(&output.value, run));
        errors.collect()
    }

    /// Returns the root of the sum of squares of all errors, as they reach an output.
    fn error(&self, output: &Operand, run: &Run) -> Lanes {
        let Run {
            values,
            operands,
            pairs,
            ..
        } = run;
        let mut squares = Lanes::zero();
        let mut constants = vec![Lanes::zero(); self.constants.len()];
        let mut slopes = vec![(Lanes::zero(), Lanes::zero()); pairs.len()];
        let mut note = |operand: &Operand, slope: &Lanes| {
            let Operand::Input(input @ (Input::Sin(angle) | Input::Cos(angle))) = operand else {
                return;
            };
            let mut trig = self.program.trig.iter().zip(&mut slopes);
            match (trig.find(|(trig, _)| trig.angle == *angle), input) {
                (Some((_, (sin, _))), Input::Sin(_)) => *sin = sin.add(slope),
                (Some((_, (_, cos))), _) => *cos = cos.add(slope),
                (None, _) => {}
            }
        };
        match output {
            Operand::Step(top) => {
                let visit = |index: usize, slope: &Lanes| {
                    let step = &self.program.steps[index];
                    let mut shared = self.shared[index].iter().flatten();
                    let is_exact = match step.operation {
                        Operation::Fused => true,
                        Operation::Mul => shared.any(|constant| self.constants[*constant].1),
                        Operation::Add | Operation::Sub | Operation::Div => false,
                    };
                    let arrives = !slope.vanishes();
                    if arrives && !is_exact {
                        squares = squares.add(&slope.mul(&values[index]).square());
                    }
                    arrives
                };
                let leaf = |leaf: Leaf<'_, Exact, Input>, slope: Lanes| match self.shared[leaf.step]
                    [leaf.side]
                {
                    Some(constant) => constants[constant] = constants[constant].add(&slope),
                    None => note(leaf.operand, &slope),
                };
                backward(
                    &self.program.steps,
                    *top,
                    |index| operands[index],
                    visit,
                    leaf,
                );
            }
            Operand::Constant(value) if !is_power_of_two(value) => {
                squares = squares.add(&Lanes::all(f64::nearest(value)).square());
            }
            operand => note(operand, &Lanes::one()),
        }
        for ((value, is_exact), slope) in self.constants.iter().zip(&constants) {
            if !is_exact {
                squares = squares.add(&slope.mul(&Lanes::all(*value)).square());
            }
        }
        for ((sin, cos), slope) in pairs.iter().zip(&slopes) {
            let own = slope.0.mul(sin).square().add(&slope.1.mul(cos).square());
            squares = squares.add(&own);
        }
        squares.sqrt()
    }
}

fn value(operand: &Operand, values: &[Lanes], input: impl Fn(Input) -> Lanes) -> Lanes {
    match operand {
        Operand::Input(of) => input(*of),
        Operand::Constant(constant) => Lanes::all(f64::nearest(constant)),
        Operand::Step(step) => values[*step],
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
