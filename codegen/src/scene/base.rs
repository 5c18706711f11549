//! The base parameters of a setting: the fewest combinations of inertial
//! parameters, and of what the drives have, that give every torque asked for.
//!
//! What can move from a link to the one before without any torque noticing is
//! known in closed form ([`dalembert_model::equations::chain::regrouping`]). From
//! the hand inward, all of it moved, every unit of a link's parameter becomes an
//! exact combination of what links keep: of a link that turns two first moments
//! and five second moments, of one that slides its mass and first moments.
//!
//! What an arm and a scene leave unfelt beyond that (axes that are parallel or
//! vertical, rates that are zero, joints that nobody asks for) shows as columns
//! that vanish or depend on others. They are found by elimination modulo
//! 2⁶¹ − 1 at random states: columns that are independent there are
//! independent. That the others depend on them as they seem to is only a finding;
//! [`crate::verify::parameters`] proves it.

use std::cell::RefCell;
use std::fmt;

use dalembert_model::equations::chain::body::entry;
use dalembert_model::equations::chain::{Body, Chain, Probed, Regrouping, Skeleton};
use dalembert_model::equations::matrix::opposite;
use dalembert_model::equations::regressor::{Column, LinkParameter, of_drives, of_links};
use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::number::{Angle, Exact, Rational};
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

use super::Setting;
use super::elimination::{fraction, reduced};

/// Combinations with more monomials than this in a coefficient are not formed:
/// every odd angle between two joints multiplies them.
const MAX_TERMS: usize = 400;

/// A seed of its own.
const SEED: u64 = 0x6261_7365;

/// A parameter of the robot file, about the origin of the link's DH frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parameter {
    /// Of a link.
    Link(usize, LinkParameter),
    /// The rotor's inertia of a joint.
    Armature(usize),
    /// The viscous friction of a joint.
    Viscous(usize),
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Parameter::Link(joint, parameter) => write!(f, "{}{}", parameter.name(), joint + 1),
            Parameter::Armature(joint) => write!(f, "armature{}", joint + 1),
            Parameter::Viscous(joint) => write!(f, "viscous{}", joint + 1),
        }
    }
}

/// The base parameters of a setting.
#[derive(Clone, Debug)]
pub struct BaseParameters {
    /// What each is a unit of: the columns of the regressor.
    pub columns: Vec<Column<Exact>>,
    /// Each as a combination of the robot file's parameters.
    pub combinations: Vec<Vec<(Parameter, Exact)>>,
}

/// Why there are none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoBase {
    /// A coefficient has too many sines and cosines of constant angles.
    Large {
        /// The joint whose link it is of.
        joint: usize,
    },
    /// A column depends on others by a coefficient that is no short fraction.
    Irrational,
    /// A constant has no value modulo the prime.
    Unfit,
}

impl fmt::Display for NoBase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let full = "ask for `full_regressor`, over all parameters of all links";
        match self {
            NoBase::Large { joint } => write!(
                f,
                "the base parameters that the link of joint {} is part of have more than \
                 {MAX_TERMS} products of sines and cosines of the table's angles: give angles \
                 that are multiples of pi/2 as such, or {full}",
                joint + 1
            ),
            NoBase::Irrational => write!(
                f,
                "one base parameter depends on the others by a number that is no short fraction, \
                 as odd angles between slides and the first axis give: {full}"
            ),
            NoBase::Unfit => write!(
                f,
                "a parameter is divisible by 2^61 - 1, modulo which columns are compared: \
                 change its last digit, or {full}"
            ),
        }
    }
}

