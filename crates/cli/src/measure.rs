//! Measures rounding: code that is run bit for bit, against 256-bit arithmetic.
//!
//! The error of a quantity at a state is max_i |error_i| over max_i |true_i|, in units of u times the
//! condition of what the quantity inverts. Near balance every torque passes through zero, where no
//! error is small against the torque: the divisor is at least a sixteenth of the largest value that
//! is met.

use std::ops::Range;

use dalembert_codegen::workspace::{
    ConditionAllowance, JointState, LEAST_PART, Quantity, Reference, RunnableCode, Runtime, Setup,
    Sizes, TrueValue,
};
use dalembert_codegen::{Function, ScalarType};
use dalembert_model::number::Rounded;

/// The bound in u of a vector.
pub const VECTOR: f64 = 100.0;
/// The bound in u of an entry, relative to its own largest value.
pub const ENTRY: f64 = 50.0;

/// A value below this part of the largest may be nothing but rounding.
const DUST: f64 = 1e-13;

/// Runs code at a state; results are flat, as doubles that hold them exactly.
pub type Run<'a> = Box<dyn Fn(&JointState) -> Vec<f64> + 'a>;

/// Code of one function in one scalar.
pub struct Code<'a> {
    /// The function.
    pub function: Function,
    /// Its scalar.
    pub scalar: ScalarType,
    /// The numbers that the lengths of its results follow from.
    pub sizes: Sizes,
    /// `true` for each result that was proved to be zero in every state.
    pub vanishing: Vec<bool>,
    /// Runs it at a state.
    pub run: Run<'a>,
}

impl Code<'_> {
    /// Takes an emitted function, with the sines of libm in the place of polynomials: how far these
    /// are from sines is measured apart.
    pub fn emitted(emitted: &RunnableCode) -> Code<'static> {
        let code = emitted.with_libm();
        Code {
            function: code.function,
            scalar: code.scalar,
            sizes: code.sizes,
            vanishing: code.vanishing().collect(),
            run: Box::new(move |state| code.run(state)),
        }
    }
}

/// The largest errors of one quantity of one function over some states.
#[derive(Clone, Debug)]
pub struct Worst {
    /// The function.
    pub function: Function,
    /// Its scalar.
    pub scalar: ScalarType,
    /// The quantity.
    pub quantity: Quantity,
    /// max_i |error_i| / max_i |true_i|, in u times the condition.
    pub vector: f64,
    /// max_i |error_i| / T_i, in u times the condition: T_i is the largest |true_i| that is met.
    pub entry: f64,
    /// The condition where `vector` is largest.
    pub condition: f64,
    /// The state there.
    pub state: JointState,
    /// A result is not finite: it is beyond the scalar's range.
    pub overflows: bool,
}

/// Returns the largest [`Worst::vector`] and [`Worst::entry`] of a function's quantities, in u.
pub fn largest(worst: &[Worst]) -> [f64; 2] {
    let most = |of: fn(&Worst) -> f64| worst.iter().map(of).fold(0.0, f64::max);
    [most(|worst| worst.vector), most(|worst| worst.entry)]
}

/// States with the true values of a function there, for code in one scalar.
pub struct Samples {
    states: Vec<JointState>,
    truths: Vec<Vec<TrueValue>>,
    granted: Vec<ConditionAllowance>,
    sizes: Vec<f64>,
}

/// A robot that code is measured on.
pub struct Bench {
    reference: Reference,
    runtime: Runtime,
    /// An absolute error that underflow may add, in units of the least subnormal number.
    underflow: f64,
}

impl Samples {
    /// Lets the errors of all entries count relative to the largest entry.
    pub fn relative_to_largest(&mut self) {
        let largest = self.sizes.iter().copied().fold(0.0, f64::max);
        self.sizes.fill(largest);
    }
}

impl Bench {
    /// Prepares the measurement of a robot's functions.
    pub fn new(setup: Setup) -> Bench {
        let joints = setup.robot().joints.iter();
        let parameters = joints.flat_map(|joint| [&joint.mass, &joint.a, &joint.d]);
        let sizes = parameters.map(|parameter| f64::nearest_rational(parameter).abs());
        let largest = sizes.fold(1.0, f64::max);
        Bench {
            reference: Reference::new(&setup),
            // Some thousand products, each off by half of it, times the robot's parameters.
            underflow: 4096.0 * largest,
            runtime: Runtime::in_scene(setup),
        }
    }

    /// Returns the robot, with the arguments that its functions take.
    pub fn setup(&self) -> &Setup {
        self.reference.setup()
    }

