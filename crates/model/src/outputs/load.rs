//! The load that a payload is: the regrouped parameters that it changes.
//!
//! A body that is fixed to the last link changes the base parameters of that link
//! and, by its mass, some of the links before. They are linear in the mass, the
//! first moments and the tensor about the frame's origin. Computed once for each
//! tool, they stand in all other functions where constants stood.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::Facts;
use super::{Argument, Axis, Shape, Written};
use crate::equations::load::Loading;
use crate::scalar::Divide;

pub(super) struct Load;

impl Formula for Load {
    const FACTS: Facts = Facts {
        field: "load",
        letter: "load",
        summary: "The regrouped parameters that a payload changes.",
        arguments: &[Argument::Payload],
        shape: Shape(&[Axis::Load]),
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let loading = at.motion.loading.as_ref();
        loading.map_or_else(Vec::new, Loading::load)
    }
}
