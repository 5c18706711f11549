//! What a text computes, as polynomials: exactly as real numbers, and at most how far
//! the floating-point values are from that.

use crate::certificate::Claim;
use crate::fault::Fault;
use crate::interval::Interval;
use crate::number::Number;
use crate::polynomial::{MAX_JOINTS, Polynomial, SLACK, Variable, Work};
use crate::program::{Angle, Node, Program, Source};
use crate::ring::Ring;
use crate::scene::Setting;
use crate::sines::{self, Scalar};

/// A value of the text.
#[derive(Clone, Debug)]
pub struct Value {
    /// The real number that it stands for, with the error of sines by polynomials as
    /// variables.
    pub exact: Polynomial,
    /// The largest magnitude of that.
    pub size: f64,
    /// How far the computed number is from it at most.
    pub error: f64,
}

struct Values<'a> {
    ring: &'a Ring,
    setting: &'a Setting,
    claim: &'a Claim,
    program: &'a Program,
    scalar: Scalar,
    /// How many of q, q̇ and q̈ are arguments.
    arguments: usize,
    /// How many errors of sines have a variable of their own.
    errors: usize,
}

/// Returns the outputs of a text over a box.
///
/// # Errors
/// A text that reads what it may not, or polynomials that are too long.
pub fn outputs(
    program: &Program,
    setting: &Setting,
    claim: &Claim,
    ring: &Ring,
    work: &mut Work,
) -> Result<Vec<Value>, Fault> {
    let scalar = Scalar::of(&claim.scalar);
    let mut values = Values {
        ring,
        setting,
        claim,
        program,
        scalar,
        arguments: claim.function()?.arguments(),
        errors: 0,
    };
    let angles = program.angles(|joint| setting.joints[joint].turns);
    let mut all = Vec::with_capacity(program.nodes.len());
    for (&node, angle) in program.nodes.iter().zip(&angles) {
        let value = match (node, angle) {
            (Node::Input(argument, joint), _) => values.input(argument, joint)?,
            (_, Some(_)) => None,
            _ => Some(values.value(node, &all, &angles, work)?),
        };
        all.push(value);
    }
    let output = |&node: &usize| number(&all, node).cloned();
    program.outputs.iter().map(output).collect()
}

fn number(all: &[Option<Value>], node: usize) -> Result<&Value, Fault> {
    let value = all.get(node).and_then(Option::as_ref);
    value.ok_or_else(|| Fault::certificate("the text uses the angle of a joint as a number"))
}

