//! The columns of an arm's regressor, and the regressor at a state.
//!
//! The base parameters are those of the generator (Gautier 1991, in closed form with an
//! elimination for what is left), with the drives' inertias and viscous friction among the
//! candidates: what no torque tells apart is one parameter. After them come Coulomb
//! friction, q̇/√(q̇² + w²) times its force at the width w of the robot file, and an offset of
//! each joint's torque sensor. An offset that another parameter gives as well, as the weight
//! of a slide that hangs, has no column.

use dalembert_codegen::workspace::function::Quantity;
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_codegen::workspace::scene::base::Parameter;
use dalembert_model::equations::chain::composite::CompositeOrder;
use dalembert_model::equations::chain::{Body, Chain, Regrouping, Skeleton};
use dalembert_model::equations::friction::per_speed;
use dalembert_model::equations::regressor::LinkParameter;
use dalembert_model::equations::{Arm, JointPosition, SinCosPair};
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::dual::Dual;
use num_traits::{One, Zero};

use crate::error::{Error, check};
use crate::limits::Limits;
use crate::random::{Random, within};
use crate::triangle::Triangle;

/// What is identified beside the links' parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Inertias of the drives' rotors.
    pub armature: bool,
    /// Viscous friction.
    pub viscous: bool,
    /// Coulomb friction.
    pub coulomb: bool,
    /// A constant that is added to each measured torque.
    pub offset: bool,
    /// Width w of Coulomb friction, rad/s or m/s, of joints of which the file has none.
    pub coulomb_width: f64,
}

impl Default for Options {
    /// All of them; the width is 0.01.
    fn default() -> Self {
        Options {
            armature: true,
            viscous: true,
            coulomb: true,
            offset: true,
            coulomb_width: 0.01,
        }
    }
}

/// What a column of the regressor is the torque of.
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
    options: Options,
    limits: Vec<Limits>,
    columns: Vec<Column>,
    /// Each base parameter as a sum of the robot's own.
    combinations: Vec<Vec<(Parameter, f64)>>,
    chain: Chain<f64>,
    widths: Vec<f64>,
    /// The columns that are not zero in the row of each joint.
    rows: Vec<Vec<usize>>,
    parameters: Vec<f64>,
    fingerprint: [u8; 32],
}

impl Model {
    /// Derives the columns of a robot.
    ///
    /// # Errors
    /// [`Error::NoBaseParameters`] where odd angles between joints make them too long, and
    /// [`Error::Option`].
    pub fn new(robot: &Robot, options: &Options) -> Result<Model, Error> {
        if !(options.coulomb_width > 0.0 && options.coulomb_width.is_finite()) {
            return Err(Error::Option(
                "`coulomb_width` has to be a positive number, such as 0.01 rad/s",
            ));
        }
        let n = robot.joints.len();
        let scene = SceneRobot::whole(&candidates(robot, options));
        let base = scene.base(Quantity::BaseRegressor);
        let base = base.map_err(|why| Error::NoBaseParameters(why.to_string()))?;
        let arm = Arm::from_robot(robot, &mut Exact::clone).fold_base();
        let mut skeleton = Skeleton::with_columns(&arm, &[], &base.columns);
        // The columns are all that is computed: the links' own bodies are not regrouped.
        skeleton
            .links
            .iter_mut()
            .for_each(|link| link.body = Body::zero());
        let chain = Chain::new(&skeleton, &Regrouping::base(&skeleton));
        let each = |terms: &Vec<(Parameter, Exact)>| {
            let terms = terms.iter();
            terms.map(|(of, x)| (*of, f64::nearest(x))).collect()
        };
        let mut columns: Vec<Column> = (0..base.columns.len()).map(Column::Base).collect();
        if options.coulomb {
            columns.extend((0..n).map(Column::Coulomb));
        }
        if options.offset {
            columns.extend((0..n).map(Column::Offset));
        }
        let width = |joint: &dalembert_model::robot::Joint| match joint.coulomb_width.is_zero() {
            true => options.coulomb_width,
            false => f64::nearest_rational(&joint.coulomb_width),
        };
        let mut model = Model {
            robot: robot.clone(),
            options: options.clone(),
            limits: Limits::of(robot),
            combinations: base.combinations.iter().map(each).collect(),
            chain: chain.map(f64::nearest),
            widths: robot.joints.iter().map(width).collect(),
            rows: vec![(0..columns.len()).collect(); n],
            columns,
            parameters: Vec::new(),
            fingerprint: [0; 32],
        };
        model.drop_columns();
        model.parameters = model.values(&base.values(&arm));
        model.fingerprint = model.hashed();
        Ok(model)
    }

    /// The robot of the file.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// What is identified beside the links' parameters.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The joints' limits.
    pub fn limits(&self) -> &[Limits] {
        &self.limits
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.robot.joints.len()
    }

