//! Verified robot dynamics in a build script: a robot file in, a Rust file out.
//!
//! In `Cargo.toml`, with `libm` for the generated code:
//!
//! ```toml
//! [dependencies]
//! libm = "0.2"
//!
//! [build-dependencies]
//! dalembert-build = "0.1"
//!
//! # The generator is a compiler: optimised, it takes a tenth of the time.
//! [profile.dev.build-override]
//! opt-level = 3
//! ```
//!
//! In `build.rs`:
//!
//! ```no_run
//! use dalembert_build::{BuildError, Generator, Output, Scalar};
//!
//! fn main() -> Result<(), BuildError> {
//!     Generator::new()
//!         .robot("robots/puma560.toml")
//!         .outputs([Output::InverseDynamics, Output::Gravity])
//!         .scalars([Scalar::F64])
//!         .write_to_out_dir("puma560.rs")
//! }
//! ```
//!
//! And in the crate:
//!
//! ```text
//! include!(concat!(env!("OUT_DIR"), "/puma560.rs"));
//!
//! let tau = puma560::inverse_dynamics(&q, &qd, &qdd);
//! ```
//!
//! # A file that is checked in
//!
//! [`Generator::write_to`] writes the file into the sources, where it can be read
//! in review. The file as it comes holds a module called after the robot. Taken
//! by `mod puma560;` that would be `puma560::puma560`; so for a file that is to
//! be a module itself, ask for what is inside:
//!
//! ```no_run
//! # use dalembert_build::{BuildError, Generator, Layout, Output, Scalar};
//! # fn main() -> Result<(), BuildError> {
//! Generator::new()
//!     .robot("robots/puma560.toml")
//!     .outputs([Output::Gravity])
//!     .scalars([Scalar::F64])
//!     .layout(Layout::Contents)
//!     .write_to("src/puma560.rs")
//! # }
//! ```
//!
//! `cargo fmt` leaves both kinds as they are.
//!
//! # Scenes
//!
//! A scene of the robot file brings its locked joints, payload, box, tolerance,
//! outputs and scalar; sines may be polynomials:
//!
//! ```no_run
//! # use dalembert_build::{BuildError, Generator, SinCos};
//! # fn main() -> Result<(), BuildError> {
//! Generator::new()
//!     .robot("robots/puma560.toml")
//!     .scene("pick")
//!     .sincos(SinCos::Polynomial { error: None })
//!     .write_to_out_dir("puma560_pick.rs")
//! # }
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod cargo;
mod error;
mod output;

use std::env;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::generate::generate_anew;
use dalembert_codegen::workspace::task::Request;
use dalembert_codegen::workspace::task::in_scene::find;
use dalembert_model::robot::Severity;

#[doc(inline)]
pub use dalembert_codegen::workspace::clauses::RobotFileError;
#[doc(inline)]
pub use dalembert_codegen::workspace::function::BundleError;
#[doc(inline)]
pub use dalembert_codegen::workspace::function::Function as Output;
#[doc(inline)]
pub use dalembert_codegen::workspace::function::RuntimeParameter as Parameter;
#[doc(inline)]
pub use dalembert_codegen::workspace::generate::GenerateError;
#[doc(inline)]
pub use dalembert_codegen::workspace::language::Language;
#[doc(inline)]
pub use dalembert_codegen::workspace::portfolio::Start as Formulation;
#[doc(inline)]
pub use dalembert_codegen::workspace::program::ScalarType as Scalar;
#[doc(inline)]
pub use dalembert_codegen::workspace::simplify::Effort;
#[doc(inline)]
pub use dalembert_codegen::workspace::sincos::SinCos;
#[doc(inline)]
pub use dalembert_codegen::workspace::task::in_scene::UnknownScene;
pub use dalembert_codegen::workspace::task::{Fma, Prefer};
#[doc(inline)]
pub use dalembert_codegen::workspace::task::Layout;
pub use error::BuildError;

/// A request for generated code: a robot file, and the functions that are wanted.
///
/// Nothing chosen, it is the outputs that the robot file names, or the seven that a controller calls, in
/// both scalars. Each function costs compile time, so most crates choose.
#[derive(Clone, Debug, Default)]
pub struct Generator {
    robot: Option<PathBuf>,
    outputs: Option<Vec<Output>>,
    bundles: Vec<Result<Output, BundleError>>,
    scalars: Option<Vec<Scalar>>,
    scene: Option<String>,
    /// Everything else.
    request: Request,
}

