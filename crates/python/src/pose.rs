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

/// Computes an operation of a row, a pose and the numbers behind it; the operation is a name, with
/// the axes behind a space.
fn computed(operation: &str, row: &[f64]) -> Option<Vec<f64>> {
    let (name, in_axes) = operation.split_once(' ').unwrap_or((operation, ""));
    let axes = match in_axes {
        "mixed" => Some(Axes::Mixed),
        "world" => Some(Axes::World),
        "split" => Some(Axes::Split),
        _ => None,
    };
    let (here, rest) = (pose(row)?, row.get(7..)?);
    let [twist, rate] = [0, 6].map(|from| rest.get(from..)?.first_chunk().copied());
    Some(match name {
        "rotate" => here.orientation.rotate(*rest.first_chunk()?).to_vec(),
        "rotate_back" => here.orientation.rotate_back(*rest.first_chunk()?).to_vec(),
        "integrate" => numbers(&here.integrate(twist?)),
        "difference" => here.difference(&pose(rest)?).to_vec(),
        "velocity_in" => here.velocity_in(axes?, twist?).to_vec(),
        "velocity_from" => here.velocity_from(axes?, twist?).to_vec(),
        "acceleration_in" => here.acceleration_in(axes?, twist?, rate?).to_vec(),
        "acceleration_from" => here.acceleration_from(axes?, twist?, rate?).to_vec(),
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
    let rows = rows.as_slice()?.chunks(rows.shape()[1].max(1));
    let results: Option<Vec<Vec<f64>>> = rows.map(|row| computed(name, row)).collect();
    Ok(PyArray2::from_vec2(py, &results.ok_or_else(wrong)?)?)
}
