//! The checked-in robots are what the generator writes: byte for byte.

use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::generate::{Request, generate};
use dalembert_model::read;

fn robots() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("generated/robots");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort();
    files
}

/// Writes what differs, so that running the tests once more is all that a
/// change of the generator takes; the difference is then in the commit.
#[test]
fn checked_in_robots_are_up_to_date() {
    let robots = robots();
    assert_eq!(robots.len(), 6);
    let mut stale = Vec::new();
    for file in robots {
        let source = fs::read_to_string(&file).unwrap();
        let robot = read::parse(&source, &read::Options::default())
            .unwrap()
            .robot;
        let text = generate(&robot, &Request::default()).unwrap().text;
        let output = file.with_extension("rs");
        if fs::read_to_string(&output).ok().as_deref() != Some(text.as_str()) {
            fs::write(&output, text).unwrap();
            stale.push(output);
        }
    }
    assert!(
        stale.is_empty(),
        "these files were not what the generator writes, and were written anew: {stale:#?}"
    );
}
