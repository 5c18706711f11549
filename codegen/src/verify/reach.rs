//! Which constants of a program follow a number of the robot file.
//!
//! Let f(x; p) be the formula at the state x and the number p, and P(x; κ) a program that equals
//! it, with constants κ. Where p changes, P stays f if its constants change at rates κ̇ with
//! Σ ∂P/∂κ_j κ̇_j = ∂f/∂p at every state. Both sides are evaluated modulo a prime and at states
//! that follow from the statement, as [`exact`](super::exact) evaluates programs, ∂f/∂p by the
//! recursion of Newton and Euler over the robot's own numbers. Of the solutions of these linear
//! equations one is taken whose constants are as few as can be: if one of them stayed, the others
//! would not do. Where either of two constants would do it is the last in the program's order, which
//! is as near to the results as can be.
//! If there is no solution, no constants do: the program has its form because of the very number.

use std::cell::RefCell;

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::Exact;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::dual::Dual;
use dalembert_model::scalar::residue::Residue;
use dalembert_model::scalar::{Divide, Scalar};
use rustc_hash::FxHashMap;

use super::challenge::{Point, Transcript};
use crate::function::Argument;
use crate::program::{Input, Operand, Program};
use crate::scene::SceneRobot;

/// States in a row that say nothing new, before nothing new is expected.
const IN_VAIN: usize = 4;
/// The most states.
const MAX_STATES: usize = 1 << 12;

/// Where a constant stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// An operand of a step, zero for its left one.
    Step(usize, usize),
    /// A result.
    Output(usize),
}

/// What a number of the robot file reaches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reach {
    /// The results that change with it.
    pub outputs: Vec<usize>,
    /// The constants that follow it, in the program's order; `None` if no change of constants
    /// does.
    pub constants: Option<Vec<Place>>,
}

/// Why it is not known what a number reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreached {
    /// What the formula reads is not linear in it, such as where a payload is added to a link.
    Nonlinear,
    /// The program reads what is computed of a payload outside of it.
    Load,
    /// Constants or divisors vanish modulo the prime.
    Unfit,
}

/// Finds what a number of a robot reaches in a program of the robot in its scene. The robot is
/// given once more with two other values of the number: larger by some amount, and by twice that.
/// An angle is given with any other value, twice.
///
/// # Errors
/// Programs and numbers of which it is not known.
pub fn reach(
    scene_robot: &SceneRobot,
    others: [&SceneRobot; 2],
    program: &Program,
) -> Result<Reach, Unreached> {
    if program.arguments.contains(&Argument::Load) {
        return Err(Unreached::Load);
    }
    let rates = rates(scene_robot, others).ok_or(Unreached::Nonlinear)?;
    let mut transcript = Transcript::new("reach");
    transcript.scene_robot(scene_robot);
    transcript.program(program);
    let challenge = transcript.seal();
    let point = challenge.draw(0).ok_or(Unreached::Unfit)?;
    let mut places = places(program);
    places.reverse();
    let equations = Equations {
        scene_robot,
        program,
        rates,
        point,
        places: &places,
    };
    equations.solve().ok_or(Unreached::Unfit)
}

/// Returns the numbers that the formula reads of a robot, in its order.
fn numbers(robot: &Robot) -> Vec<Exact> {
    let mut all = Vec::new();
    let _: Arm<Dual<f64>> = Arm::from_robot(robot, &mut |x: &Exact| {
        all.push(x.clone());
        Dual::zero()
    });
    all
}

/// Returns how fast each of these numbers changes; `None` if they are no multiples of the change.
fn rates(scene_robot: &SceneRobot, others: [&SceneRobot; 2]) -> Option<Vec<Exact>> {
    let own = numbers(scene_robot.robot());
    let [once, twice] = others.map(|other| numbers(other.robot()));
    let mut rates: Vec<Exact> = once.iter().zip(&own).map(|(x, y)| x.sub(y)).collect();
    let is_changed = |rate: &Exact| !Scalar::is_zero(rate);
    let first = rates.iter().position(is_changed)?;
    if once == twice {
        // Sine and cosine of an angle, which nothing else follows.
        rates.fill(Exact::zero());
        rates[first] = own.get(first + 1)?.clone();
        rates[first + 1] = own[first].neg();
        return Some(rates);
    }
    let doubled = own
        .iter()
        .zip(&rates)
        .map(|(x, rate)| x.add(&rate.double()));
    let is_linear = own.len() == twice.len() && doubled.eq(twice.iter().cloned());
    is_linear.then_some(rates)
}

/// Returns where constants are, in the program's order.
fn places<'p>(program: &'p Program) -> Vec<(Place, &'p Exact)> {
    let steps = program.steps.iter().enumerate();
    let of_steps = steps.flat_map(|(index, step)| {
        [
            (Place::Step(index, 0), &step.left),
            (Place::Step(index, 1), &step.right),
        ]
    });
    let outputs = program.outputs.iter().enumerate();
    let of_outputs = outputs.map(|(index, output)| (Place::Output(index), &output.value));
    let constant = |(place, operand): (Place, &'p Operand)| match operand {
        Operand::Constant(value) => Some((place, value)),
        _ => None,
    };
    of_steps.chain(of_outputs).filter_map(constant).collect()
}

