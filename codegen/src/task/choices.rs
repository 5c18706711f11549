//! Choices that have two words.

use crate::words::words;

words! {
    /// The preference among programs. It decides about one whose estimated rounding error is
    /// more than 4 times that of the textbook form.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Prefer: "preference" {
        /// Take the cheapest that is not that much worse.
        #[default]
        Accuracy = "accuracy",
        /// Take the cheapest.
        Operations = "operations",
    }
}

words! {
    /// Fusing a product with the sum that alone reads it, or not.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Fma: "choice" {
        /// Every operation is rounded.
        #[default]
        Off = "off",
        /// A product and its sum are one operation, `mul_add`, and rounded once. It
        /// needs `std`, and a processor that has it.
        On = "on",
    }
}
