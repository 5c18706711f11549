//! The first `[[joint]]` table, where it is a base that floats.

use toml_span::Value;

use super::table::Table;
use super::value::{Context, bodies, body};
use crate::number::Rational;
use crate::robot::{BaseLimits, FloatingBase};

pub(super) fn floats(table: &Value) -> bool {
    let entries = table.as_table();
    let kind = entries.and_then(|entries| entries.get("kind"));
    kind.and_then(Value::as_str) == Some(FloatingBase::KIND)
}

pub(super) fn read(cx: &mut Context, mut keys: Table<'_>) -> FloatingBase {
    const NONE: &str = "a base that floats is where it is, nothing drives it and no friction holds it: leave it out";
    const OF_JOINTS: &str = "placement axis parent alpha beta a d theta offset viscous coulomb \
                             coulomb_width armature mimic frame";

    let table = &mut keys;
    let name = table.optional(cx, "name", Context::string);
    table.get("kind");
    let body = body(cx, table, "base", "6.9", "base's frame");
    let limits = limits(cx, table);
    for key in OF_JOINTS.split(' ') {
        if let Some(value) = table.get(key) {
            let message = alloc::format!("`{key}` of a base that floats");
            cx.refuse::<()>(value, message, NONE);
        }
    }
    keys.finish(cx);
    FloatingBase {
        name,
        mass: body.mass,
        com: body.com,
        inertia: body.inertia,
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
