//! Holds the arm against gravity, with a tool in its hand.

use crate::{Joints, arm, carrying, varied, with_a_kilogram};

/// The stiffness and the damping of [`hold`], N·m/rad and N·m s/rad.
const STIFFNESS: f64 = 80.0;
const DAMPING: f64 = 6.0;

/// Returns the torques that let the arm float: it stays where a hand puts it.
pub fn float(q: &Joints) -> Joints {
    arm::gravity(q)
}

/// Returns the torques that pull the arm softly to a pose.
pub fn hold(q: &Joints, qd: &Joints, pose: &Joints) -> Joints {
    let load = arm::gravity(q);
    std::array::from_fn(|i| load[i] + STIFFNESS * (pose[i] - q[i]) - DAMPING * qd[i])
}

/// Half a kilogram, 0.1 m in front of the last link. A body that cannot exist would not compile.
const TOOL: carrying::Payload =
    carrying::Payload::new(0.5, [0.0, 0.0, 0.1], [1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0]).unwrap();

/// Returns the torques that hold the tool.
pub fn hold_a_tool(q: &Joints) -> Joints {
    // Once for each tool.
    let load = carrying::load(&TOOL);
    let sideways = carrying::Gravity([9.81, 0.0, 0.0]);
    carrying::gravity(q, &sideways, &load)
}

/// Returns the torques of an arm whose second link is heavier than in the robot file.
pub fn with_a_heavy_link(q: &Joints, qd: &Joints, qdd: &Joints) -> Option<Joints> {
    let inertia = [0.012, 0.082, 0.078, 0.0, 0.0, 0.004];
    let second = varied::Body::new(6.2, [-0.19, 0.0, 0.04], inertia)?;
    // Places count from zero.
    let load = varied::load(&varied::BODIES.with(1, second));
    Some(varied::inverse_dynamics(q, qd, qdd, &load))
}

/// Returns the mass in the hand that explains the torques measured at poses, in kg, by least squares.
///
/// Torques are linear in a mass at a known position in the hand, so the torques of one
/// kilogram give those of any mass. `None` if the mass changes no torque at these poses.
pub fn mass(measured: &[(Joints, Joints)]) -> Option<f64> {
    let (mut along, mut size) = (0.0, 0.0);
    for (q, tau) in measured {
        let (empty, loaded) = (arm::gravity(q), with_a_kilogram::gravity(q));
        for i in 0..arm::N {
            let kilogram = loaded[i] - empty[i];
            along += kilogram * (tau[i] - empty[i]);
            size += kilogram * kilogram;
        }
    }
    (size > 0.0).then(|| along / size)
}

/// Returns the torques that sensors would measure at poses with a mass in the hand, without noise;
/// `None` if the mass is negative.
pub fn measured(poses: &[Joints], mass: f64) -> Option<Vec<(Joints, Joints)>> {
    let load = carrying::load(&carrying::Payload::new(mass, [0.0, 0.0, 0.02], [0.0; 6])?);
    let floor = carrying::Gravity([0.0, 0.0, -9.81]);
    let with = |q: &Joints| (*q, carrying::gravity(q, &floor, &load));
    Some(poses.iter().map(with).collect())
}
