//! A call with arrays: arguments checked and broadcast, results written in place or copied.

use dalembert_jit::{Error, Function as Compiled, MOST_ARGUMENTS, Real};
use numpy::{Element, PyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::convert::{self, Quantity, broadcast, shown};
use crate::memory::{self, Layout};

/// For fewer states, letting other threads of Python run takes longer than computing.
const RELEASE: usize = 64;

pub(crate) struct Call<'a> {
    pub(crate) function: &'a Compiled,
    pub(crate) quantities: &'a [Quantity],
    pub(crate) refuses_nan: bool,
    pub(crate) threads: usize,
}

type Arrays<'py, T> = Vec<Bound<'py, PyArrayDyn<T>>>;

impl Call<'_> {
    fn name(&self) -> &'static str {
        self.function.name()
    }

    fn failed(&self, error: &Error) -> PyErr {
        PyValueError::new_err(format!("{}: {error}", self.name()))
    }

    pub(crate) fn run<'py, T: Real + Element>(
        &self,
        py: Python<'py>,
        objects: &[Bound<'py, PyAny>],
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Arrays<'py, T>> {
        if let Some(results) = self.one_state(py, objects, out) {
            return results;
        }
        let (arrays, batch) = self.arguments::<T>(objects)?;
        let product = |states: usize, &axis: &usize| states.checked_mul(axis);
        let states = batch.iter().try_fold(1, product).ok_or_else(|| {
            let (name, batch) = (self.name(), shown(&batch));
            PyMemoryError::new_err(format!(
                "{name}: the batch shape {batch} has more states than fit in memory"
            ))
        })?;
        let read = arrays.iter().map(|array| argument(array, &batch, states));
        let (read, _copies): (Vec<Layout<T>>, Vec<Copy<'py, T>>) =
            read.collect::<PyResult<Vec<_>>>()?.into_iter().unzip();
        for (place, layout) in read.iter().enumerate().filter(|_| self.refuses_nan) {
            if let Some((state, entry)) = layout.find(|value| value.to_f64().is_nan()) {
                return Err(self.refused(place, state, entry));
            }
        }
        let results = convert::arrays::<T>(py, self.name(), self.quantities, &batch, out)?;
        let mut written: Vec<Layout<T>> = Vec::with_capacity(results.len());
        let mut copies = Vec::with_capacity(results.len());
        for (array, (_, shape)) in results.iter().zip(self.quantities) {
            let taken = || read.iter().chain(&written);
            let (layout, copy) = result(array, shape, batch.len(), states, taken())?;
            written.push(layout);
            copies.push(copy);
        }
        let native = self.function.native();
        let threads = self.threads;
        let mut compute = || {
            let rows: Vec<_> = read.iter().map(Layout::rows).collect();
            let mut out: Vec<_> = written.iter_mut().map(Layout::rows_mut).collect();
            native.call_rows(&rows, &mut out, states, threads)
        };
        let done = match states > RELEASE {
            true => py.detach(compute),
            false => compute(),
        };
        done.map_err(|error| self.failed(&error))?;
        for (copy, array) in copies.iter().zip(&results) {
            if let Some(copy) = copy {
                let shape = PyTuple::new(py, array.shape())?;
                let shaped = copy.call_method1("reshape", (shape,))?;
                array.set_item(py.Ellipsis(), shaped)?;
            }
        }
        Ok(results)
    }

    /// The shortest way, for control loops of one state in plain arrays; `None` for other calls.
    fn one_state<'py, T: Real + Element>(
        &self,
        py: Python<'py>,
        objects: &[Bound<'py, PyAny>],
        out: Option<&Bound<'py, PyAny>>,
    ) -> Option<PyResult<Arrays<'py, T>>> {
        let out = match (out, self.quantities) {
            (None, _) => None,
            (Some(out), [(_, shape)]) => {
                let array = out.cast::<PyArrayDyn<T>>().ok()?;
                Some(memory::writeable(array, shape).then_some(array)?)
            }
            (Some(_), _) => return None,
        };
        let native = self.function.native();
        let mut slices: [&[T]; MOST_ARGUMENTS] = [&[]; MOST_ARGUMENTS];
        let arguments = objects.iter().zip(&native.signature().arguments);
        for (slice, (object, &(_, length))) in slices.iter_mut().zip(arguments) {
            let array = object.cast::<PyArrayDyn<T>>().ok()?;
            *slice = memory::entries(array).filter(|entries| entries.len() == length)?;
        }
        let slices = slices.get(..objects.len())?;
        if self.refuses_nan {
            let first_nan = |slice: &&[T]| slice.iter().position(|value| value.to_f64().is_nan());
            let mut entries = slices.iter().map(first_nan).enumerate();
            if let Some((place, entry)) = entries.find_map(|(place, e)| Some((place, e?))) {
                return Some(Err(self.refused(place, 0, entry)));
            }
        }
        if let ([(_, shape)], None) = (self.quantities, out) {
            let array = memory::filled(py, shape, |result| {
                let done = native.call(slices, result);
                done.map_err(|error| self.failed(&error))
            });
            return Some(array.map(|array| vec![array]));
        }
        let mut values = vec![T::default(); native.program().dag.outputs.len()];
        if let Err(error) = native.call(slices, &mut values) {
            return Some(Err(self.failed(&error)));
        }
        if let Some(array) = out {
            memory::write(array, &values);
            return Some(Ok(vec![array.clone()]));
        }
        let mut rest = values.as_slice();
        let array = |(_, shape): &Quantity| -> PyResult<_> {
            let (entries, others) = rest.split_at(shape.iter().product());
            rest = others;
            let array = memory::zeros(py, shape)?;
            memory::write(&array, entries);
            Ok(array)
        };
        Some(self.quantities.iter().map(array).collect())
    }

    fn refused(&self, place: usize, state: usize, entry: usize) -> PyErr {
        let argument = self.function.native().signature().arguments[place].0;
        PyValueError::new_err(format!(
            "{}: argument `{}` is not a number at state {state}, entry {entry}",
            self.name(),
            argument.name(),
        ))
    }

    fn arguments<'py, T: Real + Element>(
        &self,
        objects: &[Bound<'py, PyAny>],
    ) -> PyResult<(Arrays<'py, T>, Vec<usize>)> {
        let signature = self.function.native().signature();
        let mut arrays = Vec::with_capacity(objects.len());
        let mut batch: Vec<usize> = Vec::new();
        for (object, &(argument, length)) in objects.iter().zip(&signature.arguments) {
            let array = convert::array::<T>(object, self.name(), argument.name())?;
            let wrong = |why: String| {
                let (function, shape) = (self.name(), shown(array.shape()));
                PyValueError::new_err(format!(
                    "{function}: argument `{}` has shape {shape}, {why}",
                    argument.name(),
                ))
            };
            let split = array.shape().split_last();
            let Some((_, leading_axes)) = split.filter(|(last, _)| **last == length) else {
                return Err(wrong(format!("expected ({length},) or (N, {length})")));
            };
            batch = broadcast(&batch, leading_axes).ok_or_else(|| {
                wrong(format!(
                    "whose leading axes {} cannot be broadcast with those of the arguments \
                     before, {}",
                    shown(leading_axes),
                    shown(&batch),
                ))
            })?;
            arrays.push(array);
        }
        Ok((arrays, batch))
    }
}

