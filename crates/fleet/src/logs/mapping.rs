//! The quantities of a log's columns, and their units: flags, or a small file.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use dalembert_model::robot::{JointKind, Robot};
use datafusion::arrow::datatypes::{DataType, Field, Schema};
use serde::Deserialize;

use crate::error::Error;

/// Columns and units of logs.
#[derive(Args, Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Mapping {
    /// A TOML file with any of the flags below, such as `position = "joint_{}"`
    #[arg(long, value_name = "FILE")]
    #[serde(skip)]
    pub mapping: Option<PathBuf>,
    /// Column of times [default: time]
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// Unit of times that are plain numbers [default: s]
    #[arg(long)]
    pub time_unit: Option<TimeUnit>,
    /// Columns of positions: a pattern as `q{}`, names with commas, or a list column [default: q{}]
    #[arg(long, value_name = "COLUMNS")]
    pub position: Option<String>,
    /// Columns of velocities [default: qd{}]
    #[arg(long, value_name = "COLUMNS")]
    pub velocity: Option<String>,
    /// Columns of accelerations [default: qdd{}]
    #[arg(long, value_name = "COLUMNS")]
    pub acceleration: Option<String>,
    /// Columns of measured torques [default: tau{}]
    #[arg(long, value_name = "COLUMNS")]
    pub effort: Option<String>,
    /// Unit of angles, and of their rates
    #[arg(long)]
    pub units: Option<Units>,
    /// N·m or N per unit of effort, with commas: torque constants where it is in A
    #[arg(long, value_name = "FACTORS", value_delimiter = ',')]
    pub torque_constants: Option<Vec<f64>>,
    /// Highest frequency of the motion, Hz, by which rates are differentiated [default: 5]
    #[arg(long, value_name = "HZ")]
    pub motion_frequency: Option<f64>,
    /// Topic of `sensor_msgs/JointState` in MCAP files [default: the only one]
    #[arg(long, value_name = "TOPIC")]
    pub topic: Option<String>,
    /// Names of the joints in `JointState`, with commas [default: the robot's, if it has them]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub joint_names: Option<Vec<String>>,
}

/// Unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Units {
    /// Radians
    Rad,
    /// Degrees
    Deg,
}

/// Unit of times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum TimeUnit {
    /// Seconds
    S,
    /// Milliseconds
    Ms,
    /// Microseconds
    Us,
    /// Nanoseconds
    Ns,
}

/// The place of a quantity in a log.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A column a joint.
    Columns(Vec<String>),
    /// One list, of a number a joint by its type.
    List(String),
    /// One list, whose rows may have other lengths: those of pandas and polars.
    Ragged(String),
}

impl Source {
    pub fn columns(&self) -> &[String] {
        match self {
            Source::Columns(columns) => columns,
            Source::List(column) | Source::Ragged(column) => std::slice::from_ref(column),
        }
    }
}

/// The quantities of the logs of a robot.
pub const QUANTITIES: [&str; 4] = ["position", "velocity", "acceleration", "effort"];

/// Columns and units, with a robot's joints and without what was left open.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    pub(crate) joints: usize,
    pub(crate) time: String,
    /// Seconds a unit.
    pub(crate) time_factor: f64,
    patterns: [String; 4],
    /// For each quantity: SI units per unit, an entry a joint.
    pub(crate) factors: [Vec<f64>; 4],
    pub(crate) motion_frequency: f64,
    pub(crate) topic: Option<String>,
    pub(crate) joint_names: Vec<String>,
}

/// The places of positions, velocities, accelerations and torques in a log; rates may be missing.
pub type Layout = [Option<Source>; 4];

impl Mapping {
    /// Resolves flags, file and defaults for a robot; flags go before the file.
    pub fn resolve(&self, robot: &Robot) -> Result<Columns, Error> {
        let file = match &self.mapping {
            Some(path) => read(path)?,
            None => Mapping::default(),
        };
        let n = robot.joints.len();
        let choice = |flag: &Option<String>, file: &Option<String>, default: &str| {
            flag.clone().or(file.clone()).unwrap_or(default.to_owned())
        };
        let units = self.units.or(file.units).unwrap_or(Units::Rad);
        let angle = |kind: JointKind| match (units, kind) {
            (Units::Deg, JointKind::Revolute) => core::f64::consts::PI / 180.0,
            _ => 1.0,
        };
        let angles: Vec<f64> = robot.joints.iter().map(|joint| angle(joint.kind)).collect();
        let constants = self.torque_constants.clone().or(file.torque_constants);
        let constants = constants.unwrap_or_else(|| vec![1.0; n]);
        length("torque constants", constants.len(), n)?;
        if constants.iter().any(|x| !x.is_finite() || *x == 0.0) {
            let why = "torque constants have to be finite and not zero";
            return Err(Error::new(why));
        }
        let frequency = self.motion_frequency.or(file.motion_frequency);
        let names = self.joint_names.clone().or(file.joint_names);
        let joints = robot.joints.iter().map(|joint| joint.name.clone());
        let joint_names: Vec<String> = names.or_else(|| joints.collect()).unwrap_or_default();
        if !joint_names.is_empty() {
            length("names of joints", joint_names.len(), n)?;
        }
        Ok(Columns {
            joints: n,
            time: choice(&self.time, &file.time, "time"),
            time_factor: match self.time_unit.or(file.time_unit).unwrap_or(TimeUnit::S) {
                TimeUnit::S => 1.0,
                TimeUnit::Ms => 1e-3,
                TimeUnit::Us => 1e-6,
                TimeUnit::Ns => 1e-9,
            },
            patterns: [
                choice(&self.position, &file.position, "q{}"),
                choice(&self.velocity, &file.velocity, "qd{}"),
                choice(&self.acceleration, &file.acceleration, "qdd{}"),
                choice(&self.effort, &file.effort, "tau{}"),
            ],
            factors: [angles.clone(), angles.clone(), angles, constants],
            motion_frequency: frequency.unwrap_or(5.0),
            topic: self.topic.clone().or(file.topic),
            joint_names,
        })
    }
}

