//! The generic runtime as [`Code`] to measure.

use dalembert_cli::measure::Code;
use dalembert_codegen::workspace::{Argument, JointState, Sizes};
use dalembert_codegen::{Function, ScalarType};
use dalembert_model::reference::{Float, JointVectors, Reference};
use dalembert_model::robot::Robot;
use nalgebra::DVector;

/// Returns the runtime of a robot in a scalar.
pub fn runtime(robot: &Robot, function: Function, scalar: ScalarType) -> Code<'static> {
    let sizes = Sizes::whole(robot.joints.len());
    let double = Reference::<f64>::from_robot(robot);
    let single = Reference::<f32>::from_robot(robot);
    Code {
        function,
        scalar,
        sizes,
        vanishing: vec![false; function.outputs(sizes)],
        run: Box::new(move |state| match scalar {
            ScalarType::F64 => run(&double, function, state, |x| x, |x| x),
            ScalarType::F32 => run(&single, function, state, |x| x as f32, f64::from),
        }),
    }
}

fn run<T: Float>(
    runtime: &Reference<T>,
    function: Function,
    state: &JointState,
    narrow: impl Fn(f64) -> T,
    widen: impl Fn(T) -> f64,
) -> Vec<f64> {
    let vector = |argument: Argument| {
        let values = state.entries(argument).iter().map(|x| narrow(*x));
        (argument, DVector::from_iterator(values.len(), values))
    };
    let at = JointVectors::new(Argument::JOINTS.map(vector));
    let quantities = function.quantities().iter();
    let entries = quantities.flat_map(|&quantity| runtime.entries(quantity, &at).unwrap());
    entries.map(widen).collect()
}
