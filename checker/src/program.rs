//! Straight-line code, over exact constants or over literals; its residues and its degree.

#[cfg(feature = "certify")]
use crate::identity::{
    exact::{Exact, Point},
    number::Number,
    state::State,
};

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

#[cfg(feature = "certify")]
impl Program<Exact> {
    /// Returns its results at a point.
    pub fn residues(&self, point: &Point, state: &State) -> Option<Vec<Number>> {
        let leaf = |own: &Operand<Exact>| match own {
            Operand::Constant(constant) => Some(point.constant(constant)),
            Operand::Entry(argument, index) => state.given.get(*argument)?.get(*index).copied(),
            Operand::Sine(joint, is_sine) => Some(state.pairs.get(*joint)?[usize::from(!is_sine)]),
            Operand::Speed(joint) => state.speeds.get(*joint).copied(),
            Operand::Step(_) => None,
        };
        let apply = |operation: char, a: Number, b: Number| match operation {
            '+' => a + b,
            '-' => a - b,
            '*' | '×' => a * b,
            _ => a / b,
        };
        self.run(leaf, apply, |own: Number| -own)
    }

    /// Returns at least the degrees of numerator and denominator of its results, in inputs, sines
    /// and constants; infinite beyond a double's range.
    ///
    /// A value is a polynomial in these and in 1/d of each divisor d, which is one in those before
    /// it: a list of degrees. Multiplied by each divisor as often as it occurs, the last first, it
    /// has none.
    pub fn degree(&self) -> f64 {
        let mut divisors = Vec::<Vec<f64>>::new();
        let zip = |a: Vec<f64>, b: Vec<f64>, pick: fn(f64, f64) -> f64| {
            let at = |list: &[f64], k: usize| list.get(k).copied().unwrap_or(0.0);
            let both = (0..a.len().max(b.len())).map(|k| pick(at(&a, k), at(&b, k)));
            both.collect::<Vec<f64>>()
        };
        let leaf = |_: &Operand<Exact>| Some(vec![1.0]);
        let apply = |operation: char, a: Vec<f64>, b: Vec<f64>| match operation {
            '+' | '-' => zip(a, b, f64::max),
            '*' | '×' => zip(a, b, |a, b| a + b),
            _ => {
                divisors.push(b);
                let mut inverse = vec![0.0; divisors.len()];
                inverse.push(1.0);
                zip(a, inverse, |a, b| a + b)
            }
        };
        let all = self.run(leaf, apply, |own| own).unwrap_or_default();
        let largest = |mut own: Vec<f64>| {
            let mut under = 0.0;
            for (index, divisor) in divisors.iter().enumerate().rev() {
                let times = own.get(index + 1).copied().unwrap_or(0.0);
                // Beyond a double's range nothing times infinity is nothing, too.
                let product = |x: &f64| match *x == 0.0 || times == 0.0 {
                    true => 0.0,
                    false => x * times,
                };
                under += product(&divisor[0]);
                own = zip(own, divisor.iter().map(product).collect(), |a, b| a + b);
            }
            own[0].max(under)
        };
        all.into_iter().map(largest).fold(0.0, f64::max)
    }
}
