//! A request: the functions to generate, and the options.

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::outputs::{PayloadDependence, RuntimeParameter};
use dalembert_model::robot::Robot;
use dalembert_model::scene::{Scene, SceneScalar};

use crate::function::Function;
use crate::language::Language;
use crate::limbs::LimbLayout;
use crate::plan::Plan;
use crate::program::ScalarType;
use crate::search::Effort;
use crate::seeds::{Start, load};
use crate::setup::Setup;
use crate::sincos::SinCos;
use crate::watch::Watch;
use crate::words::words;

/// Some minutes where nothing is optimised.
const WORK_WHILE_COMPILING: u64 = 400_000_000;

words! {
    /// The preference among programs. It decides about one whose estimated rounding error is
    /// more than 4 times that of the textbook form.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Prefer: "preference" {
        /// Take the cheapest that is not that much worse.
        #[default]
        Accuracy = "accuracy",
        /// Take the cheapest.
        Operations = "operations",
    }
}

/// A request for code: the functions, and the options by which they are searched for and printed.
///
/// ```
/// use dalembert_codegen::{Effort, Function, Language, Request};
///
/// let request = Request {
///     language: Language::C,
///     effort: Effort::Thorough,
///     ..Request::new(&[Function::InverseDynamics, Function::Gravity])
/// };
/// assert!(request.asked().to_string().starts_with("outputs: inverse_dynamics, gravity"));
/// ```
#[derive(Clone, Debug)]
pub struct Request {
    /// The functions, in any order; duplicates count once.
    pub functions: Vec<Function>,
    /// The scalars; one file each in Rust.
    pub scalars: Vec<ScalarType>,
    /// The formulation to start from.
    pub start: Start,
    /// The effort of the search.
    pub effort: Effort,
    /// The preference among programs.
    pub prefer: Prefer,
    /// `true` if a product and the sum that alone reads it are one operation, `mul_add`, and rounded
    /// once. It needs `std`, and a processor that has it.
    pub fma: bool,
    /// The layout of limbs of one structure in functions.
    pub limbs: LimbLayout,
    /// The source of sines and cosines.
    pub sincos: SinCos,
    /// The largest |computed − true| of each sine and cosine by polynomials. If nothing is said it
    /// is [`SinCos::ERROR`], or the least error of two digits that each scalar can have. A scene's
    /// tolerance says it by itself.
    pub sincos_error: Option<f64>,
    /// `true` for functions of any number of states beside those of one.
    pub batch: bool,
    /// The language of the code.
    pub language: Language,
    /// Programs to replay instead of searching.
    pub plan: Option<Plan>,
    /// Programs that a search goes on from, but for those of another robot, scene or function.
    pub renewed: Option<Plan>,
    /// `true` if a plan beside the robot file is not used.
    pub has_no_plan: bool,
    /// The observer of a long search, if there is one.
    pub watch: Watch,
    /// The name that functions begin with in C; the robot's and the scene's if `None`.
    pub module: Option<String>,
    /// The robot's parameters that functions take as arguments.
    pub parameters: Vec<RuntimeParameter>,
    /// The links whose bodies are arguments, counted from one, the base zero; all if this is empty.
    pub bodies: Vec<usize>,
    /// `true` if numbers of bodies that are zero in the robot file stay zero.
    pub keeps_zeros: bool,
    /// The robot's use; everything if `None`. [`Request::choose`] applies its outputs and scalar.
    pub scene: Option<Scene>,
    /// `true` if nobody chose a scalar. Then a tolerance takes the cheapest of the scalars that it
    /// admits, and f32 is left out where it cannot hold a constant.
    pub is_scalar_open: bool,
    /// The options that chose the chain in a model, with their values; none for a robot file.
    pub chain: Vec<(String, String)>,
    /// Units of work that the search for what a tolerance allows may take; it is refused where that
    /// is not enough. They are counted, never timed: the same everywhere. No limit if `None`.
    pub work: Option<u64>,
}

impl Default for Request {
    fn default() -> Self {
        Request {
            functions: Function::by_default(),
            scalars: ScalarType::ALL.to_vec(),
            start: Start::default(),
            effort: Effort::default(),
            prefer: Prefer::default(),
            fma: false,
            limbs: LimbLayout::default(),
            sincos: SinCos::default(),
            sincos_error: None,
            batch: false,
            language: Language::default(),
            plan: None,
            renewed: None,
            has_no_plan: false,
            watch: Watch::default(),
            module: None,
            parameters: Vec::new(),
            bodies: Vec::new(),
            keeps_zeros: false,
            scene: None,
            is_scalar_open: false,
            chain: Vec::new(),
            work: None,
        }
    }
}

