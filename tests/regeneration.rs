//! What is generated and checked in is what the generator writes from the plans
//! beside the robots, byte for byte: the robots' source, and the code and counts in the README.
//!
//! What differs is written anew before the test fails, so that running it once
//! more is all that a change of the generator takes; the difference is then in
//! the commit.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{Generated, Request, generate};
use dalembert_codegen::workspace::plan;
use dalembert_model::read;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn robots() -> BTreeMap<String, PathBuf> {
    let folder = fs::read_dir(root().join("generated/robots")).unwrap();
    folder
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), path))
        .collect()
}

/// Whether a file says this; if not, it does afterwards.
fn keep(path: &Path, text: &str) -> bool {
    let same = fs::read_to_string(path).is_ok_and(|old| old == text);
    if !same {
        fs::write(path, text).unwrap();
    }
    same
}

#[test]
fn checked_in_code_is_up_to_date() {
    let robots = robots();
    assert_eq!(robots.len(), 6);
    let mut stale = Vec::new();
    let mut all = BTreeMap::new();
    for (name, file) in robots {
        let source = fs::read_to_string(&file).unwrap();
        let reading = read::parse(&source, &read::Options::default()).unwrap();
        let request = Request {
            plan: plan::file::beside(&file).unwrap(),
            ..Request::default()
        };
        let generated = generate(&reading.robot, &request).unwrap();
        let output = file.with_extension("rs");
        if !keep(&output, &generated.text) {
            stale.push(output);
        }
        all.insert(name, generated);
    }
    let readme = root().join("README.md");
    let text = updated(&fs::read_to_string(&readme).unwrap(), &all);
    if !keep(&readme, &text) {
        stale.push(readme);
    }
    assert!(
        stale.is_empty(),
        "these files were not what the generator writes, and were written anew: {stale:#?}"
    );
}

/// The README with the code and the rows of counts as they are now.
fn updated(readme: &str, all: &BTreeMap<String, Generated>) -> String {
    let mut text = String::new();
    let mut columns: Vec<&str> = Vec::new();
    let mut lines = readme.lines();
    while let Some(line) = lines.next() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if cells.get(2).is_some_and(|cell| all.contains_key(*cell)) {
            columns = cells[2..cells.len() - 1].to_vec();
        }
        let function = cells
            .get(1)
            .and_then(|cell| Function::from_name(cell.trim_matches('`')));
        match (function, line) {
            (Some(function), _) if !columns.is_empty() => {
                text += &counts(function, &columns, all);
            }
            (_, "<!-- planar2r::inverse_dynamics -->") => {
                let code = body(&all["planar2r"].text, Function::InverseDynamics);
                text += &format!("{line}\n```rust\n{code}```\n");
                // Both fences and what is between them.
                lines.next();
                lines.by_ref().find(|line| *line == "```");
            }
            _ => text += &format!("{line}\n"),
        }
    }
    text
}

fn counts(function: Function, robots: &[&str], all: &BTreeMap<String, Generated>) -> String {
    let mut row = format!("| `{function}` |");
    for robot in robots {
        let mut functions = all[*robot].functions.iter();
        let counts = functions.find(|f| f.function == function).unwrap().counts;
        row += &format!(" **{}/{}** |", counts.mul, counts.add);
    }
    row + "\n"
}

/// A function of the first module, without its documentation.
fn body(text: &str, function: Function) -> String {
    let start = text.find(&format!("pub fn {function}(")).unwrap();
    let end = start + text[start..].find("\n}\n").unwrap() + 3;
    text[start..end].to_owned()
}
