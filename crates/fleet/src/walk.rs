//! A log's residuals in the order of its rows: what a query does not keep.

use crate::dynamics::Dynamics;
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
        // Every row of it has a null.
        if block.is_empty() {
            continue;
        }
        robot.residuals(block.len(), &block.quantities, &mut residuals)?;
        call(&block, &residuals)?;
    }
    Ok(())
}
