//! For build scripts: a robot file to a Rust file.
//!
//! ```no_run
//! // build.rs
//! use dalembert_codegen::builder::{BuildError, Generator};
//! use dalembert_codegen::emit::ScalarType;
//! use dalembert_codegen::function::Function;
//!
//! fn main() -> Result<(), BuildError> {
//!     Generator::new()
//!         .robot("robots/puma560.toml")
//!         .outputs([Function::InverseDynamics, Function::Gravity])
//!         .scalars([ScalarType::F64])
//!         .write_to_out_dir("puma560.rs")
//! }
//! ```
//!
//! and in the crate, with `libm` among its dependencies:
//!
//! ```text
//! include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
//! ```
//!
//! A scene of the robot file brings its locked joints, payload, box, tolerance,
//! outputs and scalar; sines may be polynomials:
//!
//! ```no_run
//! # use dalembert_codegen::builder::{BuildError, Generator};
//! # use dalembert_codegen::sincos::SinCos;
//! # fn main() -> Result<(), BuildError> {
//! Generator::new()
//!     .robot("robots/puma560.toml")
//!     .scene("pick")
//!     .sincos(SinCos::Polynomial { error: None })
//!     .write_to_out_dir("puma560_pick.rs")
//! # }
//! ```

mod error;
mod output;

use std::env;
use std::path::{Path, PathBuf};

pub use error::BuildError;

use crate::clauses::RobotFile;
use crate::emit::{MathPath, ScalarType};
use crate::function::Function;
use crate::generate::{Request, Start, generate};
use crate::plan;
use crate::scene;
use crate::simplify::Effort;
use crate::sincos::SinCos;
use dalembert_model::robot::Severity;

/// What to generate, and from which robot file.
///
/// The defaults are those of [`Request`]: every function in both scalars.
/// Each function costs compile time, so most crates choose.
#[derive(Clone, Debug, Default)]
pub struct Generator {
    robot: Option<PathBuf>,
    request: Request,
    scene: Option<String>,
    /// Whether outputs and scalars were chosen: else they are the scene's.
    chose: [bool; 2],
}

impl Generator {
    /// A generator with nothing chosen but the defaults.
    pub fn new() -> Self {
        Self::default()
    }

    /// The robot file, relative to the package. There is no default.
    #[must_use]
    pub fn robot(mut self, path: impl Into<PathBuf>) -> Self {
        self.robot = Some(path.into());
        self
    }

    /// Only these functions: the others need not be searched, proved and
    /// compiled.
    #[must_use]
    pub fn outputs(mut self, outputs: impl IntoIterator<Item = Function>) -> Self {
        self.request.functions = outputs.into_iter().collect();
        self.chose[0] = true;
        self
    }

    /// Only these scalars: `f32` where the hardware has no doubles, `f64`
    /// where accuracy matters. Of two, the f32 module is called `NAME_f32`.
    #[must_use]
    pub fn scalars(mut self, scalars: impl IntoIterator<Item = ScalarType>) -> Self {
        self.request.scalars = scalars.into_iter().collect();
        self.chose[1] = true;
        self
    }

    /// One formulation only, to compare formulations; [`Start::Auto`], the
    /// default, is never dearer.
    #[must_use]
    pub fn formulation(mut self, start: Start) -> Self {
        self.request.start = start;
        self
    }

    /// How long to search. [`Effort::Thorough`] saves a few operations more,
    /// which pays where the file is generated once and run for long.
    #[must_use]
    pub fn effort(mut self, effort: Effort) -> Self {
        self.request.effort = effort;
        self
    }

    /// Only what a scene of the robot file needs: locked joints, rates that
    /// are zero and joints that nobody asks for are gone from the code. Its
    /// outputs and scalar count where none were chosen here, and the module is
    /// called `ROBOT_SCENE`. If it has a tolerance, the cheapest code found
    /// that is certified to stay within it: in each scalar that was chosen, or
    /// else in the cheapest that it admits.
    #[must_use]
    pub fn scene(mut self, name: impl Into<String>) -> Self {
        self.scene = Some(name.into());
        self
    }

    /// The name of the module, if the robot's is taken or says too little.
    #[must_use]
    pub fn module(mut self, name: impl Into<String>) -> Self {
        self.request.module = Some(name.into());
        self
    }

    /// Where the code finds `sincos`, `sin` and `cos` (`sincosf`, … for f32):
    /// a path, `libm` by default. A target with its own sines has a module of
    /// them.
    #[must_use]
    pub fn math(mut self, path: impl Into<String>) -> Self {
        self.request.math = MathPath(path.into());
        self
    }

    /// Where sines come from. Polynomials over the joints' limits, or the
    /// scene's box, are faster and need no libm; their largest error is
    /// [`SinCos::ERROR`] unless one is given. A scene's tolerance decides on it
    /// by itself: there, giving one is an error.
    #[must_use]
    pub fn sincos(mut self, sincos: SinCos) -> Self {
        self.request.sincos = sincos;
        self
    }

    /// Writes the file into `OUT_DIR`, for `include!`.
    ///
    /// # Errors
    /// [`BuildError`]; a file that was there stays as it was.
    pub fn write_to_out_dir(&self, file_name: impl AsRef<Path>) -> Result<(), BuildError> {
        let folder = env::var_os("OUT_DIR").ok_or(BuildError::NoOutDir)?;
        self.write_to(Path::new(&folder).join(file_name))
    }

    /// Writes the file to a path, so that it can be checked in and read in
    /// review, and builds need no generator.
    ///
    /// Nothing is generated if the file is there already, unchanged, from the
    /// same robot file, the same choices and the same version of this crate.
    ///
    /// # Errors
    /// [`BuildError`]; a file that was there stays as it was.
    pub fn write_to(&self, path: impl AsRef<Path>) -> Result<(), BuildError> {
        let robot = self.robot.as_deref().ok_or(BuildError::NoRobot)?;
        tell(&format!("rerun-if-changed={}", robot.display()));
        let file = RobotFile::read(robot).map_err(BuildError::Robot)?;
        let plan = plan::file::path(robot);
        if plan.is_file() {
            tell(&format!("rerun-if-changed={}", plan.display()));
        }
        let mut request = self.request.clone();
        request.plan = file.plan.clone();
        if let Some(name) = &self.scene {
            let scene = scene::find(&file.scenes, name)
                .map_err(|error| BuildError::Scene(robot.to_owned(), error))?;
            let [outputs, scalars] = self.chose;
            request = request.in_scene(scene, outputs, scalars);
        }
        let path = path.as_ref();
        let key = output::key(&file.source, &request);
        if output::is_current(path, &key) {
            return Ok(());
        }
        for note in &file.notes {
            if note.severity == Severity::Warning {
                let place = format!("{}:{}", robot.display(), note.line);
                tell(&format!("warning={place}: {}", note.message));
            }
        }
        let generated = generate(&file.robot, &request)
            .map_err(|error| BuildError::Generate(robot.to_owned(), error))?;
        for warning in &generated.warnings {
            tell(&format!("warning={}: {warning}", robot.display()));
        }
        output::write(path, &key, &generated.text)
            .map_err(|error| BuildError::Write(path.to_owned(), error.to_string()))
    }
}

/// Tells cargo; outside a build script nobody would listen.
fn tell(line: &str) {
    if env::var_os("OUT_DIR").is_some() {
        println!("cargo::{line}");
    }
}