fn read(path: &Path) -> Result<Mapping, Error> {
    let text = std::fs::read_to_string(path).map_err(|why| Error::new(why).at(path.display()))?;
    toml::from_str(&text).map_err(|why| Error::new(why).at(path.display()))
}

fn length(what: &str, found: usize, expected: usize) -> Result<(), Error> {
    match found == expected {
        true => Ok(()),
        false => Err(Error::new(format!(
            "there are {found} {what}, and the robot has {expected} joints"
        ))),
    }
}

impl Columns {
    /// Returns the columns of a file that this program wrote: canonical names, SI units.
    pub fn canonical(joints: usize) -> Columns {
        let one = vec![1.0; joints];
        Columns {
            joints,
            time: "time".into(),
            time_factor: 1.0,
            patterns: ["q{}", "qd{}", "qdd{}", "tau{}"].map(str::to_owned),
            factors: [one.clone(), one.clone(), one.clone(), one],
            motion_frequency: 5.0,
            topic: None,
            joint_names: Vec::new(),
        }
    }

    fn names(&self, quantity: usize) -> Vec<String> {
        let pattern = &self.patterns[quantity];
        let trimmed = |name: &str| name.trim().to_owned();
        let numbered = |i: usize| pattern.replace("{}", &i.to_string());
        match pattern.contains("{}") {
            true => (1..=self.joints).map(numbered).collect(),
            false => pattern.split(',').map(trimmed).collect(),
        }
    }

    /// Finds the quantities in a log.
    pub fn layout(&self, schema: &Schema) -> Result<Layout, Error> {
        let time = schema.field_with_name(&self.time);
        let time = time.map_err(|_| missing(&self.time, "time", schema))?;
        let kind = time.data_type();
        if !kind.is_numeric() && !matches!(kind, DataType::Timestamp(..)) {
            return Err(unexpected(time, "a number or a timestamp"));
        }
        let source = |quantity| self.source(quantity, schema);
        Ok([source(0)?, source(1)?, source(2)?, source(3)?])
    }

    fn source(&self, quantity: usize, schema: &Schema) -> Result<Option<Source>, Error> {
        let mut names = self.names(quantity);
        let n = self.joints;
        let field_of = |name: &String| schema.field_with_name(name).ok();
        // Without `q1` and others `q{}` is `q`, if that is a list.
        let list = self.patterns[quantity].replace("{}", "");
        let is_list = field_of(&list).is_some_and(|field| item(field.data_type()).is_some());
        if is_list && names.iter().all(|name| field_of(name).is_none()) {
            names = vec![list];
        }
        let Some(first) = names.iter().find_map(field_of) else {
            // Rates can be differentiated.
            return match quantity {
                1 | 2 => Ok(None),
                _ => Err(missing(&names[0], QUANTITIES[quantity], schema)),
            };
        };
        if let [name] = &names[..]
            && (n > 1 || item(first.data_type()).is_some())
        {
            let (kind, item) = (first.data_type(), item(first.data_type()));
            return match (kind, item.is_some_and(DataType::is_numeric)) {
                (DataType::FixedSizeList(_, width), true) if *width as usize == n => {
                    Ok(Some(Source::List(name.clone())))
                }
                (DataType::List(_) | DataType::LargeList(_), true) => {
                    Ok(Some(Source::Ragged(name.clone())))
                }
                _ => Err(Error::new(format!(
                    "column `{name}` is {kind}; expected a list of {n} numbers, or one column a \
                     joint: `--{} '{name}{{}}'`",
                    QUANTITIES[quantity]
                ))),
            };
        }
        if names.len() != n {
            return Err(Error::new(format!(
                "`{}` names {} columns of {}, and the robot has {n} joints",
                self.patterns[quantity],
                names.len(),
                QUANTITIES[quantity]
            )));
        }
        for name in &names {
            let lost = || missing(name, QUANTITIES[quantity], schema);
            let field = field_of(name).ok_or_else(lost)?;
            if !field.data_type().is_numeric() {
                return Err(unexpected(field, "a number"));
            }
        }
        Ok(Some(Source::Columns(names)))
    }
}

fn item(kind: &DataType) -> Option<&DataType> {
    match kind {
        DataType::List(item) | DataType::LargeList(item) | DataType::FixedSizeList(item, _) => {
            Some(item.data_type())
        }
        _ => None,
    }
}

fn unexpected(field: &Field, expected: &str) -> Error {
    let (name, kind) = (field.name(), field.data_type());
    let why = format!("column `{name}` is {kind}: {expected} was expected");
    Error::new(why)
}

fn missing(name: &str, quantity: &str, schema: &Schema) -> Error {
    let fields = schema.fields().iter();
    let names: Vec<&str> = fields.map(|field| field.name().as_str()).collect();
    let few = names[..names.len().min(12)].join(", ");
    let more = if names.len() > 12 { ", …" } else { "" };
    Error::new(format!(
        "there is no column `{name}`; there are {few}{more}: name it with `--{quantity}`"
    ))
}
