//! One `[[joint]]` table.

use alloc::format;
use core::ops::Range;

use num_traits::Zero;
use toml_span::Value;

use super::table::Table;
use super::value::{Context, bodies, body, placement};
use crate::number::{Angle, Rational};
use crate::robot::{FloatingBase, Joint, JointKind, Limits, Placed};

const ROW: [&str; 6] = ["alpha", "beta", "a", "d", "theta", "offset"];

pub(super) struct Read<'v> {
    pub(super) joint: Joint,
    pub(super) placed: Option<Placed>,
    pub(super) parent: Option<&'v Value<'v>>,
    pub(super) mimic: Option<&'v Value<'v>>,
    pub(super) span: Range<usize>,
}

/// Zeros stand in for values that cannot be read, which are reported.
pub(super) fn read<'v>(cx: &mut Context, mut keys: Table<'v>) -> Read<'v> {
    const KIND: &str = "kind = \"revolute\" or \"prismatic\"";
    const FIRST: &str =
        "the base is the one body that floats: put its [[joint]] table before the others";

    let table = &mut keys;
    let name = table.optional(cx, "name", Context::string);
    let kind = table.required(cx, "kind", KIND, |cx, value| {
        match value.as_str() == Some(FloatingBase::KIND) {
            true => cx.refuse(value, "only the first joint can float", FIRST),
            false => cx.word(value, &JointKind::WORDS, ""),
        }
    });
    let alpha = angle(cx, table, "alpha");
    let beta = angle(cx, table, "beta");
    let a = number(cx, table, "a");
    let (d, theta) = variable(cx, table, kind);
    let placed = placed(cx, table);
    let body = body(cx, table, "link", "4.8", "link frame");
    let parent = table.get("parent");
    let joint = Joint {
        name,
        parent: None,
        place: None,
        kind: kind.unwrap_or(JointKind::Revolute),
        alpha,
        beta,
        a,
        d,
        theta,
        mass: body.mass,
        com: body.com,
        inertia: body.inertia,
        viscous: number(cx, table, "viscous"),
        coulomb: number(cx, table, "coulomb"),
        coulomb_width: number(cx, table, "coulomb_width"),
        armature: number(cx, table, "armature"),
        // Also one that is its row's: moments are about its origin.
        frame: placement(cx, table, "frame"),
        limits: limits(cx, table, kind),
    };
    let (mimic, span) = (table.get("mimic"), table.span.clone());
    keys.finish(cx);
    Read {
        joint,
        placed,
        parent,
        mimic,
        span,
    }
}

fn number(cx: &mut Context, keys: &mut Table, key: &'static str) -> Rational {
    keys.optional(cx, key, Context::number).unwrap_or_default()
}

fn angle(cx: &mut Context, keys: &mut Table, key: &'static str) -> Angle {
    keys.optional(cx, key, Context::angle).unwrap_or_default()
}

/// The constant part of the joint's variable, d or theta, is called `offset`.
fn variable(cx: &mut Context, keys: &mut Table, kind: Option<JointKind>) -> (Rational, Angle) {
    let (d, theta) = (number(cx, keys, "d"), angle(cx, keys, "theta"));
    let (key, kind_word, is_zero, constants) = match kind {
        Some(JointKind::Revolute) => {
            let offset = angle(cx, keys, "offset");
            ("theta", "revolute", theta.is_zero(), (d, offset))
        }
        Some(JointKind::Prismatic) => {
            let offset = number(cx, keys, "offset");
            ("d", "prismatic", d.is_zero(), (offset, theta))
        }
        // Without a kind there is no saying what the offset is.
        None => {
            keys.get("offset");
            return (d, theta);
        }
    };
    if let (false, Some(value)) = (is_zero, keys.get(key)) {
        let message = format!("`{key}` of a {kind_word} joint is its variable, so it must be 0");
        let help = "a constant that is added to it is called `offset`";
        cx.refuse::<()>(value, message, help);
    }
    constants
}

fn placed(cx: &mut Context, keys: &mut Table) -> Option<Placed> {
    const AXIS: &str = "axis = [0, 0, 1]: the joint's axis in the axes of its link's frame";
    let (place, axis) = (keys.get("placement"), keys.get("axis"));
    let row = ROW.map(|key| keys.get(key).map(|value| (key, value)));
    let mut row_entries = row.into_iter().flatten();
    if let (None, Some(axis)) = (place, axis)
        && let Some((row, _)) = row_entries.next()
    {
        let message = format!("`axis` beside `{row}`, and no `placement`");
        let help = "an axis belongs to a joint that is placed; in a DH table joints act along \
                    z: leave `axis` out";
        return cx.refuse(axis, message, help);
    }
    place.or(axis)?;
    for (key, value) in row_entries {
        let message = format!("`{key}` of a joint that is placed");
        let help = "a placement takes the place of the DH row: leave the one or the other";
        cx.refuse::<()>(value, message, help);
    }
    let placement = placement(cx, keys, "placement").unwrap_or_default();
    let direction = keys.required(cx, "axis", AXIS, |cx, value| {
        let axis: [Rational; 3] = cx.array(value, AXIS, Context::number)?;
        match axis.iter().all(Zero::is_zero) {
            true => cx.refuse(value, "an axis of length zero has no direction", AXIS),
            false => Some(axis),
        }
    });
    let axis = direction.unwrap_or_default();
    Some(Placed { placement, axis })
}

fn limits(cx: &mut Context, keys: &mut Table, kind: Option<JointKind>) -> Limits {
    const HELP: &str =
        "limits = { position = [-2.8, 2.8], velocity = 8, acceleration = 20, torque = 97.6 }";
    let read = keys.table(cx, "limits", HELP, |cx, keys| {
        // Without a kind there is no saying what a position is.
        let position = keys.get("position").filter(|_| kind.is_some());
        let position = position.and_then(|_| {
            keys.optional(cx, "position", |cx, value| {
                cx.range(value, kind, "position = [lowest, highest], or leave it out")
            })
        });
        let turns = kind == Some(JointKind::Revolute);
        Some(Limits {
            position,
            velocity: keys.optional(cx, "velocity", |cx, v| cx.rate(v, turns, "rad/s")),
            acceleration: keys.optional(cx, "acceleration", |cx, v| cx.rate(v, turns, "rad/s²")),
            torque: keys.optional(cx, "torque", Context::number),
            body: bodies(cx, keys, "body"),
        })
    });
    read.unwrap_or_default()
}
