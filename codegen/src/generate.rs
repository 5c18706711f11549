//! The one function that macro, build script and command call.

use std::fmt;

use dalembert_model::equations::Formulation;
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scene::Scene;

use crate::certify::certificate::Refuted;
use crate::certify::choose::{Admitted, Refusal};
use crate::certify::input_box::InputBox;
use crate::certify::ranges::{Finding, ranges};
use crate::emit::module::{self, ModuleOptions};
use crate::emit::{MathPath, ScalarType};
use crate::function::{Function, Quantity};
use crate::graph::{Counts, Graph};
use crate::plan::{self, Entry, Plan};
use crate::portfolio::tune::Tuned;
use crate::portfolio::{self, Source, Sums, Variant};
use crate::scene::{Setting, SettingError};
use crate::schedule::{Operand, Program};
use crate::simplify::{self, Effort, Simplified, Stage};
use crate::sincos::{self, AngleKernel, SinCos, Sines};
use crate::tolerate::tolerate;
use crate::verify::accuracy::Judge;
use crate::verify::exact::{Disproof, Proof, prove_in};
use crate::verify::floating::Emitted;
use crate::verify::text::{TextError, TextProgram};
use crate::watch::{Part, Vigil, Watch};

/// Which formulation a function starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Start {
    /// The cheapest, with the others' values at hand.
    #[default]
    Auto,
    /// As [`Start::Auto`], where the sines and cosines of angle sums of
    /// parallel joints may be evaluated instead of formed: fewer operations,
    /// a pair more, and an error of |q| u in the sum.
    AngleSums,
    /// One only.
    Only(Formulation),
}

impl Start {
    /// The choices of the command line and the macro.
    pub const NAMES: [&'static str; 5] = [
        "auto",
        "angle_sums",
        "lagrange_euler",
        "dalembert",
        "newton_euler",
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Start::Auto => "auto",
            Start::AngleSums => "angle_sums",
            Start::Only(formulation) => Source::Textbook(formulation).name(),
        }
    }

    /// The choice of a name.
    pub fn from_name(name: &str) -> Option<Start> {
        Some(match name {
            "auto" => Start::Auto,
            "angle_sums" => Start::AngleSums,
            "lagrange_euler" => Start::Only(Formulation::LagrangeEuler),
            "dalembert" => Start::Only(Formulation::Dalembert),
            "newton_euler" => Start::Only(Formulation::NewtonEulerLink),
            _ => return None,
        })
    }

    /// The graphs to start from.
    fn variants(
        self,
        setting: &Setting,
        function: Function,
        effort: Effort,
        watch: Option<Vigil<'_>>,
    ) -> (Option<Tuned>, Vec<Variant>) {
        match self {
            Start::Only(formulation) => {
                let variant = portfolio::textbook(setting, function, formulation);
                (None, vec![variant])
            }
            Start::Auto | Start::AngleSums => {
                let tuned = portfolio::tuned(setting, function, effort, watch);
                let mut variants = portfolio::regrouped(setting, function, &tuned.gauge);
                // The textbook recursion gives D column by column and h_ikm
                // by polarisation, with n² of work a link or more: no match.
                if function.quantities() == [Quantity::Torque] {
                    let recursion = Formulation::NewtonEulerLink;
                    variants.push(portfolio::textbook(setting, function, recursion));
                }
                (Some(tuned), variants)
            }
        }
    }
}

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

/// A generated and proved function.
#[derive(Clone, Debug)]
pub struct GeneratedFunction {
    /// Which function.
    pub function: Function,
    /// The formulation that the search started from.
    pub source: Source,
    /// The final program with exact constants: what is emitted.
    pub program: Program,
    /// Its counts, without the polynomials of sines.
    pub counts: Counts,
    /// The polynomials of its sines in each scalar, if they are not libm's.
    pub sines: Vec<(ScalarType, Sines)>,
    /// Counts of the formula as executed, then after each step.
    pub stages: Vec<Stage>,
    /// That it is right; with a tolerance, that the program is that it was
    /// made from.
    pub proof: Proof,
    /// With a tolerance: what was left out, and the certificates.
    pub admitted: Option<Admitted>,
}

impl GeneratedFunction {
    /// The polynomials of its sines in a scalar; none if they are libm's.
    pub fn sines(&self, scalar: ScalarType) -> &[AngleKernel] {
        sincos::of(&self.sines, scalar)
    }

