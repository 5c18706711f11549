//! Algebraic identities, a row each, that add e-nodes to the e-graph.
//!
//! Patterns are over values up to sign: `±` is a sum or a difference. Which signs a right
//! side has where a left side matched is told by fingerprint when it is applied, so one
//! row serves for all of them; and each row is tried with the operands of its sums and
//! products in either order.
//!
//! Distribution, a·(b ± c) → a·b ± a·c, is no row: every product of sums would double the
//! e-graph, and formulations bring the expanded forms along. Quotients have none either: the
//! few that formulas have are as cheap where they stand.

use std::sync::LazyLock;

use egg::{ENodeOrVar, Id, Language, Pattern, PatternAst, Subst, Var};

use super::classes::{ClassId, Classes, ENode, Operator, Way};
use crate::graph::Fingerprint;

/// Name, left side, right side.
pub(crate) const RULES: &[(&str, &str, &str)] = &[
    ("factor", "(± (* ?a ?b) (* ?a ?c))", "(* ?a (± ?b ?c))"),
    (
        "squares",
        "(± (* ?a ?a) (* ?b ?b))",
        "(* (± ?a ?b) (± ?a ?b))",
    ),
    ("mul-associates", "(* (* ?a ?b) ?c)", "(* ?a (* ?b ?c))"),
    ("add-associates", "(± (± ?a ?b) ?c)", "(± ?a (± ?b ?c))"),
];

/// The rows, read once.
static READ: LazyLock<Vec<Rule>> = LazyLock::new(|| RULES.iter().flat_map(Rule::read).collect());

/// Limits of the rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RuleLimits {
    /// The number of e-nodes, for each one that was there, at which they stop.
    pub growth: usize,
    /// The number of times that each is applied to all that is there.
    pub iterations: usize,
}

impl RuleLimits {
    /// Those of a round of the search.
    pub(super) const ROUND: RuleLimits = RuleLimits {
        growth: 20,
        iterations: 1,
    };

    /// None are applied.
    pub(super) const NONE: RuleLimits = RuleLimits {
        growth: 0,
        iterations: 0,
    };
}

/// Applies all rules to all that is there.
pub(crate) fn saturate(classes: &mut Classes, limits: RuleLimits) {
    let before = classes.size();
    for _ in 0..limits.iterations {
        let found = classes.matches(READ.iter().map(|rule| &rule.left));
        let size = classes.size();
        for (rule, found) in READ.iter().zip(found) {
            for found in found {
                for substitution in &found.substs {
                    if classes.size() < limits.growth * before {
                        rule.apply(classes, found.eclass, substitution);
                    }
                }
            }
        }
        if classes.size() == size {
            break;
        }
    }
}

/// A row, read, with its left operands in one order.
struct Rule {
    left: Pattern<ENode>,
    right: PatternAst<ENode>,
}

impl Rule {
    fn read((name, left, right): &(&str, &str, &str)) -> Vec<Rule> {
        let read = |text: &str| -> PatternAst<ENode> {
            let pattern = text.parse();
            pattern.unwrap_or_else(|why| unreachable!("rule {name}: {why}"))
        };
        let (left, right) = (read(left), read(right));
        let mut orders: Vec<PatternAst<ENode>> = vec![left.clone()];
        let operations = left.iter().enumerate();
        for (place, _) in operations.filter(|(_, node)| operator(node).is_some()) {
            let mut swapped = orders.clone();
            for order in &mut swapped {
                order[Id::from(place)].children_mut().reverse();
            }
            orders.extend(swapped);
        }
        let rules = orders.into_iter().map(|left| Rule {
            left: Pattern::new(left),
            right: right.clone(),
        });
        rules.collect()
    }

    /// Adds the right side with those signs that give the class.
    fn apply(&self, classes: &mut Classes, class: ClassId, substitution: &Subst) {
        let sums = |node: &&ENodeOrVar<ENode>| operator(node) == Some(Operator::Sum);
        for signs in 0..1_u32 << self.right.iter().filter(sums).count() {
            let prints = self.right_side(signs, |step| match step {
                Step::Known(variable) => Some(*classes.print(substitution[variable])),
                Step::New(operator, [a, b]) => {
                    let print = operator.print([&a, &b]).canonical().0;
                    (print != Fingerprint::zero()).then_some(print)
                }
            });
            if prints.is_some_and(|print| print == *classes.print(class)) {
                self.right_side(signs, |step| match step {
                    Step::Known(variable) => Some(substitution[variable]),
                    Step::New(operator, operands) => {
                        Some(classes.add(Way::new(operator, operands))?.class)
                    }
                });
            }
        }
    }

