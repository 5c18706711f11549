//! Names in generated code for the places that the joints of a tree have in arguments, and the base
//! where it floats.

use std::collections::BTreeSet;

use crate::read::{is_letter, is_plain_sign};

/// Names that generated code has for something else, in Rust or in C behind the header's name.
const TAKEN: &str = "N NV BASE JOINT_NAMES LIMBS JOINTS COORDINATES BOX H CUH RESTRICT UNFUSED SIMD FORGET FOUR FOUR_T FOUR_V";
/// The end of the names of constants that hold parameters.
const PARAMETERS: &str = "PARAMETERS";
/// The longest name of a joint: with a header's name, compilers tell it from others.
const LONGEST: usize = 40;
/// Coordinates of a base that floats.
const BASE: usize = 6;

/// The places of joints.
#[derive(Clone, Debug)]
pub struct Places {
    names: Vec<String>,
    /// The constants of velocities.
    pub velocities: Vec<(String, usize)>,
    /// The constants of positions; empty where places in velocities are the same.
    pub positions: Vec<(String, usize)>,
    /// The joints with which the limbs of a base that floats begin, then the number of joints; empty on
    /// a fixed base.
    pub limbs: Vec<usize>,
    /// The number of joints, and of entries of a velocity.
    pub counts: [usize; 2],
}

impl Places {
    /// Returns the places of joints, in order, by their names in the robot file; `limbs` are the joints
    /// with which limbs begin where the base floats.
    pub fn new(names: &[Option<&str>], limbs: Option<Vec<usize>>) -> Places {
        let floats = limbs.is_some();
        let mut used_names: BTreeSet<String> = TAKEN.split(' ').map(str::to_owned).collect();
        let [mut plain_names, mut constants] = [Vec::new(), Vec::new()];
        let same = |c: char| if is_plain_sign(c) { c } else { '_' };
        for (number, name) in (1..).zip(names) {
            plain_names.push(match name {
                Some(name) => name.chars().map(same).collect(),
                None => format!("joint {number}"),
            });
            let mut constant = constant(name.unwrap_or(""), number);
            if used_names.contains(&constant) || constant.ends_with(PARAMETERS) {
                constant = format!("JOINT_{constant}");
            }
            while used_names.contains(&constant) || used_names.contains(&format!("Q_{constant}")) {
                constant += &format!("_{number}");
            }
            used_names.extend([format!("Q_{constant}"), constant.clone()]);
            constants.push(constant);
        }
        let base = if floats { BASE } else { 0 };
        let velocities = constants.iter().cloned().zip(base..);
        let position = |constant: &String| format!("Q_{constant}");
        let positions = constants.iter().map(position).zip(0..);
        let root = floats.then(|| ("BASE".to_owned(), 0));
        Places {
            names: plain_names,
            velocities: root.into_iter().chain(velocities).collect(),
            positions: positions.filter(|_| floats).collect(),
            limbs: limbs.map_or_else(Vec::new, |starts| [starts, vec![names.len()]].concat()),
            counts: [names.len(), base + names.len()],
        }
    }

    /// Returns the array in Rust of the joints with which limbs begin; none on a fixed base.
    pub fn limbs(&self) -> Option<String> {
        let (count, limbs) = (self.limbs.len(), &self.limbs);
        (count > 0).then(|| format!("pub const LIMBS: [usize; {count}] = {limbs:?};"))
    }

    /// Returns the array of joint names in Rust, a line each.
    pub fn array(&self) -> String {
        let lines = self.names.iter().map(|name| format!("    \"{name}\",\n"));
        let (count, lines) = (self.names.len(), lines.collect::<String>());
        format!("pub const JOINT_NAMES: [&str; {count}] = [\n{lines}];")
    }

    /// Returns the lines of a header: an enum, and the names and the limbs as macros that begin arrays.
    pub fn header(&self, name: &str) -> String {
        let counts = ["N", "NV"].map(str::to_owned).into_iter().zip(self.counts);
        let places = [&self.velocities, &self.positions].into_iter().flatten();
        let line = |(constant, place)| format!("    {name}_{constant} = {place}");
        let lines: Vec<String> = counts.chain(places.cloned()).map(line).collect();
        let quoted = |name: &String| format!("\"{name}\"");
        let names: Vec<String> = self.names.iter().map(quoted).collect();
        let mut macros = format!("#define {name}_JOINT_NAMES {{{}}}", names.join(", "));
        if !self.limbs.is_empty() {
            let limbs: Vec<String> = self.limbs.iter().map(usize::to_string).collect();
            macros += &format!("\n#define {name}_LIMBS {{{}}}", limbs.join(", "));
        }
        format!("enum {{\n{}\n}};\n{macros}", lines.join(",\n"))
    }
}

/// Returns a name in capital letters, digits and `_`, which a letter begins.
fn constant(name: &str, number: usize) -> String {
    let letter = |c: char| if is_letter(c) { c } else { '_' };
    let word: String = name.chars().map(letter).take(LONGEST).collect();
    let capitals = word.to_ascii_uppercase();
    match capitals.trim_matches('_') {
        "" => format!("JOINT_{number}"),
        short if short.starts_with(|c: char| c.is_ascii_digit()) => format!("JOINT_{short}"),
        short => short.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart() {
        let names = [
            "FL hip", "FL_hip", "N", "", "2nd", "q_a", "a", "\"é\"", "base",
        ];
        let names = names.map(Some);
        let places = Places::new(&names, Some(vec![0, 4]));
        let line = |(name, place): &(String, usize)| format!("{name} {place}");
        let velocities: Vec<String> = places.velocities.iter().map(line).collect();
        assert_eq!(
            velocities.join(", "),
            "BASE 0, FL_HIP 6, JOINT_FL_HIP 7, JOINT_N 8, JOINT_4 9, JOINT_2ND 10, Q_A 11, A_7 12, \
             JOINT_8 13, JOINT_BASE 14"
        );
        let positions: Vec<String> = places.positions.iter().map(line).collect();
        assert_eq!(positions[5..7], ["Q_Q_A 5", "Q_A_7 6"]);
        assert!(places.array().contains("    \"_é_\",\n"));
        let end = "\"q_a\", \"a\", \"_é_\", \"base\"}\n#define ARM_LIMBS {0, 4, 9}";
        assert!(places.header("ARM").ends_with(end));
        let limbs = "pub const LIMBS: [usize; 3] = [0, 4, 9];";
        assert_eq!(places.limbs().as_deref(), Some(limbs));
        let fixed = Places::new(&[None, Some("elbow")], None);
        assert_eq!(
            fixed.header("ARM"),
            "enum {\n    ARM_N = 2,\n    ARM_NV = 2,\n    ARM_JOINT_1 = 0,\n    ARM_ELBOW = 1\n};\n\
             #define ARM_JOINT_NAMES {\"joint 1\", \"elbow\"}"
        );
    }
}
