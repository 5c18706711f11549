//! Frames that are fixed to links, and the one that velocities and wrenches are of.
//!
//! An arm has a hand: the last link's frame, or the tool's. [`Arm::seen`](super::Arm::seen) gives the same
//! arm with another frame in its place, on any link, and says in which axes and which of
//! the six components are asked for. So formulas of the hand are formulas of any frame.

use alloc::string::String;
use alloc::vec::Vec;

use super::matrix::Columns;
use crate::robot::values::word;

/// The axes that a frame's velocity has its components in, and the point it is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Axes {
    /// Base axes, at the frame's origin (`LOCAL_WORLD_ALIGNED` in Pinocchio).
    #[default]
    Mixed,
    /// The frame's own axes, at its origin (`LOCAL`).
    Local,
    /// Base axes, at the base's origin (`WORLD`).
    World,
}

impl Axes {
    /// Every choice with its word.
    pub const WORDS: [(&'static str, Axes); 3] = [
        ("mixed", Axes::Mixed),
        ("local", Axes::Local),
        ("world", Axes::World),
    ];

    /// Returns its word.
    pub fn word(self) -> &'static str {
        word(&Axes::WORDS, &self)
    }
}

/// The components of a velocity or a wrench that are asked for: some of six, linear before angular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rows(u8);

impl Rows {
    /// All six.
    pub const ALL: Rows = Rows(0b11_1111);
    /// The linear ones.
    pub const LINEAR: Rows = Rows(0b00_0111);
    /// The names of the components, in their order.
    pub const NAMES: [&'static str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
    const GROUPS: [(&'static str, Rows); 2] =
        [("linear", Rows::LINEAR), ("angular", Rows(0b11_1000))];

    /// Returns the components of a word: `linear`, `angular`, or names in their order, as `x_y_rz`.
    pub fn of(word: &str) -> Option<Rows> {
        if let Some((_, rows)) = Rows::GROUPS.into_iter().find(|(name, _)| *name == word) {
            return Some(rows);
        }
        let mut rows = 0u8;
        for name in word.split('_') {
            let mut names = Rows::NAMES.into_iter();
            let bit = 1 << names.position(|candidate| candidate == name)?;
            // In order, and none twice: one word for one choice.
            if rows >= bit {
                return None;
            }
            rows |= bit;
        }
        Some(Rows(rows))
    }

    /// Returns its word.
    pub fn word(self) -> String {
        match Rows::GROUPS.into_iter().find(|(_, rows)| *rows == self) {
            Some((name, _)) => name.into(),
            None => {
                let names = self.indices().map(|row| Rows::NAMES[row]);
                names.collect::<Vec<_>>().join("_")
            }
        }
    }

    /// Returns the places of the components among six.
    pub fn indices(self) -> impl Iterator<Item = usize> + Clone {
        (0..6).filter(move |row| self.0 >> row & 1 == 1)
    }

    /// Returns the number of components.
    pub fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Returns these of six.
    pub fn pick<T: Clone>(self, six: &[T]) -> Vec<T> {
        let rows = self.indices();
        rows.filter_map(|row| six.get(row).cloned()).collect()
    }
}

/// A frame, and what is asked of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct View {
    /// The frame's name, or [`HAND`](crate::robot::HAND); of contacts all names, with commas between.
    pub frame: &'static str,
    /// In which axes.
    pub axes: Axes,
    /// The components.
    pub rows: Rows,
}

impl View {
    /// Returns the names of its frames.
    pub fn frames(self) -> impl Iterator<Item = &'static str> + Clone {
        self.frame.split(',')
    }
}

/// A frame that is fixed to a link.
#[derive(Clone, Debug)]
pub struct NamedFrame<S> {
    /// Its name.
    pub name: String,
    /// The joint that moves the link, zero-based.
    pub joint: usize,
    /// Its pose in the frame of the joint's row.
    pub pose: Columns<S>,
}

/// The frames of an arm that no torque depends on.
#[derive(Clone, Debug)]
pub struct Frames<S> {
    /// Each link's own frame in that of its row; `None`, or missing, where it is that.
    pub links: Vec<Option<Columns<S>>>,
    /// Those with a name.
    pub named: Vec<NamedFrame<S>>,
    /// The joint that moves the link with the hand; `None` for the last.
    pub joint: Option<usize>,
    /// The axes of velocities of the hand.
    pub axes: Axes,
    /// The components of these.
    pub rows: Rows,
    /// The names of the frames in contact; none for the hand alone.
    pub contacts: Vec<&'static str>,
}

impl<S> Default for Frames<S> {
    fn default() -> Self {
        Frames {
            links: Vec::new(),
            named: Vec::new(),
            joint: None,
            axes: Axes::default(),
            rows: Rows::ALL,
            contacts: Vec::new(),
        }
    }
}

impl<S> Frames<S> {
    /// Returns a link's own frame in that of its row; `None` where it is that.
    pub fn of_link(&self, link: usize) -> Option<&Columns<S>> {
        self.links.get(link)?.as_ref()
    }

    /// Returns every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Frames<T> {
        let poses = self.links.iter();
        let links = poses.map(|pose| Some(pose.as_ref()?.map(&mut f))).collect();
        let named = self.named.iter().map(|frame| NamedFrame {
            name: frame.name.clone(),
            joint: frame.joint,
            pose: frame.pose.map(&mut f),
        });
        Frames {
            links,
            named: named.collect(),
            joint: self.joint,
            axes: self.axes,
            rows: self.rows,
            contacts: self.contacts.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_choice_of_components_has_one_word() {
        let words: Vec<String> = (1..64).map(|mask| Rows(mask).word()).collect();
        for (mask, word) in (1..64).zip(&words) {
            assert_eq!(Rows::of(word), Some(Rows(mask)));
            assert_eq!(Rows(mask).indices().count(), Rows(mask).count());
        }
        assert_eq!(Rows::of("x_y_rz").map(Rows::count), Some(3));
        assert_eq!(Rows::of("linear"), Rows::of("x_y_z"));
        for none in ["", "y_x", "x_x", "x__y", "roll", "linear_rz"] {
            assert_eq!(Rows::of(none), None, "{none}");
        }
    }
}
