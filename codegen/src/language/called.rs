//! Sines by the crate's algorithm in C: one call gives those of all angles, by a loop that
//! compilers make vectors of.
//!
//! ```text
//! const double angles[2] = {q[0], q[2]};
//! double sines[2];
//! double cosines[2];
//! arm_sines_2(angles, sines, cosines);
//! const double s1 = sines[0];
//! ```

use super::names::{Names, float};
use super::{Language, list, trig};
use crate::program::Code;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SineCall {
    /// The first, where they are positions of neighbouring joints, as they stand in `q`.
    first: Option<usize>,
    pub(crate) angles: Vec<usize>,
}

impl SineCall {
    /// In CUDA, and in what batches call, vectors are of states: each angle has its own call.
    pub(crate) fn of(code: &Code, joints: usize, names: &Names, is_told: bool) -> Option<SineCall> {
        let angles: Vec<usize> = trig::taken(code).map(|pair| pair.joint).collect();
        if is_told || names.language != Language::C || angles.is_empty() {
            return None;
        }
        let neighbours = SineCall::neighbours(&angles, joints);
        let first = None;
        neighbours.or(Some(SineCall { first, angles }))
    }

    /// An even number, if that takes one joint more at the most, since vectors hold two or four.
    fn neighbours(angles: &[usize], joints: usize) -> Option<SineCall> {
        let (mut first, mut last) = (*angles.iter().min()?, *angles.iter().max()?);
        let is_odd = |count: usize| count > 1 && count % 2 == 1;
        if angles.len() == last + 1 - first && is_odd(angles.len()) {
            match first {
                0 => last = (last + 1).min(joints - 1),
                _ => first -= 1,
            }
        }
        let count = last + 1 - first;
        let is_near = count == angles.len() || count == angles.len() + 1 && is_odd(angles.len());
        is_near.then(|| SineCall {
            first: Some(first),
            angles: (first..=last).collect(),
        })
    }

    pub(crate) fn name(count: usize, names: &Names) -> String {
        names.of(&format!("sines_{count}"))
    }

    pub(super) fn lines(&self, names: &Names) -> Vec<String> {
        let (float, count) = (float(names.dialect().scalar), self.angles.len());
        let mut lines = Vec::new();
        let argument = match self.first {
            Some(joint) => format!("&q[{joint}]"),
            None => {
                let angles = list(self.angles.iter().map(|&angle| trig::operand(angle)));
                lines.push(format!("const {float} angles[{count}] = {{{angles}}};"));
                "angles".to_owned()
            }
        };
        lines.extend(["sines", "cosines"].map(|array| format!("{float} {array}[{count}];")));
        let name = SineCall::name(count, names);
        lines.push(format!("{name}({argument}, sines, cosines);"));
        lines
    }

    pub(super) fn value(&self, joint: usize, is_sine: bool) -> Option<String> {
        let place = self.angles.iter().position(|angle| *angle == joint)?;
        let array = if is_sine { "sines" } else { "cosines" };
        Some(format!("{array}[{place}]"))
    }
}
