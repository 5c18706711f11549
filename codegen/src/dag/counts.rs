//! Operation counts.

use std::fmt;

use super::{Dag, Operation};

/// Operations of straight-line code. Negation and copies are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Counts {
    /// Multiplications.
    pub mul: usize,
    /// Additions, subtractions, doublings.
    pub add: usize,
    /// Fused multiply-adds, which are not among the multiplications and additions.
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
    pub(crate) fn of_operations(operations: impl Iterator<Item = Operation>) -> Counts {
        let mut counts = Counts::default();
        for operation in operations {
            match operation {
                Operation::Mul => counts.mul += 1,
                Operation::Add | Operation::Sub => counts.add += 1,
                Operation::Div => counts.div += 1,
                Operation::Fused => counts.fma += 1,
            }
        }
        // A fused product is an operation with its sum.
        counts.add -= counts.fma;
        counts
    }

    pub(crate) fn with_speeds(self, speeds: usize) -> Counts {
        Counts {
            mul: self.mul + speeds,
            add: self.add + speeds,
            div: self.div + speeds,
            sqrt: self.sqrt + speeds,
            ..self
        }
    }

    /// Multiplications, additions, both in one and divisions, but those of sines' polynomials.
    pub fn operations(&self) -> usize {
        self.mul + self.add + self.fma + self.div
    }
}

impl<C, I> Dag<C, I> {
    pub(crate) fn arithmetic(&self) -> Counts {
        Counts::of_operations(self.operations().map(|(_, operation, _)| operation))
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul, {} add", self.mul, self.add)?;
        let others = [(self.fma, "fma"), (self.div, "div"), (self.sqrt, "sqrt")];
        for (count, name) in others.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, ", {count} {name}")?;
        }
        write!(f, ", {} sincos", self.sincos)?;
        if self.trig_mul + self.trig_add > 0 {
            let (mul, add) = (self.trig_mul, self.trig_add);
            write!(f, ", {mul} trig_mul, {add} trig_add")?;
        }
        Ok(())
    }
}
