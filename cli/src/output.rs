//! Standard output and tables.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use anstream::{AutoStream, ColorChoice};
use dalembert_codegen::Counts;
use dalembert_model::read::{Diagnostic, RobotWarning, Severity};
use serde_json::{Value, json};

use crate::bar;
use crate::outcome::{Failure, Outcome};

/// Prints to standard output. A reader that has gone away, as in `… | head`,
/// is no failure.
pub fn print(text: &str) -> Outcome {
    let mut out = io::stdout().lock();
    match bar::aside(|| out.write_all(text.as_bytes()).and_then(|()| out.flush())) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Input(format!(
            "error: standard output cannot be written: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Prints a JSON document.
pub fn print_json(value: &Value) -> Outcome {
    print(&format!("{value:#}\n"))
}

/// Writes a message about a file as JSON; a warning counts as printed.
pub fn diagnostic(found: &Diagnostic) -> Value {
    WARNED.fetch_or(found.severity == Severity::Warning, Ordering::Relaxed);
    json!({
        "severity": found.severity.to_string(),
        "warning": found.warning.map(RobotWarning::name),
        "line": found.line,
        "column": found.column,
        "message": found.message,
        "help": found.help,
    })
}

/// Counts as JSON.
pub fn counts(counts: &Counts) -> Value {
    json!({
        "mul": counts.mul,
        "add": counts.add,
        "fma": counts.fma,
        "div": counts.div,
        "sqrt": counts.sqrt,
        "sincos": counts.sincos,
        "trig_mul": counts.trig_mul,
        "trig_add": counts.trig_add,
    })
}

/// Whether a warning was printed in this run, and whether warnings are denied.
static WARNED: AtomicBool = AtomicBool::new(false);
static DENIED: AtomicBool = AtomicBool::new(false);

/// Begins a run, which may deny warnings.
pub fn begin(denies_warnings: bool) {
    WARNED.store(false, Ordering::Relaxed);
    DENIED.store(denies_warnings, Ordering::Relaxed);
}

/// Fails where a warning was printed and warnings are denied.
///
/// # Errors
/// A failed check.
pub fn undenied() -> Outcome {
    match WARNED.load(Ordering::Relaxed) && DENIED.load(Ordering::Relaxed) {
        true => Err(Failure::Check(
            "error: there are warnings, and --deny-warnings takes them for errors".into(),
        )),
        false => Ok(()),
    }
}

/// The words that begin a message or its parts, with their colours on a terminal.
const COLOURS: [(&str, &str); 6] = [
    ("error", "1;31"),
    ("warning", "1;33"),
    ("note", "1;36"),
    ("  = help", "1;32"),
    ("  = note", "1;36"),
    (" --> ", "1;34"),
];

/// Prints a line, or several, on standard error: in colour on a terminal, unless the environment
/// says otherwise (`NO_COLOR`, `CLICOLOR_FORCE`).
pub fn note(text: &str) {
    let text = text.trim_end();
    if text.lines().any(|line| line.starts_with("warning")) {
        WARNED.store(true, Ordering::Relaxed);
    }
    let plain = AutoStream::choice(&io::stderr()) == ColorChoice::Never;
    let coloured = |line: &str| match COLOURS.iter().find(|(mark, _)| line.starts_with(mark)) {
        Some((mark, code)) if !plain => {
            format!("\x1b[{code}m{mark}\x1b[0m{}", &line[mark.len()..])
        }
        _ => line.to_owned(),
    };
    let lines: Vec<String> = text.split('\n').map(coloured).collect();
    bar::aside(|| {
        // There is nowhere left to complain to.
        let _ = writeln!(io::stderr().lock(), "{}", lines.join("\n"));
    });
}

/// Lays out rows in columns: the first to the left, the others to the right
/// except the last `text` ones.
pub fn table(rows: &[Vec<String>], text: usize) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut lines = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[column] - cell.chars().count());
            let left = column == 0 || column + text >= columns;
            let (before, after) = if left { ("", &*pad) } else { (&*pad, "") };
            line.push_str(&format!("  {before}{cell}{after}"));
        }
        lines.push_str(line.trim_end());
        lines.push('\n');
    }
    lines
}
