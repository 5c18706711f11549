//! Functions: what is known of them, and their arguments by place or by name.

use std::sync::Arc;

use dalembert_jit::{Function as Compiled, Output, Real, Scalar};
use numpy::{Element, PyArrayDyn};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::call::Call;
use crate::convert::{Quantity, dtype, raised, shown};
use crate::payload::{self, Load};
use crate::xla;

/// A function of an arm, in one scalar or both.
///
/// Call it with one state, arrays of shape ``(n,)``, or with many, ``(N, n)``; leading axes
/// are broadcast by NumPy's rules and lead the result's. Rows and columns, and any other
/// strides that are not negative, are read without a copy.
///
/// Arguments, by place or name, are those of ``arguments``: ``q``, ``qd``, ``qdd``, ``tau``
/// (positions, velocities, accelerations, torques: rad or m, a second, N·m or N), ``v`` and
/// ``a`` of a controller, ``g`` (3,) in m/s², ``load``, a :class:`dalembert.Load`, which
/// ``arm.load`` returns of what it takes: ``payload``, ``bodies``, ``armature`` and ``viscous``.
///
/// ``bodies`` (k, 10) has of each link in ``arm.body_links`` the same ten numbers as a payload, in
/// the frame of the link in the file, that of ``link_poses``; ``armature`` and ``viscous`` have an
/// entry a row of the robot's table.
///
/// ``payload`` (10,) is mass, com x y z, inertia xx yy zz xy yz xz, in kg, m and kg·m²: the
/// centre of mass in the last link's frame, the inertia about the centre of mass in the axes of
/// that frame. It is the frame behind the last row of a table in standard DH, the last joint's
/// own in modified DH, the last moving link's in a URDF, unless the robot file's
/// ``payload_frame`` says otherwise; the tool's pose has no part in it. Numbers that no body has
/// are a ``ValueError``: a negative mass, a principal moment above the sum of the other two.
///
/// ``out`` is an array, or a tuple of several, of the result's shape and dtype; ``threads``
/// share many states among them. Arrays of float32 are computed as such where the arm was
/// loaded with ``scalar="f32"`` or both, else in float64.
///
/// A function with several results returns a named tuple of arrays.
#[pyclass(frozen, module = "dalembert")]
pub struct Function {
    arm: Arc<dalembert_jit::Arm>,
    /// Its places among the arm's functions, in each scalar that it is compiled in.
    places: Vec<usize>,
    arguments: Vec<&'static str>,
    quantities: Vec<Quantity>,
    /// The structure in which several results are returned.
    structure: Option<Py<PyAny>>,
    refuses_nan: bool,
    /// The numbers of bodies that stay zero.
    zeros: Vec<bool>,
    /// The name and the options of the arm, as Python has them.
    loaded: Py<PyAny>,
}

impl Function {
    pub(crate) fn new(
        arm: &Arc<dalembert_jit::Arm>,
        name: &str,
        structure: Option<Py<PyAny>>,
        refuses_nan: bool,
        loaded: Py<PyAny>,
    ) -> PyResult<Function> {
        let functions = arm.functions().iter().enumerate();
        let named = functions.filter(|(_, function)| function.name() == name);
        let places: Vec<usize> = named.map(|(place, _)| place).collect();
        let Some(any) = places.first().map(|&place| &arm.functions()[place]) else {
            return Err(PyValueError::new_err(format!("unknown function `{name}`")));
        };
        let shape = |quantity: &dalembert_jit::Quantity| {
            let lengths = quantity.shape().lengths(any.sizes());
            (quantity.field(), lengths.collect())
        };
        let zeros = match any.output() == Output::Load {
            true => arm.kept_zeros().map_err(raised)?,
            false => Vec::new(),
        };
        let arguments = any.native().signature().arguments.iter();
        Ok(Function {
            zeros,
            arguments: arguments.map(|(argument, _)| argument.name()).collect(),
            quantities: any.output().quantities().iter().map(shape).collect(),
            arm: arm.clone(),
            places,
            structure,
            refuses_nan,
            loaded,
        })
    }

    fn compiled(&self) -> impl Iterator<Item = &Compiled> {
        let functions = self.arm.functions();
        self.places.iter().map(|&place| &functions[place])
    }

    fn is_load(&self) -> bool {
        let mut functions = self.compiled();
        functions.any(|function| function.output() == Output::Load)
    }

    fn in_scalar(&self, scalar: Scalar) -> Option<&Compiled> {
        self.compiled().find(|function| function.scalar() == scalar)
    }
}

