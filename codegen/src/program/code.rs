//! Code: a program in a scalar, as it is printed, read back and run.

use std::collections::BTreeMap;

use dalembert_model::equations::friction::per_speed;
use dalembert_model::number::Exact;
use dalembert_model::scalar::Divide;

use super::kernel::{Kernel, SinCosUse};
use super::machine::Machine;
use super::{Counts, Input, Library, Literal, Loop, Program, ScalarType};
use crate::dag::lanes::{LANES, Lanes};
use crate::dag::{Dag, Leaves};
use crate::function::Argument;
use crate::states::{JointState, State};

/// A program in a scalar, with every constant rounded once.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    pub scalar: ScalarType,
    /// The library that computes the sines that are called; libm where none is.
    pub library: Library,
    pub pairs: Vec<Pair>,
    /// The joints of which r = 1/√(q̇² + w²) is read, ascending.
    pub speeds: Vec<Speed<Literal>>,
    pub dag: Dag<Literal>,
    /// Operations that the text has in loops; none in code that was read.
    pub loops: Vec<Loop>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    pub joint: usize,
    pub need: SinCosUse,
    /// The polynomials, unless a library is called.
    pub kernel: Option<Kernel>,
}

/// A coordinate of the velocity whose r = 1/√(q̇² + w²) is read: it smooths Coulomb friction over a width w. The code
/// squares the velocity, adds w², takes the root and divides one by it.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed<C = Exact> {
    pub coordinate: usize,
    /// w²: exact, or the literal that it was rounded to.
    pub square: C,
}

impl Speed<Literal> {
    /// Returns r as the code computes it; none if the velocities lack the joint.
    pub fn run<T: Machine>(&self, qd: &[T]) -> Option<T> {
        let qd = qd.get(self.coordinate)?;
        Some(per_speed(qd, &T::literal(self.square.0), |x| x.root()))
    }
}

impl Code {
    /// Rounds every constant of a program to a scalar, once, and chooses the source of each sine.
    pub(crate) fn new(
        program: &Program,
        scalar: ScalarType,
        library: Library,
        kernel: impl Fn(usize) -> Option<Kernel>,
    ) -> Code {
        let literal = |value: &Exact| Literal(scalar.round(value));
        let pairs = program.trig().into_iter().map(|pair| Pair {
            kernel: kernel(pair.joint),
            ..pair
        });
        let speeds = program.speeds.iter().map(|speed| Speed {
            coordinate: speed.coordinate,
            square: literal(&speed.square),
        });
        let code = Code {
            scalar,
            library: Library::Libm,
            pairs: pairs.collect(),
            speeds: speeds.collect(),
            dag: program.dag.map(literal, |input| *input),
            loops: program.loops.clone(),
        };
        code.calling(library)
    }

    /// Returns the code with another library for the angles that call one.
    #[must_use]
    pub fn calling(mut self, library: Library) -> Code {
        let calls = |pair: &Pair| pair.kernel.is_none();
        if self.pairs.iter().any(calls) {
            self.library = library;
        }
        if self.library == Library::Together {
            self.pairs.sort_by_key(calls);
        }
        self
    }

    /// Returns the code with libm's sines, to measure what rounding costs the rest.
    #[must_use]
    pub fn with_libm(&self) -> Code {
        let mut other = self.clone();
        other.library = Library::Libm;
        for pair in &mut other.pairs {
            pair.kernel = None;
        }
        other
    }

    /// Counts the operations, with those of the polynomials for sines.
    pub fn counts(&self) -> Counts {
        let counts = Counts {
            sincos: self.pairs.len(),
            ..self.dag.arithmetic()
        };
        let kernels = self.pairs.iter().filter_map(|pair| pair.kernel.as_ref());
        counts.with_speeds(self.speeds.len()).with_kernels(kernels)
    }

    /// Runs the code bit for bit at a state; none if the state lacks an entry that is read.
    pub fn run<T: Machine>(&self, state: &State<T>) -> Option<Vec<T>> {
        let inputs = self.inputs(std::slice::from_ref(state))?;
        Some(self.dag.run(&leaves(inputs, |lanes| lanes.0[0])))
    }

