//! Runs lowered code at many states at once, with the bits of
//! [`Lowered::run`]: an operation goes through all states before the next
//! one, so that a compiler makes vectors of it. What samples by the million
//! runs here.

use std::collections::BTreeMap;

use crate::function::Argument;
use crate::program::fused::{Fusion, fusion};
use crate::program::machine::Machine;
use crate::program::{Input, Literal, Lowered, Operand, Operation, Output};
use crate::states::JointState;

/// States, coordinate by coordinate: a column a joint.
#[derive(Clone, Debug, Default)]
pub struct Columns<T> {
    /// A list of columns for each argument, in the order of [`Argument::ALL`].
    pub arguments: [Vec<Vec<T>>; Argument::COUNT],
    /// The number of states.
    pub len: usize,
}

impl<T: Machine> Columns<T> {
    /// Makes columns from states, each number rounded to the machine's.
    pub fn of(states: &[JointState]) -> Columns<T> {
        let columns = |argument: Argument| {
            let part = |state: &'_ JointState, joint: usize| T::literal(state.of(argument)[joint]);
            let joints = states.first().map_or(0, |state| state.of(argument).len());
            let column = |joint: usize| states.iter().map(|state| part(state, joint)).collect();
            (0..joints).map(column).collect()
        };
        Columns {
            arguments: Argument::ALL.map(columns),
            len: states.len(),
        }
    }
}

impl Lowered {
    /// Returns the results, a column each, in the order of the function's quantities.
    pub fn run_columns<T: Machine>(&self, states: &Columns<T>) -> Vec<Vec<T>> {
        let m = states.len;
        let trig = self.trig_columns(states);
        let mut values: Vec<T> = vec![T::literal(0.0); self.steps.len() * m];
        for (index, step) in self.steps.iter().enumerate() {
            let (before, rest) = values.split_at_mut(index * m);
            let read = |operand: &Operand<Literal>| match *operand {
                Operand::Constant(Literal(value)) => Column::All(T::literal(value)),
                Operand::Step(step) => Column::Each(&before[step * m..][..m]),
                Operand::Input(input) => Column::Each(at(states, &trig, input)),
            };
            let own = &mut rest[..m];
            match fusion(&self.steps, index) {
                None => step
                    .operation
                    .at_each(read(&step.left), read(&step.right), own),
                Some(fusion) => {
                    let (left, right) = (&fusion.product.left, &fusion.product.right);
                    fusion.at_each([left, right, fusion.addend].map(read), own);
                }
            }
        }
        let output = |output: &Output<Literal>| {
            let signed = |x: &T| if output.negative { x.neg() } else { *x };
            match output.value {
                Operand::Constant(Literal(value)) => vec![signed(&T::literal(value)); m],
                Operand::Step(step) => values[step * m..][..m].iter().map(signed).collect(),
                Operand::Input(input) => at(states, &trig, input).iter().map(signed).collect(),
            }
        };
        self.outputs.iter().map(output).collect()
    }

    fn trig_columns<T: Machine>(&self, states: &Columns<T>) -> BTreeMap<Input, Vec<T>> {
        let mut columns = BTreeMap::new();
        let positions = &states.arguments[Argument::Position.index()];
        let mut q = vec![T::literal(0.0); positions.len()];
        for trig in &self.trig {
            let (mut sines, mut cosines) = (Vec::new(), Vec::new());
            for state in 0..states.len {
                for (q, column) in q.iter_mut().zip(positions) {
                    *q = column[state];
                }
                let (sin, cos) = trig.pair(self.library, &q);
                sines.push(sin);
                cosines.push(cos);
            }
            columns.insert(Input::Sin(trig.angle), sines);
            columns.insert(Input::Cos(trig.angle), cosines);
        }
        let velocities = &states.arguments[Argument::Velocity.index()];
        let mut qd = vec![T::literal(0.0); velocities.len()];
        for speed in &self.speeds {
            let mut own = Vec::new();
            for state in 0..states.len {
                for (qd, column) in qd.iter_mut().zip(velocities) {
                    *qd = column[state];
                }
                own.extend(speed.run(&qd));
            }
            columns.insert(Input::PerSpeed(speed.joint), own);
        }
        columns
    }
}

