//! Bodies, which have to be numbers that a body has, and the loads that they are.

use dalembert_model::number::Rational;
use dalembert_model::robot::Inertia;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Numbers = [f64; 10];

/// A load: what ``arm.load`` returns of a payload or of bodies, and what the arm's other functions take
/// as ``load``. No bodies are passed for one.
///
/// ``numbers`` has them as an array, which the arm alone can read; ``dalembert.Load(numbers)``
/// makes them a load again.
#[pyclass(frozen, module = "dalembert")]
pub struct Load {
    /// An array, with leading axes where there are many of them.
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

/// Refuses bodies of the argument of a name that no body is. The call refuses what has not
/// ten numbers a body.
pub(crate) fn check(name: &str, bodies: &Bound<'_, PyAny>, zeros: &[bool]) -> PyResult<()> {
    let numpy = bodies.py().import("numpy")?;
    let Ok(array) = numpy.call_method1("asarray", (bodies,)) else {
        return Ok(());
    };
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let body_count = shape.last().map_or(0, |last| last / 10);
    if shape.last() != Some(&(10 * body_count)) || body_count == 0 {
        return Ok(());
    }
    let rows = array.call_method1("reshape", ((-1, 10),))?;
    let Ok(rows) = rows.call_method0("tolist")?.extract::<Vec<Numbers>>() else {
        return Ok(());
    };
    let mut body_rows = rows.iter().enumerate();
    let wrong = |(place, numbers): (usize, &Numbers)| {
        let zeros = zeros.iter().skip(10 * (place % body_count));
        let why = defect(numbers).or_else(|| filled(numbers, zeros))?;
        Some((place, why))
    };
    let Some((place, why)) = body_rows.find_map(wrong) else {
        return Ok(());
    };
    let mut which = String::new();
    if rows.len() > body_count {
        which += &format!(" at state {}", place / body_count);
    }
    if body_count > 1 {
        which += &format!(", body {}", place % body_count);
    }
    let message = format!("load: argument `{name}`{which}: {why}");
    Err(PyValueError::new_err(message))
}

/// Puts the ten numbers of each body, on an axis of their own, one behind the other.
pub(crate) fn flat<'py>(bodies: &Bound<'py, PyAny>, length: usize) -> PyResult<Bound<'py, PyAny>> {
    let numpy = bodies.py().import("numpy")?;
    let Ok(array) = numpy.call_method1("asarray", (bodies,)) else {
        return Ok(bodies.clone());
    };
    let mut shape: Vec<usize> = array.getattr("shape")?.extract()?;
    if !shape.ends_with(&[length / 10, 10]) {
        return Ok(bodies.clone());
    }
    shape.truncate(shape.len() - 2);
    shape.push(length);
    array.call_method1("reshape", (shape,))
}

/// Finds a number that stays zero and is another.
fn filled<'z>(body: &Numbers, zeros: impl Iterator<Item = &'z bool>) -> Option<String> {
    const NAMES: [&str; 10] = [
        "mass", "x", "y", "z", "Ixx", "Iyy", "Izz", "Ixy", "Iyz", "Ixz",
    ];
    let mut numbers = body.iter().zip(NAMES).zip(zeros);
    let ((number, name), _) =
        numbers.find(|((number, _), is_zero)| **is_zero && **number != 0.0)?;
    Some(format!(
        "{name} is {number}, and stays zero as in the robot file: load the arm without keep_zeros"
    ))
}

/// Moments may be rounded to six digits, as in generated code.
fn defect(body: &Numbers) -> Option<String> {
    let [mass, _, _, _, moments @ ..] = body;
    if !body.iter().all(|x| x.is_finite()) {
        return Some(format!("{body:?} has to be finite numbers"));
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
