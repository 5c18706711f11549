//! The error of emitted code by cause.

use crate::certify::bound::{Budget, magnitudes, relative};
use crate::certify::edits::{Stage, difference};
use crate::certify::input_box::InputBox;
use crate::certify::sensitivity::rounding;
use crate::emit::ScalarType;
use crate::schedule::Program;

/// Sub-boxes of the rounding bound.
pub const ROUNDING_BOXES: usize = 4096;

/// A bound by cause, relative to T.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Split {
    /// Terms left out.
    pub model: f64,
    /// Sines and cosines.
    pub sincos: f64,
    /// Operations and constants.
    pub rounding: f64,
}

impl Split {
    /// E
    pub fn total(self) -> f64 {
        (self.model + self.sincos + self.rounding) * (1.0 + 1e-15)
    }
}

/// Bounds by cause, relative to the scales.
pub(super) fn bounds(
    stages: &[Stage],
    emitted: &Program,
    scalar: ScalarType,
    limits: &InputBox,
    scales: &[f64],
) -> Vec<Split> {
    let edited = stages.iter().any(|stage| !stage.edits.is_empty());
    let model = if edited {
        magnitudes(&difference(stages), limits, scales, 0.0, Budget::CERTIFY)
    } else {
        vec![0.0; scales.len()]
    };
    let rounding = rounding(emitted, scalar, limits, ROUNDING_BOXES);
    let all = model.iter().zip(&rounding).zip(scales);
    all.map(|((&model, rounding), &scale)| Split {
        model: relative(model, scale),
        sincos: relative(rounding.sincos, scale),
        rounding: relative(rounding.arithmetic, scale),
    })
    .collect()
}
