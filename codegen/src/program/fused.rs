//! Products that are fused with a sum: `a.mul_add(b, c)`, one operation that
//! rounds once.
//!
//! A fused product is a step of its own ([`Operation::Fused`]) whose value is
//! not rounded. It stands right before the one step that reads it, a sum or a
//! difference, and both are one line of the text. So whatever is exact, a proof
//! or a derivative, takes it for the product that it is; whatever rounds leaves
//! its rounding out; and only machines, which cannot hold the exact product,
//! compute the two steps as one.
//!
//! **Which products are fused.** One that a single sum or difference reads, and
//! nothing else. A sum can take one product: each that has any takes one, so
//! there are as few operations as there can be. Of two it takes the one
//! with the longer chain of operations behind its factors, since its own step is
//! the one that the chain no longer has, and of equal ones the left. The choice at
//! one sum leaves those at others as they are: so chains are as short
//! as they can be. A sum with a negative literal takes none, whose sign a text
//! could not tell from a difference's, nor is a product of two literals taken.

use dalembert_model::number::{Exact, Rounded};
use dalembert_model::scalar::Scalar;

use super::{Operand, Operation, Program, Step};

/// A sum or a difference, and the product that it takes.
#[derive(Debug, PartialEq)]
pub struct Fusion<'p, C, I> {
    /// The product.
    pub product: &'p Step<C, I>,
    /// `true` if the product is subtracted.
    pub negative: bool,
    /// The operand that the product is added to.
    pub addend: &'p Operand<C, I>,
    /// `true` if the addend is subtracted.
    pub minus: bool,
}

// Derived, it would ask the same of constants and inputs.
impl<C, I> Clone for Fusion<'_, C, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<C, I> Copy for Fusion<'_, C, I> {}

/// Returns the fused product that a step takes, if it is a sum with one before it.
pub fn fusion<C, I>(steps: &[Step<C, I>], index: usize) -> Option<Fusion<'_, C, I>> {
    let (before, step) = (index.checked_sub(1)?, steps.get(index)?);
    let product = steps.get(before)?;
    if product.operation != Operation::Fused {
        return None;
    }
    let is = |operand: &Operand<C, I>| matches!(operand, Operand::Step(read) if *read == before);
    let (addend, on_left) = match (is(&step.left), is(&step.right)) {
        (true, false) => (&step.right, true),
        (false, true) => (&step.left, false),
        _ => return None,
    };
    let (negative, minus) = match step.operation {
        Operation::Add => (false, false),
        Operation::Sub => (!on_left, on_left),
        Operation::Mul | Operation::Fused | Operation::Div => return None,
    };
    Some(Fusion {
        product,
        negative,
        addend,
        minus,
    })
}

impl<C, I> Fusion<'_, C, I> {
    /// Returns the sum in a scalar, from its operands' values.
    pub fn apply<S: Scalar>(&self, left: &S, right: &S, addend: &S) -> S {
        let addend = match self.minus {
            true => addend.neg(),
            false => addend.clone(),
        };
        match self.negative {
            true => left.neg().mul_add(right, &addend),
            false => left.mul_add(right, &addend),
        }
    }
}

/// Returns whether a step's rounding can lose what is below the least normal number: that of a
/// product, a quotient, and a sum with a fused product. A sum of two floats cannot.
pub(crate) fn underflows<C, I>(steps: &[Step<C, I>], index: usize) -> bool {
    match steps.get(index).map(|step| step.operation) {
        Some(Operation::Mul | Operation::Div) => true,
        Some(Operation::Add | Operation::Sub) => fusion(steps, index).is_some(),
        Some(Operation::Fused) | None => false,
    }
}

/// Returns the ends of pieces of at least so many steps; none ends between a product and
/// the sum that takes it.
pub(crate) fn pieces<C, I>(steps: &[Step<C, I>], length: usize) -> Vec<std::ops::Range<usize>> {
    let mut pieces = Vec::new();
    let mut start = 0;
    while start < steps.len() {
        let mut end = (start + length.max(1)).min(steps.len());
        if fusion(steps, end).is_some() {
            end += 1;
        }
        pieces.push(start..end);
        start = end;
    }
    pieces
}

impl Program {
    /// Returns the number of operations of the longest chain, a fused multiply-add counted as one.
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

