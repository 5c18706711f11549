//! A tool in the hand, on an arm that hangs on a wall.

use crate::{Joints, carrying};

/// Returns the torques that hold half a kilogram, 0.1 m in front of the last link.
pub fn hold_a_tool(q: &Joints) -> Joints {
    let tool = carrying::Payload::new(0.5, [0.0, 0.0, 0.1], [1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0]);
    // Once for each tool.
    let load = carrying::load(&tool);
    let sideways = carrying::Gravity([9.81, 0.0, 0.0]);
    carrying::gravity(q, &sideways, &load)
}
