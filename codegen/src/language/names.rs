//! Names in headers, and the types of scalars.

use dalembert_checker::read::Symbols;

use super::Language;
use super::c99::{is_bundle, structure_name};
use super::dialect::Dialect;
use crate::function::Function;
use crate::program::ScalarType;

/// The most characters of a name, of those that other files may see: compilers need not tell longer
/// ones apart.
pub(crate) const LONGEST: usize = 31;

/// The most characters of a name of a function at frames: it is `static`, and of those compilers tell
/// 63 apart.
const LONGEST_AT_FRAMES: usize = 63;

const SHORT: [(&str, &str); 19] = [
    ("inverse", "inv"),
    ("forward", "fwd"),
    ("dynamics", "dyn"),
    ("derivatives", "deriv"),
    ("second", "sec"),
    ("kinematics", "kin"),
    ("coefficients", "coef"),
    ("manipulator", "manip"),
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

/// For names that are still too long; `id` and `fd` are the inverse and the forward dynamics.
const SHORTER: [(&str, &str); 16] = [
    ("inv_dyn_", "id_"),
    ("fwd_dyn_", "fd_"),
    ("sec_deriv", "deriv2"),
    ("coriolis", "cor"),
    ("dalembert", "dal"),
    ("jacobian", "jac"),
    ("reaction_wrenches", "react_wr"),
    ("oper_inertia", "oper_in"),
    ("consistent", "cons"),
    ("null_space", "null"),
    ("linear", "lin"),
    ("angular", "ang"),
    ("centroidal_mom_matrix", "cmm"),
    ("centroidal", "cent"),
    ("centre_of_mass", "com"),
    ("joint_torques", "jt"),
];

/// With a word and a scalar of at most these letters, there is room for the name of a module.
const LONGEST_WORD: usize = 24;

/// Frames are many, or have names of any length: the longest part of a word loses its last letter
/// until it is short enough.
fn cut(word: &str, most: usize) -> String {
    let mut parts: Vec<String> = word.split('_').map(str::to_owned).collect();
    for _ in most..word.len() {
        let longest = parts.iter_mut().max_by_key(|part| part.len());
        longest.and_then(String::pop);
    }
    parts.join("_")
}

#[derive(Clone, Debug)]
pub struct Names {
    base: String,
    pub(super) language: Language,
    scalar: ScalarType,
}

impl Names {
    pub fn new(base: &str, language: Language, scalar: ScalarType) -> Names {
        Names {
            base: base.to_owned(),
            language,
            scalar,
        }
    }

    pub(crate) fn dialect(&self) -> Dialect {
        match self.language {
            Language::Cuda => Dialect::cuda(self.scalar),
            Language::C | Language::Rust => Dialect::c99(self.scalar),
        }
    }

    /// Returns a function or type by its word, shortened where it would be too long.
    pub fn of(&self, word: &str) -> String {
        self.with_limit(word).0
    }

    /// Returns the name of a word, and how many characters of it compilers tell apart.
    pub(crate) fn with_limit(&self, word: &str) -> (String, usize) {
        let infix = self.scalar.of("", "f32_");
        let name = |word: &str| format!("{}_{infix}{word}", self.base);
        let words = word.split('_').map(|part| {
            let short = SHORT.iter().find(|(long, _)| *long == part);
            short.map_or(part, |(_, short)| short)
        });
        let short = words.collect::<Vec<&str>>().join("_");
        let replaced = |text: String, (long, short): &(&str, &str)| text.replace(long, short);
        let shorter = SHORTER.iter().fold(short.clone(), replaced);
        let names = [word, &short, &shorter].map(name);
        let within = |limit: usize| names.iter().find(|name| name.len() <= limit).cloned();
        let least = LONGEST_WORD - infix.len();
        let room = |limit: usize| limit.saturating_sub(name("").len()).max(least);
        let limit = match shorter.len() > room(LONGEST) {
            true => LONGEST_AT_FRAMES,
            false => LONGEST,
        };
        let named = within(LONGEST).or_else(|| within(limit));
        let shortest = || name(&cut(&shorter, room(limit)));
        (named.unwrap_or_else(shortest), limit)
    }

    pub(crate) fn symbols(&self, function: Function) -> Symbols {
        let infix = self.scalar.of("", "_f32");
        Symbols {
            macros: self.macros(),
            prefix: format!("{}{infix}", self.base),
            single: self.of(function.name()),
            any: self.of(&format!("{function}_any")),
            batch: self.of(&format!("{function}_batch")),
            structure: is_bundle(function).then(|| structure_name(function, self)),
            is_cuda: self.language == Language::Cuda,
        }
    }

    pub(crate) fn macros(&self) -> String {
        self.base.to_uppercase()
    }

    pub(crate) fn constant(&self, word: &str) -> String {
        format!("{}_{word}", self.macros())
    }
}

pub(crate) fn float(scalar: ScalarType) -> &'static str {
    scalar.of("double", "float")
}
