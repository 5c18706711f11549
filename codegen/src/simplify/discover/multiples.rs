//! Multiples and shifts: c·a and a + c with a constant that is in no formula.

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;
use rustc_hash::FxHashMap;

use crate::function::Argument;
use crate::program::Input;
use crate::simplify::classes::{ClassId, Classes, Leaf, Operator, Signed, Way};

/// Finds classes that are a constant multiple of one another, or differ by a
/// constant, and adds the ways that lead from one to the other.
pub(crate) fn multiples(classes: &mut Classes, pool: &[ClassId], choice: &[Option<Way>]) {
    // Points 0 and 1 share the constant angles, so a ratio (difference) that
    // is the same at both is a constant.
    let mut ratios: FxHashMap<Field, Vec<ClassId>> = FxHashMap::default();
    let mut shifts: FxHashMap<Field, Vec<ClassId>> = FxHashMap::default();
    for &id in pool {
        let print = *classes.print(id);
        let constant = matches!(classes.leaf(id), Some(Leaf::Constant(_)));
        if constant || print.is_constant() {
            continue;
        }
        if let Some(inverse) = print.0[1].inverse() {
            ratios.entry(print.0[0].mul(&inverse)).or_default().push(id);
        }
        let shift = print.0[0].sub(&print.0[1]);
        shifts.entry(shift.min(shift.neg())).or_default().push(id);
    }
    let mut values = Values::new(classes, choice);
    let mut found = Vec::new();
    for (a, x, b, y) in values.pairs(ratios) {
        if !num_traits::Zero::is_zero(&x) {
            found.push((b, Operator::Product, a, Exact::from(y / x)));
        }
    }
    for (a, x, b, y) in values.pairs(shifts) {
        // b = c ± a, whichever it is.
        found.push((b, Operator::Sum, a, Exact::from(&y - &x)));
        found.push((b, Operator::Sum, a, Exact::from(&y + &x)));
    }
    for (class, operator, a, constant) in found {
        if constant.is_zero() || constant.is_one() || constant.neg().is_one() {
            continue;
        }
        let Some(Signed { class: leaf, .. }) = classes.add_constant(&constant) else {
            continue;
        };
        classes.add_to(class, Way::new(operator, [a, leaf]));
        if operator == Operator::Sum {
            classes.add_to(class, Way::new(Operator::Difference, [a, leaf]));
        }
    }
}

/// Exact values of classes at one rational state, by the chosen program.
struct Values<'a> {
    classes: &'a Classes,
    choice: &'a [Option<Way>],
    known: FxHashMap<ClassId, Option<Rational>>,
}

impl<'a> Values<'a> {
    fn new(classes: &'a Classes, choice: &'a [Option<Way>]) -> Self {
        Values {
            classes,
            choice,
            known: FxHashMap::default(),
        }
    }

    /// Returns the ordered pairs within each group, with their values, in an order
    /// that does not depend on the map's.
    fn pairs(
        &mut self,
        groups: FxHashMap<Field, Vec<ClassId>>,
    ) -> Vec<(ClassId, Rational, ClassId, Rational)> {
        let mut groups: Vec<Vec<ClassId>> = groups.into_values().filter(|g| g.len() > 1).collect();
        groups.sort_unstable();
        let mut pairs = Vec::new();
        for group in groups {
            for &a in &group {
                for &b in group.iter().filter(|&&b| b != a) {
                    if let (Some(x), Some(y)) = (self.of(a), self.of(b)) {
                        pairs.push((a, x, b, y));
                    }
                }
            }
        }
        pairs
    }

    /// Returns the value that the class's canonical print stands for; `None` where a
    /// constant is not rational or no way is chosen.
    fn of(&mut self, id: ClassId) -> Option<Rational> {
        let mut pending = vec![id];
        while let Some(&top) = pending.last() {
            if self.known.contains_key(&top) {
                pending.pop();
                continue;
            }
            let value = match self.classes.leaf(top) {
                Some(Leaf::Constant(constant)) => constant.as_rational().cloned(),
                Some(Leaf::Input(input)) => Some(sample(*input)),
                None => match self.choice.get(usize::from(top)).copied().flatten() {
                    None => None,
                    Some(way) => {
                        let [a, b] = way.operands;
                        let (Some(x), Some(y)) = (self.known.get(&a), self.known.get(&b)) else {
                            for operand in [a, b] {
                                if !self.known.contains_key(&operand) {
                                    pending.push(operand);
                                }
                            }
                            continue;
                        };
                        let print = self.classes.way_print(way);
                        let negative = print != *self.classes.print(top);
                        match (x, y) {
                            (Some(x), Some(y)) => operate(way.operator, x, y)
                                .map(|value| if negative { -value } else { value }),
                            _ => None,
                        }
                    }
                },
            };
            self.known.insert(top, value);
            pending.pop();
        }
        self.known.get(&id).cloned().flatten()
    }
}

/// Returns the value of a way; none of a quotient by zero.
fn operate(operator: Operator, x: &Rational, y: &Rational) -> Option<Rational> {
    Some(match operator {
        Operator::Sum => x + y,
        Operator::Difference => x - y,
        Operator::Product => x * y,
        Operator::Quotient if num_traits::Zero::is_zero(y) => return None,
        Operator::Quotient => x / y,
    })
}

/// Returns a fixed rational state in general position. Sums of angles are composed
/// from their joints, so that identities between them hold.
fn sample(input: Input) -> Rational {
    let ratio = |n: i64, d: i64| Rational::new(n.into(), d.into());
    let pair = |angle: crate::program::AngleSum| {
        let (mut sin, mut cos) = (ratio(0, 1), ratio(1, 1));
        for (joint, negative) in angle.terms() {
            // t/(t + 3) as the half angle's tangent: small, distinct per joint.
            let t = ratio(2 * joint as i64 + 3, 2 * joint as i64 + 6);
            let denominator = ratio(1, 1) + &t * &t;
            let c = (ratio(1, 1) - &t * &t) / &denominator;
            let mut s = ratio(2, 1) * &t / &denominator;
            if negative {
                s = -s;
            }
            (sin, cos) = (&sin * &c + &cos * &s, &cos * &c - &sin * &s);
        }
        (sin, cos)
    };
    match input {
        Input::Sin(angle) => pair(angle).0,
        Input::Cos(angle) => pair(angle).1,
        Input::PerSpeed(joint) => ratio(joint as i64 + 2, 41),
        Input::Entry(argument, joint) => {
            const DENOMINATORS: [i64; Argument::COUNT] =
                [7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47];
            let place = argument.index();
            ratio((joint + place) as i64 + 2, DENOMINATORS[place])
        }
    }
}
