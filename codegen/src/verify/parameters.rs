//! The exact proof that base parameters give every torque: the column of each
//! parameter of the robot file is the combination of the regressor's columns
//! that its base parameters say.
//!
//! Let B be what [`BaseParameters`] holds, π' = B π. Then τ = Y_full π = Y π' for
//! every π exactly if Y_full = Y B, entry by entry, and that is what is evaluated
//! here, as [`exact`](super::exact) evaluates programs: both sides by Lagrange–Euler, at points
//! that follow from the statement. Fewer columns would not do, and this needs no such proof: they
//! were independent modulo a prime, and so they are.
//!
//! [`BaseParameters`]: crate::setup::base::BaseParameters

use std::collections::BTreeMap;

use dalembert_model::equations::Formulation;
use dalembert_model::equations::regressor::{Column, LinkParameter, of_drives, of_links};
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use super::degree::Degrees;
use super::exact::{Disproof, bounded, compare, reference_formulation};
use super::points::{Residue, written};
use crate::dag::Leaves;
use crate::function::{Columns, Quantity};
use crate::setup::Task;
use crate::setup::base::{BaseParameters, Parameter};

/// Proves the base parameters of a robot in its scene that a function is over.
///
/// # Errors
/// A parameter whose torques they do not give, or too large a chance of a miss.
pub fn prove_base(task: Task<'_>, base: &BaseParameters) -> Result<(), Disproof> {
    let Task { setup, function } = task;
    let Columns::Base(quantity) = function.columns() else {
        return Err(Disproof::Shape);
    };
    let statement = Statement {
        task,
        quantity,
        base,
        formulation: reference_formulation(setup),
    };
    let combinations = statement.combinations().ok_or(Disproof::Unfit)?;
    let parameters = statement.parameters();
    let length = setup.rows().len() * parameters.len();
    let base = format!("{function} {:?} {:?}", base.columns, base.combinations);
    compare(
        &["base parameters", &written(setup), &base],
        |_| Ok(Some(vec![Residue::zero(); length])),
        |point| Some(statement.differences(&combinations, point)),
        |wrong| Disproof::Dependence {
            parameter: parameters[wrong % parameters.len()].to_string(),
        },
    )?;
    let degrees = Degrees::default();
    let differences = statement.differences(&combinations, &degrees);
    let zeros = vec![Scalar::zero(); length];
    bounded(degrees.of_differences(&differences, &zeros, setup.joints()))
}

struct Statement<'a> {
    task: Task<'a>,
    quantity: Quantity,
    base: &'a BaseParameters,
    formulation: Formulation,
}

impl Statement<'_> {
    /// Returns all parameters of the robot file, in the order of the full columns.
    fn parameters(&self) -> Vec<Parameter> {
        let rows = 0..self.task.setup.robot().rows().len();
        let links = rows.flat_map(|joint| {
            let all = LinkParameter::ALL.into_iter();
            all.map(move |own| Parameter::Link(joint, own))
        });
        let drives = of_drives::<Exact>(self.task.setup.robot()).into_iter();
        let drives = drives.map(|column| match column {
            Column::Viscous(joint) => Parameter::Viscous(joint),
            Column::Armature(joint) | Column::Body { joint, .. } => Parameter::Armature(joint),
        });
        links.chain(drives).collect()
    }

    /// Returns each base parameter's terms: the place of a parameter, and its factor. None if
    /// there is no such parameter.
    fn combinations(&self) -> Option<Vec<Vec<(usize, &Exact)>>> {
        let places: BTreeMap<Parameter, usize> = (self.parameters().into_iter())
            .enumerate()
            .map(|(place, parameter)| (parameter, place))
            .collect();
        let combinations = self.base.combinations.iter().map(|terms| {
            let terms = terms.iter();
            let terms = terms.map(|(own, factor)| Some((*places.get(own)?, factor)));
            terms.collect()
        });
        combinations.collect()
    }

    /// Returns Y_full − Y B over the rows, row by row.
    fn differences<L: Leaves>(
        &self,
        combinations: &[Vec<(usize, &Exact)>],
        leaves: &L,
    ) -> Vec<L::Value> {
        let robot = self.task.setup.robot();
        let posed = self.task.posed(leaves);
        let constant = |x: &Exact| leaves.constant(x);
        let mut all = of_links(robot.rows().len());
        all.extend(of_drives(robot));
        let own: Vec<_> = self.base.columns.iter().map(|c| c.map(constant)).collect();
        let [whole, own] =
            [all, own].map(|columns| posed.regressor(self.formulation, self.quantity, &columns));
        let mut found = Vec::new();
        for (mut differences, own) in whole.into_iter().zip(own) {
            for (entry, terms) in own.iter().zip(combinations) {
                for (place, factor) in terms {
                    let part = entry.mul(&constant(factor));
                    differences[*place] = differences[*place].sub(&part);
                }
            }
            found.extend(differences);
        }
        found
    }
}