    /// Returns the true values of a function at a state.
    pub fn truth(&self, function: Function, state: &JointState) -> Vec<TrueValue> {
        self.reference.run(function, state)
    }

    /// Returns the runtime, whose results are those of the equations of motion.
    pub fn runtime(&self) -> &Runtime {
        &self.runtime
    }

    /// Works out what is true at states, as a scalar holds them; `scales` are the states that sizes
    /// are taken from.
    pub fn samples(
        &self,
        function: Function,
        scalar: ScalarType,
        states: &[JointState],
        scales: &[JointState],
    ) -> Samples {
        // A state that a scalar cannot hold is another state.
        let held = states.iter().map(|state| state.in_scalar(scalar));
        let states: Vec<JointState> = held.filter(JointState::is_finite).collect();
        let mut sizes: Vec<f64> = Vec::new();
        for state in scales {
            let values = self.runtime.run(function, state);
            sizes.resize(values.len(), 0.0);
            let pairs = sizes.iter_mut().zip(values);
            pairs.for_each(|(size, x)| *size = size.max(x.abs()));
        }
        let granted = |state: &JointState| self.runtime.granted(function, state);
        Samples {
            truths: states.iter().map(|s| self.truth(function, s)).collect(),
            granted: states.iter().map(granted).collect(),
            sizes,
            states,
        }
    }

    /// Measures every quantity of a function; `scales` are the states that sizes are taken from.
    pub fn measure(
        &self,
        code: &Code<'_>,
        states: &[JointState],
        scales: &[JointState],
    ) -> Vec<Worst> {
        let samples = self.samples(code.function, code.scalar, states, scales);
        self.compare(code, &samples)
    }

    /// Compares code with what is true at states.
    pub fn compare(&self, code: &Code<'_>, samples: &Samples) -> Vec<Worst> {
        let (function, scalar) = (code.function, code.scalar);
        let states = &samples.states;
        let results: Vec<Vec<f64>> = states.iter().map(|state| (code.run)(state)).collect();
        let mut start = 0;
        let worst = |&quantity: &Quantity| {
            let range = start..start + quantity.len(code.sizes);
            start = range.end;
            let mut worst = Worst {
                function,
                scalar,
                quantity,
                vector: 0.0,
                entry: 0.0,
                condition: 1.0,
                state: states.first().cloned().unwrap_or_default(),
                overflows: false,
            };
            let truths = samples.truths.iter().zip(&results);
            let runs = states.iter().zip(&samples.granted).zip(truths);
            for ((state, granted), (truth, result)) in runs {
                worst.overflows |= result[range.clone()].iter().any(|x| !x.is_finite());
                let condition = granted.factor(quantity);
                let unit = condition * scalar.unit_roundoff();
                let errors = self.errors(code, range.clone(), truth, result, &samples.sizes);
                let [vector, entry] = errors.map(|error| relative(error, unit));
                worst.entry = worst.entry.max(entry);
                if vector > worst.vector {
                    (worst.vector, worst.condition) = (vector, condition);
                    worst.state = state.clone();
                }
            }
            worst
        };
        function.quantities().iter().map(worst).collect()
    }

    fn errors(
        &self,
        code: &Code<'_>,
        range: Range<usize>,
        truth: &[TrueValue],
        result: &[f64],
        sizes: &[f64],
    ) -> [f64; 2] {
        let least = match code.scalar {
            ScalarType::F64 => f64::from_bits(1),
            ScalarType::F32 => f64::from(f32::from_bits(1)),
        };
        let largest = sizes[range.clone()].iter().copied().fold(0.0, f64::max);
        let (mut error, mut size, mut entry) = (0.0f64, LEAST_PART * largest, 0.0f64);
        for i in range {
            let off = match code.vanishing[i] {
                true => result[i].abs(),
                false => (truth[i].error(result[i]) - self.underflow * least).max(0.0),
            };
            // Gravity does not reach a vertical axis: what is computed there is dust.
            let scale = match sizes[i] > DUST * largest {
                true => sizes[i],
                false => largest,
            };
            entry = entry.max(relative(off, scale));
            (error, size) = (error.max(off), size.max(truth[i].size()));
        }
        [relative(error, size), entry]
    }
}

/// Returns error / size: zero of nothing, infinite of what is no number.
fn relative(error: f64, size: f64) -> f64 {
    match error / size {
        _ if error == 0.0 => 0.0,
        part if part.is_nan() => f64::INFINITY,
        part => part,
    }
}
