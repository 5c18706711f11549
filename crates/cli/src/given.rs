//! States from elsewhere (a simulator, another library, a measurement) compared with generated code:
//! JSON with a list `states` of objects with `q`, the rates `qd` and `qdd` where they matter, and
//! any result by its key, such as `tau`, `D`, `h` or `c`.

use std::collections::{BTreeMap, BTreeSet};

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{Argument, JointState, Quantity, RunnableCode, Runtime, Sizes};
use dalembert_model::diagnostic::closest;
use dalembert_model::number::Rounded;
use dalembert_model::outputs::Shape;
use dalembert_model::robot::Robot;
use serde::Deserialize;

use crate::output::Done;
use crate::report::{Cell, Table, cells, counted};
use crate::terminal::printable;

/// The largest disagreement that counts as agreement: the largest error of an
/// entry at a state, relative to the largest entry given at that state.
pub const BOUND: f64 = 1e-12;

/// An error of every value below this is one of digits, not of units or signs.
const FEW_DIGITS: f64 = 1e-4;

const MOST: usize = 10;
const TORQUE: &str = "torque";
const GRAVITY: &str = "g";
/// The condition of D, by which the source of a state judged the results that need D⁻¹.
const REMARK: &str = "condition";

/// A state with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenState {
    /// The state; rates that no given quantity needs are zero.
    pub state: JointState,
    /// τ, D (row by row), h and c, as far as they are known.
    pub known: BTreeMap<Quantity, Vec<f64>>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object with a list `states`")]
struct File {
    states: Vec<BTreeMap<String, Numbers>>,
}

/// A number, a list of numbers, or a matrix as rows or row by row.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number or a list of numbers")]
enum Numbers {
    One(f64),
    List(Vec<Numbers>),
}

impl Numbers {
    fn flat(&self) -> Vec<f64> {
        match self {
            Numbers::One(number) => vec![*number],
            Numbers::List(list) => list.iter().flat_map(Numbers::flat).collect(),
        }
    }
}

/// Reads the states of a robot. Where its base floats, gravity in the base's axes is `g`, the robot
/// file's unless a state gives it.
///
/// # Errors
/// The text is not JSON with a list of states, or everything that is wrong with the states.
pub fn read(text: &str, robot: &Robot) -> Result<Vec<GivenState>, String> {
    let file: File = serde_json::from_str(text).map_err(|error| {
        format!(
            "{error}\n  = help: a file of states is {{\"states\": [{{\"q\": […], \"qd\": […], \"qdd\": […], \
             \"tau\": […]}}, …]}}, with numbers and lists of numbers alone"
        )
    })?;
    let mut mistakes = Vec::new();
    let mut states = Vec::new();
    for (at, keys) in (1..).zip(&file.states) {
        let (state, wrong) = state(keys, robot);
        states.push(state);
        mistakes.extend(wrong.iter().map(|why| format!("state {at}: {why}")));
    }
    let more = mistakes.len().saturating_sub(MOST);
    mistakes.truncate(MOST);
    if more > 0 {
        mistakes.push(format!("and {more} more mistakes"));
    }
    if states.is_empty() {
        mistakes.push("the list `states` is empty".into());
    }
    match mistakes.is_empty() {
        true => Ok(states),
        false => Err(mistakes.join("\n")),
    }
}

