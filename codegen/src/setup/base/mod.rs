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
//! - `elimination`: columns at random states, modulo a prime, and which depend on others

mod elimination;
mod moments;
mod origins;

use std::fmt;

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::equations::Arm;
use dalembert_model::equations::chain::{Chain, Probed, Skeleton};
use dalembert_model::equations::matrix::opposite;
use dalembert_model::equations::regressor::{Column, LinkParameter, of_drives, of_links};
use dalembert_model::number::Exact;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use num_traits::{One, Signed};

use super::Setup;
use crate::figures::decimal;
use crate::function::Quantity;
use elimination::{ColumnBasis, reduced, values};
use moments::{MAX_TERMS, Moment, kept, parts};

/// A parameter of the robot file, of a link about the origin and in the axes of its own frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parameter {
    /// A parameter of a base that floats.
    Base(LinkParameter),
    /// A parameter of the link of a row.
    Link(usize, LinkParameter),
    /// The rotor's inertia of a joint.
    Armature(usize),
    /// The viscous friction of a joint.
    Viscous(usize),
}

impl Parameter {
    pub(crate) fn of_drive(robot: &Robot, column: &Column<Exact>) -> Parameter {
        let row = column.joint - robot.base_coordinates();
        match column.of {
            Probed::Viscous => Parameter::Viscous(row),
            Probed::Armature | Probed::Body(_) => Parameter::Armature(row),
        }
    }

