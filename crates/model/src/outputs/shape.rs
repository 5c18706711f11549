//! The shape of a result's numbers.

use alloc::vec::Vec;

use crate::equations::regressor::LinkParameter;
use crate::robot::Robot;

/// An axis of a result's array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// An entry a coordinate of the velocity: those of a base that floats, then one a joint; in a
    /// scene, those that results are over.
    Coordinates,
    /// An entry a joint, of the link that it moves; in a scene, those that results are over.
    Links,
    /// So many entries, whatever the arm.
    Fixed(usize),
    /// An entry an inertial parameter, link by link, in a scene too.
    LinkParameters,
    /// The blocks of a matrix over joints, one a limb, one behind the other, each row by row; in a scene,
    /// over the joints that results are over.
    Limbs,
    /// An entry a base parameter: how many there are, the arm says, and the scene.
    BaseParameters,
    /// An entry a regrouped parameter that depends on arguments.
    Load,
}

/// The numbers that the lengths of axes follow from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// The coordinates that results are over.
    pub rows: usize,
    /// The joints among them.
    pub links: usize,
    /// All joints.
    pub joints: usize,
    /// The coordinates of a base that floats: six, or none.
    pub floating: usize,
    /// The joints with which the limbs of a base that floats begin, a bit each; none on a fixed base.
    pub limbs: u64,
    /// The entries of the limbs' blocks.
    pub blocks: usize,
    /// The base parameters; zero where nothing is over these.
    pub base: usize,
    /// The regrouped parameters that depend on arguments; zero where none do.
    pub load: usize,
    /// The links whose bodies are arguments.
    pub bodies: usize,
    /// The rows of the table: joints that follow others have rows too.
    pub table: usize,
}

impl Sizes {
    /// Returns the sizes of results over all joints on a fixed base, none over base parameters.
    pub fn whole(joints: usize) -> Sizes {
        Sizes {
            rows: joints,
            links: joints,
            joints,
            table: joints,
            ..Sizes::default()
        }
    }

    /// Returns the sizes of results over all coordinates of a robot.
    pub fn of(robot: &Robot) -> Sizes {
        let limbs = robot.floating.as_ref().map_or(0, |_| robot.limb_starts());
        Sizes {
            table: robot.rows().len(),
            ..Sizes::floating(robot.base_coordinates(), robot.joints.len(), limbs)
        }
    }

    /// Returns the sizes of results over all coordinates, with limbs that begin with these joints.
    pub fn floating(floating: usize, joints: usize, limbs: u64) -> Sizes {
        let sizes = Sizes {
            floating,
            limbs,
            ..Sizes::whole(joints)
        };
        let rows: Vec<usize> = (0..floating + joints).collect();
        sizes.over(&rows)
    }

    /// Lists the joints with which limbs begin.
    pub fn limb_starts(self) -> impl Iterator<Item = usize> {
        (0..self.joints).filter(move |joint| self.limbs >> joint & 1 == 1)
    }

    /// Returns the number of coordinates of a velocity.
    pub fn coordinates(self) -> usize {
        self.floating + self.joints
    }

    /// Returns the sizes over these coordinates.
    #[must_use]
    pub fn over(self, rows: &[usize]) -> Sizes {
        let limbs = self.of_limbs(rows);
        Sizes {
            rows: rows.len(),
            links: rows.iter().filter(|row| **row >= self.floating).count(),
            blocks: limbs.iter().map(|limb| limb.len().pow(2)).sum(),
            ..self
        }
    }

    /// Returns each limb's places among these coordinates, as [`Axis::Limbs`] has them; limbs that none of
    /// them is of are left out.
    pub fn of_limbs(self, rows: &[usize]) -> Vec<Vec<usize>> {
        let joint = |row: usize| row.checked_sub(self.floating).filter(|joint| *joint < 64);
        let limb = |row: usize| joint(row).map(|joint| (self.limbs << (63 - joint)).count_ones());
        let of_limb = |number: u32| {
            let places = (0..rows.len()).filter(|place| limb(rows[*place]) == Some(number));
            places.collect::<Vec<usize>>()
        };
        let limbs = (1..=self.limbs.count_ones()).map(of_limb);
        limbs.filter(|places| !places.is_empty()).collect()
    }

