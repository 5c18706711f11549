//! Conditions on a function that divides, whose rounding has no bound over the box: a number that
//! is added and taken away again, large at states that are not tried, is not in its program.
//!
//! - No step is in vain: at random residues another value of it gives another result. Of K in
//!   (x + K) − K any value gives the same.
//! - No step that reads the state has one value at two random points, and none is, but for its
//!   sign, an earlier one or an operand. Lanes of a loop may compute the same: then these steps are
//!   in vain if no result changes where all of them change alike.
//! - In f64, a step that no quotient reaches is over the box at most [`MOST_RATIO`] times its
//!   largest magnitude at states. Honest programs need 2¹⁹. In f32 a constant of 24 bits hides as
//!   much as rounding does.
//!
//! Programs of the generator satisfy these; they are a sieve, and no proof. x + 2K − L, where L is
//! 2K written otherwise, passes.

use std::collections::{HashMap, HashSet};

use crate::fault::Fault;
use crate::identity::exact::{Exact, Point};
use crate::identity::number::Number;
use crate::identity::residues::leaf;
use crate::identity::setting::Setting;
use crate::identity::state::State;
use crate::program::{Operand, Program, argument};
use crate::work::Work;

/// The largest bound of a step relative to its largest magnitude at states.
pub(crate) const MOST_RATIO: f64 = (1u64 << 20) as f64;

/// Nanoseconds for an operation on residues.
const RESIDUE: u64 = 60;

/// Checks the first two conditions; `load` is the number of entries of a load.
pub(crate) fn check(
    program: &Program<Exact>,
    loops: &[[usize; 3]],
    setting: &Setting,
    load: usize,
    points: &[Point; 3],
    work: &Work,
) -> Result<(), Fault> {
    work.spend(program.steps.len(), 6 * RESIDUE)?;
    let lost = || Fault::Claim("the program reads what is not there".into());
    let [first, second, point] = points;
    let vain_at = |point| vain(program, loops, point, setting, load).ok_or_else(lost);
    let ([alone, twins], [other_alone, other_twins]) = (vain_at(first)?, vain_at(second)?);
    if let Some(step) = twins.intersection(&other_twins).min() {
        let why = "changes no result with its like in other lanes";
        return Err(refused(*step, why));
    }
    // A zero derivative is no proof: it is zero at an extremum, too.
    let mut idle: Vec<usize> = alone.intersection(&other_alone).copied().collect();
    idle.sort_unstable();
    for step in idle {
        work.spend(program.steps.len(), 2 * RESIDUE)?;
        let state = state(first, setting, load).ok_or_else(lost)?;
        let results = program.residues(first, &state);
        let changed = program.residues_but(step, first.residue(), first, &state);
        let both = results.zip(changed).ok_or_else(lost)?;
        let value = |number: &Number| number.value(first.prime);
        if both.0.iter().map(value).eq(both.1.iter().map(value)) {
            return Err(refused(step, "changes no result"));
        }
    }
    let drawn = || state(point, setting, load).ok_or_else(lost);
    let (one, other) = (drawn()?, drawn()?);
    let values = |state: &State| program.step_residues(point, state).ok_or_else(lost);
    let (first_values, second_values) = (values(&one)?, values(&other)?);
    let mut known = HashMap::new();
    // Lanes of one row may have it.
    let mut is_new = |both: [Number; 2], row: usize| {
        let values = |both: [Number; 2]| both.map(|x| x.value(point.prime).unwrap_or_default());
        let first = known.entry(values(both.map(|x| -x)).min(values(both)));
        *first.or_insert(row) == row
    };
    let row = |step: usize| {
        let mut lane_loops = loops
            .iter()
            .filter(|[first, rows, lanes]| (*first..first + rows * lanes).contains(&step));
        lane_loops
            .next()
            .map_or(step, |[first, rows, _]| first + (step - first) % rows)
    };
    let is_input = |operand: &Operand<Exact>| Some(!matches!(operand, Operand::Constant(_)));
    let reads = program.values(is_input, |_, a, b| a || b);
    let reads_state = reads.ok_or_else(lost)?;
    let operands = program.steps.iter().flat_map(|step| &step.1);
    for operand in operands.filter(|operand| !matches!(operand, Operand::Constant(_))) {
        let both = [&one, &other].map(|state| leaf(operand, point, state));
        if let [Some(a), Some(b)] = both {
            is_new([a, b], usize::MAX);
        }
    }
    for (step, (a, b)) in first_values.into_iter().zip(second_values).enumerate() {
        // A product that is not rounded hides nothing, and may stand once for each of its sums.
        if program.steps[step].0 == '×' {
            continue;
        }
        let is_constant = a.value(point.prime) == b.value(point.prime);
        if is_constant && reads_state[step] {
            return Err(refused(step, "has one value at all states"));
        }
        if !is_new([a, b], row(step)) {
            return Err(refused(step, "has the value of an earlier one"));
        }
    }
    Ok(())
}

