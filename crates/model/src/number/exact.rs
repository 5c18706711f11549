//! Constants, exact to the end: polynomials over ℚ in the sines and cosines of constant angles.
//!
//! Every angle that is not a multiple of π/4 contributes two generators, its sine and its cosine,
//! with the one relation s² = 1 − c². An eighth of a turn contributes one, √½ = sin π/4 = cos π/4,
//! whose square is ½. Relations between different angles (sin π/3 and cos π/6 are the same generator,
//! but 2·cos² π/6 − 1 = sin π/6 is not known) are lost, never wrongly assumed: two equal constants
//! may look different, two different ones never look equal. [`Modulo::of_angle`] has the relations
//! in the fields of searches and proofs.
//!
//! [`Modulo::of_angle`]: crate::scalar::field::Modulo::of_angle

use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::hash::{Hash, Hasher};

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::rationals::{compare, product, sum};
use super::trig::circle;
use super::{Angle, Rational, ratio};
use crate::scalar::count::Count;
use crate::scalar::{Scalar, SinCosPair};

/// An exact constant.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Exact(pub(super) Canonical);

/// Canonical: `Polynomial` only where a generator occurs, no zero coefficient.
#[derive(Clone, Debug, Eq)]
pub(super) enum Canonical {
    Rational(Arc<Rational>),
    Polynomial(Arc<Terms>),
}

pub(super) type Terms = BTreeMap<Monomial, Rational>;

impl Ord for Canonical {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Canonical::Rational(a), Canonical::Rational(b)) => compare(a, b),
            (Canonical::Polynomial(a), Canonical::Polynomial(b)) if Arc::ptr_eq(a, b) => {
                Ordering::Equal
            }
            (Canonical::Polynomial(a), Canonical::Polynomial(b)) => {
                let terms = a.iter().zip(b.iter());
                let mut orders = terms.map(|((a, x), (b, y))| a.cmp(b).then_with(|| compare(x, y)));
                let first = orders.find(|order| order.is_ne());
                first.unwrap_or_else(|| a.len().cmp(&b.len()))
            }
            (Canonical::Rational(_), Canonical::Polynomial(_)) => Ordering::Less,
            (Canonical::Polynomial(_), Canonical::Rational(_)) => Ordering::Greater,
        }
    }
}

impl PartialOrd for Canonical {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Parts that are reduced: a rational's comparison and hash, which divide, do not count on that.
fn parts(value: &Rational) -> (&BigInt, &BigInt) {
    (value.numer(), value.denom())
}

impl PartialEq for Canonical {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Canonical::Rational(a), Canonical::Rational(b)) => parts(a) == parts(b),
            (Canonical::Polynomial(a), Canonical::Polynomial(b)) => {
                let same = |((a, x), (b, y)): ((_, &Rational), (_, &Rational))| {
                    parts(x) == parts(y) && <Monomial as PartialEq>::eq(a, b)
                };
                Arc::ptr_eq(a, b) || a.len() == b.len() && a.iter().zip(b.iter()).all(same)
            }
            _ => false,
        }
    }
}

impl Hash for Canonical {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Canonical::Rational(value) => parts(value).hash(state),
            Canonical::Polynomial(terms) => {
                for (monomial, coefficient) in terms.iter() {
                    (monomial.len(), parts(coefficient)).hash(state);
                    for power in monomial {
                        (power.sin, power.cos).hash(state);
                    }
                }
            }
        }
    }
}

/// A product of powers of generators, sorted by angle.
pub(super) type Monomial = Vec<Power>;

/// sin(angle)^sin · cos(angle)^cos with sin ∈ {0, 1}.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Power {
    pub(super) angle: Arc<Angle>,
    pub(super) sin: u32,
    pub(super) cos: u32,
}

