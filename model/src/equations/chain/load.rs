//! Bodies that are fixed to links beside their own, as often as a number says.

use super::{Probed, Skeleton};
use crate::equations::matrix::times;
use crate::scalar::Scalar;

impl<S: Scalar> Skeleton<S> {
    /// Returns the skeleton whose bodies have its columns, each as often as its value says,
    /// and which has columns no longer.
    #[must_use]
    pub fn with_values(mut self, values: &[S]) -> Skeleton<S> {
        for link in &mut self.links {
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
