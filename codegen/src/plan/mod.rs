//! Plans: final programs as claims, beside the robot file they belong to.
//!
//! A long search is run once; its programs, with exact constants, are kept
//! in `<robot>.plan` and replayed: read, proved again, printed. A plan says
//! which robot it is for by the hash of that robot, so an edited robot does
//! not get the program of another.
//!
//! - this file: [`Plan`]: its entries and how one is found
//! - [`mod@file`]: where it is kept
//! - `document`: the text

mod document;
pub mod file;

use crate::edits::Omission;
use crate::function::Function;
use crate::program::{Program, ScalarType};
use crate::search::Pass;
use crate::seeds::{Source, Start};
use crate::setup::{ParametersKey, SceneKey};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::scene::Scene;

/// The programs kept for a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The robot's name, for readers.
    pub robot: String,
    /// The robot's [`input_hash`](dalembert_model::robot::Robot::input_hash)
    /// in hexadecimal.
    pub input: String,
    /// One entry a scene, function, formulation and scalar, and what is an argument.
    pub entries: Vec<Entry>,
}

/// One kept program.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The formulation that was asked for.
    pub start: Start,
    /// The scalar that it was made for.
    pub scalar: ScalarType,
    /// Where the search started.
    pub source: Source,
    /// Counts after each step of the search.
    pub passes: Vec<Pass>,
    /// The scene that it is for, unless it is for the whole robot.
    pub scene: Option<SceneKey>,
    /// The robot's parameters that it takes as arguments, if it does.
    pub parameters: Option<ParametersKey>,
    /// The program.
    pub program: Program,
    /// The variant to emit instead, where a scene has a tolerance.
    pub edited: Option<Edited>,
}

/// A variant that a scene's tolerance admits. Whenever it is used, its bounds are found anew.
#[derive(Clone, Debug, PartialEq)]
pub struct Edited {
    /// The program to emit.
    pub program: Program,
    /// The values that were left out, for the documentation.
    pub left_out: Vec<Omission>,
}

/// What tells the entries of a plan apart.
type Key<'e> = (
    Option<&'e str>,
    Function,
    &'static str,
    ScalarType,
    &'e [RuntimeParameter],
);

/// Returns which parameters of the robot are arguments.
fn taken(parameters: Option<&ParametersKey>) -> &[RuntimeParameter] {
    parameters.map_or(&[], |parameters| &parameters.taken)
}

impl Entry {
    fn key(&self) -> Key<'_> {
        let scene = self.scene.as_ref().map(|scene| scene.name.as_str());
        (
            scene,
            self.program.function,
            self.start.name(),
            self.scalar,
            taken(self.parameters.as_ref()),
        )
    }
}

impl Plan {
    /// Returns the entry for a function, formulation and scalar that takes the same
    /// parameters, in a scene of this name. Whether the scene and the load's numbers
    /// are still the same, their hashes say.
    pub fn find(
        &self,
        function: Function,
        start: Start,
        scalar: ScalarType,
        scene: Option<&Scene>,
        parameters: Option<&ParametersKey>,
    ) -> Option<&Entry> {
        let scene = scene.map(|scene| scene.name.as_str());
        let key = (scene, function, start.name(), scalar, taken(parameters));
        self.entries.iter().find(|entry| entry.key() == key)
    }

    /// Puts an entry in its place, instead of the one with the same key.
    pub fn insert(&mut self, entry: Entry) {
        self.entries.retain(|other| other.key() != entry.key());
        self.entries.push(entry);
        self.entries.sort_by(|a, b| a.key().cmp(&b.key()));
    }
}
