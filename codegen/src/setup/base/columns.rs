//! Columns of a regressor modulo a prime, at random states.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::regressor::Column;
use dalembert_model::number::Exact;
use dalembert_model::scalar::field::Modulo;
use dalembert_model::scalar::sparse::Sparse;

use crate::dag::Points;
use crate::function::{Columns, Function, Quantity};
use crate::program::Input;
use crate::setup::Setup;

/// A seed of its own.
const SEED: u64 = 0x6261_7365;

/// Returns the columns, each over the rows of enough random states for every independent pair to
/// differ; `None` if a constant has no value.
pub(super) fn values<const P: u64>(
    setup: &Setup,
    quantity: Quantity,
    columns: &[Column<Exact>],
) -> Option<Vec<Vec<Modulo<P>>>> {
    let points = Points::new(SEED);
    // Constant angles are the same in every state.
    let constant = |value: &Exact| match points.constant_at(value, 0) {
        Some(residue) => Sparse::constant(value, residue),
        None => Sparse::Lost,
    };
    let is_over = |function: &Function| function.columns() == Columns::Base(quantity);
    let task = setup.task(Function::ALL.into_iter().find(is_over)?);
    let arm = setup.arm(constant);
    let columns: Vec<_> = columns.iter().map(|c| c.map(constant)).collect();
    let mut found: Vec<Vec<Modulo<P>>> = vec![Vec::new(); columns.len()];
    let states = columns.len() / setup.rows().len().max(1) + 4;
    for state in 0..states {
        let input = |input: Input| Sparse::Value(points.input_at(input, state));
        let posed = task.posed_over(arm.clone(), &(constant, input), Vec::new());
        for row in posed.regressor(Formulation::NewtonEulerLink, quantity, &columns) {
            for (column, entry) in found.iter_mut().zip(row) {
                column.push(entry.value()?);
            }
        }
    }
    Some(found)
}
