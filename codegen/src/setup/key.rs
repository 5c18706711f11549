//! Keys that identify a robot, a scene, and the parameters that are arguments.

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;
use dalembert_model::robot::values::short_hash;
use dalembert_model::scene::Scene;

use super::Task;
use crate::function::Argument;

/// The scene that a plan's entry or a claim is about. The hash of a plan is the robot's alone,
/// so that a scene can be added; an edited scene shows in its own.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SceneKey {
    pub name: String,
    /// Its [`short_hash`](Scene::short_hash).
    pub hash: String,
}

impl SceneKey {
    pub fn new(scene: &Scene) -> SceneKey {
        SceneKey {
            name: scene.name.clone(),
            hash: scene.short_hash(),
        }
    }
}

/// The parameters of the robot that a plan's entry takes as arguments, and the load's numbers:
/// a program of others means nothing in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParametersKey {
    /// The arguments, in the order of [`Argument::ALL`].
    pub taken: Vec<Argument>,
    /// The number of entries of the load; zero where the load is no argument.
    pub load: usize,
    /// The hash of these numbers.
    pub hash: String,
}

impl ParametersKey {
    /// Returns the key of a function; `None` if it takes no parameters as arguments.
    pub fn find(task: Task<'_>) -> Option<ParametersKey> {
        let Task { setup, function } = task;
        let mut taken: Vec<Argument> = setup.taken(function).collect();
        taken.sort();
        taken.dedup();
        if taken.is_empty() {
            return None;
        }
        let load = setup.load().filter(|_| taken.contains(&Argument::Load));
        let numbers = load.map_or(&[][..], |load| &load.numbers);
        // Loads of other links may have the same numbers, so the hash has the links, too. A payload
        // is always on the last link: its hash has the numbers alone, as in existing plans.
        let mut lines = String::new();
        for parameter in RuntimeParameter::LOADING {
            if load.is_some() && setup.has(parameter) && parameter != RuntimeParameter::Payload {
                lines += &format!("{} {:?}\n", parameter.name(), setup.body_links());
            }
        }
        lines.extend(numbers.iter().map(|number| format!("{number}\n")));
        Some(ParametersKey {
            taken,
            load: numbers.len(),
            hash: short_hash(&lines),
        })
    }
}

/// Returns the hash of a robot as plans and claims write it.
pub fn input_hash(robot: &Robot) -> String {
    let hash = robot.input_hash();
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
