//! Code: a program in a scalar, as it is printed, read back and run.

use std::collections::BTreeMap;

use dalembert_model::number::Exact;

use super::kernel::{Kernel, Need};
use super::lanes::{LANES, Lanes};
use super::machine::Machine;
use super::{Counts, Input, Library, Literal, Program, ScalarType, Speed};
use crate::dag::{Dag, Leaves};
use crate::function::Argument;
use crate::states::{JointState, State};

/// A program in a scalar: every constant rounded once, and how each angle's sine and cosine are
/// computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// The scalar.
    pub scalar: ScalarType,
    /// Who computes the sines that are called; libm where none is.
    pub library: Library,
    /// Sines and cosines, in the order of the text.
    pub pairs: Vec<Pair>,
    /// The joints of which r = 1/√(q̇² + w²) is read, ascending.
    pub speeds: Vec<Speed<Literal>>,
    /// The arithmetic and the results.
    pub dag: Dag<Literal>,
}

/// The sine and cosine of a joint's angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The joint.
    pub joint: usize,
    /// The ones that the code reads.
    pub need: Need,
    /// The polynomials, unless a library is called.
    pub kernel: Option<Kernel>,
}

impl Code {
    /// Rounds a program to a scalar, with the polynomials that there are for sines; other angles are
    /// the library's. One that takes all angles together is called after the sines that are
    /// computed alone.
    pub(crate) fn new(
        program: &Program,
        scalar: ScalarType,
        library: Library,
        kernel: impl Fn(usize) -> Option<Kernel>,
    ) -> Code {
        let literal = |value: &Exact| Literal(scalar.round(value));
        let pairs = program.trig().into_iter().map(|trig| Pair {
            joint: trig.joint,
            need: trig.need,
            kernel: kernel(trig.joint),
        });
        let speeds = program.speeds.iter().map(|own| Speed {
            joint: own.joint,
            square: literal(&own.square),
        });
        let code = Code {
            scalar,
            library: Library::Libm,
            pairs: pairs.collect(),
            speeds: speeds.collect(),
            dag: program.dag.map(literal, |input| *input),
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

    /// Returns the code with libm's sines in place of all others, to measure what rounding costs
    /// the rest.
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
        let kernels = self.pairs.iter().filter_map(|pair| pair.kernel.as_ref());
        let trig = kernels.map(Kernel::counts);
        let (trig_mul, trig_add) = trig.fold((0, 0), |(m, a), (mul, add)| (m + mul, a + add));
        let own = Counts {
            sincos: self.pairs.len(),
            trig_mul,
            trig_add,
            ..self.dag.arithmetic()
        };
        own.with_speeds(self.speeds.len())
    }

    /// Runs the code bit for bit at a state; none if the state lacks an entry that is read.
    pub fn run<T: Machine>(&self, state: &State<T>) -> Option<Vec<T>> {
        let inputs = Inputs::new(self, std::slice::from_ref(state))?;
        Some(self.dag.run(&First(inputs)))
    }

    /// Runs the code at many states, with the bits of [`Code::run`]; returns a column a result.
    pub fn run_many<T: Machine>(&self, states: &[State<T>]) -> Option<Vec<Vec<T>>> {
        let mut columns = vec![Vec::with_capacity(states.len()); self.dag.outputs.len()];
        for states in states.chunks(LANES) {
            let results = self.dag.run(&Inputs::new(self, states)?);
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
        let states = states.iter();
        let results = match self.scalar {
            ScalarType::F64 => {
                let states: Vec<State<f64>> = states.map(JointState::numbers).collect();
                self.run_many(&states)
            }
            ScalarType::F32 => {
                let states: Vec<State<f32>> = states.map(JointState::numbers).collect();
                let columns = self.run_many(&states);
                columns.map(|columns| columns.into_iter().map(widened).collect())
            }
        };
        results.unwrap_or_default()
    }
}

impl Code {
    /// Returns the value of each node at a state, in doubles; none where the state lacks an entry
    /// that is read.
    pub(crate) fn values_at(&self, state: &JointState) -> Vec<f64> {
        let inputs = Inputs::new(self, &[state.numbers()]);
        inputs.map_or_else(Vec::new, |inputs| self.dag.values(&First(inputs)))
    }
}

fn widened(numbers: Vec<f32>) -> Vec<f64> {
    numbers.into_iter().map(f64::from).collect()
}

impl Program {
    /// Returns the program in f64, with libm's sines.
    pub fn in_doubles(&self) -> Code {
        Code::new(self, ScalarType::F64, Library::Libm, |_| None)
    }
}

/// The inputs of code at a few states.
struct Inputs<T>(BTreeMap<Input, Lanes<T>>);

/// The inputs at the first of them.
struct First<T>(Inputs<T>);

impl<T: Machine> Inputs<T> {
    /// Reads what the code reads; none if a state lacks an entry of it.
    fn new(code: &Code, states: &[State<T>]) -> Option<Inputs<T>> {
        let lanes = |argument: Argument, of: &dyn Fn(&[T]) -> Option<T>| {
            let values = states.iter().map(|state| of(&state[argument.index()]));
            Lanes::new(&values.collect::<Option<Vec<T>>>()?)
        };
        let mut inputs = BTreeMap::new();
        for &input in code.dag.inputs() {
            if let Input::Entry(argument, index) = input {
                let entries = lanes(argument, &|entries| entries.get(index).copied())?;
                inputs.insert(input, entries);
            }
        }
        for pair in &code.pairs {
            let both = |state: &State<T>| {
                let angle = state[Argument::Position.index()].get(pair.joint)?;
                Some(pair.run(code.library, *angle))
            };
            let both = states.iter().map(both).collect::<Option<Vec<_>>>()?;
            let (sines, cosines): (Vec<T>, Vec<T>) = both.into_iter().unzip();
            inputs.insert(Input::Sin(pair.joint), Lanes::new(&sines)?);
            inputs.insert(Input::Cos(pair.joint), Lanes::new(&cosines)?);
        }
        for speed in &code.speeds {
            let value = lanes(Argument::Velocity, &|qd| speed.run(qd))?;
            inputs.insert(Input::PerSpeed(speed.joint), value);
        }
        Some(Inputs(inputs))
    }
}

impl<T: Machine> Leaves<Literal, Input> for Inputs<T> {
    type Value = Lanes<T>;

    fn constant(&self, constant: &Literal) -> Lanes<T> {
        Lanes([T::literal(constant.0); LANES])
    }

    fn input(&self, input: Input) -> Lanes<T> {
        let known = self.0.get(&input).copied();
        known.unwrap_or(Lanes([T::literal(f64::NAN); LANES]))
    }
}

impl<T: Machine> Leaves<Literal, Input> for First<T> {
    type Value = T;

    fn constant(&self, constant: &Literal) -> T {
        T::literal(constant.0)
    }

    fn input(&self, input: Input) -> T {
        self.0.input(input).0[0]
    }
}

impl Pair {
    /// Returns sine and cosine as the code computes them; of one that it does not read, anything.
    fn run<T: Machine>(&self, library: Library, angle: T) -> (T, T) {
        match &self.kernel {
            Some(kernel) => kernel.run(angle),
            None => library.pair(angle, self.need),
        }
    }
}
