//! Mistakes in a log that its residuals give away: angles in other units, columns of other
//! joints, torques that are late.
//!
//! Each joint's row of τ = Y π is fitted alone, so that no mistake of one joint hides in
//! another's parameters. The part of the torque that such fits leave falls to the sensors' noise
//! if the mistake is undone, and hardly if another one is.

use crate::accumulator::Accumulator;
use crate::error::{Error, check};
use crate::fit::noise;
use crate::model::Model;
use dalembert_model::robot::JointKind;

/// A change of a log's columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// Angles and their rates times a factor.
    Angles(f64),
    /// The torques of two joints in each other's place.
    Torques(usize, usize),
    /// All that is logged of two joints in each other's place.
    Joints(usize, usize),
    /// Torques of so many rows later.
    Late(isize),
}

/// A change under which the model explains a log's torques.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suspicion {
    /// The change.
    pub change: Change,
    /// The part of the torques, root mean square over the joints, that fits leave of the log.
    pub before: f64,
    /// The part that they leave with the change.
    pub after: f64,
}

const STATES: usize = 600;
/// The longest delay, rows.
const LATEST: usize = 128;
/// A change is suspected where it leaves less than so much of what was left.
const LESS: f64 = 0.25;

/// Searches for the change of a log after which fits leave least of its torques.
///
/// `log` is q, q̇, q̈ and τ of rows at equal times: entry i of row s at `i * rows + s`. Nothing of a base
/// that floats is suspected.
///
/// # Errors
/// [`Error::Length`], [`Error::Value`], and [`Error::TooFew`] of short logs.
pub fn suspect(model: &Model, log: [&[f64]; 4]) -> Result<Option<Suspicion>, Error> {
    let n = model.joints();
    if model.robot().floating.is_some() {
        return Ok(None);
    }
    let rows = log[0].len() / n;
    for (name, column) in ["q", "qd", "qdd", "tau"].into_iter().zip(log) {
        check(name, column, n * rows)?;
    }
    let before = unexplained_part(model, log, rows, None)?;
    let degrees = core::f64::consts::PI / 180.0;
    let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (j, i)));
    let delays = (0..7).flat_map(|k| [1 << k, -(1 << k), 3 << k >> 1, -(3 << k >> 1)]);
    let mut changes = vec![Change::Angles(degrees), Change::Angles(1.0 / degrees)];
    changes.extend(pairs.clone().map(|(i, j)| Change::Torques(i, j)));
    changes.extend(pairs.map(|(i, j)| Change::Joints(i, j)));
    changes.extend(delays.map(Change::Late));
    let (mut best, mut least) = (None, LESS * before);
    for change in changes {
        let after = unexplained_part(model, log, rows, Some(change))?;
        if after < least {
            (best, least) = (Some(change), after);
        }
    }
    Ok(best.map(|change| Suspicion {
        change,
        before,
        after: least,
    }))
}

fn unexplained_part(
    model: &Model,
    log: [&[f64]; 4],
    rows: usize,
    change: Option<Change>,
) -> Result<f64, Error> {
    let n = model.joints();
    let swapped = |i: usize, [a, b]: [usize; 2]| match i {
        _ if i == a => b,
        _ if i == b => a,
        _ => i,
    };
    let mut data = Accumulator::new(model);
    let mut squares = vec![0.0; n];
    let last = rows.saturating_sub(LATEST);
    for row in (LATEST..last).step_by((rows / STATES).max(1)) {
        let [q, qd, qdd, tau] = [0, 1, 2, 3].map(|quantity| -> Vec<f64> {
            let value = |i: usize, row: usize| log[quantity][i * rows + row];
            let entry = |i: usize| match change {
                Some(Change::Joints(a, b)) => value(swapped(i, [a, b]), row),
                Some(Change::Torques(a, b)) if quantity == 3 => value(swapped(i, [a, b]), row),
                Some(Change::Late(by)) if quantity == 3 => value(i, row.saturating_add_signed(by)),
                Some(Change::Angles(factor)) if quantity < 3 => {
                    let is_angle = model.robot().joints[i].kind == JointKind::Revolute;
                    value(i, row) * if is_angle { factor } else { 1.0 }
                }
                _ => value(i, row),
            };
            (0..n).map(entry).collect()
        });
        data.add(model, [&q, &qd, &qdd], &tau)?;
        for (sum, tau) in squares.iter_mut().zip(&tau) {
            *sum += tau * tau;
        }
    }
    let part = |(noise, squares): (f64, f64)| match squares / data.states() as f64 {
        mean_square if mean_square > 0.0 => noise * noise / mean_square,
        _ => 0.0,
    };
    let parts = noise(&data)?.into_iter().zip(squares).map(part);
    Ok(libm::sqrt(parts.sum::<f64>() / n as f64))
}
