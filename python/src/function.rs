//! Calls: arguments by place or name, their shapes, and the results.

use std::sync::Arc;

use dalembert_jit::{CallError, Function as Compiled, Real, Scalar};
use numpy::{Element, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::array::{Layout, zeros};

/// A function of an arm, in one scalar or both.
///
/// Call it with NumPy arrays: one state, ``(n,)``, or many, ``(N, n)``, which may be
/// broadcast against each other. Results have the same leading axes.
#[pyclass(frozen, module = "dalembert")]
pub struct Function {
    arm: Arc<dalembert_jit::Arm>,
    /// Where it is among the arm's functions, in f64 and in f32.
    places: [Option<usize>; 2],
    /// What several results are returned in.
    structure: Option<Py<PyAny>>,
    raises_on_nan: bool,
}

impl Function {
    pub(crate) fn new(
        arm: Arc<dalembert_jit::Arm>,
        places: [Option<usize>; 2],
        structure: Option<Py<PyAny>>,
        raises_on_nan: bool,
    ) -> Function {
        Function {
            arm,
            places,
            structure,
            raises_on_nan,
        }
    }

    fn any(&self) -> &Compiled {
        let place = self.places[0].or(self.places[1]).unwrap_or_default();
        &self.arm.functions()[place]
    }

    fn in_scalar(&self, scalar: Scalar) -> Option<&Compiled> {
        let place = match scalar {
            Scalar::F64 => self.places[0],
            Scalar::F32 => self.places[1],
        };
        place.map(|place| &self.arm.functions()[place])
    }

    fn argument_names(&self) -> impl Iterator<Item = &'static str> {
        let arguments = self.any().native().signature().arguments.iter();
        arguments.map(|(argument, _)| argument.name())
    }
}

#[pymethods]
impl Function {
    /// The function's name.
    #[getter]
    fn __name__(&self) -> &'static str {
        self.any().name()
    }

    /// The names of the arguments, in order.
    #[getter]
    fn arguments(&self) -> Vec<&'static str> {
        self.argument_names().collect()
    }

    /// The results by name, each with its shape for one state.
    #[getter]
    fn results(&self) -> Vec<(&'static str, Vec<usize>)> {
        shapes(self.any())
    }

    /// The dtypes that it computes in.
    #[getter]
    fn dtypes(&self) -> Vec<&'static str> {
        let names = ["float64", "float32"].into_iter().zip(self.places);
        names
            .filter_map(|(name, place)| place.map(|_| name))
            .collect()
    }

    fn __repr__(&self) -> String {
        let arguments: Vec<&str> = self.argument_names().collect();
        let results = self.results();
        let results: Vec<String> = results
            .iter()
            .map(|(name, shape)| format!("{name} {}", shown(shape)))
            .collect();
        format!(
            "{}({}) -> {}",
            self.__name__(),
            arguments.join(", "),
            results.join(", ")
        )
    }

    #[pyo3(signature = (*args, out=None, threads=1, **kwargs))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        args: &Bound<'py, PyTuple>,
        out: Option<Bound<'py, PyAny>>,
        threads: usize,
        kwargs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = self.given(args, kwargs)?;
        let single = match (self.in_scalar(Scalar::F64), self.in_scalar(Scalar::F32)) {
            (_, None) => false,
            (None, Some(_)) => true,
            // Of both, floats are for who gives nothing else.
            (Some(_), Some(_)) => given
                .iter()
                .all(|array| array.cast::<PyArrayDyn<f32>>().is_ok()),
        };
        let scalar = if single { Scalar::F32 } else { Scalar::F64 };
        let function = self.in_scalar(scalar).ok_or_else(|| {
            PyTypeError::new_err(format!("{}: nothing was compiled", self.__name__()))
        })?;
        match single {
            true => self.call::<f32>(py, function, &given, out, threads),
            false => self.call::<f64>(py, function, &given, out, threads),
        }
    }
}