    /// What each column of Y, and each entry of π, is of.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of base parameters; they are the first columns.
    pub fn base(&self) -> usize {
        self.combinations.len()
    }

    /// A base parameter as a sum of parameters of the robot file.
    pub fn combination(&self, base: usize) -> &[(Parameter, f64)] {
        &self.combinations[base]
    }

    /// The columns that are not zero in the row of a joint.
    pub fn row(&self, joint: usize) -> &[usize] {
        &self.rows[joint]
    }

    /// π of the robot file; offsets are zero.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Tells models of which the columns differ apart.
    pub fn fingerprint(&self) -> &[u8; 32] {
        &self.fingerprint
    }

    /// Returns a parameter's name: a sum of the robot file's parameters, cut after three.
    pub fn name(&self, column: usize) -> String {
        match self.columns[column] {
            Column::Coulomb(joint) => format!("coulomb{}", joint + 1),
            Column::Offset(joint) => format!("offset{}", joint + 1),
            Column::Base(base) => sum(&self.combinations[base]),
        }
    }

    /// Evaluates Y, row by row, all columns.
    ///
    /// # Errors
    /// [`Error::Length`] and [`Error::Value`].
    pub fn regressor(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Result<Vec<f64>, Error> {
        let n = self.joints();
        check("q", q, n)?;
        check("qd", qd, n)?;
        check("qdd", qdd, n)?;
        let position: Vec<_> = (self.robot.joints.iter().zip(q))
            .map(|(joint, q)| match joint.kind {
                JointKind::Revolute => JointPosition::Revolute(pair(*q)),
                JointKind::Prismatic => JointPosition::Prismatic(*q),
            })
            .collect();
        let rows = rows(&self.chain, &position, qd, qdd);
        let mut y = Vec::with_capacity(n * self.columns.len());
        for (i, row) in rows.into_iter().enumerate() {
            y.extend(row);
            y.extend(
                self.columns[self.base()..]
                    .iter()
                    .map(|column| match column {
                        Column::Coulomb(joint) if *joint == i => self.coulomb(i, &qd[i]),
                        Column::Offset(joint) if *joint == i => 1.0,
                        _ => 0.0,
                    }),
            );
        }
        Ok(y)
    }

    /// Coulomb friction of a joint per unit of its force.
    pub(crate) fn coulomb(&self, joint: usize, qd: &f64) -> f64 {
        let width = self.widths[joint];
        qd * per_speed(qd, &(width * width), |x| libm::sqrt(*x))
    }

    /// The width of a joint's Coulomb friction.
    pub(crate) fn width(&self, joint: usize) -> f64 {
        self.widths[joint]
    }

    /// Differentiates `weights`·Y, row by row as Y, by every q, q̇ and q̈: 3n numbers.
    pub(crate) fn gradient(&self, [q, qd, qdd]: [&[f64]; 3], weights: &[f64]) -> Vec<f64> {
        let (n, base, width) = (self.joints(), self.base(), self.columns.len());
        let chain = self.chain.map(|x| Dual::constant(*x));
        let mut gradient = Vec::with_capacity(3 * n);
        for along in 0..3 * n {
            let rate = |of: usize| f64::from(u8::from(of == along));
            let position: Vec<_> = (self.robot.joints.iter().zip(q).enumerate())
                .map(|(i, (joint, q))| match joint.kind {
                    JointKind::Revolute => JointPosition::Revolute(pair(*q).turning(&rate(i))),
                    JointKind::Prismatic => JointPosition::Prismatic(Dual {
                        value: *q,
                        rate: rate(i),
                    }),
                })
                .collect();
            let moving = |values: &[f64], first: usize| -> Vec<Dual<f64>> {
                let values = values.iter().enumerate();
                let moving = values.map(|(i, value)| Dual {
                    value: *value,
                    rate: rate(first + i),
                });
                moving.collect()
            };
            let rows = rows(&chain, &position, &moving(qd, n), &moving(qdd, 2 * n));
            let mut total = 0.0;
            for (row, weights) in rows.iter().zip(weights.chunks(width)) {
                let products = row.iter().zip(weights).map(|(y, w)| y.rate * w);
                total += products.sum::<f64>();
            }
            if (n..2 * n).contains(&along) {
                let joint = along - n;
                let width = self.widths[joint];
                let r = per_speed(&qd[joint], &(width * width), |x| libm::sqrt(*x));
                let of = |column: &Column| *column == Column::Coulomb(joint);
                if let Some(column) = self.columns[base..].iter().position(of) {
                    let weight = weights[joint * self.columns.len() + base + column];
                    total += weight * width * width * r * r * r;
                }
            }
            gradient.push(total);
        }
        gradient
    }

    /// Finds the columns that are zero in a row whatever the state is, and drops offsets that
    /// depend on other columns, by random states within limits twice as wide.
    fn drop_columns(&mut self) {
        let (n, width) = (self.joints(), self.columns.len());
        let mut random = Random::new(0x6669_7400);
        let mut largest = vec![0.0f64; n * width];
        let mut all = Triangle::new(width);
        for _ in 0..2 * width + 8 {
            let [q, qd, qdd] = state(&self.limits, 2.0, &mut random);
            let Ok(y) = self.regressor(&q, &qd, &qdd) else {
                continue;
            };
            for (largest, y) in largest.iter_mut().zip(&y) {
                *largest = largest.max(y.abs());
            }
            y.chunks(width)
                .for_each(|row| all.push(row.iter().copied()));
        }
        let r = all.reduced();
        let independent = |column: usize| {
            let norm: f64 = (0..=column).map(|i| r[i * width + column].powi(2)).sum();
            r[column * width + column] > 1e-9 * libm::sqrt(norm)
        };
        let kept: Vec<usize> = (0..width)
            .filter(|k| !matches!(self.columns[*k], Column::Offset(_)) || independent(*k))
            .collect();
        self.columns = kept.iter().map(|k| self.columns[*k]).collect();
        let scale = |k: usize| (0..n).fold(0.0f64, |max, i| max.max(largest[i * width + k]));
        for (i, row) in self.rows.iter_mut().enumerate() {
            // What is nothing but rounding next to the column's largest entry is zero.
            let felt = kept.iter().enumerate();
            let felt = felt.filter(|(_, k)| largest[i * width + **k] > 1e-12 * scale(**k));
            *row = felt.map(|(new, _)| new).collect();
        }
    }

    fn values(&self, base: &[Exact]) -> Vec<f64> {
        let each = self.columns.iter().map(|column| match *column {
            Column::Base(k) => f64::nearest(&base[k]),
            Column::Coulomb(joint) => f64::nearest_rational(&self.robot.joints[joint].coulomb),
            Column::Offset(_) => 0.0,
        });
        each.collect()
    }

    /// The hash of the robot without what is identified, with what decides the columns.
    fn hashed(&self) -> [u8; 32] {
        let mut bare = candidates(&self.robot, &self.options);
        let count = self.columns.len();
        bare.name = format!("{:?} {:?} {count}", self.options, self.widths);
        for joint in &mut bare.joints {
            joint.name = None;
            joint.limits = Default::default();
            joint.mass = Rational::zero();
            joint.com = Default::default();
            joint.inertia = joint.inertia.map(|_| Rational::zero());
        }
        bare.input_hash()
    }
}

/// The robot with the drives whose columns are asked for: every rotor a unit of inertia,
/// every joint a unit of viscous friction. Coulomb friction is not a base parameter.
fn candidates(robot: &Robot, options: &Options) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints {
        joint.coulomb = Rational::zero();
        for (asked, own) in [
            (options.armature, &mut joint.armature),
            (options.viscous, &mut joint.viscous),
        ] {
            if asked {
                *own = Rational::one();
            }
        }
    }
    robot
}

