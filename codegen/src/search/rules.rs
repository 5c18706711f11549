//! Algebraic identities, a row each: a pattern, and (?b inner ?c) outer ?a as another way to it.
//!
//! Patterns are over values up to sign: ± is a sum or a difference, and fingerprints tell which
//! signs the right side has. Distribution is no row: it would double the e-graph for every product
//! of sums, and formulations bring the expanded forms along.

use std::sync::LazyLock;

use egg::{Language, Pattern, PatternAst, Var};

use super::egraph::{Classes, ENode, Kind, PRODUCT, SUM};

/// Name, left side, and the outer and the inner operation of the right side, each up to signs.
pub(super) const RULES: &[(&str, &str, Kind, Kind)] = &[
    ("factor", "(± (* ?a ?b) (* ?a ?c))", PRODUCT, SUM),
    ("mul-associates", "(* (* ?a ?b) ?c)", PRODUCT, PRODUCT),
    ("add-associates", "(± (± ?a ?b) ?c)", SUM, SUM),
];

pub(super) fn signed(left: &str) -> Vec<String> {
    let mut texts = vec![left.to_owned()];
    for _ in left.matches('±') {
        let signed = |text: &String| ["+", "-"].map(|sign| text.replacen('±', sign, 1));
        texts = texts.iter().flat_map(signed).collect();
    }
    texts
}

/// The rules' patterns in all orders of operands, each with the outer and the inner operation.
static PATTERNS: LazyLock<Vec<(Pattern<ENode>, [Kind; 2])>> = LazyLock::new(|| {
    let mut patterns = Vec::new();
    for &(name, left, outer, inner) in RULES {
        for text in signed(left) {
            let pattern = text.parse::<PatternAst<ENode>>();
            let mut orders = vec![pattern.unwrap_or_else(|why| unreachable!("{name}: {why}"))];
            for place in (0..orders[0].len()).map(egg::Id::from) {
                if !orders[0][place].is_leaf() {
                    let mut swapped = orders.clone();
                    for order in &mut swapped {
                        order[place].children_mut().reverse();
                    }
                    orders.append(&mut swapped);
                }
            }
            let orders = orders.into_iter();
            patterns.extend(orders.map(|left| (Pattern::new(left), [outer, inner])));
        }
    }
    patterns
});

/// The e-nodes, for each one that was there, at which rules stop.
const GROWTH: usize = 20;

pub(super) fn saturate(classes: &mut Classes, iterations: usize) {
    let variables = ["?a", "?b", "?c"].map(|name| {
        let variable = name.parse::<Var>();
        variable.unwrap_or_else(|why| unreachable!("{name}: {why}"))
    });
    let most = GROWTH * classes.bound();
    for _ in 0..iterations {
        let size = classes.bound();
        let matches = classes.matches(PATTERNS.iter().map(|(left, _)| left));
        for (rule_matches, (_, kinds)) in matches.into_iter().zip(PATTERNS.iter()) {
            for class_match in &rule_matches {
                for substitution in &class_match.substs {
                    if classes.bound() < most {
                        let ends = variables.map(|variable| substitution[variable]);
                        classes.nest(class_match.eclass, *kinds, ends);
                    }
                }
            }
        }
        if classes.bound() == size {
            break;
        }
    }
}
