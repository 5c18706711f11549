//! More ways to call a function, for those who ask for them: with sines that the
//! caller has, in lanes, in batches.
//!
//! The arithmetic of a state is printed once, in `NAME_with_sincos`; what else there is of a
//! function of states computes sines and calls it.
//!
//! - this file: [`Entries`], which of them there are
//! - [`angles`]: where each angle's sine is
//! - `single`: `NAME`, `given`: `NAME_with_sincos`
//! - `lanes`: `NAME_lanes`, several states at once
//! - `batch`: `NAME_batch` and `NAME_columns`, any number of states, and `vectors`: what these run

pub(crate) mod angles;
mod batch;
mod given;
mod lanes;
mod single;
mod vectors;

use crate::function::{Function, Sizes};
use crate::language::Printed;
use crate::words::words;
use angles::Angles;

words! {
    /// How a function can be called; each has those before it, too.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Entries: "kind of entries" {
        /// By its name: one state.
        #[default]
        Single = "single",
        /// `NAME_with_sincos`: one state, of which the caller has sines and cosines.
        WithSincos = "with_sincos",
        /// `NAME_lanes`: so many states at once as the caller says.
        Lanes = "lanes",
        /// `NAME_batch` and `NAME_columns`: slices of states, by the crate
        /// `dalembert-batch`.
        Batch = "batch",
    }
}

/// What the functions of a module have in common.
#[derive(Clone, Copy, Debug)]
pub struct Around<'a> {
    /// Where sines and roots are that are called.
    pub path: &'a str,
    /// Where `dalembert-batch` is.
    pub batch: &'a str,
    /// Where each angle's sine is.
    pub angles: &'a Angles,
}

/// Prints the function by all its entries.
pub(crate) fn write(
    printed: &Printed<'_>,
    around: &Around<'_>,
    entries: Entries,
    doc: &[String],
) -> String {
    let mut text = String::new();
    single::write(&mut text, printed, around, doc);
    text.push('\n');
    given::write(&mut text, printed, around);
    if entries >= Entries::Lanes {
        text.push('\n');
        lanes::write(&mut text, printed, around);
    }
    if entries >= Entries::Batch {
        text.push('\n');
        batch::write(&mut text, printed, around);
    }
    text
}

/// Returns the names of the arguments that there are.
fn arguments(printed: &Printed<'_>) -> Vec<&'static str> {
    let arguments = printed.arguments.iter();
    arguments.map(|argument| argument.name()).collect()
}

/// Returns the entries of a result in their order, as they are written after its name:
/// `.d[0][1]`.
pub fn places(function: Function, sizes: Sizes) -> Vec<String> {
    let mut places = Vec::new();
    for quantity in function.quantities() {
        let field = match function.structure() {
            Some(_) => format!(".{}", quantity.field()),
            None if function == Function::Load => ".0".to_owned(),
            None => String::new(),
        };
        let shape = quantity.shape();
        places.extend((0..shape.len(sizes)).map(|index| {
            let axes = shape.places(index, sizes).into_iter();
            axes.fold(field.clone(), |place, at| format!("{place}[{at}]"))
        }));
    }
    places
}
