//! Errors against the size of angles, of velocities, and the ratio of masses.

use dalembert_model::robot::Robot;

use super::deviation::Measure;
use super::report::Options;
use super::subject::{Code, Subject};
use super::{robots, states};
use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::GenerateError;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_codegen::workspace::states::{JointState, seeded};
use dalembert_codegen::workspace::verify::reference::Reference;

/// The quantity that is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The bound of |q| of revolute joints, rad.
    Angle,
    /// The factor of the velocities.
    Velocity,
    /// The last link's masses over the first's, relative to the robot's own.
    MassRatio,
}

impl Axis {
    /// Every axis.
    pub const ALL: [Axis; 3] = [Axis::Angle, Axis::Velocity, Axis::MassRatio];

    /// Returns its exponents of ten.
    fn exponents(self) -> Vec<i32> {
        match self {
            Axis::Angle => (0..=9).collect(),
            Axis::Velocity => (-3..=9).collect(),
            Axis::MassRatio => (-9..=9).step_by(3).collect(),
        }
    }
}

/// Worst normwise errors of one code along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The quantity that is varied.
    pub axis: Axis,
    /// The scalar.
    pub scalar: ScalarType,
    /// Which code.
    pub subject: Subject,
    /// (value, error in u); points that are not finite are left out.
    pub points: Vec<(f64, f64)>,
}

/// States of each point.
const STATES: usize = 20;

/// Measures the curves of every axis, scalar and code.
///
/// # Errors
/// Those of generating the code that is run.
pub fn run(robot: &Robot, options: &Options) -> Result<Vec<Curve>, GenerateError> {
    let own = Codes::new(robot, options)?;
    let mut curves = Vec::new();
    for axis in Axis::ALL {
        let first = curves.len();
        for scalar in ScalarType::ALL {
            curves.extend(Subject::ALL.map(|subject| Curve {
                axis,
                scalar,
                subject,
                points: Vec::new(),
            }));
        }
        for exponent in axis.exponents() {
            let value = 10f64.powi(exponent);
            let seed = options.seed;
            let errors = match axis {
                Axis::Angle => own.errors(&states::angles(robot, STATES, seed, value)),
                Axis::Velocity => {
                    own.errors(&states::times(robot, STATES, seed, [1.0, value, 1.0]))
                }
                Axis::MassRatio => {
                    let changed = robots::mass_ratio(robot, exponent);
                    Codes::new(&changed, options)?.errors(&seeded(&changed, STATES, seed))
                }
            };
            for (curve, error) in curves[first..].iter_mut().zip(errors) {
                if error.is_finite() {
                    curve.points.push((value, error));
                }
            }
        }
    }
    Ok(curves)
}

/// The programs of a robot, a scalar's subjects together.
struct Codes {
    robot: Robot,
    reference: Reference,
    codes: Vec<(ScalarType, Option<Code>)>,
}

impl Codes {
    fn new(robot: &Robot, options: &Options) -> Result<Codes, GenerateError> {
        let mut codes = Vec::new();
        for scalar in ScalarType::ALL {
            let functions = [Function::InverseDynamics];
            let emitted = Code::emitted(robot, &options.request, &functions, scalar)?;
            codes.push((scalar, Some(Code::runtime(robot, scalar))));
            codes.push((scalar, emitted.ok()));
        }
        Ok(Codes {
            reference: Reference::new(&SceneRobot::whole(robot)),
            robot: robot.clone(),
            codes,
        })
    }

    /// Returns the worst error of each code over states; infinite where there is none.
    fn errors(&self, states: &[JointState]) -> Vec<f64> {
        let mut worst = vec![0.0f64; self.codes.len()];
        for (index, (scalar, code)) in self.codes.iter().enumerate() {
            let measure = Measure::new(&self.robot, *scalar, Vec::new());
            for state in states {
                let state = state.in_scalar(*scalar);
                let run = Function::InverseDynamics;
                let found = code.as_ref().and_then(|code| code.run(run, &state));
                let error = match found {
                    Some(found) if state.is_finite() => {
                        measure
                            .of(&found, &self.reference.run(run, &state))
                            .normwise
                    }
                    _ => f64::INFINITY,
                };
                worst[index] = worst[index].max(if error.is_nan() { f64::INFINITY } else { error });
            }
        }
        worst
    }
}
