//! What is kept of a loaded arm.

use dalembert_codegen::GeneratedFunction;
use dalembert_codegen::workspace::{Emitted, Sizes};
use serde::{Deserialize, Serialize};

/// What was generated for a robot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Entry {
    /// The robot file.
    pub(crate) robot: String,
    /// What a user should know.
    pub(crate) notes: Vec<String>,
    /// The functions, scalar by scalar.
    pub(crate) functions: Vec<Proved>,
    /// The functions as Rust: a file's text for each scalar.
    pub(crate) rust: Vec<String>,
    /// The claim about these files, which the command `certify` compares with them.
    pub(crate) claim: String,
    /// The programs with exact constants.
    pub(crate) plan: String,
    /// Whether the search was ended early.
    pub(crate) ended: bool,
}

/// What is known of a function besides its code.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Proved {
    /// Its name, and what it bundles if it is a bundle.
    pub(crate) function: String,
    /// Its scalar.
    pub(crate) scalar: String,
    /// Which of the texts it is in.
    pub(crate) file: usize,
    /// Its arguments by name, in order.
    pub(crate) arguments: Vec<String>,
    /// Rows, joints, base parameters and load: [`Sizes`].
    pub(crate) sizes: [usize; 4],
    /// What was proved, in a sentence.
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
