//! `dynamics!` as a whole.

use std::path::Path;

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use dalembert_model::read::Diagnostic;
use dalembert_model::robot::Severity;

use super::errors::Errors;
use super::invocation::{self, Invocation};
use super::messages as m;
use super::warnings::Warning;
use super::{RobotFile, RobotFileError, module};
use crate::generate::{GenerateError, Generated, generate_anew};
use crate::plan;
use crate::program::ScalarType;
use crate::task::Request;
use crate::task::in_scene::find;

/// Returns the modules that an invocation asks for, or all of its errors.
///
/// Paths of robot files are relative to `base`.
pub fn expand(input: TokenStream, base: &Path) -> TokenStream {
    expand_from(input, &[base], true)
}

/// Returns [`expand`], where paths of robot files are relative to the first of these folders that
/// has the file, and `has_batch` says whether the crate `dalembert` has its feature `batch`.
pub fn expand_from(input: TokenStream, folders: &[&Path], has_batch: bool) -> TokenStream {
    let mut errors = Errors::default();
    let Some(invocation) = invocation::read(input, &mut errors) else {
        return errors.into_tokens();
    };
    if invocation.request.batch && !has_batch {
        errors.push(&invocation.batch_at, &m::NO_BATCH);
    }
    let (file, watch) = robot(&invocation, folders, &mut errors);
    let modules = file.and_then(|file| modules(&file, &invocation, &mut errors));
    let errors = errors.into_tokens();
    quote!(#watch #errors #modules)
}

/// Reads the robot, from a file or the invocation's own text, and returns what makes an edit of
/// the file, or of its plan, expand the macro again.
fn robot(
    invocation: &Invocation,
    folders: &[&Path],
    errors: &mut Errors,
) -> (Option<RobotFile>, TokenStream) {
    let literal = &invocation.robot;
    let (read, watch) = match invocation.has_text() {
        true => {
            let read = RobotFile::parse(&literal.value(), &invocation.shown());
            (read, TokenStream::new())
        }
        false => file(&literal.value(), folders),
    };
    let file = read.map_err(|error| {
        let help = match &error {
            RobotFileError::Missing { meant: None, .. } => {
                "the path is relative to the folder of Cargo.toml or of the file with the macro"
            }
            _ => "",
        };
        for message in error.messages() {
            errors.say(literal, &message, help);
        }
    });
    (file.ok(), watch)
}

fn file(shown: &str, folders: &[&Path]) -> (Result<RobotFile, RobotFileError>, TokenStream) {
    let mut places = folders.iter().map(|folder| folder.join(shown));
    // A file that is nowhere is missed where it is looked for first.
    let first = places.next().unwrap_or_else(|| shown.into());
    let path = match first.is_file() {
        true => first,
        false => places.find(|path| path.is_file()).unwrap_or(first),
    };
    // Both the robot file and its plan, if it has one. The import of a file that is not there
    // would be a second error.
    let watch = [path.clone(), plan::file::path(&path)];
    let watch = watch.iter().filter_map(|path| path.to_str());
    let watch = watch.filter(|path| Path::new(path).is_file()).map(|path| {
        quote!(
            const _: &[::core::primitive::u8] = ::core::include_bytes!(#path);
        )
    });
    let watch = watch.collect();
    (RobotFile::read_as(&path, shown), watch)
}

/// Generates the modules; `None` after an error.
fn modules(file: &RobotFile, invocation: &Invocation, errors: &mut Errors) -> Option<TokenStream> {
    if invocation.outputs.is_none() && invocation.scene.is_none() && file.outputs.is_empty() {
        errors.push(&invocation.name, &m::NO_OUTPUTS);
    }
    if !errors.is_empty() {
        return None;
    }
    let generated = functions(file, invocation, errors)?;
    let rounding = generated.warnings.into_iter().map(|text| Warning {
        at: invocation.robot.to_token_stream(),
        text,
        help: None,
    });
    let warnings: Vec<Warning> = warnings(file, invocation).chain(rounding).collect();
    module::assemble(&generated.text, invocation, &warnings)
        .map_err(|error| {
            let text = format!("the generated text has no tokens: {error}");
            errors.say(&invocation.name, &text, "");
        })
        .ok()
}

/// Returns the warnings about the robot, at the literal of its path or text: a macro knows no
/// place in another file.
fn warnings<'a>(
    file: &'a RobotFile,
    invocation: &'a Invocation,
) -> impl Iterator<Item = Warning> + 'a {
    let shown = invocation.shown();
    let notes = file.notes.iter();
    let notes = notes.filter(|note| note.severity == Severity::Warning);
    notes.map(move |note: &Diagnostic| Warning {
        at: invocation.robot.to_token_stream(),
        text: format!("{shown}:{}: {}", note.line, note.message),
        help: note.help.clone(),
    })
}

fn functions(file: &RobotFile, invocation: &Invocation, errors: &mut Errors) -> Option<Generated> {
    let scene = match &invocation.scene {
        Some(name) => match find(&file.scenes, &name.to_string()) {
            Ok(scene) => Some(scene),
            Err(error) => {
                errors.say(name, &error.message(), &error.help());
                return None;
            }
        },
        None => None,
    };
    let outputs = invocation.outputs.as_ref();
    let outputs = outputs.map(|chosen| chosen.iter().map(|(f, _)| *f).collect());
    let asked = &invocation.request;
    let request = Request {
        scalars: vec![ScalarType::F64],
        plan: file.plan.clone(),
        parameters: invocation.parameters.iter().map(|(p, _)| *p).collect(),
        module: Some(invocation.name.to_string()),
        work: Request::work_while_compiling(asked.effort),
        ..asked.clone()
    };
    let request = request.for_file(&file.outputs);
    let request = request.choose(outputs, invocation.scalars.clone(), scene);
    generate_anew(&file.robot, &request, &invocation.shown())
        .map_err(|error| {
            let function = error.function();
            let asked = invocation.outputs.iter().flatten();
            let at = asked
                .filter(|(output, _)| Some(*output) == function)
                .map(|(_, tokens)| tokens.clone())
                .next();
            let asked = match &error {
                GenerateError::Parameter(_) => invocation.parameters.first(),
                _ => None,
            };
            let at = at.or_else(|| asked.map(|(_, tokens)| tokens.clone()));
            let at = at.unwrap_or_else(|| invocation.robot.to_token_stream());
            errors.say(at, &error.to_string(), "");
        })
        .ok()
}
