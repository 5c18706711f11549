//! The mass in the hand, from the torques that hold it.

use crate::{Joints, arm, with_a_kilogram};

/// Returns the mass that explains the torques measured at poses, in kg, by least squares.
///
/// Torques are linear in a mass whose place in the hand is known, so a kilogram of it
/// tells what any other mass does. `None` where no pose depends on the mass.
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