/// The linear equations for the rates of a program's constants.
struct Equations<'a> {
    scene_robot: &'a SceneRobot,
    program: &'a Program,
    /// How fast the numbers of the robot change.
    rates: Vec<Exact>,
    point: Point,
    places: &'a [(Place, &'a Exact)],
}

impl Equations<'_> {
    fn solve(&self) -> Option<Reach> {
        let prime = self.point.prime();
        let is_zero = |x: &Residue| Some(x.value(prime)? == 0);
        let address = |constant: &Exact| std::ptr::from_ref(constant).addr();
        let constants = self
            .places
            .iter()
            .map(|(_, constant)| Some((address(constant), self.point.constant(constant)?)));
        let constants: FxHashMap<usize, Residue> = constants.collect::<Option<_>>()?;
        let count = self.places.len();
        // Each row begins with the place of its first number that is not zero, made one.
        let mut rows: Vec<(usize, Vec<Residue>)> = Vec::new();
        let (mut changed, mut in_vain) = (vec![false; self.program.outputs.len()], 0);
        for state in 0..MAX_STATES {
            let at = self.point.with_state(state);
            let wanted = self.formula(&at)?;
            let inputs = RefCell::new(FxHashMap::default());
            let mut columns = Vec::with_capacity(count + 1);
            for (_, changing) in self.places {
                let constant = |constant: &Exact| {
                    let rate = match std::ptr::eq(constant, *changing) {
                        true => Residue::one(),
                        false => Residue::zero(),
                    };
                    let value = *constants.get(&address(constant))?;
                    Some(Dual { value, rate })
                };
                let input = |input: &Input| {
                    let mut inputs = inputs.borrow_mut();
                    let value = inputs.entry(*input).or_insert_with(|| at.input(*input));
                    Some(Dual::constant(*value))
                };
                columns.push(self.program.evaluate(input, constant)?);
            }
            columns.push(wanted);
            in_vain += 1;
            for (output, is_changed) in changed.iter_mut().enumerate() {
                let row = columns.iter().map(|column| Some(column.get(output)?.rate));
                let mut row: Vec<Residue> = row.collect::<Option<_>>()?;
                *is_changed |= !is_zero(&row[count])?;
                for (first, other) in &rows {
                    let factor = row[*first];
                    if !is_zero(&factor)? {
                        for (x, y) in row.iter_mut().zip(other).skip(*first) {
                            *x = x.sub(&factor.mul(y));
                        }
                    }
                }
                let is_left = |x: &Residue| x.value(prime) != Some(0);
                if let Some(first) = row.iter().position(is_left) {
                    let divisor = row[first];
                    row.iter_mut().for_each(|x| *x = x.div(&divisor));
                    let place = rows.partition_point(|(other, _)| *other < first);
                    rows.insert(place, (first, row));
                    in_vain = 0;
                }
            }
            if in_vain == IN_VAIN {
                break;
            }
        }
        let outputs = changed
            .iter()
            .enumerate()
            .filter(|(_, is_changed)| **is_changed);
        let outputs = outputs.map(|(output, _)| output).collect();
        if rows.last().is_some_and(|(first, _)| *first == count) {
            let constants = None;
            return Some(Reach { outputs, constants });
        }
        let mut solution = vec![Residue::zero(); count];
        for (first, row) in rows.iter().rev() {
            let known = solution.iter().zip(row).skip(*first + 1);
            let known = known.fold(Residue::zero(), |sum, (x, y)| sum.add(&x.mul(y)));
            solution[*first] = row[count].sub(&known);
        }
        let mut follow = Vec::new();
        for ((place, _), rate) in self.places.iter().zip(&solution) {
            if !is_zero(rate)? {
                follow.push(*place);
            }
        }
        follow.sort_unstable();
        let constants = Some(follow);
        Some(Reach { outputs, constants })
    }

    /// Returns the formula's results at a state, and how fast they change.
    fn formula(&self, at: &Point) -> Option<Vec<Dual<Residue>>> {
        let mut is_whole = true;
        let mut number = |constant: &Exact| {
            at.constant(constant).unwrap_or_else(|| {
                is_whole = false;
                Residue::zero()
            })
        };
        let mut rates = self.rates.iter();
        let arm = Arm::from_robot(self.scene_robot.robot(), &mut |x: &Exact| Dual {
            value: number(x),
            rate: rates.next().map_or(Residue::zero(), &mut number),
        });
        let input = |input| Dual::constant(at.input(input));
        let constant = |x: &Exact| Dual::constant(number(x));
        let function = self.program.function;
        let posed = self.scene_robot.posed(function, arm, input, constant);
        let results = posed.results(self.scene_robot, function, Formulation::NewtonEulerLink);
        is_whole.then_some(results)
    }
}