impl Ord for Power {
    fn cmp(&self, other: &Self) -> Ordering {
        let powers = (self.sin, self.cos).cmp(&(other.sin, other.cos));
        match Arc::ptr_eq(&self.angle, &other.angle) {
            true => powers,
            false => self.angle.cmp(&other.angle).then(powers),
        }
    }
}

impl PartialOrd for Power {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Exact {
    /// Returns the kind of number that it is known to be where operations are counted.
    pub fn counted<'a>(&self) -> Count<'a> {
        match () {
            () if self.is_zero() => Count::Zero,
            () if self.is_one() => Count::One,
            () if self.neg().is_one() => Count::MinusOne,
            () => Count::Number,
        }
    }

    /// Returns the pair of a constant angle; multiples of π/2 give 0 and ±1.
    pub fn sincos(angle: &Angle) -> SinCosPair<Exact> {
        let (turns, [sin, cos]) = reduce(angle);
        let (sin, cos) = match turns {
            0 => (sin, cos),
            1 => (cos, sin.neg()),
            2 => (sin.neg(), cos.neg()),
            _ => (cos.neg(), sin),
        };
        SinCosPair { sin, cos }
    }

    /// Returns the rational value, if no angle occurs.
    pub fn as_rational(&self) -> Option<&Rational> {
        match &self.0 {
            Canonical::Rational(value) => Some(value),
            Canonical::Polynomial(_) => None,
        }
    }

    /// True if the leading coefficient is negative, not necessarily the value: canonical forms pull
    /// that sign out.
    pub fn leads_negative(&self) -> bool {
        match &self.0 {
            Canonical::Rational(value) => value.is_negative(),
            Canonical::Polynomial(terms) => {
                terms.values().next_back().is_some_and(Signed::is_negative)
            }
        }
    }

    /// Returns the constant divided by a rational; `None` if that is zero.
    pub fn divide(&self, divisor: &Rational) -> Option<Exact> {
        (!divisor.is_zero()).then(|| self.scale(&divisor.recip()))
    }

    /// Returns the number of monomials: 1 for a rational.
    pub fn terms(&self) -> usize {
        match &self.0 {
            Canonical::Rational(_) => 1,
            Canonical::Polynomial(terms) => terms.len(),
        }
    }

    /// Returns the value in another ring, from the images of rationals, if any, and constant angles.
    pub fn map<S: Scalar>(
        &self,
        rational: &mut impl FnMut(&Rational) -> Option<S>,
        pair: &mut impl FnMut(&Angle) -> SinCosPair<S>,
    ) -> Option<S> {
        let terms = match &self.0 {
            Canonical::Rational(value) => return rational(value),
            Canonical::Polynomial(terms) => terms,
        };
        let mut sum = S::zero();
        let mut pairs = BTreeMap::new();
        for (monomial, coefficient) in terms.iter() {
            let mut product = rational(coefficient)?;
            for Power { angle, sin, cos } in monomial {
                let rotor = pairs.entry(angle).or_insert_with(|| pair(angle));
                for _ in 0..*sin {
                    product = product.mul(&rotor.sin);
                }
                for _ in 0..*cos {
                    product = product.mul(&rotor.cos);
                }
            }
            sum = sum.add(&product);
        }
        Some(sum)
    }

    fn scale(&self, factor: &Rational) -> Exact {
        match factor.is_zero() {
            true => Exact::zero(),
            false => self.each(|coefficient| product(coefficient, factor)),
        }
    }

    /// `change` must not give zero for a coefficient of a polynomial.
    fn each(&self, change: impl Fn(&Rational) -> Rational) -> Exact {
        match &self.0 {
            Canonical::Rational(value) => Exact::from(change(value)),
            Canonical::Polynomial(terms) => Exact(Canonical::Polynomial(Arc::new(
                terms.iter().map(|(m, c)| (m.clone(), change(c))).collect(),
            ))),
        }
    }

    fn to_terms(&self) -> Terms {
        match &self.0 {
            Canonical::Rational(value) if value.is_zero() => Terms::new(),
            Canonical::Rational(value) => Terms::from([(Monomial::new(), value.as_ref().clone())]),
            Canonical::Polynomial(terms) => terms.as_ref().clone(),
        }
    }

