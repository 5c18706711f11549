//! The one function that macro, build script and command call.
//!
//! Takes a robot and a [`Request`]; returns [`GeneratedCode`], the text with its claim, or a
//! [`GenerateError`] and no text.

pub(crate) mod contradiction;
pub(crate) mod keep;
mod lanes;
pub(crate) mod language;
pub(crate) mod parameters;
mod range;
pub(crate) mod search;
mod sines;
pub(crate) mod tolerate;

use dalembert_checker::Fault;
use dalembert_checker::read::Text;
use dalembert_model::diagnostic::{Diagnostic, closest};
use dalembert_model::robot::{Frame, HAND, Robot};
use dalembert_stamp::{Comment, Stamp};

use crate::emit::{GeneratedFunction, header, module};
use crate::function::Function;
use crate::language::c99::Names;
use crate::language::read::Signature;
use crate::language::{Language, columns};
use crate::limbs::LimbLayout;
use crate::parallel;
use crate::program::{Code, Program, ScalarType};
use crate::search::{Effort, price};
use crate::seeds::depends_on_coulomb;
use crate::setup::{ParametersKey, Setup, input_hash};
use crate::task::{GenerateError, Job, Miss, Prefer, Request};
use crate::tolerance::refusals::{FOLLOWERS_ARE_UNBOUNDED, FRICTION_IS_UNBOUNDED, unbounded};
use crate::verify::exact::prove;
use crate::verify::measure::RunnableCode;
use crate::verify::parameters::prove_base;
use crate::verify::singular::without_inertia;
use crate::watch::Watch;
use range::{check_constants, leave_out_single, overflow, vanishing};
use search::{found_program, replay};
use tolerate::tolerate;

/// Everything generated for a robot.
#[derive(Clone, Debug)]
pub struct GeneratedCode {
    /// In the order of [`Function::in_order`], behind that of a load.
    pub functions: Vec<GeneratedFunction>,
    /// The scalars, in the order in which they were asked for; under a tolerance the cheapest one.
    pub scalars: Vec<ScalarType>,
    /// The text of each file, without a stamp: in Rust one for each scalar, in C and CUDA one for all.
    pub texts: Vec<String>,
    /// The functions as the source says them, scalar by scalar.
    pub emitted: Vec<RunnableCode>,
    /// Warnings, such as constants that round to subnormals.
    pub warnings: Vec<String>,
    /// The reason for which there is no f32, where nobody chose a scalar and both are the default.
    pub without_single: Option<String>,
    /// True if the observer wanted an end before a thorough search was through:
    /// no function is dearer than the quick search's, but more might be found.
    pub ended: bool,
}

impl GeneratedCode {
    /// Returns the text of each file behind its stamp, as it is to be written. `robot` is the path
    /// of the robot file from the folder of the file, `source` its text.
    pub fn files(&self, request: &Request, robot: &str, source: &str) -> Vec<String> {
        let comment = match request.language {
            Language::Rust => Comment::Line,
            Language::C | Language::Cuda => Comment::Block,
        };
        let stamped = |(index, text): (usize, &String)| {
            let mut named = request.clone();
            named.scalars = match request.language {
                Language::Rust => vec![self.scalars[index]],
                Language::C | Language::Cuda => self.scalars.clone(),
            };
            let mut asked = named.asked();
            if self.without_single.is_some() {
                // f64 alone was not asked for. `set` cannot fail: `scalar` is an option.
                let _ = asked.set("scalar", "");
            }
            let stamp = Stamp {
                version: env!("CARGO_PKG_VERSION").to_owned(),
                robot: robot.to_owned(),
                robot_hash: dalembert_stamp::hash(source),
                chain: request.chain.clone(),
                asked,
            };
            stamp.write(comment, text)
        };
        self.texts.iter().enumerate().map(stamped).collect()
    }

    /// Returns the end of each file's name, before its extension: `_f32` for the second of two
    /// scalars in Rust.
    pub fn suffixes(&self) -> Vec<&'static str> {
        let is_pair = self.texts.len() > 1;
        let suffix = |scalar: &ScalarType| dalembert_stamp::suffix(scalar.name(), is_pair);
        let scalars = self.scalars.iter().take(self.texts.len());
        scalars.map(suffix).collect()
    }

    /// Returns the texts of all files, one after the other.
    pub fn text(&self) -> String {
        self.texts.concat()
    }
}

