//! Couplings that nearly vanish: weak ones, and those that one number, or several small ones, keep alive.

use dalembert_codegen::workspace::SEED;
use dalembert_model::reference::Reference;
use dalembert_model::scalar::Scalar;
use nalgebra::{DMatrix, DVector};

use super::conditions::{Condition, conditions};
use super::{Entry, Finder, entries};
use crate::arm::SymbolicArm;
use crate::number::Number;
use crate::quantity::Quantity;
use crate::ring::{Polynomial, Symbols};
use crate::symbol::Symbol;

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

/// The values of x², x and 1 in a polynomial of degree two.
type Quadratic = [Number; 3];

impl Definitions {
    /// True if a base parameter is zero although its summands are not: but for the moments of inertia of
    /// one link, which may be equal.
    pub(super) fn is_balance(&self, parameter: usize, value: &Number) -> bool {
        let terms = self.parameters[parameter].terms();
        let is_of_inertia = |symbols: Symbols| {
            let definition = symbols
                .parameter_index()
                .map(|index| &self.arm.parameters[index]);
            let is_inertia = definition.is_some_and(|entry| entry.symbol.text.starts_with('I'));
            is_inertia && symbols.lengths().next().is_none()
        };
        let row = |symbols: Symbols| {
            let index = symbols.parameter_index()?;
            self.arm.parameters[index].row
        };
        let mut rows: Vec<_> = terms
            .iter()
            .map(|(monomial, _)| row(monomial.symbols))
            .collect();
        rows.dedup();
        let are_equal_moments = rows.len() == 1
            && terms
                .iter()
                .all(|(monomial, _)| is_of_inertia(monomial.symbols));
        value.is_zero() && !terms.is_empty() && !are_equal_moments
    }

    fn value(&self, symbols: Symbols) -> Number {
        let values: Vec<Number> = self
            .arm
            .parameters
            .iter()
            .map(|parameter| parameter.value)
            .collect();
        self.arm.value_of(symbols, &values)
    }

    /// Lists the centres of mass and the moments of inertia that are not zero, each with the size of its
    /// link.
    fn candidates(&self) -> Vec<Candidate> {
        let of_row = |definition: &Option<usize>, row: usize| *definition == Some(row);
        let is_centre = |symbol: &Symbol| symbol.text.contains('\u{304}');
        let is_inertia =
            |symbol: &Symbol| symbol.text.starts_with('I') && !symbol.text.ends_with('a');
        let mut candidates = Vec::new();
        for row in 0..self.arm.arm.links.len() {
            let lengths = self
                .arm
                .lengths
                .iter()
                .filter(|length| of_row(&length.row, row));
            let longest = lengths
                .map(|length| length.value.magnitude())
                .fold(1e-9, f64::max);
            for (index, length) in self.arm.lengths.iter().enumerate() {
                if of_row(&length.row, row) && is_centre(&length.symbol) {
                    candidates.extend(Symbols::length(index).map(|place| Candidate {
                        symbol: length.symbol.clone(),
                        place,
                        value: length.value,
                        size: longest,
                    }));
                }
            }
            let inertias = || {
                let parameters = self.arm.parameters.iter().enumerate();
                parameters
                    .filter(|(_, moment)| of_row(&moment.row, row) && is_inertia(&moment.symbol))
            };
            let largest = inertias()
                .map(|(_, moment)| moment.value.magnitude())
                .fold(1e-9, f64::max);
            for (index, moment) in inertias() {
                candidates.extend(Symbols::parameter(index).map(|place| Candidate {
                    symbol: moment.symbol.clone(),
                    place,
                    value: moment.value,
                    size: largest,
                }));
            }
        }
        candidates
    }

