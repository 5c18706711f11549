//! The exact proof that base parameters give every torque: the column of each parameter of the
//! robot file is the combination of the regressor's columns that its base parameters say.
//!
//! Let B be what [`BaseParameters`] holds, π' = B π. Then τ = Y_full π = Y π' for
//! every π exactly if Y_full = Y B, entry by entry, and that is what is evaluated
//! here, as [`exact`](super::exact) evaluates programs: both sides by Lagrange–Euler, at points
//! that follow from the statement. Fewer columns would not do, and this needs no such proof: they
//! were independent modulo a prime, and so they are.
//!
//! [`BaseParameters`]: crate::setup::base::BaseParameters

use dalembert_model::equations::regressor::{Column, of_drives, of_links};
use dalembert_model::number::Exact;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;

use super::exact::{Disproof, compare, reference_formulation};
use super::points::{Degrees, Residue, written};
use crate::dag::Leaves;
use crate::function::{Quantity, RegressorColumns};
use crate::scalar::{AnyLeaves, Erase, restored};
use crate::setup::Task;
use crate::setup::base::{BaseParameters, Parameter};

/// Proves the base parameters of a robot in its scene that a function is over.
///
/// # Errors
/// A parameter whose torques they do not give, or too large a chance of a miss.
pub fn prove_base(task: Task<'_>, base: &BaseParameters) -> Result<(), Disproof> {
    let Task { setup, function } = task;
    let RegressorColumns::Base(quantity) = function.columns() else {
        return Err(Disproof::Shape);
    };
    let parameters = parameters(setup.robot());
    let place = |parameter: &Parameter| parameters.iter().position(|other| other == parameter);
    let combinations: Option<Vec<Vec<_>>> = base
        .combinations
        .iter()
        .map(|terms| {
            let terms = terms
                .iter()
                .map(|(parameter, factor)| Some((place(parameter)?, factor)));
            terms.collect()
        })
        .collect();
    let statement = Statement {
        task,
        quantity,
        columns: &base.columns,
        combinations: combinations.ok_or(Disproof::Unfit)?,
    };
    let length = setup.rows().len() * parameters.len();
    let base = format!("{function} {:?} {:?}", base.columns, base.combinations);
    let degrees = Degrees::default();
    let differences = statement.differences(&degrees);
    let zeros = vec![Scalar::zero(); length];
    let points = degrees.points(&differences, &zeros, setup.joints())?;
    compare(
        points,
        &["base parameters", &written(setup), &base],
        |_| Ok(Some(vec![Residue::zero(); length])),
        |point| Some(statement.differences(point)),
        |wrong| Disproof::Dependence(parameters[wrong % parameters.len()].to_string()),
    )
}

fn parameters(robot: &Robot) -> Vec<Parameter> {
    let drives = of_drives::<Exact>(robot);
    let of_drives = drives.iter().map(|drive| Parameter::of_drive(robot, drive));
    Parameter::of_bodies(robot).chain(of_drives).collect()
}

struct Statement<'a> {
    task: Task<'a>,
    quantity: Quantity,
    columns: &'a [Column<Exact>],
    /// Each base parameter's terms: the place of a parameter, and its factor.
    combinations: Vec<Vec<(usize, &'a Exact)>>,
}

impl Statement<'_> {
    /// Returns Y_full − Y B over the rows, row by row.
    fn differences<L: Leaves>(&self, leaves: &L) -> Vec<L::Value>
    where
        L::Value: Erase,
    {
        let leaves = &AnyLeaves(leaves);
        let setup = self.task.setup;
        let by = reference_formulation(setup);
        let posed = self.task.posed(leaves);
        let constant = |x: &Exact| leaves.constant(x);
        let mut full_columns = of_links(&setup.arm(constant));
        full_columns.extend(of_drives(setup.robot()));
        let base_columns: Vec<_> = self.columns.iter().map(|c| c.map(constant)).collect();
        let [whole, base] = [full_columns, base_columns]
            .map(|columns| posed.regressor(by, self.quantity, &columns));
        let mut residuals = Vec::new();
        for (mut differences, row) in whole.into_iter().zip(base) {
            for (entry, terms) in row.iter().zip(&self.combinations) {
                for (place, factor) in terms {
                    let part = entry.mul(&constant(factor));
                    differences[*place] = differences[*place].sub(&part);
                }
            }
            residuals.extend(differences);
        }
        restored(residuals)
    }
}
