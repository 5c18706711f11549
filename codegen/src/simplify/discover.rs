//! New ways to compute the values of a program, found by fingerprint.
//!
//! - pairs: a ± b and a·b over a pool of classes that happen to be a class
//! - multiples and shifts: c·a and a + c with a constant that is in no formula
//! - resubstitution: (a ∘ b) ∘ c for a live class, a ∘ b being new
//!
//! A hit at every point of the field is an identity but for a chance below
//! 1e-40; the final program is proved at other points all the same.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use super::classes::{ClassId, Classes, ENode, Leaf};
use super::sieve::Sieve;
use crate::function::Argument;
use crate::graph::Fingerprint;
use crate::program::Input;

/// Tries every pair of the pool; returns how many new ways there are.
pub fn pairs(classes: &mut Classes, pool: &[ClassId]) -> usize {
    let mut known = Sieve::new(classes.len());
    for id in 0..classes.len() as ClassId {
        known.note(key(&classes.get(id).print));
    }
    let mut found = Vec::new();
    for_pairs(classes, pool, |first, way| {
        if known.passes(first) {
            found.push(way);
        }
    });
    let mut count = 0;
    for way in found {
        if let Some(hit) = classes.find(&classes.way_print(way)) {
            count += usize::from(classes.add_way(hit.class, way));
        }
    }
    count
}

/// Calls with the key of every sum, difference and product in the pool.
fn for_pairs(classes: &Classes, pool: &[ClassId], mut call: impl FnMut(Field, ENode)) {
    let first: Vec<Field> = pool.iter().map(|&id| classes.get(id).print.0[0]).collect();
    for (index, (&a, x)) in pool.iter().zip(&first).enumerate() {
        for (&b, y) in pool[index..].iter().zip(&first[index..]) {
            call(up_to_sign(x.add(y)), ENode::Sum(a, b));
            call(up_to_sign(x.sub(y)), ENode::Difference(a, b));
            call(up_to_sign(x.mul(y)), ENode::Product(a, b));
        }
    }
}

/// Calls with the key of every y − c, y + c and y / c, the target y, c, and whether
/// c is a factor of y.
fn for_inner(
    classes: &Classes,
    targets: &[ClassId],
    pool: &[ClassId],
    mut call: impl FnMut(Field, ClassId, ClassId, bool),
) {
    let first = |id: ClassId| classes.get(id).print.0[0];
    let others: Vec<(ClassId, Field, Option<Field>)> = pool
        .iter()
        .map(|&c| (c, first(c), first(c).inverse()))
        .collect();
    for &y in targets {
        let target = first(y);
        for (c, other, inverse) in others.iter().filter(|(c, ..)| *c != y) {
            call(up_to_sign(target.sub(other)), y, *c, false);
            call(up_to_sign(target.add(other)), y, *c, false);
            if let Some(inverse) = inverse {
                call(up_to_sign(target.mul(inverse)), y, *c, true);
            }
        }
    }
}

/// By the first point of a print up to sign: what agrees there is compared at
/// all points afterwards.
type Table<T> = HashMap<Field, T, BuildHasherDefault<AsItIs>>;

fn key(print: &Fingerprint) -> Field {
    up_to_sign(print.0[0])
}

fn up_to_sign(x: Field) -> Field {
    x.min(x.neg())
}

/// Field values are as good as random: no hash need mix them again but for the
/// table's use of the highest bits.
#[derive(Clone, Copy, Debug, Default)]
struct AsItIs(u64);

impl Hasher for AsItIs {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }
    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(8) ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
}

/// Finds classes that are a constant multiple of one another, or differ by a
/// constant, and adds the ways that lead from one to the other.
pub fn multiples(classes: &mut Classes, pool: &[ClassId], choice: &[Option<ENode>]) -> usize {
    // Points 0 and 1 share the constant angles, so a ratio (difference) that
    // is the same at both is a constant.
    let mut ratios: HashMap<Field, Vec<ClassId>> = HashMap::new();
    let mut shifts: HashMap<Field, Vec<ClassId>> = HashMap::new();
    for &id in pool {
        let print = classes.get(id).print;
        let constant = matches!(classes.get(id).leaf, Some(Leaf::Constant(_)));
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
            found.push((b, ENode::Product(a, a), Exact::from(y / x)));
        }
    }
    for (a, x, b, y) in values.pairs(shifts) {
        // b = c ± a, whichever it is.
        found.push((b, ENode::Sum(a, a), Exact::from(&y - &x)));
        found.push((b, ENode::Difference(a, a), Exact::from(&y + &x)));
    }
    let mut count = 0;
    for (class, kind, constant) in found {
        if constant.is_zero() || constant.is_one() || constant.neg().is_one() {
            continue;
        }
        let Some(leaf) = intern_constant(classes, &constant) else {
            continue;
        };
        let [a, _] = kind.operands();
        let candidates = match kind {
            ENode::Product(..) => vec![ENode::Product(a, leaf)],
            _ => vec![ENode::Sum(a, leaf), ENode::Difference(a, leaf)],
        };
        for way in candidates {
            let print = classes.way_print(way);
            if classes.find(&print).is_some_and(|hit| hit.class == class) {
                count += usize::from(classes.add_way(class, way));
            }
        }
    }
    count
}

