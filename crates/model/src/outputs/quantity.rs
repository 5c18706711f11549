//! A result.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;

use super::{Argument, Axis, PayloadDependence, Quantity, Shape, Sizes};
use crate::equations::chain::HandChoice;
use crate::equations::following::{FollowerLine, gather};
use crate::equations::regressor::LinkParameter;
use crate::robot::Robot;
use crate::scalar::Scalar;

/// The choices of an output's frame; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum FrameChoice {
    None,
    Frame,
    /// Several of them.
    Frames,
    Axes,
    Rows,
}

/// The facts of a quantity, beside its formulas.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// Its field in the structs that generated functions return.
    pub field: &'static str,
    /// Its letter in the equations and in the names of its entries.
    pub letter: &'static str,
    /// Its name where the letter by itself would be another quantity's; else nothing.
    pub symbol: &'static str,
    /// A line of documentation for its field.
    pub summary: &'static str,
    /// The arguments that it depends on.
    pub arguments: &'static [Argument],
    /// The arrangement of its numbers.
    pub shape: Shape,
    /// Over base parameters: what it gives with their values, and the generated constant of these.
    pub linear: Option<(&'static str, &'static str)>,
    /// The unit of an entry, given its place along each axis.
    pub unit: fn(&[Index]) -> &'static str,
    /// The scale of an error where actuators are the measure.
    pub scale: ErrorScale,
    /// Its key in files of given states.
    pub given: Option<&'static str>,
    /// The choices that the chain formulas leave; `None` if they do not give it.
    pub(super) choices: Option<&'static [Choice]>,
    /// True if the textbook recursion is a start that may be the cheapest.
    pub starts_from_recursion: bool,
    /// True if recursions give it by differences of torques alone: digits and n² recursions.
    pub by_differences: bool,
    /// The parts of a hand's form that it reads.
    pub hand: HandChoice,
    /// True if it is a matrix that is positive definite.
    pub definite: bool,
    /// True if it exists only where D has an inverse.
    pub inverts_inertia: bool,
    /// True if it depends on lengths that no torque depends on: where the first joints stand.
    pub depends_on_base: bool,
    /// Its dependence on a payload.
    pub payload_dependence: PayloadDependence,
    /// True if it depends on gravity.
    pub gravity: bool,
    /// True if joints whose axes meet at the base may be solved for as one.
    pub has_shoulder: bool,
    pub(super) frame: FrameChoice,
    /// True if it is there on a fixed base alone: what it is made of belongs to joints' own rates.
    pub on_fixed_base: bool,
    /// True if it is there on a base that floats alone.
    pub on_floating_base: bool,
    /// True if an entry is of the link by itself, of which there are more than coordinates.
    pub of_links: bool,
}

impl Facts {
    pub(super) const PLAIN: Facts = Facts {
        field: "",
        letter: "",
        symbol: "",
        summary: "",
        arguments: &[],
        shape: Shape::SCALAR,
        linear: None,
        unit: |_| "",
        scale: ErrorScale::None,
        given: None,
        choices: None,
        starts_from_recursion: false,
        by_differences: false,
        hand: HandChoice::None,
        definite: false,
        inverts_inertia: false,
        depends_on_base: false,
        payload_dependence: PayloadDependence::None,
        gravity: false,
        has_shoulder: false,
        frame: FrameChoice::None,
        on_fixed_base: false,
        on_floating_base: false,
        of_links: false,
    };

