//! The reach of an arm, and inertias that are far too large for it.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use num_traits::{Signed, Zero};

use super::units::{shown, whole};
use super::{Inertia, Joint, Placement, Position, Robot};
use crate::number::{Rational, Rounded};

/// A body whose mass is further from its centre than this many times the arm's reach, or
/// metres for an arm without lengths, was probably given in kg·mm².
const MAX_GYRATION: i64 = 3;

/// In metres, without the base; zero of an arm without lengths.
pub(crate) fn reach(robot: &Robot, placed: &[Placement]) -> Rational {
    let travel = |joint: &Joint| {
        let ends = joint.limits.position.iter().flatten();
        let lengths = ends.filter_map(|end| match end {
            Position::Length(length) => Some(length.abs()),
            Position::Angle(_) => None,
        });
        lengths.max().unwrap_or_default()
    };
    let rows = robot.rows();
    let mut distances: Vec<Rational> = Vec::with_capacity(rows.len());
    for (row, joint) in rows.iter().enumerate() {
        let placement = joint.place.as_ref().map(|place| &place.placement);
        let step = placement.or(placed.get(row)).map(Placement::size);
        let link_length = joint.a.abs() + joint.d.abs() + travel(joint) + step.unwrap_or_default();
        let before = joint.carrier(row).and_then(|link| distances.get(link));
        distances.push(before.cloned().unwrap_or_default() + link_length);
    }
    let tool: Rational = robot.tool.iter().map(Placement::size).sum();
    let size = |xyz: &[Rational; 3]| xyz.iter().map(Signed::abs).sum::<Rational>();
    let bodies = rows.iter().map(|joint| size(&joint.com));
    let furthest = distances.into_iter().max().unwrap_or_default();
    furthest + tool + bodies.max().unwrap_or_default()
}

/// A body whose mass is all at a distance k from an axis has the moment m k².
pub(crate) fn large_inertia(
    inertia: &Inertia<Rational>,
    mass: &Rational,
    reach: &Rational,
) -> Option<(String, String)> {
    let largest = (&inertia.xx).max(&inertia.yy).max(&inertia.zz);
    let most = match reach.is_zero() {
        true => whole(MAX_GYRATION),
        false => whole(MAX_GYRATION) * reach,
    };
    if !largest.is_positive() || !mass.is_positive() || *largest <= &most * &most * mass {
        return None;
    }
    let away = libm::sqrt(f64::nearest_rational(&(largest / mass)));
    let metres = f64::nearest_rational(reach);
    let arm = match reach.is_zero() {
        true => String::new(),
        false => format!(", and the arm reaches {metres:.3} m"),
    };
    let (mass, moment) = (shown(mass), shown(largest));
    let less = shown(&(largest / whole(1_000_000)));
    let message = format!(
        "a mass of {mass} kg with a moment of {moment} kg·m² is {away:.3} m from its axis{arm}"
    );
    let help = format!(
        "inertias are in kg·m²: of kg·mm², write {less} for {moment}; it is taken as it stands"
    );
    Some((message, help))
}