impl Function {
    /// The arguments in order, by place or by name.
    fn given<'py>(
        &self,
        args: &Bound<'py, PyTuple>,
        kwargs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let mut given: Vec<Bound<'py, PyAny>> = args.iter().collect();
        let names: Vec<&str> = self.argument_names().collect();
        let wrong = |what: String| {
            let arguments = names.join(", ");
            PyTypeError::new_err(format!("{}({arguments}): {what}", self.__name__()))
        };
        if given.len() > names.len() {
            let (expected, found) = (names.len(), given.len());
            return Err(wrong(format!(
                "expected {expected} arguments, {found} were given"
            )));
        }
        let Some(kwargs) = kwargs else {
            return match names.get(given.len()) {
                None => Ok(given),
                Some(missing) => Err(wrong(format!("argument `{missing}` is missing"))),
            };
        };
        for name in kwargs.keys() {
            let name: String = name.extract()?;
            match names.iter().position(|own| *own == name) {
                None => return Err(wrong(format!("there is no argument `{name}`"))),
                Some(place) if place < given.len() => {
                    return Err(wrong(format!("argument `{name}` is given twice")));
                }
                Some(_) => {}
            }
        }
        for name in names.iter().skip(given.len()).copied().collect::<Vec<_>>() {
            match kwargs.get_item(name)? {
                Some(value) => given.push(value),
                None => return Err(wrong(format!("argument `{name}` is missing"))),
            }
        }
        Ok(given)
    }

    fn call<'py, T: Real + Element>(
        &self,
        py: Python<'py>,
        function: &Compiled,
        given: &[Bound<'py, PyAny>],
        out: Option<Bound<'py, PyAny>>,
        threads: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let signature = function.native().signature();
        let mut arrays = Vec::with_capacity(given.len());
        let mut batch: Vec<usize> = Vec::new();
        for (object, &(argument, length)) in given.iter().zip(&signature.arguments) {
            let array = converted::<T>(py, object, function, argument.name())?;
            let shape = array.shape();
            if shape.last() != Some(&length) {
                return Err(PyValueError::new_err(format!(
                    "{}: argument `{}` has shape {}, expected ({length},) or (N, {length})",
                    function.name(),
                    argument.name(),
                    shown(shape),
                )));
            }
            let own = &shape[..shape.len() - 1];
            broadcast(&mut batch, own).map_err(|()| {
                PyValueError::new_err(format!(
                    "{}: argument `{}` has shape {}, whose leading axes {} cannot be broadcast \
                     with those of the arguments before, {}",
                    function.name(),
                    argument.name(),
                    shown(shape),
                    shown(own),
                    shown(&batch),
                ))
            })?;
            arrays.push(array);
        }
        let shapes = shapes(function);
        let results = results::<T>(py, function, &shapes, &batch, out)?;
        let states: usize = batch.iter().product();
        // What lies along one axis is taken where it lies; what does not is copied.
        let mut layouts = Vec::with_capacity(arrays.len());
        let mut copies = Vec::new();
        for array in &arrays {
            let axes = array.ndim() - 1;
            let is_row = axes == 0 || (axes == 1 && batch.len() == 1);
            let layout = is_row.then(|| Layout::of(array, axes)).flatten();
            let layout = match layout {
                Some(mut layout) => {
                    if axes == 1 && array.shape()[0] == 1 {
                        layout.place.state = 0;
                    }
                    layout
                }
                None => {
                    let copy = copied(array, &batch, states)?;
                    let layout = Layout::of(&copy, 1);
                    copies.push(copy);
                    layout.ok_or_else(|| PyValueError::new_err("NumPy made no plain copy"))?
                }
            };
            layouts.push(layout);
        }
        // A result that cannot be written in place, or lies on an argument, is copied there.
        let mut written = Vec::with_capacity(results.len());
        let mut fresh = Vec::new();
        for ((array, is_given), (_, shape)) in results.iter().zip(&shapes) {
            let axes = batch.len();
            let plain = (axes <= 1).then(|| Layout::of(array, axes)).flatten();
            let plain = plain.filter(|layout| {
                let mut others = layouts.iter().chain(&written);
                !is_given || !others.any(|other| other.touches(layout))
            });
            written.push(match plain {
                Some(layout) => layout,
                None => {
                    let flat: Vec<usize> = std::iter::once(states)
                        .chain(shape.iter().copied())
                        .collect();
                    let own = zeros::<T>(py, &flat);
                    let layout = Layout::of(&own, 1);
                    fresh.push((own, array.clone()));
                    layout.ok_or_else(|| PyValueError::new_err("NumPy made no plain array"))?
                }
            });
        }
        if self.raises_on_nan {
            self.refuse_nan(function, &layouts)?;
        }
        let native = function.native();
        let mut run = || -> Result<(), CallError> {
            if batch.is_empty() && written.len() == 1 && is_dense(&layouts) {
                let slices: Vec<&[T]> = layouts.iter().map(Layout::slice).collect();
                if written[0]
                    .place
                    .offsets
                    .iter()
                    .enumerate()
                    .all(|(i, &offset)| i == offset)
                {
                    return native.call(&slices, written[0].slice_mut());
                }
            }
            let rows: Vec<_> = layouts.iter().map(Layout::rows).collect();
            let mut out: Vec<_> = written.iter_mut().map(Layout::rows_mut).collect();
            native.call_rows(&rows, &mut out, states, threads)
        };
        // For a few states, releasing the interpreter takes longer than computing.
        let done = match states > RELEASE {
            true => py.detach(run),
            false => run(),
        };
        done.map_err(|error| PyValueError::new_err(format!("{}: {error}", function.name())))?;
        for (own, array) in fresh {
            let shaped = own.call_method1("reshape", (array.getattr("shape")?,))?;
            array.set_item(py.Ellipsis(), shaped)?;
        }
        drop(copies);
        self.returned(py, results)
    }

    /// The array, or the named tuple of several.
    fn returned<'py, T: Element>(
        &self,
        py: Python<'py>,
        results: Vec<(Bound<'py, PyArrayDyn<T>>, bool)>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut arrays = results.into_iter().map(|(array, _)| array.into_any());
        match &self.structure {
            None => arrays
                .next()
                .ok_or_else(|| PyValueError::new_err("no results")),
            Some(structure) => {
                let arrays = PyTuple::new(py, arrays.collect::<Vec<_>>())?;
                structure.bind(py).call1(arrays)
            }
        }
    }

    fn refuse_nan<T: Real + Element>(
        &self,
        function: &Compiled,
        layouts: &[Layout<T>],
    ) -> PyResult<()> {
        let names = function.native().signature().arguments.iter();
        for (layout, (argument, _)) in layouts.iter().zip(names) {
            let data = layout.slice();
            let farthest = layout.place.offsets.iter().max().map_or(0, |offset| offset + 1);
            let more = data.len().saturating_sub(farthest).checked_div(layout.place.state);
            let states = if data.is_empty() { 0 } else { more.unwrap_or(0) + 1 };
            for state in 0..states {
                let entries = layout.place.offsets.iter().enumerate();
                for (entry, offset) in entries {
                    let value = data.get(state * layout.place.state + offset);
                    if value.is_some_and(|value| value.to_f64().is_nan()) {
                        return Err(PyValueError::new_err(format!(
                            "{}: argument `{}` is not a number at state {state}, entry {entry}",
                            function.name(),
                            argument.name(),
                        )));
                    }
                }
            }
        }
        Ok(())
    }
}

