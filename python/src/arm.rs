//! Loading an arm, with progress, and what is known of it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use dalembert_jit::watch::{Observer, Progress, Watch};
use dalembert_jit::{
    Cache, Effort, Load, LoadError, Output, Prefer, RuntimeParameter, Scalar, SinCos,
};
use dalembert_model::number::Rounded;
use dalembert_model::read::closest;
use dalembert_model::robot::{JointKind, Position};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::function::Function;

/// An arm; `dalembert.Arm` is what users have of it.
#[pyclass(frozen, module = "dalembert._dalembert")]
pub struct Arm(Arc<dalembert_jit::Arm>);

/// How often a waiting interpreter looks for signals.
const PATIENCE: Duration = Duration::from_millis(50);

/// Deep expressions of large arms.
const STACK: usize = 64 << 20;

/// Who waits: what to show, and whether to end.
#[derive(Default)]
struct Waiting {
    last: Mutex<Option<String>>,
    stop: AtomicBool,
}

impl Observer for Waiting {
    fn step(&self, progress: &Progress) {
        let Progress {
            function,
            part,
            round,
            rounds,
            best,
        } = progress;
        let mut text = format!("{function}: {part}");
        if *rounds > 0 {
            text += &format!(" {round}/{rounds}");
        }
        if let Some(best) = best {
            text += &format!(", best {best}");
        }
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(text);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// The words that an option has, and the one that is meant.
fn chosen<T: Copy>(option: &str, word: &str, words: &[(&str, T)]) -> PyResult<T> {
    let found = words.iter().find(|(name, _)| *name == word);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
        let help = match closest(word, &names) {
            Some(meant) => format!("did you mean {meant:?}?"),
            None => format!("expected one of {}", names.join(", ")),
        };
        PyValueError::new_err(format!("{option}: there is no {word:?}; {help}"))
    })
}

fn output_words() -> Vec<(&'static str, Output)> {
    Output::ALL
        .into_iter()
        .map(|output| (output.name(), output))
        .collect()
}

/// Returns the names of all outputs, each with a line about it.
#[pyfunction]
pub fn outputs() -> Vec<(&'static str, &'static str)> {
    Output::ALL
        .into_iter()
        .map(|output| (output.name(), output.summary()))
        .collect()
}

fn scalar_of(word: &str) -> PyResult<Scalar> {
    chosen(
        "scalar",
        word,
        &Scalar::ALL.map(|scalar| (scalar.name(), scalar)),
    )
}