fn state(keys: &BTreeMap<String, Numbers>, robot: &Robot) -> (GivenState, Vec<String>) {
    let mut wrong = Vec::new();
    let sizes = Sizes::of(robot);
    let mut values = |key: &str, length: usize| -> Option<Vec<f64>> {
        let values = keys.get(key)?.flat();
        if values.len() != length {
            let count = values.len();
            wrong.push(format!("`{key}` has {count} numbers, not {length}"));
        }
        Some(values)
    };
    let state = JointState::new(|argument| {
        let length = argument.length(sizes);
        if argument == Argument::Gravity && robot.floating.is_some() {
            let gravity = robot.gravity.each_ref().map(f64::nearest_rational);
            return values(GRAVITY, length).unwrap_or_else(|| gravity.to_vec());
        }
        let entries = argument.given().and_then(|key| values(key, length));
        let is_motion = Argument::JOINTS[..3].contains(&argument);
        entries.unwrap_or_else(|| vec![0.0; if is_motion { length } else { 0 }])
    });
    let mut known = BTreeMap::new();
    let quantities = results().chain(keys.keys().filter_map(|key| at_frame(key)));
    for (key, quantity) in quantities {
        known.extend(values(key, quantity.len(sizes)).map(|values| (quantity, values)));
    }
    if !keys.contains_key("q") {
        wrong.push("`q` is missing".into());
    }
    for (quantity, key) in known.keys().filter_map(|q| Some((q, q.facts().given?))) {
        let arguments = quantity.arguments().iter();
        let needed = arguments.filter_map(|argument| argument.given());
        for missing in needed.filter(|need| *need != "q" && !keys.contains_key(*need)) {
            wrong.push(format!("`{missing}` is missing, which `{key}` depends on"));
        }
    }
    let mut read = known.keys().flat_map(|quantity| quantity.arguments());
    if keys.contains_key(TORQUE) && !read.any(|argument| *argument == Argument::Torque) {
        wrong.push(format!(
            "`{TORQUE}` is what `forward_dynamics` reads, and the state does not give that\n  \
             = help: torques that q, qd and qdd give are `tau`"
        ));
    }
    let arguments = Argument::ALL.into_iter().filter_map(Argument::given);
    let words: Vec<&str> = arguments.chain(results().map(|(key, _)| key)).collect();
    for key in keys.keys() {
        let is_gravity = key == GRAVITY && robot.floating.is_some();
        if words.contains(&key.as_str()) || key == REMARK || is_gravity || at_frame(key).is_some() {
            continue;
        }
        let shown: String = key.chars().take(40).map(printable).collect();
        let meant = closest(key, &words)
            .map_or_else(String::new, |word| format!("did you mean `{word}`? "));
        wrong.push(format!(
            "`{shown}` is not a state key\n  = help: {meant}a state has `q`, `qd`, `qdd` and any of {}",
            results().map(|(key, _)| format!("`{key}`")).collect::<Vec<_>>().join(", ")
        ));
    }
    (GivenState { state, known }, wrong)
}

fn results() -> impl Iterator<Item = (&'static str, Quantity)> {
    let quantities = Quantity::ALL.iter();
    quantities.filter_map(|&quantity| Some((quantity.facts().given?, quantity)))
}

/// Returns the quantity of a key with a frame: `jacobian@camera:local`.
fn at_frame(key: &str) -> Option<(&'static str, Quantity)> {
    let (name, view) = key.split_once('@')?;
    let (_, quantity) = results().find(|(word, _)| *word == name)?;
    let function = Function::parse(&format!("{}@{view}", quantity.function())).ok()?;
    let quantity = *function.quantities().first()?;
    let full_key = quantity.facts().given.filter(|word| *word == key)?;
    Some((full_key, quantity))
}

/// One quantity of one function, compared at every state that gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The function that was run.
    pub function: Function,
    /// The quantity as it is given: h where the function returns its symbols.
    pub quantity: Quantity,
    /// Number of states that give it.
    pub states: usize,
    /// At how many of them it is further off than [`BOUND`].
    pub disagreeing: usize,
    /// The largest error, relative to the largest entry given at that state, over the condition of D
    /// there where the quantity inverts it.
    pub error: f64,
    /// That error in words: the state, the entry, and both values.
    pub worst: String,
}

/// Returns the quantities to compare with given states: of h_ikm, the load h that they give.
pub fn quantities(function: Function) -> impl Iterator<Item = Quantity> {
    let quantities = function.quantities().iter();
    quantities.map(|quantity| quantity.as_given(&[], &[]).0)
}

/// Runs the code of a runtime's robot at every state; sines are libm's.
pub fn compare(
    emitted: &RunnableCode,
    runtime: &Runtime,
    robot: &Robot,
    states: &[GivenState],
) -> Vec<Comparison> {
    let code = emitted.with_libm();
    let function = emitted.function;
    let sizes = Sizes::of(robot);
    let mut comparisons: BTreeMap<Quantity, Comparison> = BTreeMap::new();
    for (index, state) in states.iter().enumerate() {
        // A state need not have what only some functions read.
        let mut arguments = function.arguments().into_iter();
        if arguments.any(|argument| state.state.entries(argument).len() != argument.length(sizes)) {
            continue;
        }
        let results = code.run(&state.state);
        let granted = runtime.granted(function, &state.state);
        let mut start = 0;
        for &returned in function.quantities() {
            let values = &results[start..start + returned.len(emitted.sizes)];
            start += returned.len(emitted.sizes);
            let (quantity, values) = returned.as_given(values, &state.state.qd);
            let Some(known) = state.known.get(&quantity) else {
                continue;
            };
            let (entry, error) = worst(&values, known);
            let error = error / granted.factor(returned);
            let compared = comparisons.entry(quantity).or_insert_with(|| Comparison {
                function,
                quantity,
                states: 0,
                disagreeing: 0,
                error: -1.0,
                worst: String::new(),
            });
            compared.states += 1;
            compared.disagreeing += usize::from(error > BOUND);
            if error > compared.error {
                compared.error = error;
                compared.worst = format!(
                    "{} at state {}, {}: the file has {:e}, the robot gives {:e}",
                    quantity.symbol(),
                    index + 1,
                    place(quantity, entry, robot),
                    known[entry],
                    values[entry]
                );
            }
        }
    }
    comparisons.into_values().collect()
}

