//! Branch and bound over sub-boxes.
//!
//! **Soundness.** The sub-boxes always cover the box, and a bound over each
//! of them holds by [`Forms`]; their largest is a bound over the box. The
//! search only decides which sub-box to halve next.
//!
//! Deterministic: sub-boxes are counted, never timed, and ties go to the one made first.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::forms::Forms;
use super::{BoxEffort, relative};
use crate::bound::input_box::InputBox;
use crate::dag::Dag;

const NARROW: f64 = 1e-9;

pub(super) fn branch_and_bound(
    graph: &Dag,
    whole: &InputBox,
    scales: &[f64],
    goal: f64,
    budget: BoxEffort,
) -> Vec<f64> {
    let Some(forms) = Forms::new(graph, whole.joints()) else {
        return vec![f64::INFINITY; graph.outputs.len()];
    };
    // A magnitude's bits are in its order; a sub-box comes before others that are no better.
    let place =
        |magnitudes: &[f64], made: usize| (priority(magnitudes, scales).to_bits(), Reverse(made));
    let first = forms.magnitudes(whole);
    let mut made: usize = 1;
    let mut leaves = BTreeMap::from([(place(&first, made), (whole.clone(), first))]);
    while made < budget.boxes {
        let Some(worst) = leaves.last_entry() else {
            break;
        };
        let (sub, magnitudes) = worst.get();
        let Some(axis) = widest(&forms, sub).filter(|_| priority(magnitudes, scales) > goal) else {
            break;
        };
        let (parent, parents) = worst.remove();
        for half in parent.position[axis].split() {
            let mut sub = parent.clone();
            sub.position[axis] = half;
            let mut own = forms.magnitudes(&sub);
            // What holds over the parent holds over its half.
            for (mine, parents) in own.iter_mut().zip(&parents) {
                *mine = mine.min(*parents);
            }
            made += 1;
            leaves.insert(place(&own, made), (sub, own));
        }
    }
    let mut most = vec![0.0f64; graph.outputs.len()];
    for (_, magnitudes) in leaves.into_values() {
        for (most, magnitude) in most.iter_mut().zip(magnitudes) {
            *most = most.max(magnitude);
        }
    }
    most
}

fn widest(forms: &Forms, sub: &InputBox) -> Option<usize> {
    let width = |joint: &usize| sub.position[*joint].width();
    let joints = forms.positions.iter().copied().rev();
    let wide = joints.filter(|joint| width(joint) > NARROW);
    wide.max_by(|a, b| width(a).total_cmp(&width(b)))
}

/// A scale of zero demands an exact output.
fn priority(magnitudes: &[f64], scales: &[f64]) -> f64 {
    let pairs = magnitudes.iter().zip(scales);
    pairs.fold(0.0, |worst, (&x, &scale)| worst.max(relative(x, scale)))
}
