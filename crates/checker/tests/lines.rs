//! Counts the lines that have to be trusted.

use std::collections::BTreeMap;
use std::fs;

use crate::support::file;

const MOST: usize = 12740;

#[test]
fn trusted_lines_are_named_and_counted() {
    let mut counted = BTreeMap::new();
    let folder = format!("{}/src", env!("CARGO_MANIFEST_DIR"));
    for before in ["", "identity/", "maximum/", "read/"] {
        for entry in fs::read_dir(format!("{folder}/{before}")).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            if let Ok(text) = fs::read_to_string(&path) {
                counted.insert(format!("{before}{name}"), text.lines().count());
            }
        }
    }
    let readme = file("crates/checker/README.md");
    let named: BTreeMap<String, usize> = readme
        .lines()
        .filter_map(|line| {
            let mut cells = line.strip_prefix("| `")?.split(" | ");
            let name = cells.next()?.strip_suffix('`')?;
            Some((name.to_owned(), cells.next()?.parse().ok()?))
        })
        .collect();
    let rounded = counted
        .iter()
        .map(|(name, lines)| (name.clone(), lines.next_multiple_of(10)));
    assert_eq!(named, rounded.collect());
    let total: usize = counted.values().sum();
    assert!(total <= MOST, "{total}");
}

/// The checker must not depend on code that it checks: no crate of this project, nor any but these.
#[test]
fn dependencies_are_named() {
    let manifest = file("crates/checker/Cargo.toml");
    let (_, behind) = manifest.split_once("[dependencies]\n").unwrap();
    let lines = behind.split("\n[").next().unwrap().lines();
    let names: Vec<&str> = lines
        .filter_map(|line| line.split(['.', ' ']).next())
        .filter(|name| !name.is_empty())
        .collect();
    let known = "hmac-sha256 num-bigint num-rational num-traits serde serde_json toml";
    assert_eq!(names.join(" "), known);
}
