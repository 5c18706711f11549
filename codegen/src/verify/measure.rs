//! The measured rounding error: the emitted text, run bit for bit, against the generic
//! runtime in f64.
//!
//! The error of a quantity is normwise, max_i |error_i| / max_i |reference_i|,
//! the worst over the states. f32 code is compared at the f32-rounded state,
//! so that only the rounding of its own arithmetic and constants counts. What
//! inverts D may err as many times more as D's condition at the state is.

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
use crate::setup::{Posed, Setup};
use crate::states::JointState;

/// The bound on the normwise error against the runtime, in units of u.
pub const BOUND: f64 = 100.0;

/// A seeded state counts relative to at least this part of the largest
/// reference met. Next to balance, where every torque passes through zero,
/// an error relative to the torque says nothing about the code.
pub const LEAST_PART: f64 = 1.0 / 16.0;

/// An emitted function, read back.
#[derive(Clone, Debug)]
pub struct Emitted {
    /// The function.
    pub function: Function,
    /// Its scalar.
    pub scalar: ScalarType,
    /// The numbers that the lengths of its results follow from.
    pub sizes: Sizes,
    /// Its text.
    pub text: Code,
}

/// The worst normwise error of one quantity of one function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// The function.
    pub function: Function,
    /// Its scalar.
    pub scalar: ScalarType,
    /// The quantity.
    pub quantity: Quantity,
    /// The worst error, over the condition of D where the quantity inverts it;
    /// infinite if a result is not a number.
    pub error: f64,
}

impl Measure {
    /// Returns the error in units of the scalar's u.
    pub fn in_units(&self) -> f64 {
        self.error / self.scalar.unit_roundoff()
    }
}

/// The factors by which the results at a state may err more than others: for what inverts D, the
/// condition of D over the joints that move, with a unit diagonal, so that units and sizes of the
/// joints are taken out and excuse nothing; for what inverts a matrix over components of the hand's
/// velocity, the condition of this as it stands, since its entries are added to one λ².
#[derive(Clone, Debug)]
pub struct Granted(Vec<(Quantity, f64)>);

impl Granted {
    /// Returns the condition of a quantity: what else is in a function inverts nothing.
    pub fn factor(&self, quantity: Quantity) -> f64 {
        let own = self.0.iter().find(|(own, _)| *own == quantity);
        own.map_or(1.0, |(_, factor)| *factor)
    }
}

/// The generic runtime: the link-frame recursion in f64, constants rounded once.
#[derive(Debug)]
pub struct Runtime {
    /// Lengths that no torque depends on are folded away while exact.
    arm: Arm<Sparse<f64>>,
    /// With them.
    whole: Arm<Sparse<f64>>,
    setup: Setup,
}

impl Runtime {
    /// Creates the runtime of a robot; lengths without effect are folded away while exact.
    pub fn new(robot: &Robot) -> Runtime {
        Runtime::in_scene(Setup::whole(robot))
    }

    /// Creates the runtime of a robot in a scene: the same recursion over all its joints, with
    /// the scene's constants in place of the state's.
    pub fn in_scene(setup: Setup) -> Runtime {
        let whole = setup.arm(Exact::clone);
        Runtime {
            arm: whole.clone().fold_base().map(constant),
            whole: whole.map(constant),
            setup,
        }
    }

    /// Returns the factors by which a function's results may err more than others at a state.
    pub fn granted(&self, function: Function, state: &JointState) -> Granted {
        let inverts = |quantity: &Quantity| quantity.inverts_inertia() || quantity.is_of_frame();
        if !function.quantities().iter().any(inverts) {
            return Granted(Vec::new());
        }
        let posed = self.posed(function, state);
        let (arm, motion) = (&posed.arm, &posed.motion);
        let d = Formulation::NewtonEulerLink.gathered_inertia(arm, &arm.at(&motion.q));
        let of_inertia = floats(&submatrix(&d, &free(&motion.moves)).concat());
        let of_inertia = match of_inertia.is_empty() {
            true => 1.0,
            false => scaled_condition(&of_inertia).max(1.0),
        };
        let divisors = posed.divisors();
        let quantities = function.quantities().iter().zip(&divisors);
        let factors = quantities.map(|(quantity, divisor)| {
            let own = match divisor.is_empty() {
                true => 1.0,
                false => condition(&floats(divisor)).max(1.0),
            };
            match quantity.inverts_inertia() {
                true => (*quantity, of_inertia * own),
                false => (*quantity, own),
            }
        });
        Granted(factors.collect())
    }

