//! Residuals on logs that a fit has not seen, and logs that disagree with the others.

use crate::accumulator::Accumulator;
use crate::error::Error;
use crate::fit::fit;
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
pub fn cross_validation(model: &Model, files: &[Accumulator]) -> Result<Vec<FileResidual>, Error> {
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
    let residuals = files.iter().map(|file| {
        let mut others = before.clone();
        if let Some(rest) = after.pop() {
            others.merge(&rest)?;
        }
        before.merge(file)?;
        let fit = fit(model, &others)?;
        Ok(FileResidual {
            before: file.residual(model, model.parameters())?,
            after: file.residual(model, &fit.parameters)?,
        })
    });
    residuals.collect()
}

/// A log that the other logs' parameters do not explain, though its own do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disagreement {
    /// Its place among the logs.
    pub file: usize,
    /// The joint at which it disagrees most.
    pub joint: usize,
    /// That joint's residual with parameters from the other logs, root mean square.
    pub others: f64,
    /// The residual with parameters from the log itself.
    pub self_fit: f64,
}

/// A log disagrees where the others' parameters leave more than so many times what its own do.
const DISAGREES: f64 = 2.0;

const MOST: usize = 8;

/// Finds up to eight logs that disagree with the others, the worst first; `validation` is their
/// [`cross_validation`]. Each is left out before the next search, since its states are in the
/// parameters that judge the rest. If two are left, both are returned.
pub fn disagreeing(
    model: &Model,
    files: &[Accumulator],
    validation: &[FileResidual],
) -> Result<Vec<Disagreement>, Error> {
    // A log too short for parameters of its own is not judged.
    let fits: Vec<_> = files.iter().map(|file| fit(model, file).ok()).collect();
    let mut rest: Vec<usize> = (0..files.len()).collect();
    let (mut residuals, mut disagreements) = (validation.to_vec(), Vec::new());
    loop {
        let joints = rest.iter().zip(&residuals).flat_map(|(&file, residual)| {
            let fit_residuals = fits[file].iter().flat_map(|fit| &fit.after);
            let pairs = residual.after.iter().zip(fit_residuals).enumerate();
            pairs.map(move |(joint, (&others, &self_fit))| Disagreement {
                file,
                joint,
                others,
                self_fit,
            })
        });
        let mut worst: Vec<Disagreement> = joints.filter(|one| one.size() > DISAGREES).collect();
        worst.sort_by(|a, b| b.size().total_cmp(&a.size()));
        let Some(&one) = worst.first() else {
            return Ok(disagreements);
        };
        disagreements.push(one);
        if rest.len() == 2 {
            disagreements.extend(worst.into_iter().find(|other| other.file != one.file));
        }
        if rest.len() == 2 || disagreements.len() == MOST {
            return Ok(disagreements);
        }
        rest.retain(|file| *file != one.file);
        let kept: Vec<Accumulator> = rest.iter().map(|file| files[*file].clone()).collect();
        residuals = cross_validation(model, &kept)?;
    }
}

impl Disagreement {
    fn size(&self) -> f64 {
        self.others / self.self_fit.max(f64::MIN_POSITIVE)
    }
}
