//! The arrays that results are written to.

use dalembert_jit::Real;
use numpy::{Element, PyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::convert::dtype;
use crate::memory::zeros;
use crate::shape::shown;

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
        let new = quantities
            .iter()
            .map(|quantity| zeros(py, &whole(quantity)));
        return new.collect();
    };
    let given: Vec<Bound<'py, PyAny>> = match quantities.len() {
        1 => vec![out.clone()],
        _ => out.try_iter()?.collect::<PyResult<_>>()?,
    };
    if given.len() != quantities.len() {
        let (found, expected) = (given.len(), quantities.len());
        return Err(PyValueError::new_err(format!(
            "{function}: `out` has {found} arrays, expected {expected}"
        )));
    }
    let both = given.into_iter().zip(quantities);
    both.map(|(object, quantity)| checked(function, object, quantity.0, &whole(quantity)))
        .collect()
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
        return Err(PyValueError::new_err(format!(
            "{function}: `out` for `{name}` has shape {found}, expected {shape}"
        )));
    }
    let is_writeable = array.getattr("flags")?.getattr("writeable")?;
    match is_writeable.extract()? {
        true => Ok(array),
        false => Err(PyValueError::new_err(format!(
            "{function}: `out` for `{name}` is read-only"
        ))),
    }
}