pub(crate) type Outcome<T> = Result<T, GenerateError>;

/// The most numbers of a function: beyond, a compiler takes minutes for what returns them alone.
const MAX_OUTPUTS: usize = 20_000;

/// Generates the requested functions for `robot`: searches for programs, proves each equal to
/// Lagrange–Euler, prints them and parses the text back.
///
/// ```
/// use dalembert_codegen::{Function, Request, RobotFile, generate};
///
/// let pendulum = "
///     name = \"pendulum\"
///     convention = \"standard\"
///     gravity = [0, -9.81, 0]
///     [[joint]]
///     kind = \"revolute\"
///     a = 0.5
///     mass = 2
///     com = [-0.25, 0, 0]
///     inertia = [0, 0.01, 0.01, 0, 0, 0]
/// ";
/// let file = RobotFile::parse(pendulum, "pendulum.toml")?;
/// let code = generate(&file.robot, &Request::new(&[Function::Gravity]))?;
/// let counts = code.functions[0].counts();
/// assert_eq!((counts.mul, counts.add, counts.sincos), (1, 0, 1)); // m g l cos(q)
/// assert!(code.texts[0].contains("pub fn gravity(q: &[f64; 1]) -> [f64; 1] {"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Why nothing was generated.
pub fn generate(robot: &Robot, request: &Request) -> Result<GeneratedCode, GenerateError> {
    let asked = request;
    let request = &*language::with_short_name(robot, asked);
    let setup = &request.prepare(robot)?;
    check(robot, setup, request)?;
    let job = &Job {
        robot,
        setup,
        request,
    };
    parameters::check(job)?;
    if let (LimbLayout::Lanes, Some([why, help])) = (request.limbs, lanes::refusal(job)) {
        let message = format!("`limbs: lanes`: {why}");
        return Err(GenerateError::refused(None, message, help));
    }
    let (mut functions, mut scalars) = functions(job)?;
    let ended = request.effort == Effort::Thorough && request.watch.is_over();
    if ended {
        no_dearer_than_quick(job, &mut functions, &scalars);
    }
    let mut warnings = Vec::from_iter(language::renamed(robot, asked, request));
    let without_single = leave_out_single(request, &functions, &mut scalars);
    warnings.extend(without_single.clone());
    sines::give(job, &mut functions, &scalars)?;
    for generated in &functions {
        for &scalar in &scalars {
            let program = &generated.program;
            let subnormal = check_constants(program, scalar);
            let fail = |why| GenerateError::Constant(generated.function, why);
            warnings.extend(subnormal.map_err(fail)?);
            warnings.extend(overflow(setup.robot(), program, scalar));
        }
    }
    let in_scalar = |&scalar: &ScalarType| {
        let code = |function: &GeneratedFunction| function.code(scalar, request.sincos.library());
        (scalar, functions.iter().map(code).collect::<Vec<Code>>())
    };
    let codes: Vec<(ScalarType, Vec<Code>)> = scalars.iter().map(in_scalar).collect();
    let texts = match request.language {
        Language::Rust => (codes.iter())
            .map(|(scalar, codes)| module::write(job, &functions, codes, *scalar))
            .collect(),
        Language::C | Language::Cuda => {
            let note = without_single.as_deref();
            vec![header::write(job, &functions, &codes, note)]
        }
    };
    let mut emitted = Vec::new();
    // Headers have all scalars in one text.
    for ((_, codes), text) in codes.iter().zip(texts.iter().cycle()) {
        let tokens = match request.language {
            Language::Rust => Text::rust(text),
            Language::C | Language::Cuda => Text::c(text),
        };
        for (generated, code) in functions.iter().zip(codes) {
            emitted.push(read_back(job, &tokens, generated, code)?);
        }
    }
    contradiction::check(setup, &functions, &emitted)?;
    Ok(GeneratedCode {
        functions,
        scalars,
        texts,
        emitted,
        warnings,
        without_single,
        ended,
    })
}