/// Loads an arm from the text of a robot file or a URDF; `options` are those of
/// `dalembert.load`, checked there for their types.
#[pyfunction]
#[pyo3(signature = (source, name, path, options, progress))]
pub fn load(
    py: Python<'_>,
    source: String,
    name: String,
    path: Option<std::path::PathBuf>,
    options: &Bound<'_, PyDict>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Arm> {
    let waiting = Arc::new(Waiting::default());
    let mut load = wanted(options)?;
    load.watch = Watch::by(waiting.clone());
    let is_thorough = load.effort == Effort::Thorough;
    let (sender, receiver) = channel();
    // Shared with the closure that waits while other threads of Python run.
    let receiver = Mutex::new(receiver);
    let work = move || {
        let arm = match path {
            Some(path) => dalembert_jit::Arm::load(path, &load),
            None => dalembert_jit::Arm::parse(&source, &name, &load),
        };
        // Nobody may wait any more.
        let _ = sender.send(arm);
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(work);
    thread.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let mut interrupted: Option<PyErr> = None;
    loop {
        match py.detach(|| {
            let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
            receiver.recv_timeout(PATIENCE)
        }) {
            Ok(arm) => {
                let arm = arm.map_err(|error| raised(&error))?;
                return match interrupted {
                    // Of a short search there is no best so far.
                    Some(error) if !is_thorough => Err(error),
                    _ => Ok(Arm(Arc::new(arm))),
                };
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the search ended without a result"));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(error) = py.check_signals() {
            let is_first = interrupted.is_none() && error.is_instance_of::<PyKeyboardInterrupt>(py);
            if !is_first {
                return Err(error);
            }
            waiting.stop.store(true, Ordering::Relaxed);
            interrupted = Some(error);
        }
        if let Some(progress) = &progress {
            let news = waiting
                .last
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
            if let Some(text) = news {
                progress.call1((text,))?;
            }
        }
    }
}

fn raised(error: &LoadError) -> PyErr {
    match error {
        LoadError::Compile(..) | LoadError::Certificate(_) => {
            PyRuntimeError::new_err(error.to_string())
        }
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// The request of options.
fn wanted(options: &Bound<'_, PyDict>) -> PyResult<Load> {
    fn option<'py, T: pyo3::conversion::FromPyObjectOwned<'py>>(
        options: &Bound<'py, PyDict>,
        name: &str,
    ) -> PyResult<Option<T>> {
        let Some(value) = options.get_item(name)?.filter(|value| !value.is_none()) else {
            return Ok(None);
        };
        let found = value.extract().map(Some);
        found.map_err(|_| PyValueError::new_err(format!("{name}: {value} is of another type")))
    }
    let words = |name: &str| option::<Vec<String>>(options, name);
    let mut load = Load::default();
    load.urdf.base = option(options, "base")?;
    load.urdf.tip = option(options, "tip")?;
    load.urdf.lock = option(options, "lock")?.unwrap_or_default();
    load.urdf.without = words("without")?.unwrap_or_default();
    load.urdf.exact = option(options, "exact")?.unwrap_or_default();
    load.outputs = match words("outputs")? {
        None => None,
        Some(names) => {
            let known = output_words();
            let all: PyResult<Vec<Output>> = names
                .iter()
                .map(|name| chosen("outputs", name, &known))
                .collect();
            Some(all?)
        }
    };
    load.scalars = match words("scalar")? {
        None => None,
        Some(names) => Some(
            names
                .iter()
                .map(|name| scalar_of(name))
                .collect::<PyResult<_>>()?,
        ),
    };
    let parameters = RuntimeParameter::ALL.map(|parameter| (parameter.name(), parameter));
    for name in words("parameters")?.unwrap_or_default() {
        load.parameters
            .push(chosen("parameters", &name, &parameters)?);
    }
    load.scene = option(options, "scene")?;
    if let Some(word) = option::<String>(options, "effort")? {
        let words = [("quick", Effort::Quick), ("thorough", Effort::Thorough)];
        load.effort = chosen("effort", &word, &words)?;
    }
    if let Some(word) = option::<String>(options, "prefer")? {
        load.prefer = chosen("prefer", &word, &Prefer::ALL.map(|p| (p.name(), p)))?;
    }
    if let Some(word) = option::<String>(options, "sincos")? {
        let words = SinCos::NAMES.map(|name| (name, SinCos::from_name(name).unwrap_or_default()));
        load.sincos = chosen("sincos", &word, &words)?;
    }
    load.cache = match options.get_item("cache")? {
        Some(value) if value.is_none() => Cache::User,
        Some(value) => match value.extract::<bool>() {
            Ok(true) => Cache::User,
            Ok(false) => Cache::Off,
            Err(_) => Cache::At(value.extract()?),
        },
        None => Cache::User,
    };
    Ok(load)
}

#[pymethods]
impl Arm {
    /// The robot's name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.robot().name
    }

    /// The joints: their names and kinds.
    #[getter]
    fn joints(&self) -> Vec<(String, &'static str)> {
        let joints = self.0.robot().joints.iter().enumerate();
        let of = |(index, joint): (usize, &dalembert_model::robot::Joint)| {
            let name = joint
                .name
                .clone()
                .unwrap_or_else(|| format!("joint{}", index + 1));
            let kind = match joint.kind {
                JointKind::Revolute => "revolute",
                JointKind::Prismatic => "prismatic",
            };
            (name, kind)
        };
        joints.map(of).collect()
    }

    /// Each joint's limits: lowest and highest position, velocity, acceleration, torque;
    /// an infinity where there is none.
    #[getter]
    fn limits(&self) -> Vec<[f64; 5]> {
        let value = |position: &Position| match position {
            Position::Angle(angle) => angle.to_f64(),
            Position::Length(length) => f64::nearest_rational(length),
        };
        let joints = self.0.robot().joints.iter().map(|joint| {
            let limits = &joint.limits;
            let all = [f64::NEG_INFINITY, f64::INFINITY];
            let [low, high] = limits
                .position
                .as_ref()
                .map_or(all, |l| l.each_ref().map(value));
            let [velocity, acceleration, torque] =
                [&limits.velocity, &limits.acceleration, &limits.torque]
                    .map(|most| most.as_ref().map_or(f64::INFINITY, f64::nearest_rational));
            [low, high, velocity, acceleration, torque]
        });
        joints.collect()
    }

    /// Operations and proof of each function, by name and scalar.
    #[getter]
    fn functions<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let functions = self.0.functions().iter().map(|function| {
            let counts = function.counts();
            let said = PyDict::new(py);
            said.set_item("name", function.name())?;
            said.set_item("scalar", function.scalar().name())?;
            said.set_item("summary", function.output().summary())?;
            said.set_item("proof", function.proof())?;
            let all = PyDict::new(py);
            for (name, count) in [
                ("mul", counts.mul),
                ("add", counts.add),
                ("div", counts.div),
                ("sqrt", counts.sqrt),
                ("fma", counts.fma),
                ("sincos", counts.sincos),
                ("trig_mul", counts.trig_mul),
                ("trig_add", counts.trig_add),
            ] {
                all.set_item(name, count)?;
            }
            said.set_item("counts", all)?;
            Ok(said)
        });
        functions.collect()
    }

    /// A function by its name; `structure` makes the named tuple of several results.
    #[pyo3(signature = (name, structure, raises_on_nan))]
    fn function(
        &self,
        name: &str,
        structure: Option<Py<PyAny>>,
        raises_on_nan: bool,
    ) -> PyResult<Function> {
        let place = |scalar: Scalar| {
            let mut all = self.0.functions().iter();
            all.position(|function| function.name() == name && function.scalar() == scalar)
        };
        let places = Scalar::ALL.map(place);
        if places == [None, None] {
            return Err(PyValueError::new_err(format!(
                "there is no function {name:?}"
            )));
        }
        Ok(Function::new(
            self.0.clone(),
            places,
            structure,
            raises_on_nan,
        ))
    }

    /// The certificates of a scene's tolerance, as JSON.
    #[getter]
    fn certificates(&self) -> Option<&str> {
        self.0.certificates()
    }

    /// What there is to know of the robot and its functions.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes().to_vec()
    }

    /// Whether nothing was searched for, since it was kept.
    #[getter]
    fn is_from_cache(&self) -> bool {
        self.0.is_from_cache()
    }

    /// Whether the search was ended early.
    #[getter]
    fn has_ended_early(&self) -> bool {
        self.0.has_ended_early()
    }

    /// The functions as Rust.
    #[getter]
    fn rust(&self) -> &str {
        self.0.rust()
    }

    /// The robot as a robot file.
    #[getter]
    fn robot_file(&self) -> &str {
        self.0.robot_file()
    }

    /// The programs that were found, as a plan beside the robot file.
    #[getter]
    fn plan(&self) -> &str {
        self.0.plan()
    }

    /// The arm at a position, drawn as SVG.
    fn svg(&self, q: Vec<f64>) -> PyResult<String> {
        dalembert_report::drawing::svg(self.0.robot(), &q)
            .map_err(|error| PyValueError::new_err(error.to_string()))
    }
}
