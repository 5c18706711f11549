//! Of which robot and scene something is.

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

/// Which scene a plan's entry or a claim is about. The hash of a plan is the
/// robot's alone, so that a scene can be added; an edited scene shows in its own.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SceneKey {
    /// Its name.
    pub name: String,
    /// Its [`short_hash`](Scene::short_hash).
    pub hash: String,
}

impl SceneKey {
    /// Of a scene.
    pub fn of(scene: &Scene) -> SceneKey {
        SceneKey {
            name: scene.name.clone(),
            hash: scene.short_hash(),
        }
    }
}

/// The hash of a robot as plans and claims write it.
pub fn input_hash(robot: &Robot) -> String {
    let hash = robot.input_hash();
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}
