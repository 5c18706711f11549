//! Placements: the keys `xyz` and `rpy`.

use alloc::format;

use super::table::Table;
use super::value::Context;
use crate::robot::Placement;

/// Returns the placement of an optional key.
pub(super) fn placement(
    cx: &mut Context,
    keys: &mut Table,
    key: &'static str,
) -> Option<Placement> {
    let help = format!("{key} = {{ xyz = [0, 0, 0.1], rpy = [0, \"pi/2\", 0] }}");
    let placement = keys.table(cx, key, &help, Context::placement);
    placement.and_then(Placement::unless_identity)
}

impl Context {
    /// Reads the placement that a table says, among other keys.
    pub(super) fn placement(&mut self, table: &mut Table) -> Option<Placement> {
        const XYZ: &str = "xyz = [x, y, z], in m";
        const RPY: &str = "rpy = [roll, pitch, yaw], turns about the fixed axes x, y and z, e.g. [0, \"pi/2\", 0]";
        let xyz = match table.get("xyz") {
            None => Some(Placement::default().xyz),
            Some(value) => self.array(value, XYZ, Self::length),
        };
        let rpy = match table.get("rpy") {
            None => Some(Placement::default().rpy),
            Some(value) => self.array(value, RPY, Self::angle),
        };
        Some(Placement {
            xyz: xyz?,
            rpy: rpy?,
        })
    }
}