impl Values<'_> {
    /// Returns a value that is no angle.
    fn value(
        &mut self,
        node: Node,
        all: &[Option<Value>],
        angles: &[Option<Angle>],
        work: &mut Work,
    ) -> Result<Value, Fault> {
        Ok(match node {
            Node::Constant(value) => exact(Polynomial::constant(value.into()), value.abs()),
            Node::Neg(a) => {
                let a = number(all, a)?;
                Value {
                    exact: a.exact.negated(),
                    ..*a
                }
            }
            Node::Add(a, b) | Node::Sub(a, b) => {
                let minus = matches!(node, Node::Sub(..));
                let (a, b) = (number(all, a)?, number(all, b)?);
                let negated = minus.then(|| b.exact.negated());
                let exact = a.exact.plus(negated.as_ref().unwrap_or(&b.exact));
                let size = self.ring.size(&exact).min((a.size + b.size) * SLACK);
                let error = self.scalar.rounded(size, a.error + b.error);
                Value { exact, size, error }
            }
            Node::Mul(a, b) | Node::Fused(a, b, _) => {
                let (a, b) = (number(all, a)?, number(all, b)?);
                let mut exact = a.exact.times(&b.exact, work)?;
                let mut size = a.size * b.size * SLACK;
                let mut inherited = a.error * b.size + b.error * a.size + a.error * b.error;
                if let Node::Fused(_, _, c) = node {
                    let c = number(all, c)?;
                    exact = exact.plus(&c.exact);
                    (size, inherited) = ((size + c.size) * SLACK, inherited + c.error);
                }
                let size = self.ring.size(&exact).min(size);
                let error = self.scalar.rounded(size, inherited * SLACK);
                Value { exact, size, error }
            }
            Node::Sine(a, is_sine, source) => {
                let why = "a sine of something that is no angle";
                let angle = angles[a].as_ref().ok_or(Fault::certificate(why))?;
                self.sine(angle, is_sine, source, work)?
            }
            Node::Div(..) | Node::Input(..) => return Err(Fault::certificate("the text divides")),
        })
    }

    /// Returns an entry of an argument; `None` of an angle.
    fn input(&self, argument: usize, joint: usize) -> Result<Option<Value>, Fault> {
        let state = &self.ring.states[joint];
        let is_still = argument > 0 && self.setting.still[argument - 1];
        let why = match self.setting.locks[joint] {
            _ if argument >= self.arguments || is_still => {
                "the text reads rates that the function, or the scene, has not".to_owned()
            }
            Some(_) => format!("the text reads joint {}, which is locked", joint + 1),
            None => {
                let is_angle = argument == 0 && self.setting.joints[joint].turns;
                let all = [&state.position, &state.velocity, &state.acceleration];
                let value = all.get(argument).copied().filter(|_| !is_angle);
                return Ok(value.map(|value| exact(value.clone(), self.ring.size(value))));
            }
        };
        Err(Fault::certificate(why))
    }

    /// Returns a sine or cosine of a sum of angles, with what it is off.
    fn sine(
        &mut self,
        joints: &[(usize, bool)],
        is_sine: bool,
        source: Source,
        work: &mut Work,
    ) -> Result<Value, Fault> {
        let (mut sin, mut cos) = (Polynomial::default(), Polynomial::one());
        let mut range = Interval::point(0.0);
        for &(joint, negative) in joints {
            let state = &self.ring.states[joint];
            let (own, own_cos) = (&state.sin, &state.cos);
            let [low, high] = self.claim.position[joint];
            let own_range = Interval::new(low, high);
            range = range + if negative { -own_range } else { own_range };
            let own = if negative { own.negated() } else { own.clone() };
            let turned = sin.times(own_cos, work)?.plus(&cos.times(&own, work)?);
            let across = sin.times(&own, work)?.negated();
            (cos, sin) = (cos.times(own_cos, work)?.plus(&across), turned);
        }
        // Each sum of angles is rounded, and a sine changes by no more than its angle.
        let sums = (joints.len() - 1) as f64;
        let rounded = 2.0 * sums * sums * self.scalar.unit * range.magnitude();
        let mut exact = if is_sine { sin } else { cos };
        let (mut error, mut size) = match source {
            // An ulp of a number up to one is at most two units.
            Source::Library => (2.0 * self.scalar.unit + rounded, 1.0),
            Source::Block(block, result) => {
                let (low, high) = (range.low - 2.0 * rounded, range.high + 2.0 * rounded);
                let wider = Interval::new(low, high);
                let block = &self.program.blocks[block];
                let most = sines::error(block, result, is_sine, wider, self.scalar) + rounded;
                let (index, joint) = (self.errors % 2, self.errors / 2);
                if joint < MAX_JOINTS {
                    self.errors += 1;
                    let variable = [Variable::EvenError, Variable::OddError][index];
                    exact = exact.plus(&Polynomial::variable(variable, joint, most));
                } else {
                    exact.rest += most;
                }
                (0.0, 1.0 + most)
            }
        };
        (size, error) = (size * SLACK, error * SLACK);
        Ok(Value { exact, size, error })
    }
}

fn exact(exact: Polynomial, size: f64) -> Value {
    let (size, error) = (size * SLACK, 0.0);
    Value { exact, size, error }
}