pub(crate) fn refused(step: usize, why: &str) -> Fault {
    let number = step + 1;
    Fault::Claim(format!(
        "operation {number} {why}: it may hide a number that cancels"
    ))
}

fn state(point: &Point, setting: &Setting, load: usize) -> Option<State> {
    let mut state = State::draw(point, setting).ok()?;
    let place = argument("load")?;
    state.arguments[place] = (0..load).map(|_| point.residue()).collect();
    Some(state)
}

/// Lists the steps that do not change a random combination of the results, and those that do not
/// change it together with their like in other lanes.
fn vain(
    program: &Program<Exact>,
    loops: &[[usize; 3]],
    point: &Point,
    setting: &Setting,
    load: usize,
) -> Option<[HashSet<usize>; 2]> {
    let state = state(point, setting, load)?;
    let values = program.step_residues(point, &state)?;
    let mut slopes = vec![Number::new(0, point.prime); values.len()];
    for (_, output) in &program.outputs {
        if let Operand::Step(step) = output {
            slopes[*step] = slopes[*step] + point.residue();
        }
    }
    for (step, (operation, operands)) in program.steps.iter().enumerate().rev() {
        let slope = slopes[step];
        if !slope.is_nonzero() {
            continue;
        }
        let value = |operand: &Operand<Exact>| match operand {
            Operand::Step(step) => values.get(*step).copied(),
            input => leaf(input, point, &state),
        };
        let [a, b] = operands.each_ref().map(value);
        let (a, b) = (a?, b?);
        let parts = match operation {
            '+' => [slope, slope],
            '-' => [slope, -slope],
            '/' => [slope / b, -(slope * values[step]) / b],
            _ => [slope * b, slope * a],
        };
        for (operand, part) in operands.iter().zip(parts) {
            if let Operand::Step(step) = operand {
                slopes[*step] = slopes[*step] + part;
            }
        }
    }
    let is_vain = |step: &usize| slopes[*step].value(point.prime) == Some(0);
    let alone = (0..slopes.len()).filter(is_vain).collect();
    let mut twins = HashSet::new();
    let value = |number: Number| number.value(point.prime);
    for &[first, rows, lanes] in loops {
        for step in first..first + rows {
            // Adds up the slopes of this and later lanes with the same value, up to its sign.
            let like = |lane: usize| (step + lane * rows..first + rows * lanes).step_by(rows);
            for lane in 0..lanes {
                let lane_step = step + lane * rows;
                let mut slope = Number::new(0, point.prime);
                let mut count = 0;
                for other in like(lane) {
                    if value(values[other]) == value(values[lane_step]) {
                        (slope, count) = (slope + slopes[other], count + 1);
                    } else if value(values[other]) == value(-values[lane_step]) {
                        (slope, count) = (slope - slopes[other], count + 1);
                    }
                }
                if count > 1 && !slope.is_nonzero() {
                    twins.insert(lane_step);
                }
            }
        }
    }
    Some([alone, twins])
}
