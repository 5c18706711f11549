//! The angles of a module, and where the sine of each stands in an array.
//!
//! ```text
//! pub fn angles(q: &[f64; 2]) -> [f64; 3] {
//!     let a1p2 = q[0] + q[1];
//!     [q[0], q[1], a1p2]
//! }
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::language::scope::Scope;
use crate::program::{AngleSum, LoweredTrig, Program, ScalarType};
use crate::sincos::angle_name;

/// An entry a joint, then the sums of angles that any function of the module
/// takes a sine of: so one pair of arrays serves all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Angles {
    joints: usize,
    sums: Vec<AngleSum>,
}

impl Angles {
    /// Returns those of functions of one robot.
    pub fn of<'a>(joints: usize, programs: impl IntoIterator<Item = &'a Program>) -> Angles {
        let trigs = programs.into_iter().flat_map(|program| &program.trig);
        let sums = trigs
            .map(|trig| trig.angle)
            .filter(|angle| angle.additions() > 0);
        let sums: BTreeSet<AngleSum> = sums.collect();
        Angles {
            joints,
            sums: sums.into_iter().collect(),
        }
    }

    /// Returns how many there are.
    pub fn count(&self) -> usize {
        self.joints + self.sums.len()
    }

    /// Returns where an angle's sine stands.
    pub fn place(&self, angle: AngleSum) -> Option<usize> {
        if angle.additions() == 0 {
            return angle.terms().next().map(|(joint, _)| joint);
        }
        let place = self.sums.iter().position(|sum| *sum == angle)?;
        Some(self.joints + place)
    }

    /// Returns the lines of the function that gives the angles, its head first.
    pub fn lines(&self, scalar: ScalarType) -> Vec<String> {
        let (n, count) = (self.joints, self.count());
        let mut lines = vec![format!(
            "pub fn angles(q: &[{scalar}; {n}]) -> [{scalar}; {count}] {{"
        )];
        let joints = (0..n).map(|joint| format!("q[{joint}]"));
        let mut angles: Vec<String> = joints.collect();
        for sum in &self.sums {
            lines.push(format!("    let a{sum} = {};", Scope::STATE.sum(*sum)));
            angles.push(format!("a{sum}"));
        }
        lines.push(format!("    [{}]", angles.join(", ")));
        lines.push("}".to_owned());
        lines
    }

    /// Prints that function.
    pub fn write(&self, text: &mut String, scalar: ScalarType) {
        let sums = match self.sums.is_empty() {
            true => String::new(),
            false => format!(", then {}", list(self.sums.iter().copied())),
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "\n/// The angles whose sines and cosines functions take that are named `…_with_sincos`:\n\
             /// those of the joints{sums}. What stands there for a joint that slides or is locked is\n\
             /// not read.\n#[must_use]"
        );
        for line in self.lines(scalar) {
            let _ = writeln!(text, "{line}");
        }
    }

    /// Returns an array with an entry for every angle; zero where none is taken.
    pub(super) fn array(
        &self,
        trigs: &[LoweredTrig],
        entry: impl Fn(&LoweredTrig) -> Option<String>,
    ) -> String {
        let mut array = vec!["0.0".to_owned(); self.count()];
        for trig in trigs {
            let place = self
                .place(trig.angle)
                .and_then(|place| array.get_mut(place));
            if let (Some(place), Some(entry)) = (place, entry(trig)) {
                *place = entry;
            }
        }
        format!("[{}]", array.join(", "))
    }
}

/// Angles as documentation lists them.
pub(super) fn list(angles: impl Iterator<Item = AngleSum>) -> String {
    let angles: Vec<String> = angles.map(angle_name).collect();
    angles.join(", ")
}