    /// Evaluates the right side, a bit of `signs` for each of its ±.
    fn right_side<T: Copy>(
        &self,
        mut signs: u32,
        mut evaluate: impl FnMut(Step<T>) -> Option<T>,
    ) -> Option<T> {
        let mut values: Vec<T> = Vec::with_capacity(self.right.len());
        for node in self.right.iter() {
            let step = match node {
                ENodeOrVar::Var(variable) => Step::Known(*variable),
                ENodeOrVar::ENode(node) => {
                    let mut operator = node.operator()?;
                    if operator == Operator::Sum {
                        if signs & 1 == 1 {
                            operator = Operator::Difference;
                        }
                        signs >>= 1;
                    }
                    let operand = |place: usize| values[usize::from(node.children()[place])];
                    Step::New(operator, [operand(0), operand(1)])
                }
            };
            values.push(evaluate(step)?);
        }
        values.last().copied()
    }
}

/// A step of a right side: a value that was matched, or an operation.
enum Step<T> {
    Known(Var),
    New(Operator, [T; 2]),
}

fn operator(node: &ENodeOrVar<ENode>) -> Option<Operator> {
    match node {
        ENodeOrVar::ENode(node) => node.operator(),
        ENodeOrVar::Var(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::graph::pattern::{Algebra, Pattern as Text};
    use crate::random::Random;
    use dalembert_model::scalar::Scalar;
    use dalembert_model::scalar::field::Field;

    /// Residues, `±` by the next sign.
    struct InField {
        signs: u32,
    }

    impl Algebra for InField {
        type Value = Field;
        fn number(&mut self, number: u64) -> Field {
            Field::new(number)
        }
        fn neg(&mut self, a: &Field) -> Field {
            a.neg()
        }
        fn operate(&mut self, symbol: &str, a: &Field, b: &Field) -> Field {
            match symbol {
                "±" => {
                    let minus = self.signs & 1 == 1;
                    self.signs >>= 1;
                    if minus { a.sub(b) } else { a.add(b) }
                }
                _ => a.mul(b),
            }
        }
    }

    /// A value for each choice of signs, up to sign.
    fn values(text: &str, variables: &HashMap<char, Field>) -> Vec<Field> {
        let signs = text.matches('±').count();
        let value = |signs| Text::parse(text).evaluate(&mut InField { signs }, variables);
        let up_to_sign = |x: Field| x.min(x.neg());
        (0..1 << signs)
            .map(|signs| up_to_sign(value(signs)))
            .collect()
    }

    /// With some signs at least; of squares it is the difference alone.
    #[test]
    fn right_sides_are_values_of_left_sides() {
        let mut random = Random::new(9);
        for (name, left, right) in RULES {
            let variables = HashMap::from(['a', 'b', 'c'].map(|v| (v, Field::new(random.bits()))));
            let (left, right) = (values(left, &variables), values(right, &variables));
            let told = left.iter().filter(|value| right.contains(value)).count();
            let least = if *name == "squares" { 1 } else { left.len() };
            assert!(told >= least, "{name}");
        }
    }

    #[test]
    fn names_are_unique() {
        for (place, (name, ..)) in RULES.iter().enumerate() {
            assert!(
                RULES[..place].iter().all(|(other, ..)| other != name),
                "{name}"
            );
        }
    }

    /// Programs whose output a rule shows how to compute by one operation at the top.
    #[test]
    fn every_rule_adds_its_right_side() {
        let programs = [
            ("(- (* ?b ?a) (* ?a ?c))", Operator::Product),
            ("(- (* ?a ?a) (* ?b ?b))", Operator::Product),
            ("(* (* ?c ?a) ?b)", Operator::Product),
            ("(- ?c (- ?a ?b))", Operator::Sum),
        ];
        for ((text, operator), row) in programs.into_iter().zip(RULES) {
            let mut classes = Classes::default();
            classes.begin(&crate::graph::pattern::graph(&[text]));
            let output = classes.outputs[0].unwrap().class;
            for rule in Rule::read(row) {
                for found in classes.matches([&rule.left].into_iter()).remove(0) {
                    for substitution in &found.substs {
                        rule.apply(&mut classes, found.eclass, substitution);
                    }
                }
            }
            let ways: Vec<Way> = classes.ways_of(output).collect();
            assert!(ways.len() >= 2, "{text}: {ways:?}");
            assert!(
                ways.iter().any(|way| way.operator == operator),
                "{text}: {ways:?}"
            );
            assert!(ways.iter().all(|&way| {
                let hit = classes.find(&classes.way_print(way));
                hit.is_some_and(|hit| hit.class == output)
            }));
        }
    }
}
