//! The law of the house: each stage uses those before it, never those after.
//!
//! The order of the stages is the list at the top of `codegen/src/lib.rs`. In
//! every crate no two top-level modules use each other, by whatever way round,
//! and neither do two files (or folders) of a module. A module's own file, the
//! table of contents, has what its files share, and is no party to this.
//!
//! And what a certificate's check rests on is named, file by file, in
//! `codegen/src/certificate/README.md`; nothing of the search is among it.

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

/// Those that reach each other, each with the arrows among them.
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

/// The stages in the order of the list in `codegen/src/lib.rs`.
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

/// The files that a README's tables name in their first columns: `bound/*`,
/// `verify/{exact,degree}`.
fn named(text: &str) -> Vec<String> {
    let rows = text.lines().filter(|line| line.starts_with("| `"));
    let first = rows.filter_map(|row| row.split('|').nth(1));
    let mut all = Vec::new();
    for name in first.flat_map(|cell| cell.split('`').skip(1).step_by(2)) {
        match name.split_once('{') {
            None => all.push(name.to_owned()),
            Some((room, files)) => {
                let files = files.trim_end_matches('}').split(',');
                all.extend(files.map(|file| format!("{room}{file}")));
            }
        }
    }
    all
}

#[test]
fn what_the_check_of_a_certificate_rests_on_is_named() {
    let codegen = &crates()[1];
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/codegen/src/certificate/README.md"
    );
    let named = named(&std::fs::read_to_string(path).unwrap());
    let trusted: BTreeSet<String> = ["certificate::check", "certificate::format"]
        .iter()
        .flat_map(|from| reach(&codegen.files, from))
        .filter(|file| !file.is_empty())
        .collect();
    assert!(trusted.len() > 50, "{trusted:?}");
    let search = [
        "simplify",
        "portfolio",
        "schedule",
        "approximate",
        "generate",
    ];
    let of_the_search = |file: &&String| search.contains(&file.split("::").next().unwrap());
    let found: Vec<&String> = trusted.iter().filter(of_the_search).collect();
    assert!(found.is_empty(), "the check uses the search: {found:?}");
    let is_named = |file: &String| {
        let file = file.replace("::", "/");
        named.iter().any(|name| match name.strip_suffix("/*") {
            Some(room) => file == room || file.starts_with(&format!("{room}/")),
            None => file == *name,
        })
    };
    let missing: Vec<&String> = trusted.iter().filter(|file| !is_named(file)).collect();
    assert!(missing.is_empty(), "not in {path}: {missing:?}");
}