/// Tries (a ∘ b) ∘ c for every class of `targets` over the pool.
pub fn resubstitute(classes: &mut Classes, targets: &[ClassId], pool: &[ClassId]) -> usize {
    // The keys that a ∘ b would have to have: of millions of pairs some thousands have
    // one of them, and only those are kept.
    let mut wanted = Sieve::new(3 * targets.len() * pool.len());
    for_inner(classes, targets, pool, |key, _, _, _| wanted.note(key));
    // a ∘ b → the first such pair.
    let mut table: Table<ENode> = Table::default();
    for_pairs(classes, pool, |first, way| {
        if wanted.passes(first) {
            table.entry(first).or_insert(way);
        }
    });
    let mut found: Vec<(ClassId, ENode, ClassId, bool)> = Vec::new();
    for_inner(classes, targets, pool, |key, y, c, product| {
        if let Some(&way) = table.get(&key)
            && !way.operands().contains(&y)
        {
            found.push((y, way, c, product));
        }
    });
    let mut count = 0;
    for (y, inner, c, product) in found {
        let print = classes.way_print(inner);
        if print == Fingerprint::zero() {
            continue;
        }
        let middle = classes.intern(&print).class;
        classes.add_way(middle, inner);
        let ways = if product {
            vec![ENode::Product(middle, c)]
        } else {
            vec![ENode::Sum(middle, c), ENode::Difference(middle, c)]
        };
        for way in ways {
            let print = classes.way_print(way);
            if classes.find(&print).is_some_and(|hit| hit.class == y) {
                count += usize::from(classes.add_way(y, way));
            }
        }
    }
    count
}

/// The leaf class of a constant.
fn intern_constant(classes: &mut Classes, constant: &Exact) -> Option<ClassId> {
    let print = crate::graph::Points::SEARCH.constant(constant)?;
    let signed = classes.intern(&print);
    let leaf = if signed.negative {
        constant.neg()
    } else {
        constant.clone()
    };
    classes.set_leaf(signed.class, Leaf::Constant(leaf));
    Some(signed.class)
}

/// Exact values of classes at one rational state, by the chosen program.
struct Values<'a> {
    classes: &'a Classes,
    choice: &'a [Option<ENode>],
    known: HashMap<ClassId, Option<Rational>>,
}

impl<'a> Values<'a> {
    fn new(classes: &'a Classes, choice: &'a [Option<ENode>]) -> Self {
        Values {
            classes,
            choice,
            known: HashMap::new(),
        }
    }

    /// The ordered pairs within each group, with their values, in an order
    /// that does not depend on the map's.
    fn pairs(
        &mut self,
        groups: HashMap<Field, Vec<ClassId>>,
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

    /// The value that the class's canonical print stands for; `None` where a
    /// constant is not rational or no way is chosen.
    fn of(&mut self, id: ClassId) -> Option<Rational> {
        let mut pending = vec![id];
        while let Some(&top) = pending.last() {
            if self.known.contains_key(&top) {
                pending.pop();
                continue;
            }
            let class = self.classes.get(top);
            let value = match &class.leaf {
                Some(Leaf::Constant(constant)) => constant.as_rational().cloned(),
                Some(Leaf::Input(input)) => Some(sample(*input)),
                None => match self.choice.get(top as usize).copied().flatten() {
                    None => None,
                    Some(way) => {
                        let [a, b] = way.operands();
                        let (Some(x), Some(y)) = (self.known.get(&a), self.known.get(&b)) else {
                            for operand in [a, b] {
                                if !self.known.contains_key(&operand) {
                                    pending.push(operand);
                                }
                            }
                            continue;
                        };
                        let print = self.classes.way_print(way);
                        match (x, y) {
                            (Some(x), Some(y)) => operate(way, x, y)
                                .map(|value| if print == class.print { value } else { -value }),
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

/// The value of a way; none of a quotient by zero.
fn operate(way: ENode, x: &Rational, y: &Rational) -> Option<Rational> {
    Some(match way {
        ENode::Sum(..) => x + y,
        ENode::Difference(..) => x - y,
        ENode::Product(..) => x * y,
        ENode::Quotient(..) if num_traits::Zero::is_zero(y) => return None,
        ENode::Quotient(..) => x / y,
    })
}

/// A fixed rational state in general position. Sums of angles are composed
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
            const DENOMINATORS: [i64; Argument::COUNT] = [7, 11, 13, 17, 19, 23, 29, 31, 37];
            let place = argument.index();
            ratio((joint + place) as i64 + 2, DENOMINATORS[place])
        }
    }
}
