//! Entries over some rows of an arm from those over others.

use alloc::vec::Vec;

use super::{Axis, Quantity, Sizes};
use crate::equations::following::{Following, gather};
use crate::scalar::Scalar;

impl Quantity {
    /// Returns its entries over some rows of an arm from those over others. Loads of joints
    /// that follow are gathered at their leaders, along each axis over joints; what is of
    /// each link by itself is not.
    pub fn selected<S: Scalar>(
        self,
        mut values: Vec<S>,
        [from, to]: [&[usize]; 2],
        following: &[Following<S>],
        sizes: Sizes,
    ) -> Vec<S> {
        let shape = self.shape();
        let lengths: Vec<usize> = shape.lengths(sizes.over(from.len())).collect();
        for (axis, _) in (shape.0.iter().enumerate()).filter(|(_, axis)| **axis == Axis::Joints) {
            if !self.is_of_links() {
                let stride = lengths[axis + 1..].iter().product();
                gather(following, from, stride, &mut values);
            }
        }
        if from == to {
            return values;
        }
        let place = |row: &usize| from.iter().position(|own| own == row);
        let places: Vec<usize> = to.iter().filter_map(place).collect();
        let sizes = sizes.over(to.len());
        let entry = |index: usize| {
            let axes = shape.places(index, sizes).into_iter();
            // The place of the entry among those there are.
            let at = axes.fold(0, |at, (axis, place)| match axis {
                Axis::Joints => at * from.len() + places[place],
                other => at * other.length(sizes) + place,
            });
            values[at].clone()
        };
        (0..shape.len(sizes)).map(entry).collect()
    }
}
