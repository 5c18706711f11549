//! The robot file: a strict reading of what changes the dynamics.
//!
//! Keys that are known to change nothing in the functions that are audited are named
//! in `WITHOUT_EFFECT`; every other key that is not read here is refused by its name.

use toml_span::value::{Table, Value, ValueInner};

use crate::fault::Fault;
use crate::number::{Angle, Ball};
use crate::polynomial::MAX_JOINTS;

/// Keys of a robot and of a joint without effect on torques.
const WITHOUT_EFFECT: [&str; 4] = ["name", "allow", "tool", "limits"];
/// The longest file and its longest line, so that reading ends soon.
const MOST_BYTES: usize = 1 << 16;
const MOST_COLUMNS: usize = 1 << 10;
/// The most brackets that are open in a file; the parser is recursive.
const MOST_BRACKETS: usize = 16;

/// A rigid body in the frame of a link.
#[derive(Clone, Debug)]
pub struct Body {
    /// The mass, kg.
    pub mass: Ball,
    /// The centre of mass, m.
    pub com: [Ball; 3],
    /// Ixx, Iyy, Izz, Ixy, Iyz, Ixz about the centre of mass, kg·m².
    pub inertia: [Ball; 6],
}

/// One joint with its link, as a row of a DH table.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Whether it turns; else it slides.
    pub turns: bool,
    /// The twist.
    pub alpha: Angle,
    /// The length a, m.
    pub a: Ball,
    /// What is constant of d, m: all of it if the joint turns.
    pub d: Ball,
    /// What is constant of θ, rad: all of it if the joint slides.
    pub theta: Angle,
    /// The link, and what it carries.
    pub bodies: Vec<Body>,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub viscous: Ball,
    /// The inertia of the drive as the joint feels it, kg·m² or kg.
    pub armature: Ball,
    /// Limits of position, rad or m.
    pub position: Option<[f64; 2]>,
    /// Limits of velocity, acceleration and torque, in SI units.
    pub limits: [Option<f64>; 3],
}

/// An arm of the standard or the modified (Craig) convention.
#[derive(Clone, Debug)]
pub struct Robot {
    /// Whether rows are of the modified convention.
    pub modified: bool,
    /// The acceleration of gravity in base axes, m/s².
    pub gravity: [Ball; 3],
    /// From the base to the hand.
    pub joints: Vec<Joint>,
}

/// What reading has at hand: the text, for numbers are read from their digits.
pub(crate) struct Reader<'s>(pub(crate) &'s str);

/// Parses the file, of bounded length and depth.
pub(crate) fn parse(source: &str) -> Result<Value<'_>, Fault> {
    let long = source.len() > MOST_BYTES || source.lines().any(|l| l.len() > MOST_COLUMNS);
    let open = source.lines().map(|line| match line.split_once('#') {
        // A comment, unless the sign may be in a string.
        Some((before, _)) if !before.contains(['"', '\'']) => before,
        _ => line,
    });
    let mut depth = 0usize;
    for c in open.flat_map(str::chars) {
        depth = match c {
            '[' | '{' => depth + 1,
            ']' | '}' => depth.saturating_sub(1),
            _ => depth,
        };
        if depth > MOST_BRACKETS {
            return Err(Fault::robot("[", format!("more than {MOST_BRACKETS} open brackets")));
        }
    }
    if long {
        let why = format!("at most {MOST_BYTES} bytes in lines of at most {MOST_COLUMNS}");
        return Err(Fault::robot("file", why));
    }
    toml_span::parse(source).map_err(|error| Fault::robot("file", error.to_string()))
}