    /// Returns the places among these coordinates of the row and the column of an entry of limbs' blocks.
    pub(super) fn of_blocks(self, mut entry: usize, rows: &[usize]) -> Option<[usize; 2]> {
        for limb in self.of_limbs(rows) {
            let length = limb.len();
            if entry < length * length {
                return Some([limb[entry / length], limb[entry % length]]);
            }
            entry -= length * length;
        }
        None
    }

    /// Returns the sizes over all rows of an arm that has so many: a limb's block is the whole matrix.
    #[must_use]
    pub fn over_all(self, rows: usize) -> Sizes {
        Sizes {
            rows,
            links: rows,
            blocks: rows * rows,
            ..self
        }
    }
}

/// The axes of a result, the outermost first; none for a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shape(pub &'static [Axis]);

impl Shape {
    /// One number.
    pub const SCALAR: Shape = Shape(&[]);
    /// n
    pub const VECTOR: Shape = Shape(&[Axis::Coordinates]);
    /// n×n
    pub const MATRIX: Shape = Shape(&[Axis::Coordinates, Axis::Coordinates]);
    /// n×n×n
    pub const CUBE: Shape = Shape(&[Axis::Coordinates, Axis::Coordinates, Axis::Coordinates]);

    /// Returns the lengths of its axes.
    pub fn lengths(self, sizes: Sizes) -> impl DoubleEndedIterator<Item = usize> {
        self.0.iter().map(move |axis| axis.length(sizes))
    }

    /// Returns how many numbers it has.
    pub fn len(self, sizes: Sizes) -> usize {
        self.lengths(sizes).product()
    }

    /// Returns the axes with the place of a number along each, the outermost first.
    pub fn places(self, mut index: usize, sizes: Sizes) -> Vec<(Axis, usize)> {
        let mut places = Vec::with_capacity(self.0.len());
        for axis in self.0.iter().rev() {
            let length = axis.length(sizes).max(1);
            places.push((*axis, index % length));
            index /= length;
        }
        places.reverse();
        places
    }
}

impl Axis {
    /// Returns its length.
    pub fn length(self, sizes: Sizes) -> usize {
        match self {
            Axis::Coordinates => sizes.rows,
            Axis::Links => sizes.links,
            Axis::Fixed(length) => length,
            Axis::LinkParameters => {
                LinkParameter::COUNT * (sizes.joints + usize::from(sizes.floating > 0))
            }
            Axis::Limbs => sizes.blocks,
            Axis::BaseParameters => sizes.base,
            Axis::Load => sizes.load,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_in_the_order_of_the_text() {
        let shape = Shape(&[Axis::Fixed(2), Axis::Coordinates]);
        let three = Sizes::whole(3);
        assert_eq!(shape.len(three), 6);
        for (index, places) in [(0, [0, 0]), (2, [0, 2]), (5, [1, 2])] {
            let entries = shape.places(index, three).into_iter();
            assert!(entries.map(|(_, place)| place).eq(places));
        }
        assert_eq!(Shape::SCALAR.len(three), 1);
        assert!(Shape::SCALAR.places(0, three).is_empty());
    }

    #[test]
    fn parameters_are_not_cut_by_rows() {
        let shape = Shape(&[Axis::Coordinates, Axis::LinkParameters]);
        assert_eq!(shape.len(Sizes::whole(6)), 360);
        assert_eq!(shape.len(Sizes::whole(6).over(&[1, 2])), 120);
        let base = Shape(&[Axis::Coordinates, Axis::BaseParameters]);
        let sizes = Sizes {
            rows: 2,
            base: 36,
            ..Sizes::whole(6)
        };
        let places = [(Axis::Coordinates, 1), (Axis::BaseParameters, 1)];
        assert_eq!(base.places(37, sizes), places);
    }
}