impl BaseParameters {
    /// Of a setting.
    pub(super) fn of(setting: &Setting) -> Result<BaseParameters, NoBase> {
        let robot = setting.robot();
        let arm = Arm::from_robot(robot, &mut Exact::clone).fold_base();
        let n = arm.links.len();
        let skeleton = Skeleton::with_columns(&arm, &setting.merged(), &of_links(n));
        let regrouping = Regrouping::base(&skeleton);
        // Without bodies of their own: only the frames matter here.
        let chain = Chain::new(&without_bodies(&skeleton), &regrouping);

        let mut candidates: Vec<Column<Exact>> = Vec::new();
        let mut places: Vec<Place> = Vec::new();
        for (link, segment) in skeleton.links.iter().enumerate() {
            let (turned, moved) = &segment.dh;
            let back = transposed(turned);
            for &moment in kept(segment.kind) {
                let body = moment.unit().moved(&regrouping.links[link].origin);
                candidates.push(Column::Body {
                    joint: segment.joint,
                    body: body.moved(&opposite(moved)).turned(&back),
                });
                places.push((link, moment));
            }
        }
        let drives: Vec<Column<Exact>> = of_drives(robot);
        candidates.extend(drives.iter().cloned());

        let columns = values(setting, &candidates).ok_or(NoBase::Unfit)?;
        let reduced = reduced(columns);
        let mut base = BaseParameters {
            columns: reduced
                .pivots
                .iter()
                .map(|&c| candidates[c].clone())
                .collect(),
            combinations: vec![Vec::new(); reduced.pivots.len()],
        };
        // What each candidate is over the base columns.
        let mut over: Vec<Vec<(usize, Exact)>> = Vec::with_capacity(candidates.len());
        for coefficients in &reduced.coefficients {
            let exact = coefficients.iter().map(|(pivot, x)| {
                let fraction = fraction(*x).ok_or(NoBase::Irrational)?;
                Ok((*pivot, Exact::from(fraction)))
            });
            over.push(exact.collect::<Result<_, NoBase>>()?);
        }
        for (link, segment) in chain.links.iter().enumerate() {
            for probe in &segment.probes {
                let Probed::Body(body) = &probe.of else {
                    continue;
                };
                let joint = probe.column / LinkParameter::COUNT;
                let own = LinkParameter::ALL[probe.column % LinkParameter::COUNT];
                let parts = parts(&chain, link, body).ok_or(NoBase::Large { joint })?;
                let mut sums = vec![Exact::zero(); base.columns.len()];
                for ((place, moment), over) in places.iter().zip(&over) {
                    let part = moment.of(&parts[*place]);
                    for (pivot, factor) in over.iter().filter(|_| !part.is_zero()) {
                        sums[*pivot] = sums[*pivot].add(&part.mul(factor));
                    }
                }
                base.add(Parameter::Link(joint, own), sums);
            }
        }
        for (drive, over) in drives.iter().zip(&over[places.len()..]) {
            let mut sums = vec![Exact::zero(); base.columns.len()];
            for (pivot, factor) in over {
                sums[*pivot] = factor.clone();
            }
            base.add(
                match drive {
                    Column::Viscous(joint) => Parameter::Viscous(*joint),
                    Column::Armature(joint) | Column::Body { joint, .. } => {
                        Parameter::Armature(*joint)
                    }
                },
                sums,
            );
        }
        base.combinations
            .iter_mut()
            .for_each(|terms| terms.sort_by_key(|(of, _)| *of));
        Ok(base)
    }

    fn add(&mut self, parameter: Parameter, coefficients: Vec<Exact>) {
        for (terms, coefficient) in self.combinations.iter_mut().zip(coefficients) {
            if !coefficient.is_zero() {
                terms.push((parameter, coefficient));
            }
        }
    }

    /// Every base parameter's value for a robot of exact numbers.
    pub fn values(&self, arm: &Arm<Exact>) -> Vec<Exact> {
        let value = |terms: &Vec<(Parameter, Exact)>| {
            let terms = terms.iter().map(|(parameter, factor)| {
                let own = match *parameter {
                    Parameter::Link(joint, own) => own.of(&arm.links[joint]),
                    Parameter::Armature(joint) => arm.links[joint].armature.clone(),
                    Parameter::Viscous(joint) => arm.links[joint].viscous.clone(),
                };
                own.mul(factor)
            });
            terms.fold(Exact::zero(), |sum, term| sum.add(&term))
        };
        self.combinations.iter().map(value).collect()
    }
}

/// A link of the chain, and a moment that it keeps.
type Place = (usize, Moment);

/// A moment of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Moment {
    Mass,
    First(usize),
    Second(usize, usize),
}

impl Moment {
    fn unit(self) -> Body<Exact> {
        let mut body = Body::zero();
        match self {
            Moment::Mass => body.mass = Exact::one(),
            Moment::First(axis) => body.first[axis] = Exact::one(),
            Moment::Second(row, column) => {
                let is_own = |i, j| (i, j) == (row, column);
                body.second = dalembert_model::robot::Inertia::symmetric(|i, j| {
                    if is_own(i, j) {
                        Exact::one()
                    } else {
                        Exact::zero()
                    }
                });
            }
        }
        body
    }

