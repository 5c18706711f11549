//! Plans: final programs as claims, beside the robot file they belong to.
//!
//! A long search is run once; its programs, with exact constants, are kept in `<robot>.plan` and
//! replayed: read, proved again, printed. A plan says which robot it is for by the hash of that
//! robot, so an edited robot does not get the program of another.
//!
//! Takes a file's text; returns a [`Plan`], a list of [`Entry`]. The generator returns a
//! `PlanUpdate`, which is written back.

mod document;
pub mod file;

use crate::function::Function;
use crate::program::{Program, ScalarType};
use crate::search::Pass;
use crate::seeds::{Source, Start};
use crate::setup::{ParametersKey, SceneKey};
use dalembert_model::outputs::Argument;
use dalembert_model::scene::Scene;

/// The programs kept for a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The robot's name, for readers.
    pub robot: String,
    /// The robot's [`input_hash`](dalembert_model::robot::Robot::input_hash) in hexadecimal.
    pub input: String,
    /// One entry a scene, list of results, formulation and scalar, and what is an argument.
    pub entries: Vec<Entry>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The formulation that was asked for.
    pub start: Start,
    pub scalar: ScalarType,
    /// The start of the search.
    pub source: Source,
    /// Counts after each step of the search.
    pub passes: Vec<Pass>,
    /// The scene that it is for, unless it is for the whole robot.
    pub scene: Option<SceneKey>,
    /// The robot's parameters that it takes as arguments, if it does.
    pub parameters: Option<ParametersKey>,
    pub program: Program,
    /// The program to emit instead, where a scene has a tolerance. Each use finds its bounds anew.
    pub edited: Option<Program>,
}

/// Functions with the same results count as one, see [`is_same`].
type Key<'e> = (
    Option<&'e str>,
    Function,
    &'static str,
    ScalarType,
    &'e [Argument],
);

fn taken(parameters: Option<&ParametersKey>) -> &[Argument] {
    parameters.map_or(&[], |parameters| &parameters.taken)
}

/// A bundle's name and the order of its parts do not matter.
fn is_same(a: Key<'_>, b: Key<'_>) -> bool {
    let [quantities, other] = [a.1, b.1].map(Function::quantities);
    let has_same_results = quantities.len() == other.len()
        && quantities.iter().all(|quantity| other.contains(quantity));
    has_same_results && (a.0, a.2, a.3, a.4) == (b.0, b.2, b.3, b.4)
}

impl Entry {
    fn as_function(&self, function: Function) -> Option<Entry> {
        let mut entry = self.clone();
        entry.program = entry.program.as_function(function)?;
        if let Some(edited) = &mut entry.edited {
            *edited = edited.as_function(function)?;
        }
        Some(entry)
    }

    fn key(&self) -> Key<'_> {
        let scene = self.scene.as_ref().map(|scene| scene.name.as_str());
        let (function, taken) = (self.program.function, taken(self.parameters.as_ref()));
        (scene, function, self.start.name(), self.scalar, taken)
    }
}

impl Plan {
    /// Returns a scene's first entry for a formulation, a scalar and parameters, as the program of
    /// a function with these results. Hashes tell if scene and load are still the same.
    pub fn find(
        &self,
        function: Function,
        start: Start,
        scalar: ScalarType,
        scene: Option<&Scene>,
        parameters: Option<&ParametersKey>,
    ) -> Option<Entry> {
        let scene = scene.map(|scene| scene.name.as_str());
        let key = (scene, function, start.name(), scalar, taken(parameters));
        let mut entries = self.entries.iter();
        let entry = entries.find(|entry| is_same(entry.key(), key))?;
        entry.as_function(function)
    }

    /// Puts an entry in its place, instead of those for the same results.
    pub fn insert(&mut self, entry: Entry) {
        self.entries
            .retain(|other| !is_same(other.key(), entry.key()));
        self.entries.push(entry);
        self.entries.sort_by(|a, b| a.key().cmp(&b.key()));
    }
}
