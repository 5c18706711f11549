//! From a robot with exact parameters to an arm in any scalar.

use super::{Arm, Link, Rotor};
use crate::number::{Exact, Rational};
use crate::robot::Robot;

impl<S> Arm<S> {
    /// The arm of a robot, each exact parameter sent through `scalar`:
    /// rounding for floats, a constant for symbols, a residue for fields.
    pub fn from_robot(robot: &Robot, scalar: &mut impl FnMut(&Exact) -> S) -> Arm<S> {
        let mut number = |value: &Rational| scalar(&Exact::from(value.clone()));
        let gravity = [0, 1, 2].map(|axis| number(&robot.gravity[axis]));
        let links = robot.joints.iter().map(|joint| {
            let mut pair = |angle| {
                let pair = Exact::rotor(angle);
                Rotor {
                    sin: scalar(&pair.sin),
                    cos: scalar(&pair.cos),
                }
            };
            let (alpha, theta) = (pair(&joint.alpha), pair(&joint.theta));
            let mut number = |value: &Rational| scalar(&Exact::from(value.clone()));
            Link {
                kind: joint.kind,
                alpha,
                theta,
                a: number(&joint.a),
                d: number(&joint.d),
                mass: number(&joint.mass),
                com: [0, 1, 2].map(|axis| number(&joint.com[axis])),
                inertia: joint.inertia.map(&mut number),
                viscous: number(&joint.viscous),
                armature: number(&joint.armature),
            }
        });
        Arm {
            convention: robot.convention,
            gravity,
            links: links.collect(),
        }
    }
}
