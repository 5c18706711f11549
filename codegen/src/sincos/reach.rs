//! Sines that no polynomial gives as exactly as was wanted: what can be had, and the likely fixes.

use std::f64::consts::PI;
use std::fmt;

use super::choose::Candidates;
use crate::figures::{above, bound_of};
use crate::program::{ScalarType, SinCosUse};
use crate::sincos::interval::Interval;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OutOfReach {
    pub(super) scalar: ScalarType,
    pub(super) joint: usize,
    pub(super) need: SinCosUse,
    pub(super) range: Interval,
    pub(crate) wanted: f64,
    /// The least error that is proved; infinite if no polynomial is known.
    pub(crate) least: f64,
}

impl OutOfReach {
    pub(crate) fn reachable(&self) -> Option<f64> {
        self.least.is_finite().then(|| above(self.least, 2))
    }

    pub(crate) fn help(&self) -> String {
        let joint = self.joint + 1;
        let Some(error) = self.reachable() else {
            return format!("narrow the limits of q{joint}, or use `sincos: libm`");
        };
        let is_enough = |scalar: ScalarType, range: Interval| {
            let best = Candidates::new(self.need, scalar, range).cheapest(self.wanted);
            best.is_some_and(|choice| choice.errors.worst() <= self.wanted)
        };
        let is_single = self.scalar == ScalarType::F32;
        let wider = match is_single && is_enough(ScalarType::F64, self.range) {
            true => ", `scalar: f64`",
            false => "",
        };
        let half_turn = Interval::symmetric(PI);
        let is_wide = self.range.magnitude() > PI;
        let limit = match is_wide && is_enough(self.scalar, half_turn) {
            true => format!(", or limit q{joint} to ±π"),
            false => String::new(),
        };
        format!("use `sincos_error: {error:e}`{wider} or `sincos: libm`{limit}")
    }
}

impl fmt::Display for OutOfReach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = [self.range.low(), self.range.high()].map(angle);
        let angle = format!("q{} in [{low}, {high}]", self.joint + 1);
        let scalar = self.scalar;
        if !self.least.is_finite() {
            return write!(f, "no {scalar} polynomial is known for {angle}");
        }
        let least = bound_of(self.least, 3);
        let wanted = format!("{:.2e}", self.wanted).replace(".00e", "e");
        write!(
            f,
            "{scalar} polynomials reach {least} for {angle}, not {wanted}"
        )
    }
}

fn angle(x: f64) -> String {
    match x / PI {
        1.0 => "π".to_owned(),
        -1.0 => "-π".to_owned(),
        turns if turns != 0.0 && turns.fract() == 0.0 => format!("{turns}π"),
        _ => format!("{x}"),
    }
}
