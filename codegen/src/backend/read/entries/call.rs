//! The call of the arithmetic: every value where its name says.

use super::TextError;
use crate::backend::entries::angles::Angles;
use crate::backend::read::error::WordFault;
use crate::program::LoweredTrig;

/// A call of `NAME_with_sincos`.
pub(super) struct Call<'a> {
    pub(super) name: &'a str,
    /// The arguments as they are passed.
    pub(super) arguments: Vec<String>,
    /// The sines and cosines that there are.
    pub(super) trigs: &'a [LoweredTrig],
    pub(super) angles: &'a Angles,
    /// What stands after the name of a sine.
    pub(super) lane: &'a str,
}

impl Call<'_> {
    /// How it is written.
    pub(super) fn write(&self) -> String {
        let mut arguments = self.arguments.clone();
        arguments.push(self.array('s', |trig| trig.sin));
        arguments.push(self.array('c', |trig| trig.cos));
        format!("{}_with_sincos({})", self.name, arguments.join(", "))
    }

    /// Sines or cosines in the places of their angles; nobody reads the zeros.
    fn array(&self, letter: char, taken: impl Fn(&LoweredTrig) -> bool) -> String {
        let entry = |place: usize| {
            let mut trigs = self.trigs.iter().filter(|trig| taken(trig));
            let found = trigs.find(|trig| self.angles.place(trig.angle) == Some(place));
            match found {
                Some(trig) => format!("{letter}{}{}", trig.angle, self.lane),
                None => "0.0".to_owned(),
            }
        };
        let entries: Vec<String> = (0..self.angles.count()).map(entry).collect();
        format!("&[{}]", entries.join(", "))
    }
}

/// The names of a head's parameters.
pub(super) fn parameters(head: &str) -> impl Iterator<Item = &str> {
    let inside = head.split_once('(').map_or("", |(_, rest)| rest);
    let inside = inside.split_once(") -> ").map_or("", |(inside, _)| inside);
    let parameters = inside.split(", ");
    parameters.filter_map(|parameter| parameter.split_once(": ").map(|(name, _)| name))
}

/// Whether a line is what it must be.
pub(super) fn expect(found: &str, expected: &str, line: usize) -> Result<(), TextError> {
    match found == expected {
        true => Ok(()),
        false => Err(TextError::new(
            line,
            WordFault::Instead {
                expected: expected.to_owned(),
                found: found.to_owned(),
            },
        )),
    }
}