/// From so many states on, other threads of Python may run meanwhile.
const RELEASE: usize = 64;

/// Whether the entries of each argument lie one after the other.
fn is_dense<T: Element>(layouts: &[Layout<T>]) -> bool {
    let mut all = layouts.iter();
    all.all(|layout| {
        layout
            .place
            .offsets
            .iter()
            .enumerate()
            .all(|(i, &offset)| i == offset)
    })
}

/// The results' names and shapes for one state.
pub(crate) fn shapes(function: &Compiled) -> Vec<(&'static str, Vec<usize>)> {
    let quantities = function.output().quantities().iter();
    let of = |quantity: &dalembert_model::outputs::Quantity| {
        (
            quantity.field(),
            quantity.shape().lengths(function.sizes()).collect(),
        )
    };
    quantities.map(of).collect()
}

/// A shape as Python writes it.
fn shown(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => {
            let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
            format!("({})", lengths.join(", "))
        }
    }
}

/// An object as an array of the scalar.
fn converted<'py, T: Real + Element>(
    py: Python<'py>,
    object: &Bound<'py, PyAny>,
    function: &Compiled,
    argument: &str,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    if let Ok(array) = object.cast::<PyArrayDyn<T>>() {
        return Ok(array.clone());
    }
    let wrong = |found: String| {
        PyTypeError::new_err(format!(
            "{}: argument `{argument}` is {found}, expected numbers that are {}",
            function.name(),
            name_of::<T>(),
        ))
    };
    let numpy = py.import("numpy")?;
    let array = numpy.call_method1("asarray", (object,));
    let array = array.map_err(|_| wrong(format!("{}", object.get_type())))?;
    let dtype = array.getattr("dtype")?;
    let kwargs = PyDict::new(py);
    // Integers as well as floats; none that would lose its imaginary part, or digits.
    kwargs.set_item(
        "casting",
        if dtype.getattr("kind")?.eq("f")? {
            "safe"
        } else {
            "same_kind"
        },
    )?;
    let is_python = !object.hasattr("dtype")?;
    if is_python {
        kwargs.set_item("casting", "same_kind")?;
    }
    let cast = array.call_method("astype", (name_of::<T>(),), Some(&kwargs));
    let cast = cast.map_err(|_| wrong(format!("of dtype {dtype}")))?;
    Ok(cast.cast_into::<PyArrayDyn<T>>()?)
}

