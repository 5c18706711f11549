//! Compares an exact program with the equations of motion.

use std::collections::BTreeMap;

use super::arm::Arm;
use super::exact::{Exact, Point};
use super::number::{Draws, Number};
use super::outputs::result;
use super::setting::Setting;
use super::state::State;
use super::table::{Field, Function};
use crate::program::{Program, argument};

/// A wrong program passes with a probability below 2 to the power of minus this.
const CERTAINTY: u32 = 140;
/// A wrong difference of a degree d passes a point with a probability below d times 2 to the power
/// of minus this: `mod.rs`.
const POINT: u32 = 100;
/// The largest degree of a difference.
const MOST_DEGREE: f64 = (1u128 << 80) as f64;

/// A base parameter: the columns of the parameters that it adds up, each times a constant.
pub type Combination = Vec<(usize, Exact)>;

/// The base parameters that a regressor is over, and their values if these are claimed too.
#[derive(Clone, Debug, Default)]
pub struct Base {
    /// The parameters that each adds up.
    pub combinations: Vec<Combination>,
    /// The values; none if nothing is claimed of them.
    pub values: Vec<Exact>,
}

/// A function, the program that it is claimed to be, and what both are over.
#[derive(Clone, Copy)]
pub struct Statement<'s> {
    /// The function.
    pub function: &'s Function,
    /// The program that it is claimed to be.
    pub program: &'s Program<Exact>,
    /// The base parameters that its columns are of, if it is a regressor.
    pub base: &'s Base,
    /// The program of a payload's load, if the function takes one.
    pub load: Option<&'s Program<Exact>>,
}

/// Points of prime fields that follow from texts which have all that is claimed, and the
/// robot at each of them.
pub struct Points<'s> {
    setting: &'s Setting<'s>,
    draws: Draws,
    points: Vec<Point>,
    arms: Vec<Arm>,
}

impl<'s> Points<'s> {
    /// Returns the points of texts about a robot.
    pub fn new(setting: &'s Setting<'s>, texts: &[&str]) -> Points<'s> {
        Points {
            setting,
            draws: Draws::new(texts),
            points: Vec::new(),
            arms: Vec::new(),
        }
    }

    pub(crate) fn first(&mut self, count: usize) -> &[Point] {
        while self.points.len() < count {
            self.points.push(Point::draw(&mut self.draws));
        }
        &self.points[..count]
    }

    fn with_arms(&mut self, count: usize) -> Result<impl Iterator<Item = (&Point, &Arm)>, String> {
        self.first(count);
        for point in self.points[..count].iter().skip(self.arms.len()) {
            self.arms.push(Arm::read(self.setting, point)?);
        }
        Ok(self.points.iter().zip(&self.arms).take(count))
    }
}

/// Checks a function's program against a robot, at so many of the points as its degree asks for.
///
/// # Errors
/// The first result that differs, by its number.
pub fn check(statement: Statement, points: &mut Points) -> Result<(), String> {
    // Own formulas are quotients of polynomials of a degree below 200 n²: D's entries are of 4 n,
    // its determinant of 4 n², and what is derived twice or inverted twice of a small multiple of
    // that. Points in contact make it three rows and columns larger. Joints that follow others
    // several times as far are of as many times their degree.
    let setting = points.setting;
    let n = (setting.links() + setting.base()) as f64;
    let held = statement.function.fields.iter().map(Field::points).max();
    let rows = n + 3.0 * held.unwrap_or_default() as f64;
    let own_degree = 200.0 * n * rows * setting.turns();
    let load_degree = statement.load.map_or(1.0, |load| load.degree().max(1.0));
    let degree = (statement.program.degree() * load_degree + own_degree) * (2.0 * n + 1.0);
    // No number counts as too large.
    if !(degree <= MOST_DEGREE) {
        return Err("the degree is too large for a few points to decide".into());
    }
    let bits = (degree.ceil() as u128).next_power_of_two().trailing_zeros();
    let mut points = points.with_arms(CERTAINTY.div_ceil(POINT - bits) as usize)?;
    points.try_for_each(|(point, arm)| at_point(statement, setting, point, arm.clone()))
}

