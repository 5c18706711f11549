//! The law of the house: each stage uses those before it, never those after.
//!
//! The order of the stages is the list at the top of `codegen/src/lib.rs`, which `rustc` knows
//! nothing of: within a crate it lets every module use every other.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/codegen/src");

/// Returns the stages in the order of the list in `codegen/src/lib.rs`.
fn stages() -> Vec<String> {
    let text = fs::read_to_string(format!("{SOURCE}/lib.rs")).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix("//! - "));
    let name = |line: &str| line.split('`').nth(1).unwrap().to_owned();
    lines.map(name).collect()
}

/// Adds the text of a file, or of all files in a folder, without comments.
fn read(path: &Path, text: &mut String) {
    if path.is_dir() {
        for entry in fs::read_dir(path).unwrap() {
            read(&entry.unwrap().path(), text);
        }
        return;
    }
    if path.extension().is_none_or(|ending| ending != "rs") {
        return;
    }
    for line in fs::read_to_string(path).unwrap().lines() {
        if !line.trim_start().starts_with("//") {
            *text += line;
            text.push('\n');
        }
    }
}

/// Returns the modules that a stage's files name behind `crate::`.
fn used(stage: &str) -> BTreeSet<String> {
    let mut text = String::new();
    for path in [".rs", ""].map(|ending| format!("{SOURCE}/{stage}{ending}")) {
        if fs::exists(&path).unwrap() {
            read(path.as_ref(), &mut text);
        }
    }
    // A list would hide what it names.
    assert!(!text.contains("crate::{"), "{stage}: one `use` a module");
    let word = |rest: &str| -> String {
        let is_letter = |c: &char| c.is_alphanumeric() || *c == '_';
        rest.chars().take_while(is_letter).collect()
    };
    let named = text.split("crate::").skip(1).map(word);
    named.filter(|name| name != stage).collect()
}

#[test]
fn no_stage_uses_a_later_one() {
    let stages = stages();
    let lib = fs::read_to_string(format!("{SOURCE}/lib.rs")).unwrap();
    let modules = lib.lines().filter_map(|line| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        Some(line.strip_prefix("mod ")?.strip_suffix(';')?.to_owned())
    });
    let listed = BTreeSet::from_iter(stages.clone());
    let what = "the list in codegen/src/lib.rs has every module";
    assert_eq!(listed, modules.collect(), "{what}");
    let place = |name: &str| stages.iter().position(|stage| stage == name);
    let mut uses = 0;
    for stage in &stages {
        for name in used(stage) {
            uses += 1;
            assert!(place(&name) < place(stage), "{stage} uses {name}");
        }
    }
    assert!(uses > 100, "{uses}");
}