    /// Its counts with the polynomials of its sines in a scalar.
    pub fn counts_in(&self, scalar: ScalarType) -> Counts {
        let (trig_mul, trig_add) = sincos::counts(self.sines(scalar));
        Counts {
            trig_mul,
            trig_add,
            ..self.counts
        }
    }
}

/// Everything generated for a robot.
#[derive(Clone, Debug)]
pub struct Generated {
    /// In the order of [`Function::ALL`].
    pub functions: Vec<GeneratedFunction>,
    /// The Rust source: one module a scalar.
    pub text: String,
    /// The functions as the source says them, scalar by scalar.
    pub emitted: Vec<Emitted>,
    /// What a user should know, such as constants that round to subnormals.
    pub warnings: Vec<String>,
}

/// Why nothing was generated.
#[derive(Clone, Debug, PartialEq)]
pub enum GenerateError {
    /// The request names no function or no scalar.
    Empty,
    /// The plan is for another robot, or for a scene that has changed.
    StalePlan {
        /// The robot that the plan names, or the scene.
        robot: String,
    },
    /// The scene is none of this robot.
    Scene(SettingError),
    /// A constant is beyond the scalar's range, or rounds to zero.
    Constant {
        /// The function that needs it.
        function: Function,
        /// The scalar that cannot hold it.
        scalar: ScalarType,
        /// Its value, roughly.
        value: String,
    },
    /// No polynomial gives a sine as exactly as was wanted.
    SinCos(Function, String),
    /// A function would be too large to compile.
    TooLarge {
        /// Which function.
        function: Function,
        /// How many numbers it returns.
        outputs: usize,
    },
    /// The program is not the formula: a defect of this library, or a
    /// parameter that cannot be proved with.
    Disproved(Function, Disproof),
    /// The printed text is not the program: a defect of this library.
    Text(Function, ScalarType, String),
    /// No variant meets the scene's tolerance.
    Tolerance(Function, Refusal),
    /// The plan's variant is none of the plan's program.
    Variant(Function, Refuted),
}

impl fmt::Display for GenerateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GenerateError::Empty => f.write_str("nothing to generate: name an output and a scalar"),
            GenerateError::StalePlan { robot } => write!(
                f,
                "the plan of `{robot}` no longer fits the robot: its parameters changed; \
                 make it anew with `dalembert generate --effort thorough --save-plan`, or delete it"
            ),
            GenerateError::Scene(error) => error.fmt(f),
            GenerateError::Constant {
                function,
                scalar,
                value,
            } => write!(
                f,
                "`{function}` needs the constant {value}, which {scalar} cannot hold: \
                 choose other units or a wider scalar"
            ),
            GenerateError::SinCos(function, why) => write!(f, "`{function}`: {why}"),
            GenerateError::TooLarge { function, outputs } => write!(
                f,
                "`{function}` would return {outputs} numbers: ask for `inverse_dynamics`, \
                 `inertia`, `coriolis` or `gravity` instead"
            ),
            GenerateError::Disproved(function, disproof) => write!(f, "`{function}`: {disproof}"),
            GenerateError::Text(function, scalar, why) => {
                write!(f, "`{function}` in {scalar}: {why}")
            }
            GenerateError::Tolerance(function, why) => write!(f, "`{function}`: {why}"),
            GenerateError::Variant(function, why) => {
                write!(f, "the plan's variant of `{function}`: {why}")
            }
        }
    }
}

impl std::error::Error for GenerateError {}

/// The most numbers a function may return: beyond, the code that returns
/// them alone takes a compiler minutes.
pub const MOST_OUTPUTS: usize = 20_000;

/// Generates, proves, prints and reads back.
pub fn generate(robot: &Robot, request: &Request) -> Result<Generated, GenerateError> {
    if request.functions.is_empty() || request.scalars.is_empty() {
        return Err(GenerateError::Empty);
    }
    if let Some(plan) = &request.plan
        && plan.input != plan::input_hash(robot)
    {
        let robot = plan.robot.clone();
        return Err(GenerateError::StalePlan { robot });
    }
    let setting = Setting::of(robot, request.scene.as_ref()).map_err(GenerateError::Scene)?;
    let mut functions = Vec::new();
    for function in Function::ALL {
        if request.functions.contains(&function) {
            functions.push(one(&setting, function, request)?);
        }
    }
    let scalars = tolerate(&setting, &mut functions, request)?;
    for generated in &mut functions {
        if generated.sines.is_empty() {
            generated.sines = sines(&setting, generated, &scalars, request)?;
        }
    }
    let mut warnings = Vec::new();
    for generated in &functions {
        for &scalar in &scalars {
            check_constants(&generated.program, scalar, &mut warnings)?;
            warn_of_overflow(setting.robot(), &generated.program, scalar, &mut warnings);
        }
    }
    let name = request.module_name(robot);
    let text = module::write(
        robot,
        &setting,
        &functions,
        &ModuleOptions {
            scalars: &scalars,
            math: &request.math,
            name: &name,
        },
    );
    let mut emitted = Vec::new();
    for &scalar in &scalars {
        for generated in &functions {
            emitted.push(read_back(&text, generated, scalar, &name, &scalars)?);
        }
    }
    Ok(Generated {
        functions,
        text,
        emitted,
        warnings,
    })
}