/// Generates as [`generate`] does; where the plan is of robot or scene before an edit, searches
/// without it, and warns with the command that renews it. Messages call the robot file `shown`.
pub fn generate_anew(robot: &Robot, request: &Request, shown: &str) -> Outcome<GeneratedCode> {
    let what = match generate(robot, request) {
        Err(GenerateError::Stale(what, _)) => what,
        other => return other,
    };
    let mut without = request.clone();
    without.plan = None;
    let mut generated = generate(robot, &without)?;
    let scene = request.scene.as_ref();
    let scene = scene.map(|scene| format!("--scene {} ", scene.name));
    generated.warnings.push(format!(
        "the plan beside {shown} no longer fits {what}, which was edited since: a search took its \
         place; `dalembert generate {shown} {}--effort thorough --save-plan` renews it",
        scene.unwrap_or_default()
    ));
    Ok(generated)
}

fn check(robot: &Robot, setup: &Setup, request: &Request) -> Outcome<()> {
    if request.functions.is_empty() || request.scalars.is_empty() {
        return Err(GenerateError::empty());
    }
    let functions = Function::in_order(&request.functions);
    for (index, &function) in functions.iter().enumerate() {
        let mut others = functions[..index].iter();
        if let Some(&other) = others.find(|other| function.is_namesake(**other)) {
            let (other, text) = (other.text(), function.text());
            let message =
                format!("`{other}` and `{text}` would get the same name in the generated module");
            let help = "give one of them another name: NAME = OUTPUT + OUTPUT";
            return Err(GenerateError::refused(function, message, help));
        }
    }
    for &function in &functions {
        check_frames(robot, setup, function)?;
        if !robot.followers.is_empty() && !function.takes_followers() {
            return Err(GenerateError::follows(function));
        }
        let floats = setup.robot().floating.is_some();
        if floats && !function.takes_floating_base() {
            return Err(GenerateError::floats(function));
        }
        if !floats && !function.takes_fixed_base() {
            return Err(GenerateError::is_fixed(function, setup.scene()));
        }
    }
    language::check(robot, request, &functions)?;
    if let Some(plan) = &request.plan
        && plan.input != input_hash(robot)
    {
        return Err(GenerateError::stale_plan(&plan.robot));
    }
    if setup.scene().is_none_or(|scene| scene.tolerance.is_none()) {
        return Ok(());
    }
    let reason = |&function: &Function| {
        let why = match robot.followers.is_empty() {
            false => Diagnostic::error(FOLLOWERS_ARE_UNBOUNDED),
            true => unbounded(function, setup.robot().floating.is_some())?,
        };
        Some((function, why))
    };
    let rubs = |function: &Function| depends_on_coulomb(setup.task(*function));
    let friction = |function: Function| (function, Diagnostic::error(FRICTION_IS_UNBOUNDED));
    let functions = request.functions.iter();
    let refused = (functions.clone().find_map(reason))
        .or_else(|| functions.copied().find(rubs).map(friction));
    match refused {
        Some((function, why)) => Err(GenerateError::Tolerance(function, Miss::Refused, why)),
        None => Ok(()),
    }
}

fn check_frames(robot: &Robot, setup: &Setup, function: Function) -> Outcome<()> {
    let is_of_base = |name: &&str| {
        let mut frames = robot.frames.iter();
        frames.any(|frame| frame.row.is_none() && frame.name == *name)
    };
    if let Some(scene) = setup.scene().filter(|scene| scene.lock_base)
        && let Some(frame) = function.frames().into_iter().find(is_of_base)
    {
        let text = function.text();
        let message = format!("`{text}`: the frame `{frame}` is on the base, which does not move");
        let help = format!("scene `{}` locks the base", scene.name);
        return Err(GenerateError::refused(function, message, &help));
    }
    let robot = setup.robot();
    // Frames at the ends of limbs are most often meant.
    let tips = robot.tips();
    let mut frames: Vec<&Frame> = robot.frames.iter().collect();
    frames.sort_by_key(|frame| frame.row.is_none_or(|row| !tips.contains(&row)));
    let names: Vec<&str> = frames.iter().map(|frame| frame.name.as_str()).collect();
    if robot.is_tree() && function.is_of_hand() {
        return Err(no_hand(robot, function, &names));
    }
    let has_hand = !robot.is_tree();
    let known = |frame: &&str| has_hand && *frame == HAND || names.contains(frame);
    let Some(frame) = function.frames().into_iter().find(|frame| !known(frame)) else {
        return Ok(());
    };
    let fix = match (closest(frame, &names), names.as_slice()) {
        (Some(meant), _) => format!("did you mean `{meant}`?"),
        (None, []) if has_hand => {
            format!("it has `{HAND}`; others are [[frame]] tables of its file")
        }
        (None, []) => "frames are [[frame]] tables of its file".to_owned(),
        (None, names) if has_hand => format!("it has `{HAND}`, `{}`", names.join("`, `")),
        (None, names) => format!("it has `{}`", names.join("`, `")),
    };
    let message = format!("`{}`: the robot has no frame `{frame}`", function.text());
    Err(GenerateError::refused(function, message, fix))
}

