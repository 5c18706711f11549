//! Numbers of a robot file by their names: `joint3.mass`, `elbow.com.x`, `gravity.z`.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Joint, JointKind, Robot, values};
use num_traits::{One, Zero};

/// The keys of a joint, as a message lists them.
const KEYS: &str = "mass, com.x to com.z, inertia.xx, yy, zz, xy, yz or xz, a, d, alpha, theta, offset, viscous, \
     coulomb or armature";

/// A number of a robot file.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The joint, from zero; none of gravity.
    joint: Option<usize>,
    key: String,
    /// Its value as the file has it.
    pub value: String,
}

/// What a name stands for.
enum Cell<'r> {
    Number(&'r mut Rational),
    Angle(&'r mut Angle),
}

impl Parameter {
    /// Returns the number of a name.
    ///
    /// # Errors
    /// What was expected.
    pub fn named(robot: &Robot, name: &str) -> Result<Parameter, String> {
        let (first, key) = name
            .split_once('.')
            .ok_or("expected JOINT.KEY or gravity.AXIS, such as joint3.mass")?;
        let joint = match first {
            "gravity" => None,
            _ => Some(joint(robot, first)?),
        };
        let mut parameter = Parameter {
            joint,
            key: key.to_owned(),
            value: String::new(),
        };
        let (mut other, label) = (robot.clone(), joint.map(|joint| robot.joint_label(joint)));
        let is_moved = joint.is_some_and(|joint| robot.joints[joint].frame.is_some());
        let is_scalar = ["mass", "viscous", "coulomb", "armature"].contains(&key);
        if is_moved && !is_scalar {
            let label = label.unwrap_or_default();
            return Err(format!(
                "`{key}` of {label} is given in a frame that is not that of the generated code: only mass, \
                 viscous, coulomb and armature can be traced there"
            ));
        }
        parameter.value = match parameter.cell(&mut other) {
            Some(Cell::Number(value)) => values::number(value),
            Some(Cell::Angle(value)) => values::angle(value),
            None => {
                let axes = "x, y or z".to_owned();
                let (of, known) =
                    label.map_or(("gravity".into(), axes), |label| (label, KEYS.into()));
                return Err(format!(
                    "there is no `{key}` of {of} to trace: expected {known}"
                ));
            }
        };
        Ok(parameter)
    }

    /// Returns the robot with the number larger by so many thousandths of it, or of one if it is
    /// zero. An angle has the same other value, whatever their number.
    pub fn with(&self, robot: &Robot, thousandths: i64) -> Robot {
        let mut other = robot.clone();
        match self.cell(&mut other) {
            Some(Cell::Number(value)) => {
                let whole = match value.is_zero() {
                    true => Rational::one(),
                    false => value.clone(),
                };
                *value += whole * Rational::new(thousandths.into(), 1000.into());
            }
            Some(Cell::Angle(value)) => {
                *value = Angle::Radians(Rational::new(31.into(), 97.into()));
            }
            None => {}
        }
        other
    }

    fn cell<'r>(&self, robot: &'r mut Robot) -> Option<Cell<'r>> {
        let axis = |key: &str| ["x", "y", "z"].iter().position(|axis| *axis == key);
        let Some(joint) = self.joint else {
            return Some(Cell::Number(&mut robot.gravity[axis(&self.key)?]));
        };
        let Joint {
            kind,
            alpha,
            a,
            d,
            theta,
            mass,
            com,
            inertia,
            viscous,
            coulomb,
            armature,
            ..
        } = robot.joints.get_mut(joint)?;
        Some(match (self.key.as_str(), *kind) {
            ("alpha", _) => Cell::Angle(alpha),
            ("theta", JointKind::Prismatic) | ("offset", JointKind::Revolute) => Cell::Angle(theta),
            ("d", JointKind::Revolute) | ("offset", JointKind::Prismatic) => Cell::Number(d),
            ("a", _) => Cell::Number(a),
            ("mass", _) => Cell::Number(mass),
            ("viscous", _) => Cell::Number(viscous),
            ("coulomb", _) if !coulomb.is_zero() => Cell::Number(coulomb),
            ("armature", _) => Cell::Number(armature),
            ("inertia.xx", _) => Cell::Number(&mut inertia.xx),
            ("inertia.yy", _) => Cell::Number(&mut inertia.yy),
            ("inertia.zz", _) => Cell::Number(&mut inertia.zz),
            ("inertia.xy", _) => Cell::Number(&mut inertia.xy),
            ("inertia.yz", _) => Cell::Number(&mut inertia.yz),
            ("inertia.xz", _) => Cell::Number(&mut inertia.xz),
            (key, _) => Cell::Number(&mut com[axis(key.strip_prefix("com.")?)?]),
        })
    }
}

/// Returns a joint by its name, or as `joint3`.
fn joint(robot: &Robot, word: &str) -> Result<usize, String> {
    let named = robot.joints.iter();
    let named = named
        .map(|joint| joint.name.as_deref())
        .position(|name| name == Some(word));
    let number = word
        .strip_prefix("joint")
        .and_then(|number| number.parse::<usize>().ok());
    let numbered = number.and_then(|number| number.checked_sub(1));
    let found = named.or(numbered.filter(|&joint| joint < robot.joints.len()));
    let count = robot.joints.len();
    found.ok_or_else(|| {
        format!("there is no joint `{word}`: expected joint1 to joint{count}, or a name")
    })
}
