//! What rounding costs a program, measured without a reference.
//!
//! A program run in f32, with its constants rounded to f32, against the same
//! program in f64 with the constants in f64, at the same f32 state: the
//! difference is the f32 rounding error to seven digits, and in units of u it
//! is what f64 would suffer too. It needs no big float and is the same on
//! every machine, so it may decide.

use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;

use super::interpret::Machine;
use super::states::{self, JointState};
use crate::emit::ScalarType;
use crate::function::{Function, Quantity};
use crate::graph::{Graph, Input};
use crate::portfolio;
use crate::scene::Setting;
use crate::schedule::{Operand, Program, Trig};

/// How many states decide.
const STATES: usize = 100;

/// A seed of its own.
const SEED: u64 = 0xacc;

/// The worst rounding errors over the states, in units of u, one a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// max_i |error_i| / max_i |result_i|.
    pub normwise: Vec<f64>,
    /// |error_i| / the largest |result_i| over the states, the worst i.
    pub per_output: Vec<f64>,
}

impl Accuracy {
    /// Of a program inside the robot's limits.
    pub fn measure(robot: &Robot, program: &Program) -> Accuracy {
        let single = Runner::<f32>::new(program, ScalarType::F32);
        let double = Runner::<f64>::new(program, ScalarType::F64);
        let mut runs = Vec::with_capacity(STATES);
        for state in states::seeded(robot, STATES, SEED) {
            let state = state.in_single();
            runs.push((single.run(&state), double.run(&state)));
        }
        let u = ScalarType::F32.unit_roundoff();
        let mut accuracy = Accuracy {
            normwise: Vec::new(),
            per_output: Vec::new(),
        };
        let mut start = 0;
        for quantity in program.function.quantities() {
            let range = start..start + quantity.len(program.rows.len());
            start = range.end;
            let error = |(rough, fine): &(Vec<f64>, Vec<f64>), i: usize| (rough[i] - fine[i]).abs();
            let over = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
            let ratio = |error: f64, size: f64| if size > 0.0 { error / size / u } else { 0.0 };
            let normwise = over(&mut runs.iter().map(|run| {
                let error = over(&mut range.clone().map(|i| error(run, i)));
                let size = over(&mut range.clone().map(|i| run.1[i].abs()));
                ratio(error, size)
            }));
            let per_output = over(&mut range.clone().map(|i| {
                let error = over(&mut runs.iter().map(|run| error(run, i)));
                let size = over(&mut runs.iter().map(|run| run.1[i].abs()));
                ratio(error, size)
            }));
            accuracy.normwise.push(normwise);
            accuracy.per_output.push(per_output);
        }
        accuracy
    }

    /// Whether a quantity is more than `factor` times worse, beyond a few u
    /// that any code has.
    pub fn is_worse(&self, than: &Accuracy, factor: f64) -> bool {
        let worse = |own: &[f64], other: &[f64]| {
            let mut pairs = own.iter().zip(other);
            pairs.any(|(own, other)| *own > factor * other.max(FLOOR))
        };
        worse(&self.normwise, &than.normwise) || worse(&self.per_output, &than.per_output)
    }
}

/// An error of this many u is nothing to mend.
const FLOOR: f64 = 4.0;

/// The factor in rounding error that fewer operations may cost.
pub const WORSE: f64 = 4.0;

/// Longer chains are not measured: their programs are what the recursion is.
const MOST_MEASURED: usize = 16;

/// The most joints for which h_ikm is held against Lagrange–Euler.
const MOST_WRITTEN: usize = 7;

/// Accepts a program of a function that costs no more than [`WORSE`] times
/// the error of a textbook form.
#[derive(Clone, Debug)]
pub struct Judge<'a> {
    setting: &'a Setting,
    function: Function,
    yardstick: Option<Accuracy>,
}

