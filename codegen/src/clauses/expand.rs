//! `dynamics!` as a whole.

use std::path::Path;

use proc_macro2::{Group, Ident, TokenStream};
use quote::{ToTokens, quote};
use syn::LitStr;

use dalembert_model::read::Diagnostic;
use dalembert_model::robot::{Robot, Severity};
use dalembert_model::scene::Scene;

use super::errors::Errors;
use super::invocation::{self, Invocation, RobotSource};
use super::messages as m;
use super::warnings::Warning;
use super::{RobotFile, RobotFileError, module, stub, table};
use crate::function::Function;
use crate::generate::{GenerateError, Generated, generate_anew};
use crate::language::Entries;
use crate::plan::{self, Plan};
use crate::program::ScalarType;
use crate::task::Request;
use crate::task::in_scene::find;

/// Returns the modules that an invocation asks for, or everything that is wrong with
/// it next to modules whose functions have no bodies.
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
    if invocation.request.entries == Entries::Batch && !has_batch {
        errors.push(&invocation.entries_at, &m::NO_BATCH);
    }
    let source = source(&invocation, folders, &mut errors);
    if invocation.outputs.is_none() && invocation.scene.is_none() && source.outputs.is_empty() {
        errors.push(&invocation.name, &m::NO_OUTPUTS);
    }
    let generated = match &source.robot {
        Some(robot) if errors.is_empty() => functions(robot, &source, &invocation, &mut errors),
        _ => None,
    };
    let (text, warnings) = match generated {
        Some(generated) => {
            let rounding = generated.warnings.into_iter().map(|text| Warning {
                at: invocation.place(),
                text,
                help: None,
            });
            let warnings = source.warnings.into_iter().chain(rounding).collect();
            (generated.text, warnings)
        }
        None => (stub::write(&invocation, source.joints), Vec::new()),
    };
    let modules =
        module::assemble(&text, &invocation, &warnings, has_batch).unwrap_or_else(|error| {
            let text = format!("the generated text has no tokens: {error}");
            errors.say(&invocation.name, &text, "");
            TokenStream::new()
        });
    let (watch, errors) = (source.watch, errors.into_tokens());
    quote!(#watch #errors #modules)
}

/// The robot and what goes with it.
#[derive(Default)]
struct Source {
    robot: Option<Robot>,
    outputs: Vec<Function>,
    scenes: Vec<Scene>,
    joints: Option<usize>,
    warnings: Vec<Warning>,
    plan: Option<Plan>,
    /// Makes an edit of the robot file, or its plan, expand the macro again.
    watch: TokenStream,
}

fn source(invocation: &Invocation, folders: &[&Path], errors: &mut Errors) -> Source {
    match &invocation.robot {
        RobotSource::File(path) => file(path, folders, invocation, errors),
        RobotSource::Table(block) => {
            let read = table::read(&invocation.name, block, written(invocation), errors);
            let in_range = (1..=Robot::MAX_JOINTS).contains(&read.joints);
            Source {
                robot: read.robot,
                outputs: read.outputs,
                scenes: read.scenes,
                joints: in_range.then_some(read.joints),
                warnings: read.warnings,
                plan: None,
                watch: TokenStream::new(),
            }
        }
    }
}

/// Returns the scene that stands in the invocation.
fn written(invocation: &Invocation) -> Option<(&Ident, &Group)> {
    let (name, body) = invocation.scene.as_ref()?;
    Some((name, body.as_ref()?))
}

fn file(
    literal: &LitStr,
    folders: &[&Path],
    invocation: &Invocation,
    errors: &mut Errors,
) -> Source {
    let shown = literal.value();
    let mut places = folders.iter().map(|folder| folder.join(&shown));
    // What is nowhere is missed where it is looked for first.
    let first = places.next().unwrap_or_else(|| shown.clone().into());
    let path = match first.is_file() {
        true => first,
        false => places.find(|path| path.is_file()).unwrap_or(first),
    };
    // Both the robot file and its plan, if it has one.
    let watch = [path.clone(), plan::file::path(&path)];
    let watch = watch.iter().filter_map(|path| path.to_str());
    let watch = watch.filter(|path| path_exists(path)).map(|path| {
        quote!(
            const _: &[::core::primitive::u8] = ::core::include_bytes!(#path);
        )
    });
    let watch: TokenStream = watch.collect();
    match RobotFile::read_as(&path, &shown) {
        Ok(file) => Source {
            joints: Some(file.robot.joints.len()),
            warnings: warnings(&file, literal),
            scenes: match written(invocation) {
                Some((name, body)) => table::beside(&file.source, name, body, errors),
                None => file.scenes,
            },
            robot: Some(file.robot),
            outputs: file.outputs,
            plan: file.plan,
            watch,
        },
        Err(error) => {
            let help = match &error {
                RobotFileError::Missing { meant: None, .. } => {
                    "the path is relative to the folder of Cargo.toml or of the file with the macro"
                }
                _ => "",
            };
            for message in error.messages() {
                errors.say(literal, &message, help);
            }
            Source {
                joints: error.joints(),
                watch,
                ..Source::default()
            }
        }
    }
}

/// Returns whether there is such a file: the import of one that is not would be a second error.
fn path_exists(path: &str) -> bool {
    Path::new(path).is_file()
}

/// Returns what is odd about the robot in the file, at the file's name: a macro knows
/// no place in another file.
fn warnings(file: &RobotFile, literal: &LitStr) -> Vec<Warning> {
    let shown = literal.value();
    let odd = file.notes.iter();
    let odd = odd.filter(|note| note.severity == Severity::Warning);
    let warning = |note: &Diagnostic| Warning {
        at: literal.to_token_stream(),
        text: format!("{shown}:{}: {}", note.line, note.message),
        help: note.help.clone(),
    };
    odd.map(warning).collect()
}

fn functions(
    robot: &Robot,
    source: &Source,
    invocation: &Invocation,
    errors: &mut Errors,
) -> Option<Generated> {
    let scene = match &invocation.scene {
        Some((name, _)) => match find(&source.scenes, &name.to_string()) {
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
        plan: source.plan.clone(),
        math: module::math(asked.sincos),
        traits: module::TRAITS.to_owned(),
        parameters: invocation.parameters.iter().map(|(p, _)| *p).collect(),
        batch: module::BATCH.to_owned(),
        module: Some(invocation.name.to_string()),
        work: Request::work_while_compiling(asked.effort),
        ..asked.clone()
    };
    let request = request.for_file(&source.outputs);
    let request = request.choose(outputs, invocation.scalars.clone(), scene);
    let shown = match &invocation.robot {
        RobotSource::File(path) => path.value(),
        RobotSource::Table(_) => String::new(),
    };
    generate_anew(robot, &request, &shown)
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
            let at = at.unwrap_or_else(|| invocation.place());
            errors.say(at, &error.to_string(), "");
        })
        .ok()
}
