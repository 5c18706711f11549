//! The guide in `docs/`: its commands are run, in the order of its chapters and in one
//! folder, and print what it shows.
//!
//! A block `console` shows all that a terminal would, `console result` what is on standard
//! output alone. What differs is written into the guide before the test fails, so that running it
//! once more is all that a change of a message takes; where a block leaves lines out
//! (`...`), it is printed instead.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support;
use crate::support::temporary;

/// A fenced block: what stands behind the fence, and its lines.
struct Block {
    info: String,
    /// The lines of the chapter that are inside.
    lines: std::ops::Range<usize>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src")
}

/// Returns the chapters in the order of the table of contents.
fn chapters() -> Vec<PathBuf> {
    let summary = fs::read_to_string(folder().join("SUMMARY.md")).unwrap();
    let links = summary.lines().filter_map(|line| line.split_once("]("));
    let paths = links.map(|(_, rest)| folder().join(rest.trim_end().trim_end_matches(')')));
    let paths: Vec<PathBuf> = paths.collect();
    assert!(paths.len() > 10, "{paths:?}");
    paths
}

fn blocks(lines: &[String]) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<(String, usize)> = None;
    for (at, line) in lines.iter().enumerate() {
        let Some(info) = line.strip_prefix("```") else {
            continue;
        };
        match open.take() {
            None => open = Some((info.to_owned(), at + 1)),
            Some((info, start)) => blocks.push(Block {
                info,
                lines: start..at,
            }),
        }
    }
    assert!(open.is_none(), "a block has no end");
    blocks
}

/// Runs a line as a shell would: words, and at most one `> FILE`.
fn run(line: &str, inside: &Path, what: &str) -> String {
    let (line, file) = match line.split_once(" > ") {
        Some((line, file)) => (line, Some(file)),
        None => (line, None),
    };
    let mut words = line.split_whitespace();
    assert_eq!(words.next(), Some("dalembert"), "{line}");
    let output = Command::new(env!("CARGO_BIN_EXE_dalembert"))
        .args(words)
        .current_dir(inside)
        .output()
        .unwrap();
    let [mut out, err] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    if let Some(file) = file {
        fs::write(inside.join(file), &out).unwrap();
        out.clear();
    }
    match what {
        "result" => out,
        // As a terminal has it: warnings and progress come before the result.
        _ => err + &out,
    }
}

/// Returns whether lines are those shown, where `...` stands for any.
fn shows(shown: &[&str], lines: &[&str]) -> bool {
    match shown {
        [] => lines.is_empty(),
        ["...", rest @ ..] => (0..=lines.len()).any(|n| shows(rest, &lines[n..])),
        [first, rest @ ..] => lines.first() == Some(first) && shows(rest, &lines[1..]),
    }
}

/// Returns a block of commands with what they print.
fn ran(lines: &[String], inside: &Path, what: &str) -> Vec<String> {
    let mut all = Vec::new();
    for line in lines {
        if let Some(command) = line.strip_prefix("$ ") {
            all.push(line.clone());
            let text = run(command, inside, what);
            all.extend(text.lines().map(|line| line.trim_end().to_owned()));
        }
    }
    all
}

