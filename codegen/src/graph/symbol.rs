//! The symbolic scalar: arithmetic on it builds a graph.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::{Divide, Scalar};

use super::{Builder, Value};
use crate::program::Input;

/// A constant, which needs no context, or a node of a shared builder.
///
/// The builder travels with the nodes, so there is no global state; two nodes
/// in one expression must come from the same builder.
#[derive(Clone)]
pub enum Symbol {
    /// An exact constant.
    Constant(Exact),
    /// A node with its builder.
    Node(Rc<RefCell<Builder>>, Value),
}

impl Symbol {
    /// An input of the traced program.
    pub fn input(builder: &Rc<RefCell<Builder>>, input: Input) -> Symbol {
        let value = builder.borrow_mut().input(input);
        Symbol::wrap(builder, value)
    }

    /// The value without its builder.
    pub fn value(&self) -> Value {
        match self {
            Symbol::Constant(constant) => Value::Constant(constant.clone()),
            Symbol::Node(_, value) => value.clone(),
        }
    }

    fn wrap(builder: &Rc<RefCell<Builder>>, value: Value) -> Symbol {
        match value {
            Value::Constant(constant) => Symbol::Constant(constant),
            node => Symbol::Node(builder.clone(), node),
        }
    }

    fn combine(
        &self,
        other: &Symbol,
        constants: impl Fn(&Exact, &Exact) -> Exact,
        nodes: impl Fn(&mut Builder, &Value, &Value) -> Value,
    ) -> Symbol {
        match (self, other) {
            (Symbol::Constant(a), Symbol::Constant(b)) => Symbol::Constant(constants(a, b)),
            (Symbol::Node(builder, _), _) | (_, Symbol::Node(builder, _)) => {
                let value = nodes(&mut builder.borrow_mut(), &self.value(), &other.value());
                Symbol::wrap(builder, value)
            }
        }
    }
}

impl From<Exact> for Symbol {
    fn from(constant: Exact) -> Self {
        Symbol::Constant(constant)
    }
}

impl Divide for Symbol {
    /// Of constants: their quotient if the divisor is rational; by zero: zero,
    /// which no formula asks for.
    fn div(&self, other: &Self) -> Self {
        let builder = match (self, other) {
            (Symbol::Node(builder, _), _) | (_, Symbol::Node(builder, _)) => builder,
            (Symbol::Constant(a), Symbol::Constant(b)) => {
                let quotient = b.as_rational().and_then(|b| a.divide(b));
                return Symbol::Constant(quotient.unwrap_or_else(Exact::zero));
            }
        };
        let value = builder.borrow_mut().div(&self.value(), &other.value());
        Symbol::wrap(builder, value)
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
        self.combine(other, Exact::add, Builder::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.combine(other, Exact::sub, Builder::sub)
    }
    fn mul(&self, other: &Self) -> Self {
        self.combine(other, Exact::mul, Builder::mul)
    }
    fn neg(&self) -> Self {
        match self {
            Symbol::Constant(constant) => Symbol::Constant(constant.neg()),
            Symbol::Node(builder, value) => {
                let negated = builder.borrow_mut().negate_if(value, true);
                Symbol::Node(builder.clone(), negated)
            }
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
