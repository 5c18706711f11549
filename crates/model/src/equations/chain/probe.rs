//! The columns of a regressor: they are fixed to the links of a chain beside their bodies.

use alloc::vec::Vec;

use super::{Body, Rotation, Segment, Skeleton};
use crate::equations::matrix::{Vector, times};
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
    Body(Body<S>),
    /// A unit of the rotor's inertia.
    Armature,
    /// A unit of viscous friction.
    Viscous,
}

impl<S> Probed<S> {
    fn through<T>(&self, f: impl FnOnce(&Body<S>) -> Body<T>) -> Probed<T> {
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
        mut f: impl FnMut(&Body<S>) -> Body<T>,
    ) -> Vec<Probe<T>> {
        let each = probes.iter().map(|probe| Probe {
            column: probe.column,
            of: probe.of.through(&mut f),
        });
        each.collect()
    }
}

pub(super) fn probes<S: Scalar>(
    columns: &[Column<S>],
    joint: usize,
    turned: &Rotation<S>,
    moved: &Vector<S>,
) -> impl Iterator<Item = Probe<S>> {
    let all = columns.iter().enumerate();
    let own = all.filter(move |(_, own)| own.joint == joint);
    own.map(move |(column, own)| Probe {
        column,
        of: own.of.through(|body| body.carried(turned, moved)),
    })
}

impl<S: Scalar> Skeleton<S> {
    /// Returns the skeleton whose bodies have its columns, each as often as its value says,
    /// and which has columns no longer.
    #[must_use]
    pub fn with_values(mut self, values: &[S]) -> Skeleton<S> {
        for Segment { link, .. } in &mut self.links {
            for probe in core::mem::take(&mut link.probes) {
                if let (Probed::Body(unit), Some(value)) = (&probe.of, values.get(probe.column)) {
                    link.body = link.body.with(&unit.map(|x| times(value, x)));
                }
            }
        }
        self.columns = 0;
        self
    }
}
