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

/// The result of one row, or nothing if the row is too short or the operation is not there.
fn result(operation: &str, row: &[f64]) -> Option<Vec<f64>> {
    let here = pose(row)?;
    let rest = row.get(7..)?;
    let (name, in_axes) = operation.split_once(' ').unwrap_or((operation, ""));
    let found = match name {
        "rotate" => here.orientation.rotate(*rest.first_chunk()?).to_vec(),
        "rotate_back" => here.orientation.rotate_back(*rest.first_chunk()?).to_vec(),
        "integrate" => numbers(&here.integrate(six(rest, 0)?)),
        "difference" => here.difference(&pose(rest)?).to_vec(),
        "velocity_in" => here.velocity_in(axes(in_axes)?, six(rest, 0)?).to_vec(),
        "velocity_from" => here.velocity_from(axes(in_axes)?, six(rest, 0)?).to_vec(),
        "acceleration_in" => {
            let (velocity, rate) = (six(rest, 0)?, six(rest, 6)?);
            here.acceleration_in(axes(in_axes)?, velocity, rate)
                .to_vec()
        }
        "acceleration_from" => {
            let (velocity, rate) = (six(rest, 0)?, six(rest, 6)?);
            here.acceleration_from(axes(in_axes)?, velocity, rate)
                .to_vec()
        }
        _ => return None,
    };
    Some(found)
}

/// Returns the results of an operation on rows: a pose, then its other arguments.
#[pyfunction]
pub fn pose_rows<'py>(
    py: Python<'py>,
    operation: &str,
    rows: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let entries = rows.as_slice()?;
    let found = entries.chunks(rows.shape()[1].max(1));
    let found: Option<Vec<Vec<f64>>> = found.map(|row| result(operation, row)).collect();
    let wrong = || PyValueError::new_err(format!("no operation `{operation}` on such rows"));
    Ok(PyArray2::from_vec2(py, &found.ok_or_else(wrong)?)?)
}
