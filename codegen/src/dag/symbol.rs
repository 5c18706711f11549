//! The symbolic scalar: arithmetic on it builds a graph.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

use super::{Builder, Edge, Input, Operation};

/// The builder travels with the nodes, so there is no global state; two nodes in one expression
/// must come from the same builder.
#[derive(Clone, Debug)]
pub(crate) enum Symbol {
    Constant(Exact),
    /// A quotient of constants whose divisor is not zero, and no rational
    /// number, or it would be a constant.
    Quotient(Exact, Exact),
    Node(Rc<RefCell<Builder>>, Edge),
}

impl Symbol {
    pub(crate) fn constant(constant: &Exact) -> Symbol {
        Symbol::Constant(constant.clone())
    }

    pub(crate) fn input(builder: &Rc<RefCell<Builder>>, input: Input) -> Symbol {
        let edge = builder.borrow_mut().input(input);
        Symbol::Node(builder.clone(), edge)
    }

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

    fn fraction(&self) -> Option<[Exact; 2]> {
        match self {
            Symbol::Constant(constant) => Some([constant.clone(), Exact::one()]),
            Symbol::Quotient(a, b) => Some([a.clone(), b.clone()]),
            Symbol::Node(..) => None,
        }
    }

    fn combine(&self, operation: Operation, other: &Symbol) -> Symbol {
        let builder = match (self, other) {
            (Symbol::Node(builder, _), _) | (_, Symbol::Node(builder, _)) => builder,
            _ => return self.without_nodes(operation, other),
        };
        let mut graph_builder = builder.borrow_mut();
        let [a, b] = [self, other].map(|symbol| symbol.edge(&mut graph_builder));
        let edge = graph_builder.apply(operation, a, b);
        match graph_builder.exact(edge) {
            Some(constant) => Symbol::Constant(constant),
            None => Symbol::Node(builder.clone(), edge),
        }
    }

    fn without_nodes(&self, operation: Operation, other: &Symbol) -> Symbol {
        if let (Symbol::Constant(a), Symbol::Constant(b)) = (self, other)
            && let Some(constant) = operation.exactly(a, b)
        {
            return Symbol::Constant(constant);
        }
        let Some(([a, b], [c, d])) = self.fraction().zip(other.fraction()) else {
            return Symbol::zero();
        };
        // Whole numbers stay whole.
        let sum = |of: fn(&Exact, &Exact) -> Exact| match b == d {
            true => [of(&a, &c), b.clone()],
            false => [of(&a.mul(&d), &c.mul(&b)), b.mul(&d)],
        };
        let [dividend, divisor] = match operation {
            Operation::Add => sum(Exact::add),
            Operation::Sub => sum(Exact::sub),
            Operation::Mul | Operation::Fused => [a.mul(&c), b.mul(&d)],
            Operation::Div => [a.mul(&d), b.mul(&c)],
        };
        Symbol::quotient(dividend, divisor)
    }
}

impl Divide for Symbol {
    fn div(&self, other: &Self) -> Self {
        self.combine(Operation::Div, other)
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
        self.combine(Operation::Add, other)
    }
    fn sub(&self, other: &Self) -> Self {
        self.combine(Operation::Sub, other)
    }
    fn mul(&self, other: &Self) -> Self {
        self.combine(Operation::Mul, other)
    }
    fn neg(&self) -> Self {
        match self {
            Symbol::Constant(constant) => Symbol::Constant(constant.neg()),
            Symbol::Quotient(a, b) => Symbol::Quotient(a.neg(), b.clone()),
            Symbol::Node(builder, edge) => Symbol::Node(builder.clone(), edge.negated_if(true)),
        }
    }
    fn half(&self) -> Self {
        self.mul(&Symbol::Constant(Exact::one().half()))
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
    use crate::dag::{Fingerprint, Folding, Points};
    use crate::function::Argument;
    use dalembert_model::number::{Angle, Rational};

    #[test]
    fn quotients_of_constants_wait_for_a_builder() {
        let angle = Angle::Radians(Rational::new(1.into(), 3.into()));
        let cosine = Exact::sincos(&angle).cos;
        let inverse = Symbol::one().div(&Symbol::constant(&cosine));
        assert!(matches!(inverse, Symbol::Quotient(..)));
        let same = inverse.neg().neg().half().double();
        let twice = inverse.add(&inverse).sub(&same);
        let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
        let x = Symbol::input(&builder, Input::Entry(Argument::Velocity, 0));
        let product = twice.mul(&x).edge(&mut builder.borrow_mut());
        let print = builder.borrow().print(product);
        let points = Points::SEARCH;
        let known = |print: Option<Fingerprint>| print.unwrap_or_else(Fingerprint::zero);
        let rate = points.input(Input::Entry(Argument::Velocity, 0));
        let expected = rate.div(&known(points.constant(&cosine)));
        assert_eq!(print, expected);
        let half = Symbol::one().div(&Symbol::one().double());
        assert!(matches!(half, Symbol::Constant(x) if x.as_rational().is_some()));
    }
}
