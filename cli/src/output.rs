//! Standard output and tables.

use std::io::{self, Write};

use dalembert_codegen::workspace::program::Counts;
use dalembert_model::read::{Diagnostic, RobotWarning};
use serde_json::{Value, json};

use crate::outcome::Failure;

/// Prints to standard output. A reader that has gone away, as in `… | head`,
/// is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Input(format!(
            "error: standard output cannot be written: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Prints a JSON document.
pub fn print_json(value: &Value) -> Result<(), Failure> {
    print(&format!("{value:#}\n"))
}

/// Writes something about a file, as JSON.
pub fn diagnostic(found: &Diagnostic) -> Value {
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

/// Prints a line, or several, on standard error.
pub fn note(text: &str) {
    let mut err = io::stderr().lock();
    // There is nowhere left to complain to.
    let _ = writeln!(err, "{}", text.trim_end());
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
