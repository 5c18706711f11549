//! The load that a payload is: which regrouped parameters a body changes that is
//! fixed to the last link, and how.
//!
//! They are base parameters ([`super::base`]) that the last link's own parameters
//! are part of. A payload adds to these, about the origin and in the axes of the
//! same frame; so it adds to each base parameter what the last link's parameters
//! would, and all others stay constants of the arm.

use dalembert_model::equations::chain::Regrouping;
use dalembert_model::equations::load::LoadRow;
use dalembert_model::equations::regressor::Column;
use dalembert_model::equations::{Arm, Link};
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use super::Setting;
use super::base::{BaseParameters, NoBase, Parameter};
use crate::function::Quantity;

/// The regrouped parameters of an arm with a payload.
#[derive(Clone, Debug)]
pub struct LoadParameters {
    /// What each number of the load is of; then what each of the constants is.
    pub columns: Vec<Column<Exact>>,
    /// The numbers of the load, the first of the columns.
    pub rows: Vec<LoadRow<Exact>>,
    /// The values of the other columns.
    pub constants: Vec<Exact>,
    /// About which points they are taken.
    pub regrouping: Regrouping<Exact>,
}

impl LoadParameters {
    /// Of a setting: of all joints that move, at any velocities, whatever is
    /// asked for.
    ///
    /// # Errors
    /// Why the parameters cannot be written down.
    pub(super) fn of(setting: &Setting) -> Result<LoadParameters, NoBase> {
        let base = BaseParameters::of(&setting.in_full_motion(), Quantity::BaseRegressor)?;
        let arm = Arm::from_robot(setting.robot(), &mut Exact::clone);
        let last = arm.links.len().saturating_sub(1);
        let (mut loads, mut fixed) = (Vec::new(), Vec::new());
        let mut constants = Vec::new();
        let mut rows = Vec::new();
        for (column, terms) in base.columns.iter().zip(&base.combinations) {
            // A chain has drives of its own.
            if !matches!(column, Column::Body { .. }) {
                continue;
            }
            let row = row(&arm.links, terms, last);
            if row.of.is_empty() {
                fixed.push(column.clone());
                constants.push(row.own);
            } else {
                loads.push(column.clone());
                rows.push(row);
            }
        }
        loads.extend(fixed);
        Ok(LoadParameters {
            columns: loads,
            rows,
            constants,
            regrouping: base.regrouping,
        })
    }
}

/// A base parameter of bodies: what the arm has of it, and what it has of the last
/// link's parameters.
fn row(links: &[Link<Exact>], terms: &[(Parameter, Exact)], last: usize) -> LoadRow<Exact> {
    let mut row = LoadRow {
        own: Exact::zero(),
        of: Vec::new(),
    };
    for (parameter, factor) in terms {
        // The rest is the drives'.
        let Parameter::Link(joint, own) = *parameter else {
            continue;
        };
        let Some(link) = links.get(joint) else {
            continue;
        };
        row.own = row.own.add(&own.of(link).mul(factor));
        if joint == last {
            row.of.push((own, factor.clone()));
        }
    }
    row
}