    fn of(self, body: &Body<Exact>) -> &Exact {
        match self {
            Moment::Mass => &body.mass,
            Moment::First(axis) => &body.first[axis],
            Moment::Second(row, column) => entry(&body.second, row, column),
        }
    }
}

/// What a link keeps where everything moves that can.
fn kept(kind: JointKind) -> &'static [Moment] {
    match kind {
        JointKind::Revolute => &[
            Moment::Second(0, 0),
            Moment::Second(1, 1),
            Moment::Second(0, 1),
            Moment::Second(0, 2),
            Moment::Second(1, 2),
            Moment::First(0),
            Moment::First(1),
        ],
        JointKind::Prismatic => &[
            Moment::Mass,
            Moment::First(0),
            Moment::First(1),
            Moment::First(2),
        ],
    }
}

/// The frames alone.
fn without_bodies(skeleton: &Skeleton<Exact>) -> Skeleton<Exact> {
    let mut empty = skeleton.clone();
    empty
        .links
        .iter_mut()
        .for_each(|link| link.body = Body::zero());
    empty
}

/// What each link keeps of a body of one; `None` where a constant grows too large.
fn parts(chain: &Chain<Exact>, link: usize, body: &Body<Exact>) -> Option<Vec<Body<Exact>>> {
    let mut parts = vec![Body::zero(); chain.links.len()];
    let mut arriving = body.clone();
    for i in (0..=link).rev() {
        if terms(&arriving) > MAX_TERMS {
            return None;
        }
        let (stays, moves) = chain.links[i].split_base(&arriving);
        parts[i] = stays;
        arriving = moves;
    }
    Some(parts)
}

/// The most monomials of a number of a body.
fn terms(body: &Body<Exact>) -> usize {
    let mut most = 0;
    body.map(|x| most = most.max(x.terms()));
    most
}

fn transposed(rotation: &[[Exact; 3]; 3]) -> [[Exact; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| rotation[j][i].clone()))
}

/// Columns modulo the prime, each over the rows of so many random states that
/// every dependence that is none shows; `None` if a constant has no value.
fn values(setting: &Setting, columns: &[Column<Exact>]) -> Option<Vec<Vec<Field>>> {
    let points = RefCell::new(Points::new(SEED));
    let circle = || {
        let (sin, cos) = points.borrow_mut().circle();
        SinCosPair { sin, cos }
    };
    // Constant angles are the same in every state.
    let angles: RefCell<Vec<(Angle, SinCosPair<Field>)>> = RefCell::default();
    let fits = std::cell::Cell::new(true);
    let constant = |value: &Exact| {
        let pair = &mut |angle: &Angle| {
            let mut angles = angles.borrow_mut();
            if let Some((_, pair)) = angles.iter().find(|(known, _)| known == angle) {
                return pair.clone();
            }
            let pair = circle();
            angles.push((angle.clone(), pair.clone()));
            pair
        };
        let found = value.map(&mut |x: &Rational| Field::from_rational(x), pair);
        found.unwrap_or_else(|| {
            fits.set(false);
            Field::ZERO
        })
    };
    let arm = Arm::from_robot(setting.robot(), &mut { constant });
    let columns: Vec<Column<Field>> = columns.iter().map(|c| c.map(constant)).collect();
    let mut found: Vec<Vec<Field>> = vec![Vec::new(); columns.len()];
    let states = columns.len() / setting.rows().len().max(1) + 4;
    for _ in 0..states {
        let pairs: Vec<SinCosPair<Field>> = setting.joints().iter().map(|_| circle()).collect();
        let input = |input| match input {
            crate::program::Input::Sin(angle) => angle.pair(|joint| pairs[joint].clone()).sin,
            crate::program::Input::Cos(angle) => angle.pair(|joint| pairs[joint].clone()).cos,
            crate::program::Input::Entry(..) => points.borrow_mut().field(),
        };
        let motion = setting.motion(input, constant);
        let (at, recursion) = (arm.at(&motion.q), Formulation::NewtonEulerLink);
        let rows = recursion.regressor(&arm, &at, &motion.qd, &motion.qdd, &columns);
        for &row in setting.rows() {
            for (column, entry) in found.iter_mut().zip(&rows[row]) {
                column.push(*entry);
            }
        }
    }
    fits.get().then_some(found)
}
