//! Couplings that nearly vanish: weak ones, and those that one number, or several small ones, keep alive.

use dalembert_codegen::workspace::SEED;
use dalembert_model::reference::Reference;
use dalembert_model::scalar::Scalar;
use nalgebra::{DMatrix, DVector};

use super::conditions::{Condition, conditions};
use super::{Entry, Finder, entries};
use crate::arm::SymbolicArm;
use crate::number::Number;
use crate::ring::{Monomial, Polynomial, Symbols};
use crate::symbol::{Definition, Symbol};

/// Couplings below this part of what they could be are weak.
const WEAK: f64 = 0.02;
/// Numbers below this part of their link's size are small.
const SMALL: f64 = 0.01;
/// A change of a number by more than this part of its link's size is not a small one.
const FAR: f64 = 0.3;
const STATES: usize = 100;

/// The coefficients of a robot that nearly vanish.
#[derive(Clone, Debug, Default)]
pub struct Near {
    /// D_ik with the largest |D_ik| over √(max D_ii · max D_kk), below 2 %, the weakest first.
    pub weak: Vec<(Entry, f64)>,
    /// Numbers each of which alone keeps couplings alive.
    pub alive: Vec<Alive>,
    /// Numbers below 1 % of their link's size, as few of them as together keep couplings alive, and these.
    pub small: Option<(Vec<Symbol>, Vec<Entry>)>,
}

/// A number of the robot file that keeps couplings alive.
#[derive(Clone, Debug)]
pub struct Alive {
    /// Its name: I6zz.
    pub symbol: Symbol,
    /// Its value.
    pub value: f64,
    /// The value at which the couplings vanish.
    pub vanishing: f64,
    /// The change as a part of the link's size.
    pub part: f64,
    /// The couplings.
    pub entries: Vec<Entry>,
}

/// The robot file's numbers as symbols, and base parameters as polynomials in them.
pub(super) struct Definitions {
    pub(super) arm: SymbolicArm,
    pub(super) parameters: Vec<Polynomial>,
}

/// A number of a link that may change.
struct Candidate {
    symbol: Symbol,
    place: Symbols,
    value: Number,
    size: f64,
}

/// Numbers of one kind.
struct Table<'a> {
    numbers: &'a [Definition<Number>],
    /// The place of a number among the symbols.
    place: fn(usize) -> Option<Symbols>,
    /// True if a number tells the size of its link.
    has_size: fn(&Symbol) -> bool,
    may_change: fn(&Symbol) -> bool,
}

/// The values of x², x and 1 in a polynomial of degree two.
type Quadratic = [Number; 3];

impl Definitions {
    /// True if a base parameter is zero although its summands are not: but for the moments of inertia of
    /// one link, which may be equal.
    pub(super) fn is_balance(&self, parameter: usize, value: &Number) -> bool {
        let terms = self.parameters[parameter].terms();
        let definition = |(monomial, _): &(Monomial, Number)| {
            let index = monomial.symbols.parameter_index()?;
            Some(&self.arm.symbols.parameters[index])
        };
        let is_moment = |term: &(Monomial, Number)| {
            let is_inertia =
                definition(term).is_some_and(|entry| entry.symbol.text.starts_with('I'));
            is_inertia && term.0.symbols.lengths().next().is_none()
        };
        let row = |term| definition(term).and_then(|definition| definition.row);
        let mut rows: Vec<_> = terms.iter().map(row).collect();
        rows.dedup();
        let are_equal_moments = rows.len() == 1 && terms.iter().all(is_moment);
        value.is_zero() && !terms.is_empty() && !are_equal_moments
    }

