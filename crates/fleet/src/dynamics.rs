//! The dynamics that functions ask of a robot: torques and rows of the regressor, for many states.
//!
//! States lie in columns: entry i of state s at `i * states + s`.

use std::fmt;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use dalembert_fit::model::without_rotors;
use dalembert_fit::{Accumulator, Model};
use dalembert_jit::{Arm, Asked, Load, Native, Output, Place, Scalar};
use dalembert_model::robot::{Robot, write};

use crate::error::Error;

/// Positions, rad or m, velocities and accelerations of many states, in columns.
#[derive(Clone, Copy, Debug)]
pub struct States<'a> {
    pub count: usize,
    pub q: &'a [f64],
    pub qd: &'a [f64],
    pub qdd: &'a [f64],
}

/// A robot whose functions are registered.
pub trait Dynamics: fmt::Debug + Send + Sync + 'static {
    fn joints(&self) -> usize;

    /// Computes the torques of states into columns; arrays have the lengths that `count` asks for.
    fn inverse_dynamics(&self, states: States<'_>, tau: &mut [f64]) -> Result<(), Error>;

    /// Computes residuals of so many states, in columns: measured torques less the robot's.
    fn residuals(
        &self,
        count: usize,
        [q, qd, qdd, measured]: &[Vec<f64>; 4],
        into: &mut Vec<f64>,
    ) -> Result<(), Error> {
        into.resize(measured.len(), 0.0);
        self.inverse_dynamics(States { count, q, qd, qdd }, into)?;
        for (residual, measured) in into.iter_mut().zip(measured) {
            *residual = measured - *residual;
        }
        Ok(())
    }

    /// Returns the columns of the regressor, if parameters can be identified.
    fn model(&self) -> Option<&Model> {
        None
    }

    /// Adds states and their measured torques to a fit; `room` is memory, kept between calls.
    fn accumulate(
        &self,
        states: States<'_>,
        tau: &[f64],
        _room: &mut Vec<f64>,
        into: &mut Accumulator,
    ) -> Result<(), Error> {
        let model = self.model().ok_or_else(no_model)?;
        let n = self.joints();
        let mut at = [(); 4].map(|()| vec![0.0; n]);
        for s in 0..states.count {
            for i in 0..n {
                let place = i * states.count + s;
                for (at, from) in at.iter_mut().zip([states.q, states.qd, states.qdd, tau]) {
                    at[i] = from[place];
                }
            }
            let [q, qd, qdd, tau] = &at;
            into.add(model, [q, qd, qdd], tau)?;
        }
        Ok(())
    }
}

pub(crate) fn no_model() -> Error {
    Error::new("this robot was registered without the columns that a fit needs")
}

/// Any robot, at run time: a robot file or a URDF, its functions compiled in memory.
pub struct Loaded {
    arm: Arm,
    fitted: Option<(Model, Arm)>,
    evaluated: Arc<AtomicU64>,
}

impl fmt::Debug for Loaded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Loaded({})", self.arm.robot().name)
    }
}

impl Loaded {
    /// Loads a robot file or a URDF; with `fit`, the regressor too.
    pub fn open(path: &Path, urdf: &dalembert_import::Options, fit: bool) -> Result<Loaded, Error> {
        let arm = Arm::load(path, &load(urdf, Output::InverseDynamics)).map_err(Error::new)?;
        let model = fit.then(|| Model::new(arm.robot()));
        Loaded::with(arm, model.transpose()?)
    }

    /// Loads a robot as [`Loaded::open`] does, without rotors: for torques behind the gears.
    pub fn without_rotors(
        path: &Path,
        urdf: &dalembert_import::Options,
        fit: bool,
    ) -> Result<Loaded, Error> {
        let load = load(urdf, Output::InverseDynamics);
        let mut arm = Arm::load(path, &load).map_err(Error::new)?;
        let robot = without_rotors(arm.robot());
        if robot != *arm.robot() {
            let name = path.display().to_string();
            arm = Arm::parse(&write(&robot), &name, None, &load).map_err(Error::new)?;
        }
        let model = fit.then(|| Model::without_rotors(arm.robot()));
        Loaded::with(arm, model.transpose()?)
    }

    /// Loads a robot, for its torques.
    pub fn of(robot: &Robot) -> Result<Loaded, Error> {
        let load = load(&Default::default(), Output::InverseDynamics);
        let arm = Arm::parse(&write(robot), &robot.name, None, &load).map_err(Error::new)?;
        Loaded::with(arm, None)
    }

    fn with(arm: Arm, model: Option<Model>) -> Result<Loaded, Error> {
        if arm.robot().floating.is_some() {
            let why = "the base of the robot floats, and logs have no motion of a base: hold it by a \
                       fixed joint, or identify it by the crate `dalembert-fit`";
            return Err(Error::new(why));
        }
        code(&arm)?.prepare_columns().map_err(Error::new)?;
        Ok(Loaded {
            arm,
            fitted: model.map(fitted).transpose()?,
            evaluated: Arc::default(),
        })
    }

