//! The scene of a robot file: what stands still, what is carried, the box of states,
//! the results that are asked for and how far they may be off.

use toml_span::value::{Table, Value};

use crate::fault::Fault;
use crate::number::{Angle, Ball};
use crate::robot::{Reader, Robot, known, parse, table};

/// Where a locked joint is.
#[derive(Clone, Copy, Debug)]
pub enum Lock {
    /// The angle of a joint that turns.
    Angle(Angle),
    /// The position of one that slides, m.
    Length(Ball),
}

/// A range a joint: both ends, rad or m, and their first and second rates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ranges {
    /// q
    pub position: Vec<[f64; 2]>,
    /// q̇
    pub velocity: Vec<[f64; 2]>,
    /// q̈
    pub acceleration: Vec<[f64; 2]>,
}

/// A robot in a scene, or by itself.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The robot, with the scene's gravity and payload.
    pub robot: Robot,
    /// Of each joint whether it is locked, and where.
    pub locks: Vec<Option<Lock>>,
    /// Whether there is no velocity, and no acceleration.
    pub still: [bool; 2],
    /// The states that the file speaks of.
    pub ranges: Ranges,
    /// The joints, from zero, that results are over.
    pub rows: Vec<usize>,
    /// The largest error of each joint that the user accepts, relative to a scale.
    pub tolerance: Option<Vec<f64>>,
    /// What that scale is: `actuator` or `range`.
    pub relative_to: Option<String>,
}

/// Reads a robot file and one of its scenes.
///
/// # Errors
/// What is no TOML, or what this checker does not know, by its key.
pub fn read(source: &str, scene: Option<&str>) -> Result<Setting, Fault> {
    let root = parse(source)?;
    let (root, reader) = (table(&root, "file")?, Reader(source));
    let robot = reader.robot(root)?;
    let none = Table::default();
    let keys = match scene {
        None => &none,
        Some(name) => {
            let scenes = root.get("scene").and_then(Value::as_table);
            let found = scenes.and_then(|scenes| scenes.get(name));
            let missing = || Fault::robot(format!("scene.{name}"), "there is no such scene");
            table(found.ok_or_else(missing)?, name)?
        }
    };
    setting(&reader, robot, keys)
}

fn setting(reader: &Reader, mut robot: Robot, keys: &Table) -> Result<Setting, Fault> {
    let read = ["joints", "lock", "gravity", "velocity", "acceleration", "payload"];
    known(keys, &[&read[..], &["box", "tolerance", "outputs", "scalar"]].concat())?;
    if let Some(gravity) = reader.numbers(keys, "gravity")? {
        robot.gravity = gravity;
    }
    if let (Some(payload), Some(last)) = (keys.get("payload"), robot.joints.last_mut()) {
        let payload = table(payload, "payload")?;
        known(payload, &["mass", "com", "inertia"])?;
        last.bodies.push(reader.body(payload)?);
    }
    let mut locks = vec![None; robot.joints.len()];
    if let Some(lock) = keys.get("lock") {
        for (key, value) in table(lock, "lock")? {
            let joint = joint(&robot, &key.name)?;
            locks[joint] = Some(match robot.joints[joint].turns {
                true => Lock::Angle(reader.angle_of(value, "lock")?),
                false => Lock::Length(reader.number_of(value, "lock")?),
            });
        }
    }
    let rows = match keys.get("joints") {
        None => (0..locks.len()).filter(|&joint| locks[joint].is_none()).collect(),
        Some(list) => {
            let items = list.as_array().map(Vec::as_slice).unwrap_or_default();
            let number = |item: &Value| item.as_integer().map(|number| number.to_string());
            let name = |item: &Value| item.as_str().map(String::from).or(number(item));
            let rows = items.iter().map(|item| joint(&robot, &name(item).unwrap_or_default()));
            rows.collect::<Result<Vec<usize>, Fault>>()?
        }
    };
    let zero = |key: &str| match keys.get(key).map(Value::as_str) {
        None => Ok(false),
        Some(Some("zero")) => Ok(true),
        Some(_) => Err(Fault::robot(key, "expected \"zero\"")),
    };
    let still = [zero("velocity")?, zero("acceleration")?];
    let ranges = ranges(reader, &robot, keys, &locks, still)?;
    let (tolerance, relative_to) = tolerance(reader, keys, locks.len())?;
    Ok(Setting { robot, locks, still, ranges, rows, tolerance, relative_to })
}