#[pymethods]
impl Function {
    #[getter]
    fn __name__(&self) -> &'static str {
        self.compiled().next().map_or("", Compiled::name)
    }

    /// Returns the names of the arguments, in order.
    #[getter]
    fn arguments(&self) -> Vec<&'static str> {
        self.arguments.clone()
    }

    /// Returns the results by name, each with its shape for one state.
    #[getter]
    fn results(&self) -> Vec<Quantity> {
        self.quantities.clone()
    }

    /// Returns the dtypes that it computes in.
    #[getter]
    fn dtypes(&self) -> Vec<&'static str> {
        let functions = self.compiled();
        functions.map(|function| dtype(function.scalar())).collect()
    }

    /// Makes it known to compiled programs of JAX, and returns the number by which they call
    /// it. The arm then lives as long as the process.
    fn xla(&self, name: &str) -> PyResult<u64> {
        let has_name = |place: &&usize| dtype(self.arm.functions()[**place].scalar()) == name;
        let Some(&place) = self.places.iter().find(has_name) else {
            let (function, dtypes) = (self.__name__(), self.dtypes().join(" and "));
            let why = format!("{function}: arrays are {name}, but the arm computes in {dtypes}");
            return Err(PyTypeError::new_err(why));
        };
        Ok(xla::register(&self.arm, place))
    }

    /// Pickles and copies by arm and name: it is proved and compiled again, once a process.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (source, plan) = (self.arm.source(), self.arm.plan());
        let arguments = (self.loaded.bind(py), source, plan, self.__name__());
        py.import("dalembert._arm")?
            .call_method1("_reduced", arguments)
    }

    fn __repr__(&self) -> String {
        let result = |(name, shape): &Quantity| format!("{name} {}", shown(shape));
        let results: Vec<String> = self.quantities.iter().map(result).collect();
        let (name, arguments) = (self.__name__(), self.arguments.join(", "));
        format!("{name}({arguments}) -> {}", results.join(", "))
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
        let mut values = self.given(args, kwargs)?;
        if self.is_load() {
            self.check_bodies(&mut values)?;
        }
        if threads == 0 {
            let why = format!("{}: `threads` is 0, expected 1 or more", self.__name__());
            return Err(PyValueError::new_err(why));
        }
        let out = out.as_ref().filter(|out| !out.is_none());
        // If it has both, floats are for callers that give nothing else.
        let is_f32 = |array: &Bound<'_, PyAny>| array.cast::<PyArrayDyn<f32>>().is_ok();
        match (self.in_scalar(Scalar::F64), self.in_scalar(Scalar::F32)) {
            (double, Some(single)) if double.is_none() || values.iter().all(is_f32) => {
                self.call::<f32>(py, single, &values, out, threads)
            }
            (Some(double), _) => self.call::<f64>(py, double, &values, out, threads),
            (None, _) => Err(PyTypeError::new_err("nothing was compiled")),
        }
    }
}

impl Function {
    /// Refuses bodies that no body is, and puts them one behind the other.
    fn check_bodies(&self, values: &mut [Bound<'_, PyAny>]) -> PyResult<()> {
        let functions = self.compiled().take(1);
        let arguments = functions.flat_map(|function| &function.native().signature().arguments);
        for (value, (argument, length)) in values.iter_mut().zip(arguments) {
            let zeros = match argument.name() {
                "bodies" => {
                    *value = payload::flat(value, *length)?;
                    &self.zeros[..]
                }
                "payload" => &[],
                _ => continue,
            };
            payload::check(argument.name(), value, zeros)?;
        }
        Ok(())
    }

    fn given<'py>(
        &self,
        args: &Bound<'py, PyTuple>,
        kwargs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let names = &self.arguments;
        let mut values: Vec<Bound<'py, PyAny>> = args.iter().collect();
        let wrong = |what: String| {
            let (name, arguments) = (self.__name__(), names.join(", "));
            Err(PyTypeError::new_err(format!("{name}({arguments}): {what}")))
        };
        if values.len() > names.len() {
            let (expected, found) = (names.len(), values.len());
            return wrong(format!("expected {expected} arguments, {found} were given"));
        }
        for name in kwargs.iter().flat_map(|kwargs| kwargs.keys()) {
            let name: String = name.extract()?;
            match names.iter().position(|argument| *argument == name) {
                None => return wrong(format!("there is no argument `{name}`")),
                Some(place) if place < args.len() => {
                    return wrong(format!("argument `{name}` is given twice"));
                }
                Some(_) => {}
            }
        }
        for name in &names[values.len()..] {
            let value = kwargs.map(|kwargs| kwargs.get_item(name)).transpose()?;
            match value.flatten() {
                Some(value) => values.push(value),
                None => return wrong(format!("argument `{name}` is missing")),
            }
        }
        let named = names.iter().zip(&mut values);
        for (_, value) in named.filter(|(name, _)| **name == "load") {
            let load = value.cast::<Load>().ok();
            let Some(numbers) = load.map(|load| load.get().numbers.bind(load.py()).clone()) else {
                let kind = value.get_type();
                let what = format!("`load` is {kind}, expected what `arm.load` returns");
                return wrong(what);
            };
            *value = numbers;
        }
        Ok(values)
    }

    fn call<'py, T: Real + Element>(
        &self,
        py: Python<'py>,
        function: &Compiled,
        values: &[Bound<'py, PyAny>],
        out: Option<&Bound<'py, PyAny>>,
        threads: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = Call {
            function,
            quantities: &self.quantities,
            refuses_nan: self.refuses_nan,
            threads,
        };
        let mut results = call.run::<T>(py, values, out)?.into_iter();
        match (&self.structure, results.next()) {
            (None, Some(result)) if self.is_load() => {
                let numbers = result.into_any().unbind();
                Ok(Bound::new(py, Load { numbers })?.into_any())
            }
            (None, Some(result)) => Ok(result.into_any()),
            (Some(structure), first) => {
                let fields: Vec<_> = first.into_iter().chain(results).collect();
                structure.bind(py).call1(PyTuple::new(py, fields)?)
            }
            (None, None) => Err(PyTypeError::new_err("the function has no results")),
        }
    }
}
