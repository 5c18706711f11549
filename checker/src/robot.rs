//! The robot file, read strictly: a key that is not named here is refused by its name.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::fault::Fault;
use crate::literal::{Angle, Literal};
use crate::number::Real;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound = "S: Deserialize<'de>")]
#[allow(dead_code, reason = "what is `IgnoredAny` may be there")]
pub(crate) struct File<S> {
    pub(crate) convention: Option<String>,
    pub(crate) gravity: [Literal; 3],
    pub(crate) joint: Vec<Row>,
    /// Frame 0 in the axes that gravity is in, and the frame of payloads in the last link's.
    pub(crate) base: Option<Placement>,
    pub(crate) payload_frame: Option<Placement>,
    #[serde(default = "BTreeMap::new")]
    pub(crate) scene: BTreeMap<String, S>,
    /// The hand's frame in the last link's.
    pub(crate) tool: Option<Placement>,
    name: IgnoredAny,
    allow: Option<IgnoredAny>,
    outputs: Option<IgnoredAny>,
    frame: Option<IgnoredAny>,
}

/// A frame in another one.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Placement {
    xyz: [Literal; 3],
    rpy: [Literal; 3],
}

impl Placement {
    pub(crate) fn steps(&self) -> Result<Vec<Step>, Fault> {
        let mut steps = vec![Step::Shift(Literal::reals(&self.xyz, "xyz")?)];
        for (axis, angle) in [Z, Y, X].into_iter().zip(self.rpy.iter().rev()) {
            steps.push(Step::about(axis, angle.angle("rpy")?));
        }
        Ok(steps)
    }
}

pub(crate) fn steps(placement: &Option<Placement>) -> Result<Vec<Step>, Fault> {
    placement.as_ref().map_or(Ok(Vec::new()), Placement::steps)
}

/// The axes that follow x, y and z.
pub const X: [usize; 2] = [1, 2];
const Y: [usize; 2] = [2, 0];
/// See [`X`].
pub const Z: [usize; 2] = [0, 1];

/// A part of the way from a frame to another.
#[derive(Clone, Debug)]
pub enum Step<N = Real> {
    /// A turn, given by the two axes that follow its own, and its sine and cosine.
    Turn([usize; 2], [N; 2]),
    /// A shift, m.
    Shift([N; 3]),
}

impl Step {
    fn about(axis: [usize; 2], angle: Angle) -> Step {
        Step::Turn(axis, [angle.sin, angle.cos])
    }
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[allow(dead_code, reason = "what is `IgnoredAny` may be there")]
pub(crate) struct Row {
    pub(crate) name: Option<String>,
    kind: Option<String>,
    placement: Option<Placement>,
    axis: Option<[Literal; 3]>,
    beta: Literal,
    alpha: Literal,
    a: Literal,
    d: Literal,
    theta: Literal,
    offset: Literal,
    mass: Option<Literal>,
    com: Option<[Literal; 3]>,
    inertia: Option<[Literal; 6]>,
    viscous: Literal,
    coulomb: Literal,
    coulomb_width: IgnoredAny,
    armature: Literal,
    frame: Option<Placement>,
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
    /// The way from the link's frame to that in which the rest is.
    pub frame: Vec<Step>,
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
        Ok(Body {
            frame: Vec::new(),
            mass: mass.real("mass")?,
            com: Literal::reals(com, "com")?,
            inertia: Literal::reals(inertia, "inertia")?,
        })
    }
}

/// A joint that turns about its z or slides along it, with its link.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Whether it turns; else it slides.
    pub turns: bool,
    /// The way from the frame of the link before to the joint's.
    pub before: Vec<Step>,
    /// The way from the joint's frame, moved, to that of its link.
    pub behind: Vec<Step>,
    /// The way from the frame of its link to that which `link_poses` shows of it.
    pub frame: Vec<Step>,
    /// What is constant of d, m: all of it if the joint turns.
    pub d: Real,
    /// What is constant of θ: all of it if the joint slides.
    pub theta: Angle,
    /// The link, and what it carries.
    pub bodies: Vec<Body>,
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub viscous: Real,
    /// Whether it has Coulomb friction, which no torque here has.
    pub rubs: bool,
    /// The inertia of the drive as the joint feels it, kg·m² or kg.
    pub armature: Real,
}

