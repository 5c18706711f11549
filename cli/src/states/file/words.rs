//! The keys of states, and what others call them.

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{Argument, Quantity};
use dalembert_model::read::closest;

/// Returns the keys of quantities, in the order of the list of outputs.
pub(super) fn given() -> impl Iterator<Item = (&'static str, Quantity)> {
    let all = Quantity::ALL.iter();
    all.filter_map(|&quantity| Some((quantity.given()?, quantity)))
}

/// Returns the quantity of a key with a frame: `jacobian@camera:local`.
pub(super) fn at_frame(key: &str) -> Option<(&'static str, Quantity)> {
    let (name, view) = key.split_once('@')?;
    let (_, quantity) = given().find(|(own, _)| *own == name)?;
    let function = Function::parse(&format!("{}@{view}", quantity.function())).ok()?;
    let quantity = *function.quantities().first()?;
    let own = quantity.given().filter(|own| *own == key)?;
    Some((own, quantity))
}

/// Returns every key of a state.
pub(super) fn keys() -> Vec<&'static str> {
    let joints = Argument::ALL.into_iter().filter_map(Argument::given);
    joints.chain(given().map(|(key, _)| key)).collect()
}

/// Returns the results that a state may have, as a message lists them.
pub(super) fn results() -> String {
    let keys: Vec<String> = given().map(|(key, _)| format!("`{key}`")).collect();
    keys.join(", ")
}

/// The torques that drive an arm, unlike those that a motion takes.
pub(super) const TORQUE: &str = "torque";

/// The names of other libraries for the same thing.
const OTHER_WORDS: [(&str, &str); 33] = [
    ("torques", "tau"),
    ("effort", "tau"),
    ("efforts", "tau"),
    ("force", "tau"),
    ("forces", "tau"),
    ("u", "tau"),
    ("m", "D"),
    ("mass_matrix", "D"),
    ("inertia", "D"),
    ("inertia_matrix", "D"),
    ("coriolis", "h"),
    ("bias", "h"),
    ("gravity", "c"),
    ("gravity_load", "c"),
    ("g", "c"),
    ("position", "q"),
    ("positions", "q"),
    ("angles", "q"),
    ("theta", "q"),
    ("velocity", "qd"),
    ("velocities", "qd"),
    ("dq", "qd"),
    ("q_dot", "qd"),
    ("qdot", "qd"),
    ("v", "qd"),
    ("acceleration", "qdd"),
    ("accelerations", "qdd"),
    ("ddq", "qdd"),
    ("q_ddot", "qdd"),
    ("qddot", "qdd"),
    ("a", "qdd"),
    ("state", "states"),
    ("samples", "states"),
];

/// Returns the key that was probably meant.
pub(super) fn likely<'k>(word: &str, keys: &[&'k str]) -> Option<&'k str> {
    let small = word.to_ascii_lowercase();
    let same = keys.iter().find(|key| key.eq_ignore_ascii_case(&small));
    let other = OTHER_WORDS.iter().find(|(other, _)| *other == small);
    let other = other.and_then(|(_, meant)| keys.iter().find(|key| *key == meant));
    same.or(other).copied().or_else(|| closest(word, keys))
}
