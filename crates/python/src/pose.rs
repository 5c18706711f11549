//! The pose of a base that floats, row by row: what `dalembert.pose` calls.

use dalembert_pose::{Axes, Pose, Quaternion};
use numpy::{PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Poses are rows of seven numbers: the origin, then x, y, z, w.
fn pose(row: &[f64]) -> Option<Pose<f64>> {
    let [px, py, pz, x, y, z, w] = *row.first_chunk()?;
    Some(Pose {
        position: [px, py, pz],
        orientation: Quaternion::from_xyzw([x, y, z, w]),
    })
}

fn numbers(pose: &Pose<f64>) -> Vec<f64> {
    [&pose.position[..], &pose.orientation.to_xyzw()].concat()
}

fn six(row: &[f64], from: usize) -> Option<[f64; 6]> {
    row.get(from..)?.first_chunk().copied()
}

fn axes(name: &str) -> Option<Axes> {
    match name {
        "mixed" => Some(Axes::Mixed),
        "world" => Some(Axes::World),
        "split" => Some(Axes::Split),
        _ => None,
    }
}

type Row = Box<dyn Fn(&Pose<f64>, &[f64]) -> Option<Vec<f64>>>;

/// Returns an operation by its name, with the axes behind a space: of a pose and the numbers behind
/// it, which are nothing if they are too few.
fn operation(text: &str) -> Option<Row> {
    let (name, in_axes) = text.split_once(' ').unwrap_or((text, ""));
    let axes = || axes(in_axes);
    Some(match name {
        "rotate" => {
            Box::new(|here, rest| Some(here.orientation.rotate(*rest.first_chunk()?).to_vec()))
        }
        "rotate_back" => {
            Box::new(|here, rest| Some(here.orientation.rotate_back(*rest.first_chunk()?).to_vec()))
        }
        "integrate" => Box::new(|here, rest| Some(numbers(&here.integrate(six(rest, 0)?)))),
        "difference" => Box::new(|here, rest| Some(here.difference(&pose(rest)?).to_vec())),
        "velocity_in" => {
            let axes = axes()?;
            Box::new(move |here, rest| Some(here.velocity_in(axes, six(rest, 0)?).to_vec()))
        }
        "velocity_from" => {
            let axes = axes()?;
            Box::new(move |here, rest| Some(here.velocity_from(axes, six(rest, 0)?).to_vec()))
        }
        "acceleration_in" => {
            let axes = axes()?;
            Box::new(move |here, rest| {
                Some(
                    here.acceleration_in(axes, six(rest, 0)?, six(rest, 6)?)
                        .to_vec(),
                )
            })
        }
        "acceleration_from" => {
            let axes = axes()?;
            Box::new(move |here, rest| {
                Some(
                    here.acceleration_from(axes, six(rest, 0)?, six(rest, 6)?)
                        .to_vec(),
                )
            })
        }
        _ => return None,
    })
}

/// Returns the results of an operation on rows: a pose, then its other arguments.
#[pyfunction]
pub fn pose_rows<'py>(
    py: Python<'py>,
    name: &str,
    rows: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let wrong = || PyValueError::new_err(format!("no operation `{name}` on such rows"));
    let of = operation(name).ok_or_else(wrong)?;
    let rows = rows.as_slice()?.chunks(rows.shape()[1].max(1));
    let results: Option<Vec<Vec<f64>>> = rows.map(|row| of(&pose(row)?, row.get(7..)?)).collect();
    Ok(PyArray2::from_vec2(py, &results.ok_or_else(wrong)?)?)
}
