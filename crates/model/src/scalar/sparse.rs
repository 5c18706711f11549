//! Values that know when they are zero or one by structure.

use super::{Divide, Scalar};

/// A value of a scalar that has no structural zeros of its own, such as a residue or a float.
///
/// A zero or one by structure is a constant of the robot or made of such constants alone, so
/// it is one in every state: formulas leave out products with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sparse<S> {
    /// 0, in every state.
    Zero,
    /// 1, in every state.
    One,
    /// Any other value.
    Value(S),
    /// No value: a constant without a residue, a quotient by zero, and what is computed of them.
    Lost,
}

use Sparse::{Lost, One, Value, Zero};

impl<S: Scalar> Sparse<S> {
    /// Returns a value that is zero or one by structure where an exact number is.
    pub fn constant(exact: &impl Scalar, value: S) -> Self {
        match () {
            () if exact.is_zero() => Zero,
            () if exact.is_one() => One,
            () => Value(value),
        }
    }

    /// Returns the value in its scalar, `None` if it is lost.
    pub fn value(&self) -> Option<S> {
        match self {
            Zero => Some(S::zero()),
            One => Some(S::one()),
            Value(value) => Some(value.clone()),
            Lost => None,
        }
    }

    fn apply(&self, other: &Self, operation: impl Fn(&S, &S) -> S) -> Self {
        match (self, other) {
            (Value(a), Value(b)) => Value(operation(a, b)),
            (a, b) => match a.value().zip(b.value()) {
                Some((a, b)) => Value(operation(&a, &b)),
                None => Lost,
            },
        }
    }
}

impl<S: Scalar> Scalar for Sparse<S> {
    fn zero() -> Self {
        Zero
    }
    fn one() -> Self {
        One
    }
    fn add(&self, other: &Self) -> Self {
        match (self, other) {
            (Zero, x) | (x, Zero) => x.clone(),
            _ => self.apply(other, S::add),
        }
    }
    fn sub(&self, other: &Self) -> Self {
        match (self, other) {
            (x, Zero) => x.clone(),
            (Zero, x) => x.neg(),
            (One, One) => Zero,
            _ => self.apply(other, S::sub),
        }
    }
    fn mul(&self, other: &Self) -> Self {
        match (self, other) {
            (Lost, _) | (_, Lost) => Lost,
            (Zero, _) | (_, Zero) => Zero,
            (One, x) | (x, One) => x.clone(),
            _ => self.apply(other, S::mul),
        }
    }
    fn neg(&self) -> Self {
        match self {
            Zero => Zero,
            _ => self.apply(self, |x, _| x.neg()),
        }
    }
    fn half(&self) -> Self {
        match self {
            Zero => Zero,
            _ => self.apply(self, |x, _| x.half()),
        }
    }
    fn is_zero(&self) -> bool {
        match self {
            Value(value) => value.is_zero(),
            _ => matches!(self, Zero),
        }
    }
    fn is_one(&self) -> bool {
        match self {
            Value(value) => value.is_one(),
            _ => matches!(self, One),
        }
    }
    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        match (self, factor, addend) {
            (Value(a), Value(b), Value(c)) => Value(a.mul_add(b, c)),
            _ => self.mul(factor).add(addend),
        }
    }
}

impl<S: Divide> Divide for Sparse<S> {
    fn div(&self, other: &Self) -> Self {
        match (self, other) {
            (_, One) => self.clone(),
            (_, Zero) => Lost,
            (_, Value(divisor)) if !divisor.divides() => Lost,
            (Zero, Value(_)) => Zero,
            _ => self.apply(other, S::div),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::field::{Field, Points};

    #[test]
    fn structure_changes_no_value() {
        let mut points = Points::new(0x5a);
        let [minus, x, y] = [Field::from_i64(-1), points.field(), points.field()].map(Value);
        let cases = [Zero, One, minus, x, y];
        type Own = Sparse<Field>;
        type Operation<S> = fn(&S, &S) -> S;
        let pairs: [(Operation<Own>, Operation<Field>); 4] = [
            (Own::add, Field::add),
            (Own::sub, Field::sub),
            (Own::mul, Field::mul),
            (Own::div, Field::div),
        ];
        for (index, (sparse, plain)) in pairs.into_iter().enumerate() {
            for x in &cases {
                for y in &cases {
                    let [a, b] = [x, y].map(|x| x.value().unwrap());
                    let expected = (index < 3 || !y.is_zero()).then(|| plain(&a, &b));
                    assert_eq!(sparse(x, y).value(), expected, "{x:?} {y:?}");
                    let sum = x.mul_add(y, &cases[3]).value();
                    assert_eq!(sum, cases[3].value().map(|c| a.mul(&b).add(&c)));
                }
                assert_eq!(sparse(x, &Lost), Lost);
                assert!(x.is_zero() || sparse(&Lost, x) == Lost);
            }
        }
        assert!(One.sub(&Own::one()).is_zero() && !cases[3].sub(&cases[3]).is_zero());
        assert_eq!(One.half().double().value(), Some(Field::ONE));
        let quotient = One.div(&cases[3].sub(&cases[3]));
        assert_eq!(Zero.mul(&quotient), Lost);
    }

    #[test]
    fn floats_fuse() {
        let x = Value(1.0 + f64::EPSILON);
        let fused = x.mul_add(&x, &Value(-1.0)).value();
        let expected = 2.0 * f64::EPSILON + f64::EPSILON * f64::EPSILON;
        assert_eq!(fused, Some(expected));
    }
}
