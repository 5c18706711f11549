//! The table of variants.

use crate::sweep::Point;
use serde_json::{Value, json};

use crate::output;

/// Returns the rows, for people or for programs, which get more digits and columns.
fn rows(points: &[Point], all: bool) -> Vec<Vec<String>> {
    let digits = if all { 6 } else { 2 };
    // What was not observed is no zero.
    let none = if all { "" } else { "–" };
    let observed = |error: Option<f64>| {
        error.map_or_else(|| none.to_owned(), |error| format!("{error:.digits$e}"))
    };
    let mut head = vec![
        "tolerance",
        "scalar",
        "sincos by",
        "mul",
        "add",
        "sincos",
        "trig_mul",
        "trig_add",
        "left out",
        "certified",
        "observed",
    ];
    if all {
        head.extend(["rounding", "rounding observed"]);
    }
    head.push("front");
    let mut rows = vec![head.into_iter().map(String::from).collect()];
    for point in points {
        let counts = point.counts();
        let mut row = vec![
            format!("{:e}", point.tolerance),
            point.certificate.scalar.to_string(),
            by(point).to_owned(),
            counts.mul.to_string(),
            counts.add.to_string(),
            counts.sincos.to_string(),
            counts.trig_mul.to_string(),
            counts.trig_add.to_string(),
            point.edits().to_string(),
            format!("{:.digits$e}", point.certified),
            observed(point.observed),
        ];
        if all {
            row.push(format!("{:.digits$e}", point.rounding));
            row.push(observed(point.rounding_observed));
        }
        row.push(if point.dominated { "" } else { "yes" }.into());
        rows.push(row);
    }
    rows
}

/// Returns a variant for programs, by the names of the table.
pub fn json(point: &Point) -> Value {
    let mut value = json!({
        "tolerance": point.tolerance,
        "scalar": point.certificate.scalar.name(),
        "sincos_by": by(point),
        "left_out": point.edits(),
        "certified": point.certified,
        "observed": point.observed,
        "rounding": point.rounding,
        "rounding_observed": point.rounding_observed,
        "front": !point.dominated,
        "certificate": point.file(),
        "violation": point.violation,
    });
    value["counts"] = output::counts(&point.counts());
    value
}

/// Returns where its sines come from.
fn by(point: &Point) -> &'static str {
    match point.certificate.sines.is_empty() {
        true => "libm",
        false => "polynomials",
    }
}

/// Writes it for people.
pub fn table(points: &[Point]) -> String {
    output::table(&rows(points, false), 1)
}

/// Writes it for programs.
pub fn csv(points: &[Point]) -> String {
    let rows = rows(points, true);
    let lines = rows
        .iter()
        .map(|row| row.join(",").replace(' ', "_") + "\n");
    lines.collect()
}
