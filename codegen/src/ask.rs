//! The way in of those that keep a compiler waiting, the macro and build scripts: a robot file
//! and what is asked, as one text.

use dalembert_model::robot::Severity;
use dalembert_stamp::Asked;

use crate::generate::{GenerateError, GeneratedCode, generate_anew};
use crate::language::Language;
use crate::robot_file::RobotFile;
use crate::task::Request;
use crate::task::options::Problem;
use crate::words::complaint;

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
) -> Result<AskedCode, Vec<Problem>> {
    let scalars = language.scalars();
    let mut request = Request::parse(asked, scalars, &file.robot, &file.outputs, &file.scenes)?;
    request.language = language;
    request.work = Request::work_while_compiling(request.effort);
    if !request.has_no_plan {
        request.plan = file.plan.clone();
    }
    let generated = generate_anew(&file.robot, &request, shown)
        .map_err(|error| vec![Problem::from_error(&error, &request)])?;
    let notes = file
        .notes
        .iter()
        .filter(|note| note.severity == Severity::Warning);
    let mut warnings: Vec<String> = notes
        .map(|note| {
            let help = note
                .help
                .as_ref()
                .map(|help| format!("\n  = help: {help}"))
                .unwrap_or_default();
            format!("{shown}:{}: {}{help}", note.line, note.message)
        })
        .collect();
    let rounding = generated.warnings.iter();
    warnings.extend(rounding.map(|said| format!("{shown}: {said}")));
    Ok(AskedCode {
        request,
        generated,
        warnings,
    })
}

impl Problem {
    fn from_error(error: &GenerateError, request: &Request) -> Problem {
        let (option, item) = match (error, error.function()) {
            (GenerateError::Parameter(..), _) => {
                let first = request.parameters.first();
                (
                    "parameters",
                    first.map_or("", |parameter| parameter.name()).to_owned(),
                )
            }
            (GenerateError::SinCos(..), _) if request.sincos_error.is_some() => {
                ("sincos_error", String::new())
            }
            (_, Some(function)) if request.functions.contains(&function) => {
                ("outputs", function.text())
            }
            _ => ("", String::new()),
        };
        Problem {
            option,
            item,
            complaint: complaint(error.to_string()),
        }
    }
}
