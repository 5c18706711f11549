//! What the builder folds while a graph grows: the left side never becomes a
//! node of its own. [`prune::price`](crate::approximate::prune) applies the same
//! rules to an edited program without building it.
//!
//! The builder's code is the fast form of these tables; the tests hold it
//! against each of them.

use super::Rule;

/// Folding by the shape of an expression, in every builder.
pub(crate) const BY_SHAPE: &[Rule] = &[
    // k + m is a constant
    Rule::new(
        "add-constants",
        "(+ ?k ?m)",
        "(+ ?k ?m)",
        "exact arithmetic on constants",
    ),
    // k − m is a constant
    Rule::new(
        "sub-constants",
        "(- ?k ?m)",
        "(- ?k ?m)",
        "exact arithmetic on constants",
    ),
    // k·m is a constant
    Rule::new(
        "mul-constants",
        "(* ?k ?m)",
        "(* ?k ?m)",
        "exact arithmetic on constants",
    ),
    // a + 0 = a
    Rule::new("add-zero", "(+ ?a 0)", "?a", "0 is neutral in sums"),
    // 0 + a = a
    Rule::new("zero-add", "(+ 0 ?a)", "?a", "0 is neutral in sums"),
    // a − 0 = a
    Rule::new("sub-zero", "(- ?a 0)", "?a", "0 is neutral in sums"),
    // 0 − a = −a
    Rule::new("zero-sub", "(- 0 ?a)", "(neg ?a)", "definition of −"),
    // a − a = 0
    Rule::new(
        "sub-self",
        "(- ?a ?a)",
        "0",
        "a value and its negative cancel",
    ),
    // a + (−a) = 0
    Rule::new(
        "add-opposite",
        "(+ ?a (neg ?a))",
        "0",
        "a value and its negative cancel",
    ),
    // 0·a = 0
    Rule::new("mul-zero", "(* 0 ?a)", "0", "0 absorbs products"),
    // 1·a = a
    Rule::new("mul-one", "(* 1 ?a)", "?a", "1 is neutral in products"),
    // (−1)·a = −a
    Rule::new(
        "mul-minus-one",
        "(* (neg 1) ?a)",
        "(neg ?a)",
        "signs leave products",
    ),
    // a·k = k·a
    Rule::new(
        "mul-constant-commutes",
        "(* ?a ?k)",
        "(* ?k ?a)",
        "multiplication commutes",
    ),
    // (−k)·a = −(k·a)
    Rule::new(
        "neg-constant",
        "(* (neg ?k) ?a)",
        "(neg (* ?k ?a))",
        "signs leave products",
    ),
    // k·(m·a) = (k·m)·a
    Rule::new(
        "constants-meet",
        "(* ?k (* ?m ?a))",
        "(* (* ?k ?m) ?a)",
        "multiplication associates; one operation, and the inner product may die",
    ),
];

/// Folding by shape that saves no operation, and so is the builder's alone.
pub(crate) const NORMAL_FORM: &[Rule] = &[
    // 2·a = a + a
    Rule::new(
        "double",
        "(* 2 ?a)",
        "(+ ?a ?a)",
        "distributive law; an addition is never dearer, and exact",
    ),
    // a + b = b + a
    Rule::new(
        "add-commutes",
        "(+ ?b ?a)",
        "(+ ?a ?b)",
        "addition commutes",
    ),
    // a·b = b·a
    Rule::new(
        "mul-commutes",
        "(* ?b ?a)",
        "(* ?a ?b)",
        "multiplication commutes",
    ),
    // b − a = −(a − b)
    Rule::new(
        "sub-flips",
        "(- ?b ?a)",
        "(neg (- ?a ?b))",
        "the negative of a − b",
    ),
    // (−a) + b = −(a − b)
    Rule::new(
        "neg-add",
        "(+ (neg ?a) ?b)",
        "(neg (- ?a ?b))",
        "definition of −",
    ),
    // (−a) − b = −(a + b)
    Rule::new(
        "neg-sub",
        "(- (neg ?a) ?b)",
        "(neg (+ ?a ?b))",
        "definition of −",
    ),
    // a − (−b) = a + b
    Rule::new("sub-neg", "(- ?a (neg ?b))", "(+ ?a ?b)", "definition of −"),
    // (−a)·b = −(a·b)
    Rule::new(
        "neg-mul",
        "(* (neg ?a) ?b)",
        "(neg (* ?a ?b))",
        "signs leave products",
    ),
];

/// Folding by fingerprint, in a builder that merges equal values: examples of
/// what no shape shows. A value whose fingerprint is zero, a known value's, its
/// opposite's, or that of its own exact value at rest becomes that.
pub(crate) const BY_FINGERPRINT: &[Rule] = &[
    // a·b + a·c is a·(b + c), whichever was there before
    Rule::new(
        "known-value",
        "(+ (* ?a ?b) (* ?a ?c))",
        "(* ?a (+ ?b ?c))",
        "equal at every point: the same polynomial but for a chance below 1e-40",
    ),
    // b·a − c·a is −(a·(c − b))
    Rule::new(
        "opposite-value",
        "(- (* ?b ?a) (* ?c ?a))",
        "(neg (* ?a (- ?c ?b)))",
        "opposite at every point",
    ),
    // (a + b)² − a² − 2ab − b² = 0
    Rule::new(
        "zero-value",
        "(- (- (* (+ ?a ?b) (+ ?a ?b)) (* ?a ?a)) (* ?b (+ ?b (+ ?a ?a))))",
        "0",
        "zero at every point",
    ),
    // (a + k) − (a + m) = k − m
    Rule::new(
        "constant-value",
        "(- (+ ?a ?k) (+ ?a ?m))",
        "(- ?k ?m)",
        "equal at points that share only the constant angles; the value at rest is confirmed at all points",
    ),
];
