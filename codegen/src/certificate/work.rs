//! Bounds on the work that a variant of a plan makes, found before any of it is done.
//!
//! Constants are exact, and folding multiplies them out: eighteen squarings of 3/10 in a row have a
//! quarter of a million digits. How large a constant can become follows from how large its operands
//! can, so a program that would take long is refused before anything of it is computed.

use dalembert_model::number::{Exact, Extent};

use crate::program::{Operand, Operation, Program, Steps};
use crate::words::{Complaint, complaint};

const MAX_STEPS: u64 = 50_000;
const MAX_ANGLES: u64 = 256;
const MAX_BITS: u64 = 1 << 16;
const MAX_TERMS: u64 = 20_000;
const MAX_DEGREE: u64 = 256;
/// Terms times degrees times bits, over all constants of a program.
const MAX_COST: u64 = 1 << 30;

pub(super) fn check(place: &str, program: &Program) -> Result<(), Complaint> {
    let steps = program.dag.steps();
    limit(place, "steps", steps.steps.len() as u64, MAX_STEPS)?;
    limit(place, "angles", program.trig().len() as u64, MAX_ANGLES)?;
    let mut cost = 0u64;
    for constant in constants(&steps) {
        let extent = constant.extent();
        admit(place, &extent)?;
        cost = cost.saturating_add(work(&extent));
    }
    limit(place, "units of work for its constants", cost, MAX_COST)?;
    let mut sizes: Vec<Size> = Vec::new();
    for (index, step) in steps.steps.iter().enumerate() {
        let [left, right] = [&step.left, &step.right].map(|operand| read(&sizes, operand));
        let value = operate(step.operation, left, right);
        if let Some((extent, _)) = &value {
            admit(&format!("{place}, t{}", index + 1), extent)?;
        }
        sizes.push(value);
    }
    Ok(())
}

fn limit(place: &str, what: &str, found: u64, most: u64) -> Result<(), Complaint> {
    if found <= most {
        return Ok(());
    }
    Err(complaint(format!(
        "{place}: {found} {what}, of which {most} are the most that is checked"
    )))
}

fn constants(program: &Steps) -> impl Iterator<Item = &Exact> {
    let steps = program
        .steps
        .iter()
        .flat_map(|step| [&step.left, &step.right]);
    let outputs = program.outputs.iter().map(|output| &output.value);
    let all = steps.chain(outputs);
    all.filter_map(|operand| match operand {
        Operand::Constant(constant) => Some(constant),
        _ => None,
    })
}

fn work(extent: &Extent) -> u64 {
    let size = extent.terms.saturating_mul(1 + extent.degree);
    size.saturating_mul(64 + extent.bits)
}

fn admit(place: &str, extent: &Extent) -> Result<(), Complaint> {
    limit(place, "bits of a constant", extent.bits, MAX_BITS)?;
    limit(place, "terms of a constant", extent.terms, MAX_TERMS)?;
    limit(place, "degrees of a constant", extent.degree, MAX_DEGREE)
}

/// How large the constant in a value can become by folding, and whether it is the value itself,
/// or else the factor in front of it; `None` of a value without one.
type Size = Option<(Extent, bool)>;

fn read(steps: &[Size], operand: &Operand) -> Size {
    match operand {
        Operand::Constant(constant) => Some((constant.extent(), true)),
        Operand::Input(_) => None,
        Operand::Step(index) => steps.get(*index).copied().flatten(),
    }
}

fn operate(operation: Operation, a: Size, b: Size) -> Size {
    let is_product = matches!(operation, Operation::Mul | Operation::Fused);
    match (a, b) {
        (Some((x, x_is)), Some((y, y_is))) => match operation {
            _ if is_product && (x_is || y_is) => Some((product(&x, &y), x_is && y_is)),
            Operation::Add | Operation::Sub if x_is && y_is => Some((sum(&x, &y), true)),
            _ => None,
        },
        // A constant times a value is a factor in front of it, any other operation with a value is
        // a value without one.
        (Some((x, true)), None) | (None, Some((x, true))) if is_product => Some((x, false)),
        _ => None,
    }
}

fn product(x: &Extent, y: &Extent) -> Extent {
    let angles = x.angles.min(y.angles).min(63);
    let terms = x.terms.saturating_mul(y.terms);
    // A squared sine makes two monomials; equal ones are added up.
    let equal = x.terms.min(y.terms);
    Extent {
        terms: terms.saturating_mul(1 << angles),
        angles: x.angles.saturating_add(y.angles),
        degree: x.degree.saturating_add(y.degree),
        bits: x.bits.saturating_add(y.bits).saturating_mul(equal),
    }
}

fn sum(x: &Extent, y: &Extent) -> Extent {
    Extent {
        terms: x.terms.saturating_add(y.terms),
        angles: x.angles.max(y.angles),
        degree: x.degree.max(y.degree),
        bits: x.bits.saturating_add(y.bits).saturating_add(1),
    }
}
