//! Objects of Python as arrays of the scalar that is computed in, and errors as exceptions.

use dalembert_jit::{LoadError, Real, Scalar};
use numpy::{Element, PyArrayDyn};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyDict;

pub(crate) fn dtype(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::F64 => "float64",
        Scalar::F32 => "float32",
    }
}

/// Takes whole numbers and floats, but no array whose digits or imaginary parts would be lost.
pub(crate) fn array<'py, T: Real + Element>(
    object: &Bound<'py, PyAny>,
    function: &str,
    argument: &str,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    if let Ok(array) = object.cast::<PyArrayDyn<T>>() {
        return Ok(array.clone());
    }
    let py = object.py();
    let expected = dtype(T::SCALAR);
    let wrong = |found: String| {
        PyTypeError::new_err(format!(
            "{function}: argument `{argument}` is {found}, expected numbers that are {expected}"
        ))
    };
    let numpy = py.import(intern!(py, "numpy"))?;
    let array = numpy.call_method1(intern!(py, "asarray"), (object,));
    let array = array.map_err(|_| wrong(format!("{}", object.get_type())))?;
    let found = array.getattr("dtype")?;
    // Python's own numbers have no dtype that anybody chose.
    let is_chosen = object.hasattr("dtype")? && found.getattr("kind")?.eq("f")?;
    let options = PyDict::new(py);
    options.set_item("casting", if is_chosen { "safe" } else { "same_kind" })?;
    let cast = array.call_method("astype", (expected,), Some(&options));
    let cast = cast.map_err(|_| wrong(format!("of dtype {found}")))?;
    Ok(cast.cast_into::<PyArrayDyn<T>>()?)
}

pub(crate) fn raised(error: &LoadError) -> PyErr {
    match error {
        LoadError::Compile(..) => PyRuntimeError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}
