//! A function as a processor meets it: what is done, in the printed order, over
//! values that are read and written.

use std::collections::BTreeMap;

use dalembert_codegen::workspace::function::Argument;
use dalembert_codegen::workspace::program::fused::fusion;
use dalembert_codegen::workspace::program::kernel::{Angle, Kernel};
use dalembert_codegen::workspace::program::{
    AngleSum, Input, Library, Literal, Lowered, LoweredTrig, Operand, Operation, Output, Step,
};

/// Where a value is before it is read for the first time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Home {
    /// In an argument.
    Argument,
    /// Nowhere: it is a constant.
    Constant(f64),
    /// Where it is computed.
    Computed,
    /// In an array that a call wrote.
    Array,
}

/// An action at a place of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deed {
    /// Arithmetic.
    Operation(Operation),
    /// A product and a sum that is rounded with it, of either sign: it reads the
    /// factors, then what their product is added to.
    Fused,
    /// The other sign.
    Negation,
    /// A call of a function of the library: an angle, its sine, its cosine or both;
    /// a square, its root.
    Call,
    /// A call of one for all angles, which are put into an array.
    CallTogether,
    /// A result is put where the caller wants it.
    Return,
}

/// A place of the text. Values are named by their number.
#[derive(Clone, Debug)]
pub struct Item {
    /// The action.
    pub deed: Deed,
    /// The values that it reads, left before right.
    pub reads: Vec<usize>,
    /// The values that it writes.
    pub writes: Vec<usize>,
}

/// A function, item by item.
#[derive(Clone, Debug, Default)]
pub struct Flat {
    /// Every value's home.
    pub values: Vec<Home>,
    /// The actions on them, in the printed order.
    pub items: Vec<Item>,
}

impl Flat {
    /// Reads the printed text.
    pub fn of(text: &Lowered) -> Flat {
        let mut writer = Writer::default();
        writer.sines(text);
        writer.speeds(text);
        writer.steps(text);
        writer.flat
    }

    /// Returns, for every value, the items that read it, ascending; an item that reads it twice
    /// is there once.
    pub fn uses(&self) -> Vec<Vec<usize>> {
        let mut uses = vec![Vec::new(); self.values.len()];
        for (place, item) in self.items.iter().enumerate() {
            for &value in &item.reads {
                if uses[value].last() != Some(&place) {
                    uses[value].push(place);
                }
            }
        }
        uses
    }
}

/// Writes a function item by item. An entry of an argument is one value, and so is a constant.
#[derive(Default)]
struct Writer {
    flat: Flat,
    inputs: BTreeMap<Input, usize>,
    constants: BTreeMap<u64, usize>,
    steps: Vec<usize>,
}

impl Writer {
    fn value(&mut self, home: Home) -> usize {
        self.flat.values.push(home);
        self.flat.values.len() - 1
    }

    fn item(&mut self, deed: Deed, reads: Vec<usize>, writes: Vec<usize>) {
        self.flat.items.push(Item {
            deed,
            reads,
            writes,
        });
    }

    fn operation(&mut self, operation: Operation, left: usize, right: usize) -> usize {
        let result = self.value(Home::Computed);
        self.item(Deed::Operation(operation), vec![left, right], vec![result]);
        result
    }

    fn signed(&mut self, negative: bool, value: usize) -> usize {
        if !negative {
            return value;
        }
        let result = self.value(Home::Computed);
        self.item(Deed::Negation, vec![value], vec![result]);
        result
    }

    fn input(&mut self, input: Input) -> usize {
        if let Some(&value) = self.inputs.get(&input) {
            return value;
        }
        let value = self.value(Home::Argument);
        self.inputs.insert(input, value);
        value
    }

    fn constant(&mut self, literal: Literal) -> usize {
        let bits = literal.0.to_bits();
        if let Some(&value) = self.constants.get(&bits) {
            return value;
        }
        let value = self.value(Home::Constant(literal.0));
        self.constants.insert(bits, value);
        value
    }

    fn operand(&mut self, operand: &Operand<Literal>) -> usize {
        match operand {
            Operand::Input(input) => self.input(*input),
            Operand::Constant(literal) => self.constant(*literal),
            // Operands come before their users.
            Operand::Step(step) => self.steps[*step],
        }
    }

