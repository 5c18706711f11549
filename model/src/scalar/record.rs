//! A formula as it is executed, to run it again in other scalars.
//!
//! A formula that is generic over its scalar can do with it what [`Scalar`] and
//! [`Divide`] offer and nothing else: it cannot look at a value, compare two, or
//! decide anything by one. So whatever the values are it asks for the same
//! operations in the same order, and a list of them *is* the formula. Running the
//! list in a scalar calls that scalar's own operations, one for one: nothing is
//! folded, shared, reordered or rewritten on the way.
//!
//! The one thing that a formula may ask is whether a value is zero or one *by
//! structure*, and it answers for every state and every scalar at once: yes for the
//! exact constants 0 and 1, and for numbers that the formula makes of `S::zero()` and
//! `S::one()` alone ([`Dyadic`]), which have no inputs to depend on. What a formula
//! leaves out for such a zero or one, it may leave out in any scalar. (Floats would
//! not have left it out; 0·x and 1·x change nothing there either, but for the sign of
//! a zero and an x that is no number.)
//!
//! Values whose only readers are left out themselves are not computed, and a place is
//! used again once its value was read for the last time.

use alloc::rc::Rc;
use alloc::vec::Vec;
use core::cell::RefCell;

use super::dyadic::Dyadic;
use super::{Divide, Scalar};

/// An operation over places of values.
#[derive(Clone, Copy, Debug)]
enum Call {
    /// An input or a constant, by its number.
    Leaf(u32),
    Number(Dyadic),
    Add(u32, u32),
    Sub(u32, u32),
    Mul(u32, u32),
    /// a · b + c
    MulAdd(u32, u32, u32),
    Div(u32, u32),
    Neg(u32),
    Half(u32),
    /// A number beyond its range, or a mixture of two recordings: there is no value.
    Lost,
}

/// A value that a recording begins with.
#[derive(Clone, Debug)]
enum Leaf<I, C> {
    Input(I),
    Constant(C),
}

/// Operations so far, operands before users.
#[derive(Clone, Debug)]
struct Tape<I, C> {
    calls: Vec<Call>,
    leaves: Vec<Leaf<I, C>>,
}

/// Records what is computed from its inputs and constants, which know whether they are
/// zero or one.
#[derive(Debug)]
pub struct Recorder<I, C>(Rc<RefCell<Tape<I, C>>>);

/// The scalar that records.
#[derive(Debug)]
pub struct Recorded<I, C>(Form<I, C>);

#[derive(Debug)]
enum Form<I, C> {
    Number(Dyadic),
    Taped(Rc<RefCell<Tape<I, C>>>, u32),
    Lost,
}

/// A formula's operations, from inputs and constants to its results.
#[derive(Clone, Debug)]
pub struct Recording<I, C> {
    leaves: Vec<Leaf<I, C>>,
    /// Each with the place of its value.
    calls: Vec<(Call, u32)>,
    places: usize,
    /// The places of the results.
    outputs: Vec<u32>,
}

impl<I, C> Default for Recorder<I, C> {
    fn default() -> Self {
        let (calls, leaves) = (Vec::new(), Vec::new());
        Recorder(Rc::new(RefCell::new(Tape { calls, leaves })))
    }
}

impl<I, C: Scalar> Recorder<I, C> {
    /// Returns nothing recorded yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns an input.
    pub fn input(&self, input: I) -> Recorded<I, C> {
        self.leaf(Leaf::Input(input))
    }

    /// Returns a constant. Zero is a number, and is zero by structure.
    pub fn constant(&self, constant: &C) -> Recorded<I, C> {
        match constant.is_zero() {
            true => Recorded::zero(),
            false => self.leaf(Leaf::Constant(constant.clone())),
        }
    }

    fn leaf(&self, leaf: Leaf<I, C>) -> Recorded<I, C> {
        let number = {
            let leaves = &mut self.0.borrow_mut().leaves;
            leaves.push(leaf);
            place(leaves.len())
        };
        push(&self.0, Call::Leaf(number))
    }

    /// Returns what was recorded, with these as its results.
    pub fn finish(self, outputs: &[Recorded<I, C>]) -> Recording<I, C> {
        let outputs = outputs.iter();
        let outputs: Vec<u32> = outputs.map(|output| output.enter(&self.0)).collect();
        let (calls, leaves) = {
            let mut tape = self.0.borrow_mut();
            (
                core::mem::take(&mut tape.calls),
                core::mem::take(&mut tape.leaves),
            )
        };
        placed(leaves, &calls, &outputs)
    }
}

