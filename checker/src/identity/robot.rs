//! The robot file, read strictly: a key that is not named here is refused. Every number stays the
//! text that it is in the file.

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;
use toml::de::{DeTable, DeValue};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "what is `IgnoredAny` may be there")]
pub struct File {
    pub convention: Option<String>,
    pub gravity: [String; 3],
    pub joint: Vec<Row>,
    pub base: Option<Placement>,
    pub payload_frame: Option<Placement>,
    pub tool: Option<Placement>,
    #[serde(default)]
    pub frame: Vec<Frame>,
    name: IgnoredAny,
    scene: Option<IgnoredAny>,
    allow: Option<IgnoredAny>,
    outputs: Option<IgnoredAny>,
}

#[derive(Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Placement {
    pub xyz: Option<[String; 3]>,
    pub rpy: Option<[String; 3]>,
}

/// A frame that is fixed to a link.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frame {
    pub name: String,
    pub link: String,
    #[serde(default)]
    pub xyz: Option<[String; 3]>,
    #[serde(default)]
    pub rpy: Option<[String; 3]>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Row {
    pub name: Option<String>,
    pub kind: String,
    pub placement: Option<Placement>,
    pub axis: Option<[String; 3]>,
    pub beta: Option<String>,
    pub alpha: Option<String>,
    pub a: Option<String>,
    pub d: Option<String>,
    pub theta: Option<String>,
    pub offset: Option<String>,
    pub mass: String,
    pub com: Option<[String; 3]>,
    pub inertia: Option<[String; 6]>,
    pub viscous: Option<String>,
    pub coulomb: Option<String>,
    pub coulomb_width: Option<String>,
    pub armature: Option<String>,
    pub frame: Option<Placement>,
    pub mimic: Option<Mimic>,
    pub limits: Limits,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mimic {
    pub joint: String,
    pub multiplier: Option<String>,
    pub offset: Option<String>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    pub position: Option<[String; 2]>,
    pub velocity: Option<String>,
    pub acceleration: Option<String>,
    pub torque: Option<String>,
}

/// Reads a robot file.
///
/// # Errors
/// What is no TOML, or has a key that is not known, with the reader's words.
pub fn read(source: &str) -> Result<File, String> {
    if source.len() > 1 << 18 {
        return Err("a robot file of more than 256 KiB".into());
    }
    let table = DeTable::parse(source).map_err(|error| error.to_string())?;
    let value = plain(&DeValue::Table(table.into_inner()))?;
    serde_json::from_value(value).map_err(|error| format!("robot file: {error}"))
}

/// Returns a value with its numbers as text.
fn plain(value: &DeValue) -> Result<Value, String> {
    Ok(match value {
        DeValue::String(text) => Value::String(text.to_string()),
        DeValue::Float(number) => Value::String(number.as_str().into()),
        DeValue::Integer(number) if number.radix() == 10 => Value::String(number.as_str().into()),
        DeValue::Array(list) => list
            .iter()
            .map(|item| plain(item.get_ref()))
            .collect::<Result<_, _>>()?,
        DeValue::Table(table) => {
            let entry = |(key, value): (_, &toml::Spanned<DeValue>)| {
                let key: &toml::Spanned<std::borrow::Cow<str>> = key;
                Ok((key.get_ref().to_string(), plain(value.get_ref())?))
            };
            Value::Object(table.iter().map(entry).collect::<Result<_, String>>()?)
        }
        other => {
            return Err(format!(
                "robot file: {other:?} is no number, text, list or table"
            ));
        }
    })
}
