//! The robot file, read strictly: a key that is not named here is refused. Every number stays the
//! text that it is in the file.

use std::collections::BTreeMap;

use num_rational::BigRational as Rational;
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;
use toml::de::{DeTable, DeValue};

use super::exact::{Angle, number};

/// A robot file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "keys that the equations do not read")]
pub struct File {
    pub(super) convention: Option<String>,
    pub(super) gravity: [String; 3],
    pub(super) joint: Vec<Row>,
    /// The base, if it floats: the first joint of the file.
    #[serde(skip)]
    pub(super) floating: Option<FloatingBase>,
    pub(super) base: Option<Placement>,
    pub(super) payload_frame: Option<Placement>,
    pub(super) tool: Option<Placement>,
    #[serde(default)]
    pub(super) limits: PayloadLimits,
    #[serde(default)]
    pub(super) frame: Vec<NamedFrame>,
    #[serde(default)]
    pub(super) scene: BTreeMap<String, Scene>,
    #[serde(skip)]
    pub(super) bare: Scene,
    /// The payload of the scene in the last row's own frame, if rows stand for placed joints.
    #[serde(skip)]
    pub(super) moved: Option<Payload>,
    name: IgnoredAny,
    allow: Option<IgnoredAny>,
    outputs: Option<IgnoredAny>,
    notes: Option<IgnoredAny>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(dead_code, reason = "keys that the equations do not read")]