/// Returns the number of the last of so many. A formula of 2³² operations would not end.
fn place(length: usize) -> u32 {
    (length - 1) as u32
}

fn push<I, C>(tape: &Rc<RefCell<Tape<I, C>>>, call: Call) -> Recorded<I, C> {
    let at = {
        let calls = &mut tape.borrow_mut().calls;
        calls.push(call);
        place(calls.len())
    };
    Recorded(Form::Taped(tape.clone(), at))
}

impl Call {
    /// Returns the same over other places.
    fn map(self, mut f: impl FnMut(u32) -> u32) -> Call {
        match self {
            Call::Leaf(_) | Call::Number(_) | Call::Lost => self,
            Call::Add(a, b) => Call::Add(f(a), f(b)),
            Call::Sub(a, b) => Call::Sub(f(a), f(b)),
            Call::Mul(a, b) => Call::Mul(f(a), f(b)),
            Call::MulAdd(a, b, c) => Call::MulAdd(f(a), f(b), f(c)),
            Call::Div(a, b) => Call::Div(f(a), f(b)),
            Call::Neg(a) => Call::Neg(f(a)),
            Call::Half(a) => Call::Half(f(a)),
        }
    }
}

/// Steps that are read, each with a place that nothing needs any longer.
fn placed<I, C>(leaves: Vec<Leaf<I, C>>, calls: &[Call], outputs: &[u32]) -> Recording<I, C> {
    // The last reader of each call; results are read at the end, others never.
    let mut last: Vec<Option<usize>> = alloc::vec![None; calls.len()];
    for &output in outputs {
        last[output as usize] = Some(calls.len());
    }
    for (index, call) in calls.iter().enumerate().rev() {
        if last[index].is_some() {
            call.map(|operand| {
                last[operand as usize].get_or_insert(index);
                operand
            });
        }
    }
    let mut places: Vec<u32> = alloc::vec![0; calls.len()];
    let (mut free, mut length) = (Vec::new(), 0);
    let mut kept = Vec::new();
    for (index, call) in calls.iter().enumerate() {
        if last[index].is_none() {
            continue;
        }
        let own = call.map(|operand| {
            let at = places[operand as usize];
            if last[operand as usize] == Some(index) {
                // Read twice by one call, it is free once.
                last[operand as usize] = None;
                free.push(at);
            }
            at
        });
        places[index] = free.pop().unwrap_or_else(|| {
            length += 1;
            place(length)
        });
        kept.push((own, places[index]));
    }
    let output = |&output: &u32| places[output as usize];
    Recording {
        leaves,
        calls: kept,
        places: length,
        outputs: outputs.iter().map(output).collect(),
    }
}

impl<I, C> Recording<I, C> {
    /// Returns the same over other constants, such as rounded ones.
    pub fn with_constants<D>(self, mut of: impl FnMut(&C) -> D) -> Recording<I, D> {
        let leaves = self.leaves.into_iter().map(|leaf| match leaf {
            Leaf::Input(input) => Leaf::Input(input),
            Leaf::Constant(constant) => Leaf::Constant(of(&constant)),
        });
        Recording {
            leaves: leaves.collect(),
            calls: self.calls,
            places: self.places,
            outputs: self.outputs,
        }
    }

    /// Returns the results in a scalar, from the values of inputs and constants, asked for
    /// once each in the order of the formula; `None` if a constant has none.
    pub fn run<S: Divide>(
        &self,
        mut input: impl FnMut(&I) -> S,
        mut constant: impl FnMut(&C) -> Option<S>,
    ) -> Option<Vec<S>> {
        let leaves = self.leaves.iter().map(|leaf| match leaf {
            Leaf::Input(name) => Some(input(name)),
            Leaf::Constant(value) => constant(value),
        });
        let leaves: Vec<S> = leaves.collect::<Option<_>>()?;
        let mut values: Vec<S> = alloc::vec![S::zero(); self.places];
        for (call, place) in &self.calls {
            let at = |operand: u32| &values[operand as usize];
            let value = match *call {
                Call::Leaf(number) => leaves[number as usize].clone(),
                Call::Number(number) => of_number(number),
                Call::Add(a, b) => at(a).add(at(b)),
                Call::Sub(a, b) => at(a).sub(at(b)),
                Call::Mul(a, b) => at(a).mul(at(b)),
                Call::MulAdd(a, b, c) => at(a).mul_add(at(b), at(c)),
                Call::Div(a, b) => at(a).div(at(b)),
                Call::Neg(a) => at(a).neg(),
                Call::Half(a) => at(a).half(),
                // As each scalar says that there is no value.
                Call::Lost => S::one().div(&S::zero()),
            };
            values[*place as usize] = value;
        }
        let output = |place: &u32| values[*place as usize].clone();
        Some(self.outputs.iter().map(output).collect())
    }
}

