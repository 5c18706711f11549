//! The counts of the README and the guide are those of the plans beside the robots, whose programs
//! are all proved. A page that differs is written anew before the test fails.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::{Argument, Entry, RuntimeParameter};
use dalembert_codegen::{Function, GeneratedFunction, Request, RobotFile, generate};
use dalembert_model::robot::Robot;

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

#[test]
fn pages_have_the_counts_of_the_plans() {
    let robots = robots();
    assert_eq!(robots.len(), 6);
    let mut stale = Vec::new();
    let mut table = BTreeMap::new();
    for (name, file) in robots {
        let read = RobotFile::read(&file).unwrap();
        let request = Request {
            plan: read.plan,
            ..Request::default().for_file(&read.robot, &read.outputs)
        };
        let mut functions = generate(&read.robot, &request).unwrap().functions;
        functions.extend(others(&read.robot, &request));
        table.insert(name, functions);
    }
    for page in ["README.md", "docs/src/how-it-works.md"] {
        let page = root().join(page);
        let old = fs::read_to_string(&page).unwrap();
        let text = updated(&old, &table);
        if text != old {
            fs::write(&page, text).unwrap();
            stale.push(page);
        }
    }
    let what = "these files were not what the generator writes, and were written anew";
    assert!(stale.is_empty(), "{what}: {stale:#?}");
}

type Table = BTreeMap<String, Vec<GeneratedFunction>>;

/// Generates what the plan has besides the functions of the file, and what takes parameters of
/// the robot as arguments. Without the plan, a search of minutes would take its place.
fn others(robot: &Robot, request: &Request) -> Vec<GeneratedFunction> {
    let plan = request.plan.as_ref().unwrap();
    let entries = || plan.entries.iter().filter(|entry| entry.scene.is_none());
    let generated = |parameters: &[RuntimeParameter]| {
        let arguments: Vec<Argument> = parameters.iter().map(|one| one.argument()).collect();
        let taken = |entry: &&Entry| match &entry.parameters {
            Some(key) => key.taken == arguments,
            None => arguments.is_empty(),
        };
        let mut functions: Vec<Function> = Vec::new();
        for function in entries().filter(taken).map(|entry| entry.program.function) {
            let is_known = parameters.is_empty() && request.functions.contains(&function);
            if !is_known && !functions.contains(&function) {
                functions.push(function);
            }
        }
        let request = Request {
            functions,
            parameters: parameters.to_vec(),
            ..request.clone()
        };
        let generated = generate(robot, &request).unwrap();
        for function in &generated.functions {
            let is_load = function.function == Function::Load;
            assert!(function.planned || is_load, "{}", function.function);
        }
        generated.functions
    };
    let functions = generated(&[]);
    // Proved, and not in the guide's table, which has one row a function.
    let mut parameters = entries().filter_map(|entry| entry.parameters.as_ref());
    assert!(parameters.all(|key| key.taken == [Argument::Load]));
    generated(&[RuntimeParameter::Payload]);
    functions
}

fn updated(page: &str, table: &Table) -> String {
    let mut text = String::new();
    let mut columns: Vec<&str> = Vec::new();
    for line in page.lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if cells.get(2).is_some_and(|cell| table.contains_key(*cell)) {
            columns = cells[2..cells.len() - 1].to_vec();
        }
        // `function` in the first column, or several that are one.
        let words = cells.get(1).into_iter().flat_map(|cell| cell.split('`'));
        let named: Vec<Function> = words.filter_map(Function::from_name).collect();
        text += &match columns.is_empty() || named.is_empty() {
            true => format!("{line}\n"),
            false => counts(cells[1], &named, &columns, table),
        };
    }
    text
}

fn counts(first: &str, named: &[Function], robots: &[&str], table: &Table) -> String {
    let mut row = format!("| {first} |");
    for robot in robots {
        let is_it = |f: &&GeneratedFunction| match named {
            [function] => f.function == *function,
            parts => f.function.parts() == parts,
        };
        let counts = table[*robot].iter().find(is_it).unwrap().counts();
        row += &match counts.div {
            0 => format!(" **{}/{}** |", counts.mul, counts.add),
            div => format!(" **{}/{}**, {div} |", counts.mul, counts.add),
        };
    }
    row + "\n"
}
