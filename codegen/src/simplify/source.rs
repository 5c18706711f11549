//! Where the ways of the e-graph come from, by name: each can be left out, to see what it earns.

use crate::words::words;

words! {
    /// A source of ways to compute the values of a program.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum WaySource: "source" {
        /// Other formulations than the cheapest, and sums of angles.
        Formulations = "formulations",
        /// Parameters moved between links.
        Regrouping = "regrouping",
        /// Identities of algebra.
        Rules = "rules",
        /// Pairs of values that happen to give another.
        Pairs = "pairs",
        /// Constant multiples and shifts.
        Multiples = "multiples",
        /// Pairs of values that give another with a third.
        Resubstitution = "resubstitution",
    }
}
