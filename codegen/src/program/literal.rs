//! Literals of printed code.

use super::ScalarType;

/// A literal's value in the code's scalar, held exactly. Equal are equal bits:
/// −0.0 is not 0.0.
#[derive(Clone, Copy, Debug)]
pub struct Literal(pub f64);

impl Literal {
    /// Returns the shortest text that reads back as the value in the scalar.
    pub fn text(self, scalar: ScalarType) -> String {
        match scalar {
            ScalarType::F64 => format!("{:?}", self.0),
            ScalarType::F32 => format!("{:?}", self.0 as f32),
        }
    }
}

impl PartialEq for Literal {
    fn eq(&self, other: &Literal) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for Literal {}

impl std::hash::Hash for Literal {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}
