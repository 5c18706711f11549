//! D stays positive definite: forward dynamics divides by it.
//!
//! The entries of the *emitted* code are meant: its exact values, the errors of its sines, and what
//! rounding may add to each. Where `turning` does not show it, the engine does, by the same means as a
//! bound.

use dalembert_checker::domain::Domain;
use dalembert_model::diagnostic::Diagnostic;

use super::input_box::InputBox;
use super::reference;
use crate::program::Program;
use crate::random::Random;
use crate::sincos::AngleKernel;
use crate::sincos::interval::Interval;
use crate::sincos::proof::Errors;
use crate::states::JointState;

const SAMPLES: usize = 64;

/// A pivot is positive or negative for certain if it is so by this part of what it was subtracted
/// from, far beyond what doubles lose.
const CERTAIN: f64 = 1e-6;

/// Returns the place of D among the results, if it is there and its two halves are the same values.
pub(super) fn inertia_place(program: &Program) -> Option<usize> {
    let (n, first) = (program.rows.len(), start(program)?);
    let outputs = &program.dag.outputs[first..][..n * n];
    let mut entries = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
    let is_symmetric = entries.all(|(i, j)| outputs[i * n + j] == outputs[j * n + i]);
    is_symmetric.then_some(first)
}

/// Returns true if D is shown to be positive definite, with these sines, where each result may be so far
/// off beside.
pub(crate) fn is_definite(
    domain: &Domain,
    program: &Program,
    sines: &[AngleKernel],
    off: Option<&[f64]>,
) -> bool {
    let n = program.rows.len();
    let Some(first) = inertia_place(program) else {
        return false;
    };
    let error = |joint: usize, is_sine: bool| {
        let Errors { sin, cos } = sines.iter().find(|kernel| kernel.joint == joint)?.errors;
        Some(if is_sine { sin } else { cos })
    };
    let sine_errors: Option<&dyn Fn(usize, bool) -> Option<f64>> = match sines {
        [] => None,
        _ => Some(&error),
    };
    let written = reference::read(program).ok();
    let Some(written) = written.and_then(|program| domain.write(&program, sine_errors).ok()) else {
        return false;
    };
    let lower = (0..n).flat_map(|i| (0..=i).map(move |j| first + i * n + j));
    let entries: Vec<_> = lower.clone().map(|place| written[place].clone()).collect();
    let bound = |place: usize| off.map_or(0.0, |off| off[place]).next_up();
    let bounds: Vec<f64> = lower.map(bound).collect();
    domain.is_definite(&entries, &bounds)
}

/// Returns why D of an exact program is not positive definite, or cannot be shown to be.
pub(super) fn indefinite(program: &Program, limits: &InputBox) -> Diagnostic {
    Diagnostic::error(match negative(program, limits) {
        Some(row) => format!(
            "D is not positive definite: at some position of the box a motion of {} and \
             those after it has a negative kinetic energy, so a link that they move has an inertia \
             that no rigid body can have: correct its `inertia`, `mass` or `com`",
            match program.rows[row].checked_sub(program.floating) {
                Some(joint) => format!("joint {}", joint + 1),
                None => "the base".to_owned(),
            }
        ),
        None => {
            "D could not be shown to be positive definite over the box: a link has no inertia, or \
             almost none beside the others, or none about an axis; or the box is too large"
                .into()
        }
    })
}

fn negative(program: &Program, limits: &InputBox) -> Option<usize> {
    let (n, first) = (program.rows.len(), start(program)?);
    let code = program.in_doubles();
    let mut random = Random::new(0x1d3f);
    let drawn = (0..SAMPLES).map(|_| {
        let of = |q: &Interval| q.low() + q.width() * random.unit();
        limits.position.iter().map(of).collect()
    });
    let middle = limits.position.iter().map(|q| q.mid()).collect();
    let mut positions = std::iter::once(middle).chain(drawn);
    positions.find_map(|q| {
        let results = code.run_at(&JointState::at_rest(q));
        let rows = (0..n).map(|i| results[first + i * n..][..n].to_vec());
        let why = eliminated(rows.collect()).err()?;
        why.is_negative.then_some(why.row)
    })
}

/// A matrix that is not seen to be positive definite.
pub(super) struct NotDefinite {
    /// The submatrix from this row on is not.
    row: usize,
    /// `true` if that is certain.
    is_negative: bool,
}

/// Eliminates a symmetric matrix from the last row on.
pub(super) fn eliminated(mut d: Vec<Vec<f64>>) -> Result<(), NotDefinite> {
    let n = d.len();
    let mut sizes: Vec<f64> = (0..n).map(|i| d[i][i].abs()).collect();
    for row in (0..n).rev() {
        let pivot = d[row][row];
        let certain = CERTAIN * sizes[row];
        if pivot.is_nan() || pivot <= certain {
            let is_negative = pivot < -certain;
            return Err(NotDefinite { row, is_negative });
        }
        let last = d[row].clone();
        for (i, above) in d.iter_mut().enumerate().take(row) {
            let factor = above[row] / pivot;
            sizes[i] += (factor * last[i]).abs();
            for (entry, subtracted) in above.iter_mut().zip(&last).take(row) {
                *entry -= factor * subtracted;
            }
        }
    }
    Ok(())
}

fn start(program: &Program) -> Option<usize> {
    let quantities = program.function.quantities();
    let mut definite = quantities.iter().map(|quantity| quantity.facts().definite);
    let place = definite.position(|is_definite| is_definite)?;
    let before = quantities[..place].iter();
    Some(before.map(|quantity| quantity.len(program.sizes())).sum())
}
