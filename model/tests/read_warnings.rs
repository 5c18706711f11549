//! What is odd in a file and not wrong: a warning or a note on the right line, in words
//! that help, which can be silenced.

use dalembert_model::read::{Options, RobotWarning, Severity, parse};

use crate::read_errors::{GOOD, errors, rows};

/// What is replaced in a good file, by what, the line, and words of what is said.
const ODD: &str = r#"
inertia = [1, 1, 1, | inertia = [1, 1, 3, | 14 | exceeds the sum
gravity = [0, 0, -9.81] | gravity = [0, 3, 9.81] | 3 | gravity points upwards, along the base's z
velocity = 2 | velocity = 0 | 17 | the limit of velocity is 0: the joint never moves
acceleration = 3 | acceleration = 0.0 | 17 | the limit of acceleration is 0: the joint never moves
mass = 2 | mass = 0 | 14 | the mass is zero
alpha = "pi/2" | alpha = 3.1416 | 7 | from pi
position = [-1, 1] | position = [-1, 1.5708] | 17 | from pi/2
"#;

/// Odd but not wrong: read, with a warning or a note on the right line.
#[test]
fn warnings_and_notes() {
    let note = r#"alpha = "pi/2" | alpha = 4.71238898038469 | 7 | 3*pi/2"#;
    let odd = rows(ODD).map(|row| (row, Severity::Warning));
    for ([what, by, line, message], severity) in
        odd.chain(rows(note).map(|row| (row, Severity::Note)))
    {
        let source = GOOD.replacen(what, by, 1);
        let notes = parse(&source, &Options::default()).expect("reads").notes;
        assert_eq!(notes.len(), 1, "{by}: {notes:?}");
        assert_eq!(
            (notes[0].severity, notes[0].line.to_string()),
            (severity, line.to_owned())
        );
        assert!(notes[0].message.contains(message), "{:?}", notes[0]);
    }
}

/// The same, and words of the help.
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

/// Numbers that look like another unit's: taken as they stand, and the help says
/// what was probably meant.
#[test]
fn sizes_of_other_units() {
    const SLIDES: &str = "kind = \"prismatic\"\ntheta = 0\nd = 0";
    for [what, by, line, message, help] in rows(OTHER_UNITS) {
        let by = by.replace("\\n", "\n");
        let source = GOOD.replacen(what, &by, 1);
        let notes = parse(&source, &Options::default()).expect("reads").notes;
        let [note] = notes.as_slice() else {
            panic!("{by}: {notes:?}");
        };
        assert_eq!(note.severity, Severity::Warning, "{by}");
        assert_eq!(note.line.to_string(), line, "{by}");
        assert!(note.message.contains(message), "{note:?}");
        let said = note.help.as_deref().unwrap_or_default();
        assert!(
            said.contains(help) && said.contains("it is taken as it stands; allow = [\""),
            "{note:?}"
        );
    }
    let sliding = GOOD.replace("kind = \"revolute\"", SLIDES);
    let sliding = sliding.replacen("d = 0.25\ntheta = 0\n", "", 1);
    for (what, by, help) in [
        ("offset = 0.1", "offset = 100", "write 0.1"),
        ("[-1, 1]", "[0, 500]", "write 0.5"),
        ("velocity = 2", "velocity = 500", "write 0.5"),
    ] {
        let source = sliding.replacen(what, by, 1);
        let notes = parse(&source, &Options::default()).expect("reads").notes;
        assert_eq!(notes.len(), 1, "{by}: {notes:?}");
        assert!(
            notes[0]
                .help
                .as_deref()
                .is_some_and(|said| said.contains(help))
        );
    }
}

/// What is usual somewhere is not odd.
#[test]
fn sizes_that_are_none_of_our_business() {
    for (what, by) in [
        ("[0, 0, -9.81]", "[0, 0, 0]"),
        ("[0, 0, -9.81]", "[0, 0, -1.62]"),
        ("[0, 0, -9.81]", "[0, 6.94, -6.94]"),
        ("\"pi/2\"", "\"5*pi/2\""),
        ("\"pi/2\"", "\"450deg\""),
        ("a = 0.5", "a = 10"),
        ("mass = 2", "mass = 999"),
        ("[-1, 1]", "[-31, 31]"),
        // All mass further away than the arm reaches, but not far further.
        ("[1, 1, 1, 0, 0, 0]", "[12, 12, 12, 0, 0, 0]"),
        ("viscous = 0.1", "coulomb = 1\ncoulomb_width = 0.2"),
        ("viscous = 0.1", "coulomb_width = 3"),
        ("[-1, 1]", "[\"-36000deg\", \"36000deg\"]"),
    ] {
        let source = GOOD.replacen(what, by, 1);
        let notes = parse(&source, &Options::default()).expect("reads").notes;
        assert!(notes.is_empty(), "{by}: {notes:?}");
    }
}

/// Three rows say what six numbers say; a massless link needs no com.
#[test]
fn other_ways_to_say_it() {
    let robot = |source: &str| parse(source, &Options::default()).expect("reads").robot;
    let six = GOOD.replace("[1, 1, 1, 0, 0, 0]", "[3, 4, 5, 0.1, 0.2, 0.3]");
    let rows = "[[3, 0.1, 0.3],\n [0.10, 4, 2e-1],\n [0.3, 0.2, 5]] # a comment";
    assert_eq!(
        robot(&six),
        robot(&GOOD.replace("[1, 1, 1, 0, 0, 0]", rows))
    );
    let massless = GOOD
        .replace("mass = 2", "mass = 0.0")
        .replace("com = [0, 0.1, 0]\n", "");
    assert_eq!(errors(&massless), []);
    let bare = massless.replace("inertia = [1, 1, 1, 0, 0, 0]\n", "");
    let zeros = massless.replace("[1, 1, 1, 0, 0, 0]", "[0, 0, 0, 0, 0, 0]");
    assert_eq!(robot(&bare), robot(&zeros));
    // Line ends of another system, and a byte order mark.
    assert_eq!(robot(&GOOD.replace('\n', "\r\n")), robot(GOOD));
    assert_eq!(robot(&format!("\u{feff}{GOOD}")), robot(GOOD));
    // A limits table of its own, and inline joints.
    let table = GOOD
        .replace("limits = {", "[joint.limits]\n")
        .replace(" }", "")
        .replace(", v", "\nv")
        .replace(", a", "\na")
        .replace(", t", "\nt");
    assert_eq!(robot(&table), robot(GOOD));
}

/// A file that knows better says so by name, and hears of the rest only.
#[test]
fn warnings_are_silenced_one_by_one() {
    let odd = GOOD
        .replacen("inertia = [1, 1, 1,", "inertia = [1, 1, 3,", 1)
        .replacen("mass = 2", "mass = 2000", 1);
    let doubts = |source: &str| -> Vec<Option<RobotWarning>> {
        let notes = parse(source, &Options::default()).expect("reads").notes;
        notes.iter().map(|note| note.warning).collect()
    };
    let [mass, inertia] = [RobotWarning::LargeMass, RobotWarning::ImpossibleInertia].map(Some);
    assert_eq!(doubts(&odd), [mass, inertia]);
    for (allow, left) in [
        ("[]", vec![mass, inertia]),
        ("[\"large_mass\"]", vec![inertia]),
        ("[\"impossible_inertia\"]", vec![mass]),
        ("[\"impossible_inertia\", \"large_mass\"]", vec![]),
        // It may be said of what the file has none of.
        ("[\"loose_tolerance\"]", vec![mass, inertia]),
    ] {
        assert_eq!(doubts(&format!("allow = {allow}\n{odd}")), left, "{allow}");
    }
    // A warning says by which name.
    let notes = parse(&odd, &Options::default()).unwrap().notes;
    let help = notes[0].help.as_deref().unwrap();
    assert!(
        help.ends_with("; allow = [\"large_mass\"] silences this"),
        "{help}"
    );
}

/// What silences nothing is an error: whoever wrote it thinks that it does.
#[test]
fn names_of_warnings() {
    for (allow, message, help) in [
        (
            "[\"large_mas\"]",
            "there is no warning `large_mas`",
            "did you mean \"large_mass\"?",
        ),
        (
            "[\"everything\"]",
            "there is no warning `everything`",
            "warnings are: impossible_inertia, ",
        ),
        (
            "[1]",
            "expected a string, found the number `1`",
            "write it in quotes",
        ),
        (
            "\"large_mass\"",
            "expected an array of the names of warnings, found the string `large_mass`",
            "allow = [\"impossible_inertia\"]",
        ),
    ] {
        let found = errors(&format!("allow = {allow}\n{GOOD}"));
        assert_eq!(found.len(), 1, "{allow}: {found:?}");
        assert_eq!((found[0].line, found[0].message.as_str()), (1, message));
        let said = found[0].help.as_deref().unwrap_or_default();
        assert!(said.starts_with(help), "{said}");
    }
    let mut names: Vec<&str> = RobotWarning::WORDS.iter().map(|(name, _)| *name).collect();
    assert!(
        RobotWarning::WORDS
            .iter()
            .all(|(name, warning)| warning.name() == *name)
    );
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), RobotWarning::WORDS.len());
}