/// Draws a state within limits, velocities and accelerations scaled by `factor`.
pub(crate) fn state(limits: &[Limits], factor: f64, random: &mut Random) -> [Vec<f64>; 3] {
    let mut draw = |of: &dyn Fn(&Limits) -> [f64; 2]| -> Vec<f64> {
        let each = limits.iter().map(of);
        each.map(|[middle, largest]| middle + within(random, largest))
            .collect()
    };
    [
        draw(&|of| [of.middle(), of.reach()]),
        draw(&|of| [0.0, factor * of.velocity]),
        draw(&|of| [0.0, factor * of.acceleration]),
    ]
}

fn rows<S: Scalar>(
    chain: &Chain<S>,
    position: &[JointPosition<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<Vec<S>> {
    let (chain, at) = chain.posed(position);
    chain.regressor(&at, qd, qdd, CompositeOrder::Outward)
}

fn pair(angle: f64) -> SinCosPair<f64> {
    let (sin, cos) = libm::sincos(angle);
    SinCosPair { sin, cos }
}

/// A sum of parameters in words, the first three of it.
fn sum(terms: &[(Parameter, f64)]) -> String {
    let mut text = String::new();
    for (i, (parameter, factor)) in terms.iter().take(3).enumerate() {
        let sign = match (i, *factor < 0.0) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        text += sign;
        if factor.abs() != 1.0 {
            text += &format!("{} ", factor.abs());
        }
        text += &parameter.to_string();
    }
    if terms.len() > 3 {
        text += &format!(" + … ({} more)", terms.len() - 3);
    }
    text
}

/// The place of a link's parameter among the ten of [`LinkParameter::ALL`].
pub(crate) fn place(parameter: LinkParameter) -> usize {
    let all = LinkParameter::ALL.iter();
    all.take_while(|other| **other != parameter).count()
}