    /// Returns a base parameter as a polynomial in one number, the others as they are.
    fn in_one(&self, parameter: usize, place: Symbols) -> Quadratic {
        let mut powers = [Number::zero(); 3];
        for (monomial, x) in self.parameters[parameter].terms() {
            let (power, rest) = monomial.symbols.without(place);
            let value = self.value(rest).mul(x);
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
                sum.add(&self.value(monomial.symbols).mul(x))
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
        let in_numbers = entries(&self.in_numbers);
        let living: Vec<(Entry, Vec<Condition>)> = entries(&self.in_parameters)
            .into_iter()
            .zip(&in_numbers)
            .filter(|(_, (_, number))| !number.is_zero())
            .map(|((entry, polynomial), _)| (entry, polynomial))
            // D_ii is never zero, and would be listed under every number.
            .filter(|(entry, _)| !matches!(*entry.indices, [i, k] if i == k))
            .filter(|(_, polynomial)| is_without_constant(polynomial))
            .map(|(entry, polynomial)| (entry, conditions(polynomial)))
            .collect();
        let candidates = definitions.candidates();
        for candidate in &candidates {
            near.alive.extend(alive(definitions, candidate, &living));
        }
        near.alive.sort_by(|a, b| a.part.total_cmp(&b.part));
        let mut small: Vec<&Candidate> = candidates
            .iter()
            .filter(|candidate| candidate.value.magnitude() < SMALL * candidate.size)
            .collect();
        let gone = vanishing(definitions, &small, &living);
        for candidate in small.clone() {
            let fewer: Vec<&Candidate> = small
                .iter()
                .copied()
                .filter(|other| other.place != candidate.place)
                .collect();
            if vanishing(definitions, &fewer, &living) == gone {
                small = fewer;
            }
        }
        // One number alone is listed above.
        if small.len() > 1 {
            let symbols = small
                .iter()
                .map(|candidate| candidate.symbol.clone())
                .collect();
            near.small = Some((symbols, gone));
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
        let strength = |entry: &Entry| match *entry.indices {
            [i, k] if i != k => Some(largest[(i, k)] / (largest[(i, i)] * largest[(k, k)]).sqrt()),
            _ => None,
        };
        let mut weak: Vec<(Entry, f64)> = entries(&self.in_numbers)
            .into_iter()
            .filter(|(entry, x)| entry.quantity == Quantity::Inertia && !x.is_zero())
            .filter_map(|(entry, _)| strength(&entry).map(|part| (entry, part)))
            .filter(|(_, part)| *part < WEAK)
            .collect();
        weak.sort_by(|a, b| a.1.total_cmp(&b.1));
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
        let terms = condition
            .iter()
            .map(|(parameter, x)| values[*parameter].mul(x));
        terms.fold(Number::zero(), |sum, x| sum.add(&x)).is_zero()
    };
    let gone = living
        .iter()
        .filter(|(_, conditions)| conditions.iter().all(holds));
    gone.map(|(entry, _)| entry.clone()).collect()
}

/// Finds the value of a number at which couplings vanish, the nearest to its value.
fn alive(
    definitions: &Definitions,
    candidate: &Candidate,
    living: &[(Entry, Vec<Condition>)],
) -> Vec<Alive> {
    let parameters = 0..definitions.parameters.len();
    let powers: Vec<Quadratic> = parameters
        .map(|parameter| definitions.in_one(parameter, candidate.place))
        .collect();
    let mut roots: Vec<(Number, Alive)> = Vec::new();
    for (entry, conditions) in living {
        let Some(root) = common_root(conditions, &powers, &candidate.value) else {
            continue;
        };
        let change = candidate.value.sub(&root).magnitude();
        let part = change / candidate.size;
        if part >= FAR {
            continue;
        }
        match roots
            .iter_mut()
            .find(|(other, _)| other.residue() == root.residue())
        {
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
    let sums: Vec<Quadratic> = conditions
        .iter()
        .map(|condition| {
            condition
                .iter()
                .fold([Number::zero(); 3], |sum, (parameter, x)| {
                    [0, 1, 2].map(|power| sum[power].add(&powers[*parameter][power].mul(x)))
                })
        })
        .collect();
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
