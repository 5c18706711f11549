//! The lines of formulas: the names of an entry, and its sum.

use crate::expression::Sum;
use crate::symbol::Symbol;

/// A formula.
#[derive(Clone, Debug)]
pub struct Line {
    /// The name of the entry.
    pub name: Symbol,
    /// Later entries that are equal, or opposite: then the flag is set.
    pub others: Vec<(bool, Symbol)>,
    /// The right side.
    pub sum: Sum,
}

/// Lines with a heading.
#[derive(Clone, Debug)]
pub struct Section {
    /// The heading.
    pub title: String,
    /// The entries that are not zero.
    pub lines: Vec<Line>,
    /// The entries that are zero.
    pub zeros: Vec<Symbol>,
    /// The nested list that SymPy text makes of them.
    pub list: Option<List>,
}

/// A nested list of entries, as SymPy text defines it.
#[derive(Clone, Debug)]
pub struct List {
    /// The identifier.
    pub name: String,
    /// The entries in the order of their indices.
    pub entries: Vec<Symbol>,
    /// The number of entries at each depth.
    pub lengths: Vec<usize>,
}
