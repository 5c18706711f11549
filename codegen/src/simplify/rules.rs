//! The e-graph's rewrite rules, as data.
//!
//! Laws for adding one: an identity of commutative rings, nothing about
//! particular values (those the fingerprints find); never general
//! distribution (it explodes: see the phases' budgets); associativity only in
//! the phase that is bounded for it. Negation is free, so signs are moved out
//! of products and into sums.

/// Rules that run together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Signs.
    Sign,
    /// Fewer products.
    Factor,
    /// Other groupings of sums and products.
    Regroup,
}

/// A rewrite rule.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Its name.
    pub name: &'static str,
    /// When it runs.
    pub phase: Phase,
    /// What it matches.
    pub from: &'static str,
    /// What it adds.
    pub to: &'static str,
    /// Why both are equal.
    pub sound: &'static str,
}

const fn rule(
    name: &'static str,
    phase: Phase,
    from: &'static str,
    to: &'static str,
    sound: &'static str,
) -> Rule {
    Rule {
        name,
        phase,
        from,
        to,
        sound,
    }
}

/// Every rule.
pub const RULES: &[Rule] = &[
    // a + b = b + a
    rule(
        "add-commutes",
        Phase::Sign,
        "(+ ?a ?b)",
        "(+ ?b ?a)",
        "addition commutes",
    ),
    // a·b = b·a
    rule(
        "mul-commutes",
        Phase::Sign,
        "(* ?a ?b)",
        "(* ?b ?a)",
        "multiplication commutes",
    ),
    // a − b = −(b − a)
    rule(
        "sub-flips",
        Phase::Sign,
        "(- ?a ?b)",
        "(neg (- ?b ?a))",
        "the negative of b − a",
    ),
    // −(−a) = a
    rule(
        "neg-twice",
        Phase::Sign,
        "(neg (neg ?a))",
        "?a",
        "negation is an involution",
    ),
    // (−a) + b = b − a
    rule(
        "neg-in-sum",
        Phase::Sign,
        "(+ (neg ?a) ?b)",
        "(- ?b ?a)",
        "definition of −",
    ),
    // a − (−b) = a + b
    rule(
        "neg-in-difference",
        Phase::Sign,
        "(- ?a (neg ?b))",
        "(+ ?a ?b)",
        "definition of −",
    ),
    // (−a)·b = −(a·b)
    rule(
        "neg-in-product",
        Phase::Sign,
        "(* (neg ?a) ?b)",
        "(neg (* ?a ?b))",
        "signs leave products",
    ),
    // a·b + a·c = a·(b + c)
    rule(
        "factor-sum",
        Phase::Factor,
        "(+ (* ?a ?b) (* ?a ?c))",
        "(* ?a (+ ?b ?c))",
        "distributive law",
    ),
    // a·b − a·c = a·(b − c)
    rule(
        "factor-difference",
        Phase::Factor,
        "(- (* ?a ?b) (* ?a ?c))",
        "(* ?a (- ?b ?c))",
        "distributive law",
    ),
    // a² − b² = (a + b)(a − b)
    rule(
        "squares",
        Phase::Factor,
        "(- (* ?a ?a) (* ?b ?b))",
        "(* (+ ?a ?b) (- ?a ?b))",
        "third binomial formula",
    ),
    // (a·b)·c = a·(b·c)
    rule(
        "mul-associates",
        Phase::Regroup,
        "(* (* ?a ?b) ?c)",
        "(* ?a (* ?b ?c))",
        "multiplication associates",
    ),
    // (a + b) + c = a + (b + c)
    rule(
        "add-associates",
        Phase::Regroup,
        "(+ (+ ?a ?b) ?c)",
        "(+ ?a (+ ?b ?c))",
        "addition associates",
    ),
    // (a − b) + c = (a + c) − b
    rule(
        "sub-add",
        Phase::Regroup,
        "(+ (- ?a ?b) ?c)",
        "(- (+ ?a ?c) ?b)",
        "addition associates",
    ),
    // (a − b) − c = a − (b + c)
    rule(
        "sub-sub",
        Phase::Regroup,
        "(- (- ?a ?b) ?c)",
        "(- ?a (+ ?b ?c))",
        "addition associates",
    ),
    // (a + b) − c = a + (b − c)
    rule(
        "add-sub",
        Phase::Regroup,
        "(- (+ ?a ?b) ?c)",
        "(+ ?a (- ?b ?c))",
        "addition associates",
    ),
    // a − (b − c) = (a + c) − b
    rule(
        "sub-difference",
        Phase::Regroup,
        "(- ?a (- ?b ?c))",
        "(- (+ ?a ?c) ?b)",
        "addition associates",
    ),
];
