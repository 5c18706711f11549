//! Messages of the compiler for common mistakes in `dynamics!`, word for word,
//! and invocations that are right.
//!
//! `UI=overwrite` writes what is said now beside the cases.

mod compiler;

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;

use compiler::Compiler;

fn cases(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    let mut cases: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|end| end == "rs"));
    cases.sort();
    assert!(cases.len() > 5, "{folder} has few cases");
    cases
}

fn complaints(cases: Vec<PathBuf>, complaint: impl Fn(&Path) -> Option<String> + Sync) -> String {
    let (left, complaints) = (Mutex::new(cases), Mutex::new(Vec::new()));
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, |n| n.get()) {
            scope.spawn(|| {
                let next = || left.lock().unwrap().pop();
                while let Some(case) = next() {
                    if let Some(complaint) = complaint(&case) {
                        let text = format!("{}:\n{complaint}", case.display());
                        complaints.lock().unwrap().push(text);
                    }
                }
            });
        }
    });
    complaints.into_inner().unwrap().join("\n\n")
}

/// Without what says only how many errors there were, and where to read on.
fn messages(stderr: &[u8]) -> String {
    let text = String::from_utf8_lossy(stderr);
    let counts = "error: aborting due to|Some errors have|For more information about";
    let is_kept = |line: &&str| !counts.split('|').any(|start| line.starts_with(start));
    let lines: Vec<&str> = text.lines().filter(is_kept).collect();
    lines.join("\n").trim_end().to_owned() + "\n"
}

#[test]
fn mistakes() {
    let compiler = Compiler::new().unwrap();
    let overwrite = env::var_os("UI").is_some_and(|value| value == "overwrite");
    let wrong = complaints(cases("fail"), |case| {
        let output = compiler.check(case).unwrap();
        if output.status.success() {
            return Some("the compiler accepts it".to_owned());
        }
        let (said, kept) = (messages(&output.stderr), case.with_extension("stderr"));
        if overwrite {
            fs::write(&kept, &said).unwrap();
        }
        let expected = fs::read_to_string(&kept).unwrap_or_default();
        (said != expected)
            .then(|| format!("said:\n{said}\nexpected (UI=overwrite keeps it):\n{expected}"))
    });
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn good_invocations() {
    let compiler = Compiler::new().unwrap();
    let wrong = complaints(cases("pass"), |case| {
        let output = compiler.run(case).unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        (!output.status.success()).then(|| said.into_owned())
    });
    assert!(wrong.is_empty(), "{wrong}");
}
