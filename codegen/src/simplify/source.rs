//! The sources that the search chooses from, by name: each can be left out, to see what it earns.

use crate::words::words;

words! {
    /// A source of the search: of ways to compute values, or of choices among them.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum WaySource: "source" {
        /// Other formulations than the cheapest, and sums of angles.
        Formulations = "formulations",
        /// Chain forms beside the one whose regrouping was chosen.
        Forms = "forms",
        /// Choices of axes beside the chosen one.
        Axes = "axes",
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
        /// Changes that cost operations first.
        Annealing = "annealing",
    }
}