    pub(super) fn from_terms(mut terms: Terms) -> Exact {
        terms.retain(|_, coefficient| !coefficient.is_zero());
        match (terms.len(), terms.get(&Monomial::new())) {
            (0, _) => Exact::zero(),
            (1, Some(value)) => Exact::from(value.clone()),
            _ => Exact(Canonical::Polynomial(Arc::new(terms))),
        }
    }
}

impl From<Rational> for Exact {
    fn from(value: Rational) -> Self {
        Exact(Canonical::Rational(Arc::new(value)))
    }
}

impl Scalar for Exact {
    fn zero() -> Self {
        Exact::from(Rational::zero())
    }
    fn one() -> Self {
        Exact::from(Rational::one())
    }
    fn add(&self, other: &Self) -> Self {
        if let (Canonical::Rational(a), Canonical::Rational(b)) = (&self.0, &other.0) {
            return Exact::from(sum(a, b));
        }
        let mut terms = self.to_terms();
        for (monomial, coefficient) in other.to_terms() {
            let place = terms.entry(monomial).or_insert_with(Rational::zero);
            *place = sum(place, &coefficient);
        }
        Exact::from_terms(terms)
    }
    fn mul(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Canonical::Rational(a), _) => other.scale(a),
            (_, Canonical::Rational(b)) => self.scale(b),
            (Canonical::Polynomial(a), Canonical::Polynomial(b)) => {
                let mut terms = Terms::new();
                for (m, c) in a.iter() {
                    for (n, d) in b.iter() {
                        multiply_into(&mut terms, m, n, &product(c, d));
                    }
                }
                Exact::from_terms(terms)
            }
        }
    }
    fn neg(&self) -> Self {
        self.each(|coefficient| -coefficient)
    }
    fn half(&self) -> Self {
        self.scale(&ratio(1, 2))
    }
    fn is_zero(&self) -> bool {
        self.as_rational().is_some_and(Zero::is_zero)
    }
    fn is_one(&self) -> bool {
        self.as_rational().is_some_and(One::is_one)
    }
}

fn generator(angle: &Arc<Angle>, sin: u32, cos: u32) -> Exact {
    let angle = angle.clone();
    let monomial = Vec::from([Power { angle, sin, cos }]);
    let terms = Terms::from([(monomial, Rational::one())]);
    Exact(Canonical::Polynomial(Arc::new(terms)))
}

/// Adds c · m · n to the terms, each s² replaced by 1 − c², and by ½ for an eighth of a turn.
fn multiply_into(terms: &mut Terms, m: &Monomial, n: &Monomial, c: &Rational) {
    let mut product = m.clone();
    for power in n {
        match product.binary_search_by(|factor| factor.angle.cmp(&power.angle)) {
            Ok(at) => {
                product[at].sin += power.sin;
                product[at].cos += power.cos;
            }
            Err(at) => product.insert(at, power.clone()),
        }
    }
    let mut factor = c.clone();
    product.retain_mut(|power| {
        if power.cos >= 2 && power.angle.is_eighth() {
            power.cos -= 2;
            factor *= ratio(1, 2);
        }
        power.sin + power.cos > 0
    });
    let mut pending = Vec::from([(product, factor)]);
    while let Some((mut monomial, coefficient)) = pending.pop() {
        match monomial.iter().position(|power| power.sin == 2) {
            None => *terms.entry(monomial).or_insert_with(Rational::zero) += coefficient,
            Some(at) => {
                monomial[at].sin = 0;
                let mut squared = monomial.clone();
                squared[at].cos += 2;
                if monomial[at].cos == 0 {
                    monomial.remove(at);
                }
                pending.push((squared, -coefficient.clone()));
                pending.push((monomial, coefficient));
            }
        }
    }
}

