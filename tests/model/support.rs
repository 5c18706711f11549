//! Files of robots, what reading them says, and tables of cases.

use std::fmt::Debug;

use crate::equations_support::golden::numbers;
use dalembert_model::equations::{JointPosition, SinCosPair};
use dalembert_model::number::Rational;
use dalembert_model::read::{Diagnostic, Reading, parse};
use dalembert_model::robot::{JointKind, Robot, write};
use nalgebra::DVector;
use serde_json::Value;

pub const ROBOTS: [&str; 6] = [
    "puma560", "stanford", "ur10", "panda", "planar2r", "planar3r",
];

pub fn data(name: &str) -> String {
    let root = env!("CARGO_MANIFEST_DIR");
    let path = format!("{root}/crates/model/tests/data/{name}");
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

pub fn generated(name: &str) -> String {
    data(&format!("../../../../generated/robots/{name}.toml"))
}

#[track_caller]
pub fn reading(text: &str) -> Reading {
    parse(text).unwrap_or_else(|e| panic!("{}", e.in_file("arm.toml").render()))
}

pub fn errors(text: &str) -> Vec<Diagnostic> {
    parse(text).err().map_or_else(Vec::new, |errors| errors.0)
}

pub fn said(text: &str) -> Vec<Diagnostic> {
    match parse(text) {
        Ok(reading) => reading.notes,
        Err(errors) => errors.0,
    }
}

#[track_caller]
pub fn refused(text: &str) -> String {
    let errors = parse(text).expect_err(text);
    errors.in_file("arm.toml").render()
}

#[track_caller]
pub fn written(robot: &Robot) -> String {
    let text = write(robot);
    assert_eq!(reading(&text).robot, *robot);
    text
}

#[track_caller]
pub fn has(said: &Diagnostic, message: &str, help: &str) {
    assert!(said.message.contains(message), "{message}: {said:?}");
    let hint = said.help.as_deref().unwrap_or_default();
    assert!(hint.contains(help), "{help}: {said:?}");
}

/// Asserts that mistakes are said. Each is a piece of the file, what it is replaced by, and of the
/// error that is said then its line, its message and its help.
#[track_caller]
pub fn are_said_at_their_lines(file: &str, mistakes: &[(&str, &str, usize, &str, &str)]) {
    for (piece, by, line, message, help) in mistakes {
        let text = replaced(file, piece, by);
        let errors = errors(&text);
        let error = only(&errors);
        has(error, message, help);
        let before = &text[..error.excerpt().unwrap().span.start];
        let error_line = before.matches('\n').count() + 1;
        assert_eq!(error_line, *line, "{}", refused(&text));
    }
}

pub fn positions(robot: &Robot, q: &[f64]) -> impl Iterator<Item = JointPosition<f64>> {
    let joints = robot.joints.iter().zip(q);
    joints.map(|(joint, q)| match joint.kind {
        JointKind::Prismatic => JointPosition::Prismatic(*q),
        JointKind::Revolute => {
            let (sin, cos) = q.sin_cos();
            JointPosition::Revolute(SinCosPair { sin, cos })
        }
    })
}

/// Asserts that results are those of a state in a file, but for this part of the largest entry.
#[track_caller]
pub fn agree(results: &[(&str, Vec<f64>)], state: &Value, part: f64, by: impl Debug) {
    for (key, results) in results {
        let expected = numbers(&state[*key]);
        assert_eq!(results.len(), expected.len(), "{key}");
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (result, expected) in results.iter().zip(&expected) {
            let off = (result - expected).abs();
            assert!(off <= part * size, "{by:?} {key}: {off:e} of {size}");
        }
    }
}

#[track_caller]
pub fn replaced(text: &str, what: &str, by: &str) -> String {
    assert!(text.contains(what), "{what}");
    text.replacen(what, by, 1)
}

#[track_caller]
pub fn only<T: Debug>(items: &[T]) -> &T {
    let [one] = items else { panic!("{items:#?}") };
    one
}

/// Returns the cells of a table: a row a line, bars between cells, `\n` for the end of a line.
pub fn rows<const N: usize>(table: &str) -> Vec<[String; N]> {
    let cells = |row: &str| -> Vec<String> {
        let cells = row.split('|').map(|cell| cell.trim().replace("\\n", "\n"));
        cells.collect()
    };
    let rows = table.lines().filter(|row| !row.is_empty());
    rows.map(|row| cells(row).try_into().expect(row)).collect()
}

pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

pub fn vector(values: &[f64]) -> DVector<f64> {
    DVector::from_column_slice(values)
}