    /// Runs the code at many states, as [`Code::run`]; returns a column a result.
    pub fn run_many<T: Machine>(&self, states: &[State<T>]) -> Option<Vec<Vec<T>>> {
        let mut columns = vec![Vec::with_capacity(states.len()); self.dag.outputs.len()];
        for states in states.chunks(LANES) {
            let results = self.dag.run(&leaves(self.inputs(states)?, |lanes| lanes));
            for (column, Lanes(lanes)) in columns.iter_mut().zip(results) {
                column.extend(&lanes[..states.len()]);
            }
        }
        Some(columns)
    }

    /// Runs the code at a state rounded to its own scalar; returns doubles that hold the results
    /// exactly, none where the state lacks an entry that is read.
    pub fn run_at(&self, state: &JointState) -> Vec<f64> {
        let results = match self.scalar {
            ScalarType::F64 => self.run::<f64>(&state.numbers()),
            ScalarType::F32 => self.run::<f32>(&state.numbers()).map(widened),
        };
        results.unwrap_or_default()
    }

    /// Runs the code at many states, as [`Code::run_at`]; returns a column a result.
    pub fn run_at_many(&self, states: &[JointState]) -> Vec<Vec<f64>> {
        fn columns<T: Machine>(code: &Code, states: &[JointState]) -> Vec<Vec<f64>> {
            let states: Vec<State<T>> = states.iter().map(JointState::numbers).collect();
            let columns = code.run_many(&states).unwrap_or_default();
            columns.into_iter().map(widened).collect()
        }
        match self.scalar {
            ScalarType::F64 => columns::<f64>(self, states),
            ScalarType::F32 => columns::<f32>(self, states),
        }
    }

    pub(crate) fn values_at(&self, state: &JointState) -> Vec<f64> {
        let inputs = self.inputs::<f64>(&[state.numbers()]);
        let values = inputs.map(|inputs| self.dag.values(&leaves(inputs, |lanes| lanes.0[0])));
        values.unwrap_or_default()
    }

    fn inputs<T: Machine>(&self, states: &[State<T>]) -> Option<BTreeMap<Input, Lanes<T>>> {
        let lanes = |argument: Argument, of: &dyn Fn(&[T]) -> Option<T>| {
            let values = states.iter().map(|state| of(&state[argument.index()]));
            Lanes::new(&values.collect::<Option<Vec<T>>>()?)
        };
        let mut inputs = BTreeMap::new();
        for &input in self.dag.inputs() {
            if let Input::Entry(argument, index) = input {
                let entries = lanes(argument, &|entries| entries.get(index).copied())?;
                inputs.insert(input, entries);
            }
        }
        for pair in &self.pairs {
            let both = |state: &State<T>| {
                let angle = state[Argument::Position.index()].get(pair.joint)?;
                Some(pair.run(self.library, *angle))
            };
            let both = states.iter().map(both).collect::<Option<Vec<_>>>()?;
            let (sines, cosines): (Vec<T>, Vec<T>) = both.into_iter().unzip();
            inputs.insert(Input::Sin(pair.joint), Lanes::new(&sines)?);
            inputs.insert(Input::Cos(pair.joint), Lanes::new(&cosines)?);
        }
        for speed in &self.speeds {
            let value = lanes(Argument::Velocity, &|qd| speed.run(qd))?;
            inputs.insert(Input::PerSpeed(speed.coordinate), value);
        }
        Some(inputs)
    }
}

fn leaves<T: Machine, S: Divide>(
    inputs: BTreeMap<Input, Lanes<T>>,
    wanted: impl Fn(Lanes<T>) -> S + Copy,
) -> impl Leaves<Literal, Input, Value = S> {
    let number = move |x: f64| wanted(Lanes([T::literal(x); LANES]));
    let constant = move |constant: &Literal| number(constant.0);
    let input = move |input: Input| match inputs.get(&input) {
        Some(lanes) => wanted(*lanes),
        None => number(f64::NAN),
    };
    (constant, input)
}

fn widened<T: Machine>(numbers: Vec<T>) -> Vec<f64> {
    numbers.into_iter().map(T::to_f64).collect()
}

impl Program {
    /// Returns the program in f64, with libm's sines.
    pub fn in_doubles(&self) -> Code {
        Code::new(self, ScalarType::F64, Library::Libm, |_| None)
    }
}

impl Pair {
    /// A sine or cosine that the code does not read may be anything.
    fn run<T: Machine>(&self, library: Library, angle: T) -> (T, T) {
        match &self.kernel {
            Some(kernel) => kernel.run(angle),
            None => library.pair(angle, self.need),
        }
    }
}
