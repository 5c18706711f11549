//! The columns of a regressor: an entry is the power of a body's wrench on a joint's twist. Where
//! the axes of several joints meet, the wrench may be taken about that point instead: N + F × o
//! once, and of each of these joints the angular part alone.

use alloc::vec::Vec;

use super::composite::CompositeOrder;
use super::floating::unit_twists;
use super::recursion::{AccelerationForm, LinkMotion, MomentForm, Motions};
use super::{Chain, MomentBody, Posture, Rotation, Segment, Skeleton};
use crate::equations::matrix::*;
use crate::equations::screws::Twist;
use crate::scalar::Scalar;

/// A column of a regressor: the torque of what causes it.
#[derive(Clone, Debug)]
pub struct Column<S> {
    /// The joint that feels it or moves the link that it is fixed to.
    pub joint: usize,
    /// The cause; a body is about the origin and in the axes of the link's DH frame.
    pub of: Probed<S>,
}

impl<S> Column<S> {
    /// Returns every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Column<T> {
        Column {
            joint: self.joint,
            of: self.of.through(|body| body.map(&mut f)),
        }
    }
}

/// A cause of torque that is fixed to a link beside its body.
#[derive(Clone, Debug)]
pub struct Probe<S> {
    /// The column of the regressor.
    pub column: usize,
    /// The value itself.
    pub of: Probed<S>,
}

/// The cause of a column of a regressor.
#[derive(Clone, Debug)]
pub enum Probed<S> {
    /// A body, about the origin and in the axes of the link's frame.
    Body(MomentBody<S>),
    /// A unit of the rotor's inertia.
    Armature,
    /// A unit of viscous friction.
    Viscous,
}

impl<S> Probed<S> {
    fn through<T>(&self, f: impl FnOnce(&MomentBody<S>) -> MomentBody<T>) -> Probed<T> {
        match self {
            Probed::Body(body) => Probed::Body(f(body)),
            Probed::Armature => Probed::Armature,
            Probed::Viscous => Probed::Viscous,
        }
    }
}

impl<S> Probe<S> {
    pub(super) fn is_body(&self) -> bool {
        matches!(self.of, Probed::Body(_))
    }

    pub(super) fn each<T>(
        probes: &[Probe<S>],
        mut f: impl FnMut(&MomentBody<S>) -> MomentBody<T>,
    ) -> Vec<Probe<T>> {
        let mapped_probes = probes.iter().map(|probe| Probe {
            column: probe.column,
            of: probe.of.through(&mut f),
        });
        mapped_probes.collect()
    }
}

pub(super) fn probes<S: Scalar>(
    columns: &[Column<S>],
    joint: usize,
    turned: &Rotation<S>,
    moved: &Vector<S>,
) -> impl Iterator<Item = Probe<S>> {
    let numbered_columns = columns.iter().enumerate();
    let joint_columns = numbered_columns.filter(move |(_, column)| column.joint == joint);
    joint_columns.map(move |(column, probed_column)| Probe {
        column,
        of: probed_column.of.through(|body| body.carried(turned, moved)),
    })
}

impl<S: Scalar> Skeleton<S> {
    /// Returns the skeleton whose bodies have its columns, times these values, and no columns.
    #[must_use]
    pub fn with_values(mut self, values: &[S]) -> Skeleton<S> {
        let weighed = |unit: &MomentBody<S>, value: &S| unit.map(|x| times(value, x));
        for Segment { link, .. } in &mut self.links {
            for probe in core::mem::take(&mut link.probes) {
                match (&probe.of, values.get(probe.column)) {
                    (Probed::Body(unit), Some(value)) => {
                        link.body = link.body.with(&weighed(unit, value));
                    }
                    (Probed::Armature, Some(value)) => link.armature = plus(&link.armature, value),
                    (Probed::Viscous, Some(value)) => {
                        link.friction.viscous = plus(&link.friction.viscous, value);
                    }
                    (_, None) => {}
                }
            }
        }
        for probe in core::mem::take(&mut self.base_probes) {
            if let (Some(base), Probed::Body(unit), Some(value)) =
                (&mut self.base, &probe.of, values.get(probe.column))
            {
                *base = base.with(&weighed(unit, value));
            }
        }
        self.columns = 0;
        self
    }
}

/// The joints that move a link, as seen from its frame.
#[derive(Clone)]
struct Way<S> {
    /// The joints from the base on, with their twists.
    twists: Vec<(usize, Twist<S>)>,
    centres: Vec<Centre<S>>,
}