macro_rules! setters {
    ($($(#[doc = $doc:literal])* $word:ident($field:ident): $type:ty, $purpose:ident;)*) => {
        /// Options of one word.
        impl Generator {
            $($(#[doc = $doc])*
            #[must_use]
            pub fn $word(mut self, $word: $type) -> Self {
                self.request.$field = $word;
                self
            })*
        }
    };
}
dalembert_codegen::each_option!(setters);

impl Generator {
    /// Returns a generator with nothing chosen but the defaults.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the robot file, relative to the package. There is no default.
    #[must_use]
    pub fn robot(mut self, path: impl Into<PathBuf>) -> Self {
        self.robot = Some(path.into());
        self
    }

    /// Generates only these functions: the others need not be searched, proved and compiled.
    #[must_use]
    pub fn outputs(mut self, outputs: impl IntoIterator<Item = Output>) -> Self {
        self.outputs = Some(outputs.into_iter().collect());
        self
    }

    /// Sets one function of this name that returns what all of these do, in a struct,
    /// and shares their work: for a control loop that wants them at one state.
    /// `.bundle("servo", [Output::InverseDynamics, Output::Jacobian])` returns a
    /// `Servo`; its arguments are all that one of its parts reads. It comes besides
    /// the [`outputs`](Generator::outputs) that are chosen.
    #[must_use]
    pub fn bundle(mut self, name: &str, parts: impl IntoIterator<Item = Output>) -> Self {
        self.bundles.push(Output::bundle(name, parts));
        self
    }

    /// Generates only these scalars: `f32` where the hardware has no doubles, `f64` where
    /// accuracy matters. Of two, the f32 module is called `NAME_f32`.
    #[must_use]
    pub fn scalars(mut self, scalars: impl IntoIterator<Item = Scalar>) -> Self {
        self.scalars = Some(scalars.into_iter().collect());
        self
    }

    /// Generates only what a scene of the robot file needs: locked joints, rates that are zero
    /// and joints that nobody asks for are gone from the code. Its outputs and scalar count where
    /// none were chosen here, and the module is called `ROBOT_SCENE`. If it has a tolerance, the
    /// cheapest code found that is certified to stay within it: in each scalar that was chosen,
    /// or else in the cheapest that it admits.
    #[must_use]
    pub fn scene(mut self, name: impl Into<String>) -> Self {
        self.scene = Some(name.into());
        self
    }

    /// Sets the name of the module, if the robot's is taken or says too little.
    #[must_use]
    pub fn module(mut self, name: impl Into<String>) -> Self {
        self.request.module = Some(name.into());
        self
    }

    /// Makes arguments of what are constants of the robot otherwise:
    /// [`Parameter::Payload`] by the regrouped parameters of a type `Load`, which a
    /// function `load` computes once for each tool, and [`Parameter::Gravity`] as
    /// `g`, for an arm whose base is tilted or moves. Searched for at every build:
    /// a plan keeps programs of the robot's own parameters.
    #[must_use]
    pub fn parameters(mut self, parameters: impl IntoIterator<Item = Parameter>) -> Self {
        self.request.parameters = parameters.into_iter().collect();
        self
    }

    /// Returns the outputs that were chosen, if any were.
    fn chosen(&self) -> Result<Option<Vec<Output>>, BuildError> {
        let bundles: Result<Vec<Output>, BundleError> = self.bundles.iter().cloned().collect();
        let bundles = bundles.map_err(BuildError::Bundle)?;
        Ok(match (&self.outputs, bundles.as_slice()) {
            (None, []) => None,
            (outputs, bundles) => {
                let outputs = outputs.iter().flatten().copied();
                Some(outputs.chain(bundles.iter().copied()).collect())
            }
        })
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
        let path = path.as_ref();
        let robot = self.robot.as_deref().ok_or(BuildError::NoRobot)?;
        cargo::watch(robot, path);
        let file = dalembert_codegen::workspace::clauses::RobotFile::read(robot)
            .map_err(BuildError::Robot)?;
        let scene = match &self.scene {
            Some(name) => find(&file.scenes, name)
                .map(Some)
                .map_err(|error| BuildError::Scene(robot.to_owned(), error))?,
            None => None,
        };
        let mut request = self.request.clone();
        request.plan = file.plan.clone();
        request.work = Request::work_while_compiling(request.effort);
        let request = request.for_file(&file.outputs);
        let request = request.choose(self.chosen()?, self.scalars.clone(), scene);
        let key = output::key(&file.source, &request);
        if output::is_current(path, &key) {
            return Ok(());
        }
        for note in &file.notes {
            if note.severity == Severity::Warning {
                let place = format!("{}:{}", robot.display(), note.line);
                cargo::warn(&place, &note.message, note.help.as_deref());
            }
        }
        let generated = generate_anew(&file.robot, &request, &robot.display().to_string())
            .map_err(|error| BuildError::Generate(robot.to_owned(), error))?;
        for warning in &generated.warnings {
            cargo::warn(&robot.display().to_string(), warning, None);
        }
        output::write(path, &key, &generated.text)
            .map_err(|error| BuildError::Write(path.to_owned(), error))
    }
}