    /// Lists those of all bodies, in the order of the columns of a full regressor.
    pub fn of_bodies(robot: &Robot) -> impl Iterator<Item = Parameter> {
        let base = robot.floating.iter().flat_map(|_| LinkParameter::ALL);
        let links = (0..robot.rows().len()).flat_map(|row| {
            let parameters = LinkParameter::ALL.into_iter();
            parameters.map(move |parameter| Parameter::Link(row, parameter))
        });
        base.map(Parameter::Base).chain(links)
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Parameter::Base(parameter) => write!(f, "{}0", parameter.name()),
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

fn large(parameter: Parameter) -> Diagnostic {
    let body = match parameter {
        Parameter::Base(_) => "the base".to_owned(),
        Parameter::Link(row, _) | Parameter::Armature(row) | Parameter::Viscous(row) => {
            format!("the link of joint {}", row + 1)
        }
    };
    let message = format!(
        "the base parameters that {body} is part of have more than {MAX_TERMS} products of sines and \
         cosines of the table's angles"
    );
    no_base(message, "write multiples of pi/2 exactly, such as `pi/2`")
}

fn no_base(message: impl Into<String>, help: &str) -> Diagnostic {
    let gap = if help.is_empty() { "" } else { ", or " };
    Diagnostic::error(message).with_help(format!("{help}{gap}{FULL}"))
}

impl BaseParameters {
    pub(super) fn find(setup: &Setup, quantity: Quantity) -> Result<BaseParameters, Diagnostic> {
        let robot = setup.robot();
        if setup.has_coulomb() {
            let message = "torques with Coulomb friction are not linear in its parameters, and no column \
                           has them";
            let help = "leave `coulomb` out of the robot file and add the friction to the torques \
                        yourself";
            let help = format!("{help}, or {FULL}, which is of links alone");
            return Err(Diagnostic::error(message).with_help(help));
        }
        let arm = Arm::from_robot(robot, &mut Exact::clone).fold_base();
        let skeleton = Skeleton::with_columns(&arm, &setup.merged(), &of_links(&arm));
        let regrouping = origins::chosen(&skeleton);
        // Without bodies of their own: only the frames matter here.
        let chain = Chain::new(&origins::without_bodies(&skeleton), &regrouping);

        let mut candidates: Vec<Column<Exact>> = Vec::new();
        // The base that floats or a link of the chain, and the moment.
        let mut places: Vec<(Option<usize>, Moment)> = Vec::new();
        for &moment in Moment::ALL.iter().filter(|_| arm.floats) {
            candidates.push(Column {
                joint: arm.first_body(),
                of: Probed::Body(moment.unit()),
            });
            places.push((None, moment));
        }
        for (link, segment) in skeleton.links.iter().enumerate() {
            let (turned, moved) = &segment.dh;
            let back = transposed(turned);
            for &moment in kept(segment.link.kind) {
                let body = moment.unit().moved(&regrouping.links[link].origin);
                candidates.push(Column {
                    joint: segment.joint,
                    of: Probed::Body(body.moved(&opposite(moved)).turned(&back)),
                });
                places.push((Some(link), moment));
            }
        }
        let drives: Vec<Column<Exact>> = of_drives(robot);
        candidates.extend(drives.iter().cloned());

        let unfit = || {
            let message = "a parameter is divisible by 2^61 - 1 or 2^61 - 465, modulo which columns \
                           are compared";
            no_base(message, "change its last digit")
        };
        let irrational = || {
            let message = "a base parameter depends on the others by a number that is not a short \
                           fraction, as odd angles between slides and the first axis give";
            no_base(message, "")
        };
        let reduced = ColumnBasis::confirmed(
            reduced(values(setup, quantity, &candidates).ok_or_else(unfit)?),
            reduced(values(setup, quantity, &candidates).ok_or_else(unfit)?),
        )
        .ok_or_else(irrational)?;
        let pivots = reduced.pivots.iter();
        let columns: Vec<Column<Exact>> = pivots.map(|&c| candidates[c].clone()).collect();
        let mut combinations = vec![Vec::new(); columns.len()];
        let coefficients = &reduced.coefficients;
        let of_bodies: Vec<Parameter> = Parameter::of_bodies(robot).collect();
        let on_base = chain.base_probes.iter().map(|probe| (None, probe));
        let links = chain.links.iter().enumerate();
        let on_links = links.flat_map(|(link, chain_link)| {
            let probes = chain_link.probes.iter();
            probes.map(move |probe| (Some(link), probe))
        });
        for (link, probe) in on_base.chain(on_links) {
            if let Probed::Body(body) = &probe.of {
                let parameter = of_bodies[probe.column];
                let parts = parts(&chain, link, body).ok_or_else(|| large(parameter))?;
                let mut sums = vec![Exact::zero(); columns.len()];
                for ((place, moment), over) in places.iter().zip(coefficients) {
                    let part = moment.read(&parts[place.unwrap_or(chain.links.len())]);
                    for (pivot, factor) in over.iter().filter(|_| !part.is_zero()) {
                        sums[*pivot] = sums[*pivot].add(&part.mul(factor));
                    }
                }
                let sums = combinations.iter_mut().zip(sums);
                for (terms, sum) in sums.filter(|(_, sum)| !sum.is_zero()) {
                    terms.push((parameter, sum));
                }
            }
        }
        for (drive, over) in drives.iter().zip(&coefficients[places.len()..]) {
            for (pivot, factor) in over {
                combinations[*pivot].push((Parameter::of_drive(robot, drive), factor.clone()));
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
        let combinations = self.combinations.iter();
        combinations.map(|terms| combination(terms)).collect()
    }

    /// Returns every base parameter's value for a robot of exact numbers.
    pub fn values(&self, arm: &Arm<Exact>) -> Vec<Exact> {
        let base = arm.base_joints();
        let value = |terms: &Vec<(Parameter, Exact)>| {
            let terms = terms.iter().map(|(parameter, factor)| {
                let amount = match *parameter {
                    Parameter::Base(entry) => entry.of_body(&arm.body(arm.first_body())),
                    Parameter::Link(row, entry) => entry.of_body(&arm.body(base + row)),
                    Parameter::Armature(row) => arm.links[base + row].armature.clone(),
                    Parameter::Viscous(row) => arm.links[base + row].friction.viscous.clone(),
                };
                amount.mul(factor)
            });
            terms.fold(Exact::zero(), |sum, term| sum.add(&term))
        };
        self.combinations.iter().map(value).collect()
    }
}

fn transposed(rotation: &[[Exact; 3]; 3]) -> [[Exact; 3]; 3] {
    core::array::from_fn(|i| core::array::from_fn(|j| rotation[j][i].clone()))
}

fn plain(constant: &Exact) -> String {
    let mut text = String::new();
    for c in constant.to_string().chars() {
        if c == '*' {
            let rest = text.strip_suffix('1');
            let ends = |c: char| c.is_ascii_digit() || c == '.' || c == '/';
            if let Some(rest) = rest.filter(|rest| !rest.ends_with(ends)) {
                text.truncate(rest.len());
                continue;
            }
        }
        text.push(c);
    }
    text.replace("+-", " - ").replace('+', " + ")
}

/// For example `Izz2 + 0.25 m3 - mx4`.
fn combination(terms: &[(Parameter, Exact)]) -> String {
    let mut text = String::new();
    for (parameter, factor) in terms {
        let is_negative = factor.as_rational().is_some_and(Signed::is_negative);
        let sign = match (text.is_empty(), is_negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let factor = match factor.as_rational() {
            Some(value) if value.abs().is_one() => String::new(),
            Some(value) => format!("{} ", decimal(&value.abs())),
            None => format!("({}) ", plain(factor)),
        };
        text += &format!("{sign}{factor}{parameter}");
    }
    text
}
