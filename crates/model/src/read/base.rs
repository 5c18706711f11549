//! The first `[[joint]]` table, where it is a base that floats.

use num_traits::Zero;
use toml_span::Value;

use super::table::Table;
use super::value::{Context, bodies};
use crate::number::Rational;
use crate::robot::{BaseLimits, FloatingBase};

/// Returns true if a table is of a joint that floats.
pub(super) fn floats(table: &Value) -> bool {
    let entries = table.as_table();
    let kind = entries.and_then(|entries| entries.get("kind"));
    kind.and_then(Value::as_str) == Some(FloatingBase::KIND)
}

/// Zeros stand in for values that cannot be read, which are reported.
pub(super) fn read(cx: &mut Context, mut keys: Table<'_>) -> FloatingBase {
    const MASS: &str = "mass = 6.9, in kg; a base without mass has mass = 0";
    const COM: &str = "com = [x, y, z]: the centre of mass in the base's frame, in m; only a base with mass = 0 may leave it out";
    const INERTIA: &str = "inertia = [Ixx, Iyy, Izz, Ixy, Iyz, Ixz] about the centre of mass, in kg·m²; only a base with mass = 0 may leave it out";
    const NONE: &str = "a base that floats is where it is, nothing drives it and no friction holds it: leave it out";

    let table = &mut keys;
    let name = table.optional(cx, "name", Context::string);
    table.get("kind");
    let mass = table.required(cx, "mass", MASS, Context::number);
    let is_massless = mass.as_ref().is_some_and(Zero::is_zero);
    let com = match table.get("com") {
        None if is_massless => None,
        _ => table.required(cx, "com", COM, |cx, value| {
            cx.array(value, COM, Context::number)
        }),
    };
    let inertia = match table.get("inertia") {
        None if is_massless => None,
        _ => table.required(cx, "inertia", INERTIA, Context::inertia),
    };
    let limits = limits(cx, table);
    for key in [
        "placement",
        "axis",
        "parent",
        "alpha",
        "beta",
        "a",
        "d",
        "theta",
        "offset",
        "viscous",
        "coulomb",
        "coulomb_width",
        "armature",
        "mimic",
        "frame",
    ] {
        if let Some(value) = table.get(key) {
            let message = alloc::format!("`{key}` of a base that floats");
            cx.refuse::<()>(value, message, NONE);
        }
    }
    keys.finish(cx);
    FloatingBase {
        name,
        mass: mass.unwrap_or_default(),
        com: com.unwrap_or_default(),
        inertia: inertia.unwrap_or_default(),
        limits,
    }
}

fn limits(cx: &mut Context, keys: &mut Table) -> BaseLimits {
    const HELP: &str = "limits = { velocity = [2, 2, 1, 4, 4, 4] }: of (v, ω) in the base's axes, m/s and rad/s; `acceleration` of their rates, `torque` of force over moment";
    let read = keys.table(cx, "limits", HELP, |cx, keys| {
        let mut six = |cx: &mut Context, key: &'static str| -> Option<[Rational; 6]> {
            keys.optional(cx, key, |cx, value| cx.array(value, HELP, Context::number))
        };
        let limits = BaseLimits {
            velocity: six(cx, "velocity"),
            acceleration: six(cx, "acceleration"),
            torque: six(cx, "torque"),
            body: bodies(cx, keys, "body"),
        };
        if let Some(value) = keys.get("position") {
            let help = "where it is has no effect: leave it out";
            cx.refuse::<()>(value, "`position` of a base that floats", help);
        }
        Some(limits)
    });
    read.unwrap_or_default()
}