    /// A torque or a force of each joint.
    pub(super) const LOAD: Facts = Facts {
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    /// A matrix over the joints, of which nothing but the way it travels can be chosen.
    pub(super) const MATRIX: Facts = Facts {
        shape: Shape::MATRIX,
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    pub(super) fn symbol(&self) -> &'static str {
        match self.symbol {
            "" => self.letter,
            symbol => symbol,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Choice {
    /// It comes out of the recursion over velocities.
    Recursion,
    /// It may travel outward or inward.
    Travel,
    /// It may come from composite momenta, which then travel.
    Flows,
}

/// The place of an entry along one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Index {
    /// A coordinate that turns.
    Turning,
    /// A coordinate that slides.
    Sliding,
    /// A place on an axis that is the same for every arm.
    Fixed(usize),
    /// An inertial parameter of a link.
    Parameter(LinkParameter),
    /// A base parameter: a combination, whose unit its terms share.
    Base,
}

/// The scale that an error is held against where the actuators' torque limits T_i are the measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorScale {
    /// T_i
    Load,
    /// min(T_i/q̈_k, T_k/q̈_i)
    Inertia,
    /// T_i/(q̇_k q̇_m)
    Coefficient,
    /// Torque limits are no measure of it.
    None,
}

impl Quantity {
    /// Returns how its numbers are arranged.
    pub fn shape(self) -> Shape {
        self.facts().shape
    }

    /// Returns how many numbers it has.
    pub fn len(self, sizes: Sizes) -> usize {
        self.shape().len(sizes)
    }

    /// Returns the arguments that it depends on.
    pub fn arguments(self) -> &'static [Argument] {
        self.facts().arguments
    }

    /// Returns its field in the structs that generated functions return.
    pub fn field(self) -> &'static str {
        self.facts().field
    }

    /// Returns its letter in the equations; `h_ikm` for the symbols that make up h.
    pub fn symbol(self) -> &'static str {
        self.facts().symbol()
    }

    /// True if the chain formulas give it.
    pub fn is_regrouped(self) -> bool {
        self.facts().choices.is_some()
    }

    /// True if it can be had at any frame.
    pub fn is_of_frame(self) -> bool {
        self.facts().frame != FrameChoice::None
    }

    /// True if it has one entry for each link.
    pub fn is_of_links(self) -> bool {
        self.facts().of_links || self.shape().0.contains(&Axis::LinkParameters)
    }

    /// Returns the coordinates of an entry over these rows, one for each axis over them.
    pub fn coordinates(
        self,
        index: usize,
        rows: &[usize],
        sizes: Sizes,
    ) -> impl Iterator<Item = usize> {
        let places = self.shape().places(index, sizes.over(rows)).into_iter();
        places.flat_map(move |(axis, place)| coordinates(axis, place, rows, sizes))
    }

    /// Returns the unit of an entry over these rows of a robot.
    pub fn unit(self, index: usize, rows: &[usize], sizes: Sizes, robot: &Robot) -> &'static str {
        let kind = |coordinate: usize| match robot.turns(coordinate) {
            true => Index::Turning,
            false => Index::Sliding,
        };
        let mut indices: Vec<Index> = Vec::new();
        for (axis, place) in self.shape().places(index, sizes.over(rows)) {
            match axis {
                Axis::Fixed(_) => indices.push(Index::Fixed(self.component(place))),
                Axis::Coordinates | Axis::Links | Axis::Limbs => {
                    indices.extend(coordinates(axis, place, rows, sizes).into_iter().map(kind));
                }
                Axis::LinkParameters => {
                    let parameter = LinkParameter::ALL[place % LinkParameter::COUNT];
                    indices.push(Index::Parameter(parameter));
                }
                Axis::BaseParameters | Axis::Load => indices.push(Index::Base),
            }
        }
        (self.facts().unit)(&indices)
    }

    fn component(self, place: usize) -> usize {
        match self {
            Quantity::At(at) if self.facts().frame >= FrameChoice::Rows => {
                at.view().rows.indices().nth(place).unwrap_or(place)
            }
            _ => place,
        }
    }

    /// Returns the name of one entry over these coordinates, one-based: `D_12`, `h_123`, with commas
    /// where a robot has more than nine, or an axis more entries. Links are counted by their joints.
    pub fn entry(self, index: usize, rows: &[usize], sizes: Sizes) -> String {
        let letter = self.facts().letter;
        let sizes = sizes.over(rows);
        let numbers = |(axis, place): (Axis, usize)| {
            let base = match axis {
                Axis::Coordinates => 0,
                _ => sizes.floating,
            };
            match coordinates(axis, place, rows, sizes).as_slice() {
                [] => vec![place + 1],
                rows => rows.iter().map(|row| row - base + 1).collect(),
            }
        };
        let is_long =
            sizes.coordinates() > 9 || self.shape().lengths(sizes).any(|length| length > 9);
        let places = self.shape().places(index, sizes).into_iter();
        let digits: Vec<String> = places.flat_map(numbers).map(|at| at.to_string()).collect();
        match digits.as_slice() {
            [] => letter.to_string(),
            digits => format!("{letter}_{}", digits.join(if is_long { "," } else { "" })),
        }
    }

    /// Returns its entries over some rows of an arm from those over others, gathered at the leaders
    /// of joints that follow along each axis over coordinates.
    pub fn selected<S: Scalar>(
        self,
        mut values: Vec<S>,
        [from, to]: [&[usize]; 2],
        following: &[FollowerLine<S>],
        sizes: Sizes,
    ) -> Vec<S> {
        let shape = self.shape();
        let lengths: Vec<usize> = shape.lengths(sizes.over_all(from.len())).collect();
        for (place, axis) in shape.0.iter().enumerate() {
            let stride: usize = lengths[place + 1..].iter().product();
            let strides = match axis {
                Axis::Coordinates | Axis::Links if !self.is_of_links() => vec![stride],
                Axis::Limbs => vec![stride * from.len(), stride],
                _ => Vec::new(),
            };
            for stride in strides {
                gather(following, from, stride, &mut values);
            }
        }
        if from == to && sizes.floating == 0 {
            return values;
        }
        let place = |row: &usize| from.iter().position(|candidate| candidate == row);
        let places: Vec<usize> = to.iter().filter_map(place).collect();
        let sizes = sizes.over(to);
        // The rows of a base's coordinates come first, and are no links.
        let base = sizes.rows - sizes.links;
        let entry = |index: usize| {
            let axes = shape.places(index, sizes).into_iter();
            let at = axes.fold(0, |at, (axis, place)| match axis {
                Axis::Coordinates => at * from.len() + places[place],
                Axis::Links => at * from.len() + places[base + place],
                Axis::Limbs => {
                    let entry = sizes.of_blocks(place, to).into_iter().flatten();
                    entry.fold(at, |at, place| at * from.len() + places[place])
                }
                other => at * other.length(sizes) + place,
            });
            values[at].clone()
        };
        (0..shape.len(sizes)).map(entry).collect()
    }
}

