//! The columns of an arm's regressor, and the regressor at a state.
//!
//! The base parameters are those of the generator (Gautier 1991, in closed form with an elimination
//! for what is left), with the drives' inertias and viscous friction among the candidates: what no
//! torque tells apart is one parameter. After them come Coulomb friction, q̇/√(q̇² + w²) times its
//! force at the width w of the robot file, and an offset of each joint's torque sensor. An offset
//! that another parameter gives as well, as the weight of a slide that hangs, has no column.
//!
//! Rates and torques have six entries of the base first where that floats, and behind the positions
//! stands gravity in the base's axes. The first six torques are the force and the moment on the base:
//! those that the ground gives, or zero in flight.

mod derive;
mod evaluate;

use dalembert_codegen::workspace::{Parameter, Quantity, Setup};
use dalembert_model::equations::Arm;
use dalembert_model::equations::chain::{Chain, MomentBody, Regrouping, Skeleton};
use dalembert_model::equations::regressor::LinkParameter;
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::robot::{Joint, Robot};
use num_traits::Zero;

use crate::error::{Error, ensure};
use crate::limits::Limits;
use crate::random::{Random, within};
use derive::candidates;

/// Width w of Coulomb friction, rad/s or m/s, of joints of which the file has none.
const COULOMB_WIDTH: f64 = 0.01;

/// The parameter of which a column of the regressor is the torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// A base parameter, its place among them.
    Base(usize),
    /// Coulomb friction of a joint.
    Coulomb(usize),
    /// The offset of a joint's measured torque.
    Offset(usize),
}

/// The linear model τ = Y π of an arm.
#[derive(Clone, Debug)]
pub struct Model {
    robot: Robot,
    rotors: bool,
    limits: Vec<Limits>,
    /// Those of the coordinates of a base that floats.
    base_limits: Vec<Limits>,
    columns: Vec<Column>,
    combinations: Vec<Vec<(Parameter, f64)>>,
    chain: Chain<f64>,
    widths: Vec<f64>,
    pub(crate) rows: Vec<Vec<usize>>,
    parameters: Vec<f64>,
    fingerprint: [u8; 32],
}

impl Model {
    /// Derives the columns of a robot.
    ///
    /// # Errors
    /// [`Error::NoBaseParameters`] where odd angles between joints make them too long, and
    /// [`Error::Option`].
    pub fn new(robot: &Robot) -> Result<Model, Error> {
        Model::derived(robot.clone(), true)
    }

    /// Derives the columns of a robot whose torques are measured behind its gears, where they do
    /// not feel the rotors: their inertias are zero, and are not identified.
    pub fn without_rotors(robot: &Robot) -> Result<Model, Error> {
        Model::derived(without_rotors(robot), false)
    }

    fn derived(robot: Robot, rotors: bool) -> Result<Model, Error> {
        ensure(
            robot.followers.is_empty(),
            "joints that follow others (`mimic`) are not identified: fit the arm without them, \
             locked",
        )?;
        let limits = Limits::of(&robot);
        ensure(
            limits.iter().all(Limits::moves),
            "each joint's limits have to let it move: its range, velocity and acceleration \
             have to be more than zero",
        )?;
        let (n, rows) = (robot.joints.len(), robot.coordinates());
        let scene = Setup::whole(&candidates(&robot, rotors));
        let base = scene
            .base(Quantity::BaseRegressor)
            .map_err(|why| Error::NoBaseParameters(why.to_string()))?;
        let arm = Arm::from_robot(&robot, &mut Exact::clone).fold_base();
        let mut skeleton = Skeleton::with_columns(&arm, &[], &base.columns);
        // The columns are all that is computed: the links' own bodies are not regrouped.
        for segment in &mut skeleton.links {
            segment.link.body = MomentBody::zero();
        }
        skeleton.base = skeleton.base.map(|_| MomentBody::zero());
        let chain = Chain::new(&skeleton, &Regrouping::base(&skeleton));
        let combination = |terms: &Vec<(Parameter, Exact)>| {
            terms.iter().map(|(of, x)| (*of, f64::nearest(x))).collect()
        };
        let mut columns: Vec<Column> = (0..base.columns.len()).map(Column::Base).collect();
        columns.extend((0..n).map(Column::Coulomb));
        columns.extend((0..n).map(Column::Offset));
        let width = |joint: &Joint| match joint.coulomb_width.is_zero() {
            true => COULOMB_WIDTH,
            false => f64::nearest_rational(&joint.coulomb_width),
        };
        let mut model = Model {
            rotors,
            limits,
            base_limits: Limits::of_base(&robot),
            combinations: base.combinations.iter().map(combination).collect(),
            chain: chain.map(f64::nearest),
            widths: robot.joints.iter().map(width).collect(),
            robot,
            rows: vec![(0..columns.len()).collect(); rows],
            columns,
            parameters: Vec::new(),
            fingerprint: [0; 32],
        };
        model.drop_columns();
        model.parameters = model.values(&base.values(&arm));
        model.fingerprint = model.hashed();
        Ok(model)
    }

