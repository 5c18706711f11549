//! Operation counts.

use std::fmt;

/// Operations of straight-line code. Negation and copies are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Counts {
    /// Multiplications.
    pub mul: usize,
    /// Additions, subtractions, doublings, sums of angles.
    pub add: usize,
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
    /// With what so many r = 1/√(q̇² + w²) of Coulomb friction take.
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

    /// Multiplications, additions and divisions, without those of the sines'
    /// polynomials.
    pub fn operations(&self) -> usize {
        self.mul + self.add + self.div
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul, {} add", self.mul, self.add)?;
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
