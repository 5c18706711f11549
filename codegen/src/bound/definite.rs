//! Whether D stays positive definite: forward dynamics divides by it.
//!
//! D is scaled first: with S = diag(1/√D_ii), D_ii at the middle of the box and rounded to a power
//! of four, S D S has no units, and its least eigenvalue tells how far D is from singular whatever
//! the masses and lengths are. S D S > 0 means D > 0.
//!
//! The entries of the *emitted* code are meant: their exact values written
//! out as trigonometric polynomials, and what rounding may add to each.

use crate::bound::expand::expand;
use crate::bound::grid::{self, Wanted};
use crate::bound::input_box::InputBox;
use crate::bound::sensitivity::rounding;
use crate::dag::{Dag, Folding};
use crate::edits::Stage;
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::{Program, ScalarType};
use crate::random::Random;
use crate::sincos::AngleKernel;
use crate::states::JointState;
use crate::words::{Complaint, complaint};

const POINTS: usize = 1 << 24;

const SAMPLES: usize = 64;

/// A pivot is negative for certain if it is so by this part of what it was
/// subtracted from, far beyond what doubles lose.
const CERTAIN: f64 = 1e-6;

fn unproved() -> Complaint {
    complaint(
        "D could not be shown to be positive definite over the box: \
         a link has no inertia, or almost none beside the others; or the box is too large",
    )
}

/// Returns a lower bound, above zero, of the least eigenvalue of S D S over the box,
/// D as code in the scalar computes it.
///
/// # Errors
/// Why D could not be shown to be positive definite; a program without D has no least eigenvalue.
pub fn least_eigenvalue(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
) -> Result<f64, Complaint> {
    shown(program, scalar, sines, limits, Wanted::Most)
}

pub(crate) fn is_definite(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
) -> bool {
    shown(program, scalar, sines, limits, Wanted::Any).is_ok()
}

fn shown(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
    wanted: Wanted,
) -> Result<f64, Complaint> {
    let n = program.rows.len();
    let first = start(program).ok_or_else(unproved)?;
    // No box has the values of parameters that are arguments.
    let mut parameters = [Argument::Load, Argument::Gravity].iter();
    if parameters.any(|parameter| program.arguments.contains(parameter)) {
        return Err(unproved());
    }
    let entry = |i: usize, j: usize| first + i * n + j;
    for i in 0..n {
        for j in 0..i {
            if program.dag.outputs[entry(i, j)] != program.dag.outputs[entry(j, i)] {
                let (row, column) = (program.rows[i] + 1, program.rows[j] + 1);
                return Err(complaint(format!(
                    "D_{row}{column} and D_{column}{row} are not the same value"
                )));
            }
        }
    }
    if let Some(row) = negative(program, limits, &entry) {
        return Err(complaint(format!(
            "D is not positive definite: at some position of the box a motion of joint {} and \
             those after it has a negative kinetic energy, so a link that they move has an inertia \
             that no body has: correct its `inertia`, `mass` or `com`",
            program.rows[row] + 1
        )));
    }
    let scales = scales(program, limits, entry)?;
    let lower: Vec<(usize, usize)> = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
    let costs = rounding(program, scalar, sines, limits);
    let graph = Stage::unedited(program.clone()).edited(Folding::Syntactic);
    let outputs = lower.iter().map(|&(i, j)| graph.outputs[entry(i, j)]);
    let graph = Dag {
        outputs: outputs.collect(),
        ..graph
    };
    let mut entries = expand(&graph, limits).ok_or_else(unproved)?;
    let mut errors = Vec::new();
    for (polynomial, &(i, j)) in entries.iter_mut().zip(&lower) {
        // A power of two: exact.
        let scale = scales[i] * scales[j];
        for (_, x) in polynomial {
            *x = *x * Interval::point(scale);
        }
        errors.push(costs[entry(i, j)].total() * scale);
    }
    let sliding = grid::sliding(&graph, limits.joints());
    grid::least_eigenvalue(&entries, &errors, limits, &sliding, POINTS, wanted).ok_or_else(unproved)
}

fn negative(
    program: &Program,
    limits: &InputBox,
    entry: &impl Fn(usize, usize) -> usize,
) -> Option<usize> {
    let n = program.rows.len();
    let code = program.in_doubles();
    let mut random = Random::new(0x1d3f);
    let drawn = (0..SAMPLES).map(|_| {
        let of = |q: &Interval| q.low() + q.width() * random.unit();
        limits.position.iter().map(of).collect()
    });
    let mut positions = std::iter::once(middle(limits)).chain(drawn);
    positions.find_map(|q| {
        let d = code.run_at(&JointState::at_rest(q));
        let d = (0..n).map(|i| (0..n).map(|j| d[entry(i, j)]).collect());
        negative_pivot(d.collect())
    })
}

/// Eliminates from the last row on: D of the joints from the returned one on is not positive
/// definite.
fn negative_pivot(mut d: Vec<Vec<f64>>) -> Option<usize> {
    let n = d.len();
    let mut sizes: Vec<f64> = (0..n).map(|i| d[i][i].abs()).collect();
    for last in (0..n).rev() {
        let pivot = d[last][last];
        let certain = CERTAIN * sizes[last];
        if pivot < -certain {
            return Some(last);
        }
        if pivot.is_nan() || pivot <= certain {
            return None;
        }
        let row = d[last].clone();
        for (i, above) in d.iter_mut().enumerate().take(last) {
            let factor = above[last] / pivot;
            sizes[i] += (factor * row[i]).abs();
            for (entry, subtracted) in above.iter_mut().zip(&row).take(last) {
                *entry -= factor * subtracted;
            }
        }
    }
    None
}

fn middle(limits: &InputBox) -> Vec<f64> {
    limits.position.iter().map(|q| q.mid()).collect()
}

fn start(program: &Program) -> Option<usize> {
    let quantities = program.function.quantities();
    let place = quantities.iter().position(|own| own.facts().definite)?;
    let before = quantities[..place].iter();
    Some(before.map(|own| own.len(program.sizes())).sum())
}

fn scales(
    program: &Program,
    limits: &InputBox,
    entry: impl Fn(usize, usize) -> usize,
) -> Result<Vec<f64>, Complaint> {
    let middle = JointState::at_rest(middle(limits));
    let values = program.in_doubles().run_at(&middle);
    let scale = |i: usize| {
        let diagonal = values[entry(i, i)];
        if !(diagonal > 0.0 && diagonal.is_finite()) {
            return Err(complaint(format!(
                "D is singular: joint {} moves nothing that has inertia; \
                 give its link mass, inertia or armature",
                program.rows[i] + 1
            )));
        }
        Ok(libm::exp2(-libm::round(0.5 * libm::log2(diagonal))))
    };
    (0..program.rows.len()).map(scale).collect()
}
