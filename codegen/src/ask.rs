//! The entry point of the macro and of build scripts, which keep a compiler waiting: a robot file
//! and the options of a request, as one text.

use dalembert_model::diagnostic::{Diagnostic, Diagnostics, Place, Severity};
use dalembert_stamp::Asked;

use crate::generate::{GeneratedCode, generate_anew};
use crate::language::Language;
use crate::robot_file::RobotFile;
use crate::task::{GenerateError, Request};

/// The code that was asked of a robot file.
#[derive(Clone, Debug)]
pub struct AskedCode {
    /// The request that was read.
    pub request: Request,
    /// The code.
    pub generated: GeneratedCode,
    /// Warnings about the robot and its code: a sentence each, and a line with the likely fix.
    pub warnings: Vec<String>,
}

/// Generates what is asked of a robot file, by the plan beside it if there is one; messages call
/// the file by this name. Code that takes minutes to find is refused.
///
/// # Errors
/// Every mistake in what is asked, or why it cannot be had.
pub fn ask(
    file: &RobotFile,
    asked: &Asked,
    language: Language,
    shown: &str,
) -> Result<AskedCode, Diagnostics> {
    let scalars = language.scalars();
    let mut request = Request::parse(asked, scalars, &file.robot, &file.outputs, &file.scenes)?;
    request.language = language;
    request.work = Request::work_while_compiling(request.effort);
    if !request.has_no_plan {
        request.plan = file.plan.clone();
    }
    let generated =
        generate_anew(&file.robot, &request, shown).map_err(|error| placed(&error, &request))?;
    let is_warning = |note: &&Diagnostic| note.severity == Severity::Warning;
    let mut warnings = Vec::new();
    for note in file.notes.iter().filter(is_warning) {
        let help = note.help.iter().map(|help| format!("\n  = help: {help}"));
        let (line, help) = (note.line().unwrap_or_default(), help.collect::<String>());
        warnings.push(format!("{shown}:{line}: {}{help}", note.message));
    }
    let rounding = generated.warnings.iter();
    warnings.extend(rounding.map(|said| format!("{shown}: {said}")));
    Ok(AskedCode {
        request,
        generated,
        warnings,
    })
}

fn placed(error: &GenerateError, request: &Request) -> Diagnostic {
    let place = match (error, error.function()) {
        (GenerateError::Parameter(..), _) => {
            let first = request.parameters.first();
            let name = first.map_or("", |parameter| parameter.name());
            Place::Option("parameters", name.to_owned())
        }
        (GenerateError::SinCos(..), _) if request.sincos_error.is_some() => {
            Place::Option("sincos_error", String::new())
        }
        (_, Some(function)) if request.functions.contains(&function) => {
            Place::Option("outputs", function.text())
        }
        _ => Place::None,
    };
    Diagnostic::error(error.to_string()).at(place)
}