impl Reader<'_> {
    /// Reads the robot's own keys.
    pub(crate) fn robot(&self, root: &Table) -> Result<Robot, Fault> {
        known(root, &["convention", "gravity", "joint", "scene"])?;
        let convention = root.get("convention").and_then(Value::as_str);
        let modified = match convention {
            Some("standard") => false,
            Some("modified") => true,
            _ => return Err(Fault::robot("convention", "expected \"standard\" or \"modified\"")),
        };
        let gravity = self.numbers(root, "gravity")?;
        let gravity = gravity.ok_or_else(|| Fault::robot("gravity", "expected three numbers"))?;
        let joints = root.get("joint").and_then(Value::as_array);
        let joints = joints.map(Vec::as_slice).unwrap_or_default();
        if !(1..=MAX_JOINTS).contains(&joints.len()) {
            let why = format!("1 to {MAX_JOINTS} joints are audited, not {}", joints.len());
            return Err(Fault::robot("joint", why));
        }
        let read = joints.iter().map(|joint| self.joint(table(joint, "joint")?));
        let joints = read.collect::<Result<_, Fault>>()?;
        Ok(Robot { modified, gravity, joints })
    }

    fn joint(&self, keys: &Table) -> Result<Joint, Fault> {
        let row = ["kind", "alpha", "a", "d", "theta", "offset", "mass", "com", "inertia"];
        known(keys, &[&row[..], &["viscous", "armature"]].concat())?;
        let turns = match keys.get("kind").and_then(Value::as_str) {
            Some("revolute") => true,
            Some("prismatic") => false,
            _ => return Err(Fault::robot("kind", "expected \"revolute\" or \"prismatic\"")),
        };
        let (theta, d) = if turns { ("offset", "d") } else { ("theta", "offset") };
        let variable = if turns { "theta" } else { "d" };
        // The joint's variable may be written as zero, which says nothing.
        if keys.contains_key(variable) && self.number(keys, variable)? != Some(Ball::default()) {
            return Err(Fault::robot(variable, "is the joint's variable and must be 0"));
        }
        let body = self.body(keys)?;
        if body.mass != Ball::default() && !keys.contains_key("inertia") {
            let why = "only a link with mass = 0 may leave it out";
            return Err(Fault::robot("inertia", why));
        }
        let none = Table::default();
        let limits = match keys.get("limits") {
            Some(value) => table(value, "limits")?,
            None => &none,
        };
        let limit = |key| Ok(self.number(limits, key)?.map(|x| x.value));
        Ok(Joint {
            name: keys.get("name").and_then(Value::as_str).map(String::from),
            turns,
            alpha: self.angle(keys, "alpha")?,
            a: self.number(keys, "a")?.unwrap_or_default(),
            d: self.number(keys, d)?.unwrap_or_default(),
            theta: self.angle(keys, theta)?,
            bodies: vec![body],
            viscous: self.number(keys, "viscous")?.unwrap_or_default(),
            armature: self.number(keys, "armature")?.unwrap_or_default(),
            position: limits.get("position").map(|x| self.range(x, turns)).transpose()?,
            limits: [limit("velocity")?, limit("acceleration")?, limit("torque")?],
        })
    }

    /// A number that a key has, read from its digits.
    pub(crate) fn number(&self, keys: &Table, key: &str) -> Result<Option<Ball>, Fault> {
        keys.get(key).map(|value| self.number_of(value, key)).transpose()
    }

    pub(crate) fn number_of(&self, value: &Value, key: &str) -> Result<Ball, Fault> {
        let read = match value.as_ref() {
            ValueInner::Integer(_) | ValueInner::Float(_) => {
                let digits = self.0.get(value.span.start..value.span.end);
                digits.and_then(Ball::parse)
            }
            ValueInner::String(text) if text.contains('/') => Ball::parse_fraction(text),
            _ => None,
        };
        read.ok_or_else(|| Fault::robot(key, "expected a number in decimal, at most 1e100"))
    }

    fn angle(&self, keys: &Table, key: &str) -> Result<Angle, Fault> {
        let value = keys.get(key);
        value.map_or(Ok(Angle::number(Ball::default()).unwrap_or_default()), |value| {
            self.angle_of(value, key)
        })
    }

    pub(crate) fn angle_of(&self, value: &Value, key: &str) -> Result<Angle, Fault> {
        let read = match value.as_str() {
            Some(text) => Angle::parse(text),
            None => Angle::number(self.number_of(value, key)?),
        };
        read.ok_or_else(|| Fault::robot(key, "expected an angle: rad, \"pi/2\" or \"90deg\""))
    }

    /// `N` numbers that a key has.
    pub(crate) fn numbers<const N: usize>(
        &self,
        keys: &Table,
        key: &str,
    ) -> Result<Option<[Ball; N]>, Fault> {
        let Some(value) = keys.get(key) else {
            return Ok(None);
        };
        let items = value.as_array().map(Vec::as_slice).unwrap_or_default();
        let read = items.iter().map(|item| self.number_of(item, key));
        let read: Vec<Ball> = read.collect::<Result<_, Fault>>()?;
        let read = read.try_into();
        read.map(Some).map_err(|_| Fault::robot(key, format!("expected {N} numbers")))
    }

    /// A mass with its centre and its inertia, none where none is given; a tensor that
    /// is written as three rows is refused.
    pub(crate) fn body(&self, keys: &Table) -> Result<Body, Fault> {
        let mass = self.number(keys, "mass")?;
        let mass = mass.ok_or_else(|| Fault::robot("mass", "expected a mass"))?;
        let com = self.numbers(keys, "com")?;
        if mass != Ball::default() && com.is_none() {
            return Err(Fault::robot("com", "expected the centre of a mass that is not 0"));
        }
        let inertia = self.numbers(keys, "inertia")?.unwrap_or_default();
        Ok(Body { mass, com: com.unwrap_or_default(), inertia })
    }

    /// Both ends of a range of positions, rad or m.
    pub(crate) fn range(&self, value: &Value, turns: bool) -> Result<[f64; 2], Fault> {
        let key = "position";
        let end = |item: &Value| match turns {
            true => Ok(self.angle_of(item, key)?.radians.value),
            false => Ok(self.number_of(item, key)?.value),
        };
        match value.as_array().map(Vec::as_slice) {
            Some([low, high]) => Ok([end(low)?, end(high)?]),
            _ => Err(Fault::robot(key, "expected [lowest, highest]")),
        }
    }
}

/// Refuses every key that is neither read nor without effect.
pub(crate) fn known(keys: &Table, read: &[&str]) -> Result<(), Fault> {
    let unknown = |key: &&str| !read.contains(key) && !WITHOUT_EFFECT.contains(key);
    match keys.keys().map(|key| key.name.as_ref()).find(unknown) {
        Some(key) => Err(Fault::robot(key, "this key is not audited")),
        None => Ok(()),
    }
}

pub(crate) fn table<'v, 'd>(value: &'v Value<'d>, key: &str) -> Result<&'v Table<'d>, Fault> {
    value.as_table().ok_or_else(|| Fault::robot(key, "expected a table"))
}
