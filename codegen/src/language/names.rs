//! Names in headers, and the types of scalars.

use super::Language;
use super::dialect::Dialect;
use crate::program::ScalarType;

/// The most characters of a name: compilers need not tell longer ones apart.
pub(crate) const LONGEST: usize = 31;

/// Words that are shortened in names that would be too long.
const SHORT: [(&str, &str); 20] = [
    ("inverse", "inv"),
    ("forward", "fwd"),
    ("dynamics", "dyn"),
    ("derivatives", "deriv"),
    ("second", "sec"),
    ("kinematics", "kin"),
    ("coefficients", "coef"),
    ("manipulator", "manip"),
    ("coriolis", "cor"),
    ("equation", "eq"),
    ("passivity", "pass"),
    ("regressor", "regr"),
    ("kinetic", "kin"),
    ("potential", "pot"),
    ("energy", "en"),
    ("momentum", "mom"),
    ("parameters", "param"),
    ("operational", "oper"),
    ("projector", "proj"),
    ("wrench", "wr"),
];

/// The names of one scalar's functions in a header of a language.
#[derive(Clone, Debug)]
pub struct Names {
    base: String,
    language: Language,
    scalar: ScalarType,
}

impl Names {
    /// The names of a module's functions in a scalar.
    pub fn new(base: &str, language: Language, scalar: ScalarType) -> Names {
        Names {
            base: base.to_owned(),
            language,
            scalar,
        }
    }

    /// The language.
    pub(super) fn language(&self) -> Language {
        self.language
    }

    /// Returns how its functions are written.
    pub(crate) fn dialect(&self) -> Dialect {
        match self.language {
            Language::Cuda => Dialect::cuda(self.scalar),
            Language::C | Language::Rust => Dialect::c99(self.scalar),
        }
    }

    /// A function or type by its word, shortened where it would be too long.
    pub(crate) fn of(&self, word: &str) -> String {
        let infix = match self.scalar {
            ScalarType::F64 => "",
            ScalarType::F32 => "f32_",
        };
        let name = format!("{}_{infix}{word}", self.base);
        if name.len() <= LONGEST {
            return name;
        }
        let words = word.split('_').map(|part| {
            let short = SHORT.iter().find(|(long, _)| *long == part);
            short.map_or(part, |(_, short)| short)
        });
        let words: Vec<&str> = words.collect();
        format!("{}_{infix}{}", self.base, words.join("_"))
    }

    /// A macro, which both scalars share.
    pub(crate) fn constant(&self, word: &str) -> String {
        format!("{}_{word}", self.base.to_uppercase())
    }
}

/// The scalar's type.
pub(crate) fn float(scalar: ScalarType) -> &'static str {
    match scalar {
        ScalarType::F64 => "double",
        ScalarType::F32 => "float",
    }
}
