//! Discovery by fingerprint: ways to compute a known value that no formula
//! shows. The left side is the value that is known already, the right side the
//! way that is found where the two agree at every point of the field.
//!
//! Unlike the e-graph's rules these are not true for all values: they are
//! tried over the values of one robot's function, and each hit is an identity
//! of that function but for a chance below 1e-40. The final program is proved
//! at other points all the same.

use crate::graph::rules::Rule;

/// Every kind of way that discovery tries, by what it is made of. `?y` stands
/// for a value of the program that the equation in `sound` gives.
pub(crate) const DISCOVERY: &[Rule] = &[
    // y = a + b
    Rule::new(
        "pair-sum",
        "?y",
        "(+ ?a ?b)",
        "y and a + b agree at every point",
    ),
    // y = a − b
    Rule::new(
        "pair-difference",
        "?y",
        "(- ?a ?b)",
        "y and a − b agree at every point",
    ),
    // y = a·b
    Rule::new(
        "pair-product",
        "?y",
        "(* ?a ?b)",
        "y and a·b agree at every point",
    ),
    // y = k·a
    Rule::new(
        "multiple",
        "?y",
        "(* ?k ?a)",
        "the ratio y/a does not depend on the state",
    ),
    // y = a + k
    Rule::new(
        "shift",
        "?y",
        "(+ ?a ?k)",
        "the difference y − a does not depend on the state",
    ),
    // y = k − a
    Rule::new(
        "mirror",
        "?y",
        "(- ?k ?a)",
        "the sum y + a does not depend on the state",
    ),
    // y = (a ∘ b) + c
    Rule::new(
        "substitute-sum",
        "?y",
        "(+ (* ?a ?b) ?c)",
        "y − c and a ∘ b agree at every point",
    ),
    // y = (a ∘ b) − c
    Rule::new(
        "substitute-difference",
        "?y",
        "(- (* ?a ?b) ?c)",
        "y + c and a ∘ b agree at every point",
    ),
    // y = (a ∘ b)·c
    Rule::new(
        "substitute-product",
        "?y",
        "(* (+ ?a ?b) ?c)",
        "y/c and a ∘ b agree at every point",
    ),
];
