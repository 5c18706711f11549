//! A robot whose parameters are numbers of a scalar.

use dalembert_model::number::{Angle, Rational, Rounded};
use dalembert_model::robot::{Frame, Inertia, Joint, Placement, Robot};

use dalembert_codegen::ScalarType;

/// Returns the robot with every number rounded to the scalar, angles in radians too;
/// multiples of π stay what they are. `None` if a number is beyond its range.
pub fn rounded(robot: &Robot, scalar: ScalarType) -> Option<Robot> {
    let number = |value: &Rational| -> Option<Rational> {
        let nearest = match scalar {
            ScalarType::F64 => f64::nearest_rational(value),
            ScalarType::F32 => f64::from(f32::nearest_rational(value)),
        };
        Rational::from_float(nearest)
    };
    let angle = |angle: &Angle| -> Option<Angle> {
        Some(match angle {
            Angle::PiTimes(_) => angle.clone(),
            Angle::Radians(radians) => Angle::Radians(number(radians)?).canonical(),
        })
    };
    let triple = |[x, y, z]: &[Rational; 3]| Some([number(x)?, number(y)?, number(z)?]);
    let joint = |joint: &Joint| -> Option<Joint> {
        let [xx, yy, zz, xy, yz, xz] = joint.inertia.entries().map(number);
        Some(Joint {
            alpha: angle(&joint.alpha)?,
            beta: angle(&joint.beta)?,
            a: number(&joint.a)?,
            d: number(&joint.d)?,
            theta: angle(&joint.theta)?,
            mass: number(&joint.mass)?,
            com: triple(&joint.com)?,
            inertia: Inertia::of([xx?, yy?, zz?, xy?, yz?, xz?]),
            viscous: number(&joint.viscous)?,
            coulomb: number(&joint.coulomb)?,
            coulomb_width: number(&joint.coulomb_width)?,
            armature: number(&joint.armature)?,
            ..joint.clone()
        })
    };
    let placement = |placement: &Option<Placement>| {
        let placement = placement.as_ref().map(
            |Placement {
                 xyz,
                 rpy: [r, p, y],
             }| {
                Some(Placement {
                    xyz: triple(xyz)?,
                    rpy: [angle(r)?, angle(p)?, angle(y)?],
                })
            },
        );
        placement.map_or(Some(None), |rounded| rounded.map(Some))
    };
    let frame = |frame: &Frame| {
        let placement = placement(&Some(frame.placement.clone()))?;
        Some(Frame {
            placement: placement.unwrap_or_default(),
            ..frame.clone()
        })
    };
    Some(Robot {
        gravity: triple(&robot.gravity)?,
        base: placement(&robot.base)?,
        tool: placement(&robot.tool)?,
        payload_frame: placement(&robot.payload_frame)?,
        joints: robot.joints.iter().map(joint).collect::<Option<_>>()?,
        frames: robot.frames.iter().map(frame).collect::<Option<_>>()?,
        ..robot.clone()
    })
}
