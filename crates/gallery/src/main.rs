//! Makes every robot file, every picture and the page of the gallery. With `--check` it writes
//! nothing and names the files that differ from what is checked in.
#![forbid(unsafe_code)]

use std::error::Error;
use std::process::ExitCode;
use std::{env, fs};

use dalembert_gallery::{Entry, File, entries, folder, page};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let done = match arguments.as_slice() {
        [] => write(),
        [word] if word == "--check" => check(),
        _ => Err("error: unknown argument; the only one is --check".into()),
    };
    if let Err(why) = &done {
        eprintln!("{why}");
    }
    ExitCode::from(u8::from(done.is_err()))
}

fn make() -> Result<(Vec<Entry>, Vec<File>), Box<dyn Error>> {
    let entries = entries()?;
    let page = ("README.md".into(), page(&entries)?);
    let files = entries
        .iter()
        .flat_map(|entry| entry.files.clone())
        .chain([page])
        .collect();
    Ok((entries, files))
}

fn check() -> Result<(), Box<dyn Error>> {
    let (_, mut files) = make()?;
    files.retain(|(name, text)| {
        !fs::read(folder().join(name)).is_ok_and(|bytes| bytes == text.as_bytes())
    });
    for (name, _) in &files {
        eprintln!("gallery/{name} is not what the command makes");
    }
    match files.len() {
        0 => Ok(()),
        count => Err(format!("files that differ: {count}").into()),
    }
}

/// Writes all files under temporary names, then renames them, so that none is half written.
fn write() -> Result<(), Box<dyn Error>> {
    let (entries, files) = make()?;
    let notes = entries.iter().flat_map(|entry| &entry.notes);
    notes.for_each(|note| eprintln!("{note}"));
    let parts = tempfile::tempdir_in(folder())?;
    let part = |name: &str| parts.path().join(name.replace('/', "-"));
    for (name, text) in &files {
        fs::write(part(name), text)?;
    }
    for (name, _) in &files {
        fs::rename(part(name), folder().join(name))?;
    }
    Ok(())
}
