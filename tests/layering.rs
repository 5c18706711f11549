//! Each stage of the generator uses those before it, never those after, in the order of the table
//! in `docs/architecture.md`: within a crate `rustc` lets every module use every other.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const STAGES: &str = "codegen/src/";

fn table() -> Vec<[Vec<String>; 2]> {
    let text = fs::read_to_string(format!("{ROOT}/docs/architecture.md")).unwrap();
    let (_, table) = text.split_once("| folder | phase |").unwrap();
    let rows = table.lines().skip(2).take_while(|line| !line.is_empty());
    let names = |cell: &str| -> Vec<String> {
        let quoted = cell.split('`').skip(1).step_by(2);
        quoted.map(str::to_owned).collect()
    };
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').collect();
        [names(cells[1]), names(cells[3])]
    };
    rows.map(row).collect()
}

fn stages() -> Vec<String> {
    let folders = table().into_iter().map(|[folders, _]| folders);
    let stages = folders.filter(|folders| folders[0].starts_with(STAGES));
    let short = |name: String| name.trim_start_matches(STAGES).to_owned();
    stages.flatten().map(short).collect()
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
            *text += &format!("{line}\n");
        }
    }
}

fn code(module: &str) -> String {
    let mut text = String::new();
    for path in [".rs", ""].map(|ending| format!("{ROOT}/{module}{ending}")) {
        if fs::exists(&path).unwrap() {
            read(path.as_ref(), &mut text);
        }
    }
    text
}

fn used(stage: &str) -> BTreeSet<String> {
    let text = code(&format!("{STAGES}{stage}"));
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
    let lib = fs::read_to_string(format!("{ROOT}/{STAGES}lib.rs")).unwrap();
    let modules = lib.lines().filter_map(|line| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        Some(line.strip_prefix("mod ")?.strip_suffix(';')?.to_owned())
    });
    let listed = BTreeSet::from_iter(stages.clone());
    let what = "the table in docs/architecture.md has every module";
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

#[test]
fn the_table_names_folders_and_types_that_exist() {
    for [folders, types] in table() {
        let is_stage = folders[0].starts_with(STAGES);
        let beside = if is_stage { STAGES } else { "" };
        let mut text = String::new();
        for folder in &folders {
            let module = code(&format!("{beside}{}", folder.trim_start_matches(STAGES)));
            assert!(!module.is_empty(), "docs/architecture.md names `{folder}`");
            text += &module;
        }
        for name in types {
            let declared = ["struct", "enum", "trait"].map(|kind| format!("{kind} {name}"));
            let is_there = declared.iter().any(|words| text.contains(words));
            let what = format!("docs/architecture.md: `{name}` is not in {folders:?}");
            assert!(is_there, "{what}");
        }
    }
}
