//! The law of the house: each stage uses those before it, never those after.
//!
//! The order of the stages is the list at the top of `codegen/src/lib.rs`. In
//! every crate no two top-level modules use each other, by whatever way round,
//! and neither do two files (or folders) of a module. A module's own file, the
//! table of contents, has what its files share, and is no party to this.

#[path = "layering/source.rs"]
mod source;

use std::collections::{BTreeMap, BTreeSet};

use source::Crate;

const CRATES: [&str; 14] = [
    "model",
    "codegen",
    "macros",
    "build",
    "generated",
    "report",
    "import",
    "cli",
    "checker",
    ".",
    "sines",
    "batch",
    "fit",
    "gallery",
];

/// Who uses whom.
type Uses = BTreeMap<String, BTreeSet<String>>;

fn crates() -> Vec<Crate> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = CRATES.map(|name| Crate::read(&root.join(name).join("src")));
    assert!(crates.iter().any(|found| found.files.len() > 100));
    crates.into()
}

/// Returns all that is used from here, directly or not.
fn reach(uses: &Uses, from: &str) -> BTreeSet<String> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from.to_owned()]);
    while let Some(at) = open.pop() {
        for next in uses.get(&at).into_iter().flatten() {
            if seen.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    seen
}

/// Returns those that reach each other, each with the arrows among them.
fn circles(uses: &Uses) -> Vec<String> {
    let reached: BTreeMap<&String, BTreeSet<String>> =
        uses.keys().map(|name| (name, reach(uses, name))).collect();
    let mut knots: Vec<BTreeSet<&String>> = Vec::new();
    for (name, to) in &reached {
        if to.contains(*name) && !knots.iter().any(|knot| knot.contains(name)) {
            let back = |other: &&String| reached[*other].contains(*name);
            knots.push(
                reached
                    .keys()
                    .filter(|o| to.contains(**o))
                    .copied()
                    .filter(back)
                    .collect(),
            );
        }
    }
    let describe = |knot: BTreeSet<&String>| {
        let arrow = |from: &&String| {
            let to: Vec<&str> = uses[*from]
                .iter()
                .filter(|to| knot.contains(to))
                .map(String::as_str)
                .collect();
            format!("  {from} uses {}", to.join(", "))
        };
        knot.iter().map(arrow).collect::<Vec<_>>().join("\n")
    };
    knots.into_iter().map(describe).collect()
}

/// Returns the stages in the order of the list in `codegen/src/lib.rs`.
fn stages() -> Vec<String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/codegen/src/lib.rs");
    let text = std::fs::read_to_string(path).unwrap();
    let lines = text.lines().filter_map(|line| line.strip_prefix("//! - "));
    let name = |line: &str| line.split('`').nth(1).unwrap().to_owned();
    lines.map(name).collect()
}

#[test]
fn no_stage_uses_a_later_one() {
    let codegen = &crates()[1];
    let stages = stages();
    let modules = codegen.children("");
    let listed: BTreeSet<&String> = stages.iter().collect();
    assert_eq!(
        listed,
        modules.keys().collect(),
        "the list in codegen/src/lib.rs has every module"
    );
    let place = |name: &String| stages.iter().position(|stage| stage == name);
    let mut back = Vec::new();
    for (from, to) in modules
        .iter()
        .flat_map(|(from, all)| all.iter().map(move |to| (from, to)))
    {
        if place(to) > place(from) {
            back.push(format!(
                "{from} uses {to}: {}",
                codegen.why(from, to).join(", ")
            ));
        }
    }
    assert!(
        back.is_empty(),
        "stages that use later ones:\n{}",
        back.join("\n")
    );
}

#[test]
fn no_circle_among_modules_or_files_of_a_module() {
    let mut all = Vec::new();
    for found in crates() {
        for module in found.folders() {
            let knots = circles(&found.children(&module)).into_iter();
            all.extend(knots.map(|knot| format!("{} {module}:\n{knot}", found.name)));
        }
    }
    assert!(all.is_empty(), "in a circle:\n{}", all.join("\n\n"));
}
