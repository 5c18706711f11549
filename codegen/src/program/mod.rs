//! Straight-line code, and what it is made of.
//!
//! - this file: [`Program`]: sines and cosines first, then arithmetic
//! - [`input`]: what a program reads: sines, cosines, positions, rates
//! - [`speed`]: what it reads of speeds for Coulomb friction
//! - [`scalar_type`]: the floats that code is printed in; constants rounded once
//! - [`counts`]: what a program costs
//! - `lowered`: the same over literals: each constant rounded once, sines by a
//!   library or by the polynomials of a [`kernel`]; `difference`: where two differ
//! - [`library`]: who computes the sines that are called
//! - [`fused`]: products that are fused with a sum
//! - `evaluate`: runs either in any scalar; [`run`]: as emitted code runs, bit
//!   for bit, [`columns`]: at many states at once
//! - `map`: the same over other constants and inputs, or with steps elsewhere
//! - [`adjoint`]: backwards in any scalar: what a result changes by
//! - [`text`]: operands and steps as plans and certificates write them
//! - [`machine`]: floats that run as emitted code does

pub(crate) mod adjoint;
pub(crate) mod columns;
pub(crate) mod counts;
mod difference;
mod evaluate;
pub(crate) mod fused;
pub(crate) mod input;
pub(crate) mod kernel;
pub(crate) mod library;
mod literal;
mod lowered;
pub(crate) mod machine;
mod map;
pub(crate) mod run;
pub(crate) mod scalar_type;
pub(crate) mod speed;
pub(crate) mod text;

use std::collections::BTreeMap;

use dalembert_model::number::Exact;

use crate::function::{Argument, Columns, Function, Sizes};
pub use counts::Counts;
pub use difference::Difference;
pub(crate) use evaluate::evaluate;
pub use input::{AngleSum, Input};
pub use library::Library;
pub use literal::Literal;
pub use lowered::{Lowered, LoweredTrig};
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
    /// The angles whose sine or cosine it needs, ascending.
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
    /// The angle.
    pub angle: AngleSum,
    /// `true` if the sine is needed.
    pub sin: bool,
    /// `true` if the cosine is needed.
    pub cos: bool,
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

/// The operations of emitted code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operation {
    /// left + right
    Add,
    /// left − right
    Sub,
    /// left · right
    Mul,
    /// left / right
    Div,
    /// left · right, not rounded: the next step, a sum or a difference, takes it
    /// and rounds once (`fused`).
    Fused,
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

impl Operation {
    /// Every operation.
    pub const ALL: [Operation; 5] = [
        Operation::Add,
        Operation::Sub,
        Operation::Mul,
        Operation::Div,
        Operation::Fused,
    ];

    /// Returns the operation of a symbol of Rust's.
    pub fn from_symbol(symbol: &str) -> Option<Operation> {
        let is = |operation: &Operation| {
            *operation != Operation::Fused && symbol.chars().eq([operation.symbol()])
        };
        Operation::ALL.into_iter().find(is)
    }

    /// Returns its symbol, Rust's but for a fused product, which has none there.
    pub fn symbol(self) -> char {
        match self {
            Operation::Add => '+',
            Operation::Sub => '-',
            Operation::Mul => '*',
            Operation::Div => '/',
            Operation::Fused => '×',
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
        let mut trig: BTreeMap<AngleSum, Trig> = BTreeMap::new();
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
        let steps = Counts::of_steps(&self.steps);
        let angles: usize = self.trig.iter().map(|t| t.angle.additions()).sum();
        let own = Counts {
            add: steps.add + angles,
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

fn note_trig(trig: &mut BTreeMap<AngleSum, Trig>, input: Input) {
    if let Some(angle) = input.angle() {
        let entry = trig.entry(angle).or_insert(Trig {
            angle,
            sin: false,
            cos: false,
        });
        match input {
            Input::Sin(_) => entry.sin = true,
            _ => entry.cos = true,
        }
    }
}