/// Returns an input's column.
fn at<'c, T>(states: &'c Columns<T>, trig: &'c BTreeMap<Input, Vec<T>>, input: Input) -> &'c [T] {
    match input {
        Input::Entry(argument, joint) => &states.arguments[argument.index()][joint],
        other => &trig[&other],
    }
}

/// An operand of an operation over columns.
#[derive(Clone, Copy, Debug)]
pub enum Column<'c, T> {
    /// A value of each state.
    Each(&'c [T]),
    /// One for all.
    All(T),
}

impl Operation {
    /// Computes the operation at every state, in one loop: no state waits for another.
    pub fn at_each<T: Machine>(self, left: Column<'_, T>, right: Column<'_, T>, out: &mut [T]) {
        match self {
            Operation::Add => zip(out, left, right, |x, y| x.add(&y)),
            Operation::Sub => zip(out, left, right, |x, y| x.sub(&y)),
            Operation::Mul | Operation::Fused => zip(out, left, right, |x, y| x.mul(&y)),
            Operation::Div => zip(out, left, right, |x, y| x.div(&y)),
        }
    }
}

impl<C, I> Fusion<'_, C, I> {
    /// Computes the sum at every state, from the factors and what the product is added to.
    fn at_each<T: Machine>(&self, operands: [Column<'_, T>; 3], out: &mut [T]) {
        for (state, out) in out.iter_mut().enumerate() {
            let [left, right, addend] = operands.map(|column| match column {
                Column::Each(values) => values[state],
                Column::All(value) => value,
            });
            *out = self.apply(&left, &right, &addend);
        }
    }
}

#[inline]
fn zip<T: Machine>(
    out: &mut [T],
    left: Column<'_, T>,
    right: Column<'_, T>,
    f: impl Fn(T, T) -> T,
) {
    match (left, right) {
        (Column::Each(left), Column::Each(right)) => {
            for ((out, &x), &y) in out.iter_mut().zip(left).zip(right) {
                *out = f(x, y);
            }
        }
        (Column::Each(left), Column::All(y)) => {
            for (out, &x) in out.iter_mut().zip(left) {
                *out = f(x, y);
            }
        }
        (Column::All(x), Column::Each(right)) => {
            for (out, &y) in out.iter_mut().zip(right) {
                *out = f(x, y);
            }
        }
        (Column::All(x), Column::All(y)) => out.fill(f(x, y)),
    }
}

#[cfg(test)]
mod tests {
    use crate::function::Function;
    use crate::program::ScalarType;
    use crate::program::columns::*;
    use crate::program::run::State;
    use crate::states::seeded;
    use dalembert_model::robot::Robot;

    const TEXT: &str = "\
pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let a1p2 = q[0] + q[1];
    let s1p2 = libm::sin(a1p2);
    let t1 = s1 * qd[0];
    let t2 = t1 - 0.1;
    let t3 = 0.3 + c1;
    let t4 = t3 * t2;
    let t5 = s1p2 * t4;
    [-t5, qdd[1]]
}
";

    /// State by state and column by column are the same bits.
    #[test]
    fn columns_are_states() {
        let joint = dalembert_model::read::parse(
            "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, 0]\n\
             [[joint]]\nkind = \"revolute\"\nmass = 1\ncom = [0, 0, 0]\ninertia = [0, 0, 1, 0, 0, 0]\n\
             [[joint]]\nkind = \"revolute\"\nmass = 1\ncom = [0, 0, 0]\ninertia = [0, 0, 1, 0, 0, 0]\n",
            &dalembert_model::read::Options::default(),
        );
        let robot: Robot = joint.unwrap().robot;
        let states = seeded(&robot, 33, 5);
        let text = Lowered::parse(TEXT, Function::InverseDynamics, ScalarType::F64).unwrap();
        let columns = text.run_columns(&Columns::<f64>::of(&states));
        for (k, state) in states.iter().enumerate() {
            let one = text.run(State::of(|argument| state.of(argument)));
            for (i, x) in one.iter().enumerate() {
                assert_eq!(x.to_bits(), columns[i][k].to_bits());
            }
        }
    }
}
