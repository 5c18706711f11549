//! `dalembert renew`: generated files made new from their own first lines, or compared with what
//! would be generated.

use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::Language;
use dalembert_stamp::Stamp;
use serde_json::json;

use crate::args::RenewArgs;
use crate::files::target::Target;
use crate::files::write::write;
use crate::generate::certificates;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress};

/// The longest file that is read.
const MAX_BYTES: u64 = 1 << 28;

/// A generated file.
struct Found {
    path: PathBuf,
    text: String,
    stamp: Stamp,
    language: Language,
}

/// A text for a file: the code, or the certificates beside it.
struct New {
    path: PathBuf,
    text: String,
    /// The first line in which the file that is there differs; none where it is the same.
    differs: Option<usize>,
}

/// Runs the subcommand.
pub fn run(args: &RenewArgs) -> Outcome {
    let files = found(&args.files)?;
    let (mut texts, mut failed) = (Vec::new(), Vec::new());
    for file in &files {
        match renewed(file) {
            Ok(own) => texts.extend(own),
            Err(Failure::Input(why) | Failure::Check(why)) => {
                failed.push(format!(
                    "{why}\n  = note: to renew `{}`",
                    file.path.display()
                ));
            }
        }
    }
    if !failed.is_empty() {
        return Err(Failure::Input(failed.join("\n\n")));
    }
    let stale: Vec<&New> = texts.iter().filter(|new| new.differs.is_some()).collect();
    if !args.check {
        let targets: Result<Vec<Target>, Failure> =
            stale.iter().map(|new| Target::at(&new.path)).collect();
        let targets = targets?;
        let outputs = targets.iter().zip(&stale);
        let outputs: Vec<(&Target, &str)> = outputs
            .map(|(target, new)| (target, new.text.as_str()))
            .collect();
        write(&outputs)?;
    }
    report(args, &texts)?;
    let lines = stale.iter().filter(|_| args.check).map(|new| {
        let (path, line) = (new.path.display(), new.differs.unwrap_or(1));
        format!("error: {path}:{line}: the file is not what would be generated")
    });
    let lines: Vec<String> = lines.collect();
    match lines.is_empty() {
        true => Ok(()),
        false => Err(Failure::Check(format!(
            "{}\n  = help: dalembert renew, without --check, writes what would be",
            lines.join("\n")
        ))),
    }
}

fn report(args: &RenewArgs, texts: &[New]) -> Outcome {
    let became = |new: &New| match (new.differs.is_some(), args.check) {
        (false, _) => "up to date",
        (true, false) => "renewed",
        (true, true) => "stale",
    };
    if args.json {
        let files = texts.iter().map(|new| {
            json!({ "file": new.path.display().to_string(), "became": became(new), "line": new.differs })
        });
        return output::print_json(&json!({ "files": files.collect::<Vec<_>>() }));
    }
    let lines = texts
        .iter()
        .map(|new| format!("{}: {}\n", new.path.display(), became(new)));
    output::print(&lines.collect::<String>())
}

/// Returns the files that were named, or all with a stamp in this folder and below it.
fn found(named: &[PathBuf]) -> Result<Vec<Found>, Failure> {
    let mut all = Vec::new();
    for path in named {
        let bytes = input::bytes(path, MAX_BYTES)?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let own = stamped(path, text).ok_or_else(|| {
            Failure::Input(format!(
                "error: `{}` does not begin as a file that this dalembert generates\n  = help: \
                 `dalembert generate ROBOT.toml -o {0}` writes one that does",
                path.display()
            ))
        });
        all.push(own?);
    }
    if named.is_empty() {
        walk(Path::new("."), &mut all)?;
        if all.is_empty() {
            return Err(Failure::Input(
                "error: there is no generated file in this folder or below it\n  = help: `dalembert \
                 generate ROBOT.toml -o FILE` writes one"
                    .into(),
            ));
        }
    }
    Ok(all)
}

fn stamped(path: &Path, text: String) -> Option<Found> {
    let (stamp, _) = Stamp::read(&text)?;
    Some(Found {
        path: path.to_owned(),
        language: Language::of(path).ok()?,
        text,
        stamp,
    })
}

/// Adds the generated files of a folder and of those below it, in the order of their names; hidden
/// ones, links and build folders are left out.
fn walk(folder: &Path, all: &mut Vec<Found>) -> Outcome {
    let fail = |error| Failure::Input(format!("error: `{}`: {error}", folder.display()));
    let entries = fs::read_dir(folder).map_err(fail)?;
    let mut entries: Vec<fs::DirEntry> = entries.flatten().collect();
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let (name, path) = (entry.file_name(), entry.path());
        let name = name.to_string_lossy();
        let Ok(kind) = entry.file_type() else {
            continue;
        };
        if kind.is_dir() && !name.starts_with('.') && name != "target" && name != "node_modules" {
            walk(&path, all)?;
        }
        if kind.is_file() && Language::of(&path).is_ok() {
            // What cannot be read is nobody's here.
            let text = input::first(&path, MAX_BYTES).unwrap_or_default();
            let path = path.strip_prefix(".").unwrap_or(&path);
            all.extend(stamped(path, String::from_utf8_lossy(&text).into_owned()));
        }
    }
    Ok(())
}

/// Generates a file anew by its own stamp.
fn renewed(file: &Found) -> Result<Vec<New>, Failure> {
    let folder = file.path.parent().unwrap_or(Path::new(""));
    let robot = folder.join(&file.stamp.robot);
    let wanted = input::wanted(&robot, &file.stamp.asked, file.language.scalars())?;
    let mut request = wanted.request;
    request.language = file.language;
    let session = progress::watch(&mut request);
    let generated = input::generated(&robot, &wanted.robot, &request)?;
    drop(session);
    for warning in &generated.warnings {
        output::note(&format!("warning: {warning}"));
    }
    let code = generated.files(&request, &file.stamp.robot, &wanted.source);
    let code = code.into_iter().next().unwrap_or_default();
    let mut new = vec![New {
        path: file.path.clone(),
        differs: difference(&file.text, &code),
        text: code,
    }];
    if let Some(text) = certificates(&generated) {
        let path = file.path.with_extension("certificate.json");
        let old = fs::read_to_string(&path).unwrap_or_default();
        let differs = difference(&old, &text);
        new.push(New {
            path,
            text,
            differs,
        });
    }
    Ok(new)
}

/// Returns the first line, from one, in which two texts differ; line ends may be of either kind.
fn difference(old: &str, new: &str) -> Option<usize> {
    let old = old.replace("\r\n", "\n");
    if old == new {
        return None;
    }
    let same = old.bytes().zip(new.bytes());
    let same = same.take_while(|(a, b)| a == b);
    Some(same.filter(|(byte, _)| *byte == b'\n').count() + 1)
}
