//! Literals of printed code.

/// A literal's value in the code's scalar, held exactly. Equal are equal bits:
/// −0.0 is not 0.0.
#[derive(Clone, Copy, Debug)]
pub struct Literal(pub f64);

impl PartialEq for Literal {
    fn eq(&self, other: &Literal) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for Literal {}
