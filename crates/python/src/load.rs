//! Loading an arm, with progress and an end by Ctrl-C.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use dalembert_jit::{Cache, Load, OPTIONS, Observer, Progress, Watch};
use dalembert_model::number::Rational;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::robot::suggested_name;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arm::Arm;
use crate::convert::raised;

/// The time between two looks of a waiting interpreter for signals.
const PATIENCE: Duration = Duration::from_millis(50);

/// Deep expressions of large arms.
const STACK: usize = 64 << 20;

#[derive(Default)]
struct SignalWatch {
    last: Mutex<Option<Progress>>,
    stop: AtomicBool,
}

impl Observer for SignalWatch {
    fn step(&self, progress: &Progress) {
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(*progress);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl SignalWatch {
    fn show(&self, progress: &Bound<'_, PyAny>) -> PyResult<()> {
        let last = *self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let (text, done) = match last {
            None => ("reading the robot".to_owned(), None),
            Some(news) => {
                let best = news.best.map(|best| format!(", best {best}"));
                let (best, part) = (best.unwrap_or_default(), news.part.name());
                let done = (news.rounds > 0).then(|| news.round as f64 / news.rounds as f64);
                (format!("{}: {part}{best}", news.function), done)
            }
        };
        progress.call1((text, done))?;
        Ok(())
    }
}

/// Loads an arm from a file, or from its text with a name for messages, and with a plan's if
/// there is one; `options` are those of `dalembert.load`, and `progress` is called as long as it
/// takes, with what is done and how much of it.
#[pyfunction]
#[pyo3(signature = (path, text, plan, options, progress))]
pub fn load(
    py: Python<'_>,
    path: PathBuf,
    text: Option<String>,
    plan: Option<String>,
    options: &Bound<'_, PyDict>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Arm> {
    let waiting = Arc::new(SignalWatch::default());
    let mut load = wanted(&Options(options))?;
    load.watch = Watch::new(waiting.clone());
    let is_thorough = load.asked.get("effort") == Some("thorough");
    let (sender, receiver) = channel();
    // Shared with the closure that waits while other threads of Python run.
    let receiver = Mutex::new(receiver);
    let work = move || {
        let arm = match text {
            Some(text) => {
                let name = path.display().to_string();
                dalembert_jit::Arm::parse(&text, &name, plan.as_deref(), &load)
            }
            None => dalembert_jit::Arm::load(path, &load),
        };
        // Nobody may wait any more.
        let _ = sender.send(arm);
    };
    let thread = std::thread::Builder::new()
        .stack_size(STACK)
        .spawn(work)
        .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    loop {
        let outcome = py.detach(|| {
            let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
            receiver.recv_timeout(PATIENCE)
        });
        match outcome {
            Ok(loaded) => {
                // The next thread takes the allocator's memory of one that has ended, and would
                // get some more beside one that is about to. A panic has no arm to return.
                let _ = py.detach(|| thread.join());
                return Ok(Arm(Arc::new(loaded.map_err(raised)?)));
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the search ended without a result"));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(error) = py.check_signals() {
            // A thorough search has a best so far, the first time that it is asked for.
            let is_first = !waiting.stop.swap(true, Ordering::Relaxed);
            if !(is_thorough && is_first && error.is_instance_of::<PyKeyboardInterrupt>(py)) {
                return Err(error);
            }
        }
        if let Some(progress) = &progress {
            waiting.show(progress)?;
        }
    }
}

/// Options by their names; `None` where nothing was chosen.
struct Options<'a, 'py>(&'a Bound<'py, PyDict>);

impl<'py> Options<'_, 'py> {
    fn get<T: FromPyObjectOwned<'py>>(&self, name: &str) -> PyResult<Option<T>> {
        let value = self.0.get_item(name)?.filter(|value| !value.is_none());
        let Some(value) = value else {
            return Ok(None);
        };
        let result = value.extract();
        result.map(Some).map_err(|_| {
            let kind = value.get_type();
            PyTypeError::new_err(format!("{name}: {value} has the wrong type, {kind}"))
        })
    }
}

fn acceleration(text: String) -> PyResult<Rational> {
    let number = parse_decimal(&text).ok();
    let number = number.filter(|number| *number > Rational::default());
    number.ok_or_else(|| {
        PyValueError::new_err(format!(
            "acceleration: expected a number above zero, such as 10, in rad/s² or m/s²; found {text}"
        ))
    })
}

fn name(text: String) -> PyResult<String> {
    let good = suggested_name(&text);
    if good.as_ref() == Some(&text) {
        return Ok(text);
    }
    Err(PyValueError::new_err(format!(
        "name: expected lower-case letters, digits and `_`, such as {}; found {text}",
        good.as_deref().unwrap_or("arm")
    )))
}

fn wanted(options: &Options<'_, '_>) -> PyResult<Load> {
    let mut load = Load::default();
    load.urdf.base = options.get("base")?;
    load.urdf.tips = options.get("tip")?.unwrap_or_default();
    load.urdf.tree = options.get("tree")?.unwrap_or_default();
    load.urdf.floating = options.get("floating")?.unwrap_or_default();
    load.urdf.lock = options.get("lock")?.unwrap_or_default();
    load.urdf.without = options.get("without")?.unwrap_or_default();
    load.urdf.exact = options.get("exact")?.unwrap_or_default();
    load.urdf.snap = options.get("snap")?.unwrap_or_default();
    load.urdf.ignore_ties = options.get("ignore_ties")?.unwrap_or_default();
    load.urdf.acceleration = options.get("acceleration")?.map(acceleration).transpose()?;
    load.urdf.name = options.get("name")?.map(name).transpose()?;
    let joined = |items: Vec<String>| items.join(",");
    for row in &OPTIONS {
        // The header of C has a name of its own.
        if row.name == "name" {
            continue;
        }
        let value = match row.is_list {
            true => options.get(row.name)?.map(joined),
            false => options.get::<String>(row.name)?,
        };
        if let Some(value) = value {
            // It is an option.
            let _ = load.asked.set(row.name, &value);
        }
    }
    load.cache = match options.get::<PathBuf>("cache_folder")? {
        Some(folder) => Cache::At(folder),
        None if options.get("cache")?.unwrap_or(true) => Cache::User,
        None => Cache::Off,
    };
    Ok(load)
}
