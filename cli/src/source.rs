//! Inputs: a robot of a path, what is asked of it, and other files.

use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::{generate_anew, plan_file};
use dalembert_codegen::{
    Asked, Function, Generated, Plan, Problem, Request, RobotFileError, ScalarType,
};
use dalembert_import::{Opened, Options, Unopened, open};
use dalembert_model::read::Reading;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use crate::files::first;
use crate::import::ChainArgs;
use crate::output::{Context, Failure};

/// A robot of a path: a robot file, a URDF or an MJCF.
#[derive(Clone)]
pub struct Source {
    pub path: PathBuf,
    pub robot: Robot,
    pub scenes: Vec<Scene>,
    /// The functions that the robot file is for; none if it does not say.
    pub outputs: Vec<Function>,
    /// The text of the file, and as a robot file.
    pub text: String,
    pub robot_file: String,
    /// Whether the file is a URDF or an MJCF.
    pub is_model: bool,
}

impl Source {
    /// Opens a robot; its warnings are said.
    ///
    /// # Errors
    /// The file cannot be read, everything that is wrong with it, or its warnings are denied.
    pub fn open(context: &Context, path: &Path) -> Result<Source, Failure> {
        let opened = opened(path, &ChainArgs::default().options(path))?;
        let is_model = opened.imported.is_some();
        for note in opened.notes() {
            // Of a model there is much to say, which `import` says.
            if !is_model || note.starts_with("warning") {
                context.say(&note);
            }
        }
        if is_model {
            let path = path.display();
            context.say(&format!(
                "note: `{path}` is read as `dalembert import {path}` reads it, which says what it changes"
            ));
        }
        context.undenied()?;
        let Reading {
            robot,
            outputs,
            scenes,
            ..
        } = opened.reading;
        Ok(Source {
            path: path.to_owned(),
            robot,
            scenes,
            outputs,
            text: opened.source.as_str().to_owned(),
            robot_file: opened.robot_file,
            is_model,
        })
    }

    /// Reads what is asked of the robot, in these scalars where nobody says which; with the plan
    /// beside the robot file, unless that is to be left alone.
    ///
    /// # Errors
    /// Every mistake, flag by flag, or the plan cannot be read.
    pub fn request(&self, asked: &Asked, scalars: &[ScalarType]) -> Result<Request, Failure> {
        let request = Request::parse(asked, scalars, &self.outputs, &self.scenes);
        let mut request = request.map_err(|problems| Failure::Input(problems_of(&problems)))?;
        if !request.has_no_plan {
            request.plan = self.plan()?;
        }
        Ok(request)
    }

    /// Reads what is asked of a function or a few: those that are named, or of the scene, or these.
    ///
    /// # Errors
    /// Those of [`Source::request`].
    pub fn request_for(&self, asked: &Asked, functions: &[Function]) -> Result<Request, Failure> {
        let named = Source {
            outputs: functions.to_vec(),
            ..self.clone()
        };
        named.request(asked, &ScalarType::ALL)
    }

    /// Returns the plan beside a robot file.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn plan(&self) -> Result<Option<Plan>, Failure> {
        match self.is_model {
            true => Ok(None),
            false => plan_file::beside(&self.path)
                .map_err(|message| Failure::Input(format!("error: {message}"))),
        }
    }

    /// Generates code, and says its warnings; a plan that no longer fits is one.
    ///
    /// # Errors
    /// Those of generating.
    pub fn generate(&self, context: &Context, request: &Request) -> Result<Generated, Failure> {
        let shown = self.path.display().to_string();
        let generated = generate_anew(&self.robot, request, &shown)?;
        for warning in &generated.warnings {
            context.say(&format!("warning: {warning}"));
        }
        Ok(generated)
    }
}

/// Opens a robot; of a model, the chain that the options choose.
///
/// # Errors
/// The file cannot be read, or everything that is wrong with it.
pub fn opened(path: &Path, options: &Options) -> Result<Opened, Failure> {
    open(path, options).map_err(|error| match error {
        Unopened::System(error) => system(path, &error),
        Unopened::Wrong(why) => Failure::Input(why),
    })
}

/// Says what is wrong with what was asked, flag by flag.
fn problems_of(problems: &[Problem]) -> String {
    let one = |problem: &Problem| {
        let flag = problem.option.replace('_', "-");
        let help = match problem.help.as_str() {
            "" => String::new(),
            help => format!("\n  = help: {help}"),
        };
        format!("error: --{flag}: {}{help}", problem.message)
    };
    problems.iter().map(one).collect::<Vec<_>>().join("\n\n")
}

/// Returns the text of a whole file.
///
/// # Errors
/// It cannot be read, is longer than `most`, or is no text.
pub fn text(path: &Path, most: u64) -> Result<String, Failure> {
    let bytes = first(path, most + 1).map_err(|error| system(path, &error))?;
    let shown = path.display();
    if bytes.len() as u64 > most {
        return Err(Failure::Input(format!(
            "error: `{shown}` is longer than {} MiB, the most that is read",
            most >> 20
        )));
    }
    let no_text = |_| Failure::Input(format!("error: `{shown}` is not UTF-8 text"));
    String::from_utf8(bytes).map_err(no_text)
}

/// Says what the system says of a path, in the words of every way in.
pub fn system(path: &Path, error: &std::io::Error) -> Failure {
    let shown = path.display().to_string();
    let said = RobotFileError::of_system(path, &shown, error).to_string();
    let whole = std::path::absolute(path).ok();
    Failure::Input(match whole.filter(|_| path.is_relative()) {
        Some(whole) => format!("{said}\n  = note: its full path is `{}`", whole.display()),
        None => said,
    })
}
