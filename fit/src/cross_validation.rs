//! Residuals on logs that a fit has not seen.

use crate::accumulator::Accumulator;
use crate::error::Error;
use crate::fit::{Prior, fit};
use crate::model::Model;

/// Residuals of a log, root mean squares, an entry a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct FileResidual {
    /// With the robot file's parameters.
    pub before: Vec<f64>,
    /// With those that were identified from all other logs.
    pub after: Vec<f64>,
}

/// Identifies from all logs but one, for each, and computes the residuals of that one.
///
/// # Errors
/// [`Error::OneFile`] and those of [`fit`].
pub fn cross_validation(
    model: &Model,
    files: &[Accumulator],
    prior: &Prior,
) -> Result<Vec<FileResidual>, Error> {
    if files.len() < 2 {
        return Err(Error::OneFile);
    }
    // Sums of all files after one, so that each file is merged twice and not once a file.
    let mut after = vec![Accumulator::new(model)];
    for file in files.iter().skip(1).rev() {
        let mut sum = file.clone();
        if let Some(rest) = after.last() {
            sum.merge(rest)?;
        }
        after.push(sum);
    }
    let mut before = Accumulator::new(model);
    let each = files.iter().map(|file| {
        let mut others = before.clone();
        if let Some(rest) = after.pop() {
            others.merge(&rest)?;
        }
        before.merge(file)?;
        let fit = fit(model, &others, prior)?;
        Ok(FileResidual {
            before: file.residual(model, model.parameters())?,
            after: file.residual(model, &fit.parameters)?,
        })
    });
    each.collect()
}
