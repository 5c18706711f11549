//! The load that bodies, drives and a payload are: the numbers of a regrouped chain that depend on
//! them.
//!
//! Masses and moments that regrouping leaves are linear in each body's mass, first moments and
//! tensor. While these are unknown, an indeterminate of exact numbers stands for each: the sine of
//! an angle that the robot has nowhere, of which, as of every constant angle, no relation to others
//! is known. So unknown bodies go through regrouping like any others, and what comes out says what
//! the load's numbers are.

use dalembert_model::equations::chain::{MomentBody, Regrouping};
use dalembert_model::equations::load::LoadRow;
use dalembert_model::equations::regressor::{Column, LinkParameter, Probed};
use dalembert_model::number::{Angle, Exact, Rational};
use dalembert_model::outputs::{Argument, RuntimeParameter};
use dalembert_model::robot::Position;
use dalembert_model::scalar::{Scalar, SinCosPair};

use super::Setup;
use crate::program::Input;

/// The numbers of a regrouped chain that depend on arguments.
#[derive(Clone, Debug)]
pub struct LoadParameters {
    /// Each with the parameters unknown, its leading sign positive.
    pub numbers: Vec<Exact>,
    /// Each by what the arm has of it and what the parameters add.
    pub rows: Vec<LoadRow<Exact>>,
    /// The chain's regrouping.
    pub regrouping: Regrouping<Exact>,
}

/// The parameters that are arguments, not known yet: of bodies about the origin and in the axes of
/// their rows' frames.
#[derive(Clone, Debug)]
pub struct Unknowns {
    /// The column of a regressor of each.
    pub columns: Vec<Column<Exact>>,
    /// An angle that the robot has nowhere for each.
    angles: Vec<Angle>,
}

impl Setup {
    /// Returns the robot with the load of a chain in a regrouping, which has these numbers.
    #[must_use]
    pub fn with_load(self, numbers: Vec<Exact>, regrouping: Regrouping<Exact>) -> Setup {
        let unknowns = self.unknowns();
        let rows = numbers.iter().map(|number| unknowns.row(number)).collect();
        let load = Some(LoadParameters {
            rows,
            numbers,
            regrouping,
        });
        Setup { load, ..self }
    }

    /// Returns the parameters that are arguments.
    pub fn unknowns(&self) -> Unknowns {
        let base = self.robot().base_coordinates();
        let last = base + self.robot().rows().len() - 1;
        let payload = self.has(RuntimeParameter::Payload).then_some(last);
        let bodies = self.bodies.iter().copied().chain(payload);
        // A body with numbers that stay zero has other parameters that are zero too.
        let indeterminate = |input: Input| match input {
            Input::Entry(_, place) => Exact::sincos(&unknown(2_000_003 + place as i64)).sin,
            Input::Sin(_) | Input::Cos(_) | Input::PerSpeed(_) => Exact::zero(),
        };
        let general = self.given_bodies(indeterminate, Exact::clone);
        let unit = |place: usize, parameter: LinkParameter| {
            let body = general.get(place).map(MomentBody::of);
            match body.is_some_and(|body| parameter.of_body(&body).is_zero()) {
                true => MomentBody::zero(),
                false => parameter.unit(),
            }
        };
        let of_body = |(place, joint): (usize, usize)| {
            LinkParameter::ALL.map(|parameter| Column {
                joint,
                of: Probed::Body(unit(place, parameter)),
            })
        };
        let drives = self.drives().map(|(argument, row)| Column {
            joint: base + row,
            of: match argument {
                Argument::Armature => Probed::Armature,
                _ => Probed::Viscous,
            },
        });
        let columns: Vec<Column<Exact>> =
            bodies.enumerate().flat_map(of_body).chain(drives).collect();
        let taken = self.constant_angles();
        let candidates = (1_000_003..).map(unknown);
        let free = candidates.filter(|angle| !taken.contains(angle));
        Unknowns {
            angles: free.take(columns.len()).collect(),
            columns,
        }
    }

    fn constant_angles(&self) -> Vec<Angle> {
        let robot = self.robot();
        let mut angles: Vec<&Angle> = Vec::new();
        for row in robot.rows() {
            angles.extend([&row.alpha, &row.beta, &row.theta]);
            angles.extend(row.place.iter().flat_map(|place| &place.placement.rpy));
        }
        for (_, placement) in robot.placements() {
            angles.extend(placement.iter().flat_map(|placement| &placement.rpy));
        }
        let offsets = robot.followers.iter().map(|follower| &follower.offset);
        let locks = self.scene().into_iter().flat_map(|scene| &scene.lock);
        for at in offsets.chain(locks.map(|(_, at)| at)) {
            if let Position::Angle(angle) = at {
                angles.push(angle);
            }
        }
        let negative = angles.iter().map(|angle| angle.negate());
        angles.iter().copied().cloned().chain(negative).collect()
    }
}

fn unknown(number: i64) -> Angle {
    Angle::Radians(Rational::from_integer(number.into()))
}

impl Unknowns {
    /// Returns each as an exact number.
    pub fn values(&self) -> Vec<Exact> {
        let value = |angle| Exact::sincos(angle).sin;
        self.angles.iter().map(value).collect()
    }

    /// True if a number depends on one of them.
    pub fn occur_in(&self, number: &Exact) -> bool {
        let mut has_angle = false;
        number.map(&mut |x| Some(Exact::from(x.clone())), &mut |angle| {
            has_angle |= self.angles.contains(angle);
            Exact::sincos(angle)
        });
        has_angle
    }

    fn row(&self, number: &Exact) -> LoadRow<Exact> {
        let constant = self.value_with_one(number, None);
        let mut occurring: Vec<usize> = Vec::new();
        number.map(&mut |x| Some(Exact::from(x.clone())), &mut |angle| {
            let place = self.angles.iter().position(|candidate| candidate == angle);
            occurring.extend(place.filter(|place| !occurring.contains(place)));
            Exact::sincos(angle)
        });
        occurring.sort_unstable();
        let coefficients = occurring.into_iter().filter_map(|place| {
            let with = self.value_with_one(number, Some(&self.angles[place]));
            let factor = with.sub(&constant);
            (!factor.is_zero()).then_some((place, factor))
        });
        LoadRow {
            of: coefficients.collect(),
            constant,
        }
    }

    fn value_with_one(&self, number: &Exact, one: Option<&Angle>) -> Exact {
        let value = number.map(
            &mut |x| Some(Exact::from(x.clone())),
            &mut |angle| match self.angles.contains(angle) {
                false => Exact::sincos(angle),
                true => SinCosPair {
                    sin: match one == Some(angle) {
                        true => Exact::one(),
                        false => Exact::zero(),
                    },
                    cos: Exact::one(),
                },
            },
        );
        value.unwrap_or_else(Exact::zero)
    }
}
