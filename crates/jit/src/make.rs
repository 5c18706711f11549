//! Generates the functions of a robot: reads it, searches, proves and prints.

use std::path::Path;

use dalembert_codegen::workspace::{claim, generate_anew, input_hash, keep};
use dalembert_codegen::{GeneratedCode, Plan, generate};
use dalembert_import::{Snap, Text};
use dalembert_model::read::{self, Reading};

use crate::cache::{self, CachedFunction, Entry, Folder};
use crate::error::Error;
use crate::request::Load;

pub(crate) fn read_robot(source: &str, name: &str) -> Result<Reading, Error> {
    read::parse(source).map_err(|errors| errors.in_file(name).into())
}

pub(crate) fn make_entry(
    source: &Text,
    plan: Option<Plan>,
    load: &Load,
    folder: Option<&Folder>,
) -> Result<Entry, Error> {
    let name = source.name();
    let mut options = load.urdf.clone();
    if options.file.is_empty() {
        let file = Path::new(name).file_name().unwrap_or(name.as_ref());
        options.file = file.to_string_lossy().into_owned();
    }
    let opened = dalembert_import::read_robot(source.clone(), &options)?;
    let mut notes = opened.notes();
    if let Some(imported) = &opened.imported {
        for snap in imported.snaps.iter().filter(|snap| snap.changes) {
            let (name, line) = source.line(snap.span.start);
            notes.push(format!("{name}:{line}: {snap}"));
        }
        notes.extend(Snap::counted(&imported.snaps));
    }
    let reading = opened.reading;
    let mut request = load.request(&reading)?;
    let key = cache::plan_key(&input_hash(&reading.robot), load);
    let kept = folder.and_then(|folder| folder.plan(&key));
    let generated = match plan {
        Some(plan) => {
            request.plan = Some(plan);
            generate_anew(&reading.robot, &request, name)
        }
        None => {
            request.plan = kept.clone();
            generate(&reading.robot, &request).or_else(|error| {
                // A scene of the same name was another one when its programs were kept.
                request.plan.take().ok_or(error)?;
                generate(&reading.robot, &request)
            })
        }
    };
    let generated = generated?;
    let plan = keep(&reading.robot, &request, &generated, kept).plan;
    if let Some(folder) = folder.filter(|_| !generated.ended) {
        folder.keep_plan(&key, &plan);
    }
    notes.extend(generated.warnings.iter().cloned());
    let claim = claim(&reading.robot, &opened.robot_file, &request, &generated)?;
    Ok(Entry {
        robot: opened.robot_file,
        notes,
        functions: proved(&generated),
        claim: claim.write(),
        plan: plan.write(),
        rust: generated.texts,
        ended: generated.ended,
    })
}

fn proved(generated: &GeneratedCode) -> Vec<CachedFunction> {
    let functions = &generated.functions;
    // File by file.
    let emitted = generated.emitted.iter().enumerate();
    let both = emitted.zip(functions.iter().cycle());
    let file = |index: usize| index / functions.len();
    both.map(|((index, code), function)| CachedFunction::of(file(index), function, code))
        .collect()
}