    /// Lists the centres of mass and the moments of inertia that are not zero, each with the size of its
    /// link.
    fn candidates(&self) -> Vec<Candidate> {
        let is_centre = |symbol: &Symbol| symbol.text.contains('\u{304}');
        let is_inertia =
            |symbol: &Symbol| symbol.text.starts_with('I') && !symbol.text.ends_with('a');
        let tables = [
            Table {
                numbers: &self.arm.symbols.lengths,
                place: Symbols::length,
                has_size: |_| true,
                may_change: is_centre,
            },
            Table {
                numbers: &self.arm.symbols.parameters,
                place: Symbols::parameter,
                has_size: is_inertia,
                may_change: is_inertia,
            },
        ];
        let mut candidates = Vec::new();
        for row in 0..self.arm.arm.links.len() {
            for table in &tables {
                let mut of_row: Vec<_> = table.numbers.iter().enumerate().collect();
                of_row.retain(|(_, n)| n.row == Some(row) && (table.has_size)(&n.symbol));
                let sizes = of_row.iter().map(|(_, number)| number.value.magnitude());
                let size = sizes.fold(1e-9, f64::max);
                of_row.retain(|(_, number)| (table.may_change)(&number.symbol));
                for (index, Definition { symbol, value, .. }) in of_row {
                    let Some(place) = (table.place)(index) else {
                        continue;
                    };
                    candidates.push(Candidate {
                        symbol: symbol.clone(),
                        place,
                        value: *value,
                        size,
                    });
                }
            }
        }
        candidates
    }

    /// Returns a base parameter as a polynomial in one number, the others as they are.
    fn in_one(&self, parameter: usize, place: Symbols) -> Quadratic {
        let mut powers = [Number::zero(); 3];
        for (monomial, x) in self.parameters[parameter].terms() {
            let (power, rest) = monomial.symbols.without(place);
            let value = self.arm.value(rest).mul(x);
            powers[power] = powers[power].add(&value);
        }
        powers
    }

    /// Returns the base parameters where some numbers are zero.
    fn without(&self, removed: &[Symbols]) -> Vec<Number> {
        let value = |parameter: &Polynomial| {
            let terms = parameter.terms().iter().filter(|(monomial, _)| {
                removed
                    .iter()
                    .all(|place| monomial.symbols.without(*place).0 == 0)
            });
            terms.fold(Number::zero(), |sum, (monomial, x)| {
                sum.add(&self.arm.value(monomial.symbols).mul(x))
            })
        };
        self.parameters.iter().map(value).collect()
    }
}

impl Finder<'_> {
    /// Finds the couplings that nearly vanish.
    pub(super) fn near(&self) -> Near {
        let mut near = Near {
            weak: self.weak(),
            ..Near::default()
        };
        let Some(definitions) = &self.definitions else {
            return near;
        };
        let in_numbers = entries(&self.in_numbers).into_iter();
        let mut living: Vec<(Entry, Vec<Condition>)> = Vec::new();
        for ((entry, polynomial), (_, x)) in
            entries(&self.in_parameters).into_iter().zip(in_numbers)
        {
            // D_ii is never zero, and would be listed under every number.
            let is_diagonal = matches!(*entry.indices, [i, k] if i == k);
            if !x.is_zero() && !is_diagonal && is_without_constant(polynomial) {
                living.push((entry, conditions(polynomial)));
            }
        }
        let candidates = definitions.candidates();
        for candidate in &candidates {
            near.alive.extend(alive(definitions, candidate, &living));
        }
        near.alive.sort_by(|a, b| a.part.total_cmp(&b.part));
        let mut small: Vec<&Candidate> = candidates.iter().collect();
        small.retain(|candidate| candidate.value.magnitude() < SMALL * candidate.size);
        let gone = vanishing(definitions, &small, &living);
        for candidate in small.clone() {
            let mut fewer = small.clone();
            fewer.retain(|other| other.place != candidate.place);
            if vanishing(definitions, &fewer, &living) == gone {
                small = fewer;
            }
        }
        // One number alone is listed above.
        if small.len() > 1 {
            let symbols = small.iter().map(|candidate| candidate.symbol.clone());
            near.small = Some((symbols.collect(), gone));
        }
        near
    }

    fn weak(&self) -> Vec<(Entry, f64)> {
        let robot = self.setup.robot();
        let runtime = Reference::<f64>::from_robot(robot);
        let n = robot.joints.len();
        let mut largest = DMatrix::<f64>::zeros(n, n);
        for state in self.setup.states(STATES, SEED) {
            let q = DVector::from_vec(state.q);
            if let Ok(inertia) = runtime.inertia(&q) {
                largest = largest.zip_map(&inertia, |most: f64, x: f64| most.max(x.abs()));
            }
        }
        let mut weak = Vec::new();
        for (entry, x) in entries(&self.in_numbers) {
            let [i, k] = *entry.indices else { continue };
            let part = largest[(i, k)] / (largest[(i, i)] * largest[(k, k)]).sqrt();
            if i != k && !x.is_zero() && part < WEAK {
                weak.push((entry, part));
            }
        }
        weak.sort_by(|a: &(Entry, f64), b| a.1.total_cmp(&b.1));
        weak
    }
}

