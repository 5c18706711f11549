//! The load that a payload is: the numbers of a regrouped chain that a body changes
//! which is fixed to the last link.
//!
//! Masses and moments that regrouping leaves are linear in the body's mass, first moments and
//! tensor. While these are unknown, an indeterminate of exact numbers stands for each: the sine of
//! an angle that the robot has nowhere, of which, as of every constant angle, no relation to others
//! is known. So a payload goes through regrouping like any other body, and what comes out says what
//! the load's numbers are.

use dalembert_model::equations::chain::Regrouping;
use dalembert_model::equations::load::LoadRow;
use dalembert_model::equations::regressor::LinkParameter;
use dalembert_model::number::{Angle, Exact, Rational};
use dalembert_model::robot::{Placement, Position};
use dalembert_model::scalar::{Scalar, SinCosPair};

use super::Setup;

/// The numbers of a regrouped chain that a payload changes.
#[derive(Clone, Debug)]
pub struct LoadParameters {
    /// Each with the payload's parameters unknown, its leading sign positive.
    pub numbers: Vec<Exact>,
    /// Each by what the arm has of it and what the payload adds.
    pub rows: Vec<LoadRow<Exact>>,
    /// The chain's regrouping.
    pub regrouping: Regrouping<Exact>,
}

/// The parameters of a payload that is not known yet, about the origin and in the
/// axes of the last link's frame.
#[derive(Clone, Debug)]
pub struct Unknowns {
    /// An angle that the robot has nowhere, for each of [`LinkParameter::ALL`].
    angles: Vec<Angle>,
}

impl Setup {
    /// Returns the robot with the load of a chain in a regrouping, which has these numbers.
    #[must_use]
    pub fn with_load(self, numbers: Vec<Exact>, regrouping: Regrouping<Exact>) -> Setup {
        let unknowns = self.unknowns();
        let rows = numbers.iter().map(|number| unknowns.row(number));
        let load = LoadParameters {
            rows: rows.collect(),
            numbers,
            regrouping,
        };
        Setup {
            load: Some(load),
            ..self
        }
    }

    /// Returns the parameters of a payload.
    pub fn unknowns(&self) -> Unknowns {
        let taken = self.constant_angles();
        let candidates =
            (1_000_003..).map(|n: i64| Angle::Radians(Rational::from_integer(n.into())));
        let free = candidates.filter(|angle| !taken.contains(angle));
        Unknowns {
            angles: free.take(LinkParameter::COUNT).collect(),
        }
    }

    fn constant_angles(&self) -> Vec<Angle> {
        let robot = self.robot();
        let rows = robot.rows().into_iter();
        let rows = rows.flat_map(|joint| [&joint.alpha, &joint.beta, &joint.theta]);
        let offsets = robot.followers.iter().map(|own| &own.offset);
        let frames = robot
            .placements()
            .into_iter()
            .filter_map(|(.., frame)| frame);
        let places = robot
            .rows()
            .into_iter()
            .filter_map(|joint| joint.place.as_ref());
        let frames = frames.chain(places.map(|place| &place.placement));
        let frames = frames.flat_map(|Placement { rpy, .. }| rpy);
        let locks = self.scene().into_iter().flat_map(|scene| &scene.lock);
        let positions = offsets.chain(locks.map(|(_, at)| at));
        let positions = positions.filter_map(|at| match at {
            Position::Angle(angle) => Some(angle),
            Position::Length(_) => None,
        });
        let all = rows.chain(positions).chain(frames);
        all.flat_map(|angle| [angle.clone(), angle.negate()])
            .collect()
    }
}

impl Unknowns {
    /// Returns each as an exact number.
    pub fn values(&self) -> Vec<Exact> {
        let value = |angle| Exact::sincos(angle).sin;
        self.angles.iter().map(value).collect()
    }

    /// Returns whether a number depends on one of the load's.
    pub fn occur_in(&self, number: &Exact) -> bool {
        let mut found = false;
        number.map(&mut |x| Some(Exact::from(x.clone())), &mut |angle| {
            found |= self.angles.contains(angle);
            Exact::sincos(angle)
        });
        found
    }

    fn row(&self, number: &Exact) -> LoadRow<Exact> {
        let own = self.where_one_is(number, None);
        let parameters = LinkParameter::ALL.into_iter().zip(&self.angles);
        let coefficients = parameters.map(|(parameter, angle)| {
            let with = self.where_one_is(number, Some(angle));
            (parameter, with.sub(&own))
        });
        LoadRow {
            of: coefficients.filter(|(_, x)| !x.is_zero()).collect(),
            own,
        }
    }

    fn where_one_is(&self, number: &Exact, one: Option<&Angle>) -> Exact {
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
