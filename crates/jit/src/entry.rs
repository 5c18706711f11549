//! What is kept of a loaded arm.

use dalembert_codegen::GeneratedFunction;
use dalembert_codegen::workspace::{Emitted, Sizes};
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Entry {
    pub(crate) robot: String,
    pub(crate) notes: Vec<String>,
    pub(crate) functions: Vec<Proved>,
    pub(crate) rust: Vec<String>,
    pub(crate) claim: String,
    /// With exact constants.
    pub(crate) plan: String,
    pub(crate) ended: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Proved {
    /// Its name, and what it bundles if it is a bundle.
    pub(crate) function: String,
    pub(crate) scalar: String,
    /// The index in `rust`.
    pub(crate) file: usize,
    pub(crate) arguments: Vec<String>,
    /// Rows, joints, base parameters and load: [`Sizes`].
    pub(crate) sizes: [usize; 4],
    pub(crate) proof: String,
}

impl Proved {
    pub(crate) fn of(file: usize, function: &GeneratedFunction, emitted: &Emitted) -> Proved {
        let Sizes {
            rows,
            joints,
            base,
            load,
        } = emitted.sizes;
        let arguments = function.program.arguments.iter();
        let tolerance = match function.admitted {
            None => "",
            Some(_) => "; what a tolerance left out of it is bounded in its claim",
        };
        Proved {
            function: function.function.text(),
            scalar: emitted.scalar.name().to_owned(),
            file,
            arguments: arguments
                .map(|argument| argument.name().to_owned())
                .collect(),
            sizes: [rows, joints, base, load],
            proof: format!("{}{tolerance}", function.proof),
        }
    }

    pub(crate) fn sizes(&self) -> Sizes {
        let [rows, joints, base, load] = self.sizes;
        Sizes {
            rows,
            joints,
            base,
            load,
        }
    }
}
