//! Operation counts.

use std::fmt;

use super::{Operation, Step};

/// Operations of straight-line code. Negation and copies are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Counts {
    /// Multiplications.
    pub mul: usize,
    /// Additions, subtractions, doublings, sums of angles.
    pub add: usize,
    /// Products with a sum that takes them, a fused multiply-add each; neither is
    /// among the multiplications and additions.
    pub fma: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Sine and cosine evaluations: a pair for one angle, or one of the two.
    pub sincos: usize,
    /// Multiplications of the polynomials that give them; none if libm does.
    pub trig_mul: usize,
    /// Additions of these.
    pub trig_add: usize,
}

impl Counts {
    /// Counts the arithmetic alone, without sines.
    pub(super) fn of_steps<C, I>(steps: &[Step<C, I>]) -> Counts {
        let [mul, div, fma] = [Operation::Mul, Operation::Div, Operation::Fused].map(|operation| {
            let is = |step: &&Step<C, I>| step.operation == operation;
            steps.iter().filter(is).count()
        });
        Counts {
            mul,
            // A fused product is a step beside its sum.
            add: steps.len() - mul - div - 2 * fma,
            fma,
            div,
            ..Counts::default()
        }
    }

    /// Returns the counts with what so many r = 1/√(q̇² + w²) of Coulomb friction take.
    pub(crate) fn with_speeds(self, speeds: usize) -> Counts {
        let [mul, add, sqrt, div] = super::speed::OPERATIONS.map(|each| each * speeds);
        Counts {
            mul: self.mul + mul,
            add: self.add + add,
            div: self.div + div,
            sqrt: self.sqrt + sqrt,
            ..self
        }
    }

    /// Multiplications, additions, both in one and divisions, without those of the sines'
    /// polynomials.
    pub fn operations(&self) -> usize {
        self.mul + self.add + self.fma + self.div
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul, {} add", self.mul, self.add)?;
        if self.fma > 0 {
            write!(f, ", {} fma", self.fma)?;
        }
        if self.div > 0 {
            write!(f, ", {} div", self.div)?;
        }
        if self.sqrt > 0 {
            write!(f, ", {} sqrt", self.sqrt)?;
        }
        write!(f, ", {} sincos", self.sincos)?;
        if self.trig_mul + self.trig_add > 0 {
            let (mul, add) = (self.trig_mul, self.trig_add);
            write!(f, ", {mul} trig_mul, {add} trig_add")?;
        }
        Ok(())
    }
}
