//! Units of entries, by their powers of SI units.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::equations::regressor::LinkParameter;

/// The place of an entry along one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Index {
    /// A joint that turns.
    Turning,
    /// A joint that slides.
    Sliding,
    /// A place on an axis that is the same for every arm.
    Fixed(usize),
    /// An inertial parameter of a link.
    Parameter(LinkParameter),
    /// A base parameter: a combination, whose unit its terms share.
    Base,
}

/// The unit of a quantity's entries.
#[derive(Clone, Copy, Debug)]
pub(super) enum Unit {
    /// None, or one that the entry's name does not tell.
    None,
    /// One by its name, of every entry.
    Named(&'static str),
    /// Of a pose [R | p]: its last column is a place.
    Pose,
    /// An acceleration of a joint, which has a radian where it turns.
    JointAcceleration,
    /// Powers of kg, N, m and s where joints slide and components are linear; and of m what a
    /// joint that turns, or an angular component, adds along each axis.
    Powers([i32; 4], &'static [i32]),
}

impl Unit {
    /// A force along an axis, or a torque about it.
    pub(super) const LOAD: Unit = Unit::Powers([0, 1, 0, 0], &[1]);
    /// Mass, first moments and second moments.
    pub(super) const INERTIA: Unit = Unit::Powers([1, 0, 0, 0], &[1, 1]);

    /// Returns the unit of an entry at these places.
    pub(super) fn at(self, places: &[Index]) -> String {
        match self {
            Unit::None => String::new(),
            Unit::Named(name) => name.to_string(),
            Unit::Pose if places.last() == Some(&Index::Fixed(3)) => "m".to_string(),
            Unit::Pose => "1".to_string(),
            Unit::JointAcceleration if places == [Index::Turning] => "rad/s²".to_string(),
            Unit::JointAcceleration => "m/s²".to_string(),
            Unit::Powers(mut powers, turns) => {
                let turns = turns.iter().zip(places);
                powers[2] += turns
                    .map(|(turn, place)| turn * place.metres())
                    .sum::<i32>();
                product(powers)
            }
        }
    }
}

impl Index {
    /// Returns the powers of m that it has more than a slide, a linear component or a moment of
    /// first order.
    fn metres(self) -> i32 {
        match self {
            Index::Turning | Index::Fixed(3..) | Index::Parameter(LinkParameter::Mass) => 1,
            Index::Parameter(LinkParameter::Tensor(..)) => -1,
            Index::Sliding | Index::Fixed(_) | Index::Base => 0,
            Index::Parameter(LinkParameter::First(_)) => 0,
        }
    }
}

/// Returns the product of kg, N, m and s with these powers.
fn product(powers: [i32; 4]) -> String {
    let factors = |sign: i32| {
        let names = ["kg", "N", "m", "s"].into_iter().zip(powers);
        let names = names.filter_map(|(name, power)| match power * sign {
            1 => Some(name.to_string()),
            2 => Some(format!("{name}²")),
            3 => Some(format!("{name}³")),
            _ => None,
        });
        names.collect::<Vec<String>>()
    };
    let (above, below) = (factors(1), factors(-1));
    let above = match above.is_empty() {
        true => "1".to_string(),
        false => above.join("·"),
    };
    match below.as_slice() {
        [] => above,
        [one] => format!("{above}/{one}"),
        several => format!("{above}/({})", several.join("·")),
    }
}
