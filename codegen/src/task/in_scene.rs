//! Scenes and what they ask for, by name.

use dalembert_model::scene::{Float, Scene};

use super::request::Request;
use crate::function::Function;
use crate::program::ScalarType;
use crate::words::Complaint;

/// Returns the scene of a name.
///
/// # Errors
/// The name that was probably meant.
pub(crate) fn find<'s>(scenes: &'s [Scene], name: &str) -> Result<&'s Scene, Complaint> {
    let found = scenes.iter().find(|scene| scene.name == name);
    found.ok_or_else(|| {
        let known: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
        let message = format!("the robot has no scene `{name}`");
        let none = format!("its file has none: add a table [scene.{name}]");
        Complaint::unknown(message, name, &known, &none)
    })
}

impl From<Float> for ScalarType {
    fn from(float: Float) -> ScalarType {
        match float {
            Float::F64 => ScalarType::F64,
            Float::F32 => ScalarType::F32,
        }
    }
}

impl Request {
    /// Returns the request with the outputs and scalars that somebody chose, if any, and
    /// in a scene, if any: it takes the scene's outputs where none were chosen,
    /// and the same for its scalar. With a tolerance and no scalar chosen, the
    /// cheapest that it admits is taken.
    #[must_use]
    pub fn choose(
        mut self,
        outputs: Option<Vec<Function>>,
        scalars: Option<Vec<ScalarType>>,
        scene: Option<&Scene>,
    ) -> Request {
        if let Some(scene) = scene {
            if !scene.outputs.is_empty() {
                self.functions = scene.outputs.clone();
            }
            if let Some(scalar) = scene.scalar {
                self.scalars = vec![scalar.into()];
            }
            self.cheapest_scalar = scalars.is_none() && scene.scalar.is_none();
            if self.cheapest_scalar && scene.tolerance.is_some() {
                self.scalars = ScalarType::ALL.to_vec();
            }
            self.scene = Some(scene.clone());
        }
        self.functions = outputs.unwrap_or(self.functions);
        self.scalars = scalars.unwrap_or(self.scalars);
        self
    }

    /// Takes the outputs that a robot file names, where it names any; a scene's and those
    /// that somebody chose come after them.
    #[must_use]
    pub fn for_file(mut self, outputs: &[Function]) -> Request {
        if !outputs.is_empty() {
            self.functions = outputs.to_vec();
        }
        self
    }

    /// Returns the request in a scene, with its outputs and its scalar.
    #[must_use]
    pub fn in_scene(self, scene: &Scene) -> Request {
        self.choose(None, None, Some(scene))
    }
}
