//! The word that was meant.

use alloc::format;
use alloc::string::String;
use core::iter;

use strsim::osa_distance;

use crate::outputs::{BundleError, Function};

/// Words of other tools and textbooks, with ours.
const OTHER_WORDS: [(&str, &str); 54] = [
    ("m", "mass"),
    ("weight", "mass"),
    ("r", "com"),
    ("cog", "com"),
    ("center_of_mass", "com"),
    ("centre_of_mass", "com"),
    ("i", "inertia"),
    ("b", "viscous"),
    ("damping", "viscous"),
    ("coulomb_friction", "coulomb"),
    ("dry_friction", "coulomb"),
    ("width", "coulomb_width"),
    ("jm", "armature"),
    ("rotor", "armature"),
    ("rotor_inertia", "armature"),
    ("type", "kind"),
    ("sigma", "kind"),
    ("twist", "alpha"),
    ("length", "a"),
    ("qlim", "limits"),
    ("effort", "torque"),
    ("force", "torque"),
    ("g", "gravity"),
    ("dh", "convention"),
    ("links", "joint"),
    ("craig", "modified"),
    ("mdh", "modified"),
    ("classic", "standard"),
    ("rotary", "revolute"),
    ("continuous", "revolute"),
    ("linear", "prismatic"),
    ("sliding", "prismatic"),
    ("rnea", "inverse_dynamics"),
    ("id", "inverse_dynamics"),
    ("aba", "forward_dynamics"),
    ("fd", "forward_dynamics"),
    ("crba", "inertia"),
    ("mass_matrix", "inertia"),
    ("inertia_matrix", "inertia"),
    ("fk", "forward_kinematics"),
    ("nle", "manipulator_equation"),
    ("nonlinear_effects", "manipulator_equation"),
    ("m", "inertia"),
    ("d", "inertia"),
    ("c", "coriolis"),
    ("j", "jacobian"),
    ("t", "forward_kinematics"),
    ("y", "regressor"),
    ("tau", "inverse_dynamics"),
    ("qdd", "forward_dynamics"),
    ("p", "potential_energy"),
    ("lagrange", "lagrange_euler"),
    ("newton", "newton_euler"),
    ("rne", "newton_euler"),
];

/// Returns the likely fix of a bundle that cannot be read, with the output that was
/// probably meant.
pub fn for_bundle(error: &BundleError) -> String {
    let meant = match error {
        BundleError::Unknown(word) => closest(word, &Function::ALL.map(Function::name)),
        _ => None,
    };
    match meant {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => error.help(),
    }
}

/// Words for what has several keys: these, and what tells them apart.
const SEVERAL: [(&str, &[&str], &str); 1] = [(
    "friction",
    &["viscous", "coulomb"],
    "write `viscous` for friction that grows with the speed, `coulomb` for one that does not, or both",
)];

/// Returns the known key, or the several, that an unknown one probably stands for.
pub(super) fn for_key(word: &str, known: &[&str]) -> Option<String> {
    let has_all = |keys: &[&str]| keys.iter().all(|key| known.contains(key));
    let mut several = SEVERAL.iter();
    if let Some((.., help)) = several.find(|(other, keys, _)| *other == word && has_all(keys)) {
        return Some((*help).into());
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
    let others = OTHER_WORDS.iter().filter(|(other, _)| *other == word);
    let mut words = iter::once(word.as_str()).chain(others.map(|(_, meant)| *meant));
    let same = words.find_map(|word| candidates.iter().find(|known| **known == word));
    if let Some(same) = same {
        return Some(same);
    }
    let letters = word.chars().count();
    candidates
        .iter()
        .map(|candidate| {
            (
                osa_distance(&word, &candidate.to_ascii_lowercase()),
                *candidate,
            )
        })
        // One slip in three letters at most: `a` is not a slip of `d`.
        .filter(|(distance, candidate)| distance * 3 <= letters.max(candidate.len()))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
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