/// Returns the number, made of one as a formula would.
fn of_number<S: Scalar>(number: Dyadic) -> S {
    let size = number.units().unsigned_abs();
    if size == 0 {
        return S::zero();
    }
    let below_the_first = (0..size.ilog2()).rev();
    let size = below_the_first.fold(S::one(), |high, bit| {
        let twice = high.double();
        match size >> bit & 1 {
            0 => twice,
            _ => twice.add(&S::one()),
        }
    });
    let value = if number.units() < 0 { size.neg() } else { size };
    (0..number.halvings()).fold(value, |value, _| value.half())
}

impl<I, C> Recorded<I, C> {
    /// Returns where its value is on a tape.
    fn enter(&self, tape: &Rc<RefCell<Tape<I, C>>>) -> u32 {
        let call = match &self.0 {
            Form::Taped(own, at) if Rc::ptr_eq(own, tape) => return *at,
            Form::Taped(..) | Form::Lost => Call::Lost,
            Form::Number(number) => Call::Number(*number),
        };
        let calls = &mut tape.borrow_mut().calls;
        calls.push(call);
        place(calls.len())
    }

    fn number(x: Option<Dyadic>) -> Self {
        Recorded(x.map_or(Form::Lost, Form::Number))
    }

    /// Returns an operation of two values: on the tape if either is on one.
    fn combine(
        &self,
        other: &Self,
        numbers: impl Fn(Dyadic, Dyadic) -> Option<Dyadic>,
        call: impl Fn(u32, u32) -> Call,
    ) -> Self {
        match (&self.0, &other.0) {
            (Form::Taped(tape, _), _) | (_, Form::Taped(tape, _)) => {
                let (a, b) = (self.enter(tape), other.enter(tape));
                push(tape, call(a, b))
            }
            (Form::Number(a), Form::Number(b)) => Self::number(numbers(*a, *b)),
            _ => Recorded(Form::Lost),
        }
    }

    fn apply(&self, number: impl Fn(Dyadic) -> Option<Dyadic>, call: impl Fn(u32) -> Call) -> Self {
        match &self.0 {
            Form::Taped(tape, at) => push(tape, call(*at)),
            Form::Number(x) => Self::number(number(*x)),
            Form::Lost => Recorded(Form::Lost),
        }
    }
}

impl<I, C> Clone for Recorded<I, C> {
    fn clone(&self) -> Self {
        Recorded(match &self.0 {
            Form::Number(number) => Form::Number(*number),
            Form::Taped(tape, at) => Form::Taped(tape.clone(), *at),
            Form::Lost => Form::Lost,
        })
    }
}

impl<I, C: Scalar> Scalar for Recorded<I, C> {
    fn zero() -> Self {
        Recorded(Form::Number(Dyadic::ZERO))
    }
    fn one() -> Self {
        Recorded(Form::Number(Dyadic::ONE))
    }
    fn add(&self, other: &Self) -> Self {
        self.combine(other, Dyadic::checked_add, Call::Add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a.checked_add(b.checked_neg()?), Call::Sub)
    }
    fn mul(&self, other: &Self) -> Self {
        self.combine(other, Dyadic::checked_mul, Call::Mul)
    }
    fn neg(&self) -> Self {
        self.apply(Dyadic::checked_neg, Call::Neg)
    }
    fn half(&self) -> Self {
        self.apply(Dyadic::half, Call::Half)
    }
    fn is_zero(&self) -> bool {
        matches!(&self.0, Form::Number(x) if x.is_zero())
    }
    fn is_one(&self) -> bool {
        match &self.0 {
            Form::Number(x) => x.is_one(),
            Form::Taped(tape, at) => {
                let tape = tape.borrow();
                match tape.calls.get(*at as usize) {
                    Some(Call::Leaf(number)) => matches!(
                        tape.leaves.get(*number as usize),
                        Some(Leaf::Constant(constant)) if constant.is_one()
                    ),
                    _ => false,
                }
            }
            Form::Lost => false,
        }
    }
    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        let of = [self, factor, addend];
        let tape = of.iter().find_map(|x| match &x.0 {
            Form::Taped(tape, _) => Some(tape),
            _ => None,
        });
        match tape {
            None => self.mul(factor).add(addend),
            Some(tape) => {
                let [a, b, c] = of.map(|x| x.enter(tape));
                push(tape, Call::MulAdd(a, b, c))
            }
        }
    }
}