    /// Returns the arm and its motion at a state.
    fn posed(&self, function: Function, state: &JointState) -> Posed<'_, Sparse<f64>> {
        let input = |input: Input| Sparse::Value(self.setup.input_at(input, state));
        let arm = self.arm_of(function).clone();
        self.setup.task(function).posed_arm(arm, &(constant, input))
    }

    /// Returns the results of a function at a state, flat.
    pub fn run(&self, function: Function, state: &JointState) -> Vec<f64> {
        let posed = self.posed(function, state);
        let formulation = Formulation::NewtonEulerLink;
        floats(&posed.results(formulation))
    }

    /// Returns the arm that a function is of.
    fn arm_of(&self, function: Function) -> &Arm<Sparse<f64>> {
        let mut quantities = function.quantities().iter();
        match quantities.any(|quantity| quantity.depends_on_base()) {
            true => &self.whole,
            false => &self.arm,
        }
    }
}

/// Returns a constant rounded once.
fn constant(exact: &Exact) -> Sparse<f64> {
    Sparse::constant(exact, f64::nearest(exact))
}

/// Returns values as floats; a quotient by a structural zero is no number.
fn floats(values: &[Sparse<f64>]) -> Vec<f64> {
    let values = values.iter().map(Sparse::value);
    values.map(|value| value.unwrap_or(f64::NAN)).collect()
}

impl Emitted {
    /// Returns the results at a state, flat, as doubles that hold them exactly.
    pub fn run(&self, state: &JointState) -> Vec<f64> {
        self.text.run_at(state)
    }

    /// Returns the function with libm's sines in place of polynomials.
    #[must_use]
    pub fn with_libm(&self) -> Emitted {
        Emitted {
            text: self.text.with_libm(),
            ..*self
        }
    }

    /// Returns, for each result, whether it was proved to vanish: these are compared with zero,
    /// not with the rounding noise that a runtime leaves there.
    pub fn vanishing(&self) -> impl Iterator<Item = bool> {
        let dag = &self.text.dag;
        let outputs = dag.outputs.iter();
        outputs.map(|output| *dag.node(output.node) == Node::Constant(Literal(0.0)))
    }

    /// Returns the errors against the runtime, a quantity each. Sines are libm's on
    /// both sides: how far polynomials are from them is
    /// [measured apart](Emitted::sines).
    pub fn against_runtime(&self, runtime: &Runtime, states: &[JointState]) -> Vec<Measure> {
        let own = self.with_libm();
        let mut cases = Vec::with_capacity(states.len());
        for state in states {
            let state = state.in_scalar(self.scalar);
            let mut reference = runtime.run(self.function, &state);
            for (value, vanishes) in reference.iter_mut().zip(self.vanishing()) {
                if vanishes {
                    *value = 0.0;
                }
            }
            let granted = runtime.granted(self.function, &state);
            cases.push((own.run(&state), reference, granted));
        }
        let mut measures = Vec::new();
        let mut start = 0;
        for &quantity in self.function.quantities() {
            let range = start..start + quantity.len(self.sizes);
            start = range.end;
            let part = |values: &'_ [f64]| values[range.clone()].to_vec();
            let cases = cases.iter();
            let cases = cases.map(|(a, b, granted)| (part(a), part(b), granted.factor(quantity)));
            let cases: Vec<Case> = cases.collect();
            let least = LEAST_PART * cases.iter().map(|(_, b, _)| largest(b)).fold(0.0, f64::max);
            measures.push(self.measure(quantity, worst(&cases, least)));
        }
        measures
    }

    /// Returns the largest |polynomial − libm's f64| of each joint over the states, in
    /// the order of the text; none for angles that are libm's.
    pub fn sines(&self, states: &[JointState]) -> Vec<(usize, f64)> {
        let pairs = self.text.pairs.iter();
        let own = pairs.filter_map(|pair| Some((pair, pair.kernel.as_ref()?)));
        own.map(|(pair, kernel)| {
            let error = |state: &JointState| match self.scalar {
                ScalarType::F64 => off::<f64>(pair, kernel, state),
                ScalarType::F32 => off::<f32>(pair, kernel, state),
            };
            let worst = states.iter().map(error).fold(0.0, f64::max);
            (pair.joint, worst)
        })
        .collect()
    }

    fn measure(&self, quantity: Quantity, error: f64) -> Measure {
        Measure {
            function: self.function,
            scalar: self.scalar,
            quantity,
            error,
        }
    }
}

/// Returns the distance of an angle's polynomials from libm at a state.
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

/// Actual and expected values, and how many times more than others they may
/// differ.
type Case = (Vec<f64>, Vec<f64>, f64);

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Returns max|a − b| / max|b| of the worst case; absolute where b vanishes.
fn worst(cases: &[Case], least: f64) -> f64 {
    let mut worst = 0.0f64;
    for (actual, expected, granted) in cases {
        let size = largest(expected).max(least);
        let differences = actual.iter().zip(expected).map(|(a, b)| (a - b).abs());
        for difference in differences {
            let error = if size > 0.0 {
                difference / size / granted
            } else {
                difference / granted
            };
            // A NaN loses every comparison: it must not go unnoticed.
            worst = if error.is_nan() {
                f64::INFINITY
            } else {
                worst.max(error)
            };
        }
    }
    worst
}
