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
use dalembert_model::scalar::Scalar;

use super::exact::{Disproof, compare, reference_formulation};
use super::points::{Degrees, Residue, written};
use crate::dag::Leaves;
use crate::function::{Quantity, RegressorColumns};
use crate::scalar::{AnyLeaves, Erase, restored};
use crate::setup::Task;
use crate::setup::base::{BaseParameters, Parameter};

/// Proves the base parameters of a robot in its scene that a function is over.
pub fn prove_base(task: Task<'_>, base: &BaseParameters) -> Result<(), Disproof> {
    let Task { setup, function } = task;
    let RegressorColumns::Base(quantity) = function.columns() else {
        return Err(Disproof::Shape);
    };
    let robot = setup.robot();
    let drives = of_drives::<Exact>(robot);
    let driven = drives.iter().map(|drive| Parameter::of_drive(robot, drive));
    let parameters: Vec<Parameter> = Parameter::of_bodies(robot).chain(driven).collect();
    let place = |parameter: &Parameter| parameters.iter().position(|other| other == parameter);
    let (columns, mut combinations) = (&base.columns, Vec::new());
    for combination in &base.combinations {
        let mut terms = Vec::new();
        for (parameter, factor) in combination {
            terms.push((place(parameter).ok_or(Disproof::Unfit)?, factor));
        }
        combinations.push(terms);
    }
    let length = setup.rows().len() * parameters.len();
    let base = format!("{function} {columns:?} {:?}", base.combinations);
    let degrees = Degrees::default();
    let outputs = differences(task, quantity, columns, &combinations, &degrees);
    let zeros = vec![Scalar::zero(); length];
    let points = degrees.points(&outputs, &zeros, setup.joints())?;
    compare(
        points,
        &["base parameters", &written(setup), &base],
        |_| Ok(Some(vec![Residue::zero(); length])),
        |point| Some(differences(task, quantity, columns, &combinations, point)),
        |wrong| Disproof::Dependence(parameters[wrong % parameters.len()].to_string()),
    )
}

/// Returns Y_full − Y B over the rows, row by row. `combinations` are each base parameter's terms: the
/// place of a parameter, and its factor.
fn differences<L: Leaves>(
    task: Task<'_>,
    quantity: Quantity,
    columns: &[Column<Exact>],
    combinations: &[Vec<(usize, &Exact)>],
    leaves: &L,
) -> Vec<L::Value>
where
    L::Value: Erase,
{
    let leaves = &AnyLeaves(leaves);
    let setup = task.setup;
    let by = reference_formulation(setup);
    let posed = task.posed(leaves);
    let constant = |x: &Exact| leaves.constant(x);
    let mut full_columns = of_links(&setup.arm(constant));
    full_columns.extend(of_drives(setup.robot()));
    let base_columns: Vec<_> = columns.iter().map(|c| c.map(constant)).collect();
    let regressor = |columns: Vec<_>| posed.regressor(by, quantity, &columns);
    let [whole, base] = [full_columns, base_columns].map(regressor);
    let mut residuals = Vec::new();
    for (mut differences, row) in whole.into_iter().zip(base) {
        for (entry, terms) in row.iter().zip(combinations) {
            for (place, factor) in terms {
                let part = entry.mul(&constant(factor));
                differences[*place] = differences[*place].sub(&part);
            }
        }
        residuals.extend(differences);
    }
    restored(residuals)
}
