//! Payloads, which have to be numbers that a body has, and the loads that they are.

use dalembert_model::number::Rational;
use dalembert_model::robot::Inertia;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Numbers = [f64; 10];

/// A load: what ``arm.load(payload)`` returns, and what the arm's other functions take as
/// ``load``. No payload is passed for one.
///
/// ``numbers`` has them as an array, which the arm alone can read; ``dalembert.Load(numbers)``
/// makes them a load again.
#[pyclass(frozen, module = "dalembert")]
pub struct Load {
    /// An array, with leading axes where there are many payloads.
    #[pyo3(get)]
    pub(crate) numbers: Py<PyAny>,
}

#[pymethods]
impl Load {
    #[new]
    fn new(numbers: Py<PyAny>) -> Load {
        Load { numbers }
    }

    /// Pickles it by its numbers.
    fn __getnewargs__(&self, py: Python<'_>) -> (Py<PyAny>,) {
        (self.numbers.clone_ref(py),)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("Load({})", self.numbers.bind(py).repr()?))
    }
}

/// Refuses payloads that no body is. What has not ten numbers a payload is left to the call.
pub(crate) fn check(payloads: &Bound<'_, PyAny>) -> PyResult<()> {
    let numpy = payloads.py().import("numpy")?;
    let Ok(array) = numpy.call_method1("asarray", (payloads,)) else {
        return Ok(());
    };
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    if shape.last() != Some(&10) {
        return Ok(());
    }
    let rows = array.call_method1("reshape", ((-1, 10),))?;
    let Ok(rows) = rows.call_method0("tolist")?.extract::<Vec<Numbers>>() else {
        return Ok(());
    };
    let mut states = rows.iter().enumerate();
    let Some((state, why)) = states.find_map(|(state, own)| Some((state, defect(own)?))) else {
        return Ok(());
    };
    let which = match rows.len() > 1 {
        true => format!(" at state {state}"),
        false => String::new(),
    };
    let message = format!("load: argument `payload`{which}: {why}");
    Err(PyValueError::new_err(message))
}

/// Moments may be rounded to six digits, as in generated code.
fn defect(payload: &Numbers) -> Option<String> {
    let [mass, _, _, _, moments @ ..] = payload;
    if !payload.iter().all(|x| x.is_finite()) {
        return Some(format!("{payload:?} has to be finite numbers"));
    }
    if *mass < 0.0 {
        return Some(format!("the mass is {mass}, expected kg, zero or more"));
    }
    let exact = |x: &f64| Rational::from_float(*x).unwrap_or_default();
    let mut inertia = Inertia::of(moments.each_ref().map(exact));
    let trace = &inertia.xx + &inertia.yy + &inertia.zz;
    let slack = trace * exact(&1e-6);
    for moment in [&mut inertia.xx, &mut inertia.yy, &mut inertia.zz] {
        *moment = &*moment + &slack;
    }
    let defect = inertia.defect(&exact(mass))?;
    Some(format!(
        "inertia {moments:?}: {}; the order is Ixx, Iyy, Izz, Ixy, Iyz, Ixz about the centre of mass",
        defect.message()
    ))
}