fn at_point(
    statement: Statement,
    setting: &Setting,
    point: &Point,
    mut arm: Arm,
) -> Result<(), String> {
    let (function, base) = (statement.function, statement.base);
    let mut state = State::draw(point, setting)?;
    let place = |name: &str| argument(name).unwrap_or_default();
    let takes = |name: &str| function.arguments.contains(&place(name));
    if takes("g") {
        arm.gravity.copy_from_slice(&state.arguments[place("g")]);
    }
    if takes("load") {
        let computed = statement.load.and_then(|load| load.residues(point, &state));
        state.arguments[place("load")] = computed.ok_or("nothing computes its `load`")?;
        arm = arm.with_load(setting, point, &state)?;
    }
    let residues = statement.program.residues(point, &state);
    let mut actual = residues.ok_or("the program reads what is not there")?;
    let mut expected = Vec::new();
    for field in &function.fields {
        let values = result(&arm, &state, field).ok_or("no such result")?;
        let values = selected(field, setting, values);
        if field.axes.contains('b') {
            let has_width = |joint: usize| !matches!(setting.width(joint), Ok(None));
            if (0..setting.joints()).any(has_width) {
                return Err("Coulomb friction is no column of a regressor".into());
            }
            let rows = setting.rows.len().max(1);
            let range = expected.len()..expected.len() + rows * base.combinations.len();
            let sizes = [rows, values.len() / rows];
            let columns = actual.get(range.clone());
            let spread = columns
                .and_then(|numbers| spread(numbers, &base.combinations, point, sizes))
                .ok_or("the base parameters do not fit the results")?;
            if !are_independent(&base.combinations, point) {
                return Err("the base parameters do not stand for themselves".into());
            }
            actual.splice(range, spread);
        }
        expected.extend(values);
    }
    if !base.values.is_empty() {
        let parameters = arm.parameters();
        let value = |combination: &Combination| {
            let mut sum = Number::new(0, point.prime);
            for (column, factor) in combination {
                sum = sum + *parameters.get(*column)? * point.constant(factor);
            }
            Some(sum)
        };
        let sums: Option<Vec<Number>> = base.combinations.iter().map(value).collect();
        expected.extend(sums.ok_or("the base parameters do not fit the robot")?);
        actual.extend(base.values.iter().map(|exact| point.constant(exact)));
    }
    if actual.len() != expected.len() {
        return Err(format!("{} results, not {}", actual.len(), expected.len()));
    }
    let is_other = |(number, other): (&Number, &Number)| {
        let residue = number.value(point.prime);
        residue.is_none() || residue != other.value(point.prime)
    };
    match actual.iter().zip(&expected).position(is_other) {
        Some(place) => Err(format!("result {} is not that of the robot", place + 1)),
        None => Ok(()),
    }
}

fn are_independent(base: &[Combination], point: &Point) -> bool {
    let mut known: Vec<BTreeMap<usize, Number>> = Vec::new();
    base.iter().all(|combination| {
        let mut row = BTreeMap::new();
        let add = |column: usize, value: Number, terms: &mut BTreeMap<usize, Number>| {
            let sum = terms.entry(column).or_insert_with(|| 0.into());
            *sum = *sum + value;
            terms.retain(|_, value| value.value(point.prime) != Some(0));
        };
        for (column, factor) in combination {
            add(*column, point.constant(factor), &mut row);
        }
        for other in &known {
            if let Some((pivot, by)) = other.first_key_value()
                && let Some(value) = row.get(pivot)
            {
                let factor = -(*value / *by);
                for (column, value) in other {
                    add(*column, *value * factor, &mut row);
                }
            }
        }
        known.push(row.clone());
        !row.is_empty()
    })
}

fn spread(
    numbers: &[Number],
    base: &[Combination],
    point: &Point,
    [n, length]: [usize; 2],
) -> Option<Vec<Number>> {
    let mut entries = vec![Number::new(0, point.prime); n * length];
    for (k, combination) in base.iter().enumerate() {
        for (column, factor) in combination {
            let factor = point.constant(factor);
            for (i, row) in entries.chunks_mut(length.max(1)).enumerate() {
                let place = row.get_mut(*column)?;
                *place = *place + *numbers.get(i * base.len() + k)? * factor;
            }
        }
    }
    (numbers.len() == n * base.len()).then_some(entries)
}

/// Returns those entries of a result that are over the joints that a scene asks for.
fn selected(field: &Field, setting: &Setting, values: Vec<Number>) -> Vec<Number> {
    let lengths = field.lengths(setting, 0).into_iter();
    let mut parts = vec![values];
    let (joint_rows, blocks) = (setting.joint_rows(), setting.blocks());
    let coordinates = setting.sizes().coordinates;
    for (axis, length) in field.axes.chars().zip(lengths) {
        // Behind these nothing is over joints.
        if ['l', 'b'].contains(&axis) {
            break;
        }
        let indices: Vec<usize> = (0..length).collect();
        let (count, rows) = match axis {
            'n' => (coordinates, &setting.rows),
            'k' => (coordinates * coordinates, &blocks),
            'j' => (setting.joints(), &joint_rows),
            _ => (length, &indices),
        };
        let split = parts.iter().flat_map(|part| {
            let length = part.len() / count.max(1);
            let pick = move |row: &usize| part[row * length..(row + 1) * length].to_vec();
            rows.iter().map(pick)
        });
        parts = split.collect();
    }
    parts.concat()
}