impl Row {
    /// Returns the ways before and behind the joint.
    fn ways(&self, convention: Option<&str>) -> Result<[Vec<Step>; 2], Fault> {
        let mut row = vec![
            Step::Shift([self.a.real("a")?, Real::default(), Real::default()]),
            Step::about(X, self.alpha.angle("alpha")?),
        ];
        match (convention, &self.placement, &self.axis) {
            (Some("modified"), None, None) if self.beta.is_zero() => Ok([row, vec![]]),
            (Some("standard"), None, None) => {
                if !self.beta.is_zero() {
                    row.push(Step::about(Y, self.beta.angle("beta")?));
                }
                Ok([vec![], row])
            }
            (None, Some(placement), Some([x, y, z])) => {
                let [x, y, z] = [x.double("axis")?, y.double("axis")?, z.double("axis")?];
                let across = (x * x + y * y).sqrt();
                let length = (across * across + z * z).sqrt();
                let has_direction = length > 1e-100 && length < 1e100;
                Fault::require(has_direction, "axis", "it has no direction")?;
                // Exact along the axes; else both are rounded a few times.
                let turn = |axis, sin: f64, cos: f64, is_exact: bool| {
                    let radius = if is_exact { 0.0 } else { 1e-15 };
                    Step::Turn(axis, [sin, cos].map(|value| Real { value, radius }))
                };
                let (is_flat, is_along) = (x == 0.0 || y == 0.0, across == 0.0 || z == 0.0);
                let (sin, cos) = match across == 0.0 {
                    true => (0.0, 1.0),
                    false => (y / across, x / across),
                };
                let (tilt, up) = (across / length, z / length);
                let mut before = placement.steps()?;
                before.extend([turn(Z, sin, cos, is_flat), turn(Y, tilt, up, is_along)]);
                let behind = vec![turn(Y, -tilt, up, is_along), turn(Z, -sin, cos, is_flat)];
                Ok([before, behind])
            }
            _ => Err(Fault::robot(
                "placement",
                "expected `convention` and rows, or `placement` and `axis` of each joint",
            )),
        }
    }

    pub(crate) fn joint(&self, convention: Option<&str>) -> Result<Joint, Fault> {
        let [before, behind] = self.ways(convention)?;
        let turns = self.turns()?;
        let (theta, d) = match turns {
            true => (&self.offset, &self.d),
            false => (&self.theta, &self.offset),
        };
        let variable = if turns { &self.theta } else { &self.d };
        let why = "is the joint's variable, so it must be 0";
        Fault::require(variable.is_zero(), "theta or d", why)?;
        let why = "only `com` and `inertia` of mass = 0 may be missing";
        let mass = self.mass.as_ref().ok_or(Fault::robot("mass", why))?;
        let has_both = self.com.is_some() && self.inertia.is_some();
        Fault::require(mass.is_zero() || has_both, "com or inertia", why)?;
        let com = self.com.clone().unwrap_or_default();
        let inertia = self.inertia.clone().unwrap_or_default();
        Ok(Joint {
            turns,
            before,
            behind,
            frame: steps(&self.frame)?,
            d: d.real("d")?,
            theta: theta.angle("theta")?,
            bodies: vec![Body::read(mass, &com, &inertia)?],
            viscous: self.viscous.real("viscous")?,
            rubs: !self.coulomb.is_zero(),
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
            Fault::require(size >= 0.0, key, &format!("{key} is negative"))
        };
        known("velocity", &self.limits.velocity)?;
        known("acceleration", &self.limits.acceleration)?;
        known("torque", &self.limits.torque)
    }

    /// Returns the ends of a range of positions, if they are in order.
    pub(crate) fn range(&self, [low, high]: &[Literal; 2], why: &str) -> Result<[f64; 2], Fault> {
        let range = [self.position(low)?, self.position(high)?];
        Fault::require(range[0] < range[1], "position", why).map(|()| range)
    }

    /// Returns whether the joint turns; else it slides.
    pub(crate) fn turns(&self) -> Result<bool, Fault> {
        match self.kind.as_deref() {
            Some("revolute") => Ok(true),
            Some("prismatic") => Ok(false),
            _ => Err(Fault::robot("kind", "expected revolute or prismatic")),
        }
    }

    /// Returns an angle or a length, as the joint has it.
    pub(crate) fn position(&self, at: &Literal) -> Result<f64, Fault> {
        match self.turns()? {
            true => Ok(at.angle("position")?.radians),
            false => at.double("position"),
        }
    }
}
