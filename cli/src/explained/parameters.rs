//! What became of every link's parameters in the regrouping that was chosen.

use std::fmt;

use dalembert_model::equations::chain::{Body, Chain, Regrouping, Skeleton};
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use super::merged;
use dalembert_codegen::Function;
use dalembert_codegen::workspace::{Folding, SceneRobot, skeleton, trace_chain, tune::Tuned};

/// A parameter of a body about the origin of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parameter {
    /// ∫ dm
    Mass,
    /// A component of ∫ r dm: x, y or z.
    First(usize),
    /// An entry of ∫ r rᵀ dm: xx, yy, zz, xy, yz or xz.
    Second(usize),
}

impl Parameter {
    /// All ten.
    pub const ALL: [Parameter; 10] = {
        use Parameter::*;
        [
            Mass,
            First(0),
            First(1),
            First(2),
            Second(0),
            Second(1),
            Second(2),
            Second(3),
            Second(4),
            Second(5),
        ]
    };

    fn of<S>(self, body: &mut Body<S>) -> &mut S {
        let second = &mut body.second;
        match self {
            Parameter::Mass => &mut body.mass,
            Parameter::First(axis) => &mut body.first[axis],
            Parameter::Second(0) => &mut second.xx,
            Parameter::Second(1) => &mut second.yy,
            Parameter::Second(2) => &mut second.zz,
            Parameter::Second(3) => &mut second.xy,
            Parameter::Second(4) => &mut second.yz,
            Parameter::Second(_) => &mut second.xz,
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Parameter::Mass => "m",
            Parameter::First(0) => "s_x",
            Parameter::First(1) => "s_y",
            Parameter::First(_) => "s_z",
            Parameter::Second(0) => "Σ_xx",
            Parameter::Second(1) => "Σ_yy",
            Parameter::Second(2) => "Σ_zz",
            Parameter::Second(3) => "Σ_xy",
            Parameter::Second(4) => "Σ_yz",
            Parameter::Second(_) => "Σ_xz",
        })
    }
}

/// The fate of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterStatus {
    /// It is zero: it always was, or all of it moved to the link before.
    Gone,
    /// It has a value, but the function does not depend on it.
    NoEffect,
    /// It stays.
    Stays,
}

/// The way in which two parameters count as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Together {
    /// Their sum.
    Sum,
    /// Their difference.
    Difference,
}

/// One link.
#[derive(Clone, Debug)]
pub struct LinkParameters {
    /// Its joint, zero-based.
    pub joint: usize,
    /// The kind of that joint.
    pub kind: JointKind,
    /// The parameters that left it for the link before, or for the base if it is the first:
    /// in kg, m and s, about its own origin.
    pub moved: Vec<(Parameter, f64)>,
    /// The parameters that are left, with their values, and whether the function needs them.
    pub left: Vec<(Parameter, f64, ParameterStatus)>,
    /// The combination of Σ_xx and Σ_yy that alone counts, if there is one.
    pub together: Option<Together>,
    /// Where its origin lies, from the end of the step before the joint, m.
    pub origin: [f64; 3],
    /// True if q_n drops out because the link is symmetric about its axis.
    pub spins_freely: bool,
    /// By how many joints its frame turns more than the link (less if
    /// negative).
    pub axes: i32,
}

/// The fate of all parameters of a robot.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// From the base to the hand.
    pub links: Vec<LinkParameters>,
    /// The unit of length, m.
    pub unit: f64,
}

impl LinkParameters {
    /// Returns how many of the ten the function needs.
    pub fn needed(&self) -> usize {
        let stays =
            |(_, _, fate): &&(Parameter, f64, ParameterStatus)| *fate == ParameterStatus::Stays;
        self.left.iter().filter(stays).count()
    }
}

