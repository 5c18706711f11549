//! The table of variants.

use super::ladder::Point;
use crate::output;

/// What a variant costs, dimension by dimension: a narrower scalar is one too.
fn cost(point: &Point) -> [usize; 3] {
    let counts = point.counts();
    let bits = match point.certificate.scalar {
        dalembert_codegen::emit::ScalarType::F64 => 64,
        dalembert_codegen::emit::ScalarType::F32 => 32,
    };
    // Polynomials are operations like others; what libm does is not known.
    match point.certificate.sines.is_empty() {
        true => [bits, counts.sincos, counts.operations()],
        false => [
            bits,
            0,
            counts.operations() + counts.trig_mul + counts.trig_add,
        ],
    }
}

/// Marks what is dominated: another point is no dearer, no worse, and not the
/// same; of equal points the first stays.
pub fn mark(points: &mut [Point]) {
    let all: Vec<([usize; 3], f64)> = points.iter().map(|p| (cost(p), p.certified)).collect();
    for (index, point) in points.iter_mut().enumerate() {
        let (mine, error) = all[index];
        point.dominated = all.iter().enumerate().any(|(other, &(theirs, e))| {
            let no_worse = theirs.iter().zip(&mine).all(|(a, b)| a <= b) && e <= error;
            let same = theirs == mine && e == error;
            no_worse && (!same || other < index)
        });
    }
}

/// The rows, for people or for programs, which get more digits and columns.
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
    let timed = points.iter().any(|point| point.time.is_some());
    if timed {
        head.extend(["ns", "time"]);
    }
    head.push("front");
    let mut rows = vec![head.into_iter().map(String::from).collect()];
    for point in points {
        let counts = point.counts();
        let by = match point.certificate.sines.is_empty() {
            true => "libm",
            false => "polynomials",
        };
        let mut row = vec![
            format!("{:e}", point.tolerance),
            point.certificate.scalar.to_string(),
            by.to_owned(),
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
        if let Some(time) = point.time {
            row.push(format!("{:.1}", time.nanoseconds));
            row.push(format!("{:.3}", time.ratio));
        }
        row.push(if point.dominated { "" } else { "yes" }.into());
        rows.push(row);
    }
    rows
}

/// For people.
pub fn table(points: &[Point]) -> String {
    output::table(&rows(points, false), 1)
}

/// For programs.
pub fn csv(points: &[Point]) -> String {
    let rows = rows(points, true);
    let lines = rows
        .iter()
        .map(|row| row.join(",").replace(' ', "_") + "\n");
    lines.collect()
}
