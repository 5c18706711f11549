//! What to make of a robot.

use std::path::PathBuf;

use dalembert_codegen::workspace::function::{Function, RuntimeParameter};
use dalembert_codegen::workspace::program::{Library, ScalarType};
use dalembert_codegen::workspace::task::{Request, in_scene};
use dalembert_codegen::workspace::watch::Watch;
use dalembert_model::read::Reading;

use crate::error::LoadError;

/// Where plans and compiled requests are kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Cache {
    /// In the user's folder for caches, or in that of `DALEMBERT_CACHE`.
    #[default]
    User,
    /// In a folder of the caller's.
    At(PathBuf),
    /// Nowhere.
    Off,
}

/// What to make of a robot: the chain of a URDF, the functions, and how to search for them.
#[derive(Clone, Debug, Default)]
pub struct Load {
    /// The chain to take of a URDF, and what of it stays where it is.
    pub urdf: dalembert_import::Options,
    /// The functions; those of the scene, or else of the generator, if `None`.
    pub outputs: Option<Vec<Function>>,
    /// The scalars that functions compute in; the scene's, or else f64, if `None`.
    pub scalars: Option<Vec<ScalarType>>,
    /// Parameters of the robot that are arguments.
    pub parameters: Vec<RuntimeParameter>,
    /// The scene of the robot file, by its name.
    pub scene: Option<String>,
    /// How to search and compute: the generator's options of one word. Sines are those of
    /// `dalembert-sines` unless a scene's tolerance admits polynomials, or others are chosen;
    /// with fused products results are not those of other machines.
    pub options: Request,
    /// Where the work is kept.
    pub cache: Cache,
    /// Who waits for a long search.
    pub watch: Watch,
}

impl Load {
    /// Makes the generator's request for a robot file.
    pub(crate) fn request(&self, reading: &Reading) -> Result<Request, LoadError> {
        let find = |name: &String| in_scene::find(&reading.scenes, name);
        let scene = self.scene.as_ref().map(find).transpose();
        let scene = scene.map_err(|error| LoadError::Request(error.to_string()))?;
        let request = Request {
            scalars: vec![ScalarType::F64],
            parameters: self.parameters.clone(),
            auto: Library::Together,
            watch: self.watch.clone(),
            work: Request::work_while_compiling(self.options.effort),
            ..self.options.clone()
        };
        let request = request.for_file(&reading.outputs);
        Ok(request.choose(self.outputs.clone(), self.scalars.clone(), scene))
    }
}
