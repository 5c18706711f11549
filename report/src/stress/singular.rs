//! Functions that divide, where D is nearest to singular.
//!
//! What solves D q̈ = … loses as many digits as the condition of D has, whatever
//! the code: an error says something about the code in units of u × condition
//! alone. The condition is that of D with a unit diagonal
//! ([`Condition::scaled`]): what units and sizes of the joints make of it costs
//! no digits. The state box is searched for its largest value, and errors are
//! measured there and at states all over the box.

use std::fmt;
use std::ops::Range;

use dalembert_codegen::workspace::{
    Argument, Condition, JointState, LEAST_PART, Quantity, Reference as Truth, SceneRobot, Sizes,
    TrueValue, positions, seeded,
};
use dalembert_codegen::{Function, GenerateError, ScalarType};
use dalembert_model::reference::Reference;
use dalembert_model::robot::Robot;
use nalgebra::DVector;

use super::category::NORMWISE;
use super::deviation::Measure;
use super::report::{Options, RangeFault, Verdict};
use super::subject::{Code, Subject};

/// Positions drawn before the best of them are improved.
const DRAWN: usize = 1000;

/// Number of them that are improved.
const IMPROVED: usize = 8;

/// Steps are halved so often: the last are far below what a condition changes over.
const HALVINGS: usize = 20;

/// Positions where D is nearest to singular, as far as a search found.
#[derive(Clone, Debug)]
pub struct Nearest {
    /// q
    pub q: Vec<f64>,
    /// The condition of D there, each entry the nearest double.
    pub condition: Condition,
}

/// One function of one code.
#[derive(Clone, Debug)]
pub struct Row {
    /// Which function.
    pub function: Function,
    /// The scalar.
    pub scalar: ScalarType,
    /// Which code.
    pub subject: Subject,
    /// The worst error of any of its quantities, normwise, in u × condition.
    pub error: f64,
    /// That error in u.
    pub normwise: f64,
    /// Where it is.
    pub state: JointState,
    /// The condition of D there.
    pub condition: Condition,
    /// Pass or fail.
    pub verdict: Verdict,
    /// Why a verdict is [`Verdict::OutOfRange`].
    pub reason: Option<RangeFault>,
}

/// The measurements of a robot.
#[derive(Clone, Debug)]
pub struct Divided {
    /// Where D is nearest to singular.
    pub nearest: Nearest,
    /// A function, a scalar and a code each; none if there is a reason.
    pub rows: Vec<Row>,
    /// Why nothing that divides is generated for the robot: D has no inverse in any
    /// state.
    pub refused: Option<GenerateError>,
}

/// Returns the functions of one quantity or several that invert D, and nothing else: what is damped
/// inverts other matrices, which are near singular at other states.
pub fn functions() -> Vec<Function> {
    let inverts = |function: &Function| {
        let arguments = function.arguments();
        function.inverts_inertia() && !arguments.contains(&Argument::Damping)
    };
    Function::ALL.into_iter().filter(inverts).collect()
}

/// Measures every function that divides.
///
/// # Errors
/// Those of generating the code that is run.
pub fn run(robot: &Robot, options: &Options) -> Result<Divided, GenerateError> {
    let truth = Truth::new(&SceneRobot::whole(robot));
    let nearest = nearest(robot, &truth);
    let mut divided = Divided {
        nearest,
        rows: Vec::new(),
        refused: None,
    };
    let states = states(robot, &divided.nearest, options);
    for scalar in ScalarType::ALL {
        let emitted = match Code::emitted(robot, &options.request, &functions(), scalar) {
            Err(error @ GenerateError::Singular { .. }) => {
                divided.refused = Some(error);
                return Ok(divided);
            }
            emitted => emitted?,
        };
        let codes = [Ok(Code::runtime(robot, scalar)), emitted];
        let cases = Cases::new(robot, &truth, &states, scalar);
        for function in functions() {
            let truths = cases.truths(function);
            for (subject, code) in Subject::ALL.into_iter().zip(&codes) {
                divided
                    .rows
                    .push(cases.row(function, subject, code, &truths));
            }
        }
    }
    Ok(divided)
}

/// States of the box, and as many with the positions where D is nearest to singular.
fn states(robot: &Robot, nearest: &Nearest, options: &Options) -> Vec<JointState> {
    let mut states = seeded(robot, 2 * options.states, options.seed);
    for state in states.iter_mut().skip(options.states) {
        state.q.clone_from(&nearest.q);
    }
    states
}

/// Searches the box of positions for the largest condition: the best of many draws,
/// each improved joint by joint with steps that halve.
fn nearest(robot: &Robot, truth: &Truth) -> Nearest {
    let runtime = Reference::<f64>::from_robot(robot);
    let price = |q: &[f64]| {
        // The lengths are the robot's.
        let d = runtime.inertia(&DVector::from_column_slice(q));
        let d = d.map_or_else(|_| Vec::new(), |d| d.iter().copied().collect());
        Condition::of(&d, ScalarType::F64.unit_roundoff()).scaled
    };
    let bounds = positions(robot);
    let drawn = seeded(robot, DRAWN, SEED).into_iter();
    let mut drawn: Vec<(f64, Vec<f64>)> = drawn.map(|s| (price(&s.q), s.q)).collect();
    drawn.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    drawn.truncate(IMPROVED);
    for (best, q) in &mut drawn {
        for halving in 2..2 + HALVINGS {
            for (joint, [low, high]) in bounds.iter().enumerate() {
                let step = (high - low) / f64::from(1u32 << halving.min(31));
                for step in [step, -step] {
                    let before = q[joint];
                    q[joint] = (before + step).clamp(*low, *high);
                    match price(q) {
                        more if more > *best => *best = more,
                        _ => q[joint] = before,
                    }
                }
            }
        }
    }
    let best = drawn
        .into_iter()
        .reduce(|a, b| if b.0 > a.0 { b } else { a });
    let q = best.map_or_else(Vec::new, |(_, q)| q);
    let condition = condition(truth, &q, ScalarType::F64);
    Nearest { q, condition }
}

