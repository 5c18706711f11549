//! The meaning of symbols: constants, base parameters and entries of the robot file.

use crate::expression::Sum;
use crate::number::Number;
use crate::symbol::{Definition, Symbol};

/// A symbol's meaning.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The symbol.
    pub symbol: Symbol,
    /// The sum of other symbols that it stands for; empty for an entry of the robot file.
    pub sum: Sum,
    /// Its value.
    pub value: Number,
}

/// Entries of the robot file that belong together.
#[derive(Clone, Debug)]
pub struct Group {
    /// The joint, or the robot.
    pub label: String,
    /// Its entries.
    pub entries: Vec<Entry>,
}

/// The symbols of some formulas.
#[derive(Clone, Debug, Default)]
pub struct Legend {
    /// Constants that coefficients share.
    pub constants: Vec<Entry>,
    /// Base parameters.
    pub parameters: Vec<Entry>,
    /// Entries of the robot file, those of a joint together.
    pub groups: Vec<Group>,
    /// True if joints are placed, and have no rows of a DH table.
    pub is_placed: bool,
    /// True if centres of mass are numbers, since there were too many symbols.
    pub has_numeric_centres: bool,
}

impl Legend {
    /// Adds an entry of the robot file to its group.
    pub(crate) fn entry(&mut self, label: String, definition: &Definition<Number>) {
        let entry = Entry {
            symbol: definition.symbol.clone(),
            sum: Sum::new(),
            value: definition.value,
        };
        match self.groups.iter_mut().find(|group| group.label == label) {
            Some(group) => group.entries.push(entry),
            None => self.groups.push(Group {
                label,
                entries: vec![entry],
            }),
        }
    }

    /// The meaning of the file's symbols.
    pub(crate) fn title_of_groups(&self) -> &'static str {
        match self.is_placed {
            false => {
                "Entries of the robot file, in m, kg, kg m² and m/s²: a and d of a row, mass m; centre of \
                 mass x̄, ȳ, z̄ in the frame of the link, moments of inertia I about it, armature Ia; tool tx, \
                 ty, tz and base bx, by, bz"
            }
            true => {
                "Entries of the robot file, in m, kg, kg m² and m/s²: origin px, py, pz in the frame of the link \
                 before, mass m; centre of mass x̄, ȳ, z̄ in the frame of the link, moments of inertia I about \
                 it, armature Ia; each frame is turned until its z is the axis of its joint"
            }
        }
    }
}