    /// Returns the robot of the file.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Returns the robot whose generated `regressor` has the base parameters' columns.
    pub fn generator_robot(&self) -> Robot {
        candidates(&self.robot, self.rotors)
    }

    /// Returns the joints' limits.
    pub fn limits(&self) -> &[Limits] {
        &self.limits
    }

    /// Returns the number of joints.
    pub fn joints(&self) -> usize {
        self.robot.joints.len()
    }

    /// Returns the number of rows of Y: those of a base that floats, then one a joint.
    pub fn coordinates(&self) -> usize {
        self.robot.coordinates()
    }

    /// Returns the place of the first link among the bodies: behind a base that floats.
    pub(crate) fn first_link(&self) -> usize {
        usize::from(self.robot.floating.is_some())
    }

    /// Returns the lengths of q, q̇ and q̈: where the base floats, gravity in its axes stands behind the
    /// positions.
    pub fn lengths(&self) -> [usize; 3] {
        let gravity = if self.robot.floating.is_some() { 3 } else { 0 };
        let rates = self.coordinates();
        [self.joints() + gravity, rates, rates]
    }

    /// Draws a state within limits so many times as wide; gravity has any direction.
    pub(crate) fn state(&self, factor: f64, random: &mut Random) -> [Vec<f64>; 3] {
        let mut draw = |limits: &[Limits], of: &dyn Fn(&Limits) -> [f64; 2]| -> Vec<f64> {
            let drawn = |[middle, largest]: [f64; 2]| middle + within(random, largest);
            limits.iter().map(of).map(drawn).collect()
        };
        let mut q = draw(&self.limits, &|of| [of.middle(), of.reach()]);
        if self.robot.floating.is_some() {
            let along = draw(&self.base_limits[..3], &|_| [0.0, 1.0]);
            let length = libm::sqrt(along.iter().map(|x| x * x).sum());
            let gravity = self.robot.gravity.each_ref().map(f64::nearest_rational);
            let most = libm::sqrt(gravity.iter().map(|x| x * x).sum());
            q.extend(along.iter().map(|x| x * most / length));
        }
        let limits = [&self.base_limits[..], &self.limits].concat();
        let qd = draw(&limits, &|of| [0.0, factor * of.velocity]);
        let qdd = draw(&limits, &|of| [0.0, factor * of.acceleration]);
        [q, qd, qdd]
    }

    /// Returns the parameter of each column of Y and each entry of π.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Returns the number of base parameters; they are the first columns.
    pub fn base(&self) -> usize {
        self.combinations.len()
    }

    /// Returns a base parameter as a sum of parameters of the robot file.
    pub fn combination(&self, base: usize) -> &[(Parameter, f64)] {
        &self.combinations[base]
    }

    /// Returns the columns that are not zero in a row.
    pub fn row(&self, row: usize) -> &[usize] {
        &self.rows[row]
    }

    /// Returns π of the robot file; offsets are zero.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Returns a hash of the columns.
    pub fn fingerprint(&self) -> &[u8; 32] {
        &self.fingerprint
    }

    /// Returns a parameter's name: a sum of the robot file's parameters, cut after three.
    pub fn name(&self, column: usize) -> String {
        match self.columns[column] {
            Column::Coulomb(joint) => format!("coulomb{}", joint + 1),
            Column::Offset(joint) => format!("offset{}", joint + 1),
            Column::Base(base) => {
                let terms = self.combinations[base].iter();
                let named = terms.map(|(of, factor)| (of.to_string(), *factor));
                sum(&Vec::from_iter(named), |x| x.to_string())
            }
        }
    }
}

/// Returns a robot without the inertias of its rotors.
pub fn without_rotors(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints {
        joint.armature = Rational::zero();
    }
    robot
}

/// Writes a sum of terms, by their names and factors, cut after three.
pub(crate) fn sum(terms: &[(String, f64)], number: impl Fn(f64) -> String) -> String {
    let mut text = String::new();
    for (i, (name, factor)) in terms.iter().take(3).enumerate() {
        text += match (i, *factor < 0.0) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        if factor.abs() != 1.0 {
            text += &format!("{} ", number(factor.abs()));
        }
        text += name;
    }
    if terms.len() > 3 {
        text += &format!(" + … ({} more)", terms.len() - 3);
    }
    text
}

pub(crate) fn place(parameter: LinkParameter) -> usize {
    let parameters = LinkParameter::ALL.iter();
    parameters.take_while(|other| **other != parameter).count()
}
