//! The results of generated code beside the given ones.

use std::collections::BTreeMap;

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{Emitted, Quantity, Runtime, Sizes};
use dalembert_model::outputs::Shape;
use dalembert_model::robot::Robot;

use super::{BOUND, GivenState, worst};

/// One quantity of one function, compared at every state that gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The function that was run.
    pub function: Function,
    /// The quantity as it is given: h where the function returns its symbols.
    pub quantity: Quantity,
    /// Number of states that give it.
    pub states: usize,
    /// At how many of them it is further off than [`BOUND`].
    pub disagreeing: usize,
    /// Where it is furthest off.
    pub worst: Difference,
}

/// One entry that was compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Which state, zero-based.
    pub state: usize,
    /// Which entry, zero-based; of a matrix row by row.
    pub entry: usize,
    /// The value that the states give.
    pub given: f64,
    /// The value that the code returns.
    pub found: f64,
    /// The error relative to the largest entry given at that state, over the
    /// condition of D there where the quantity inverts it.
    pub error: f64,
}

impl Compared {
    /// Returns whether every state agrees.
    pub fn agrees(&self) -> bool {
        self.disagreeing == 0
    }

    /// Returns the entry that is furthest off, in words.
    pub fn describe(&self, robot: &Robot) -> String {
        let Difference {
            state,
            entry,
            given,
            found,
            ..
        } = self.worst;
        let n = robot.joints.len().max(1);
        let place = match self.quantity.shape() {
            Shape::SCALAR => "its value".to_owned(),
            Shape::VECTOR => robot.joint_label(entry),
            Shape::MATRIX => format!(
                "row of {}, column of {}",
                robot.joint_label(entry / n),
                robot.joint_label(entry % n)
            ),
            _ => self.quantity.entry(entry, Sizes::whole(n)),
        };
        format!(
            "{} at state {}, {place}: the file has {given:e}, the robot gives {found:e}",
            self.quantity.symbol(),
            state + 1
        )
    }
}

/// Returns the quantities that can be compared with given states, from what a function
/// returns: the symbols h_ikm are compared as the load h that they give.
pub fn quantities(function: Function) -> impl Iterator<Item = Quantity> {
    let all = function.quantities().iter();
    all.map(|quantity| quantity.as_given(&[], &[]).0)
}

/// Runs the code of a runtime's robot at every state; sines are libm's.
pub fn compare(emitted: &Emitted, runtime: &Runtime, states: &[GivenState]) -> Vec<Compared> {
    let own = emitted.with_libm();
    let function = emitted.function;
    let mut all: BTreeMap<Quantity, Compared> = BTreeMap::new();
    for (index, given) in states.iter().enumerate() {
        let n = given.state.q.len();
        // A state need not have what only some functions read.
        let mut arguments = function.arguments().into_iter();
        let sizes = Sizes::whole(n);
        if arguments.any(|argument| given.state.of(argument).len() != argument.length(sizes)) {
            continue;
        }
        let results = own.run(&given.state);
        let granted = runtime.granted(function, &given.state);
        let mut start = 0;
        for &returned in function.quantities() {
            let values = &results[start..start + returned.len(emitted.sizes)];
            start += returned.len(emitted.sizes);
            let (quantity, values) = returned.as_given(values, &given.state.qd);
            let Some(known) = given.known.get(&quantity) else {
                continue;
            };
            let (entry, error) = worst(&values, known);
            let error = error / granted.to(returned);
            let found = Difference {
                state: index,
                entry,
                given: known[entry],
                found: values[entry],
                error,
            };
            let compared = all.entry(quantity).or_insert(Compared {
                function,
                quantity,
                states: 0,
                disagreeing: 0,
                worst: found,
            });
            compared.states += 1;
            compared.disagreeing += usize::from(error > BOUND);
            if error > compared.worst.error {
                compared.worst = found;
            }
        }
    }
    all.into_values().collect()
}