/// True if an entry is a combination of base parameters, without an armature beside them.
fn is_without_constant(polynomial: &Polynomial) -> bool {
    let mut terms = polynomial.terms().iter();
    terms.all(|(monomial, _)| monomial.symbols.parameter_index().is_some())
}

/// Lists the couplings that vanish if numbers are zero.
fn vanishing(
    definitions: &Definitions,
    numbers: &[&Candidate],
    living: &[(Entry, Vec<Condition>)],
) -> Vec<Entry> {
    let removed: Vec<Symbols> = numbers.iter().map(|candidate| candidate.place).collect();
    let values = definitions.without(&removed);
    let holds = |condition: &Condition| {
        let terms = condition.iter();
        let products = terms.map(|(parameter, x)| values[*parameter].mul(x));
        products
            .fold(Number::zero(), |sum, x| sum.add(&x))
            .is_zero()
    };
    let is_gone = |(_, conditions): &&(Entry, Vec<Condition>)| conditions.iter().all(holds);
    let gone = living.iter().filter(is_gone);
    gone.map(|(entry, _)| entry.clone()).collect()
}

/// Finds the value of a number at which couplings vanish, the nearest to its value.
fn alive(
    definitions: &Definitions,
    candidate: &Candidate,
    living: &[(Entry, Vec<Condition>)],
) -> Vec<Alive> {
    let in_one = |parameter| definitions.in_one(parameter, candidate.place);
    let powers: Vec<Quadratic> = (0..definitions.parameters.len()).map(in_one).collect();
    let mut roots: Vec<(Number, Alive)> = Vec::new();
    for (entry, conditions) in living {
        let Some(root) = common_root(conditions, &powers, &candidate.value) else {
            continue;
        };
        let part = candidate.value.sub(&root).magnitude() / candidate.size;
        if part >= FAR {
            continue;
        }
        let mut known = roots.iter_mut();
        match known.find(|(other, _)| other.residue() == root.residue()) {
            Some((_, alive)) => alive.entries.push(entry.clone()),
            None => roots.push((
                root,
                Alive {
                    symbol: candidate.symbol.clone(),
                    value: candidate.value.to_f64(),
                    vanishing: root.to_f64(),
                    part,
                    entries: vec![entry.clone()],
                },
            )),
        }
    }
    roots.into_iter().map(|(_, alive)| alive).collect()
}

/// Returns the value at which all conditions hold: zero, or the root of one that is linear.
fn common_root(conditions: &[Condition], powers: &[Quadratic], now: &Number) -> Option<Number> {
    let sum = |condition: &Condition| {
        let terms = condition.iter();
        terms.fold([Number::zero(); 3], |sum, (parameter, x)| {
            [0, 1, 2].map(|power| sum[power].add(&powers[*parameter][power].mul(x)))
        })
    };
    let sums: Vec<Quadratic> = conditions.iter().map(sum).collect();
    let at = |[c, b, a]: &Quadratic, x: &Number| c.add(&x.mul(&b.add(&a.mul(x))));
    let linear = sums
        .iter()
        .find(|[_, b, a]| a.is_zero() && !b.is_zero())
        .and_then(|[c, b, _]| c.neg().over(b));
    let roots = [Some(Number::zero()), linear].into_iter().flatten();
    let common = roots.filter(|x| sums.iter().all(|sum| at(sum, x).is_zero()));
    let change = |x: &Number| now.sub(x).magnitude();
    common.min_by(|x, y| change(x).total_cmp(&change(y)))
}