    fn sines(&mut self, text: &Lowered) {
        let mut together = Vec::new();
        for trig in &text.trig {
            let angle = self.angle(trig.angle);
            match (&trig.kernel, text.library) {
                (Some(kernel), _) => self.polynomials(trig, angle, kernel),
                (None, Library::Libm) => {
                    let writes = self.named(trig, Home::Computed);
                    self.item(Deed::Call, vec![angle], writes);
                }
                (None, Library::Together) => together.push((trig, angle)),
            }
        }
        if together.is_empty() {
            return;
        }
        let mut writes = Vec::new();
        for (trig, _) in &together {
            writes.extend(self.named(trig, Home::Array));
        }
        let angles = together.into_iter().map(|(_, angle)| angle).collect();
        self.item(Deed::CallTogether, angles, writes);
    }

    /// Returns the values of an angle's sine and cosine, where they are wanted.
    fn named(&mut self, trig: &LoweredTrig, home: Home) -> Vec<usize> {
        let sin = trig.sin.then_some(Input::Sin(trig.angle));
        let cos = trig.cos.then_some(Input::Cos(trig.angle));
        let names = [sin, cos].into_iter().flatten();
        let named = names.map(|name| {
            let value = self.value(home);
            self.inputs.insert(name, value);
            value
        });
        named.collect()
    }

    /// Returns a sum of angles, term by term.
    fn angle(&mut self, angle: AngleSum) -> usize {
        let mut sum = None;
        for (joint, negative) in angle.terms() {
            let term = self.input(Input::Entry(Argument::Position, joint));
            sum = Some(match (sum, negative) {
                (None, negative) => self.signed(negative, term),
                (Some(sum), false) => self.operation(Operation::Add, sum, term),
                (Some(sum), true) => self.operation(Operation::Sub, sum, term),
            });
        }
        // An angle is the sum of one joint's at least.
        sum.unwrap_or_default()
    }

    /// Counts one over the root of a velocity's square and a width's, for Coulomb friction.
    fn speeds(&mut self, text: &Lowered) {
        for speed in &text.speeds {
            let qd = self.input(Input::Entry(Argument::Velocity, speed.joint));
            let own = self.operation(Operation::Mul, qd, qd);
            let width = self.constant(speed.square);
            let sum = self.operation(Operation::Add, own, width);
            let root = self.value(Home::Computed);
            self.item(Deed::Call, vec![sum], vec![root]);
            let one = self.constant(Literal(1.0));
            let inverse = self.operation(Operation::Div, one, root);
            self.inputs.insert(Input::PerSpeed(speed.joint), inverse);
        }
    }

    fn polynomials(&mut self, trig: &LoweredTrig, angle: usize, kernel: &Kernel) {
        let mut steps: Vec<usize> = Vec::new();
        for step in &kernel.steps {
            let Step {
                operation,
                left,
                right,
            } = step;
            let (left, right) = (
                self.term(left, angle, &steps),
                self.term(right, angle, &steps),
            );
            let result = self.operation(*operation, left, right);
            steps.push(result);
        }
        for (result, name) in [
            (&kernel.sin, Input::Sin(trig.angle)),
            (&kernel.cos, Input::Cos(trig.angle)),
        ] {
            if let Some(Output { negative, value }) = result {
                let value = self.term(value, angle, &steps);
                let value = self.signed(*negative, value);
                self.inputs.insert(name, value);
            }
        }
    }

    fn term(&mut self, term: &Operand<Literal, Angle>, angle: usize, steps: &[usize]) -> usize {
        match term {
            Operand::Input(Angle) => angle,
            Operand::Constant(literal) => self.constant(*literal),
            Operand::Step(step) => steps[*step],
        }
    }

    fn steps(&mut self, text: &Lowered) {
        for (index, step) in text.steps.iter().enumerate() {
            let result = match fusion(&text.steps, index) {
                // With its sum: nobody else reads it.
                None if step.operation == Operation::Fused => usize::MAX,
                None => {
                    let (left, right) = (self.operand(&step.left), self.operand(&step.right));
                    self.operation(step.operation, left, right)
                }
                Some(fusion) => {
                    let (left, right) = (&fusion.product.left, &fusion.product.right);
                    let reads = [left, right, fusion.addend].map(|operand| self.operand(operand));
                    let result = self.value(Home::Computed);
                    self.item(Deed::Fused, reads.to_vec(), vec![result]);
                    result
                }
            };
            self.steps.push(result);
        }
        // They are all returned at the end, as printed; one that is negated for
        // several results is negated once.
        let mut negated = BTreeMap::new();
        for output in &text.outputs {
            let value = self.operand(&output.value);
            let value = match output.negative {
                false => value,
                true => match negated.get(&value) {
                    Some(&negative) => negative,
                    None => {
                        let negative = self.signed(true, value);
                        negated.insert(value, negative);
                        negative
                    }
                },
            };
            self.item(Deed::Return, vec![value], Vec::new());
        }
    }
}