fn no_hand(robot: &Robot, function: Function, names: &[&str]) -> GenerateError {
    let text = function.text();
    let tips = robot.tips().len();
    let message = match robot.floating {
        Some(_) => format!("`{text}` needs a hand, but the base of this robot floats"),
        None => {
            format!("`{text}` needs a single hand, but the links of this robot have {tips} ends")
        }
    };
    let name = text.split('@').next().unwrap_or_default();
    let frames = names.join("`, `");
    let fix = match names {
        [] => format!(
            "name an end by a [[frame]] table in the robot file (`name`, `link`, `xyz`, `rpy`), and ask for \
             `{name}@NAME`"
        ),
        [first, ..] => format!("ask for `{name}@{first}`; frames are `{frames}`"),
    };
    GenerateError::refused(function, message, fix)
}

type FunctionsInScalars = (Vec<GeneratedFunction>, Vec<ScalarType>);

/// A tolerance starts from the cheapest exact programs, then from those that cost fewer digits.
fn functions(job: &Job<'_>) -> Outcome<FunctionsInScalars> {
    let request = job.request;
    if job.tolerance().is_none() || request.prefer != Prefer::Accuracy {
        return all_proved(job);
    }
    let mut cheapest = request.clone();
    cheapest.prefer = Prefer::Operations;
    match all_proved(&job.with(&cheapest)) {
        Err(GenerateError::Tolerance(_, Miss::Above, _)) => all_proved(job),
        outcome => outcome,
    }
}

/// Keeps the quick search's function where it is cheaper: an early end is never worse than that.
fn no_dearer_than_quick(
    job: &Job<'_>,
    generated: &mut [GeneratedFunction],
    scalars: &[ScalarType],
) {
    let quick_request = Request {
        effort: Effort::Quick,
        watch: Watch::default(),
        ..job.request.clone()
    };
    // Its bounds are coarser: it may have needed a wider scalar.
    if let Ok((quick, theirs)) = functions(&job.with(&quick_request))
        && theirs == scalars
    {
        for (function, quick) in generated.iter_mut().zip(quick) {
            if price(&quick.program.counts()) < price(&function.program.counts()) {
                *function = quick;
            }
        }
    }
}

fn all_proved(job: &Job<'_>) -> Outcome<FunctionsInScalars> {
    let mut functions = Function::in_order(&job.request.functions);
    if job.setup.has_load() {
        functions.insert(0, Function::Load);
    }
    let proved = |function: &Function| proved(job, *function);
    let outcome: Result<Vec<_>, _> = match job.request.effort {
        Effort::Quick => parallel::each(&functions, proved).into_iter().collect(),
        // One function at a time, so that progress can be shown for each.
        Effort::Thorough => functions.iter().map(proved).collect(),
    };
    let mut functions = outcome?;
    let has_no_lanes = |function: &GeneratedFunction| function.program.loops.is_empty();
    if job.request.limbs == LimbLayout::Lanes && functions.iter().all(has_no_lanes) {
        let message = "`limbs: lanes`: no function has lanes: torques, D, accelerations and slopes have, of limbs \
                       with the same joints whose numbers are zero in the same places";
        return Err(GenerateError::refused(None, message, "leave `limbs` out"));
    }
    let scalars = tolerate(job, &mut functions)?;
    Ok((functions, scalars))
}