impl<I, C: Scalar> Divide for Recorded<I, C> {
    /// Returns Divides; of two numbers the quotient is lost, unless it is by one.
    fn div(&self, other: &Self) -> Self {
        self.combine(other, |a, b| b.is_one().then_some(a), Call::Div)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Exact, Rational};
    use crate::scalar::count::Counter;
    use crate::scalar::field::{Field, Points};

    /// Returns a formula with every operation, values that are read again and again, and some
    /// that nobody reads.
    fn formula<S: Divide>(x: &[S]) -> Vec<S> {
        let mut sums = alloc::vec![x[0].clone()];
        for k in 1..40 {
            let (a, b) = (&sums[k - 1], &sums[k / 2]);
            let next = match k % 6 {
                0 => a.add(b),
                1 => a.sub(&x[k % x.len()].mul(b)),
                2 => a.mul_add(b, &x[k % x.len()]),
                3 => a.div(&b.double()).neg(),
                4 => a.half().mul(&a.add(&S::one().double().neg())),
                _ => a.mul(a),
            };
            let _unread = next.mul(b);
            sums.push(next);
        }
        let last = sums.last().cloned();
        alloc::vec![sums[7].clone(), S::one().half(), sums[20].clone()]
            .into_iter()
            .chain(last)
            .collect()
    }

    fn recorded(length: usize) -> Recording<usize, Exact> {
        let recorder = Recorder::new();
        let inputs: Vec<_> = (0..length).map(|i| recorder.input(i)).collect();
        let outputs = formula(&inputs);
        recorder.finish(&outputs)
    }

    #[test]
    fn runs_as_the_formula_does() {
        let recording = recorded(5);
        let mut points = Points::new(0x7ec);
        let x: Vec<Field> = (0..5).map(|_| points.field()).collect();
        let found = recording.run(|&i| x[i], |_| None);
        assert_eq!(found, Some(formula(&x)));
        // Bit for bit, so in the formula's order and fused where it fuses.
        let x: Vec<f64> = (0..5).map(|_| points.unit()).collect();
        let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
        let found = recording.run(|&i| x[i], |_| None).map(bits);
        assert_eq!(found, Some(bits(formula(&x))));
        assert!(recording.places < recording.calls.len() / 2);
    }

    /// As many operations as the formula has, less those that nobody reads.
    #[test]
    fn operations_are_one_for_one() {
        let (own, again) = (Counter::new(), Counter::new());
        formula(&[(); 5].map(|()| own.value()));
        let run = recorded(5).run(|_| again.value(), |_| None);
        assert_eq!(run.map(|values| values.len()), Some(4));
        assert_eq!(again.divisions(), own.divisions());
        assert_eq!(again.additions(), own.additions());
        assert_eq!(again.multiplications(), own.multiplications() - 39);
    }

    #[test]
    fn structure_is_what_every_scalar_has() {
        let recorder = Recorder::new();
        let of = |x: i64| Exact::from(Rational::from_integer(x.into()));
        let [zero, one, two] = [0, 1, 2].map(|x| recorder.constant(&of(x)));
        let x = recorder.input(0);
        assert!(zero.is_zero() && one.is_one() && !two.is_zero() && !two.is_one());
        assert!(!x.is_zero() && !x.sub(&x).is_zero() && !one.mul(&one).is_one());
        assert!(!one.sub(&one).is_zero() && !x.mul(&zero).is_zero());
        type Own = Recorded<usize, Exact>;
        assert!(Own::one().sub(&Own::one()).is_zero() && Own::one().neg().neg().is_one());
        let recording = recorder.finish(&[two.mul(&x)]);
        assert_eq!(
            recording.run(|_| 3.0, |_| Some(2.0)),
            Some(alloc::vec![6.0])
        );
        // A constant without a value leaves nothing, whoever reads it.
        assert_eq!(
            recording.run(|_| 3.0, |x| (!x.is_one()).then_some(2.0)),
            None
        );
    }

    /// No value rather than a wrong one: quotients of numbers, what is beyond their
    /// range, and what is of another recording.
    #[test]
    fn what_cannot_be_recorded_is_lost() {
        type Own = Recorded<usize, Exact>;
        let recorder = Recorder::new();
        let x = recorder.input(0);
        let mut large = Own::one();
        for _ in 0..64 {
            large = large.double();
        }
        let other = Recorder::new().input(0);
        let third = Own::one().div(&Own::one().add(&Own::one().double()));
        let lost = [large, other, third].map(|lost| x.add(&lost));
        let run = recorder.finish(&lost).run(|_| 1.0f64, |_| None).unwrap();
        assert!(run.iter().all(|value| !value.is_finite()), "{run:?}");
    }
}
