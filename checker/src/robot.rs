//! The robot file, read strictly: a key that is not named here is refused by its name.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::fault::Fault;
use crate::literal::{Angle, Literal};
use crate::number::Real;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound = "S: Deserialize<'de>")]
pub(crate) struct File<S> {
    pub(crate) convention: Convention,
    pub(crate) gravity: [Literal; 3],
    pub(crate) joint: Vec<Row>,
    #[serde(default = "BTreeMap::new")]
    pub(crate) scene: BTreeMap<String, S>,
    /// These, and the frame of the hand, move nothing.
    #[serde(rename = "name")]
    _name: IgnoredAny,
    #[serde(rename = "allow")]
    _allow: Option<IgnoredAny>,
    #[serde(rename = "outputs")]
    _outputs: Option<IgnoredAny>,
    #[serde(rename = "tool")]
    _tool: Option<IgnoredAny>,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Convention {
    Standard,
    Modified,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    Revolute,
    Prismatic,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Row {
    pub(crate) name: Option<String>,
    pub(crate) kind: Option<Kind>,
    alpha: Literal,
    a: Literal,
    d: Literal,
    theta: Literal,
    offset: Literal,
    mass: Option<Literal>,
    com: Option<[Literal; 3]>,
    inertia: Option<[Literal; 6]>,
    viscous: Literal,
    armature: Literal,
    pub(crate) limits: Limits,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Limits {
    pub(crate) position: Option<[Literal; 2]>,
    pub(crate) velocity: Option<Literal>,
    pub(crate) acceleration: Option<Literal>,
    pub(crate) torque: Option<Literal>,
}

/// A rigid body in the frame of a link.
#[derive(Clone, Debug)]
pub struct Body {
    /// The mass, kg.
    pub mass: Real,
    /// The centre of mass, m.
    pub com: [Real; 3],
    /// Ixx, Iyy, Izz, Ixy, Iyz, Ixz about the centre of mass, kg·m².
    pub inertia: [Real; 6],
}

impl Body {
    pub(crate) fn read(
        mass: &Literal,
        com: &[Literal; 3],
        inertia: &[Literal; 6],
    ) -> Result<Body, Fault> {
        let [x, y, z] = com;
        let mut moments = Vec::new();
        for one in inertia {
            moments.push(one.real("inertia")?);
        }
        Ok(Body {
            mass: mass.real("mass")?,
            com: [x.real("com")?, y.real("com")?, z.real("com")?],
            inertia: moments.try_into().unwrap_or_default(),
        })
    }
}

/// A joint that turns or slides, with its link, as a row of a DH table.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Whether it turns; else it slides.
    pub turns: bool,
    /// The twist.
    pub alpha: Angle,
    /// The length a, m.
    pub a: Real,
    /// What is constant of d, m: all of it if the joint turns.
    pub d: Real,
    /// What is constant of θ: all of it if the joint slides.
    pub theta: Angle,
    /// The link, and what it carries.
    pub bodies: Vec<Body>,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub viscous: Real,
    /// The inertia of the drive as the joint feels it, kg·m² or kg.
    pub armature: Real,
}

impl Row {
    pub(crate) fn joint(&self) -> Result<Joint, Fault> {
        let turns = self.turns()?;
        let (theta, d) = if turns {
            (&self.offset, &self.d)
        } else {
            (&self.theta, &self.offset)
        };
        if !(if turns { &self.theta } else { &self.d }).is_zero() {
            return Err(Fault::robot(
                "theta or d",
                "is the joint's variable, so it must be 0",
            ));
        }
        let missing =
            |key| Fault::robot(key, "only `com` and `inertia` of mass = 0 may be missing");
        let mass = self.mass.as_ref().ok_or(missing("mass"))?;
        if !mass.is_zero() && (self.com.is_none() || self.inertia.is_none()) {
            return Err(missing("com or inertia"));
        }
        let (com, inertia) = (self.com.clone(), self.inertia.clone());
        Ok(Joint {
            turns,
            alpha: self.alpha.angle("alpha")?,
            a: self.a.real("a")?,
            d: d.real("d")?,
            theta: theta.angle("theta")?,
            bodies: vec![Body::read(
                mass,
                &com.unwrap_or_default(),
                &inertia.unwrap_or_default(),
            )?],
            viscous: self.viscous.real("viscous")?,
            armature: self.armature.real("armature")?,
        })
    }

    /// Refuses limits between which nothing is, as whoever generates does.
    pub(crate) fn in_order(&self) -> Result<(), Fault> {
        if let Some(range) = &self.limits.position {
            self.range(range, "the lowest position is not below the highest")?;
        }
        let known = |key, literal: &Option<Literal>| {
            let size = literal.as_ref().map_or(Ok(0.0), |size| size.double(key))?;
            not_negative(key, size, format!("{key} is negative"))
        };
        known("velocity", &self.limits.velocity)?;
        known("acceleration", &self.limits.acceleration)?;
        known("torque", &self.limits.torque)
    }

    /// The ends of a range of positions, if they are in order.
    pub(crate) fn range(&self, [low, high]: &[Literal; 2], why: &str) -> Result<[f64; 2], Fault> {
        let range = [self.position(low)?, self.position(high)?];
        match range[0] < range[1] {
            true => Ok(range),
            false => Err(Fault::robot("position", why)),
        }
    }

    /// Whether the joint turns; else it slides.
    pub(crate) fn turns(&self) -> Result<bool, Fault> {
        let missing = || Fault::robot("kind", "expected revolute or prismatic");
        Ok(self.kind.ok_or_else(missing)? == Kind::Revolute)
    }

    /// An angle or a length, as the joint has it.
    pub(crate) fn position(&self, at: &Literal) -> Result<f64, Fault> {
        if self.turns()? {
            Ok(at.angle("position")?.radians)
        } else {
            at.double("position")
        }
    }
}

pub(crate) fn not_negative(key: &str, value: f64, why: String) -> Result<(), Fault> {
    match value >= 0.0 {
        true => Ok(()),
        false => Err(Fault::robot(key, why)),
    }
}
