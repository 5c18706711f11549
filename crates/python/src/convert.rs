//! Objects of Python as arrays of the scalar that is computed in, and errors as exceptions; the
//! arrays that results are written to; how Python writes shapes, how leading axes are broadcast.

use dalembert_jit::{Error, Real, Scalar};
use numpy::{Element, PyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::memory::zeros;

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
    let array = numpy
        .call_method1(intern!(py, "asarray"), (object,))
        .map_err(|_| wrong(format!("{}", object.get_type())))?;
    let dtype = array.getattr("dtype")?;
    // Python's own numbers have no dtype that anybody chose.
    let is_chosen = object.hasattr("dtype")? && dtype.getattr("kind")?.eq("f")?;
    let options = PyDict::new(py);
    options.set_item("casting", if is_chosen { "safe" } else { "same_kind" })?;
    let cast = array
        .call_method("astype", (expected,), Some(&options))
        .map_err(|_| wrong(format!("of dtype {dtype}")))?;
    Ok(cast.cast_into::<PyArrayDyn<T>>()?)
}

pub(crate) fn raised(error: Error) -> PyErr {
    match error {
        Error::Function(..) => PyRuntimeError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// A result: its name, and its shape for one state.
pub(crate) type Quantity = (&'static str, Vec<usize>);

pub(crate) fn arrays<'py, T: Real + Element>(
    py: Python<'py>,
    function: &str,
    quantities: &[Quantity],
    batch: &[usize],
    out: Option<&Bound<'py, PyAny>>,
) -> PyResult<Vec<Bound<'py, PyArrayDyn<T>>>> {
    let whole = |(_, shape): &Quantity| -> Vec<usize> { [batch, shape].concat() };
    let Some(out) = out else {
        let new = |quantity: &Quantity| zeros(py, &whole(quantity));
        return quantities.iter().map(new).collect();
    };
    let objects: Vec<Bound<'py, PyAny>> = match quantities.len() {
        1 => vec![out.clone()],
        _ => out.try_iter()?.collect::<PyResult<_>>()?,
    };
    if objects.len() != quantities.len() {
        let (found, expected) = (objects.len(), quantities.len());
        let why = format!("{function}: `out` has {found} arrays, expected {expected}");
        return Err(PyValueError::new_err(why));
    }
    let checked = |(object, quantity): (Bound<'py, PyAny>, &Quantity)| {
        checked(function, object, quantity.0, &whole(quantity))
    };
    objects.into_iter().zip(quantities).map(checked).collect()
}

fn checked<'py, T: Real + Element>(
    function: &str,
    object: Bound<'py, PyAny>,
    name: &str,
    expected: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let shape = shown(expected);
    let array = object.cast_into::<PyArrayDyn<T>>().map_err(|_| {
        let dtype = dtype(T::SCALAR);
        PyTypeError::new_err(format!(
            "{function}: `out` for `{name}` must be an array of {dtype} with shape {shape}"
        ))
    })?;
    if array.shape() != expected {
        let found = shown(array.shape());
        let why = format!("{function}: `out` for `{name}` has shape {found}, expected {shape}");
        return Err(PyValueError::new_err(why));
    }
    let is_writeable = array.getattr("flags")?.getattr("writeable")?;
    match is_writeable.extract()? {
        true => Ok(array),
        false => Err(PyValueError::new_err(format!(
            "{function}: `out` for `{name}` is read-only"
        ))),
    }
}

pub(crate) fn shown(shape: &[usize]) -> String {
    let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
    let end = if shape.len() == 1 { "," } else { "" };
    format!("({}{end})", lengths.join(", "))
}

/// Broadcasts two shapes by NumPy's rule; `None` where they do not fit.
pub(crate) fn broadcast(left: &[usize], right: &[usize]) -> Option<Vec<usize>> {
    let axes = left.len().max(right.len());
    // The length of an axis, counted from the last.
    let length = |shape: &[usize], axis: usize| {
        let place = (axis + shape.len()).checked_sub(axes);
        place.map_or(1, |place| shape[place])
    };
    let both = |axis| match (length(left, axis), length(right, axis)) {
        (1, other) | (other, 1) => Some(other),
        (one, other) => (one == other).then_some(one),
    };
    (0..axes).map(both).collect()
}
