//! A log's residuals in the order of its rows: what a query does not keep.

use crate::dynamics::{Dynamics, States};
use crate::error::Error;
use crate::logs::{Block, Log, states};
use crate::progress::Going;

/// Calls with blocks of states and their residuals, column by column.
///
/// # Errors
/// Those of the log and of the call, and that the command was ended.
pub fn walk(
    robot: &dyn Dynamics,
    log: &Log,
    going: &Going,
    mut call: impl FnMut(&Block, &[f64]) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut residuals = Vec::new();
    for block in states(&log.path, &log.columns)? {
        let block = block?;
        going.check()?;
        let [q, qd, qdd, measured] = &block.quantities;
        let count = block.len();
        robot.residuals(States { count, q, qd, qdd }, measured, &mut residuals)?;
        call(&block, &residuals)?;
    }
    Ok(())
}