fn one(
    setting: &Setting,
    function: Function,
    request: &Request,
) -> Result<GeneratedFunction, GenerateError> {
    let outputs = function.outputs(setting.rows().len());
    if outputs > MOST_OUTPUTS {
        return Err(GenerateError::TooLarge { function, outputs });
    }
    let (source, stages, program) = match replay(setting, function, request)? {
        Some(entry) => (entry.source, entry.stages.clone(), entry.program.clone()),
        None => found(setting, function, request)?,
    };
    let proof = prove_in(setting, &program).map_err(|d| GenerateError::Disproved(function, d))?;
    Ok(GeneratedFunction {
        function,
        source,
        counts: program.counts(),
        sines: Vec::new(),
        program,
        stages,
        proof,
        admitted: None,
    })
}

/// The polynomials of a program's sines in each scalar.
fn sines(
    setting: &Setting,
    generated: &GeneratedFunction,
    scalars: &[ScalarType],
    request: &Request,
) -> Result<Vec<(ScalarType, Sines)>, GenerateError> {
    let SinCos::Polynomial { error } = request.sincos else {
        return Ok(Vec::new());
    };
    let fail = |why: String| GenerateError::SinCos(generated.function, why);
    if generated.admitted.is_some() {
        return Err(fail(
            "a scene's tolerance decides how exact its sines are: leave that to it, or take `libm`"
                .into(),
        ));
    }
    let all = scalars.iter().map(|&scalar| {
        let positions = sincos::positions(setting.robot(), scalar);
        let sines = sincos::polynomials(&generated.program, scalar, &positions, error);
        Ok((scalar, sines.map_err(|why| fail(why.to_string()))?))
    });
    all.collect()
}

/// The plan's program, the first requested scalar's that it has.
pub(crate) fn replay<'r>(
    setting: &Setting,
    function: Function,
    request: &'r Request,
) -> Result<Option<&'r Entry>, GenerateError> {
    let Some(plan) = &request.plan else {
        return Ok(None);
    };
    let scene = setting.scene();
    let mut scalars = request.scalars.iter();
    let found = scalars.find_map(|&scalar| plan.find(function, request.start, scalar, scene));
    match (found, scene) {
        // A program of the scene as it was is a program of another scene.
        (Some(entry), Some(scene)) if entry.scene != Some(plan::SceneKey::of(scene)) => {
            Err(GenerateError::StalePlan {
                robot: scene.name.clone(),
            })
        }
        _ => Ok(found),
    }
}

/// Searches for a program.
fn found(
    setting: &Setting,
    function: Function,
    request: &Request,
) -> Result<(Source, Vec<Stage>, Program), GenerateError> {
    let found = search(setting, function, request)?;
    let (seed, simplified) = (&found.variants[found.simplified.seed], &found.simplified);
    let mut stages = vec![Stage {
        name: "traced",
        counts: seed.traced,
    }];
    stages.extend(simplified.stages.iter().cloned());
    let program = Program::in_setting(setting, function, &simplified.graph);
    stages.push(Stage {
        name: "final",
        counts: program.counts(),
    });
    Ok((seed.source, stages, program))
}

/// What a search found, and from what.
pub(crate) struct Found {
    /// The gauge of the regrouped variants, if there are such.
    pub tuned: Option<Tuned>,
    /// What it started from.
    pub variants: Vec<Variant>,
    /// Its program, and those on the way.
    pub simplified: Simplified,
}