impl Request {
    /// Asks for these functions; every other option has its default.
    pub fn new(functions: &[Function]) -> Request {
        Request {
            functions: functions.to_vec(),
            ..Request::default()
        }
    }

    /// Returns the units of [`work`](Request::work) of the ways in that keep a compiler waiting,
    /// `dynamics!` and build scripts; no limit if a thorough search is asked for there.
    pub fn work_while_compiling(effort: Effort) -> Option<u64> {
        match effort {
            Effort::Quick => Some(WORK_WHILE_COMPILING),
            Effort::Thorough => None,
        }
    }

    /// Puts the robot into the scene, where functions take the parameters. If they take a load, this
    /// searches for the regrouping that its numbers are of, which takes seconds.
    ///
    /// # Errors
    /// The scene does not fit this robot, or a function needs mass and no link has any.
    pub fn prepare(&self, robot: &Robot) -> Result<Setup, Diagnostic> {
        let setup = Setup::in_scene(robot, self.scene.as_ref())?
            .taking(&self.parameters)
            .taking_bodies(&self.bodies, self.keeps_zeros)?;
        if setup.has(RuntimeParameter::Payload) && robot.is_tree() {
            let message = "a payload that is an argument is on the last link, and the links of this robot \
                           branch";
            let help =
                "give it to a link in a scene: payload = { link = \"left_hand\", mass = 2.5, … }";
            return Err(Diagnostic::error(message).with_help(help));
        }
        if !setup.robot().has_mass() && !setup.has_load() {
            // A function that no payload changes is kinematics, or over any parameters.
            let weighs =
                |function: &&Function| function.payload_dependence() != PayloadDependence::None;
            if let Some(function) = self.functions.iter().find(weighs) {
                let message = format!(
                    "no link has mass, inertia or an armature, so `{function}` would be that of an arm that \
                     weighs nothing"
                );
                let help = "give each link its `mass`, `com` and `inertia`, in a URDF an <inertial>; outputs such \
                            as `jacobian` need none";
                return Err(Diagnostic::error(message).with_help(help));
            }
        }
        Ok(load::chosen(setup))
    }

    /// Returns the module's name.
    pub fn module_name(&self, robot: &Robot) -> String {
        match (&self.module, &self.scene) {
            (Some(name), _) => name.clone(),
            (None, Some(scene)) => format!("{}_{}", robot.name, scene.name),
            (None, None) => robot.name.clone(),
        }
    }

    /// Returns the request with the outputs and scalars that somebody chose, in a scene, if any,
    /// whose outputs and scalar are the defaults. With a tolerance and no scalar chosen, the
    /// cheapest that it admits is taken.
    #[must_use]
    pub fn choose(
        mut self,
        outputs: Option<Vec<Function>>,
        scalars: Option<Vec<ScalarType>>,
        scene: Option<&Scene>,
    ) -> Request {
        let of_scene = scene.and_then(|scene| scene.scalar);
        self.is_scalar_open = scalars.is_none() && of_scene.is_none();
        if let Some(scene) = scene {
            if !scene.outputs.is_empty() {
                self.functions = scene.outputs.clone();
            }
            self.scalars = match of_scene {
                Some(SceneScalar::F64) => vec![ScalarType::F64],
                Some(SceneScalar::F32) => vec![ScalarType::F32],
                None if scene.tolerance.is_none() || !self.is_scalar_open => self.scalars,
                None => ScalarType::ALL.to_vec(),
            };
            self.scene = Some(scene.clone());
        }
        self.functions = outputs.unwrap_or(self.functions);
        self.scalars = scalars.unwrap_or(self.scalars);
        self
    }

    /// Takes the outputs that a robot file names; where it names none and its links branch, those by
    /// default that need no hand. A scene's and those that somebody chose come after them.
    #[must_use]
    pub fn for_file(mut self, robot: &Robot, outputs: &[Function]) -> Request {
        if !outputs.is_empty() {
            self.functions = outputs.to_vec();
        } else if robot.is_tree() {
            self.functions.retain(|function| !function.is_of_hand());
        }
        self
    }
}
