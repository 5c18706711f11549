//! The word that was meant.

use alloc::format;
use alloc::string::String;
use core::iter;

use strsim::osa_distance;

/// Our words, each with those of other tools and textbooks.
const OTHER_WORDS: [(&str, &[&str]); 29] = [
    ("mass", &["m", "weight"]),
    ("com", &["r", "cog", "center_of_mass", "centre_of_mass"]),
    (
        "inertia",
        &["i", "crba", "mass_matrix", "inertia_matrix", "m", "d"],
    ),
    ("viscous", &["b", "damping"]),
    ("coulomb", &["coulomb_friction", "dry_friction"]),
    ("coulomb_width", &["width"]),
    ("armature", &["jm", "rotor", "rotor_inertia"]),
    ("kind", &["type", "sigma"]),
    ("alpha", &["twist"]),
    ("a", &["length"]),
    ("limits", &["qlim"]),
    ("torque", &["effort", "force"]),
    ("gravity", &["g"]),
    ("convention", &["dh"]),
    ("joint", &["links"]),
    ("modified", &["craig", "mdh"]),
    ("standard", &["classic"]),
    ("revolute", &["rotary", "continuous"]),
    ("prismatic", &["linear", "sliding"]),
    ("inverse_dynamics", &["rnea", "id", "tau"]),
    ("forward_dynamics", &["aba", "fd", "qdd"]),
    ("forward_kinematics", &["fk", "t"]),
    ("manipulator_equation", &["nle", "nonlinear_effects"]),
    ("coriolis", &["c"]),
    ("jacobian", &["j"]),
    ("regressor", &["y"]),
    ("potential_energy", &["p"]),
    ("lagrange_euler", &["lagrange"]),
    ("newton_euler", &["newton", "rne"]),
];

pub(crate) fn for_key(word: &str, known: &[&str]) -> Option<String> {
    const FRICTION: &str = "write `viscous` for friction that grows with the speed, `coulomb` for one that does not, or both";
    if word == "friction" && known.contains(&"viscous") && known.contains(&"coulomb") {
        return Some(FRICTION.into());
    }
    closest(word, known).map(|meant| format!("did you mean `{meant}`?"))
}

/// The longest word that is compared: the work stays bounded.
const MAX_LENGTH: usize = 64;

/// Returns the candidate that `word` is most likely a slip of, if one is near.
pub fn closest<'c>(word: &str, candidates: &[&'c str]) -> Option<&'c str> {
    if word.len() >= MAX_LENGTH {
        return None;
    }
    let word = word.to_ascii_lowercase();
    let others = OTHER_WORDS.iter();
    let others = others.filter(|(_, others)| others.contains(&word.as_str()));
    let mut words = iter::once(word.as_str()).chain(others.map(|(name, _)| *name));
    let same = words.find_map(|word| candidates.iter().find(|known| **known == word));
    if let Some(same) = same {
        return Some(same);
    }
    let letters = word.chars().count();
    let distance = |known: &str| osa_distance(&word, &known.to_ascii_lowercase());
    // One slip in three letters at most: `a` is not a slip of `d`.
    let is_near = |known: &&&str| distance(known) * 3 <= letters.max(known.len());
    let near = candidates.iter().filter(is_near);
    near.min_by_key(|known| distance(known)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_likely_word() {
        let keys = [
            "name", "kind", "alpha", "a", "d", "mass", "com", "inertia", "limits",
        ];
        for (word, meant) in [
            ("mas", Some("mass")),
            ("Mass", Some("mass")),
            ("amss", Some("mass")),
            ("inertai", Some("inertia")),
            ("I", Some("inertia")),
            ("limit", Some("limits")),
            ("type", Some("kind")),
            ("B", None),
            ("x", None),
            ("colour", None),
            ("", None),
        ] {
            assert_eq!(closest(word, &keys), meant, "{word}");
        }
    }
}
