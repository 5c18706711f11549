//! What is tested: emitted code, run from its text, and the generic runtime.

use std::fmt;

use dalembert_model::reference::{Float, JointVectors, Reference, WrongLength};
use dalembert_model::robot::Robot;
use nalgebra::DVector;

use dalembert_codegen::workspace::{Argument, Columns, Emitted, JointState};
use dalembert_codegen::{Function, GenerateError, Request, ScalarType, generate};

/// Which code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Subject {
    /// [`Reference`].
    Runtime,
    /// The text that [`generate`] prints, interpreted bit for bit.
    Emitted,
}

impl Subject {
    /// Both.
    pub const ALL: [Subject; 2] = [Subject::Runtime, Subject::Emitted];
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Subject::Runtime => "runtime",
            Subject::Emitted => "emitted",
        })
    }
}

/// Code of one robot in one scalar.
#[derive(Clone, Debug)]
pub enum Code {
    /// The runtime in f64.
    Double(Box<Reference<f64>>),
    /// The runtime in f32.
    Single(Box<Reference<f32>>),
    /// Emitted functions.
    Emitted(Vec<Emitted>),
}

impl Code {
    /// Returns the generic runtime.
    pub fn runtime(robot: &Robot, scalar: ScalarType) -> Code {
        match scalar {
            ScalarType::F64 => Code::Double(Box::new(Reference::from_robot(robot))),
            ScalarType::F32 => Code::Single(Box::new(Reference::from_robot(robot))),
        }
    }

    /// Generates functions in a scalar, read back from the text; the reason where the scalar
    /// cannot hold a constant.
    ///
    /// # Errors
    /// Others of generating.
    pub fn emitted(
        robot: &Robot,
        request: &Request,
        functions: &[Function],
        scalar: ScalarType,
    ) -> Result<Result<Code, GenerateError>, GenerateError> {
        let request = Request {
            functions: functions.to_vec(),
            scalars: vec![scalar],
            ..request.clone()
        };
        match generate(robot, &request) {
            Ok(generated) => Ok(Ok(Code::Emitted(generated.emitted))),
            Err(error @ GenerateError::Constant { .. }) => Ok(Err(error)),
            Err(error) => Err(error),
        }
    }

    /// Returns the results of a function at a state, flat, as doubles that hold them
    /// exactly; `None` if there is no such function here, or the state is of
    /// another robot.
    pub fn run(&self, function: Function, state: &JointState) -> Option<Vec<f64>> {
        match self {
            // Which parameters are base parameters, the runtime does not know.
            Code::Double(_) | Code::Single(_) if matches!(function.columns(), Columns::Base(_)) => {
                None
            }
            Code::Double(runtime) => run(runtime, function, state, |x| x, |x| x).ok(),
            Code::Single(runtime) => run(runtime, function, state, |x| x as f32, f64::from).ok(),
            Code::Emitted(functions) => {
                let emitted = functions.iter().find(|f| f.function == function)?;
                Some(emitted.run(state))
            }
        }
    }
}

fn run<T: Float>(
    runtime: &Reference<T>,
    function: Function,
    state: &JointState,
    narrow: impl Fn(f64) -> T,
    widen: impl Fn(T) -> f64,
) -> Result<Vec<f64>, WrongLength> {
    let vector =
        |values: &[f64]| DVector::from_iterator(values.len(), values.iter().map(|x| narrow(*x)));
    let at = JointVectors {
        wrench: vector(state.of(Argument::Wrench)),
        damping: vector(state.of(Argument::Damping)),
        multiplier: vector(state.of(Argument::Multiplier)),
        ..JointVectors::new(Argument::JOINTS.map(|argument| vector(state.of(argument))))
    };
    let mut results = Vec::new();
    for quantity in function.quantities() {
        results.extend(runtime.entries(*quantity, &at)?);
    }
    Ok(results.into_iter().map(widen).collect())
}
