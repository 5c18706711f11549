//! Branch and bound over sub-boxes.
//!
//! **Soundness.** The sub-boxes always cover the box, and a bound over each
//! of them holds by [`Forms`]; their largest is a bound over the box. The
//! search only decides which sub-box to halve next.
//!
//! Deterministic: sub-boxes are counted, never timed, and ties go to the one
//! made first.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::{BoxEffort, relative};
use crate::bound::form::{Forms, Scratch};
use crate::bound::input_box::InputBox;
use crate::dag::Dag;

/// Bounds as [`magnitudes`](super::magnitudes), by sub-boxes alone.
pub(super) fn branch_and_bound(
    graph: &Dag,
    whole: &InputBox,
    scales: &[f64],
    goal: f64,
    budget: BoxEffort,
) -> Vec<f64> {
    let forms = Forms::new(graph, whole.joints());
    let mut search = Search {
        forms: &forms,
        scales,
        scratch: Scratch::default(),
        serial: 0,
    };
    let first = search.leaf(whole.clone());
    let mut leaves = BTreeMap::from([(search.place(&first), first)]);
    while search.serial < budget.boxes {
        let Some(worst) = leaves.last_entry() else {
            break;
        };
        let leaf = worst.get();
        if priority(&leaf.magnitudes, scales) <= goal || leaf.axis == usize::MAX {
            break;
        }
        let leaf = worst.remove();
        for half in leaf.sub.position[leaf.axis].split() {
            let mut sub = leaf.sub.clone();
            sub.position[leaf.axis] = half;
            let mut child = search.leaf(sub);
            // What holds over the parent holds over its half.
            for (mine, parents) in child.magnitudes.iter_mut().zip(&leaf.magnitudes) {
                *mine = mine.min(*parents);
            }
            leaves.insert(search.place(&child), child);
        }
    }
    let mut most = vec![0.0f64; graph.outputs.len()];
    for leaf in leaves.into_values() {
        for (most, magnitude) in most.iter_mut().zip(&leaf.magnitudes) {
            *most = most.max(*magnitude);
        }
    }
    most
}

/// A sub-box that is not halved yet.
struct Leaf {
    sub: InputBox,
    magnitudes: Vec<f64>,
    axis: usize,
}

struct Search<'a> {
    forms: &'a Forms,
    scales: &'a [f64],
    scratch: Scratch,
    serial: usize,
}

impl Search<'_> {
    fn leaf(&mut self, sub: InputBox) -> Leaf {
        self.forms.evaluate(&sub, &mut self.scratch);
        let outputs = self.forms.outputs(&sub, &self.scratch);
        let magnitudes: Vec<f64> = outputs.iter().map(|x| x.magnitude()).collect();
        self.serial += 1;
        Leaf {
            axis: self.axis(&sub),
            sub,
            magnitudes,
        }
    }

    /// Returns the place of the leaf that was made last: before the others that are no better.
    fn place(&self, leaf: &Leaf) -> (u64, Reverse<usize>) {
        // A magnitude's bits are in its order.
        let priority = priority(&leaf.magnitudes, self.scales);
        (priority.to_bits(), Reverse(self.serial))
    }

    /// Returns the widest position that matters.
    fn axis(&self, sub: &InputBox) -> usize {
        let positions = self.forms.positions.iter().copied();
        positions
            .filter(|&joint| sub.position[joint].width() > 1e-9)
            .fold((usize::MAX, 0.0), |(best, width), joint| {
                let mine = sub.position[joint].width();
                if mine > width {
                    (joint, mine)
                } else {
                    (best, width)
                }
            })
            .0
    }
}

/// Returns the worst output against its scale. A scale of zero demands an exact
/// output.
fn priority(magnitudes: &[f64], scales: &[f64]) -> f64 {
    let pairs = magnitudes.iter().zip(scales);
    pairs.fold(0.0, |worst, (&x, &scale)| worst.max(relative(x, scale)))
}
