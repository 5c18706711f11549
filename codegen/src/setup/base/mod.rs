//! The base parameters of a robot in its scene: the fewest combinations of inertial
//! parameters, and of what the drives have, that give every torque asked for, be it
//! that of inverse dynamics or another that is linear in them.
//!
//! The closed form ([`dalembert_model::equations::chain::regrouping`]) tells which moments
//! can move from a link to the one before without a change of any torque. From
//! the hand inward, all of it moved, every unit of a link's parameter becomes an
//! exact combination of what links keep: of a link that turns two first moments
//! and five second moments, of one that slides its mass and first moments.
//!
//! An arm and a scene may leave more unfelt (axes that are parallel or vertical, rates that are
//! zero, joints that nobody asks for). It shows as columns that vanish or depend on others. They
//! are found by elimination modulo two primes at random states: columns that are independent there
//! are independent. That the others depend on them as they seem to is only a finding;
//! [`crate::verify::parameters`] proves it.
//!
//! - `moments`: the moments that links keep; `origins`: about which points
//! - `names`: combinations in words
//! - `elimination`: columns at random states, modulo a prime, and which depend on others

mod elimination;
mod moments;
mod names;
mod origins;

use std::fmt;

use dalembert_model::equations::Arm;
use dalembert_model::equations::chain::{Chain, Probed, Skeleton};
use dalembert_model::equations::matrix::opposite;
use dalembert_model::equations::regressor::{Column, LinkParameter, of_drives, of_links};
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use super::Setup;
use crate::function::Quantity;
use crate::words::Complaint;
use elimination::{Reduced, reduced, values};
use moments::{MAX_TERMS, Moment, kept, parts};

/// A parameter of the robot file, of a link about the origin and in the axes of its own frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parameter {
    /// A parameter of a link.
    Link(usize, LinkParameter),
    /// The rotor's inertia of a joint.
    Armature(usize),
    /// The viscous friction of a joint.
    Viscous(usize),
}

