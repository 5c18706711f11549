//! Scalars that textbook formulas are evaluated in, as one type.
//!
//! The equations are generic over the scalar, and large: for each scalar that takes all of them, a
//! user waits for seconds of compiling. So symbols, residues, doubles, degrees and true values are
//! cases of [`AnyScalar`], and the equations are compiled for it alone.
//!
//! Takes the arguments of a formula in one scalar; returns its results. `Degree` bounds the degree
//! of a program in a proof, `TrueValue` is a number of 256 bits.

pub(crate) mod degree;
pub(crate) mod true_value;

use std::ops;
use std::rc::Rc;

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::field::{Field, ProofField};
use dalembert_model::scalar::sparse::Sparse;
use dalembert_model::scalar::{Divide, Scalar};
use num_traits::{One, ToPrimitive, Zero};

use crate::dag::Leaves;
use crate::dag::symbol::Symbol;
use degree::Degree;
use true_value::TrueValue;

/// A value of a scalar. Two values of an expression are of one scalar, or one is a number.
#[derive(Clone, Debug)]
pub(crate) enum AnyScalar {
    /// Made of zeros and ones alone: of every scalar.
    Number(Rc<Rational>),
    Search(Field),
    Proof(ProofField),
    Double(f64),
    Degree(Rc<Degree>),
    True(Rc<TrueValue>),
    Symbol(Rc<Symbol>),
}

use AnyScalar::{Double, Number, Proof, Search, True};

/// A value with the zeros and ones of the robot's structure.
pub(crate) type AnyValue = Sparse<AnyScalar>;

/// A scalar that [`AnyScalar`] has a case for.
pub(crate) trait Case: Divide {
    fn any(self) -> AnyScalar;
    fn of_number(number: &Rational) -> Self;
    /// Returns none if the value is of another scalar.
    fn of(value: AnyScalar) -> Option<Self>;
}

macro_rules! case {
    ($scalar:ty, $case:ident, $of_number:expr) => {
        case!($scalar, $case, $of_number, |x| x, |x| x);
    };
    ($scalar:ty, $case:ident, $of_number:expr, $wrap:expr, $unwrap:expr) => {
        impl Case for $scalar {
            fn any(self) -> AnyScalar {
                AnyScalar::$case($wrap(self))
            }
            fn of_number(number: &Rational) -> Self {
                $of_number(number)
            }
            fn of(value: AnyScalar) -> Option<Self> {
                match value {
                    Number(number) => Some(Self::of_number(&number)),
                    AnyScalar::$case(value) => Some($unwrap(value)),
                    _ => None,
                }
            }
        }
    };
}

fn true_number(number: &Rational) -> TrueValue {
    TrueValue::constant(&Exact::from(number.clone()))
}

fn symbol(number: &Rational) -> Symbol {
    Symbol::Constant(Exact::from(number.clone()))
}

// Denominators of such numbers are powers of two, which no prime here divides.
case!(Field, Search, |x| Field::from_rational(x)
    .unwrap_or_default());
case!(ProofField, Proof, |x| ProofField::from_rational(x)
    .unwrap_or_default());
case!(f64, Double, |x: &Rational| x.to_f64().unwrap_or(f64::NAN));
case!(
    Degree,
    Degree,
    |_| Degree::zero(),
    Rc::new,
    Rc::unwrap_or_clone
);
case!(TrueValue, True, true_number, Rc::new, Rc::unwrap_or_clone);
case!(Symbol, Symbol, symbol, Rc::new, Rc::unwrap_or_clone);

impl AnyScalar {
    fn alike(&self, number: &Rational) -> AnyScalar {
        match self {
            Number(_) => Number(Rc::new(number.clone())),
            Search(_) => Field::of_number(number).any(),
            Proof(_) => ProofField::of_number(number).any(),
            Double(_) => f64::of_number(number).any(),
            AnyScalar::Degree(_) => Degree::of_number(number).any(),
            True(_) => TrueValue::of_number(number).any(),
            AnyScalar::Symbol(_) => Symbol::of_number(number).any(),
        }
    }
}

macro_rules! binary {
    ($operation:ident, $of_numbers:expr) => {
        fn $operation(&self, other: &Self) -> Self {
            match (self, other) {
                (Number(a), Number(b)) => Number(Rc::new($of_numbers(&**a, &**b))),
                (Number(a), b) => b.alike(a).$operation(b),
                (a, Number(b)) => a.$operation(&a.alike(b)),
                (Search(a), Search(b)) => Search(a.$operation(b)),
                (Proof(a), Proof(b)) => Proof(a.$operation(b)),
                (Double(a), Double(b)) => Double(a.$operation(b)),
                (AnyScalar::Degree(a), AnyScalar::Degree(b)) => a.$operation(b).any(),
                (True(a), True(b)) => a.$operation(b).any(),
                (AnyScalar::Symbol(a), AnyScalar::Symbol(b)) => a.$operation(b).any(),
                (a, b) => unreachable!("{a:?} and {b:?} are of two scalars"),
            }
        }
    };
}

macro_rules! unary {
    ($operation:ident, $of_number:expr) => {
        fn $operation(&self) -> Self {
            match self {
                Number(x) => Number(Rc::new($of_number(&**x))),
                Search(x) => Search(x.$operation()),
                Proof(x) => Proof(x.$operation()),
                Double(x) => Double(Scalar::$operation(x)),
                AnyScalar::Degree(x) => x.$operation().any(),
                True(x) => x.$operation().any(),
                AnyScalar::Symbol(x) => x.$operation().any(),
            }
        }
    };
}