fn place(quantity: Quantity, entry: usize, robot: &Robot) -> String {
    let n = robot.coordinates().max(1);
    match quantity.shape() {
        Shape::SCALAR => "its value".to_owned(),
        Shape::VECTOR => robot.coordinate_label(entry),
        Shape::MATRIX => {
            let [row, column] = [entry / n, entry % n].map(|k| robot.coordinate_label(k));
            format!("row of {row}, column of {column}")
        }
        _ => quantity.entry(entry, &Vec::from_iter(0..n), Sizes::of(robot)),
    }
}

/// Relative to the largest expected entry; absolute if all vanish, infinite for a NaN.
fn worst(actual: &[f64], expected: &[f64]) -> (usize, f64) {
    let size = expected.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let size = if size > 0.0 { size } else { 1.0 };
    let mut worst = (0, 0.0f64);
    for (index, (a, b)) in actual.iter().zip(expected).enumerate() {
        let error = (a - b).abs() / size;
        if error.is_nan() {
            return (index, f64::INFINITY);
        }
        if error > worst.1 {
            worst = (index, error);
        }
    }
    worst
}

pub(crate) fn describe(
    file: &str,
    states: &[GivenState],
    compared: &[Comparison],
    done: &mut Done,
) {
    let heads = "function|result|states|error|bound|.disagreeing|.worst|verdict=";
    let mut table = Table::new(heads);
    for comparison in compared {
        let quantity = comparison.quantity;
        let agrees = comparison.disagreeing == 0;
        let verdict = if agrees { "ok" } else { "DISAGREES" };
        table.row(cells![
            comparison.function.to_string(),
            quantity.facts().given.unwrap_or_else(|| quantity.symbol()),
            comparison.states,
            Cell::power(comparison.error, 1),
            Cell::power(BOUND, 1),
            comparison.disagreeing,
            comparison.worst.as_str(),
            verdict,
        ]);
    }
    let count = counted(states.len(), "state");
    let title = format!("{count} of {file}, in f64");
    done.report.table("given", title, table);
    let known = states.iter().flat_map(|state| state.known.keys().copied());
    let mut missed: BTreeSet<Quantity> = known.collect();
    for comparison in compared {
        missed.remove(&comparison.quantity);
    }
    let keys = missed.iter().filter_map(|quantity| quantity.facts().given);
    let missed = Vec::from_iter(keys).join(", ");
    if !missed.is_empty() {
        let why = "not compared, since no function of --outputs returns it";
        done.report.line(format!("{why}: {missed}"));
    }
    let mut wrong: Vec<&Comparison> = compared.iter().collect();
    wrong.retain(|comparison| comparison.disagreeing > 0);
    // Several functions return the same quantity: it is named once.
    wrong.sort_by_key(|comparison| comparison.quantity);
    wrong.dedup_by_key(|comparison| comparison.quantity);
    if wrong.is_empty() {
        return;
    }
    let mut text = format!("error: {file}: the robot disagrees with the states");
    for comparison in wrong {
        let (worst, off, total) = (&comparison.worst, comparison.disagreeing, comparison.states);
        text += &format!("\n  {worst}; {off} of {total} states disagree");
    }
    let errors = compared.iter().map(|comparison| comparison.error);
    let worst = errors.fold(0.0, f64::max);
    done.failed.push(match worst < FEW_DIGITS {
        true => format!(
            "{text}\n  = help: all values agree to {:.1} digits: were they written with fewer than 17, \
             or with another value of a parameter?",
            -worst.log10()
        ),
        false => format!(
            "{text}\n  = help: the usual causes are units (degrees, mm, g), signs and axes of gravity, the DH \
             convention, inertia about the origin instead of the centre of mass, products of inertia, axes \
             and zeros of single joints, damping and armature; compare `c` at q = 0 first, then `D`, then `h`"
        ),
    });
}