    /// Returns the program with its products fused, as the head of this file says; a fused
    /// program stays as it is.
    #[must_use]
    pub fn fused(&self) -> Program {
        let taken = self.taken();
        let is_taken = |step: usize| taken.contains(&Some(step));
        let mut place = vec![usize::MAX; self.steps.len()];
        let mut steps: Vec<Step> = Vec::with_capacity(self.steps.len());
        for (index, step) in self.steps.iter().enumerate() {
            if is_taken(index) {
                continue;
            }
            if let Some(product) = taken[index] {
                place[product] = steps.len();
                steps.push(factors(self.steps[product].moved(&place)));
            }
            place[index] = steps.len();
            let mut step = step.moved(&place);
            let swaps = step.operation == Operation::Add && taken[index].is_some();
            if swaps && step.right == Operand::Step(steps.len() - 1) {
                std::mem::swap(&mut step.left, &mut step.right);
            }
            steps.push(step);
        }
        let mut outputs = self.outputs.clone();
        for output in &mut outputs {
            if let Operand::Step(step) = &mut output.value {
                *step = place.get(*step).copied().unwrap_or(usize::MAX);
            }
        }
        Program {
            steps,
            outputs,
            ..self.clone()
        }
    }

    /// Returns whether the program has fused products.
    pub fn fuses(&self) -> bool {
        let mut steps = self.steps.iter();
        steps.any(|step| step.operation == Operation::Fused)
    }

    /// Returns, for each step, the product that is fused into it.
    fn taken(&self) -> Vec<Option<usize>> {
        let mut reads = vec![0usize; self.steps.len()];
        let results = self.outputs.iter().map(|output| &output.value);
        let operands = self.steps.iter().flat_map(|step| [&step.left, &step.right]);
        for operand in operands.chain(results) {
            if let Operand::Step(read) = operand
                && let Some(reads) = reads.get_mut(*read)
            {
                *reads += 1;
            }
        }
        let mut taken = vec![None; self.steps.len()];
        // The operations of the longest chain that ends in each step.
        let mut chain = vec![0usize; self.steps.len()];
        let behind = |chain: &[usize], operands: &[&Operand]| {
            let of = |operand: &&Operand| match operand {
                Operand::Step(read) => chain.get(*read).copied().unwrap_or(0),
                Operand::Input(_) | Operand::Constant(_) => 0,
            };
            operands.iter().map(of).max().unwrap_or(0)
        };
        for (index, step) in self.steps.iter().enumerate() {
            let product = |operand: &Operand, addend: &Operand| match operand {
                Operand::Step(read) if *read < index && reads[*read] == 1 => {
                    let product = &self.steps[*read];
                    let factors = [&product.left, &product.right];
                    let literals = factors.iter().all(|f| matches!(f, Operand::Constant(_)));
                    let fits = matches!(product.operation, Operation::Mul | Operation::Fused)
                        && !literals
                        && !is_negative(addend);
                    fits.then(|| (behind(&chain, &factors), *read))
                }
                _ => None,
            };
            let candidates = match step.operation {
                Operation::Add | Operation::Sub => [
                    product(&step.left, &step.right),
                    product(&step.right, &step.left),
                ],
                Operation::Mul | Operation::Fused | Operation::Div => [None; 2],
            };
            taken[index] = match candidates {
                [Some((left, _)), Some((right, product))] if right > left => Some(product),
                [Some((_, product)), _] | [None, Some((_, product))] => Some(product),
                [None, None] => None,
            };
            chain[index] = 1 + match taken[index] {
                None => behind(&chain, &[&step.left, &step.right]),
                Some(product) => {
                    let is = |operand: &Operand| *operand == Operand::Step(product);
                    let addend = match is(&step.left) {
                        true => &step.right,
                        false => &step.left,
                    };
                    let product = &self.steps[product];
                    behind(&chain, &[&product.left, &product.right, addend])
                }
            };
        }
        taken
    }
}

/// Returns the product, fused; a literal on the right, since `mul_add` is a method of the
/// left factor and a literal has no type of its own.
fn factors(product: Step) -> Step {
    let swap = matches!(product.left, Operand::Constant(_));
    let (left, right) = match swap {
        true => (product.right, product.left),
        false => (product.left, product.right),
    };
    Step {
        operation: Operation::Fused,
        left,
        right,
    }
}

fn is_negative(operand: &Operand) -> bool {
    matches!(operand, Operand::Constant(value) if f64::nearest(value) < 0.0)
}

impl Step<Exact> {
    /// Returns the step where others have moved to these places.
    fn moved(&self, place: &[usize]) -> Step {
        Step {
            operation: self.operation,
            left: self.left.moved(place),
            right: self.right.moved(place),
        }
    }
}
