//! The same sums and products in the order in which the longest chain is shortest.
//!
//! A sum of sums that nobody else reads is one sum of many terms, each with its sign,
//! and a product of products one of many factors: exact arithmetic does not ask in
//! which order they are taken. Here the two that are ready first are always taken
//! first, which is the order that ends soonest, by the cycles that operations take.
//! As many operations are left as there were. What others read stays a value of its own, so that
//! nothing is computed twice.
//!
//! Rounding does ask: the reordered program is proved, run and bounded as itself.

use dalembert_model::number::Exact;

use super::fused::fusion;
use super::{Operand, Operation, Program, Step};

/// Cycles until the next operation can read the result of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycles {
    /// Cycles of a sum or a difference.
    pub add: u64,
    /// Cycles of a product.
    pub mul: u64,
    /// Cycles of a quotient.
    pub div: u64,
}

impl Cycles {
    /// Latencies of a desktop processor, by LLVM's scheduling model of Skylake,
    /// `X86SchedSkylakeClient.td`: f64; f32 divides in 11.
    pub const DESKTOP: Cycles = Cycles {
        add: 4,
        mul: 4,
        div: 14,
    };

    fn of(self, operation: Operation) -> u64 {
        match operation {
            Operation::Add | Operation::Sub => self.add,
            Operation::Mul | Operation::Fused => self.mul,
            Operation::Div => self.div,
        }
    }
}

/// An operation whose operands can be taken in any order.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Sum,
    Product,
}

fn kind(operation: Operation) -> Option<Kind> {
    match operation {
        Operation::Add | Operation::Sub => Some(Kind::Sum),
        Operation::Mul => Some(Kind::Product),
        Operation::Fused | Operation::Div => None,
    }
}

/// A term or a factor.
#[derive(Clone)]
struct Term {
    operand: Operand,
    negative: bool,
    /// When it can be read, in cycles.
    ready: u64,
}

impl Program {
    /// Returns the program with sums and products reordered so that the longest chain is
    /// shortest. One with fused products stays as it is.
    #[must_use]
    pub fn shallow(&self, cycles: Cycles) -> Program {
        if self.fuses() {
            return self.clone();
        }
        let inner = self.inner();
        let mut writer = Writer {
            cycles,
            steps: Vec::with_capacity(self.steps.len()),
            ready: Vec::with_capacity(self.steps.len()),
        };
        let mut place = vec![usize::MAX; self.steps.len()];
        for (index, step) in self.steps.iter().enumerate() {
            if inner[index] {
                continue;
            }
            place[index] = match kind(step.operation) {
                None => {
                    let (left, right) = (step.left.moved(&place), step.right.moved(&place));
                    writer.push(step.operation, left, right)
                }
                Some(kind) => {
                    let mut terms = Vec::new();
                    self.terms(index, false, &inner, &mut |operand, negative| {
                        terms.push((operand.moved(&place), negative));
                    });
                    writer.take(kind, terms)
                }
            };
        }
        let outputs = self.outputs.iter().map(|output| super::Output {
            negative: output.negative,
            value: output.value.moved(&place),
        });
        Program {
            outputs: outputs.collect(),
            steps: writer.steps,
            ..self.clone()
        }
    }

    /// The operations of the longest chain, a fused multiply-add counted as one.
    pub fn depth(&self) -> usize {
        let mut depths = vec![0usize; self.steps.len()];
        for (index, step) in self.steps.iter().enumerate() {
            let of = |operand: &Operand| match operand {
                Operand::Step(read) => depths.get(*read).copied().unwrap_or(0),
                Operand::Input(_) | Operand::Constant(_) => 0,
            };
            let before = match fusion(&self.steps, index) {
                None => of(&step.left).max(of(&step.right)),
                Some(fusion) => of(&fusion.product.left)
                    .max(of(&fusion.product.right))
                    .max(of(fusion.addend)),
            };
            depths[index] = before + 1;
        }
        depths.into_iter().max().unwrap_or(0)
    }