impl Scalar for AnyScalar {
    fn zero() -> Self {
        Number(Rc::new(Rational::zero()))
    }
    fn one() -> Self {
        Number(Rc::new(Rational::one()))
    }
    binary!(add, ops::Add::add);
    binary!(sub, ops::Sub::sub);
    binary!(mul, ops::Mul::mul);
    unary!(neg, ops::Neg::neg);
    unary!(half, |x: &Rational| x / Rational::from_integer(2.into()));

    fn is_zero(&self) -> bool {
        matches!(self, AnyScalar::Symbol(x) if x.is_zero())
    }
    fn is_one(&self) -> bool {
        matches!(self, AnyScalar::Symbol(x) if x.is_one())
    }

    /// As the doubles of the generic runtime do, those here round once.
    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        match (self, factor, addend) {
            (Double(a), Double(b), Double(c)) => Double(Scalar::mul_add(a, b, c)),
            _ => self.mul(factor).add(addend),
        }
    }
}

impl Divide for AnyScalar {
    binary!(div, ops::Div::div);

    fn divides(&self) -> bool {
        match self {
            Number(x) => !x.is_zero(),
            Search(x) => x.divides(),
            Proof(x) => x.divides(),
            Double(_) | AnyScalar::Degree(_) | True(_) | AnyScalar::Symbol(_) => true,
        }
    }
}

/// A value that a formula is evaluated in by way of [`AnyValue`].
pub(crate) trait Erase: Divide {
    fn erase(self) -> AnyValue;
    fn restore(value: AnyValue) -> Self;
}

impl<S: Case> Erase for Sparse<S> {
    fn erase(self) -> AnyValue {
        match self {
            Sparse::Zero => Sparse::Zero,
            Sparse::One => Sparse::One,
            Sparse::Value(value) => Sparse::Value(value.any()),
            Sparse::Lost => Sparse::Lost,
        }
    }

    fn restore(value: AnyValue) -> Self {
        match value {
            Sparse::Zero => Sparse::Zero,
            Sparse::One => Sparse::One,
            Sparse::Value(value) => S::of(value).map_or(Sparse::Lost, Sparse::Value),
            Sparse::Lost => Sparse::Lost,
        }
    }
}

impl Erase for TrueValue {
    fn erase(self) -> AnyValue {
        Sparse::Value(self.any())
    }

    fn restore(value: AnyValue) -> Self {
        let value = value.value().and_then(TrueValue::of);
        value.unwrap_or_else(TrueValue::unknown)
    }
}

impl Erase for Symbol {
    fn erase(self) -> AnyValue {
        match self {
            x if x.is_zero() => Sparse::Zero,
            x if x.is_one() => Sparse::One,
            x => Sparse::Value(x.any()),
        }
    }

    fn restore(value: AnyValue) -> Self {
        let value = value.value().and_then(Symbol::of);
        value.unwrap_or_else(Symbol::zero)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct AnyLeaves<'a, L>(pub(crate) &'a L);

impl<C, I, L: Leaves<C, I>> Leaves<C, I> for AnyLeaves<'_, L>
where
    L::Value: Erase,
{
    type Value = AnyValue;

    fn constant(&self, constant: &C) -> AnyValue {
        self.0.constant(constant).erase()
    }

    fn input(&self, input: I) -> AnyValue {
        self.0.input(input).erase()
    }
}

pub(crate) fn restored<S: Erase>(values: Vec<AnyValue>) -> Vec<S> {
    values.into_iter().map(S::restore).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::scalar::field::Points;

    /// Each operation, with numbers of either side, in a scalar and by way of the common one.
    fn is_the_same<S: Case + PartialEq + std::fmt::Debug>(x: S, y: S) {
        let half = Rational::new(1.into(), 2.into());
        let values = [x, y, S::of_number(&half)];
        let mut any: Vec<AnyScalar> = values.iter().map(|x| x.clone().any()).collect();
        let one = AnyScalar::one();
        any.extend([one.half(), one.double().half().half()]);
        let plain = |place: usize| values[place.min(2)].clone();
        for (i, a) in any.iter().enumerate() {
            for (j, b) in any.iter().enumerate() {
                let (x, y) = (plain(i), plain(j));
                let pairs = [
                    (a.add(b), x.add(&y)),
                    (a.sub(b), x.sub(&y)),
                    (a.mul(b), x.mul(&y)),
                    (a.div(b), x.div(&y)),
                    (a.neg(), x.neg()),
                    (a.half(), x.half()),
                    (a.mul_add(b, &any[0]), x.mul_add(&y, &values[0])),
                ];
                for (found, expected) in pairs {
                    assert_eq!(S::of(found), Some(expected), "{a:?} {b:?}");
                }
                assert!(a.divides() && x.divides());
            }
        }
    }

    #[test]
    fn every_case_computes_as_its_scalar() {
        let mut points = Points::new(5);
        is_the_same(points.field(), points.field());
        let [x, y] = [points.bits(), points.bits()].map(ProofField::new);
        is_the_same(x, y);
        is_the_same(0.1, -3.7);
        assert!(!Field::ZERO.any().divides() && Field::of(ProofField::ONE.any()).is_none());
        assert!(!AnyScalar::one().sub(&AnyScalar::one()).divides());
    }
}
