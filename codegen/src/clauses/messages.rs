//! The errors of an invocation's form, in one table. Those of a robot are the reader's, those
//! of words are of [`words`](crate::words).

/// A message: the fault, and what would be right.
pub(super) struct Message {
    pub(super) text: &'static str,
    pub(super) help: &'static str,
}

const fn message(text: &'static str, help: &'static str) -> Message {
    Message { text, help }
}

pub(super) const NO_ROBOT: Message = message(
    "expected the path of a robot file in quotes, or its text",
    "pub mod puma560 = \"robots/puma560.toml\"; or pub mod arm = r#\"name = …\"#; with line breaks",
);
pub(super) const NO_MODULE: Message = message(
    "expected `mod` and the name of the module",
    "pub mod puma560 = \"robots/puma560.toml\";",
);
pub(super) const NO_SEMICOLON: Message = message("expected `;` after the path", "");
pub(super) const TWO_ROBOTS: Message = message(
    "an invocation has one robot",
    "write a second `dynamics!` for the next",
);
pub(super) const NO_KEY: Message = message(
    "expected the name of a clause",
    "a clause is `name: value;`, such as `outputs: inverse_dynamics, gravity;`",
);
pub(super) const NO_COLON: Message = message(
    "expected `:` after the clause's name",
    "a clause is `name: value;`",
);
pub(super) const NO_VALUE: Message = message("expected a value", "");
pub(super) const NO_OUTPUTS: Message = message(
    "there is no clause `outputs`",
    "outputs: inverse_dynamics, gravity;",
);
pub(super) const NO_BATCH: Message = message(
    "`batch: on` needs the feature `batch` of the crate dalembert",
    "in Cargo.toml: dalembert = { version = \"0.1\", features = [\"batch\"] }",
);
pub(super) const NO_WORD: Message = message("expected a word", "");
pub(super) const NO_COMMA: Message = message("expected `,` or `;`", "");
pub(super) const NO_PART: Message = message(
    "expected the word for an output",
    "a bundle is `name = output + output`",
);
pub(super) const NO_PLUS: Message = message(
    "expected `+`, `,` or `;`",
    "a bundle is `name = output + output`",
);
pub(super) const ONE_WORD: Message = message("expected one word only", "");
pub(super) const SINCOS_ERROR: Message = message(
    "expected an error above 0 and below 1",
    "sincos_error: 1e-9;",
);
pub(super) const NO_POLYNOMIALS: Message = message(
    "only polynomials have an error to choose",
    "add `sincos: polynomial;`, or leave this out",
);
pub(super) const CRATE_PATH: Message = message(
    "expected the path of the crate `dalembert`",
    "crate = ::my_library::dalembert;",
);
pub(super) const CRATE_RELATIVE: Message = message(
    "the path would be taken from inside the generated module",
    "start with `crate::` or with the name of a crate",
);
pub(super) const SCENE_CLAUSE: Message = message(
    "expected the name of a scene",
    "scene: pick; of the robot file's [scene.pick]",
);
impl Message {
    /// Returns both, as the compiler shows them.
    pub(super) fn with_help(&self) -> String {
        match self.help {
            "" => self.text.to_owned(),
            help => format!("{}\n  = help: {help}", self.text),
        }
    }
}