fn proved(job: &Job<'_>, function: Function) -> Outcome<GeneratedFunction> {
    let setup = job.setup;
    let wrong = |why: &Diagnostic| GenerateError::Base(function, why.clone());
    let base = setup.base_of(function).map_err(wrong)?;
    let outputs = function.outputs(setup.sizes(function));
    if outputs > MAX_OUTPUTS {
        let message = format!("`{function}` would return {outputs} numbers");
        let help = "ask for `inverse_dynamics`, `inertia`, `coriolis` or `gravity` instead";
        return Err(GenerateError::refused(function, message, help));
    }
    if let Some(base) = base {
        prove_base(setup.task(function), base)
            .map_err(|why| GenerateError::Disproved(function, why))?;
    }
    if function.inverts_inertia()
        && let Some(joint) = without_inertia(setup.task(function))
    {
        let message = format!(
            "D is singular in every state, since {} moves no inertia while the joints after it are \
             free",
            setup.robot().joint_label(joint)
        );
        let help = "give what it moves mass or inertia, or the joint an `armature`, or lock it in a \
                    scene";
        let why = Diagnostic::error(message).with_help(help);
        return Err(GenerateError::Singular(function, why));
    }
    let entry = replay(job, job.request.plan.as_ref(), function)?;
    let entry = entry.filter(|entry| lanes::admits(job, function, &entry.program));
    let planned = entry.is_some();
    let (source, mut passes, program, refused) = match entry {
        Some(entry) => {
            // Widths are the robot's: a plan has none.
            let mut program = entry.program.with_speeds(setup.speeds());
            if !lanes::may_be_lanes(job) {
                program.loops.clear();
            }
            (entry.source, entry.passes, program, None)
        }
        None => found_program(job, function)?,
    };
    let program = without_vain_steps(program);
    if let Some(last) = passes.last_mut() {
        last.counts = program.counts();
    }
    let finished = match job.tolerance() {
        // Errors are bounded, and parts left out of it, first.
        Some(_) => program.clone(),
        None => job.finished(&program),
    };
    let (program, original) = match finished == program {
        true => (program, None),
        false => (finished, Some(program)),
    };
    let proof = prove(setup, &program).map_err(|disproof| match vanishing(setup) {
        Some(value) => {
            let message = format!(
                "`{function}`: the constant {value} is divisible by 2^61 - 1 or 2^61 - 465, modulo \
                 which search and proof tell values apart"
            );
            GenerateError::refused(function, message, "change its last digit")
        }
        None => GenerateError::Disproved(function, disproof),
    })?;
    Ok(GeneratedFunction {
        function,
        source,
        parameters: ParametersKey::find(setup.task(function)),
        planned,
        sines: Vec::new(),
        program,
        found: original,
        passes,
        proof,
        refused,
        admitted: None,
    })
}

/// The checker refuses steps in vain, and plans of earlier versions have some.
fn without_vain_steps(program: Program) -> Program {
    if !program.loops.is_empty() {
        return program;
    }
    let graph = program.dag.without_vain_steps();
    match graph == program.dag {
        true => program,
        false => program.with_graph(&graph),
    }
}

fn read_back(
    job: &Job<'_>,
    tokens: &Result<Text<'_>, Fault>,
    generated: &GeneratedFunction,
    code: &Code,
) -> Outcome<RunnableCode> {
    let request = job.request;
    let scalar = code.scalar;
    let fail = |why| GenerateError::Defect(generated.function, Some(scalar), why);
    let text = tokens.as_ref().map_err(|error| fail(error.to_string()))?;
    let signature = Signature::of(&generated.program, scalar);
    let names = Names::new(&request.module_name(job.robot), request.language, scalar);
    let has_many = request.batch && columns::are_there(signature.function, request.language);
    let read =
        Code::read(text, &signature, &names, has_many).map_err(|error| fail(error.to_string()))?;
    if let Some(difference) = read.difference(code) {
        return Err(fail(difference.to_string()));
    }
    if read.counts() != generated.counts_in(scalar) {
        return Err(fail("the counts of the text differ".to_owned()));
    }
    Ok(RunnableCode {
        function: generated.function,
        scalar,
        sizes: generated.program.sizes(),
        text: read,
    })
}