#[test]
fn commands_print_what_the_guide_shows() {
    let inside = temporary("guide");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (from, to) in [
        ("import/tests/data/ur5.urdf", "ur5.urdf"),
        ("generated/robots/puma560.toml", "puma560.toml"),
        ("generated/robots/puma560.plan", "puma560.plan"),
        ("import/tests/data/mjcf/xarm7.xml", "xarm7.xml"),
        ("import/tests/data/so101.urdf", "so101.urdf"),
    ] {
        fs::copy(root.join(from), inside.join(to)).unwrap();
    }
    let mut differing = Vec::new();
    for chapter in chapters() {
        let text = fs::read_to_string(&chapter).unwrap_or_else(|e| panic!("{chapter:?}: {e}"));
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let mut changes = Vec::new();
        for block in blocks(&lines) {
            let body = &lines[block.lines.clone()];
            match block.info.split_once(' ').unwrap_or((&block.info, "")) {
                ("toml", file) if !file.is_empty() => {
                    let (how, name) = file.split_once('=').unwrap();
                    let path = inside.join(name);
                    let before = match how {
                        "file" => String::new(),
                        "append" => fs::read_to_string(&path).unwrap() + "\n",
                        _ => panic!("{chapter:?}: {file}"),
                    };
                    fs::write(path, before + &body.join("\n") + "\n").unwrap();
                }
                ("console", what) => {
                    let found = ran(body, &inside, what);
                    let texts = |lines: &[String]| lines.join("\n");
                    let [shown, printed] = [texts(body), texts(&found)];
                    let each = |text: &str| -> Vec<String> {
                        text.lines()
                            .map(|line| line.trim_end().to_owned())
                            .collect()
                    };
                    let (a, b) = (each(&shown), each(&printed));
                    let a: Vec<&str> = a.iter().map(String::as_str).collect();
                    let b: Vec<&str> = b.iter().map(String::as_str).collect();
                    if shows(&a, &b) {
                        continue;
                    }
                    let name = chapter.file_name().unwrap().display();
                    match a.contains(&"...") {
                        true => {
                            differing.push(format!("{name} leaves out other lines of\n{printed}"))
                        }
                        false => {
                            differing.push(format!("{name} was changed: see what"));
                            changes.push((block.lines.clone(), found));
                        }
                    }
                }
                _ => {}
            }
        }
        for (range, found) in changes.into_iter().rev() {
            lines.splice(range, found);
            fs::write(&chapter, lines.join("\n") + "\n").unwrap();
        }
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
    // What the chapters make of the arm is what the code of the guide is compiled with.
    let arm = fs::read_to_string(inside.join("arm.toml")).unwrap();
    let compiled = fs::read_to_string(root.join("examples/guide/robots/arm.toml")).unwrap();
    assert_eq!(arm, compiled);
}

/// Pictures of the guide that are made elsewhere are those.
#[test]
fn pictures_are_what_the_commands_draw() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read =
        |path: PathBuf| fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
    let planar = support::robot("planar2r");
    let drawn = support::run(&["show", &planar, "--at", "0.6,0.7"]).out;
    assert!(
        read(folder().join("planar2r.svg")) == drawn,
        "dalembert show generated/robots/planar2r.toml --at 0.6,0.7 -o docs/src/planar2r.svg"
    );
    let chart = read(root.join("generated/tradeoff/puma560.svg"));
    assert!(
        read(folder().join("tradeoff.svg")) == chart,
        "cp generated/tradeoff/puma560.svg docs/src/tradeoff.svg"
    );
}

/// Every link of the guide and the README leads somewhere.
#[test]
fn links_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut pages = chapters();
    pages.extend(["README.md", "gallery/README.md", "docs/src/SUMMARY.md"].map(|p| root.join(p)));
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        // Code has brackets too.
        let prose = text.split("```").step_by(2);
        let links = prose.flat_map(|part| part.split("](").skip(1));
        for link in links.filter_map(|rest| rest.split(')').next()) {
            let target = link.split('#').next().unwrap();
            if !target.is_empty() && !target.starts_with("http") {
                let path = page.parent().unwrap().join(target);
                assert!(path.exists(), "{page:?} links to {link}");
            }
        }
    }
}

/// Every file of sources that CONTRIBUTING names is there.
#[test]
fn files_that_contributing_names_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let text = fs::read_to_string(root.join("CONTRIBUTING.md")).unwrap();
    let folders = [
        "",
        "codegen/src",
        "codegen/src/verify",
        "model/src/equations",
        "model/src/outputs",
        "model/src/robot",
        "src/interface",
    ];
    let is_there = |name: &str| {
        folders
            .iter()
            .any(|folder| root.join(folder).join(name).exists())
    };
    let prose = text.split("```").step_by(2);
    let words = prose.flat_map(|part| part.split('`').skip(1).step_by(2));
    let names: Vec<&str> = words.filter(|word| word.ends_with(".rs")).collect();
    assert!(names.len() > 10, "{names:?}");
    let lost = names.iter().filter(|name| !is_there(name));
    assert_eq!(lost.collect::<Vec<_>>(), Vec::<&&str>::new());
}
