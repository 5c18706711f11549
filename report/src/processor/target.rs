//! What a processor has, as numbers that one function reads.

use dalembert_codegen::workspace::program::{Operation, ScalarType};

/// A processor and how compilers use it. The table is
/// [`TARGETS`](super::targets::TARGETS).
#[derive(Debug)]
pub struct Target {
    /// Its name on the command line.
    pub name: &'static str,
    /// Which of its kind, in a few words.
    pub about: &'static str,
    /// What it has for f32.
    pub f32: Option<Unit>,
    /// What it has for f64; without, every operation calls software.
    pub f64: Option<Unit>,
    /// Bytes of an integer register.
    pub word: usize,
    /// Bytes that a call puts on the stack by itself: the return address.
    pub returns: usize,
    /// Words that a function that uses the stack saves first: the return address
    /// where the call left it in a register, the frame pointer.
    pub frame: usize,
    /// What the stack pointer is a multiple of.
    pub alignment: usize,
    /// Registers of 64 bits for floats that a function restores before it returns.
    pub restored: usize,
    /// Registers that one instruction saves or restores.
    pub saves: usize,
    /// Bytes of an instruction, on average.
    pub bytes: f64,
    /// Whether an operation writes over its left operand, so that one that is
    /// read again needs a copy.
    pub overwrites: bool,
    /// Whether an operation can read its right operand in memory.
    pub reads_memory: bool,
    /// Whether constants of few digits stand in the instruction itself.
    pub short_constants: bool,
    /// Whether compilers make vectors of scalars, which the estimates leave out.
    pub vectors: bool,
}

/// What a processor has for a scalar.
#[derive(Debug)]
pub struct Unit {
    /// Registers.
    pub registers: usize,
    /// Of these, those that a call leaves as they are.
    pub kept: usize,
    /// Instructions that load a constant where it does not stand in one.
    pub constant: usize,
    /// Whether they load it from a table of constants.
    pub constants_in_table: bool,
    /// Whether compilers make one instruction of a product and its sum, with both
    /// roundings: the same bits.
    pub accumulates: bool,
    /// Cycles until the next operation can read the result.
    pub cycles: Cycles,
}

/// Cycles from operands to result.
#[derive(Clone, Copy, Debug)]
pub struct Cycles {
    /// Of a sum or difference.
    pub add: usize,
    /// Of a product.
    pub mul: usize,
    /// Of a quotient.
    pub div: usize,
    /// Of a fused multiply-add; none if it is a function that is called.
    pub fma: Option<Fused>,
}

/// Cycles from the operands of a fused multiply-add to its result.
#[derive(Clone, Copy, Debug)]
pub struct Fused {
    /// From a factor.
    pub factor: usize,
    /// From what the product is added to, which some read later.
    pub addend: usize,
}

impl Target {
    /// What it has for a scalar.
    pub fn unit(&self, scalar: ScalarType) -> Option<&Unit> {
        match scalar {
            ScalarType::F64 => self.f64.as_ref(),
            ScalarType::F32 => self.f32.as_ref(),
        }
    }
}

impl Cycles {
    /// Of an operation.
    pub fn of(self, operation: Operation) -> usize {
        match operation {
            Operation::Add | Operation::Sub => self.add,
            Operation::Mul | Operation::Fused => self.mul,
            Operation::Div => self.div,
        }
    }

    /// Of a fused multiply-add. How long a function takes is not known here: no less
    /// than both operations.
    pub fn fused(self) -> Fused {
        let software = self.mul + self.add;
        self.fma.unwrap_or(Fused {
            factor: software,
            addend: software,
        })
    }
}