    /// Returns, for each step, whether a single step reads it and is of its kind.
    fn inner(&self) -> Vec<bool> {
        let mut reads = vec![0usize; self.steps.len()];
        let mut inner = vec![false; self.steps.len()];
        let mut note = |operand: &Operand, same: &dyn Fn(usize) -> bool| {
            if let Operand::Step(read) = *operand
                && let Some(count) = reads.get_mut(read)
            {
                *count += 1;
                inner[read] = *count == 1 && same(read);
            }
        };
        for step in &self.steps {
            let own = kind(step.operation);
            let same = |read: usize| own.is_some() && own == kind(self.steps[read].operation);
            note(&step.left, &same);
            note(&step.right, &same);
        }
        for output in &self.outputs {
            note(&output.value, &|_| false);
        }
        inner
    }

    /// Collects the terms or factors of a step, those of the steps within it among them, left
    /// before right.
    fn terms(
        &self,
        index: usize,
        negative: bool,
        inner: &[bool],
        visit: &mut impl FnMut(&Operand, bool),
    ) {
        // A stack of its own: chains are as long as programs.
        let mut open = vec![(Operand::Step(index), negative, true)];
        while let Some((operand, negative, is_root)) = open.pop() {
            match operand {
                Operand::Step(read) if is_root || inner[read] => {
                    let step = &self.steps[read];
                    let minus = step.operation == Operation::Sub;
                    open.push((step.right.clone(), negative != minus, false));
                    open.push((step.left.clone(), negative, false));
                }
                operand => visit(&operand, negative),
            }
        }
    }
}

/// The steps of the new program, and when each can be read.
struct Writer {
    cycles: Cycles,
    steps: Vec<Step<Exact>>,
    ready: Vec<u64>,
}

impl Writer {
    fn when(&self, operand: &Operand) -> u64 {
        match operand {
            Operand::Step(step) => self.ready.get(*step).copied().unwrap_or(0),
            Operand::Input(_) | Operand::Constant(_) => 0,
        }
    }

    fn push(&mut self, operation: Operation, left: Operand, right: Operand) -> usize {
        let ready = self.when(&left).max(self.when(&right)) + self.cycles.of(operation);
        self.ready.push(ready);
        self.steps.push(Step {
            operation,
            left,
            right,
        });
        self.steps.len() - 1
    }

    /// Takes two at least, those first that are ready first; of equals those that stand
    /// first. Not two constants, whose product or sum no search has left.
    fn take(&mut self, kind: Kind, terms: Vec<(Operand, bool)>) -> usize {
        let with_time = |(operand, negative): (Operand, bool)| Term {
            ready: self.when(&operand),
            operand,
            negative,
        };
        let mut terms: Vec<Term> = terms.into_iter().map(with_time).collect();
        let mut last = 0;
        while terms.len() > 1 {
            // Stable: what is new stands behind what was there.
            terms.sort_by_key(|term| term.ready);
            let first = terms.remove(0);
            let is_constant = |term: &Term| matches!(term.operand, Operand::Constant(_));
            let second = match is_constant(&first) {
                true => terms.iter().position(|term| !is_constant(term)),
                false => None,
            };
            let second = terms.remove(second.unwrap_or(0));
            let (left, right, operation, negative) = ordered(kind, first, second);
            last = self.push(operation, left, right);
            terms.push(Term {
                operand: Operand::Step(last),
                negative,
                ready: self.ready[last],
            });
        }
        last
    }
}

/// Returns the operation of two terms or factors, a constant on its right, and whether what
/// comes of it is to be subtracted: never at the end, since a sum's first term
/// is added.
fn ordered(kind: Kind, first: Term, second: Term) -> (Operand, Operand, Operation, bool) {
    let swaps = matches!(first.operand, Operand::Constant(_));
    let (left, right) = match swaps {
        true => (second, first),
        false => (first, second),
    };
    match (kind, left.negative, right.negative) {
        (Kind::Product, ..) => (left.operand, right.operand, Operation::Mul, false),
        (Kind::Sum, false, false) => (left.operand, right.operand, Operation::Add, false),
        (Kind::Sum, true, true) => (left.operand, right.operand, Operation::Add, true),
        (Kind::Sum, false, true) => (left.operand, right.operand, Operation::Sub, false),
        (Kind::Sum, true, false) => (right.operand, left.operand, Operation::Sub, false),
    }
}
