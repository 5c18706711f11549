//! Special values of a robot's geometry, which may be why a coupling vanishes.

use dalembert_model::equations::SinCosPair;
use dalembert_model::equations::matrix::Columns;
use dalembert_model::robot::{Convention, JointKind};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use super::world::Geometry;

/// A special value of the geometry. Those that say least about an arm come first: the search for a
/// smallest set drops them in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Fact {
    /// The armature of a joint is zero.
    NoArmature(usize),
    /// d of a row is zero.
    NoOffset(usize),
    /// a of a row is zero.
    NoLength(usize),
    /// A component of the origin of a joint that is placed is zero.
    NoOrigin(usize, usize),
    /// θ of a slide, or of a joint that is locked, is a multiple of a right angle; a placement turns by
    /// right angles. It stays the angle that it is.
    RightTurn(usize),
    /// Gravity is along an axis of the base, or absent.
    Gravity,
    /// Two axes are perpendicular.
    Across(usize),
    /// Two axes are parallel.
    Along(usize),
}

/// In the field a number is zero by its value, not by structure.
pub(crate) fn is_zero(x: &Field) -> bool {
    *x == Field::ZERO
}

pub(crate) fn is_right(pair: &SinCosPair<Field>) -> bool {
    is_zero(&pair.sin) || is_zero(&pair.cos)
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl Geometry<'_> {
    /// Lists the facts of the arm.
    pub(crate) fn facts(&self) -> Vec<Fact> {
        let mut facts = Vec::new();
        let arm = &self.arm;
        for (row, link) in arm.links.iter().enumerate() {
            if is_zero(&link.armature) {
                facts.push(Fact::NoArmature(row));
            }
            let (slides, is_locked) = (link.kind == JointKind::Prismatic, self.is_locked(row));
            if let Some(place) = &link.place {
                let origin = place.origin.iter().enumerate();
                let zeros = origin.filter(|(_, x)| is_zero(x));
                facts.extend(zeros.map(|(axis, _)| Fact::NoOrigin(row, axis)));
                let along = &place.axes[2][2];
                if place.axes.iter().flatten().filter(|x| is_zero(x)).count() == 6 {
                    facts.push(Fact::RightTurn(row));
                }
                match () {
                    () if is_zero(along) => facts.push(Fact::Across(row)),
                    () if along.mul(along) == Field::ONE => facts.push(Fact::Along(row)),
                    () => {}
                }
                continue;
            }
            // The first step along the first axis moves nothing.
            let has_effect = row > 0 || arm.convention == Convention::Modified;
            if is_zero(&link.d) && (is_locked || !slides) && has_effect {
                facts.push(Fact::NoOffset(row));
            }
            if is_zero(&link.a) {
                facts.push(Fact::NoLength(row));
            }
            if (slides || is_locked) && is_right(&self.constant_turn(row)) {
                facts.push(Fact::RightTurn(row));
            }
            if link.beta.is_none() {
                match () {
                    () if is_zero(&link.alpha.sin) => facts.push(Fact::Along(row)),
                    () if is_zero(&link.alpha.cos) => facts.push(Fact::Across(row)),
                    () => {}
                }
            }
        }
        if arm.gravity.iter().filter(|g| !is_zero(g)).count() <= 1 {
            facts.push(Fact::Gravity);
        }
        facts.sort();
        facts
    }

    /// Writes a fact in words.
    pub(crate) fn describe(&self, fact: Fact) -> String {
        let axes = |row: usize| match (&self.arm.links[row].place, self.arm.convention) {
            (Some(_), _) => {
                let carrier = self.arm.carrier(row).map_or(0, |carrier| carrier + 1);
                [carrier, row + 1]
            }
            (None, Convention::Standard) => [row + 1, row + 2],
            (None, Convention::Modified) => [row, row + 1],
        };
        let both = |row: usize, how: &str| {
            let [x, y] = axes(row);
            format!("axes {x} and {y} {how}")
        };
        match fact {
            Fact::NoArmature(row) => format!("joint {} has no armature", row + 1),
            Fact::NoOffset(row) => format!("d{} = 0", row + 1),
            Fact::NoLength(row) => match is_zero(&self.arm.links[row].alpha.sin) {
                true => both(row, "coincide"),
                false => both(row, "meet"),
            },
            Fact::NoOrigin(row, axis) => format!("p{}{} = 0", AXES[axis], row + 1),
            Fact::RightTurn(row) => match &self.arm.links[row].place {
                Some(place) => {
                    let [carrier, moved] = axes(row);
                    format!("frame {moved} has {}", along_axes(place, moved, carrier))
                }
                None => {
                    let turn = right_angle(&self.constant_turn(row));
                    format!("θ{} = {turn}", row + 1)
                }
            },
            Fact::Gravity => match self.arm.gravity.iter().position(|g| !is_zero(g)) {
                Some(axis) => format!("gravity is along {}0", AXES[axis]),
                None => "there is no gravity".to_owned(),
            },
            Fact::Across(row) => both(row, "are perpendicular"),
            Fact::Along(row) => both(row, "are parallel"),
        }
    }
}

/// Writes a turn by right angles.
fn right_angle(pair: &SinCosPair<Field>) -> &'static str {
    match () {
        () if is_zero(&pair.sin) && pair.cos == Field::ONE => "0",
        () if is_zero(&pair.sin) => "180°",
        () if pair.sin == Field::ONE => "90°",
        () => "−90°",
    }
}

/// Writes the directions of the axes of a frame that is turned by right angles: `x3 along z2`.
fn along_axes(place: &Columns<Field>, moved: usize, carrier: usize) -> String {
    let axes = AXES.iter().zip(&place.axes).map(|(axis, components)| {
        let along = components.iter().position(|x| !is_zero(x)).unwrap_or(0);
        let sign = match components[along] == Field::ONE {
            true => "",
            false => "−",
        };
        format!("{axis}{moved} along {sign}{}{carrier}", AXES[along])
    });
    axes.collect::<Vec<_>>().join(", ")
}
