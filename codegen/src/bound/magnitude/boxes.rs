//! Branch and bound over sub-boxes.
//!
//! **Soundness.** The sub-boxes always cover the box, and a bound over each
//! of them holds by [`Forms`]; their largest is a bound over the box. The
//! search only decides which sub-box to halve next.
//!
//! Deterministic: sub-boxes are counted, never timed, and ties go to the one
//! made first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

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
    let mut heap = BinaryHeap::new();
    heap.push(search.leaf(whole.clone()));
    while search.serial < budget.boxes {
        let Some(leaf) = heap.peek() else { break };
        if leaf.priority <= goal || leaf.axis == usize::MAX {
            break;
        }
        let Some(leaf) = heap.pop() else { break };
        for half in leaf.sub.position[leaf.axis].split() {
            let mut sub = leaf.sub.clone();
            sub.position[leaf.axis] = half;
            let mut child = search.leaf(sub);
            // What holds over the parent holds over its half.
            for (mine, parents) in child.magnitudes.iter_mut().zip(&leaf.magnitudes) {
                *mine = mine.min(*parents);
            }
            child.priority = priority(&child.magnitudes, scales);
            heap.push(child);
        }
    }
    let mut most = vec![0.0f64; graph.outputs.len()];
    for leaf in heap {
        for (most, magnitude) in most.iter_mut().zip(&leaf.magnitudes) {
            *most = most.max(*magnitude);
        }
    }
    most
}

/// A sub-box that is not halved yet.
struct Leaf {
    /// The output that is worst here relative to its weight.
    priority: f64,
    serial: usize,
    sub: InputBox,
    magnitudes: Vec<f64>,
    axis: usize,
}

impl PartialEq for Leaf {
    fn eq(&self, other: &Leaf) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Leaf {}
impl PartialOrd for Leaf {
    fn partial_cmp(&self, other: &Leaf) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Leaf {
    fn cmp(&self, other: &Leaf) -> Ordering {
        let first = self.priority.total_cmp(&other.priority);
        first.then(other.serial.cmp(&self.serial))
    }
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
            priority: priority(&magnitudes, self.scales),
            serial: self.serial,
            axis: self.axis(&sub),
            sub,
            magnitudes,
        }
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
