//! Compares an exact program with the equations of motion.

use super::arm::Arm;
use super::exact::{Exact, Point};
use super::number::{Draws, Number};
use super::outputs::{Function, State, result};
use super::program::Program;
use super::robot::File;

/// The number of points.
const POINTS: usize = 12;
/// The largest degree of a difference.
const MOST_DEGREE: f64 = (1u64 << 30) as f64;

/// A base parameter: the columns of the parameters that it adds up, each times a constant.
pub type Combination = Vec<(usize, Exact)>;

/// Checks a function's program against a robot; `base` are the parameters that a regressor is over.
///
/// # Errors
/// The first result that differs, by its number.
pub fn check(
    file: &File,
    statement: &[&str],
    function: &Function,
    program: &Program<Exact>,
    base: &[Combination],
) -> Result<(), String> {
    // Own formulas are quotients of polynomials of a degree below 200 n²: D's entries are of 4 n,
    // its determinant of 4 n², and what is derived twice or inverted twice of a small multiple of
    // that.
    let n = file.joint.len() as f64;
    let degree = (program.degree() + 200.0 * n * n) * (2.0 * n + 1.0);
    // No number counts as too large.
    if !(degree <= MOST_DEGREE) {
        return Err("the degree is too large for a few points to decide".into());
    }
    let mut draws = Draws::new(&[statement, &[function.name]].concat());
    for _ in 0..POINTS {
        let point = Point::draw(&mut draws);
        let arm = Arm::read(file, &point)?;
        let state = State::draw(&point, arm.joints.len());
        let found = program.residues(&point, &state);
        let mut found = found.ok_or("the program reads what is not there")?;
        let fields = function.fields.iter();
        let expected = fields.map(|field| result(&arm, &state, field));
        let expected = expected.collect::<Option<Vec<_>>>();
        let expected = expected.ok_or("no such result")?.concat();
        if !base.is_empty() {
            let rows = arm.joints.len().max(1);
            let spread = spread(&found, base, &point, [rows, expected.len() / rows]);
            found = spread.ok_or("the base parameters do not fit the results")?;
        }
        let is_other = |(own, other): (&Number, &Number)| {
            let own = own.value(point.prime);
            own.is_none() || own != other.value(point.prime)
        };
        if found.len() != expected.len() {
            return Err(format!("{} results, not {}", found.len(), expected.len()));
        }
        if let Some(place) = found.iter().zip(&expected).position(is_other) {
            return Err(format!("result {} is not that of the robot", place + 1));
        }
    }
    Ok(())
}

/// Returns the columns of all parameters, from those of base parameters, over n rows; none if there
/// are no such columns.
fn spread(
    found: &[Number],
    base: &[Combination],
    point: &Point,
    [n, length]: [usize; 2],
) -> Option<Vec<Number>> {
    let mut all = vec![Number::new(0, point.prime); n * length];
    for (k, combination) in base.iter().enumerate() {
        for (column, factor) in combination {
            let factor = point.constant(factor);
            for (i, row) in all.chunks_mut(length).enumerate() {
                let place = row.get_mut(*column)?;
                *place = *place + *found.get(i * base.len() + k)? * factor;
            }
        }
    }
    (found.len() == n * base.len()).then_some(all)
}
