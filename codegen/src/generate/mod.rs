//! The one function that macro, build script and command call.
//!
//! - [`request`], [`start`]: what somebody wants, and from which formulation
//! - `search`: a program from the plan, or searched for
//! - `tolerate`: the cheapest variant that a scene's tolerance admits
//! - [`early`]: a search that was ended early, and what programs are compared by
//! - `range`: what a scalar cannot hold
//! - [`error`]: why nothing was generated

pub mod early;
pub mod error;
mod range;
pub mod request;
pub(crate) mod search;
pub mod start;
pub(crate) mod tolerate;

use dalembert_model::robot::Robot;

use crate::certify::choose::Admitted;
use crate::emit::ScalarType;
use crate::emit::module::{self, ModuleOptions};
use crate::function::Function;
use crate::graph::Counts;
use crate::plan;
use crate::portfolio::Source;
use crate::scene::Setting;
use crate::schedule::Program;
use crate::simplify::{Effort, Stage};
use crate::sincos::{self, AngleKernel, SinCos, Sines};
use crate::verify::exact::{Proof, prove_in};
use crate::verify::floating::Emitted;
use crate::verify::text::{TextError, TextProgram};
pub use error::GenerateError;
use range::{check_constants, warn_of_overflow};
pub use request::{Prefer, Request};
use search::{found, replay};
pub use start::Start;
use tolerate::tolerate;

/// A generated and proved function.
#[derive(Clone, Debug)]
pub struct GeneratedFunction {
    /// Which function.
    pub function: Function,
    /// The formulation that the search started from.
    pub source: Source,
    /// Whether it is the plan's, and nothing was searched for.
    pub planned: bool,
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
    /// Whether the observer wanted an end before a thorough search was through:
    /// no function is dearer than the quick search's, but more might be found.
    pub ended: bool,
}

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
    let (mut functions, scalars) = all(&setting, request)?;
    let ended = request.effort == Effort::Thorough && request.watch.is_over();
    if ended {
        early::no_dearer_than_quick(&setting, request, &mut functions, &scalars);
    }
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
        ended,
    })
}

/// Every function's program, with what a tolerance leaves of it, and the
/// scalars to emit.
fn all(
    setting: &Setting,
    request: &Request,
) -> Result<(Vec<GeneratedFunction>, Vec<ScalarType>), GenerateError> {
    let mut functions = Vec::new();
    for function in Function::ALL {
        if request.functions.contains(&function) {
            functions.push(one(setting, function, request)?);
        }
    }
    let scalars = tolerate(setting, &mut functions, request)?;
    Ok((functions, scalars))
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
    let entry = replay(setting, function, request)?;
    let (source, stages, program) = match entry {
        Some(entry) => (entry.source, entry.stages.clone(), entry.program.clone()),
        None => found(setting, function, request)?,
    };
    let proof = prove_in(setting, &program).map_err(|d| GenerateError::Disproved(function, d))?;
    Ok(GeneratedFunction {
        function,
        source,
        planned: entry.is_some(),
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
    if generated.admitted.is_some() {
        // It has what its tolerance admits, or no sines.
        return Ok(Vec::new());
    }
    let error = error.unwrap_or(SinCos::ERROR);
    let fail = |why: String| GenerateError::SinCos(generated.function, why);
    let all = scalars.iter().map(|&scalar| {
        let positions = sincos::positions(setting.robot(), scalar);
        let sines = sincos::polynomials(&generated.program, scalar, &positions, error);
        Ok((scalar, sines.map_err(|why| fail(why.to_string()))?))
    });
    all.collect()
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