/// Splits angle = turns·π/2 + remainder, 0 to 3 turns. Multiples of π are reduced to (0, π/4], so
/// that π/3 and π/6 share their generators; radians, which are no multiple, only lose their sign.
fn reduce(angle: &Angle) -> (u8, [Exact; 2]) {
    let generators = |angle: Angle| {
        let angle = Arc::new(angle);
        let cos = generator(&angle, 0, 1);
        match angle.is_eighth() {
            true => [cos.clone(), cos],
            false => [generator(&angle, 1, 0), cos],
        }
    };
    match angle {
        Angle::PiTimes(multiple) => {
            let halves = multiple * Rational::from_integer(2.into());
            let whole = halves.floor();
            let rest = &halves - &whole;
            let turns = num_integer::Integer::mod_floor(&whole.to_integer(), &4.into());
            let turns = u8::try_from(turns).unwrap_or(0);
            if rest.is_zero() {
                return (turns, [Exact::zero(), Exact::one()]);
            }
            let half = ratio(1, 2);
            if rest > half {
                let [sin, cos] = generators(Angle::PiTimes((Rational::one() - rest) * half));
                return (turns, [cos, sin]);
            }
            (turns, generators(Angle::PiTimes(rest * half)))
        }
        Angle::Radians(value) if value.is_zero() => (0, [Exact::zero(), Exact::one()]),
        Angle::Radians(value) if value.is_negative() => {
            let [sin, cos] = generators(Angle::Radians(-value));
            (0, [sin.neg(), cos])
        }
        Angle::Radians(_) => (0, generators(angle.clone())),
        Angle::TwiceAtan(tangent) => (0, circle(tangent).map(Exact::from)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pi_times(n: i64, d: i64) -> Angle {
        Angle::PiTimes(ratio(n, d))
    }

    #[test]
    fn opposite_angles_cancel() {
        for n in -12..=12 {
            let (there, back) = (pi_times(n, 12), pi_times(-n, 12));
            let sum = Exact::sincos(&there).compose(&Exact::sincos(&back));
            assert!(sum.sin.is_zero() && sum.cos.is_one(), "{n}");
        }
    }

    #[test]
    fn right_angles_are_exact() {
        for (n, sin, cos) in [(0, 0, 1), (1, 1, 0), (2, 0, -1), (3, -1, 0), (-1, -1, 0)] {
            let rotor = Exact::sincos(&pi_times(n, 2));
            assert_eq!(rotor.sin, Exact::from(ratio(sin, 1)));
            assert_eq!(rotor.cos, Exact::from(ratio(cos, 1)));
        }
    }

    #[test]
    fn the_circle_relation_folds() {
        for angle in [pi_times(1, 5), Angle::Radians(ratio(3, 10))] {
            let r = Exact::sincos(&angle);
            assert!(r.sin.mul(&r.sin).add(&r.cos.mul(&r.cos)).is_one());
        }
    }

    #[test]
    fn an_eighth_of_a_turn_is_the_root_of_one_half() {
        let [eighth, back, three] = [1, -1, 3].map(|n| Exact::sincos(&pi_times(n, 4)));
        assert_eq!(eighth.sin, eighth.cos);
        assert_eq!(eighth.sin, three.sin);
        assert_eq!(back.sin, three.cos);
        assert_eq!(eighth.sin.mul(&eighth.cos), Exact::from(ratio(1, 2)));
        let turn = eighth.compose(&eighth);
        assert!(turn.sin.is_one() && turn.cos.is_zero());
        let other = Exact::sincos(&pi_times(1, 5)).cos;
        let product = other.mul(&eighth.cos).mul(&eighth.sin);
        assert_eq!(product, other.half());
    }

    #[test]
    fn complementary_angles_share_their_generators() {
        let [third, sixth] = [3, 6].map(|d| Exact::sincos(&pi_times(1, d)));
        assert_eq!(third.sin, sixth.cos);
    }
}
