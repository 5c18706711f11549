//! A scene of a robot file: what stands still, what is carried, the box of states, the
//! results that are asked for and how far they may be off.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::fault::Fault;
use crate::literal::Literal;
use crate::number::Real;
use crate::polynomial::MAX_JOINTS;
use crate::robot::{Body, File, Joint, Row, Step, steps};

/// The longest robot file.
const MOST_BYTES: usize = 1 << 18;

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(dead_code, reason = "what is `IgnoredAny` may be there")]
struct Scene {
    outputs: Option<IgnoredAny>,
    scalar: Option<IgnoredAny>,
    joints: Option<Vec<Literal>>,
    lock: BTreeMap<String, Literal>,
    gravity: Option<[Literal; 3]>,
    velocity: Option<Zero>,
    acceleration: Option<Zero>,
    payload: Option<Payload>,
    r#box: Bounds,
    tolerance: Option<Tolerance>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Zero {
    Zero,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Payload {
    mass: Literal,
    com: [Literal; 3],
    inertia: Option<[Literal; 6]>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Bounds {
    position: Option<Vec<[Literal; 2]>>,
    velocity: Option<Vec<Literal>>,
    acceleration: Option<Vec<Literal>>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tolerance {
    value: OneOrEach,
    relative_to: String,
}

#[derive(Clone, Deserialize)]
#[serde(untagged)]
enum OneOrEach {
    One(Literal),
    Each(Vec<Literal>),
}

/// A robot in a scene, or by itself.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The way from the axes that gravity is in to frame 0.
    pub base: Vec<Step>,
    /// The way from the last link's frame to the hand's.
    pub tool: Vec<Step>,
    /// The acceleration of gravity in base axes, m/s².
    pub gravity: [Real; 3],
    /// From the base to the hand; the last one carries the payload.
    pub joints: Vec<Joint>,
    /// Of each joint that is locked sine and cosine, if it turns, and its position, m.
    pub locks: Vec<Option<[Real; 3]>>,
    /// Whether q̇ is zero, and q̈.
    pub still: [bool; 2],
    /// The ranges of q, q̇ and q̈ that the file speaks of, NaN where it does not.
    pub ranges: [Vec<[f64; 2]>; 3],
    /// The limits of force or torque, N or N·m, NaN where there are none.
    pub torques: Vec<f64>,
    /// The joints, from zero, that results are over.
    pub rows: Vec<usize>,
    /// `true` if a scene of the file has a tolerance.
    pub has_tolerances: bool,
    /// The largest error of each joint that the user accepts, relative to a scale.
    pub tolerance: Option<Vec<f64>>,
    /// What that scale is: `actuator` or `range`.
    pub relative_to: Option<String>,
}

/// Reads a robot file and one of its scenes.
///
/// # Errors
/// What is no TOML, or what this checker does not know, by its key.
pub fn read(source: &str, name: Option<&str>) -> Result<Setting, Fault> {
    let why = format!("more than {MOST_BYTES} bytes");
    Fault::require(source.len() <= MOST_BYTES, "file", &why)?;
    let file: File<Scene> =
        toml::from_str(source).map_err(|e| Fault::robot("file", e.to_string()))?;
    let none = Scene::default();
    let missing = |name: &str| Fault::robot(format!("scene.{name}"), "there is no such scene");
    let scene = name.map_or(Ok(&none), |name| file.scene.get(name).ok_or(missing(name)))?;
    setting(&file, scene)
}

fn setting(file: &File<Scene>, scene: &Scene) -> Result<Setting, Fault> {
    let (rows, count) = (&file.joint, file.joint.len());
    let why = format!("1 to {MAX_JOINTS} joints are audited, not {count}");
    Fault::require((1..=MAX_JOINTS).contains(&count), "joint", &why)?;
    rows.iter().try_for_each(Row::in_order)?;
    let mut scenes = file.scene.values();
    scenes.try_for_each(|scene| in_order(rows, &scene.r#box))?;
    let joints = rows.iter().map(|row| row.joint(file.convention.as_deref()));
    let mut joints: Vec<Joint> = joints.collect::<Result<_, Fault>>()?;
    if let (Some(Payload { mass, com, inertia }), Some(last)) = (&scene.payload, joints.last_mut())
    {
        last.bodies.push(Body {
            frame: steps(&file.payload_frame)?,
            ..Body::read(mass, com, inertia.as_ref().unwrap_or(&Default::default()))?
        });
    }
    let gravity = scene.gravity.as_ref().unwrap_or(&file.gravity);
    let mut at: Vec<Option<&Literal>> = vec![None; count];
    for (word, position) in &scene.lock {
        at[joint(rows, word)?] = Some(position);
    }
    let (mut locks, zero) = (Vec::new(), Real::default());
    for (joint, at) in joints.iter().zip(&at) {
        let held = at.map(|at| match joint.turns {
            true => at.angle("lock").map(|angle| [angle.sin, angle.cos, zero]),
            false => at.real("lock").map(|at| [zero, 1.0.into(), at]),
        });
        locks.push(held.transpose()?);
    }
    let word = |word: &Literal| match word {
        Literal::Text(name) => joint(rows, name),
        Literal::Whole(number) => joint(rows, &number.to_string()),
        Literal::Decimal(_) => Err(Fault::robot("joints", "expected numbers or names")),
    };
    let asked = scene.joints.as_ref();
    let asked = asked.map(|list| list.iter().map(word).collect::<Result<Vec<usize>, Fault>>());
    let moving = (0..count).filter(|&joint| locks[joint].is_none());
    let still = [scene.velocity.is_some(), scene.acceleration.is_some()];
    let torque = |row: &Row| Literal::optional(row.limits.torque.as_ref(), "torque");
    let tolerance = scene.tolerance.as_ref().map(|tolerance| {
        let each = match &tolerance.value {
            OneOrEach::One(one) => vec![one; count],
            OneOrEach::Each(each) => each.iter().collect(),
        };
        // Down, so that nothing is allowed that the decimal does not allow.
        let down = |x: &&Literal| x.double("tolerance").map(f64::next_down);
        let read: Vec<f64> = each.iter().map(down).collect::<Result<_, Fault>>()?;
        let why = "expected a value, or one a joint";
        Fault::require(read.len() == count, "tolerance", why).map(|()| read)
    });
    Ok(Setting {
        base: steps(&file.base)?,
        tool: steps(&file.tool)?,
        gravity: Literal::reals(gravity, "gravity")?,
        joints,
        rows: asked.transpose()?.unwrap_or(moving.collect()),
        still,
        ranges: ranges(rows, &scene.r#box, &at, still)?,
        torques: rows.iter().map(torque).collect::<Result<_, Fault>>()?,
        locks,
        has_tolerances: file.scene.values().any(|scene| scene.tolerance.is_some()),
        tolerance: tolerance.transpose()?,
        relative_to: scene.tolerance.as_ref().map(|t| t.relative_to.clone()),
    })
}

/// Returns a joint by its number, from one, or by its name.
fn joint(rows: &[Row], word: &str) -> Result<usize, Fault> {
    let found = match word.parse::<usize>() {
        Ok(number) => number.checked_sub(1).filter(|&joint| joint < rows.len()),
        Err(_) => rows
            .iter()
            .position(|row| row.name.as_deref() == Some(word)),
    };
    found.ok_or_else(|| Fault::robot(word, "there is no such joint"))
}

/// Refuses a box between whose ends nothing is, or that is not of this robot.
fn in_order(rows: &[Row], given: &Bounds) -> Result<(), Fault> {
    let why = |count| format!("{count} entries, but the robot has {} joints", rows.len());
    let entries = |key: &str, count: usize| Fault::require(count == rows.len(), key, &why(count));
    if let Some(ranges) = &given.position {
        entries("position", ranges.len())?;
        let why = "the range is empty: its lowest position is not below its highest";
        for (row, range) in rows.iter().zip(ranges) {
            row.range(range, why)?;
        }
    }
    let (velocity, acceleration) = (&given.velocity, &given.acceleration);
    for (key, sizes) in [("velocity", velocity), ("acceleration", acceleration)] {
        let Some(sizes) = sizes else { continue };
        entries(key, sizes.len())?;
        for size in sizes {
            let why = format!("the range is empty: the {key} is negative");
            Fault::require(size.double(key)? >= 0.0, key, &why)?;
        }
    }
    Ok(())
}

/// Returns the box: the scene's, else the joints' limits, and a whole turn where a joint that
/// turns has none. What is locked has one position; what stands still has no rates.
fn ranges(
    rows: &[Row],
    given: &Bounds,
    locks: &[Option<&Literal>],
    still: [bool; 2],
) -> Result<[Vec<[f64; 2]>; 3], Fault> {
    let mut ranges = [vec![], vec![], vec![]];
    for (index, row) in rows.iter().enumerate() {
        let own = given.position.as_ref().and_then(|list| list.get(index));
        ranges[0].push(match (locks[index], own.or(row.limits.position.as_ref())) {
            (Some(at), _) => [row.position(at)?; 2],
            (None, Some([low, high])) => [row.position(low)?, row.position(high)?],
            (None, None) if row.turns()? => [-PI, PI],
            (None, None) => [f64::NAN; 2],
        });
        let rates = [
            (&given.velocity, &row.limits.velocity),
            (&given.acceleration, &row.limits.acceleration),
        ];
        for (which, (given, limit)) in rates.into_iter().enumerate() {
            let given = given.as_ref().and_then(|list| list.get(index));
            let most = Literal::optional(given.or(limit.as_ref()), "limits")?;
            let moves = locks[index].is_none() && !still[which];
            ranges[which + 1].push(if moves { [-most, most] } else { [0.0; 2] });
        }
    }
    Ok(ranges)
}
