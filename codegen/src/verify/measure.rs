//! The reference for emitted text that is run bit for bit: the generic runtime in f64, and how many
//! times more than others a quantity may err.

use dalembert_model::equations::factor::submatrix;
use dalembert_model::equations::forward::free;
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::sparse::Sparse;

use super::condition::{condition, scaled_condition};
use crate::dag::Node;
use crate::function::{Function, Quantity, Sizes};
use crate::program::kernel::Kernel;
use crate::program::machine::Machine;
use crate::program::{Code, Input, Literal, Pair, ScalarType};
use crate::scalar::AnyScalar::Double;
use crate::scalar::{AnyValue, Case};
use crate::setup::{Setup, TaskArm};
use crate::states::JointState;

/// A seeded state counts relative to at least this part of the largest
/// reference met. Next to balance, where every torque passes through zero,
/// an error relative to the torque says nothing about the code.
pub const LEAST_PART: f64 = 1.0 / 16.0;

#[derive(Clone, Debug)]
pub struct RunnableCode {
    pub function: Function,
    pub scalar: ScalarType,
    pub sizes: Sizes,
    pub text: Code,
}

/// The factors by which the results at a state may err more than others: for what inverts D, the
/// condition of D over the joints that move, with a unit diagonal, so that units and sizes of the
/// joints are taken out and excuse nothing; for what inverts a matrix over components of the hand's
/// velocity, the condition of this as it stands, since its entries are added to one λ².
#[derive(Clone, Debug)]
pub struct ConditionAllowance(Vec<(Quantity, f64)>);

impl ConditionAllowance {
    /// Returns the condition of a quantity: what else is in a function inverts nothing.
    pub fn factor(&self, quantity: Quantity) -> f64 {
        let entry = self.0.iter().find(|(key, _)| *key == quantity);
        entry.map_or(1.0, |(_, factor)| *factor)
    }
}

/// The generic runtime: the link-frame recursion in f64, constants rounded once.
#[derive(Debug)]
pub struct Runtime {
    /// Lengths that no torque depends on are folded away while exact.
    arm: Arm<AnyValue>,
    /// With them.
    whole: Arm<AnyValue>,
    setup: Setup,
}

impl Runtime {
    /// Creates the runtime of a robot; lengths without effect are folded away while exact.
    pub fn new(robot: &Robot) -> Runtime {
        Runtime::in_scene(Setup::whole(robot))
    }

    /// Creates the runtime of a robot in a scene, whose constants take the place of the state's.
    pub fn in_scene(setup: Setup) -> Runtime {
        let exact = setup.arm(Exact::clone);
        let whole = exact.map(constant);
        let arm = exact.fold_base().map(constant);
        Runtime { arm, whole, setup }
    }

    /// Returns the factors by which a function's results may err more than others at a state.
    pub fn granted(&self, function: Function, state: &JointState) -> ConditionAllowance {
        let inverts =
            |quantity: &Quantity| quantity.facts().inverts_inertia || quantity.is_of_frame();
        if !function.quantities().iter().any(inverts) {
            return ConditionAllowance(Vec::new());
        }
        let posed = self.posed(function, state);
        let (arm, motion) = (&posed.arm, &posed.motion);
        let d = Formulation::NewtonEulerLink.gathered_inertia(arm, &arm.at(&motion.q));
        let d = submatrix(&d, &free(&motion.moves)).concat();
        // A matrix without entries has the condition zero.
        let of_inertia = scaled_condition(&floats(&d)).max(1.0);
        let divisors = posed.divisors();
        let quantities = function.quantities().iter().zip(&divisors);
        let factors = quantities.map(|(&quantity, divisor)| {
            let of_divisor = condition(&floats(divisor)).max(1.0);
            let factor = match quantity.facts().inverts_inertia {
                true => of_inertia * of_divisor,
                false => of_divisor,
            };
            (quantity, factor)
        });
        ConditionAllowance(factors.collect())
    }

    fn posed(&self, function: Function, state: &JointState) -> TaskArm<'_, AnyValue> {
        let input = |input: Input| Sparse::Value(Double(self.setup.input_at(input, state)));
        let mut quantities = function.quantities().iter();
        let is_whole = quantities.any(|quantity| quantity.facts().depends_on_base);
        let arm = if is_whole { &self.whole } else { &self.arm };
        let task = self.setup.task(function);
        task.posed_arm(arm.clone(), &(constant, input))
    }

    pub fn run(&self, function: Function, state: &JointState) -> Vec<f64> {
        let posed = self.posed(function, state);
        floats(&posed.results(Formulation::NewtonEulerLink))
    }
}

fn constant(exact: &Exact) -> AnyValue {
    Sparse::constant(exact, Double(f64::nearest(exact)))
}

/// Returns values as floats; a quotient by a structural zero is no number.
fn floats(values: &[AnyValue]) -> Vec<f64> {
    let values = values.iter().map(|x| x.value().and_then(f64::of));
    values.map(|value| value.unwrap_or(f64::NAN)).collect()
}

impl RunnableCode {
    /// Returns the results at a state, flat, as doubles that hold them exactly.
    pub fn run(&self, state: &JointState) -> Vec<f64> {
        self.text.run_at(state)
    }

    #[must_use]
    pub fn with_libm(&self) -> RunnableCode {
        let text = self.text.with_libm();
        RunnableCode { text, ..*self }
    }

    /// True for each result that was proved to vanish, which is compared with zero.
    pub fn vanishing(&self) -> impl Iterator<Item = bool> {
        let dag = &self.text.dag;
        let outputs = dag.outputs.iter();
        outputs.map(|output| *dag.node(output.node) == Node::Constant(Literal(0.0)))
    }

    /// Returns the largest |polynomial − libm's f64| of each joint over the states, in
    /// the order of the text; none for angles that are libm's.
    pub fn sines(&self, states: &[JointState]) -> Vec<(usize, f64)> {
        let worst = |pair: &Pair| {
            let kernel = pair.kernel.as_ref()?;
            let error = |state: &JointState| match self.scalar {
                ScalarType::F64 => off::<f64>(pair, kernel, state),
                ScalarType::F32 => off::<f32>(pair, kernel, state),
            };
            Some((pair.joint, states.iter().map(error).fold(0.0, f64::max)))
        };
        self.text.pairs.iter().filter_map(worst).collect()
    }
}

fn off<T: Machine>(pair: &Pair, kernel: &Kernel, state: &JointState) -> f64 {
    let angle = T::literal(state.q[pair.joint]);
    let (sin, cos) = kernel.run(angle);
    let (true_sin, true_cos) = libm::sincos(angle.to_f64());
    let off = |taken: bool, a: T, b: f64| match taken {
        // A NaN loses every comparison: it must not go unnoticed.
        true if a.to_f64().is_nan() => f64::INFINITY,
        true => (a.to_f64() - b).abs(),
        false => 0.0,
    };
    off(pair.need.sin, sin, true_sin).max(off(pair.need.cos, cos, true_cos))
}
