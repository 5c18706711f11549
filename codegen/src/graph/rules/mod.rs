//! Algebraic rules as data: a name, the equation, why it is sound.
//!
//! - this file: what a rule is
//! - [`folding`]: the rules that the builder applies as a graph grows
//! - `pattern`: the patterns' reader and evaluator, for the tests of all rules
//!
//! The rules of the search are in [`simplify::rules`](crate::simplify::rules);
//! its README says what may be added.

#[cfg_attr(
    not(test),
    expect(
        dead_code,
        reason = "its code is the builder's, and the tests hold it against the table"
    )
)]
pub(crate) mod folding;
#[cfg(test)]
pub(crate) mod pattern;

/// An equation, written as two patterns.
///
/// A pattern is an s-expression over `+`, `-`, `*` and `neg`. `?a`, `?b`, … stand
/// for any value, `?k` and `?m` for constants, numbers for themselves. Negation
/// is free: it never counts as an operation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule {
    /// Its name.
    pub name: &'static str,
    /// What it matches.
    pub from: &'static str,
    /// What takes its place, or is added to it.
    pub to: &'static str,
    /// Why both are equal.
    #[cfg_attr(
        not(test),
        expect(
            dead_code,
            reason = "for readers, and for the test that there is a reason"
        )
    )]
    pub sound: &'static str,
}

impl Rule {
    /// Returns a rule of a table.
    pub(crate) const fn new(
        name: &'static str,
        from: &'static str,
        to: &'static str,
        sound: &'static str,
    ) -> Rule {
        Rule {
            name,
            from,
            to,
            sound,
        }
    }
}
