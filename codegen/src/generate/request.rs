//! What somebody wants generated.

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use crate::emit::{Interface, Layout};
use crate::function::Function;
use crate::language::{Entries, Language, MathPath};
use crate::plan::Plan;
use crate::portfolio::{Start, load};
use crate::program::shallow::Cycles;
use crate::program::{Program, ScalarType};
use crate::scene::{SceneError, SceneRobot};
use crate::simplify::Effort;
use crate::sincos::SinCos;
use crate::watch::Watch;

/// What programs are chosen by: what to do about one whose estimated rounding error is
/// more than 4 times that of the textbook form, and in which order its operations are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Prefer {
    /// Take the cheapest that is not that much worse.
    #[default]
    Accuracy,
    /// Take the cheapest.
    Operations,
    /// As `Accuracy`, then take sums and products in the order in which the longest
    /// chain is shortest: for who waits for one
    /// state's result, rather than for many.
    Latency,
}

impl Prefer {
    /// All, the default first.
    pub const ALL: [Prefer; 3] = [Prefer::Accuracy, Prefer::Operations, Prefer::Latency];

    /// Its name on the command line and in the macro.
    pub fn name(self) -> &'static str {
        match self {
            Prefer::Accuracy => "accuracy",
            Prefer::Operations => "operations",
            Prefer::Latency => "latency",
        }
    }
}

/// Whether products are fused with the sums that alone read them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fma {
    /// Every operation is rounded.
    #[default]
    Off,
    /// A product and its sum are one operation, `mul_add`, and rounded once. It
    /// needs `std`, and a processor that has it.
    On,
}

impl Fma {
    /// Both, the default first.
    pub const ALL: [Fma; 2] = [Fma::Off, Fma::On];

    /// Its name on the command line and in the macro.
    pub fn name(self) -> &'static str {
        match self {
            Fma::Off => "off",
            Fma::On => "on",
        }
    }
}

/// Some minutes where nothing is optimised.
const WORK_WHILE_COMPILING: u64 = 400_000_000;

/// What to generate.
#[derive(Clone, Debug)]
pub struct Request {
    /// The functions, in any order; duplicates count once.
    pub functions: Vec<Function>,
    /// The scalars; one module each.
    pub scalars: Vec<ScalarType>,
    /// The language of the text.
    pub language: Language,
    /// Whether functions in C have contracts in ACSL, for Frama-C.
    pub acsl: bool,
    /// The formulation to start from.
    pub start: Start,
    /// How much work the simplifier may do for functions that are not in the
    /// plan.
    pub effort: Effort,
    /// What to do about a program that costs digits.
    pub prefer: Prefer,
    /// Whether products are fused with their sums.
    pub fma: Fma,
    /// Programs to replay instead of searching.
    pub plan: Option<Plan>,
    /// Who waits, if anybody does.
    pub watch: Watch,
    /// How emitted code gets sines and cosines: polynomials hold over the
    /// robot's limits of position, or its scene's box.
    pub sincos: SinCos,
    /// Where emitted code finds sine and cosine, if it calls them.
    pub math: MathPath,
    /// In how many ways each function can be called.
    pub entries: Entries,
    /// Where emitted code finds `dalembert-batch`, if batches are asked for.
    pub batch: String,
    /// How code meets the modules.
    pub interface: Interface,
    /// Where emitted code finds the traits, if they are asked for.
    pub traits: String,
    /// The module's name; the robot's and the scene's if `None`. The f32
    /// module of a pair has `_f32` appended.
    pub module: Option<String>,
    /// Whether the text has modules, or is the contents of one.
    pub layout: Layout,
    /// What functions take as arguments that are the robot's parameters otherwise.
    pub parameters: Vec<RuntimeParameter>,
    /// What the robot is used for; everything if `None`. Its outputs and
    /// scalar are defaults that the ways in apply ([`Request::choose`]).
    pub scene: Option<Scene>,
    /// Nobody chose a scalar: of the scalars, a tolerance takes the cheapest
    /// that it admits.
    pub cheapest_scalar: bool,
    /// Units of work that the search for what a tolerance allows may take; it
    /// is refused where that is not enough. They are counted, never timed: the
    /// same everywhere. No limit if `None`.
    pub work: Option<u64>,
}

impl Request {
    /// The units of [`work`](Request::work) of the ways in that keep a compiler
    /// waiting, `dynamics!` and build scripts; no limit for who asks for a
    /// thorough search there.
    pub fn work_while_compiling(effort: Effort) -> Option<u64> {
        match effort {
            Effort::Quick => Some(WORK_WHILE_COMPILING),
            Effort::Thorough => None,
        }
    }

    /// The robot in the scene, where functions take the parameters.
    ///
    /// # Errors
    /// The scene is none of this robot.
    pub fn scene_robot(&self, robot: &Robot) -> Result<SceneRobot, SceneError> {
        let scene_robot = SceneRobot::of(robot, self.scene.as_ref())?;
        Ok(load::chosen(scene_robot.taking(&self.parameters)))
    }

    /// Returns what is emitted of a program that was found: in another order, or with its
    /// products fused, where that was asked for.
    pub(crate) fn finished(&self, program: &Program) -> Program {
        let program = match self.prefer {
            Prefer::Latency => program.shallow(Cycles::DESKTOP),
            Prefer::Accuracy | Prefer::Operations => program.clone(),
        };
        match self.fma {
            Fma::On => program.fused(),
            Fma::Off => program,
        }
    }

    /// The module's name.
    pub fn module_name(&self, robot: &Robot) -> String {
        match (&self.module, &self.scene) {
            (Some(name), _) => name.clone(),
            (None, Some(scene)) => format!("{}_{}", robot.name, scene.name),
            (None, None) => robot.name.clone(),
        }
    }
}

impl Default for Request {
    fn default() -> Self {
        Request {
            functions: Function::by_default(),
            scalars: ScalarType::ALL.to_vec(),
            language: Language::default(),
            acsl: false,
            start: Start::Auto,
            effort: Effort::Quick,
            prefer: Prefer::Accuracy,
            fma: Fma::Off,
            plan: None,
            watch: Watch::default(),
            sincos: SinCos::default(),
            math: MathPath::default(),
            entries: Entries::default(),
            batch: "dalembert_batch".to_owned(),
            interface: Interface::default(),
            traits: "dalembert::interface".to_owned(),
            module: None,
            layout: Layout::default(),
            parameters: Vec::new(),
            scene: None,
            cheapest_scalar: false,
            work: None,
        }
    }
}