/// A point where the axes of several joints meet.
#[derive(Clone)]
struct Centre<S> {
    joints: Vec<usize>,
    at: Vector<S>,
}

impl<S: Scalar> Chain<S> {
    /// Returns the columns that the probes are, a row a coordinate; by twists that travel
    /// outward alone, or by wrenches about points where axes meet.
    pub fn regressor(
        &self,
        at: &Posture<S>,
        qd: &[S],
        qdd: &[S],
        travel: CompositeOrder,
    ) -> Matrix<S> {
        let motions = self.motions(at, qd, qdd, AccelerationForm::Column);
        self.powers(at, &motions, [qd, qdd], travel)
    }

    /// Computes the regressor of D a + C v + c + b∘v.
    pub fn passivity_regressor(
        &self,
        at: &Posture<S>,
        qd: &[S],
        [v, a]: [&[S]; 2],
        travel: CompositeOrder,
    ) -> Matrix<S> {
        let motions = self.mixed_motions(at, qd, [v, a]);
        self.powers(at, &motions, [v, a], travel)
    }

    fn powers(
        &self,
        at: &Posture<S>,
        motions: &Motions<S>,
        [rates, accelerations]: [&[S]; 2],
        travel: CompositeOrder,
    ) -> Matrix<S> {
        let first = self.base_coordinates();
        let mut rows: Matrix<S> = alloc::vec![zeros(self.columns); self.coordinates()];
        let (twists, centres) = (Vec::new(), Vec::new());
        let mut base = Way { twists, centres };
        if self.base.is_some() {
            base.twists.extend(unit_twists().into_iter().enumerate());
            if travel == CompositeOrder::Inward {
                base.centres.extend(meeting(&base.twists));
            }
        }
        let enter =
            |rows: &mut Matrix<S>, way: &Way<S>, motion: &LinkMotion<S>, probe: &Probe<S>| {
                let Probed::Body(body) = &probe.of else {
                    return;
                };
                let wrench = motion.wrench(body, MomentForm::SecondMoments);
                let about =
                    |centre: &Centre<S>| sum(&wrench.moment, &cross(&wrench.force, &centre.at));
                let moments: Vec<Vector<S>> = way.centres.iter().map(about).collect();
                for (k, twist) in &way.twists {
                    let power = match widest(&way.centres, *k) {
                        Some(centre) => dot(&twist.turn, &moments[centre]),
                        None => wrench.along(twist),
                    };
                    rows[*k][probe.column] = self.coordinate_in_metres(*k, power);
                }
            };
        for probe in &self.base_probes {
            enter(&mut rows, &base, &motions.base, probe);
        }
        let [rates, accelerations] = [rates, accelerations].map(|rates| self.of_joints(rates));
        let mut ways: Vec<Way<S>> = Vec::with_capacity(self.links.len());
        for (i, link) in self.links.iter().enumerate() {
            let mut way = link.parent.map_or(&base, |parent| &ways[parent]).clone();
            for (_, twist) in &mut way.twists {
                *twist = link.twist_outward(&at[i], twist);
            }
            way.twists.push((first + i, link.twist()));
            for centre in &mut way.centres {
                let lever = link.lever(&at[i]);
                centre.at = link.inward(&at[i], &difference(&centre.at, &lever));
            }
            if travel == CompositeOrder::Inward {
                way.centres.extend(meeting(&way.twists));
            }
            for probe in &link.probes {
                match &probe.of {
                    Probed::Armature => rows[first + i][probe.column] = accelerations[i].clone(),
                    Probed::Viscous => rows[first + i][probe.column] = rates[i].clone(),
                    Probed::Body(_) => enter(&mut rows, &way, &motions.links[i], probe),
                }
            }
            ways.push(way);
        }
        rows
    }
}

fn meeting<S: Scalar>(twists: &[(usize, Twist<S>)]) -> Option<Centre<S>> {
    let passes = |twist: &Twist<S>| {
        let turns = twist.turn.iter().any(|x| !x.is_zero());
        turns && twist.shift.iter().all(S::is_zero)
    };
    let meet = twists.iter().filter(|(_, twist)| passes(twist));
    let joints: Vec<usize> = meet.map(|(joint, _)| *joint).collect();
    let at = zero_vector();
    (joints.len() > 1).then_some(Centre { joints, at })
}

fn widest<S>(centres: &[Centre<S>], joint: usize) -> Option<usize> {
    let size = |index: &usize| centres[*index].joints.len();
    let on_axis = (0..centres.len()).filter(|&index| centres[index].joints.contains(&joint));
    on_axis.rev().max_by_key(size)
}
