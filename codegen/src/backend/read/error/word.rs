//! A word that is not what it should be.

use std::fmt;

/// A word that is not what it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WordFault {
    /// A statement lacks one of its marks.
    Lacks(Mark),
    /// A word is none of its kind.
    Not(String, Kind),
    /// The statements are numbered, and this is not the next one.
    Next {
        /// The name that is next.
        expected: String,
        /// The name that is there.
        found: String,
    },
    /// Another word must stand there.
    Instead {
        /// The word that must.
        expected: String,
        /// The word that does.
        found: String,
    },
    /// Another word must stand there in the result.
    InsteadInResult {
        /// The word that must.
        expected: String,
        /// The word that does.
        found: String,
    },
}

/// What a statement may lack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Its end.
    Semicolon,
    /// The mark between name and value.
    Equals,
    /// A function and its argument.
    Call,
    /// The end of a call.
    Parenthesis,
    /// The end of a call with an array.
    Bracket,
}

/// What a word is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The symbol of an operation.
    Operation,
    /// The symbol of an operation that polynomials have.
    PolynomialOperation,
    /// Two operands and a symbol.
    OneOperation,
    /// A product that a sum takes.
    Fused,
    /// A value that lines before computed.
    Computed,
    /// A value or a literal.
    Operand,
    /// The angle, a value or a literal.
    PolynomialOperand,
    /// The position of a joint.
    Position,
    /// A plus or minus.
    Sign,
    /// An angle.
    Angle,
    /// A sine or a cosine.
    Sine,
    /// A sine and a cosine.
    Pair,
    /// Sines and cosines.
    Pairs,
    /// The function that gives all sines and cosines.
    Sincos,
    /// A sine or cosine that the caller gives.
    GivenSine,
    /// An entry of the result.
    Entry,
    /// The head of a part.
    PartHead,
    /// A value of one lane.
    Lane,
}

impl fmt::Display for WordFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WordFault::Lacks(mark) => f.write_str(match mark {
                Mark::Semicolon => "no `;` at the end",
                Mark::Equals => "no ` = `",
                Mark::Call => "no call",
                Mark::Parenthesis => "no `)`",
                Mark::Bracket => "no `])`",
            }),
            WordFault::Not(word, kind) => write!(f, "`{word}` {}", kind.denied()),
            WordFault::Next { expected, found } => {
                write!(f, "`{expected}` is next, not `{found}`")
            }
            WordFault::Instead { expected, found } => {
                write!(f, "`{expected}` expected, not `{found}`")
            }
            WordFault::InsteadInResult { expected, found } => {
                write!(f, "`{expected}` expected in the result, not `{found}`")
            }
        }
    }
}

impl Kind {
    /// How a sentence about a word says that it is none of these.
    fn denied(self) -> &'static str {
        match self {
            Kind::Operation => "is no operation",
            Kind::PolynomialOperation => "is no operation of a polynomial",
            Kind::OneOperation => "is not one operation",
            Kind::Fused => "is not one fused multiply-add",
            Kind::Computed => "is not computed yet",
            Kind::Operand => "is neither a value nor a literal",
            Kind::PolynomialOperand => "is neither the angle, a value nor a literal",
            Kind::Position => "is no position",
            Kind::Sign => "is no sign",
            Kind::Angle => "is no angle",
            Kind::Sine => "is no sine or cosine",
            Kind::Pair => "is no sine and cosine",
            Kind::Pairs => "are no sines and cosines",
            Kind::Sincos => "is not `sincos` of this scalar",
            Kind::GivenSine => "is no sine or cosine of the caller's",
            Kind::Entry => "is no entry of the result",
            Kind::PartHead => "is no head of a part",
            Kind::Lane => "is no lane",
        }
    }

    /// A word that is none of these.
    pub fn not(self, word: &str) -> WordFault {
        WordFault::Not(word.to_owned(), self)
    }
}

impl std::error::Error for WordFault {}
