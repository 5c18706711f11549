//! Inputs: robots, requests and other files.

use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::{generate_anew, plan_file};
use dalembert_codegen::{
    Asked, Diagnostics, Function, GeneratedCode, Request, ScalarType, unreadable,
};
use dalembert_import::{ChainArgs, OpenError, Options, first_bytes, open};
use dalembert_model::diagnostic::{Diagnostic, Place};
use dalembert_model::number::Rational;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use crate::args::as_flags;
use crate::output::{Context, Failure};
use crate::progress;

/// A robot from a robot file, a URDF or an MJCF.
pub struct Source {
    pub path: PathBuf,
    pub robot: Robot,
    pub scenes: Vec<Scene>,
    /// The functions of a request that names none: those that the robot file lists, if it lists any.
    pub outputs: Vec<Function>,
    /// The text of the file, and the text of the robot as a robot file.
    pub text: String,
    pub robot_file: String,
    /// True if the file is a URDF or an MJCF.
    pub is_model: bool,
    chain: ChainArgs,
}

impl Source {
    /// Opens a robot and prints its warnings, and what the arm has otherwise than the model that it
    /// is a chain of.
    pub fn open(context: &Context, path: &Path, chain: &ChainArgs) -> Result<Source, Failure> {
        let opened =
            open(path, &chain.choose(defaults(path))).map_err(|error| unopened(path, error))?;
        let is_model = opened.imported.is_some();
        for note in opened.notes() {
            // A model has many notes; `import` prints them.
            if !is_model || note.starts_with("warning") {
                context.say(&note);
            }
        }
        if is_model {
            say_notes(context, &opened.reading.robot);
        }
        context.undenied()?;
        let reading = opened.reading;
        Ok(Source {
            path: path.to_owned(),
            robot: reading.robot,
            scenes: reading.scenes,
            outputs: reading.outputs,
            text: opened.source.as_str().to_owned(),
            robot_file: opened.robot_file,
            is_model,
            chain: chain.clone(),
        })
    }

    /// Parses options to a request. Without a scalar option it asks for `scalars`; it has the plan
    /// beside the robot file unless the options turn plans off; a model has none.
    pub fn request(&self, asked: &Asked, scalars: &[ScalarType]) -> Result<Request, Failure> {
        let mut request = Request::parse(asked, scalars, &self.robot, &self.outputs, &self.scenes)
            .map_err(|problems| Failure::Input(problems_of(&problems)))?;
        request.chain = self.chain.pairs();
        if !request.has_no_plan && !self.is_model {
            request.plan = plan_file::beside(&self.path).map_err(Failure::input)?;
        }
        Ok(request)
    }

    /// Generates code, watched by the bar and Ctrl-C, and prints its warnings, for example that the plan no longer fits.
    pub fn generate(
        &self,
        context: &Context,
        request: &mut Request,
    ) -> Result<GeneratedCode, Failure> {
        let _session = progress::watch(request);
        let shown = self.path.display().to_string();
        let generated = generate_anew(&self.robot, request, &shown)?;
        for warning in &generated.warnings {
            context.say(&format!("warning: {warning}"));
        }
        Ok(generated)
    }
}

pub fn say_notes(context: &Context, robot: &Robot) {
    for note in &robot.notes {
        context.say(&format!("note: {note}"));
    }
}

/// The limit of acceleration where none is given, rad/s² or m/s².
pub const ACCELERATION: i64 = 10;

pub fn defaults(path: &Path) -> Options {
    let name = path.file_name().unwrap_or_default();
    Options {
        acceleration: Some(Rational::from_integer(ACCELERATION.into())),
        file: name.to_string_lossy().into_owned(),
        ..Options::default()
    }
}

pub fn unopened(path: &Path, error: OpenError) -> Failure {
    match error {
        OpenError::System(error) => system(path, &error),
        OpenError::Wrong(errors) => Failure::Input(errors.render()),
    }
}

fn problems_of(problems: &Diagnostics) -> String {
    let one = |problem: &Diagnostic| {
        let plain = problem.clone().at(Place::None);
        let flagged = match &problem.place {
            Place::Option(option, _) => plain.within(format!("--{}", option.replace('_', "-"))),
            _ => plain,
        };
        as_flags(flagged.render().trim_end())
    };
    problems.0.iter().map(one).collect::<Vec<_>>().join("\n\n")
}

/// Returns the text of a whole file of at most so many bytes.
pub fn text(path: &Path, most: u64) -> Result<String, Failure> {
    let bytes = first_bytes(path, most + 1).map_err(|error| system(path, &error))?;
    let shown = path.display();
    if bytes.len() as u64 > most {
        let most = most >> 20;
        let why = format!("`{shown}` is longer than {most} MiB, the limit");
        return Err(Failure::input(why));
    }
    let no_text = |_| Failure::input(format!("`{shown}` is not UTF-8 text"));
    String::from_utf8(bytes).map_err(no_text)
}

fn system(path: &Path, error: &std::io::Error) -> Failure {
    let shown = path.display().to_string();
    let said = unreadable(path, &shown, error).render();
    let said = said.trim_end();
    let whole = std::path::absolute(path).ok();
    Failure::Input(match whole.filter(|_| path.is_relative()) {
        Some(whole) => format!("{said}\n  = note: its full path is `{}`", whole.display()),
        None => said.to_owned(),
    })
}