/// A joint by its number, from one, or by its name.
fn joint(robot: &Robot, word: &str) -> Result<usize, Fault> {
    let named = robot.joints.iter().position(|joint| joint.name.as_deref() == Some(word));
    let found = match word.parse::<usize>() {
        Ok(number) => number.checked_sub(1).filter(|&joint| joint < robot.joints.len()),
        Err(_) => named,
    };
    found.ok_or_else(|| Fault::robot(word, "there is no such joint"))
}

/// The box: the scene's, else the joints' limits, and a whole turn where a joint that
/// turns has none. What stands still has empty ranges of rates.
fn ranges(
    reader: &Reader,
    robot: &Robot,
    keys: &Table,
    locks: &[Option<Lock>],
    still: [bool; 2],
) -> Result<Ranges, Fault> {
    let none = Table::default();
    let given = keys.get("box").map_or(Ok(&none), |given| table(given, "box"))?;
    known(given, &["position", "velocity", "acceleration"])?;
    let list = |key: &str| match given.get(key).map(Value::as_array) {
        None => Ok(None),
        Some(Some(items)) if items.len() == locks.len() => Ok(Some(items)),
        Some(_) => Err(Fault::robot(key, "expected one entry a joint")),
    };
    let positions = list("position")?;
    let rates = [list("velocity")?, list("acceleration")?];
    let mut ranges = Ranges::default();
    for (index, joint) in robot.joints.iter().enumerate() {
        let at = locks[index].map(|lock| match lock {
            Lock::Angle(angle) => angle.radians.value,
            Lock::Length(length) => length.value,
        });
        let turn = || joint.turns.then_some([-std::f64::consts::PI, std::f64::consts::PI]);
        ranges.position.push(match (at, positions) {
            (Some(at), _) => [at, at],
            (None, Some(items)) => reader.range(&items[index], joint.turns)?,
            (None, None) => joint.position.or_else(turn).unwrap_or([f64::NAN; 2]),
        });
        let rate = |which: usize| match (at.is_some() || still[which], rates[which]) {
            (true, _) => Ok([0.0; 2]),
            (false, Some(items)) => {
                let most = reader.number_of(&items[index], "box")?.value;
                Ok([-most, most])
            }
            (false, None) => Ok(joint.limits[which].map_or([f64::NAN; 2], |most| [-most, most])),
        };
        ranges.velocity.push(rate(0)?);
        ranges.acceleration.push(rate(1)?);
    }
    Ok(ranges)
}

/// The tolerance of each joint and what it is relative to.
fn tolerance(
    reader: &Reader,
    keys: &Table,
    joints: usize,
) -> Result<(Option<Vec<f64>>, Option<String>), Fault> {
    let Some(tolerance) = keys.get("tolerance") else {
        return Ok((None, None));
    };
    let tolerance = table(tolerance, "tolerance")?;
    known(tolerance, &["value", "relative_to"])?;
    let relative_to = tolerance.get("relative_to").and_then(Value::as_str);
    let values = match tolerance.get("value") {
        Some(value) if value.as_array().is_some() => {
            let items = value.as_array().map(Vec::as_slice).unwrap_or_default();
            let read = items.iter().map(|item| reader.number_of(item, "value"));
            read.collect::<Result<Vec<Ball>, Fault>>()?
        }
        Some(value) => vec![reader.number_of(value, "value")?; joints],
        None => Vec::new(),
    };
    if values.len() != joints {
        return Err(Fault::robot("tolerance", "expected a value, or one a joint"));
    }
    // Down, so that nothing is allowed that the decimal does not allow.
    let allowed = values.iter().map(|x| x.value - x.radius).collect();
    Ok((Some(allowed), relative_to.map(String::from)))
}