impl Parameter {
    pub(crate) fn of_drive(column: &Column<Exact>) -> Parameter {
        match column.of {
            Probed::Viscous => Parameter::Viscous(column.joint),
            Probed::Armature | Probed::Body(_) => Parameter::Armature(column.joint),
        }
    }
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

/// The base parameters of a robot in its scene.
#[derive(Clone, Debug)]
pub struct BaseParameters {
    /// The parameters that each base parameter combines: the columns of the regressor.
    pub columns: Vec<Column<Exact>>,
    /// Each as a combination of the robot file's parameters.
    pub combinations: Vec<Vec<(Parameter, Exact)>>,
}

const FULL: &str = "ask for `full_regressor`, over all parameters of all links";

fn large(joint: usize) -> Complaint {
    let message = format!(
        "the base parameters that the link of joint {} is part of have more than {MAX_TERMS} products \
         of sines and cosines of the table's angles",
        joint + 1
    );
    no_base(message, "give angles that are multiples of pi/2 as such")
}

fn no_base(message: impl Into<String>, help: &str) -> Complaint {
    let gap = if help.is_empty() { "" } else { ", or " };
    Complaint::new(message, format!("{help}{gap}{FULL}"))
}

impl BaseParameters {
    pub(super) fn find(setup: &Setup, quantity: Quantity) -> Result<BaseParameters, Complaint> {
        let robot = setup.robot();
        if setup.has_coulomb() {
            let message = "torques with Coulomb friction are not linear in its parameters, and no column \
                           has them";
            let help = "leave `coulomb` out of the robot file and add the friction to the torques \
                        yourself";
            let help = format!("{help}, or {FULL}, which is of links alone");
            return Err(Complaint::new(message, help));
        }
        let arm = Arm::from_robot(robot, &mut Exact::clone).fold_base();
        let skeleton = Skeleton::with_columns(&arm, &setup.merged(), &of_links(&arm));
        let regrouping = origins::chosen(&skeleton);
        // Without bodies of their own: only the frames matter here.
        let chain = Chain::new(&origins::without_bodies(&skeleton), &regrouping);

        let mut candidates: Vec<Column<Exact>> = Vec::new();
        let mut places: Vec<(usize, Moment)> = Vec::new();
        for (link, segment) in skeleton.links.iter().enumerate() {
            let (turned, moved) = &segment.dh;
            let back = transposed(turned);
            for &moment in kept(segment.link.kind) {
                let body = moment.unit().moved(&regrouping.links[link].origin);
                candidates.push(Column {
                    joint: segment.joint,
                    of: Probed::Body(body.moved(&opposite(moved)).turned(&back)),
                });
                places.push((link, moment));
            }
        }
        let drives: Vec<Column<Exact>> = of_drives(robot);
        candidates.extend(drives.iter().cloned());

        let unfit = || {
            let message = "a parameter is divisible by 2^61 - 1 or 2^61 - 45, modulo which columns \
                           are compared";
            no_base(message, "change its last digit")
        };
        let irrational = || {
            let message = "one base parameter depends on the others by a number that is no short \
                           fraction, as odd angles between slides and the first axis give";
            no_base(message, "")
        };
        let reduced = Reduced::confirmed(
            reduced(values(setup, quantity, &candidates).ok_or_else(unfit)?),
            reduced(values(setup, quantity, &candidates).ok_or_else(unfit)?),
        )
        .ok_or_else(irrational)?;
        let columns = reduced.pivots.iter().map(|&c| candidates[c].clone());
        let columns: Vec<Column<Exact>> = columns.collect();
        let mut combinations = vec![Vec::new(); columns.len()];
        let over = &reduced.coefficients;
        for (link, segment) in chain.links.iter().enumerate() {
            for probe in &segment.probes {
                let Probed::Body(body) = &probe.of else {
                    continue;
                };
                let joint = probe.column / LinkParameter::COUNT;
                let own = LinkParameter::ALL[probe.column % LinkParameter::COUNT];
                let parts = parts(&chain, link, body).ok_or_else(|| large(joint))?;
                let mut sums = vec![Exact::zero(); columns.len()];
                for ((place, moment), over) in places.iter().zip(over) {
                    let part = moment.read(&parts[*place]);
                    for (pivot, factor) in over.iter().filter(|_| !part.is_zero()) {
                        sums[*pivot] = sums[*pivot].add(&part.mul(factor));
                    }
                }
                let sums = combinations.iter_mut().zip(sums);
                for (terms, sum) in sums.filter(|(_, sum)| !sum.is_zero()) {
                    terms.push((Parameter::Link(joint, own), sum));
                }
            }
        }
        for (drive, over) in drives.iter().zip(&over[places.len()..]) {
            for (pivot, factor) in over {
                combinations[*pivot].push((Parameter::of_drive(drive), factor.clone()));
            }
        }
        for terms in &mut combinations {
            terms.sort_by_key(|(of, _)| *of);
        }
        Ok(BaseParameters {
            columns,
            combinations,
        })
    }

    /// Returns every base parameter as a combination of the links' and the drives', in words.
    pub fn names(&self) -> Vec<String> {
        let all = self.combinations.iter();
        all.map(|terms| names::combination(terms)).collect()
    }

    /// Returns every base parameter's value for a robot of exact numbers.
    pub fn values(&self, arm: &Arm<Exact>) -> Vec<Exact> {
        let bodies: Vec<_> = (0..arm.links.len()).map(|joint| arm.body(joint)).collect();
        let value = |terms: &Vec<(Parameter, Exact)>| {
            let terms = terms.iter().map(|(parameter, factor)| {
                let own = match *parameter {
                    Parameter::Link(joint, own) => own.of_body(&bodies[joint]),
                    Parameter::Armature(joint) => arm.links[joint].armature.clone(),
                    Parameter::Viscous(joint) => arm.links[joint].friction.viscous.clone(),
                };
                own.mul(factor)
            });
            terms.fold(Exact::zero(), |sum, term| sum.add(&term))
        };
        self.combinations.iter().map(value).collect()
    }
}

fn transposed(rotation: &[[Exact; 3]; 3]) -> [[Exact; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| rotation[j][i].clone()))
}
