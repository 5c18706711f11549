//! The proof of a variant's programs: before a claim is made of one that was just found,
//! and of one that a plan kept.

use super::subject::direct;
use super::{Certificate, Refuted, shape, work};
use crate::dag::Folding;
use crate::setup::Setup;
use crate::verify::exact::prove_same;

impl Certificate {
    /// Checks that the programs are of this robot and scene, and that the edits lead from
    /// each to the next. What a certificate claims of them, `dalembert-checker` checks.
    pub(crate) fn check_programs(&self, setup: &Setup) -> Result<(), Refuted> {
        let programs = self.stages.iter().map(|stage| &stage.program);
        let mut programs = programs.chain([&self.emitted]);
        if !programs.all(|program| program.dag.is_straight()) {
            return Err(Refuted::Shape);
        }
        work::check(self).map_err(Refuted::Work)?;
        shape::check(self, setup)?;
        self.check_edits()
    }

    /// Checks that each stage's edits apply and give the program that follows. A function that is
    /// bounded against the exact one need not come of it by edits.
    fn check_edits(&self) -> Result<(), Refuted> {
        if direct(&self.stages, &self.emitted).is_some() {
            return Ok(());
        }
        for (index, stage) in self.stages.iter().enumerate() {
            stage.check().map_err(|bad| Refuted::Edits(index, bad))?;
            let next = self.stages.get(index + 1).map(|next| &next.program);
            let edited = stage.program(Folding::Syntactic);
            let next = next.unwrap_or(&self.emitted);
            prove_same(&edited, next).map_err(|_| Refuted::Step(index))?;
        }
        Ok(())
    }
}
