//! Straight-line code, over exact constants or over literals.

/// The arguments, in the order in which heads have them, and their lengths: `j` for an entry a joint,
/// `n` for one a coordinate of the velocity, `k` for ten a body, `t` for one a row of the table.
pub const ARGUMENTS: [(&str, char); 15] = [
    ("q", 'j'),
    ("qd", 'n'),
    ("qdd", 'n'),
    ("tau", 'n'),
    ("v", 'n'),
    ("a", 'n'),
    ("g", '3'),
    ("load", '0'),
    ("payload", 'p'),
    ("wrench", '6'),
    ("damping", '1'),
    ("multiplier", 'n'),
    ("bodies", 'k'),
    ("armature", 't'),
    ("viscous", 't'),
];

/// The argument that has the acceleration of gravity.
pub(crate) const GRAVITY: &str = "g";

/// The function that makes a load, and the argument that takes it.
pub(crate) const LOAD: &str = "load";

/// Returns the place of an argument.
pub fn argument(name: &str) -> Option<usize> {
    ARGUMENTS.iter().position(|argument| argument.0 == name)
}

/// An operand of an operation.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand<C> {
    /// The result of an operation before it.
    Step(usize),
    /// A constant.
    Constant(C),
    /// An entry of an argument, whose place among [`ARGUMENTS`] is first.
    Entry(usize, usize),
    /// The sine, or else the cosine, of a joint's angle.
    Sine(usize, bool),
    /// 1/√(q̇² + w²) of a coordinate.
    Speed(usize),
}

/// One operation: `+`, `-`, `*` or `/`; or `×`, a product that is not rounded, whose sum is next.
pub type Step<C> = (char, [Operand<C>; 2]);

/// A function; results may be negated.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program<C> {
    /// The operations, in order.
    pub steps: Vec<Step<C>>,
    /// The results, each with whether it is negated.
    pub outputs: Vec<(bool, Operand<C>)>,
}

impl<C> Program<C> {
    /// Returns true if some operand is such.
    pub fn reads(&self, is_such: impl Fn(&Operand<C>) -> bool) -> bool {
        let steps = self.steps.iter().flat_map(|step| &step.1);
        let outputs = self.outputs.iter().map(|output| &output.1);
        steps.chain(outputs).any(is_such)
    }

    /// Returns the values of its steps, given those of other operands; none if one of them has none.
    pub fn values<V: Clone>(
        &self,
        leaf: impl Fn(&Operand<C>) -> Option<V>,
        mut apply: impl FnMut(char, V, V) -> V,
    ) -> Option<Vec<V>> {
        let mut values: Vec<V> = Vec::with_capacity(self.steps.len());
        for (operation, operands) in &self.steps {
            let value = |operand: &Operand<C>| read(operand, &values, &leaf);
            let [a, b] = operands.each_ref().map(value);
            values.push(apply(*operation, a?, b?));
        }
        Some(values)
    }

    /// Returns its results, given the values of operands other than steps; none if one of them has
    /// none.
    pub fn run<V: Clone>(
        &self,
        leaf: impl Fn(&Operand<C>) -> Option<V>,
        apply: impl FnMut(char, V, V) -> V,
        opposite: impl Fn(V) -> V,
    ) -> Option<Vec<V>> {
        let values = self.values(&leaf, apply)?;
        let output = |(negative, operand): &(bool, Operand<C>)| {
            let value = read(operand, &values, &leaf)?;
            Some(if *negative { opposite(value) } else { value })
        };
        self.outputs.iter().map(output).collect()
    }

    /// Tells of each step whether a quotient is in it.
    pub(crate) fn has_quotients(&self) -> Vec<bool> {
        let apply = |operation: char, a: bool, b: bool| operation == '/' || a || b;
        self.values(|_| Some(false), apply).unwrap_or_default()
    }
}

fn read<C, V: Clone>(
    operand: &Operand<C>,
    values: &[V],
    leaf: impl Fn(&Operand<C>) -> Option<V>,
) -> Option<V> {
    match operand {
        Operand::Step(step) => values.get(*step).cloned(),
        operand => leaf(operand),
    }
}