/// An array that a call was given a copy of, to be held while it runs.
type Copy<'py, T> = Option<Bound<'py, PyArrayDyn<T>>>;

/// Copies an argument, states one after the other, unless they are along one axis at most.
fn argument<'py, T: Real + Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
    batch: &[usize],
    states: usize,
) -> PyResult<(Layout<T>, Copy<'py, T>)> {
    let axes = array.ndim() - 1;
    if (axes == 0 || (axes == 1 && batch.len() == 1))
        && let Some(layout) = Layout::of(array, axes)
    {
        return Ok((layout, None));
    }
    let py = array.py();
    let entries = array.shape()[axes];
    let numpy = py.import("numpy")?;
    let shape = PyTuple::new(py, [batch, &[entries]].concat())?;
    let wide = numpy.call_method1("broadcast_to", (array, shape))?;
    let wide = numpy.call_method1("require", (wide, py.None(), ["C", "A"]))?;
    let rows = wide.call_method1("reshape", ((states, entries),))?;
    copied(rows.cast_into::<PyArrayDyn<T>>()?)
}

/// Takes a result where it is to lie if nothing else of the call is there; else new memory.
fn result<'py, 'l, T: Real + Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
    shape: &[usize],
    axes: usize,
    states: usize,
    mut taken: impl Iterator<Item = &'l Layout<T>>,
) -> PyResult<(Layout<T>, Copy<'py, T>)> {
    if axes <= 1
        && let Some(layout) = Layout::of(array, axes)
        && !taken.any(|other| other.touches(&layout))
    {
        return Ok((layout, None));
    }
    copied(memory::zeros(array.py(), &[&[states], shape].concat())?)
}

fn copied<T: Element>(copy: Bound<'_, PyArrayDyn<T>>) -> PyResult<(Layout<T>, Copy<'_, T>)> {
    let layout =
        Layout::of(&copy, 1).ok_or_else(|| PyValueError::new_err("NumPy made no plain copy"))?;
    Ok((layout, Some(copy)))
}
