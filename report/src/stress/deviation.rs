//! Errors in units of u.

use dalembert_model::number::Rounded;
use dalembert_model::robot::Robot;

use dalembert_codegen::ScalarType;
use dalembert_codegen::workspace::TrueValue;

/// The error of a vector of joint torques, or of any other result.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Deviation {
    /// max_i |error_i| / max_i |truth_i|, in u.
    pub normwise: f64,
    /// max_i |error_i| / T_i, in u.
    pub per_joint: f64,
    /// The joint (zero-based) where that is.
    pub joint: usize,
}

/// The measure of results.
#[derive(Clone, Debug)]
pub struct Measure {
    /// The unit.
    pub scalar: ScalarType,
    /// T_i: empty if there are none.
    pub scales: Vec<f64>,
    /// The largest absolute error that underflow may add.
    pub underflow: f64,
}

impl Measure {
    /// Begins a measurement for the torques of a robot.
    ///
    /// A product that underflows is off by half the least subnormal, whatever
    /// its size; the robot's parameters then multiply that. A function has
    /// some thousand products.
    pub fn new(robot: &Robot, scalar: ScalarType, scales: Vec<f64>) -> Measure {
        let sizes = robot
            .joints
            .iter()
            .flat_map(|joint| [&joint.mass, &joint.a, &joint.d]);
        let largest = sizes
            .map(f64::nearest_rational)
            .fold(1.0, |most, x| x.abs().max(most));
        let least = match scalar {
            ScalarType::F64 => f64::from_bits(1),
            ScalarType::F32 => f64::from(f32::from_bits(1)),
        };
        Measure {
            scalar,
            scales,
            underflow: 4096.0 * largest * least,
        }
    }

    /// Returns the error of each entry; infinite if it is not finite.
    fn errors(&self, found: &[f64], truth: &[TrueValue]) -> Vec<f64> {
        let pairs = found.iter().zip(truth);
        let error = |(found, truth): (&f64, &TrueValue)| truth.error(*found) - self.underflow;
        pairs.map(|pair| error(pair).max(0.0)).collect()
    }

    /// Returns the largest error of a result against a size, in u.
    pub fn against(&self, found: &[f64], truth: &[TrueValue], size: f64) -> f64 {
        let errors = self.errors(found, truth).into_iter();
        ratio(errors.fold(0.0, f64::max), size) / self.scalar.unit_roundoff()
    }

    /// Returns the error of a result; infinite if it is not finite.
    pub fn of(&self, found: &[f64], truth: &[TrueValue]) -> Deviation {
        let u = self.scalar.unit_roundoff();
        let errors = self.errors(found, truth);
        let most = errors.iter().copied().fold(0.0, f64::max);
        let size = truth.iter().map(|x| x.magnitude()).fold(0.0, f64::max);
        let mut deviation = Deviation {
            normwise: ratio(most, size) / u,
            ..Deviation::default()
        };
        for (joint, (error, scale)) in errors.iter().zip(&self.scales).enumerate() {
            let error = ratio(*error, *scale) / u;
            if error > deviation.per_joint {
                deviation.per_joint = error;
                deviation.joint = joint;
            }
        }
        deviation
    }
}

/// Returns error / size; nothing of nothing is nothing.
fn ratio(error: f64, size: f64) -> f64 {
    if error == 0.0 { 0.0 } else { error / size }
}