/// Returns the coordinates at a place along an axis over these rows: one, or two of a limb's block;
/// none of other axes.
fn coordinates(axis: Axis, place: usize, rows: &[usize], sizes: Sizes) -> Vec<usize> {
    let over = sizes.over(rows);
    let places = match axis {
        Axis::Coordinates => [Some(place), None],
        Axis::Links => [Some(over.rows - over.links + place), None],
        Axis::Limbs => match sizes.of_blocks(place, rows) {
            Some(entry) => entry.map(Some),
            None => [None; 2],
        },
        _ => [None; 2],
    };
    let rows = places.map(|place| rows.get(place?).copied());
    rows.into_iter().flatten().collect()
}

pub(super) fn load(at: &[Index]) -> &'static str {
    by_turns(turns(at), ["N", "N·m", "N·m"])
}

/// Kilograms times metres, so many powers above those of the joints.
pub(super) fn kilograms(metres: i32) -> &'static str {
    match metres {
        ..0 => "kg/m",
        0 => "kg",
        1 => "kg·m",
        _ => "kg·m²",
    }
}

pub(super) fn by_turns(turns: i32, [none, one, more]: [&'static str; 3]) -> &'static str {
    match turns {
        0 => none,
        1 => one,
        _ => more,
    }
}

/// Returns how many of the joints turn: a force over an axis is a torque, one metre more.
pub(super) fn turns(at: &[Index]) -> i32 {
    at.iter().map(|at| i32::from(*at == Index::Turning)).sum()
}
