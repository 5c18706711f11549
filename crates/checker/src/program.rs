//! Straight-line code, over exact constants or over literals.

/// The arguments, in the order in which heads have them, and their lengths.
pub const ARGUMENTS: [(&str, char); 12] = [
    ("q", 'n'),
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
];

/// Returns the place of an argument.
pub fn argument(name: &str) -> Option<usize> {
    ARGUMENTS.iter().position(|own| own.0 == name)
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
    /// 1/√(q̇² + w²) of a joint.
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
        let steps = self.steps.iter().flat_map(|own| &own.1);
        let outputs = self.outputs.iter().map(|own| &own.1);
        steps.chain(outputs).any(is_such)
    }

    /// Returns its results, given the values of operands other than steps; none if one of them has
    /// none.
    pub fn run<V: Clone>(
        &self,
        leaf: impl Fn(&Operand<C>) -> Option<V>,
        mut apply: impl FnMut(char, V, V) -> V,
        opposite: impl Fn(V) -> V,
    ) -> Option<Vec<V>> {
        let mut values: Vec<V> = Vec::with_capacity(self.steps.len());
        let read = |values: &[V], own: &Operand<C>| match own {
            Operand::Step(step) => values.get(*step).cloned(),
            own => leaf(own),
        };
        for (operation, [left, right]) in &self.steps {
            let value = apply(*operation, read(&values, left)?, read(&values, right)?);
            values.push(value);
        }
        let output = |(negative, own): &(bool, Operand<C>)| {
            let value = read(&values, own)?;
            Some(if *negative { opposite(value) } else { value })
        };
        self.outputs.iter().map(output).collect()
    }
}
