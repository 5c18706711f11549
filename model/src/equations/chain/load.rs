//! Bodies by their regrouped parameters: those that are known are the links'
//! bodies, those that an argument brings are probes until it is there.

use alloc::vec::Vec;

use super::{Body, Chain, Probe, Probed, Skeleton};
use crate::equations::matrix::times;
use crate::scalar::Scalar;

impl<S: Scalar> Skeleton<S> {
    /// The skeleton whose bodies have the columns from `first` on, each as often
    /// as its value says; the columns before stay what they are.
    #[must_use]
    pub fn with_values(mut self, first: usize, values: &[S]) -> Skeleton<S> {
        let value = |column: usize| values.get(column.checked_sub(first)?);
        for link in &mut self.links {
            take_on(&mut link.body, &mut link.probes, value);
        }
        self.columns = first;
        self
    }
}

impl<S: Scalar> Chain<S> {
    /// The chain whose bodies have its columns, each as often as the load's number
    /// says.
    #[must_use]
    pub fn loaded(mut self, load: &[S]) -> Chain<S> {
        for link in &mut self.links {
            take_on(&mut link.body, &mut link.probes, |column| load.get(column));
        }
        self.columns = 0;
        self
    }
}

/// Makes probes that have a value part of the body.
fn take_on<'v, S: Scalar + 'v>(
    body: &mut Body<S>,
    probes: &mut Vec<Probe<S>>,
    value: impl Fn(usize) -> Option<&'v S>,
) {
    probes.retain(|probe| match (&probe.of, value(probe.column)) {
        (Probed::Body(unit), Some(value)) => {
            *body = body.with(&unit.map(|x| times(value, x)));
            false
        }
        _ => true,
    });
}