pub(super) struct Scene {
    pub(super) joints: Option<Vec<String>>,
    pub(super) lock: BTreeMap<String, String>,
    pub(super) gravity: Option<[String; 3]>,
    pub(super) velocity: Option<Zero>,
    pub(super) acceleration: Option<Zero>,
    pub(super) payload: Option<Payload>,
    pub(super) r#box: SceneBounds,
    pub(super) tolerance: Option<Tolerance>,
    outputs: Option<IgnoredAny>,
    scalar: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Tolerance {
    pub(super) value: OneOrEach,
    pub(super) relative_to: String,
}

#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum OneOrEach {
    One(String),
    Each(Vec<String>),
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Zero {
    Zero,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Payload {
    pub(super) mass: String,
    pub(super) com: [String; 3],
    pub(super) inertia: Option<[String; 6]>,
    pub(super) link: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct SceneBounds {
    pub(super) position: Option<Vec<[String; 2]>>,
    pub(super) velocity: Option<Vec<String>>,
    pub(super) acceleration: Option<Vec<String>>,
    pub(super) payload: Option<Bodies>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct PayloadLimits {
    pub(super) payload: Option<Bodies>,
}

/// The bodies that there may be of a payload or a link.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bodies {
    pub(super) mass: [String; 2],
    pub(super) radius: String,
}

#[derive(Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Placement {
    pub(super) xyz: Option<[String; 3]>,
    pub(super) rpy: Option<[String; 3]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NamedFrame {
    pub(super) name: String,
    pub(super) link: String,
    #[serde(default)]
    pub(super) xyz: Option<[String; 3]>,
    #[serde(default)]
    pub(super) rpy: Option<[String; 3]>,
}

impl NamedFrame {
    pub(super) fn placement(&self) -> Placement {
        let (xyz, rpy) = (self.xyz.clone(), self.rpy.clone());
        Placement { xyz, rpy }
    }
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Row {
    pub(super) name: Option<String>,
    pub(super) kind: String,
    pub(super) parent: Option<String>,
    pub(super) placement: Option<Placement>,
    pub(super) axis: Option<[String; 3]>,
    pub(super) beta: Option<String>,
    pub(super) alpha: Option<String>,
    pub(super) a: Option<String>,
    pub(super) d: Option<String>,
    pub(super) theta: Option<String>,
    pub(super) offset: Option<String>,
    pub(super) mass: String,
    pub(super) com: Option<[String; 3]>,
    pub(super) inertia: Option<[String; 6]>,
    pub(super) viscous: Option<String>,
    pub(super) coulomb: Option<String>,
    pub(super) coulomb_width: Option<String>,
    pub(super) armature: Option<String>,
    pub(super) frame: Option<Placement>,
    pub(super) mimic: Option<Mimic>,
    pub(super) limits: Limits,
}

/// A base that floats. Its limits are of six numbers, linear over angular.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "keys that the equations do not read")]
pub(super) struct FloatingBase {
    pub(super) name: Option<String>,
    kind: IgnoredAny,
    pub(super) mass: String,
    pub(super) com: Option<[String; 3]>,
    pub(super) inertia: Option<[String; 6]>,
    #[serde(default)]
    pub(super) limits: BaseLimits,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct BaseLimits {
    pub(super) velocity: Option<[String; 6]>,
    pub(super) acceleration: Option<[String; 6]>,
    pub(super) torque: Option<[String; 6]>,
    pub(super) body: Option<Bodies>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Mimic {
    pub(super) joint: String,
    pub(super) multiplier: Option<String>,
    pub(super) offset: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct Limits {
    pub(super) position: Option<[String; 2]>,
    pub(super) velocity: Option<String>,
    pub(super) acceleration: Option<String>,
    pub(super) torque: Option<String>,
    pub(super) body: Option<Bodies>,
}

impl File {
    /// Returns the row whose link carries that of a row; none of one that the base carries.
    pub(super) fn carrier(&self, row: usize) -> Result<Option<usize>, String> {
        let joint = &self.joint[row];
        let why = match joint.parent.as_deref() {
            None => return Ok(row.checked_sub(1)),
            Some(_) if joint.placement.is_none() => "has a `parent` and no placement",
            Some(word) if self.is_base(word) => return Ok(None),
            Some(word) => match self.row(word)? {
                carrier if carrier < row => return Ok(Some(carrier)),
                _ => "comes before its `parent`",
            },
        };
        Err(format!("joint {}: it {why}", row + 1))
    }

    pub(super) fn is_base(&self, word: &str) -> bool {
        let name = self.floating.as_ref().and_then(|base| base.name.as_deref());
        word == "base" || name == Some(word)
    }

    /// Returns the row whose link a frame is fixed to; none for a base that floats.
    pub(super) fn frame_row(&self, frame: &NamedFrame) -> Result<Option<usize>, String> {
        match self.floating.is_some() && self.is_base(&frame.link) {
            true => Ok(None),
            false => self.row(&frame.link).map(Some),
        }
    }

    /// Returns true if the base floats, or links have more than one end: there is no hand.
    pub(super) fn is_tree(&self) -> bool {
        let branches = |row: usize| self.carrier(row) != Ok(Some(row - 1));
        self.floating.is_some() || (1..self.joint.len()).any(branches)
    }

    /// Returns the row whose link holds a payload: the last, but where links branch; none for a base that
    /// floats.
    pub(super) fn holder(&self, link: Option<&String>) -> Result<Option<usize>, String> {
        if self.floating.is_some() && link.is_some_and(|word| self.is_base(word)) {
            return Ok(None);
        }
        let last = self.joint.len().saturating_sub(1);
        let row = link.map(|link| self.row(link)).transpose()?;
        match (row, self.is_tree()) {
            (Some(row), true) => Ok(Some(row)),
            (None, true) => Err("a payload, and no link that holds it".into()),
            (Some(row), false) if row != last => {
                Err("a payload on another than the last link".into())
            }
            _ => Ok(Some(last)),
        }
    }

    /// Returns true if numbers of it may be rounded: its joints are placed, and have no rows, or
    /// payloads are in a frame of their own.
    pub fn is_placed(&self) -> bool {
        self.payload_frame.is_some() || self.joint.iter().any(|row| row.placement.is_some())
    }

    /// Returns this robot with the scenes and the limits of another file, and with its own payload in
    /// a scene.
    pub fn in_scenes_of(mut self, other: File, scene: Option<&str>) -> File {
        self.moved = scene.and_then(|name| self.scene.remove(name)?.payload);
        self.scene = other.scene;
        self.limits = other.limits;
        if let (Some(base), Some(other)) = (&mut self.floating, other.floating) {
            base.limits = other.limits;
        }
        for (row, other) in self.joint.iter_mut().zip(other.joint) {
            row.limits = other.limits;
        }
        self
    }
}

/// Reads a robot file.
///
/// # Errors
/// A text that is no TOML, or a key that is not known, with the words of the reader.
pub fn read(source: &str) -> Result<File, String> {
    if source.len() > 1 << 18 {
        return Err("a robot file of more than 256 KiB".into());
    }
    let table = DeTable::parse(source).map_err(|error| error.to_string())?;
    let mut value = plain(&DeValue::Table(table.into_inner()))?;
    let wrong = |error: serde_json::Error| format!("robot file: {error}");
    let joints = value.get_mut("joint").and_then(Value::as_array_mut);
    let floats = |rows: &&mut Vec<Value>| rows.first().is_some_and(|row| row["kind"] == "floating");
    let floating = joints.filter(floats).map(|joints| joints.remove(0));
    let mut file: File = serde_json::from_value(value).map_err(wrong)?;
    let base = floating.map(serde_json::from_value).transpose();
    file.floating = base.map_err(wrong)?;
    Ok(file)
}

/// Reads a number; one that is missing is zero.
pub(super) fn number_of(text: Option<&String>) -> Result<Rational, String> {
    let text = text.map_or("0", String::as_str);
    number(text).ok_or_else(|| format!("`{text}` is not a number"))
}

pub(super) fn angle_of(text: Option<&String>) -> Result<Angle, String> {
    let text = text.map_or("0", String::as_str);
    Angle::read(text).ok_or_else(|| format!("`{text}` is not an angle"))
}

fn plain(value: &DeValue) -> Result<Value, String> {
    Ok(match value {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Float(number) => Value::String(number.as_str().into()),
        DeValue::Integer(number) if number.radix() == 10 => Value::String(number.as_str().into()),
        DeValue::Array(list) => list
            .iter()
            .map(|item| plain(item.get_ref()))
            .collect::<Result<_, _>>()?,
        DeValue::Table(table) => table
            .iter()
            .map(|(key, value)| Ok((key.get_ref().to_string(), plain(value.get_ref())?)))
            .collect::<Result<_, String>>()?,
        other => {
            let why = format!("robot file: {other:?} is not a number, text, list or table");
            return Err(why);
        }
    })
}
