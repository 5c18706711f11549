//! Equality saturation: the rules that the e-graph runs, phase by phase.

use crate::graph::rules::Rule;

/// Rules that run together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// Signs: they run in every phase.
    Sign,
    /// Fewer products.
    Factor,
    /// Other groupings of sums and products.
    Regroup,
}

/// Every rule of the e-graph, and when it runs.
pub(crate) const SATURATION: &[(Phase, Rule)] = &[
    // a + b = b + a
    (
        Phase::Sign,
        Rule::new(
            "add-commutes",
            "(+ ?a ?b)",
            "(+ ?b ?a)",
            "addition commutes",
        ),
    ),
    // a·b = b·a
    (
        Phase::Sign,
        Rule::new(
            "mul-commutes",
            "(* ?a ?b)",
            "(* ?b ?a)",
            "multiplication commutes",
        ),
    ),
    // a − b = −(b − a)
    (
        Phase::Sign,
        Rule::new(
            "sub-flips",
            "(- ?a ?b)",
            "(neg (- ?b ?a))",
            "the negative of b − a",
        ),
    ),
    // −(−a) = a
    (
        Phase::Sign,
        Rule::new(
            "neg-twice",
            "(neg (neg ?a))",
            "?a",
            "negation is an involution",
        ),
    ),
    // (−a) + b = b − a
    (
        Phase::Sign,
        Rule::new(
            "neg-in-sum",
            "(+ (neg ?a) ?b)",
            "(- ?b ?a)",
            "definition of −",
        ),
    ),
    // a − (−b) = a + b
    (
        Phase::Sign,
        Rule::new(
            "neg-in-difference",
            "(- ?a (neg ?b))",
            "(+ ?a ?b)",
            "definition of −",
        ),
    ),
    // (−a)·b = −(a·b)
    (
        Phase::Sign,
        Rule::new(
            "neg-in-product",
            "(* (neg ?a) ?b)",
            "(neg (* ?a ?b))",
            "signs leave products",
        ),
    ),
    // (−a)/b = −(a/b)
    (
        Phase::Sign,
        Rule::new(
            "neg-in-dividend",
            "(/ (neg ?a) ?b)",
            "(neg (/ ?a ?b))",
            "signs leave quotients; the divisor stays",
        ),
    ),
    // a/(−b) = −(a/b)
    (
        Phase::Sign,
        Rule::new(
            "neg-in-divisor",
            "(/ ?a (neg ?b))",
            "(neg (/ ?a ?b))",
            "signs leave quotients; the divisor stays but for its sign",
        ),
    ),
    // a/c + b/c = (a + b)/c
    (
        Phase::Factor,
        Rule::new(
            "add-quotients",
            "(+ (/ ?a ?c) (/ ?b ?c))",
            "(/ (+ ?a ?b) ?c)",
            "distributive law; the divisor stays",
        ),
    ),
    // a/c − b/c = (a − b)/c
    (
        Phase::Factor,
        Rule::new(
            "sub-quotients",
            "(- (/ ?a ?c) (/ ?b ?c))",
            "(/ (- ?a ?b) ?c)",
            "distributive law; the divisor stays",
        ),
    ),
    // (a·b)/c = a·(b/c)
    (
        Phase::Regroup,
        Rule::new(
            "div-associates",
            "(/ (* ?a ?b) ?c)",
            "(* ?a (/ ?b ?c))",
            "multiplication by 1/c associates; the divisor stays",
        ),
    ),
    // a·(b/c) = (a·b)/c
    (
        Phase::Regroup,
        Rule::new(
            "mul-quotient",
            "(* ?a (/ ?b ?c))",
            "(/ (* ?a ?b) ?c)",
            "multiplication by 1/c associates; the divisor stays",
        ),
    ),
    // a·b + a·c = a·(b + c)
    (
        Phase::Factor,
        Rule::new(
            "factor-sum",
            "(+ (* ?a ?b) (* ?a ?c))",
            "(* ?a (+ ?b ?c))",
            "distributive law",
        ),
    ),
    // a·b − a·c = a·(b − c)
    (
        Phase::Factor,
        Rule::new(
            "factor-difference",
            "(- (* ?a ?b) (* ?a ?c))",
            "(* ?a (- ?b ?c))",
            "distributive law",
        ),
    ),
    // a² − b² = (a + b)(a − b)
    (
        Phase::Factor,
        Rule::new(
            "squares",
            "(- (* ?a ?a) (* ?b ?b))",
            "(* (+ ?a ?b) (- ?a ?b))",
            "third binomial formula",
        ),
    ),
    // (a·b)·c = a·(b·c)
    (
        Phase::Regroup,
        Rule::new(
            "mul-associates",
            "(* (* ?a ?b) ?c)",
            "(* ?a (* ?b ?c))",
            "multiplication associates",
        ),
    ),
    // (a + b) + c = a + (b + c)
    (
        Phase::Regroup,
        Rule::new(
            "add-associates",
            "(+ (+ ?a ?b) ?c)",
            "(+ ?a (+ ?b ?c))",
            "addition associates",
        ),
    ),
    // (a − b) + c = (a + c) − b
    (
        Phase::Regroup,
        Rule::new(
            "sub-add",
            "(+ (- ?a ?b) ?c)",
            "(- (+ ?a ?c) ?b)",
            "addition associates",
        ),
    ),
    // (a − b) − c = a − (b + c)
    (
        Phase::Regroup,
        Rule::new(
            "sub-sub",
            "(- (- ?a ?b) ?c)",
            "(- ?a (+ ?b ?c))",
            "addition associates",
        ),
    ),
    // (a + b) − c = a + (b − c)
    (
        Phase::Regroup,
        Rule::new(
            "add-sub",
            "(- (+ ?a ?b) ?c)",
            "(+ ?a (- ?b ?c))",
            "addition associates",
        ),
    ),
    // a − (b − c) = (a + c) − b
    (
        Phase::Regroup,
        Rule::new(
            "sub-difference",
            "(- ?a (- ?b ?c))",
            "(- (+ ?a ?c) ?b)",
            "addition associates",
        ),
    ),
];
