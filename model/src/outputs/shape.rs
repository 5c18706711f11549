//! How the numbers of a result are arranged.

use alloc::vec::Vec;

/// An axis of a result's array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// An entry a joint; in a scene, a joint that results are over.
    Joints,
    /// So many entries, whatever the arm.
    Fixed(usize),
}

/// The axes of a result, the outermost first; none for a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Shape(pub &'static [Axis]);

impl Shape {
    /// One number.
    pub const SCALAR: Shape = Shape(&[]);
    /// n
    pub const VECTOR: Shape = Shape(&[Axis::Joints]);
    /// n×n
    pub const MATRIX: Shape = Shape(&[Axis::Joints, Axis::Joints]);
    /// n×n×n
    pub const CUBE: Shape = Shape(&[Axis::Joints, Axis::Joints, Axis::Joints]);

    /// The lengths of its axes over so many joints.
    pub fn lengths(self, joints: usize) -> impl DoubleEndedIterator<Item = usize> {
        self.0.iter().map(move |axis| axis.length(joints))
    }

    /// How many numbers it has over so many joints.
    pub fn len(self, joints: usize) -> usize {
        self.lengths(joints).product()
    }

    /// The place of a number along each axis, the outermost first.
    pub fn places(self, mut index: usize, joints: usize) -> Vec<usize> {
        let mut places: Vec<usize> = Vec::with_capacity(self.0.len());
        for length in self.lengths(joints).rev() {
            places.push(index % length.max(1));
            index /= length.max(1);
        }
        places.reverse();
        places
    }
}

impl Axis {
    /// Its length over so many joints.
    pub fn length(self, joints: usize) -> usize {
        match self {
            Axis::Joints => joints,
            Axis::Fixed(length) => length,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_in_the_order_of_the_text() {
        let shape = Shape(&[Axis::Fixed(2), Axis::Joints]);
        assert_eq!(shape.len(3), 6);
        let places: Vec<Vec<usize>> = (0..6).map(|index| shape.places(index, 3)).collect();
        assert_eq!(places[0], [0, 0]);
        assert_eq!(places[2], [0, 2]);
        assert_eq!(places[5], [1, 2]);
        assert_eq!(Shape::SCALAR.len(3), 1);
        assert!(Shape::SCALAR.places(0, 3).is_empty());
    }
}
