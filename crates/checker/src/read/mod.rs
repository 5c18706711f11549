//! The text of a function, in Rust, C or CUDA, read into straight-line code.
//!
//! The grammar is what the generator prints. Any other text is refused with its line, however
//! harmless. All that follows from a function's head (types, what else calls the function, loops
//! over states) is compared word by word with what it must be; the rest is one operation a
//! statement, so that nothing can be contracted.
//!
//! - this file: [`Text`], and what is known of a function before it is read
//! - `tokens`: words, numbers and signs
//! - `reader`: operands, operations, sines
//! - `rust`: functions in Rust, and those of any number of states
//! - `c`: functions in C and CUDA, and those of any number of states

mod c;
mod lanes;
mod reader;
mod rust;
mod tokens;

use self::reader::Reader;
use self::tokens::Token;
use crate::Fault;
use crate::program::Program;

pub use self::c::Symbols;
pub(crate) use self::reader::number;
pub(crate) use self::tokens::{has_only, is_letter, is_plain_sign, lines, whole};

/// An argument of a function.
#[derive(Clone, Copy, Debug)]
pub struct Argument<'h> {
    /// The place among all arguments, which operands have.
    pub place: usize,
    /// The name.
    pub name: &'h str,
    /// The number of entries.
    pub length: usize,
}

impl Argument<'_> {
    fn is_struct(&self) -> bool {
        ["load", "payload", "bodies"].contains(&self.name)
    }
}

/// The head of a function, and its results.
#[derive(Clone, Debug)]
pub struct Head<'h> {
    /// The name.
    pub name: &'h str,
    /// `true` if the scalar is f32.
    pub is_single: bool,
    /// The arguments, in order.
    pub arguments: Vec<Argument<'h>>,
    /// The results, in order: their names and the lengths of their axes.
    pub fields: Vec<(&'h str, Vec<usize>)>,
    /// The number of joints.
    pub joints: usize,
}

impl Head<'_> {
    fn scalar(&self) -> &'static str {
        if self.is_single { "f32" } else { "f64" }
    }

    pub(crate) fn structure(&self) -> Option<String> {
        (self.fields.len() > 1).then(|| rust::camel(self.name))
    }

    fn float(&self) -> &'static str {
        if self.is_single { "float" } else { "double" }
    }

    pub(crate) fn kind(&self, shape: &[usize]) -> String {
        let lengths = shape.iter().rev();
        let array = |kind: String, length: &usize| format!("[{kind}; {length}]");
        lengths.fold(self.scalar().to_owned(), array)
    }

    fn lengths(&self) -> impl Iterator<Item = (&str, usize)> {
        let fields = self.fields.iter();
        fields.map(|(name, shape)| (*name, shape.iter().product()))
    }
}

/// The library, or polynomial, that computes the sine and the cosine of an angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// libm, or the C library.
    Libm,
    /// `dalembert-sines`, or the header's own function that does the same.
    Together,
    /// Operations that stand in the function: on entry 0 of argument 0, the angle.
    Polynomial(Program<f64>),
}

/// The sine and cosine of a joint's angle.
#[derive(Clone, Debug, PartialEq)]
pub struct SinePair {
    /// The joint.
    pub joint: usize,
    /// `true` for the sine, and for the cosine, if it has a name.
    pub needs: [bool; 2],
    /// The source that computes them.
    pub source: Source,
}

/// A function as its text computes it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadFunction {
    /// Sines and cosines, in the order of the text.
    pub sines: Vec<SinePair>,
    /// The joints of which 1/√(q̇² + w²) is read, each with w².
    pub speeds: Vec<(usize, f64)>,
    /// Operations and results.
    pub program: Program<f64>,
    /// The loops over lanes: the operations before each, those of a lane, and the lanes.
    pub loops: Vec<[usize; 3]>,
}

/// A text as words.
#[derive(Debug)]
pub struct Text<'t> {
    tokens: Vec<Token<'t>>,
}

impl<'t> Text<'t> {
    /// Reads the words of a text in Rust.
    ///
    /// # Errors
    /// The first line with a character that is none of generated code.
    pub fn rust(source: &'t str) -> Result<Text<'t>, Fault> {
        tokens::read(source, false).map(|tokens| Text { tokens })
    }

    /// Reads the words of a text in C or CUDA.
    ///
    /// # Errors
    /// As [`Text::rust`].
    pub fn c(source: &'t str) -> Result<Text<'t>, Fault> {
        tokens::read(source, true).map(|tokens| Text { tokens })
    }

    /// Reads a function, and that of any number of states if it has one: in C or CUDA by its names
    /// and with its struct, in Rust without names. Returns as well whether nothing else stands in
    /// the text. A compiler compares the struct of results in Rust.
    ///
    /// # Errors
    /// The first thing that is not of such a function.
    pub fn function(
        &self,
        head: &Head<'_>,
        symbols: Option<&Symbols>,
        has_many: bool,
    ) -> Result<(ReadFunction, bool), Fault> {
        let mut reader = Reader::new(&self.tokens, head, symbols);
        match symbols {
            None => reader.rust(has_many)?,
            Some(symbols) => reader.c(symbols, has_many)?,
        }
        let is_whole = reader.first == 0 && reader.at == reader.tokens.len();
        Ok((reader.function, is_whole))
    }
}
