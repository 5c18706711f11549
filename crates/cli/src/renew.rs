//! `dalembert renew`: regenerates files from the options in their first lines, or compares them
//! with what would be generated.

use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::Language;
use dalembert_codegen::workspace::claim;
use dalembert_import::{ChainArgs, first_bytes};
use dalembert_stamp::Stamp;

use crate::certify::claim_of;
use crate::files::{Files, MAX_BYTES};
use crate::new::{EXPECTED, expected};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Report, Table, cells};
use crate::source::{Source, text};

/// Arguments of `renew`.
#[derive(Debug, clap::Args)]
pub struct RenewArgs {
    /// The generated files [default: all in this folder and below it]
    files: Vec<PathBuf>,
    /// Write nothing, and exit with 1 if a file is out of date
    #[arg(long)]
    check: bool,
}

struct StampedFile {
    path: PathBuf,
    text: String,
    stamp: Stamp,
    language: Language,
}

struct New {
    path: PathBuf,
    text: String,
    /// The first line in which the existing file differs; `None` if it is the same.
    differs: Option<usize>,
}

pub(crate) fn run(args: &RenewArgs, context: &Context) -> Outcome {
    let files = stamped_files(&args.files)?;
    let (mut texts, mut failed) = (Vec::new(), Vec::new());
    for file in &files {
        match renewed(context, file) {
            // Both scalars have one claim.
            Ok(renewals) => renewals.into_iter().for_each(|new| {
                if !texts.iter().any(|other: &New| other.path == new.path) {
                    texts.push(new);
                }
            }),
            Err(Failure::Input(why) | Failure::Check(why)) => {
                let path = file.path.display();
                failed.push(format!("{why}\n  = note: to renew `{path}`"));
            }
        }
    }
    if !failed.is_empty() {
        return Err(Failure::Input(failed.join("\n\n")));
    }
    let mut report = Report::default();
    let mut table = Table::new("file|became|line");
    for new in &texts {
        let became = match (new.differs.is_some(), args.check) {
            (false, _) => "up to date",
            (true, false) => "renewed",
            (true, true) => "stale",
        };
        let path = new.path.display().to_string();
        report.line(format!("{path}: {became}"));
        table.row(cells![path, became, Cell::json(new.differs)]);
    }
    report.value("files", table.json());
    let mut done = Done::from(report);
    texts.retain(|new| new.differs.is_some());
    if !args.check {
        let mut files = Files::new(context, &[]);
        for new in texts {
            stays(&new.path)?;
            done.files.push((files.add(&new.path)?, new.text));
        }
        return Ok(done);
    }
    for new in &texts {
        let (path, line) = (new.path.display(), new.differs.unwrap_or(1));
        let why = format!("error: {path}:{line}: the file is out of date");
        done.failed.push(why);
    }
    if !texts.is_empty() {
        let help = "  = help: run `dalembert renew` without --check to update it";
        done.failed.push(help.into());
    }
    Ok(done)
}

fn stamped_files(paths: &[PathBuf]) -> Result<Vec<StampedFile>, Failure> {
    let mut files = Vec::new();
    for path in paths {
        let file = stamped(path, text(path, MAX_BYTES)?).ok_or_else(|| {
            Failure::Input(format!(
                "error: `{}` lacks the first lines of a file that this version of dalembert generates\n  = help: \
                 `dalembert generate ROBOT.toml -o {0}` writes such a file",
                path.display()
            ))
        });
        files.push(file?);
    }
    if paths.is_empty() {
        walk(Path::new("."), &mut files)?;
        if files.is_empty() {
            let why = "there is no generated file in this folder or below it\n  = help: `dalembert \
                 generate ROBOT.toml -o FILE` writes one";
            return Err(Failure::input(why));
        }
    }
    Ok(files)
}

fn stamped(path: &Path, text: String) -> Option<StampedFile> {
    let (stamp, _) = Stamp::read(&text)?;
    Some(StampedFile {
        path: path.to_owned(),
        language: Language::of(path).ok()?,
        text,
        stamp,
    })
}

/// Leaves out hidden folders, build folders and links.
fn walk(folder: &Path, files: &mut Vec<StampedFile>) -> Result<(), Failure> {
    let fail = |error| Failure::Input(format!("error: `{}`: {error}", folder.display()));
    let mut entries: Vec<fs::DirEntry> = fs::read_dir(folder).map_err(fail)?.flatten().collect();
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let (name, path) = (entry.file_name(), entry.path());
        let name = name.to_string_lossy();
        let Ok(kind) = entry.file_type() else {
            continue;
        };
        if kind.is_dir() && !name.starts_with('.') && name != "target" && name != "node_modules" {
            walk(&path, files)?;
        }
        if kind.is_file() && Language::of(&path).is_ok() {
            // An unreadable file counts as not generated.
            let text = first_bytes(&path, MAX_BYTES).unwrap_or_default();
            let path = path.strip_prefix(".").unwrap_or(&path);
            files.extend(stamped(path, String::from_utf8_lossy(&text).into_owned()));
        }
    }
    Ok(())
}

fn renewed(context: &Context, file: &StampedFile) -> Result<Vec<New>, Failure> {
    let folder = file.path.parent().unwrap_or(Path::new(""));
    let chain = ChainArgs::from_pairs(&file.stamp.chain).ok_or_else(|| {
        let path = file.path.display();
        let why = format!("`{path}` has options of its chain that are not known");
        Failure::input(why)
    })?;
    let source = Source::open(context, &folder.join(&file.stamp.robot), &chain)?;
    let mut request = source.request(&file.stamp.asked, file.language.scalars())?;
    request.language = file.language;
    let generated = source.generate(context, &mut request)?;
    let files = generated.files(&request, &file.stamp.robot, &source.text);
    let code = files.into_iter().next().unwrap_or_default();
    let made = |path: PathBuf, old: &str, text: String| New {
        path,
        differs: difference(old, &text),
        text,
    };
    let mut new = vec![made(file.path.clone(), &file.text, code)];
    let made_claim = claim(&source.robot, &source.robot_file, &request, &generated);
    let claim = made_claim.map_err(Failure::input)?.write();
    for (path, text) in [
        (claim_of(&file.path), Ok(claim)),
        (file.path.with_extension(EXPECTED), expected(&source.robot)),
    ] {
        if let Ok(old) = fs::read_to_string(&path) {
            new.push(made(path, &old, text?));
        }
    }
    Ok(new)
}

/// Refuses a file that a link puts out of this folder and out of the folder of its name.
fn stays(path: &Path) -> Result<(), Failure> {
    let file = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let is_in =
        |folder: &Path| fs::canonicalize(folder).is_ok_and(|folder| file.starts_with(folder));
    match is_in(Path::new(".")) || path.parent().is_some_and(is_in) {
        true => Ok(()),
        false => Err(Failure::Input(format!(
            "error: `{}` is a link that leads out of the folder\n  = help: dalembert renew {}",
            path.display(),
            file.display()
        ))),
    }
}

/// Returns the first line, counted from 1, in which two texts differ; CRLF in `old` counts as LF.
fn difference(old: &str, new: &str) -> Option<usize> {
    let old = old.replace("\r\n", "\n");
    if old == new {
        return None;
    }
    let same = old.bytes().zip(new.bytes()).take_while(|(a, b)| a == b);
    Some(same.filter(|(byte, _)| *byte == b'\n').count() + 1)
}