    pub fn robot(&self) -> &Robot {
        self.arm.robot()
    }

    pub fn notes(&self) -> &[String] {
        self.arm.notes()
    }

    /// Returns the count of states that were evaluated.
    pub fn evaluated(&self) -> Arc<AtomicU64> {
        self.evaluated.clone()
    }

    fn count(&self, states: States<'_>) {
        let count = states.count as u64;
        self.evaluated.fetch_add(count, Ordering::Relaxed);
    }
}

fn load(urdf: &dalembert_import::Options, output: Output) -> Load {
    let mut asked = Asked::default();
    for (option, value) in [("outputs", output.name()), ("scalar", "f64")] {
        // Both are options.
        let _ = asked.set(option, value);
    }
    Load {
        urdf: urdf.clone(),
        asked,
        ..Load::default()
    }
}

fn code(arm: &Arm) -> Result<&Native, Error> {
    let mut functions = arm.functions().iter();
    let function = functions.find(|function| function.scalar() == Scalar::F64);
    let native = function.map(|function| function.native());
    native.ok_or_else(|| Error::new("the generator returned no function"))
}

fn fitted(model: Model) -> Result<(Model, Arm), Error> {
    let text = write(&model.generator_robot());
    let load = load(&Default::default(), Output::Regressor);
    let arm = Arm::parse(&text, "the robot with its drives", None, &load).map_err(Error::new)?;
    code(&arm)?.prepare_columns().map_err(Error::new)?;
    Ok((model, arm))
}

impl Dynamics for Loaded {
    fn joints(&self) -> usize {
        self.arm.robot().joints.len()
    }

    fn inverse_dynamics(&self, states: States<'_>, tau: &mut [f64]) -> Result<(), Error> {
        self.count(states);
        let native = code(&self.arm)?;
        call(native, self.joints(), states, tau, self.joints())
    }

    fn model(&self) -> Option<&Model> {
        self.fitted.as_ref().map(|(model, _)| model)
    }

    fn accumulate(
        &self,
        states: States<'_>,
        tau: &[f64],
        room: &mut Vec<f64>,
        into: &mut Accumulator,
    ) -> Result<(), Error> {
        self.count(states);
        let (model, arm) = self.fitted.as_ref().ok_or_else(no_model)?;
        let entries = self.joints() * model.base();
        room.resize(entries * states.count, 0.0);
        call(code(arm)?, self.joints(), states, room, entries)?;
        Ok(into.add_columns(model, room, states.qd, tau, states.count)?)
    }
}

fn call(
    native: &Native,
    joints: usize,
    states: States<'_>,
    results: &mut [f64],
    entries: usize,
) -> Result<(), Error> {
    let place = Place::columns(joints, states.count);
    let read = [states.q, states.qd, states.qdd].map(|data| (data, place.clone()));
    let mut written = [(results, Place::columns(entries, states.count))];
    let called = native.call_rows(&read, &mut written, states.count, 1);
    called.map_err(Error::new)
}

/// A generated function of torques, such as `arm::inverse_dynamics`.
pub struct Generated<F, const N: usize> {
    torques: F,
    model: Option<Model>,
}

impl<F, const N: usize> Generated<F, N>
where
    F: Fn(&[f64; N], &[f64; N], &[f64; N]) -> [f64; N],
{
    /// Returns the robot whose torques at q, q̇ and q̈ the function computes, in N·m and N; with a
    /// model of the same robot file, parameters can be identified.
    pub fn new(torques: F, model: Option<Model>) -> Result<Generated<F, N>, Error> {
        let joints = model.as_ref().map_or(N, Model::joints);
        if joints != N {
            let why = format!("the model has {joints} joints and the generated robot {N}");
            return Err(Error::new(why));
        }
        Ok(Generated { torques, model })
    }
}

impl<F, const N: usize> fmt::Debug for Generated<F, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Generated({})", std::any::type_name::<F>())
    }
}

impl<F, const N: usize> Dynamics for Generated<F, N>
where
    F: Fn(&[f64; N], &[f64; N], &[f64; N]) -> [f64; N] + Send + Sync + 'static,
{
    fn joints(&self) -> usize {
        N
    }

    fn inverse_dynamics(&self, states: States<'_>, tau: &mut [f64]) -> Result<(), Error> {
        let count = states.count;
        for s in 0..count {
            let of = |from: &[f64]| std::array::from_fn(|i| from[i * count + s]);
            let (q, qd, qdd) = (of(states.q), of(states.qd), of(states.qdd));
            let torques = (self.torques)(&q, &qd, &qdd);
            for (i, torque) in torques.into_iter().enumerate() {
                tau[i * count + s] = torque;
            }
        }
        Ok(())
    }

    fn model(&self) -> Option<&Model> {
        self.model.as_ref()
    }
}
