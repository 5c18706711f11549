//! Makes the gallery anew: every robot file, every picture and the page. With `--check`
//! it writes nothing and says which of them are not what is checked in.
#![forbid(unsafe_code)]

use std::path::Path;
use std::process::ExitCode;
use std::{env, fs, io};

use dalembert_gallery::arms::ARMS;
use dalembert_gallery::made::{self, Made};
use dalembert_gallery::{folder, page};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let check = match arguments.as_slice() {
        [] => false,
        [word] if word == "--check" => true,
        _ => {
            eprintln!("error: the only argument known: --check");
            return ExitCode::from(2);
        }
    };
    match run(check) {
        Ok(differing) if differing.is_empty() => ExitCode::SUCCESS,
        Ok(differing) => {
            for file in differing {
                eprintln!("gallery/{file} is not what the command makes");
            }
            ExitCode::FAILURE
        }
        Err(why) => {
            eprintln!("{why}");
            ExitCode::from(2)
        }
    }
}

/// Writes everything, or returns what differs.
fn run(check: bool) -> Result<Vec<String>, String> {
    // All of them before any file is written: a gallery is whole or as it was.
    let made: Vec<Made> = ARMS.iter().map(Made::of).collect::<Result<_, _>>()?;
    let mut files: Vec<(String, String)> = Vec::new();
    let mut rows = Vec::new();
    for made in made {
        if !check {
            made.notes.iter().for_each(|note| eprintln!("{note}"));
        }
        let counts = made::counts(&made.robot)?;
        files.extend(made.files());
        rows.push((made, counts));
    }
    files.push(("README.md".to_owned(), page::text(&rows)));
    if check {
        files.retain(|(name, text)| {
            fs::read_to_string(folder().join(name)).ok() != Some(text.clone())
        });
        return Ok(files.into_iter().map(|(name, _)| name).collect());
    }
    for (name, text) in &files {
        write(&folder().join(name), text)?;
    }
    Ok(Vec::new())
}

/// Writes beside the file, which then gets its name.
fn write(path: &Path, text: &str) -> Result<(), String> {
    let unfinished = path.with_extension("unfinished");
    let written = || -> io::Result<()> {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::write(&unfinished, text)?;
        fs::rename(&unfinished, path)
    };
    written().map_err(|error| {
        // What is left of it is of no use; that it cannot go is no news.
        let _ = fs::remove_file(&unfinished);
        format!("{}: {error}", path.display())
    })
}
