//! An arm and its functions.

use std::sync::Arc;

use dalembert_jit::Output;
use dalembert_model::number::Rounded;
use dalembert_model::robot::{HAND, Joint, JointKind, Position};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::convert::raised;
use crate::function::Function;

/// An arm; `dalembert.Arm` is what users have of it.
#[pyclass(frozen, module = "dalembert._dalembert")]
pub struct Arm(pub(crate) Arc<dalembert_jit::Arm>);

/// Returns the names of all outputs, each with a line about it.
#[pyfunction]
pub fn outputs() -> Vec<(&'static str, &'static str)> {
    let about = |output: Output| (output.name(), output.summary());
    Output::ALL.into_iter().map(about).collect()
}

#[pymethods]
impl Arm {
    #[getter]
    fn name(&self) -> &str {
        &self.0.robot().name
    }

    /// Returns the text that the arm was loaded from.
    #[getter]
    fn source(&self) -> &str {
        self.0.source()
    }

    /// Returns the joints: their names and kinds.
    #[getter]
    fn joints(&self) -> Vec<(String, &'static str)> {
        let of = |(number, joint): (usize, &Joint)| {
            let name = joint.name.clone();
            let kind = match joint.kind {
                JointKind::Revolute => "revolute",
                JointKind::Prismatic => "prismatic",
            };
            (name.unwrap_or_else(|| format!("joint{number}")), kind)
        };
        (1..).zip(&self.0.robot().joints).map(of).collect()
    }

    /// Returns the name of the base if it floats, and no scene locks it.
    #[getter]
    fn base(&self) -> Option<String> {
        let floating = self.0.robot().floating.as_ref();
        let base = floating.filter(|_| self.0.floats())?;
        Some(base.name.clone().unwrap_or_else(|| "base".to_owned()))
    }

    /// Returns the frames that outputs may be at.
    #[getter]
    fn frames(&self) -> Vec<String> {
        let robot = self.0.robot();
        let hand = (!robot.is_tree()).then(|| HAND.to_owned());
        let named = robot.frames.iter().map(|frame| frame.name.clone());
        hand.into_iter().chain(named).collect()
    }

    /// Returns each joint's limits: lowest and highest position, velocity, acceleration, torque;
    /// an infinity where there is none.
    #[getter]
    fn limits(&self) -> Vec<[f64; 5]> {
        let joints = self.0.robot().joints.iter().map(|joint| {
            let limits = &joint.limits;
            let infinite_range = [f64::NEG_INFINITY, f64::INFINITY];
            let position = limits.position.as_ref();
            let [low, high] =
                position.map_or(infinite_range, |l| l.each_ref().map(Position::to_f64));
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
        let about = |function: &dalembert_jit::Function| {
            let counts = function.counts();
            let operations = PyDict::new(py);
            for (name, count) in [
                ("mul", counts.mul),
                ("add", counts.add),
                ("div", counts.div),
                ("sqrt", counts.sqrt),
                ("sincos", counts.sincos),
                ("trig_mul", counts.trig_mul),
                ("trig_add", counts.trig_add),
            ] {
                operations.set_item(name, count)?;
            }
            let said = PyDict::new(py);
            said.set_item("name", function.name())?;
            said.set_item("scalar", function.scalar().name())?;
            said.set_item("proof", function.proof())?;
            said.set_item("counts", operations)?;
            Ok(said)
        };
        self.0.functions().iter().map(about).collect()
    }

    /// Returns a function by its name; `structure` makes the named tuple of several results, and
    /// `loaded` is what it is pickled by besides its arm.
    #[pyo3(signature = (name, structure, refuses_nan, loaded))]
    fn function(
        &self,
        name: &str,
        structure: Option<Py<PyAny>>,
        refuses_nan: bool,
        loaded: Py<PyAny>,
    ) -> PyResult<Function> {
        Function::new(&self.0, name, structure, refuses_nan, loaded)
    }

    /// Returns the claim about the functions, as JSON.
    #[getter]
    fn claim(&self) -> &str {
        self.0.claim()
    }

    /// Returns the parameters of every link, by their names.
    #[getter]
    fn parameters(&self) -> PyResult<Vec<(String, f64)>> {
        self.0.parameters().map_err(raised)
    }

    /// Returns the robot's numbers in the place of the arguments of `load`, by their names.
    #[getter]
    fn loading(&self) -> PyResult<Vec<(&'static str, Vec<f64>)>> {
        self.0.loading().map_err(raised)
    }

    /// Returns the links whose bodies are among them.
    #[getter]
    fn body_links(&self) -> PyResult<Vec<usize>> {
        self.0.body_links().map_err(raised)
    }

    /// Returns the base parameters, by the combinations that they are.
    #[getter]
    fn base_parameters(&self, py: Python<'_>) -> PyResult<Vec<(String, f64)>> {
        py.detach(|| self.0.base_parameters()).map_err(raised)
    }

    /// Returns the joints of each limb in the order of `inertia_blocks`.
    #[getter]
    fn limbs(&self) -> PyResult<Vec<Vec<usize>>> {
        self.0.limbs().map_err(raised)
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes().to_vec()
    }

    /// True if nothing was searched for, since it was kept.
    #[getter]
    fn is_from_cache(&self) -> bool {
        self.0.is_from_cache()
    }

    /// True if the search was ended early.
    #[getter]
    fn has_ended_early(&self) -> bool {
        self.0.has_ended_early()
    }

    /// Returns the functions as files of Rust: what their names end in, and their texts.
    fn rust(&self) -> PyResult<Vec<(&'static str, String)>> {
        self.0.files().map_err(raised)
    }

    /// Returns the functions as one header of C99, with its claim and warnings about it.
    fn c(&self, py: Python<'_>, name: Option<String>) -> PyResult<(String, String, Vec<String>)> {
        py.detach(|| self.0.c(name)).map_err(raised)
    }

    #[getter]
    fn robot_file(&self) -> &str {
        self.0.robot_file()
    }

    /// Returns the programs that were found, as a plan beside the robot file.
    #[getter]
    fn plan(&self) -> &str {
        self.0.plan()
    }

    /// Returns the arm at a position, drawn as SVG.
    fn svg(&self, q: Vec<f64>) -> PyResult<String> {
        dalembert_cli::drawing::svg(self.0.robot(), &q)
            .map_err(|error| PyValueError::new_err(error.to_string()))
    }
}
