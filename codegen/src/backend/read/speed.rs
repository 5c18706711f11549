//! The lines that compute what Coulomb friction reads of speeds.

use crate::program::text::input_name;
use crate::program::{Input, Literal, ScalarType, Speed};

use super::error::SpeedFault;
use super::index_of;

/// What `let r2 = 1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001);` says, from its name
/// and its value; the joints of lines `before` come before it.
pub(super) fn read(
    name: &str,
    value: &str,
    scalar: ScalarType,
    before: &[Speed<Literal>],
) -> Result<Speed<Literal>, SpeedFault> {
    let wrong = || SpeedFault::Value(value.to_owned());
    let call = value.strip_prefix("1.0 / ").ok_or_else(wrong)?;
    let (path, argument) = call.split_once('(').ok_or_else(wrong)?;
    let call = path.rsplit("::").next().unwrap_or_default();
    if call.strip_suffix(scalar.math_suffix()) != Some("sqrt") {
        return Err(SpeedFault::Call(path.to_owned()));
    }
    let argument = argument.strip_suffix(')').ok_or_else(wrong)?;
    let mut words = argument.split(' ');
    let words = std::array::from_fn(|_| words.next().unwrap_or_default());
    let [left, "*", right, "+", square] = words else {
        return Err(wrong());
    };
    let joint = index_of(left, "qd").filter(|_| left == right);
    let joint = joint.ok_or_else(wrong)?;
    if name != input_name(Input::PerSpeed(joint)) {
        let name = name.to_owned();
        return Err(SpeedFault::Name { name, joint });
    }
    if before.last().is_some_and(|last| last.joint >= joint) {
        return Err(SpeedFault::Order(name.to_owned()));
    }
    let literal = square.contains(['.', 'e']).then(|| scalar.parse(square));
    let square = literal.flatten().map(Literal).ok_or_else(wrong)?;
    // Nothing may follow the literal.
    match argument.split(' ').count() {
        5 => Ok(Speed { joint, square }),
        _ => Err(wrong()),
    }
}
