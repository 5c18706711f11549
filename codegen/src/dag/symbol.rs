//! The symbolic scalar: arithmetic on it builds a graph.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::{Divide, Scalar};

use super::{Builder, Edge};
use crate::dag::Input;

/// A constant, which needs no context, or a node of a shared builder.
///
/// The builder travels with the nodes, so there is no global state; two nodes
/// in one expression must come from the same builder.
#[derive(Clone)]
pub(crate) enum Symbol {
    /// An exact constant.
    Constant(Exact),
    /// A quotient of constants whose divisor is not zero, and no rational
    /// number, or it would be a constant.
    Quotient(Exact, Exact),
    /// A node with its builder.
    Node(Rc<RefCell<Builder>>, Edge),
}

impl Symbol {
    /// Returns an input of the traced program.
    pub(crate) fn input(builder: &Rc<RefCell<Builder>>, input: Input) -> Symbol {
        let edge = builder.borrow_mut().input(input);
        Symbol::Node(builder.clone(), edge)
    }

    /// Returns the value in a builder, which is that of its nodes if it has any.
    pub(crate) fn edge(&self, builder: &mut Builder) -> Edge {
        match self {
            Symbol::Constant(constant) => builder.constant(constant),
            Symbol::Quotient(a, b) => {
                let [a, b] = [a, b].map(|x| builder.constant(x));
                builder.div(a, b)
            }
            Symbol::Node(_, edge) => *edge,
        }
    }

    /// Returns a/b; by zero: zero, which no formula asks for.
    fn quotient(a: Exact, b: Exact) -> Symbol {
        match b.as_rational() {
            Some(divisor) => Symbol::Constant(a.divide(divisor).unwrap_or_else(Exact::zero)),
            None if a.is_zero() => Symbol::zero(),
            None => Symbol::Quotient(a, b),
        }
    }

    /// Returns dividend and divisor of a value without nodes.
    fn fraction(&self) -> Option<[Exact; 2]> {
        match self {
            Symbol::Constant(constant) => Some([constant.clone(), Exact::one()]),
            Symbol::Quotient(a, b) => Some([a.clone(), b.clone()]),
            Symbol::Node(..) => None,
        }
    }

    fn combine(
        &self,
        other: &Symbol,
        constants: impl Fn(&Exact, &Exact) -> Option<Exact>,
        fractions: impl Fn([Exact; 2], [Exact; 2]) -> [Exact; 2],
        nodes: impl Fn(&mut Builder, Edge, Edge) -> Edge,
    ) -> Symbol {
        let builder = match (self, other) {
            (Symbol::Node(builder, _), _) | (_, Symbol::Node(builder, _)) => builder,
            _ => {
                if let (Symbol::Constant(a), Symbol::Constant(b)) = (self, other)
                    && let Some(constant) = constants(a, b)
                {
                    return Symbol::Constant(constant);
                }
                let both = self.fraction().zip(other.fraction());
                let result = both.map(|(x, y)| fractions(x, y));
                return result.map_or_else(Symbol::zero, |[a, b]| Symbol::quotient(a, b));
            }
        };
        let mut shared = builder.borrow_mut();
        let [a, b] = [self, other].map(|symbol| symbol.edge(&mut shared));
        let edge = nodes(&mut shared, a, b);
        match shared.exact(edge) {
            Some(constant) => Symbol::Constant(constant),
            None => Symbol::Node(builder.clone(), edge),
        }
    }
}

/// Returns a/b ± c/d; whole numbers stay whole.
fn sum([a, b]: [Exact; 2], [c, d]: [Exact; 2], of: fn(&Exact, &Exact) -> Exact) -> [Exact; 2] {
    match b == d {
        true => [of(&a, &c), b],
        false => [of(&a.mul(&d), &c.mul(&b)), b.mul(&d)],
    }
}

impl From<Exact> for Symbol {
    fn from(constant: Exact) -> Self {
        Symbol::Constant(constant)
    }
}

impl Divide for Symbol {
    fn div(&self, other: &Self) -> Self {
        let upside_down = |[a, b]: [Exact; 2], [c, d]: [Exact; 2]| [a.mul(&d), b.mul(&c)];
        let constants = |a: &Exact, b: &Exact| b.as_rational().and_then(|b| a.divide(b));
        self.combine(other, constants, upside_down, Builder::div)
    }
}

impl Scalar for Symbol {
    fn zero() -> Self {
        Symbol::Constant(Exact::zero())
    }
    fn one() -> Self {
        Symbol::Constant(Exact::one())
    }
    fn add(&self, other: &Self) -> Self {
        self.combine(
            other,
            |a, b| Some(a.add(b)),
            |x, y| sum(x, y, Exact::add),
            Builder::add,
        )
    }
    fn sub(&self, other: &Self) -> Self {
        self.combine(
            other,
            |a, b| Some(a.sub(b)),
            |x, y| sum(x, y, Exact::sub),
            Builder::sub,
        )
    }
    fn mul(&self, other: &Self) -> Self {
        let product = |[a, b]: [Exact; 2], [c, d]: [Exact; 2]| [a.mul(&c), b.mul(&d)];
        self.combine(other, |a, b| Some(a.mul(b)), product, Builder::mul)
    }
    fn neg(&self) -> Self {
        match self {
            Symbol::Constant(constant) => Symbol::Constant(constant.neg()),
            Symbol::Quotient(a, b) => Symbol::Quotient(a.neg(), b.clone()),
            Symbol::Node(builder, edge) => Symbol::Node(builder.clone(), edge.negated_if(true)),
        }
    }
    fn half(&self) -> Self {
        self.mul(&Symbol::Constant(Exact::from(Rational::new(
            1.into(),
            2.into(),
        ))))
    }
    fn is_zero(&self) -> bool {
        matches!(self, Symbol::Constant(constant) if constant.is_zero())
    }
    fn is_one(&self) -> bool {
        matches!(self, Symbol::Constant(constant) if constant.is_one())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::Operation;
    use crate::dag::{Fingerprint, Folding, Points};
    use crate::function::Argument;
    use dalembert_model::number::Angle;

    /// (1/c)·x with c the cosine of an odd angle: constants without a builder
    /// keep their quotient until they meet one.
    #[test]
    fn quotients_of_constants_wait_for_a_builder() {
        let angle = Angle::Radians(Rational::new(1.into(), 3.into()));
        let cosine = Exact::sincos(&angle).cos;
        let inverse = Symbol::one().div(&Symbol::from(cosine.clone()));
        assert!(matches!(inverse, Symbol::Quotient(..)));
        let twice = inverse
            .add(&inverse)
            .sub(&inverse.neg().neg().half().double());
        let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
        let x = Symbol::input(&builder, Input::Entry(Argument::Velocity, 0));
        let product = twice.mul(&x).edge(&mut builder.borrow_mut());
        let print = builder.borrow().print(product);
        let points = Points::SEARCH;
        let known = |print: Option<Fingerprint>| print.unwrap_or_else(Fingerprint::zero);
        let rate = points.input(Input::Entry(Argument::Velocity, 0));
        let expected = Fingerprint::apply(Operation::Div, &rate, &known(points.constant(&cosine)));
        assert_eq!(print, expected);
        let half = Symbol::one().div(&Symbol::one().double());
        assert!(matches!(half, Symbol::Constant(x) if x.as_rational().is_some()));
    }
}
