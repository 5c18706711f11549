//! Straight-line code, and what it is made of.
//!
//! - this file: [`Program`]: sines and cosines first, then arithmetic
//! - [`speed`]: what it reads of speeds for Coulomb friction
//! - [`scalar_type`]: the floats that code is printed in; constants rounded once
//! - [`code`]: the same over literals: each constant rounded once, sines by a
//!   library or by the polynomials of a [`kernel`]; `difference`: where two differ
//! - [`library`]: who computes the sines that are called
//! - [`fused`]: products that are fused with a sum
//! - [`adjoint`]: backwards in any scalar: what a result changes by
//! - [`text`]: operands and steps as plans and certificates write them
//! - [`machine`]: floats that run as emitted code does; [`lanes`]: several side by side

pub(crate) mod adjoint;
pub(crate) mod code;
mod difference;
pub(crate) mod fused;
pub(crate) mod kernel;
pub(crate) mod lanes;
pub(crate) mod library;
mod literal;
pub(crate) mod machine;
pub(crate) mod scalar_type;
pub(crate) mod speed;
pub(crate) mod text;

use std::collections::BTreeMap;

use dalembert_model::number::Exact;

pub use crate::dag::{Counts, Input, Operation};
use crate::function::{Argument, Columns, Function, Sizes};
pub use code::{Code, Pair};
pub use difference::Difference;
pub use kernel::Need;
pub use library::Library;
pub use literal::Literal;
pub use scalar_type::ScalarType;
pub(crate) use speed::Speed;

/// Straight-line code with exact constants: what is proved and emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The function that the program computes.
    pub function: Function,
    /// n: the length of every argument that has an entry a joint.
    pub joints: usize,
    /// The joints that the results are over, zero-based, in their order.
    pub rows: Vec<usize>,
    /// The arguments there are, in order.
    pub arguments: Vec<Argument>,
    /// The number of entries of the load; zero where the load is neither argument nor result.
    pub load: usize,
    /// The joints whose sine or cosine it needs, ascending.
    pub trig: Vec<Trig>,
    /// The joints of which r = 1/√(q̇² + w²) is read, ascending.
    pub speeds: Vec<Speed>,
    /// The arithmetic, operands before users.
    pub steps: Vec<Step>,
    /// The results in the order of the function's quantities.
    pub outputs: Vec<Output>,
}

/// One sine/cosine evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trig {
    /// The joint.
    pub joint: usize,
    /// Which of them is needed.
    pub need: Need,
}

/// One operation over constants C and inputs I.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<C = Exact, I = Input> {
    /// The arithmetic operation.
    pub operation: Operation,
    /// Left operand.
    pub left: Operand<C, I>,
    /// Right operand.
    pub right: Operand<C, I>,
}

/// An operand of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operand<C = Exact, I = Input> {
    /// An input.
    Input(I),
    /// A constant: exact, or the literal that it was rounded to.
    Constant(C),
    /// The result of an earlier step.
    Step(usize),
}

/// A result, negated or not: negation is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output<C = Exact, I = Input> {
    /// `true` if the result is negated.
    pub negative: bool,
    /// The value.
    pub value: Operand<C, I>,
}

impl<C: Clone, I: Clone> Operand<C, I> {
    /// Returns the operand where steps have moved to these places.
    pub(crate) fn moved(&self, place: &[usize]) -> Self {
        match self {
            Operand::Step(step) => Operand::Step(place.get(*step).copied().unwrap_or(usize::MAX)),
            other => other.clone(),
        }
    }
}

impl<C, I> Output<C, I> {
    /// Returns a value as it is.
    pub fn of(value: Operand<C, I>) -> Output<C, I> {
        Output {
            negative: false,
            value,
        }
    }
}

impl Program {
    /// Lists the sines and cosines that steps and outputs read.
    pub(crate) fn collect_trig(&mut self) {
        let mut trig: BTreeMap<usize, Trig> = BTreeMap::new();
        let operands = self.steps.iter().flat_map(|step| [&step.left, &step.right]);
        for operand in operands.chain(self.outputs.iter().map(|output| &output.value)) {
            if let Operand::Input(input) = operand {
                note_trig(&mut trig, *input);
            }
        }
        self.trig = trig.into_values().collect();
    }

    /// Returns the program with these speeds, as far as it reads them.
    #[must_use]
    pub(crate) fn with_speeds(self, mut speeds: Vec<Speed>) -> Program {
        let read = speed::read(&self.steps, &self.outputs);
        speeds.retain(|own| read.contains(&own.joint));
        Program { speeds, ..self }
    }

    /// Counts the operations.
    pub fn counts(&self) -> Counts {
        let steps = Counts::of_operations(self.steps.iter().map(|step| step.operation));
        let own = Counts {
            sincos: self.trig.len(),
            ..steps
        };
        own.with_speeds(self.speeds.len())
    }
}

impl Program {
    /// Returns the numbers that the lengths of results follow from; the number of base
    /// parameters is derived from the number of results.
    pub fn sizes(&self) -> Sizes {
        let rows = self.rows.len();
        let mut sizes = Sizes {
            rows,
            joints: self.joints,
            base: 0,
            load: self.load,
        };
        if let Columns::Base(_) = self.function.columns() {
            // What a bundle returns beside its regressor is of known lengths.
            let others = self.function.outputs(sizes);
            sizes.base = self.outputs.len().saturating_sub(others) / rows.max(1);
        }
        sizes
    }

    /// Returns whether no step and no result reads a step that is not computed yet.
    pub(crate) fn is_straight(&self) -> bool {
        let is_before = |operand: &Operand, count: usize| match operand {
            Operand::Step(read) => *read < count,
            Operand::Input(_) | Operand::Constant(_) => true,
        };
        let mut steps = self.steps.iter().enumerate();
        let mut outputs = self.outputs.iter();
        steps.all(|(index, step)| is_before(&step.left, index) && is_before(&step.right, index))
            && outputs.all(|output| is_before(&output.value, self.steps.len()))
    }

    /// Returns whether the program divides.
    pub fn divides(&self) -> bool {
        let mut steps = self.steps.iter();
        steps.any(|step| step.operation == Operation::Div)
    }
}

/// Returns whether a program computes D.
pub(crate) fn has_inertia(program: &Program) -> bool {
    let mut quantities = program.function.quantities().iter();
    quantities.any(|quantity| quantity.is_definite())
}

fn note_trig(trig: &mut BTreeMap<usize, Trig>, input: Input) {
    if let Some(joint) = input.angle() {
        let entry = trig.entry(joint).or_insert(Trig {
            joint,
            need: Need::default(),
        });
        match input {
            Input::Sin(_) => entry.need.sin = true,
            _ => entry.need.cos = true,
        }
    }
}
