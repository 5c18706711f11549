//! What somebody wants generated.

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use super::Start;
use crate::emit::{MathPath, ScalarType};
use crate::function::Function;
use crate::plan::Plan;
use crate::simplify::Effort;
use crate::sincos::SinCos;
use crate::watch::Watch;

/// What to do about a program whose rounding error is more than
/// [`WORSE`](crate::verify::accuracy::WORSE) times that of the textbook form.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Prefer {
    /// Take the cheapest that is not that much worse.
    #[default]
    Accuracy,
    /// Take the cheapest.
    Operations,
}

/// What to generate.
#[derive(Clone, Debug)]
pub struct Request {
    /// The functions, in any order; duplicates count once.
    pub functions: Vec<Function>,
    /// The scalars; one module each.
    pub scalars: Vec<ScalarType>,
    /// The formulation to start from.
    pub start: Start,
    /// How much work the simplifier may do for functions that are not in the
    /// plan.
    pub effort: Effort,
    /// What to do about a program that costs digits.
    pub prefer: Prefer,
    /// Programs to replay instead of searching.
    pub plan: Option<Plan>,
    /// Who waits, if anybody does.
    pub watch: Watch,
    /// How emitted code gets sines and cosines: polynomials hold over the
    /// robot's limits of position, or its scene's box.
    pub sincos: SinCos,
    /// Where emitted code finds sine and cosine, if it calls them.
    pub math: MathPath,
    /// The module's name; the robot's and the scene's if `None`. The f32
    /// module of a pair has `_f32` appended.
    pub module: Option<String>,
    /// What the robot is used for; everything if `None`. Its outputs and
    /// scalar are defaults that the ways in apply ([`Request::in_scene`]).
    pub scene: Option<Scene>,
    /// Nobody chose a scalar: of the scalars, a tolerance takes the cheapest
    /// that it admits.
    pub any_scalar: bool,
}

impl Request {
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
            functions: Function::ALL.to_vec(),
            scalars: ScalarType::ALL.to_vec(),
            start: Start::Auto,
            effort: Effort::Quick,
            prefer: Prefer::Accuracy,
            plan: None,
            watch: Watch::default(),
            sincos: SinCos::default(),
            math: MathPath::default(),
            module: None,
            scene: None,
            any_scalar: false,
        }
    }
}
