//! The meaning of symbols: constants, base parameters and entries of the robot file.

use dalembert_model::robot::Robot;

use crate::expression::Sum;
use crate::number::Number;
use crate::symbol::{Definition, Symbol};

/// A symbol's meaning.
#[derive(Clone, Debug)]
pub struct SymbolEntry {
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
    pub entries: Vec<SymbolEntry>,
}

/// The frames in which numbers of links are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Frames {
    /// Those of the robot file.
    #[default]
    File,
    /// Those of the rows of a DH table, which follow from the file's placements.
    Rows,
    /// Those of the file, turned until z is the axis of the joint: joints are placed.
    Turned,
}

impl Frames {
    /// Returns those of a robot.
    pub(crate) fn of(robot: &Robot) -> Frames {
        match () {
            () if robot.is_tree() => Frames::Turned,
            () if robot.rows().iter().any(|joint| joint.frame.is_some()) => Frames::Rows,
            () => Frames::File,
        }
    }

    /// Describes them.
    pub fn words(self) -> &'static str {
        match self {
            Frames::File => "in the frame of the link",
            Frames::Rows => "in the frame of the DH row, which `dalembert show` draws",
            Frames::Turned => {
                "in the frame of the link, turned until its z is the axis of the joint"
            }
        }
    }
}

/// The symbols of some formulas.
#[derive(Clone, Debug, Default)]
pub struct Legend {
    /// Constants that coefficients share.
    pub constants: Vec<SymbolEntry>,
    /// Base parameters.
    pub parameters: Vec<SymbolEntry>,
    /// Entries of the robot file, those of a joint together.
    pub groups: Vec<Group>,
    /// The frames of the links.
    pub frames: Frames,
    /// True if centres of mass are numbers, since there were too many symbols.
    pub has_numeric_centres: bool,
}

impl Legend {
    /// Adds an entry of the robot file to its group.
    pub(crate) fn entry(&mut self, label: String, definition: Definition<Number>) {
        let entry = SymbolEntry {
            symbol: definition.symbol,
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

    /// The meaning of the file's symbols that occur.
    pub(crate) fn title_of_groups(&self) -> String {
        let centre = format!("x̄, ȳ, z̄ centre of mass {}", self.frames.words());
        let meanings: [(&[&str], &str); 10] = [
            (&["g", "gx", "gy", "gz"], "g gravity"),
            (&["a"], "a length of the row"),
            (&["d"], "d offset of the row"),
            (
                &["px", "py", "pz"],
                "px, py, pz origin of the joint in the frame of the link before, turned in the same way",
            ),
            (&["m"], "m mass"),
            (&["x", "y", "z"], &centre),
            (&["I"], "I moment of inertia about the centre of mass"),
            (&["Ia"], "Ia armature"),
            (&["tx", "ty", "tz"], "tx, ty, tz place of the tool"),
            (&["bx", "by", "bz"], "bx, by, bz place of the base"),
        ];
        let occurs = |letters: &&str| {
            let mut entries = self.groups.iter().flat_map(|group| &group.entries);
            entries.any(|entry| kind(&entry.symbol.code) == **letters)
        };
        let phrases: Vec<&str> = meanings
            .into_iter()
            .filter(|(letters, _)| letters.iter().any(occurs))
            .map(|(_, phrase)| phrase)
            .collect();
        format!(
            "Entries of the robot file: in m, kg, kg m² and m/s²; {}",
            phrases.join("; ")
        )
    }
}

/// Returns the letters of an identifier: `I` of `I2zz`, `Ia` of `I2a`.
fn kind(code: &str) -> String {
    let letters: String = code.chars().filter(|c| c.is_alphabetic()).collect();
    match letters.strip_prefix('I') {
        Some("a") => "Ia".to_owned(),
        Some(_) => "I".to_owned(),
        None => letters,
    }
}
