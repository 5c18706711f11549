//! The coefficients of a robot's dynamics: which vanish, which repeat another.

use dalembert_codegen::Diagnostic;
use dalembert_codegen::workspace::Setup;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;

use super::{Entry, entries};
use crate::arm::{Symbolic, SymbolicArm};
use crate::quantity::Quantity;
use crate::ring::Polynomial;

/// The value of a coefficient.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Zero in every state.
    Zero,
    /// A constant that is not zero.
    Constant,
    /// A function of the state, neither equal nor opposite to an earlier coefficient.
    Distinct,
    /// Equal to an earlier coefficient.
    Equals(Entry),
    /// The opposite of an earlier coefficient.
    OppositeOf(Entry),
}

/// The coefficients of a robot with their values: D, then h, then c, symmetric ones once, in the order of
/// their indices.
#[derive(Clone, Debug)]
pub struct Inventory(pub Vec<(Entry, Value)>);

impl Inventory {
    /// Lists the coefficients of a robot.
    ///
    /// # Errors
    /// The robot has no formulas.
    pub fn new(robot: &Robot) -> Result<Inventory, Diagnostic> {
        let setup = Setup::whole(robot);
        let arm = SymbolicArm::new(&setup, Symbolic::Nothing)?;
        let posed = arm.chain(&arm.arm);
        let coefficients = arm.coefficients(&setup, &posed, &posed.chain)?;
        let mut distinct: Vec<(Entry, &Polynomial)> = Vec::new();
        let mut inventory = Vec::new();
        for (entry, polynomial) in entries(&coefficients) {
            let mut earlier = distinct
                .iter()
                .filter(|(other, _)| other.quantity == entry.quantity);
            let repeated = earlier.find_map(|(other, known)| {
                let sign = known.sign_against(polynomial)?;
                Some((other.clone(), sign))
            });
            let value = match repeated {
                _ if polynomial.is_zero() => Value::Zero,
                Some((other, 1)) => Value::Equals(other),
                Some((other, _)) => Value::OppositeOf(other),
                None => {
                    distinct.push((entry.clone(), polynomial));
                    match polynomial.to_constant() {
                        Some(_) => Value::Constant,
                        None => Value::Distinct,
                    }
                }
            };
            inventory.push((entry, value));
        }
        Ok(Inventory(inventory))
    }

    /// Counts the coefficients of one quantity: all, those that vanish, and the others, with equal and
    /// opposite ones counted once.
    pub fn summary(&self, quantity: Quantity) -> [usize; 3] {
        let is_such = |(entry, _): &&(Entry, Value)| entry.quantity == quantity;
        let values = self.0.iter().filter(is_such);
        let count = |is: fn(&Value) -> bool| values.clone().filter(|(_, value)| is(value)).count();
        [
            count(|_| true),
            count(|value| *value == Value::Zero),
            count(|value| matches!(value, Value::Constant | Value::Distinct)),
        ]
    }
}