/// Searches for the cheapest program.
pub(crate) fn search(
    setting: &Setting,
    function: Function,
    request: &Request,
) -> Result<Found, GenerateError> {
    let watch = request.watch.over(function);
    // Who wants an end before a function's turn gets the quick search for it.
    let (effort, watch) = match watch.is_over() {
        true => (Effort::Quick, None),
        false => (request.effort, Some(watch)),
    };
    let tell = |part, best| {
        if let Some(watch) = watch {
            watch.step(part, [0, 1], best);
        }
    };
    tell(Part::Formulations, None);
    let (tuned, variants) = request.start.variants(setting, function, effort, watch);
    let graphs: Vec<Graph> = variants.iter().map(|v| v.graph.clone()).collect();
    let mut helpers = match request.start {
        Start::Auto => vec![portfolio::angle_sums(setting, Sums::Products)],
        Start::AngleSums => vec![portfolio::angle_sums(setting, Sums::Inputs)],
        Start::Only(_) => Vec::new(),
    };
    if let Some(tuned) = &tuned
        && std::env::var("NB").is_ok()
    {
        helpers.extend(portfolio::neighbours(setting, function, tuned));
    }
    let judge = match request.prefer {
        Prefer::Accuracy => Judge::new(setting, function),
        Prefer::Operations => Judge::lenient(setting, function),
    };
    let accept = |graph: &Graph| judge.accepts(graph);
    let simplified = simplify::watched(&graphs, &helpers, effort, &accept, watch);
    let simplified = simplified.ok_or(GenerateError::Empty)?;
    tell(Part::Proof, Some(simplified.graph.counts()));
    Ok(Found {
        tuned,
        variants,
        simplified,
    })
}

/// A constant that becomes infinite or zero is an error, a subnormal one a
/// warning: its relative rounding error is no longer bounded by u.
fn check_constants(
    program: &Program,
    scalar: ScalarType,
    warnings: &mut Vec<String>,
) -> Result<(), GenerateError> {
    let operands = program.steps.iter().flat_map(|s| [&s.left, &s.right]);
    let outputs = program.outputs.iter().map(|output| &output.value);
    for operand in operands.chain(outputs) {
        let Operand::Constant(constant) = operand else {
            continue;
        };
        let rounded = scalar.round(constant);
        // A sum over constant angles may be zero by a relation between them
        // that is not known as such; zero is then what it is rounded to.
        if constant.as_rational().is_none() && f64::nearest(constant) == 0.0 {
            continue;
        }
        if !rounded.is_finite() || (rounded == 0.0 && !constant.is_zero()) {
            return Err(GenerateError::Constant {
                function: program.function,
                scalar,
                value: roughly(constant),
            });
        }
        if rounded != 0.0 && rounded.abs() < scalar.least_normal() {
            warnings.push(format!(
                "`{}`: the constant {rounded:e} is subnormal in {scalar}",
                program.function
            ));
        }
    }
    Ok(())
}

/// Intermediates that may overflow inside the robot's limits, where it has
/// all of them: never a silent infinity.
fn warn_of_overflow(
    robot: &Robot,
    program: &Program,
    scalar: ScalarType,
    warnings: &mut Vec<String>,
) {
    let Ok(limits) = InputBox::of(robot) else {
        return;
    };
    let findings = ranges(program, scalar, &limits, 1).findings;
    let mut overflows = findings
        .iter()
        .filter(|finding| matches!(finding, Finding::Overflow { .. }));
    if let Some(first) = overflows.next() {
        warnings.push(format!(
            "`{}` in {scalar}, inside the robot's limits: {first}; {} more like it",
            program.function,
            overflows.count()
        ));
    }
}

fn roughly(constant: &Exact) -> String {
    format!("{:e}", f64::nearest(constant))
}

fn read_back(
    text: &str,
    generated: &GeneratedFunction,
    scalar: ScalarType,
    name: &str,
    scalars: &[ScalarType],
) -> Result<Emitted, GenerateError> {
    let fail = |why: String| GenerateError::Text(generated.function, scalar, why);
    let module = module::name(name, scalar, scalars);
    let section = module::section(text, &module)
        .ok_or_else(|| fail(format!("there is no module `{module}`")))?;
    let read = TextProgram::parse(section, generated.function, scalar)
        .map_err(|error: TextError| fail(error.to_string()))?;
    read.matches_with(&generated.program, scalar, generated.sines(scalar))
        .map_err(fail)?;
    if read.counts() != generated.counts_in(scalar) {
        return Err(fail("the counts of the text differ".into()));
    }
    Ok(Emitted {
        function: generated.function,
        scalar,
        text: read,
    })
}
