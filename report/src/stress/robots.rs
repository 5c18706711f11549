//! Robots made out of a robot: other masses, lengths, bases, tools.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Robot};
use num_traits::Zero;

/// Returns 10^e
pub fn power(e: i32) -> Rational {
    let ten = Rational::from_integer(10.into());
    let size = num_traits::pow(ten, e.unsigned_abs() as usize);
    if e < 0 { size.recip() } else { size }
}

/// Masses and inertias from the base to the hand, growing (or shrinking) by
/// equal ratios up to 10^e at the last link.
pub fn mass_ratio(robot: &Robot, e: i32) -> Robot {
    let last = robot.joints.len().saturating_sub(1).max(1) as i32;
    each(robot, |index, joint| {
        // Whole powers of ten: exact, and short in decimals.
        scale_mass(joint, &power(e * index as i32 / last));
    })
}

/// Returns all lengths times 10^e, inertias times its square.
pub fn lengths(robot: &Robot, e: i32) -> Robot {
    each(robot, |_, joint| scale_length(joint, &power(e)))
}

/// Lengths from 10⁻⁶ at the base to 10⁶ at the hand, or the other way round.
pub fn mixed_lengths(robot: &Robot, long_hand: bool) -> Robot {
    let last = robot.joints.len().saturating_sub(1).max(1) as i32;
    each(robot, |index, joint| {
        let e = 12 * index as i32 / last - 6;
        scale_length(joint, &power(if long_hand { e } else { -e }));
    })
}

/// Returns the last links without mass and inertia; rotors too, or nothing would be
/// singular.
pub fn massless(robot: &Robot, links: usize) -> Robot {
    let first = robot.joints.len().saturating_sub(links);
    each(robot, |index, joint| {
        if index >= first {
            scale_mass(joint, &Rational::zero());
            joint.armature = Rational::zero();
        }
    })
}

/// Returns all of the last link's mass in one point, at the origin of its frame.
pub fn point_mass(robot: &Robot) -> Robot {
    let last = robot.joints.len().saturating_sub(1);
    each(robot, |index, joint| {
        if index == last {
            joint.com = Default::default();
            joint.inertia = Inertia::default();
            joint.armature = Rational::zero();
            if joint.mass.is_zero() {
                joint.mass = power(0);
            }
        }
    })
}

/// Returns a point mass of 10^e kg more in the hand, 0.1 m from its frame's origin
/// along x and z: the last link's body becomes the two together.
pub fn payload(robot: &Robot, e: i32) -> Robot {
    let last = robot.joints.len().saturating_sub(1);
    let at = [power(-1), Rational::zero(), power(-1)];
    each(robot, |index, joint| {
        if index == last {
            add_point(joint, &power(e), &at);
        }
    })
}

/// Returns the base 10^e m away, along all that has no effect: d_1, and for modified
/// DH a_1.
pub fn base_offset(robot: &Robot, e: i32) -> Robot {
    let convention = robot.convention;
    each(robot, |index, joint| {
        if index == 0 {
            joint.d += power(e);
            if convention == Convention::Modified {
                joint.a += power(e);
            }
        }
    })
}

/// Returns a million turns more on every offset, as a float of radians.
pub fn huge_offset(robot: &Robot) -> Option<Robot> {
    let mut possible = true;
    let robot = each(robot, |_, joint| {
        if joint.kind == JointKind::Revolute {
            let sum = joint.theta.to_f64() + 1e6 * std::f64::consts::TAU;
            match Rational::from_float(sum) {
                Some(sum) => joint.theta = Angle::Radians(sum),
                None => possible = false,
            }
        }
    });
    possible.then_some(robot)
}

/// Returns the robot with right angles typed with five digits; `None` if the robot has none.
pub fn typed_angles(robot: &Robot) -> Option<Robot> {
    let right = Rational::new(15708.into(), 10000.into());
    let mut any = false;
    let robot = each(robot, |_, joint| {
        let typed = match joint.alpha.quarter_turns() {
            Some(1) => right.clone(),
            Some(3) => -right.clone(),
            _ => return,
        };
        joint.alpha = Angle::Radians(typed);
        any = true;
    });
    any.then_some(robot)
}

/// Returns the robot's joints again and again, up to `n`.
pub fn repeated(robot: &Robot, n: usize) -> Robot {
    let unnamed = robot.joints.iter().map(|joint| Joint {
        name: None,
        ..joint.clone()
    });
    Robot {
        joints: unnamed.cycle().take(n.min(Robot::MAX_JOINTS)).collect(),
        ..robot.clone()
    }
}

/// Returns the robot without gravity.
pub fn weightless(robot: &Robot) -> Robot {
    Robot {
        gravity: Default::default(),
        ..robot.clone()
    }
}

fn each(robot: &Robot, mut change: impl FnMut(usize, &mut Joint)) -> Robot {
    let mut robot = robot.clone();
    for (index, joint) in robot.joints.iter_mut().enumerate() {
        change(index, joint);
    }
    robot
}

fn scale_mass(joint: &mut Joint, factor: &Rational) {
    joint.mass *= factor;
    scale_inertia(&mut joint.inertia, factor);
}

fn scale_length(joint: &mut Joint, factor: &Rational) {
    joint.a *= factor;
    joint.d *= factor;
    for component in &mut joint.com {
        *component *= factor;
    }
    scale_inertia(&mut joint.inertia, &(factor * factor));
}

fn scale_inertia(tensor: &mut Inertia<Rational>, factor: &Rational) {
    *tensor = tensor.map(|entry| entry * factor);
}

/// Makes two bodies one: about their common centre of mass the reduced mass at their distance is
/// added to the inertia.
fn add_point(joint: &mut Joint, mass: &Rational, at: &[Rational; 3]) {
    let total = &joint.mass + mass;
    let reduced = &joint.mass * mass / &total;
    let between: [Rational; 3] = std::array::from_fn(|i| &at[i] - &joint.com[i]);
    for (component, between) in joint.com.iter_mut().zip(&between) {
        *component += between * mass / &total;
    }
    let [x, y, z] = &between;
    let tensor = &mut joint.inertia;
    tensor.xx += &reduced * (y * y + z * z);
    tensor.yy += &reduced * (x * x + z * z);
    tensor.zz += &reduced * (x * x + y * y);
    tensor.xy -= &reduced * x * y;
    tensor.yz -= &reduced * y * z;
    tensor.xz -= &reduced * x * z;
    joint.mass = total;
}