/// The seed of the positions that a search begins with.
const SEED: u64 = 0xd1f1;

fn condition(truth: &Truth, q: &[f64], scalar: ScalarType) -> Condition {
    let state = JointState::new(|argument| match argument {
        Argument::Position => q.to_vec(),
        _ => vec![0.0; q.len()],
    });
    let d = truth.run(Function::Inertia, &state);
    let d: Vec<f64> = d.iter().map(TrueValue::to_f64).collect();
    Condition::of(&d, scalar.unit_roundoff())
}

/// The states of a scalar.
struct Cases<'a> {
    truth: &'a Truth,
    measure: Measure,
    sizes: Sizes,
    states: Vec<(JointState, Condition)>,
}

impl<'a> Cases<'a> {
    fn new(robot: &Robot, truth: &'a Truth, states: &[JointState], scalar: ScalarType) -> Self {
        let states = states.iter().map(|state| {
            let state = state.in_scalar(scalar);
            let condition = condition(truth, &state.q, scalar);
            (state, condition)
        });
        Cases {
            truth,
            measure: Measure::new(robot, scalar, Vec::new()),
            sizes: Sizes::whole(robot.joints.len()),
            states: states.collect(),
        }
    }

    fn truths(&self, function: Function) -> Vec<Option<Vec<TrueValue>>> {
        let states = self.states.iter();
        let truth = |state: &JointState| self.truth.run(function, state);
        states
            .map(|(state, _)| state.is_finite().then(|| truth(state)))
            .collect()
    }

    fn row(
        &self,
        function: Function,
        subject: Subject,
        code: &Result<Code, GenerateError>,
        truths: &[Option<Vec<TrueValue>>],
    ) -> Row {
        let scalar = self.measure.scalar;
        let mut row = Row {
            function,
            scalar,
            subject,
            error: -1.0,
            normwise: 0.0,
            state: JointState::default(),
            condition: Condition::of(&[], scalar.unit_roundoff()),
            verdict: Verdict::Pass,
            reason: None,
        };
        let code = match code {
            Ok(code) => code,
            Err(error) => {
                row.verdict = Verdict::OutOfRange;
                row.reason = Some(RangeFault::Constant(error.clone()));
                return row;
            }
        };
        let least = self.least(function, truths);
        for ((state, condition), truth) in self.states.iter().zip(truths) {
            let (Some(found), Some(truth)) = (code.run(function, state), truth) else {
                continue;
            };
            if found.iter().any(|x| !x.is_finite()) {
                row.verdict = Verdict::OutOfRange;
                row.reason = Some(RangeFault::Result(scalar));
            }
            let normwise = self.normwise(function, &found, truth, &least);
            let error = normwise / condition.scaled.max(1.0);
            if error > row.error || error.is_nan() {
                row.error = if error.is_nan() { f64::INFINITY } else { error };
                row.normwise = normwise;
                row.state = state.clone();
                row.condition = *condition;
            }
        }
        if row.verdict == Verdict::Pass && row.error > NORMWISE {
            row.verdict = Verdict::Fail;
        }
        row
    }

    /// Returns the part of a function's results that each quantity has.
    fn parts(&self, function: Function) -> Vec<Range<usize>> {
        let mut start = 0;
        let quantities = function.quantities().iter();
        let part = |quantity: &Quantity| {
            let range = start..start + quantity.len(self.sizes);
            start = range.end;
            range
        };
        quantities.map(part).collect()
    }

    /// Returns what an error of each quantity is relative to at least: ∂q̈/∂q̇ of an arm that is
    /// stretched out all but vanishes, and what is left of it says nothing about the code.
    fn least(&self, function: Function, truths: &[Option<Vec<TrueValue>>]) -> Vec<f64> {
        let most = |range: Range<usize>| {
            let parts = truths.iter().flatten();
            let parts = parts.filter_map(|truth| truth.get(range.clone()));
            LEAST_PART * parts.map(largest).fold(0.0, f64::max)
        };
        self.parts(function).into_iter().map(most).collect()
    }

    /// Returns the worst of a function's quantities, in u.
    fn normwise(
        &self,
        function: Function,
        found: &[f64],
        truth: &[TrueValue],
        least: &[f64],
    ) -> f64 {
        let mut worst = 0.0f64;
        for (range, least) in self.parts(function).into_iter().zip(least) {
            let parts = (found.get(range.clone()), truth.get(range));
            let (Some(found), Some(truth)) = parts else {
                return f64::INFINITY;
            };
            let size = largest(truth).max(*least);
            worst = worst.max(self.measure.against(found, truth, size));
        }
        worst
    }
}

fn largest(values: &[TrueValue]) -> f64 {
    let sizes = values.iter().map(|x| x.magnitude());
    sizes.fold(0.0, f64::max)
}

impl fmt::Display for Nearest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Condition { raw, scaled, .. } = self.condition;
        write!(f, "cond D {raw:.1e}, {scaled:.1e} with a unit diagonal")
    }
}
