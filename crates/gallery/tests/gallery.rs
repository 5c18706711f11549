//! The files that are checked in are what the command makes, and the robots are sound.

use std::fs;
use std::sync::LazyLock;

use dalembert_gallery::{Entry, entries, folder};
use dalembert_model::number::Rounded;
use dalembert_model::read;

static ENTRIES: LazyLock<Vec<Entry>> =
    LazyLock::new(|| entries().unwrap_or_else(|why| panic!("{why}")));

fn text(name: &str) -> String {
    fs::read_to_string(folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn imports_and_pictures_are_what_is_checked_in() {
    for entry in &*ENTRIES {
        for (name, expected) in &entry.files {
            // Not assert_eq, which would print both drawings.
            assert!(text(name) == *expected, "{name}: run dalembert-gallery");
            assert!(expected.len() < 60_000, "{name} is large");
        }
        // The robot file with its head gives the robot that was imported.
        let reading = read::parse(&text(&entry.arm.robot_file()));
        assert_eq!(reading.unwrap().robot, entry.robot, "{}", entry.arm.name);
    }
}

/// Lengths that vanish when frames are derived are exactly zero: a rounding error of 256 bits would
/// cost operations as any other number does.
#[test]
fn no_length_is_dust() {
    for joint in ENTRIES.iter().flat_map(|entry| &entry.robot.joints) {
        let lengths = joint.com.iter().chain([&joint.a, &joint.d]);
        for length in lengths.map(f64::nearest_rational) {
            assert!(length == 0.0 || length.abs() > 1e-30, "{joint:?}");
        }
    }
}

#[test]
fn every_file_belongs_to_an_arm_with_a_licence() {
    let licences = text("LICENCES.md");
    let mut known = Vec::new();
    for Entry { arm, .. } in &*ENTRIES {
        let mut free = ["BSD", "Apache-2.0", "MIT"].iter();
        assert!(free.any(|name| arm.licence.starts_with(name)), "{arm:?}");
        let (_, name) = arm.file.rsplit_once('/').unwrap();
        let is_named = licences.contains(&format!("`{name}`"));
        assert!(is_named || name.ends_with(".toml"), "{name} has no licence");
        known.extend([arm.robot_file(), arm.picture(), arm.file.clone()]);
    }
    known.retain(|name| !name.starts_with("../"));
    let mut files = Vec::new();
    for part in ["robots", "pictures", "urdf"] {
        for entry in fs::read_dir(folder().join(part)).unwrap() {
            files.push(format!("{part}/{}", entry.unwrap().file_name().display()));
        }
    }
    known.sort();
    known.dedup();
    files.sort();
    assert_eq!(files, known);
}

/// Checks the table's counts for arms whose search takes a second; the command's `--check`, in
/// .ci/run, checks all arms.
#[test]
fn the_table_has_the_counts() {
    let page = text("README.md");
    for entry in &*ENTRIES {
        assert!(page.contains(&format!("\n## {}\n", entry.arm.name)));
        if entry.robot.joints.len() <= 4 {
            let row = entry.row().unwrap();
            assert!(page.contains(&row), "the page has no row\n{row}");
        }
    }
}
