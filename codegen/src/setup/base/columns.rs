//! Columns of a regressor modulo a prime, at random states.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::following::gather;
use dalembert_model::equations::regressor::Column;
use dalembert_model::number::Exact;
use dalembert_model::outputs::{RuntimeParameter, Written};
use dalembert_model::scalar::field::Modulo;
use dalembert_model::scalar::sparse::Sparse;

use crate::dag::Points;
use crate::function::{Argument, Quantity};
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
    let arm = setup.arm(constant);
    let columns: Vec<_> = columns.iter().map(|c| c.map(constant)).collect();
    let mut found: Vec<Vec<Modulo<P>>> = vec![Vec::new(); columns.len()];
    let states = columns.len() / setup.rows().len().max(1) + 4;
    for state in 0..states {
        let input = |input: Input| Sparse::Value(points.input_at(input, state));
        let motion = setup.motion(input, constant);
        let mut arm = arm.clone().at_speeds(&motion.per_speed);
        if setup.has(RuntimeParameter::Gravity) {
            let entry = |axis| input(Input::Entry(Argument::Gravity, axis));
            arm = arm.with_gravity(&[0, 1, 2].map(entry));
        }
        let mut entries = quantity.written(&Written {
            formulation: Formulation::NewtonEulerLink,
            arm: &arm,
            at: &arm.at(&motion.q),
            motion: &motion,
            columns: &columns,
        });
        let rows: Vec<usize> = (0..arm.links.len()).collect();
        // Joints that follow are gathered at their leaders.
        gather(&arm.following, &rows, columns.len(), &mut entries);
        let rows: Vec<&[Sparse<Modulo<P>>]> = entries.chunks(columns.len().max(1)).collect();
        for &joint in setup.rows() {
            let row = setup.robot().row_of(joint);
            for (column, entry) in found.iter_mut().zip(rows[row]) {
                column.push(entry.value()?);
            }
        }
    }
    Some(found)
}
