//! Scenes and what they ask for, by name.

use std::fmt;

use dalembert_model::read::closest;
use dalembert_model::scene::{Float, Output, Scene};

use crate::emit::ScalarType;
use crate::function::Function;
use crate::generate::Request;

/// There is no scene of this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownScene {
    /// The name.
    pub found: String,
    /// The scene that was probably meant.
    pub meant: Option<String>,
    /// The scenes that there are.
    pub known: Vec<String>,
}

impl UnknownScene {
    /// What is wrong.
    pub fn message(&self) -> String {
        format!("the robot has no scene `{}`", self.found)
    }

    /// The likely fix.
    pub fn help(&self) -> String {
        match (&self.meant, self.known.as_slice()) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, []) => format!("its file has none: add a table [scene.{}]", self.found),
            (None, known) => format!("there is: {}", known.join(", ")),
        }
    }
}

impl fmt::Display for UnknownScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message(), self.help())
    }
}

impl std::error::Error for UnknownScene {}

/// The scene of a name.
///
/// # Errors
/// [`UnknownScene`], with the name that was probably meant.
pub fn find<'s>(scenes: &'s [Scene], name: &str) -> Result<&'s Scene, UnknownScene> {
    scenes
        .iter()
        .find(|scene| scene.name == name)
        .ok_or_else(|| {
            let known: Vec<&str> = scenes.iter().map(|scene| scene.name.as_str()).collect();
            UnknownScene {
                found: name.to_owned(),
                meant: closest(name, &known).map(str::to_owned),
                known: known.into_iter().map(str::to_owned).collect(),
            }
        })
}

impl From<Output> for Function {
    fn from(output: Output) -> Function {
        match output {
            Output::InverseDynamics => Function::InverseDynamics,
            Output::Gravity => Function::Gravity,
            Output::Inertia => Function::Inertia,
            Output::Coriolis => Function::Coriolis,
            Output::ManipulatorEquation => Function::ManipulatorEquation,
            Output::DynamicCoefficients => Function::DynamicCoefficients,
        }
    }
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
    /// The request in a scene: it takes the scene's outputs where none were
    /// chosen otherwise, and the same for its scalar. With a tolerance and no
    /// scalar chosen, the cheapest that it admits is taken.
    #[must_use]
    pub fn in_scene(mut self, scene: &Scene, chose_outputs: bool, chose_scalars: bool) -> Request {
        if !chose_outputs && !scene.outputs.is_empty() {
            self.functions = scene.outputs.iter().copied().map(Function::from).collect();
        }
        if let (false, Some(scalar)) = (chose_scalars, scene.scalar) {
            self.scalars = vec![scalar.into()];
        }
        self.any_scalar = !chose_scalars && scene.scalar.is_none();
        if self.any_scalar && scene.tolerance.is_some() {
            self.scalars = ScalarType::ALL.to_vec();
        }
        self.scene = Some(scene.clone());
        self
    }
}
