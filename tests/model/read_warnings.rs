//! Oddities of a file that are not errors: warnings and notes, which can be silenced.

use std::collections::BTreeSet;

use crate::read_errors::GOOD;
use crate::support::{errors, has, only, reading, replaced, rows};
use dalembert_model::read::{Diagnostic, RobotWarning, Severity};

/// Replacements in a good file: the old text, the new text, the line, and words of the message.
const ODD: &str = r#"
inertia = [1, 1, 1, | inertia = [1, 1, 3, | 14 | exceeds the sum
gravity = [0, 0, -9.81] | gravity = [0, 3, 9.81] | 3 | gravity points upwards, along the base's z
velocity = 2 | velocity = 0 | 17 | the limit of velocity is 0: the joint never moves
acceleration = 3 | acceleration = 0.0 | 17 | the limit of acceleration is 0: the joint never moves
mass = 2 | mass = 0 | 14 | the mass is zero
alpha = "pi/2" | alpha = 3.1416 | 7 | from pi
alpha = "pi/2" | alpha = 4.71238898038469 | 7 | 4.71238898038469 is read as 3*pi/2
"#;

/// Numbers that look like another unit's, those in their place, and words of the help.
const OTHER_UNITS: &str = r#"
[0, 0, -9.81] | [0, 0, -9810] | 3 | is 9810.0000 m/s² | mm/s²
[0, 0, -9.81] | [0, 981, 0] | 3 | far from | cm/s²
[0, 0, -9.81] | [0, 32.174, 0] | 3 | far from | ft/s²
[0, 0, -9.81] | [0, 0, -1] | 3 | far from | a direction
"pi/2" | 90 | 7 | alpha is 90 rad: more than a turn | "90deg"
"pi/2" | -7.5 | 7 | more than a turn | "-7.5deg"
offset = 0.1 | offset = 45 | 11 | offset is 45 rad | "45deg"
a = 0.5 | a = 431.8 | 8 | a is 431.8 m: longer than 10 m | write 0.4318
d = 0.25 | d = -149.09 | 9 | d is -149.09 m | write -0.14909
[0, 0.1, 0] | [0, 68.1, -70] | 13 | com is -70 m | write -0.07
mass = 2 | mass = 17400 | 12 | 17400 kg | of grams, write 17.4
[-1, 1] | [-170, 170] | 17 | a limit of -170 rad | "-170deg"
velocity = 2 | velocity = 110 | 17 | 110 rad/s is fast | write 1.9199
[1, 1, 1, 0, 0, 0] | [12300, 12300, 1, 0, 0, 0] | 14 | a mass of 2 kg with a moment of | of kg·mm², write
[1, 1, 1, 0, 0, 0] | [12300, 12300, 1, 0, 0, 0] | 14 | 12300 kg·m² is 78.422 m from its axis | 0.0123 for
[1, 1, 1, 0, 0, 0] | [12300, 12300, 1, 0, 0, 0] | 14 | axis, and the arm reaches 0.850 m | for 12300
viscous = 0.1 | coulomb = 1\ncoulomb_width = 2 | 16 | smoothed over 2 rad/s | a tenth
viscous = 0.1 | coulomb = 1\ncoulomb_width = 2 | 16 | and the joint reaches 2 | of the slowest speed
"#;

const OF_SLIDES: &str = r#"
offset = 0.1 | offset = 100 | 11 | | write 0.1
[-1, 1] | [0, 500] | 17 | | write 0.5
velocity = 2 | velocity = 500 | 17 | | write 0.5
"#;

fn oddity([what, by, line]: [&str; 3], good: &str) -> Diagnostic {
    let notes = reading(&replaced(good, what, by)).notes;
    assert_eq!(only(&notes).line().unwrap().to_string(), line, "{by}");
    notes[0].clone()
}

#[test]
fn warnings_and_notes() {
    for [what, by, line, message] in rows(ODD) {
        let note = oddity([&what, &by, &line], GOOD);
        let is_note = message.contains("is read as");
        assert_eq!(note.severity == Severity::Note, is_note, "{by}");
        has(&note, &message, "");
    }
}

#[test]
fn sizes_of_other_units() {
    let slides = "kind = \"prismatic\"\ntheta = 0\nd = 0";
    let slides = replaced(GOOD, "kind = \"revolute\"", slides).replace("d = 0.25\ntheta = 0\n", "");
    for (good, table) in [(GOOD, OTHER_UNITS), (&slides, OF_SLIDES)] {
        for [what, by, line, message, help] in rows(table) {
            let note = oddity([&what, &by, &line], good);
            assert_eq!(note.severity, Severity::Warning, "{by}");
            has(&note, &message, &help);
            has(&note, "", "it is taken as it stands; allow = [\"");
        }
    }
}

#[test]
fn sizes_that_are_none_of_our_business() {
    // Inertia of all mass further away than the arm reaches, but not far further.
    let usual = r#"
[0, 0, -9.81] | [0, 0, 0]
[0, 0, -9.81] | [0, 0, -1.62]
[0, 0, -9.81] | [0, 6.94, -6.94]
"pi/2" | "5*pi/2"
"pi/2" | "450deg"
a = 0.5 | a = 10
mass = 2 | mass = 999
[-1, 1] | [-31, 31]
[-1, 1] | [-1.57, 3.1416]
[1, 1, 1, 0, 0, 0] | [12, 12, 12, 0, 0, 0]
viscous = 0.1 | coulomb = 1\ncoulomb_width = 0.2
viscous = 0.1 | coulomb_width = 3
[-1, 1] | ["-36000deg", "36000deg"]
"#;
    for [what, by] in rows(usual) {
        assert_eq!(reading(&replaced(GOOD, &what, &by)).notes, [], "{by}");
    }
}

#[test]
fn other_ways_to_say_it() {
    let robot = |source: &str| reading(source).robot;
    let six = GOOD.replace("[1, 1, 1, 0, 0, 0]", "[3, 4, 5, 0.1, 0.2, 0.3]");
    let rows = "[[3, 0.1, 0.3],\n [0.10, 4, 2e-1],\n [0.3, 0.2, 5]] # a comment";
    let nine = GOOD.replace("[1, 1, 1, 0, 0, 0]", rows);
    let massless = GOOD
        .replace("mass = 2", "mass = 0.0")
        .replace("com = [0, 0.1, 0]\n", "");
    assert_eq!(errors(&massless), []);
    let bare = massless.replace("inertia = [1, 1, 1, 0, 0, 0]\n", "");
    let zeros = massless.replace("[1, 1, 1, 0, 0, 0]", "[0, 0, 0, 0, 0, 0]");
    let mut table = GOOD.replace("limits = {", "[joint.limits]\n");
    for (from, to) in [(" }", ""), (", v", "\nv"), (", a", "\na"), (", t", "\nt")] {
        table = table.replace(from, to);
    }
    let good = GOOD.to_owned();
    for (one, other) in [
        (six, nine),
        (bare, zeros),
        (table, good.clone()),
        (GOOD.replace('\n', "\r\n"), good.clone()),
        (format!("\u{feff}{GOOD}"), good),
    ] {
        assert_eq!(robot(&one), robot(&other));
    }
}

#[test]
fn warnings_are_silenced_one_by_one() {
    let odd = GOOD
        .replace("[1, 1, 1,", "[1, 1, 3,")
        .replace("mass = 2", "mass = 2000");
    let doubts = |source: &str| -> Vec<Option<RobotWarning>> {
        let notes = reading(source).notes;
        notes.iter().map(|note| note.warning).collect()
    };
    let [mass, inertia] = [RobotWarning::LargeMass, RobotWarning::ImpossibleInertia].map(Some);
    assert_eq!(doubts(&odd), [mass, inertia]);
    for (allow, left) in [
        ("[]", vec![mass, inertia]),
        ("[\"large_mass\"]", vec![inertia]),
        ("[\"impossible_inertia\"]", vec![mass]),
        ("[\"impossible_inertia\", \"large_mass\"]", vec![]),
        ("[\"loose_tolerance\"]", vec![mass, inertia]),
    ] {
        assert_eq!(doubts(&format!("allow = {allow}\n{odd}")), left, "{allow}");
    }
    let help = reading(&odd).notes[0].help.clone().unwrap();
    assert!(help.ends_with("; allow = [\"large_mass\"] silences this"));
}

/// Keys of a file that silence nothing, and words of the message.
const ALLOW: &str = r#"
["large_mas"] | there is no warning `large_mas` | did you mean "large_mass"?
["everything"] | there is no warning `everything` | warnings are: impossible_inertia,
[1] | expected a string, found the number `1` | write it in quotes
"" | expected an array of the names of warnings, found the string `` | allow = ["impossible_inertia
"#;

#[test]
fn names_of_warnings() {
    for [allow, message, help] in rows(ALLOW) {
        let errors = errors(&format!("allow = {allow}\n{GOOD}"));
        assert_eq!(only(&errors).line(), Some(1));
        assert_eq!(errors[0].message, message);
        let hint = errors[0].help.as_deref().unwrap_or_default();
        assert!(hint.starts_with(&help), "{hint}");
    }
    let words = RobotWarning::WORDS;
    let names = BTreeSet::from_iter(words.iter().map(|(name, _)| *name));
    assert!(words.iter().all(|(name, warning)| warning.name() == *name));
    assert_eq!(names.len(), words.len());
}