fn name_of<T: Real>() -> &'static str {
    match T::SCALAR {
        Scalar::F64 => "float64",
        Scalar::F32 => "float32",
    }
}

/// Broadcasts leading axes by NumPy's rule.
fn broadcast(all: &mut Vec<usize>, own: &[usize]) -> Result<(), ()> {
    let mut found = vec![1; all.len().max(own.len())];
    let least = found.len();
    for (axis, length) in found.iter_mut().enumerate() {
        let at = |shape: &[usize]| {
            (axis + shape.len())
                .checked_sub(least)
                .map_or(1, |axis| shape[axis])
        };
        *length = match (at(all), at(own)) {
            (1, other) | (other, 1) => other,
            (left, right) if left == right => left,
            _ => return Err(()),
        };
    }
    *all = found;
    Ok(())
}

/// An argument broadcast to all states, state by state.
fn copied<'py, T: Element>(
    array: &Bound<'py, PyArrayDyn<T>>,
    batch: &[usize],
    states: usize,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let py = array.py();
    let entries = array.shape().last().copied().unwrap_or(0);
    let shape: Vec<usize> = batch.iter().copied().chain([entries]).collect();
    let numpy = py.import("numpy")?;
    let wide = numpy.call_method1("broadcast_to", (array, PyTuple::new(py, shape)?))?;
    let wide = numpy.call_method1("ascontiguousarray", (wide,))?;
    let rows = wide.call_method1("reshape", (states, entries))?;
    Ok(rows.cast_into::<PyArrayDyn<T>>()?)
}

type Results<'py, T> = Vec<(Bound<'py, PyArrayDyn<T>>, bool)>;

/// The arrays to write to: new ones, or the caller's.
fn results<'py, T: Real + Element>(
    py: Python<'py>,
    function: &Compiled,
    shapes: &[(&'static str, Vec<usize>)],
    batch: &[usize],
    out: Option<Bound<'py, PyAny>>,
) -> PyResult<Results<'py, T>> {
    let whole = |shape: &[usize]| -> Vec<usize> { batch.iter().chain(shape).copied().collect() };
    let Some(out) = out else {
        let new = shapes
            .iter()
            .map(|(_, shape)| (zeros::<T>(py, &whole(shape)), false));
        return Ok(new.collect());
    };
    let given: Vec<Bound<'py, PyAny>> = match shapes.len() {
        1 => vec![out],
        _ => out.try_iter()?.collect::<PyResult<_>>()?,
    };
    if given.len() != shapes.len() {
        return Err(PyValueError::new_err(format!(
            "{}: `out` has {} arrays, expected {}",
            function.name(),
            given.len(),
            shapes.len()
        )));
    }
    let check = |(object, (name, shape)): (Bound<'py, PyAny>, &(&'static str, Vec<usize>))| {
        let expected = whole(shape);
        let array = object.cast_into::<PyArrayDyn<T>>().map_err(|_| {
            PyTypeError::new_err(format!(
                "{}: `out` for `{name}` must be an array of {} with shape {}",
                function.name(),
                name_of::<T>(),
                shown(&expected)
            ))
        })?;
        if array.shape() != expected {
            return Err(PyValueError::new_err(format!(
                "{}: `out` for `{name}` has shape {}, expected {}",
                function.name(),
                shown(array.shape()),
                shown(&expected)
            )));
        }
        if !array
            .getattr("flags")?
            .getattr("writeable")?
            .extract::<bool>()?
        {
            return Err(PyValueError::new_err(format!(
                "{}: `out` for `{name}` is read-only",
                function.name()
            )));
        }
        Ok((array, true))
    };
    given.into_iter().zip(shapes).map(check).collect()
}