impl<'a> Judge<'a> {
    /// Measures the textbook form: the link-frame recursion; for h_ikm, which
    /// it gives only by differences, Lagrange–Euler.
    pub fn new(setting: &'a Setting, function: Function) -> Self {
        let n = setting.joints().len();
        let formulation = if function.quantities().contains(&Quantity::Christoffel) {
            (n <= MOST_WRITTEN).then_some(Formulation::LagrangeEuler)
        } else {
            (n <= MOST_MEASURED).then_some(Formulation::NewtonEulerLink)
        };
        let yardstick = formulation.map(|formulation| {
            let textbook = portfolio::textbook(setting, function, formulation).graph;
            measure(setting, function, &textbook)
        });
        Judge {
            setting,
            function,
            yardstick,
        }
    }

    /// Whatever it costs.
    pub fn lenient(setting: &'a Setting, function: Function) -> Self {
        Judge {
            setting,
            function,
            yardstick: None,
        }
    }

    /// Whether the program is accurate enough.
    pub fn accepts(&self, graph: &Graph) -> bool {
        match &self.yardstick {
            None => true,
            Some(yardstick) => {
                let own = measure(self.setting, self.function, graph);
                !own.is_worse(yardstick, WORSE)
            }
        }
    }
}

fn measure(setting: &Setting, function: Function, graph: &Graph) -> Accuracy {
    let program = Program::in_setting(setting, function, graph);
    Accuracy::measure(setting.robot(), &program)
}

/// A program with its constants rounded.
pub(crate) struct Runner<'a, T> {
    program: &'a Program,
    /// Left and right constant of each step; zero where there is none.
    constants: Vec<[T; 2]>,
    results: Vec<T>,
}

impl<'a, T: Machine> Runner<'a, T> {
    pub(crate) fn new(program: &'a Program, scalar: ScalarType) -> Self {
        let constant = |operand: &Operand| match operand {
            Operand::Constant(value) => T::literal(scalar.round(value)),
            _ => T::literal(0.0),
        };
        Runner {
            program,
            constants: program
                .steps
                .iter()
                .map(|step| [constant(&step.left), constant(&step.right)])
                .collect(),
            results: program.outputs.iter().map(|o| constant(&o.value)).collect(),
        }
    }

    pub(crate) fn run(&self, state: &JointState) -> Vec<f64> {
        let pairs: Vec<(Trig, (T, T))> = self
            .program
            .trig
            .iter()
            .map(|&trig| {
                let mut sum = T::literal(0.0);
                for (joint, negative) in trig.angle.terms() {
                    let q = T::literal(state.q[joint]);
                    let q = if negative { q.neg() } else { q };
                    sum = sum.operate(crate::schedule::Operation::Add, q);
                }
                (trig, sum.sincos())
            })
            .collect();
        let read = |operand: &Operand, constant: T, steps: &[T]| match operand {
            Operand::Constant(_) => constant,
            Operand::Step(index) => steps[*index],
            Operand::Input(Input::Position(joint)) => T::literal(state.q[*joint]),
            Operand::Input(Input::Velocity(joint)) => T::literal(state.qd[*joint]),
            Operand::Input(Input::Acceleration(joint)) => T::literal(state.qdd[*joint]),
            Operand::Input(Input::Sin(angle)) => pair(&pairs, *angle).0,
            Operand::Input(Input::Cos(angle)) => pair(&pairs, *angle).1,
        };
        let mut steps: Vec<T> = Vec::with_capacity(self.program.steps.len());
        for (step, [left, right]) in self.program.steps.iter().zip(&self.constants) {
            let (x, y) = (
                read(&step.left, *left, &steps),
                read(&step.right, *right, &steps),
            );
            steps.push(x.operate(step.operation, y));
        }
        let results = self.program.outputs.iter().zip(&self.results);
        results
            .map(|(output, &constant)| {
                let value = read(&output.value, constant, &steps);
                let value = if output.negative { value.neg() } else { value };
                value.to_f64()
            })
            .collect()
    }
}

fn pair<T: Machine>(pairs: &[(Trig, (T, T))], angle: crate::graph::AngleSum) -> (T, T) {
    let found = pairs.iter().find(|(trig, _)| trig.angle == angle);
    found.map_or((T::literal(0.0), T::literal(1.0)), |(_, pair)| *pair)
}