impl Parameters {
    /// Follows them through a tuned regrouping; `chain` is in it.
    pub(super) fn of(
        scene_robot: &SceneRobot,
        function: Function,
        tuned: &Tuned,
        chain: &Chain<Exact>,
    ) -> Parameters {
        let arm = skeleton(scene_robot);
        let mut metres = tuned.regrouping.clone();
        (metres.unit, metres.per_unit) = (Exact::one(), Exact::one());
        let now = Chain::new(&arm, &metres);
        let results = |chain: &Chain<Exact>| {
            let form = tuned.form;
            let traced = trace_chain(scene_robot, function, chain, form, Folding::Syntactic);
            merged::results(&traced.0)
        };
        let expected = results(chain);
        // Whether the function depends on a change of a link's body.
        let counts = |link: usize, change: &dyn Fn(&mut Body<Exact>)| {
            let mut other = chain.clone();
            change(&mut other.links[link].body);
            results(&other) != expected
        };
        let more = |value: &mut Exact| *value = value.add(&Exact::one());
        let less = |value: &mut Exact| *value = value.sub(&Exact::one());
        let needs =
            |link: usize, parameter: Parameter| counts(link, &|body| more(parameter.of(body)));
        let together = |link: usize| {
            let second = |body: &mut Body<Exact>, first: &dyn Fn(&mut Exact)| {
                first(&mut body.second.xx);
                more(&mut body.second.yy);
            };
            if !needs(link, Parameter::Second(0)) || !needs(link, Parameter::Second(1)) {
                None
            } else if !counts(link, &|body| second(body, &less)) {
                Some(Together::Sum)
            } else {
                let difference = !counts(link, &|body| second(body, &more));
                difference.then_some(Together::Difference)
            }
        };
        let freedoms = chain.freedoms();
        let links = arm.links.iter().enumerate().map(|(i, segment)| {
            let regrouping = &metres.links[i];
            let link = &now.links[i];
            let moved = match segment.kind {
                JointKind::Revolute => {
                    let [mass, first, second] = &link.free;
                    vec![
                        (Parameter::Mass, mass.sub(&regrouping.mass)),
                        (Parameter::First(2), first.sub(&regrouping.first)),
                        (Parameter::Second(2), second.sub(&regrouping.second)),
                    ]
                }
                JointKind::Prismatic => seconds_moved(&arm, &metres, i),
            };
            let moved = moved.into_iter().filter(|(_, value)| !value.is_zero());
            let mut body = link.body.clone();
            let left = Parameter::ALL.into_iter().filter_map(|parameter| {
                let value = parameter.of(&mut body);
                let fate = match () {
                    () if value.is_zero() => return None,
                    () if needs(i, parameter) => ParameterStatus::Stays,
                    () => ParameterStatus::NoEffect,
                };
                Some((parameter, f64::nearest(value), fate))
            });
            LinkParameters {
                joint: segment.joint,
                kind: segment.kind,
                moved: moved.map(|(p, value)| (p, f64::nearest(&value))).collect(),
                left: left.collect(),
                together: together(i),
                origin: regrouping.origin.each_ref().map(f64::nearest),
                spins_freely: link.spins_freely,
                axes: {
                    let [less, more] = freedoms[i];
                    link.axes.clamp(less, more)
                },
            }
        });
        Parameters {
            links: links.collect(),
            unit: f64::nearest(&tuned.regrouping.unit),
        }
    }
}

/// Returns the second moments that a slide gave to the link before.
fn seconds_moved(
    arm: &Skeleton<Exact>,
    regrouping: &Regrouping<Exact>,
    link: usize,
) -> Vec<(Parameter, Exact)> {
    if regrouping.links[link].keep_seconds {
        return Vec::new();
    }
    let mut whole = regrouping.clone();
    whole.links[link].keep_seconds = true;
    let mut body = Chain::new(arm, &whole).links[link].body.clone();
    let seconds = (0..6).map(Parameter::Second);
    seconds.map(|p| (p, p.of(&mut body).clone())).collect()
}
