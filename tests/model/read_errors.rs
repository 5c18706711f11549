//! Errors of a file are on the right line, in words that help, and all at once.

use crate::support::{errors, has, only, replaced};
use dalembert_model::read::{Diagnostic, MAX_BYTES, parse, parse_bytes};

/// A good robot of one joint; the rows below put one thing wrong.
pub const GOOD: &str = r#"name = "arm"
convention = "standard"
gravity = [0, 0, -9.81]
[[joint]]
name = "waist"
kind = "revolute"
alpha = "pi/2"
a = 0.5
d = 0.25
theta = 0
offset = 0.1
mass = 2
com = [0, 0.1, 0]
inertia = [1, 1, 1, 0, 0, 0]
viscous = 0.1
armature = 0.1
limits = { position = [-1, 1], velocity = 2, acceleration = 3, torque = 4 }
"#;

/// Line to replace, what by, and pieces of the one error expected there.
type Row = (&'static str, &'static str, &'static str, &'static str);

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("name = \"arm\"", "", "the robot has no `name`", "name = \"puma560\""),
    ("convention = \"standard\"", "", "the robot has no `convention`", "\"modified\""),
    ("gravity = [0, 0, -9.81]", "", "the robot has no `gravity`", "m/s²"),
    ("name = \"arm\"", "name = 3", "expected a string, found the number `3`", "quotes"),
    ("name = \"arm\"", "name = \"\"", "the name is empty", "lower-case"),
    ("name = \"arm\"", "name = \"PUMA 560\"", "cannot name a Rust module", "\"puma_560\""),
    ("name = \"arm\"", "name = \"3r\"", "cannot name a Rust module", "\"robot_3r\""),
    ("name = \"waist\"", "name = \"w\\u202Eaist\"", "turns the direction of text", "write \"waist\""),
    ("name = \"waist\"", "name = \"\\u2066\"", "turns the direction of text", "leave the name out"),
    ("name = \"arm\"", "name = \"loop\"", "a Rust keyword", "\"loop_robot\""),
    ("name = \"arm\"", "name = \"bras_mécanique\"", "cannot name", "\"bras_m_canique\""),
    ("name = \"arm\"", "nmae = \"arm\"", "the robot has no `name`", ""),
    ("convention = \"standard\"", "convention = \"standrad\"", "expected \"standard\" or \"modified\"", "did you mean \"standard\""),
    ("convention = \"standard\"", "convention = \"craig\"", "found the string `craig`", "did you mean \"modified\""),
    ("convention = \"standard\"", "convention = \"DH\"", "found the string `DH`", "\"standard\" where joint i acts along z of frame i − 1, \"modified\" (Craig)"),
    ("convention = \"standard\"", "convention = 1", "found the number `1`", "\"modified\" (Craig)"),
    ("a = 0.5", "axis = [0, 0, 1]", "`axis` beside `alpha`, and no `placement`", "joints act along z: leave `axis` out"),
    ("convention = \"standard\"", "convention = true", "found `true`", ""),
    ("gravity = [0, 0, -9.81]", "gravity = [0, -9.81]", "expected an array of 3, found an array of 2", "gravity ="),
    ("gravity = [0, 0, -9.81]", "gravity = -9.81", "expected an array of 3, found the number `-9.81`", "base axes"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, inf]", "`inf` is not a finite number", "finite"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, \"-9.81\"]", "expected a number, found the string", "without quotes"),
    ("[[joint]]", "[joint]", "expected [[joint]] tables, found a table", "two brackets"),
    ("[[joint]]", "[[joints]]", "the robot has no `joint`", ""),
    ("name = \"arm\"", "name = \"arm\"\nnotes = \"soft\"", "expected an array of strings", "notes = ["),
    ("name = \"arm\"", "name = \"arm\"\nnotes = [\"a\\nb\"]", "a note has a character that controls text", "in one line"),
    ("kind = \"revolute\"", "", "joint 1 has no `kind`", "prismatic"),
    ("mass = 2", "", "joint 1 has no `mass`", "mass = 0"),
    ("com = [0, 0.1, 0]", "", "joint 1 has no `com`", "only a link with mass = 0"),
    ("inertia = [1, 1, 1, 0, 0, 0]", "", "joint 1 has no `inertia`", "Ixx, Iyy, Izz"),
    ("a = 0.5", "length = 0.5", "unknown key `length`", "did you mean `a`"),
    ("viscous = 0.1", "damping = 0.1", "unknown key `damping`", "did you mean `viscous`"),
    ("armature = 0.1", "colour = \"red\"", "unknown key `colour`", "joint 1 has: name, kind"),
    ("kind = \"revolute\"", "kind = \"revolut\"", "found the string `revolut`", "did you mean \"revolute\""),
    ("kind = \"revolute\"", "kind = \"slider\"", "expected \"revolute\" or \"prismatic\"", ""),
    ("kind = \"revolute\"", "kind = \"fixed\"", "found the string `fixed`", "part of the link before"),
    ("kind = \"revolute\"", "kind = 0", "found the number `0`", ""),
    ("kind = \"revolute\"", "kind = \"prismatic\"", "`d` of a prismatic joint is its variable", "called `offset`"),
    ("theta = 0", "theta = 0.5", "`theta` of a revolute joint is its variable", "called `offset`"),
    ("name = \"waist\"", "name = \"\"", "a joint's name has 1 to 64 characters", "leave the name out"),
    ("name = \"waist\"", "name = \"a\\nb\"", "control character", ""),
    ("name = \"waist\"", "name = \"2\"", "joint 1 is called \"2\", which is a joint's number and not its own", "write \"joint_2\""),
    ("name = \"waist\"", "name = \"+02\"", "a joint's number and not its own", "write \"joint_2\""),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [1, 1, -1, 0, 0, 0]", "a principal moment is negative", "about the centre of mass"),
    ("mass = 2", "mass = nan", "`nan` is not a finite number", ""),
    ("mass = 2", "mass = -inf", "`-inf` is not a finite number", ""),
    ("mass = 2", "mass = -2", "mass is negative", "zero or more"),
    ("mass = 2", "mass = 0x10", "in another base", "decimal"),
    ("mass = 2", "mass = 1e-301", "too large or too small", "1e-300 to 1e300"),
    ("mass = 2", "mass = 1e301", "too large or too small", "1e-300 to 1e300"),
    ("mass = 2", "mass = 1e400", "`1e400` is a number too large or too small", "zero, or a size from 1e-300 to 1e300"),
    ("mass = 2", "mass = .5", "expected a value, found a period", ""),
    ("mass = 2", "mass = +-5", "not a decimal number", "0.5"),
    ("mass = 2", "mass = 99999999999999999999", "is not a number that TOML can hold", "1e30"),
    ("mass = 2", "mass = \"1/0\"", "denominator zero", ""),
    ("mass = 2", "mass = \"2 kg\"", "expected a number, found the string `2 kg`", "SI units"),
    ("mass = 2", "mass = \"pi\"", "expected a number", "not an angle"),
    ("mass = 2", "mass = 2 kg", "expected newline, found an identifier", ""),
    ("a = 0.5", "a = half", "`half` is neither a number nor a quoted string", "in quotes"),
    ("a = 0.5", "a = 1979-05-27", "is not a number", ""),
    ("viscous = 0.1", "viscous = -0.1", "viscous is negative", "energy"),
    ("viscous = 0.1", "coulomb = -0.1", "coulomb is negative", "energy"),
    ("viscous = 0.1", "coulomb = 0.1", "Coulomb friction without a `coulomb_width`", "coulomb_width = 0.01, in rad/s"),
    ("viscous = 0.1", "coulomb = \"0.1 Nm\"", "expected a number, found the string `0.1 Nm`", "SI units"),
    ("viscous = 0.1", "coulomb = 0.1\ncoulomb_width = 0", "Coulomb friction without a `coulomb_width`", "coulomb_width = 0.01"),
    ("viscous = 0.1", "friction = 0.1", "unknown key `friction`", "write `viscous` for friction that grows with the speed, `coulomb` for"),
    ("viscous = 0.1", "coulomb_width = -0.1", "coulomb_width is negative", "coulomb_width = 0.01"),
    ("viscous = 0.1", "coulomb_width = 1e-12", "a coulomb_width too large or too small", "coulomb_width = 0.01"),
    ("viscous = 0.1", "coulomb_width = \"narrow\"", "expected a number", ""),
    ("viscous = 0.1", "coulomb_friction = 0.1", "unknown key `coulomb_friction`", "did you mean `coulomb`"),
    ("armature = 0.1", "armature = -1", "armature is negative", "rotor"),
    ("alpha = \"pi/2\"", "alpha = \"pi/0\"", "expected an angle, found the string `pi/0`", "90deg"),
    ("alpha = \"pi/2\"", "alpha = \"1.5\"", "expected an angle", "without quotes"),
    ("alpha = \"pi/2\"", "alpha = \"180\"", "expected an angle", "of radians write 180 without quotes, of degrees \"180deg\""),
    ("alpha = \"pi/2\"", "alpha = [1]", "expected an angle, found an array of 1", "radians"),
    ("alpha = \"pi/2\"", "alpha = pi/2", "`pi/2` is not a number", "write \"pi/2\", in quotes"),
    ("alpha = \"pi/2\"", "alpha = -pi/2", "expected the end of the value, found `/`", "in quotes"),
    ("alpha = \"pi/2\"", "alpha = -pi", "`-pi` is not a number", "write \"-pi\", in quotes"),
    ("alpha = \"pi/2\"", "alpha = 90deg", "`90deg` is not a number", "write \"90deg\", in quotes"),
    ("alpha = \"pi/2\"", "alpha = 3*pi/4", "found `*`", "in quotes"),
    ("offset = 0.1", "offset = \"ninety\"", "expected an angle", ""),
    ("com = [0, 0.1, 0]", "com = [0, 0.1]", "expected an array of 3", "com ="),
    ("com = [0, 0.1, 0]", "com = { x = 1 }", "expected an array of 3, found a table", ""),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [1, 1, 1]", "expected 6 numbers or 3 rows of 3, found an array of 3", "Ixx"),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [1, [2], 3, 4, 5, 6]", "expected a number, found an array of 1", "SI units"),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [[1,0,0],[0,1],[0,0,1]]", "expected an array of 3, found an array of 2", ""),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [[1,0,0.1],[0,1,0],[0.2,0,1]]", "row 1, column 3 is not row 3, column 1", "same number"),
    ("limits = {", "limits = { speed = 2,", "unknown key `speed`", "limits has: position, velocity"),
    ("position = [-1, 1]", "position = [1, -1]", "the lowest position is not below the highest", "[lowest, highest]"),
    ("position = [-1, 1]", "position = [\"pi\", \"180deg\"]", "the lowest position is not below", ""),
    ("position = [-1, 1]", "position = [1]", "expected an array of 2", "lowest"),
    ("velocity = 2", "velocity = -2", "velocity is negative", "both directions"),
    ("velocity = 2", "velocity = \"120deg\"", "expected a number, found the string `120deg`", "in rad/s, as a number: write 2.0944"),
    ("velocity = 2", "velocity = \"2*pi/3\"", "expected a number", "write 2.0944"),
    ("velocity = 2", "velocity = \"120deg/s\"", "expected a number", "write 2.0944"),
    ("acceleration = 3", "acceleration = \"90deg\"", "expected a number", "in rad/s², as a number: write 1.5708"),
    ("torque = 4", "torque = inf", "not a finite number", "leave the key out"),
    ("a = 0.5", "a = 0.5\na = 0.6", "the key `a` is defined twice", "line 8"),
    ("name = \"arm\"", "name = \"arm", "the string does not end on its line", "quotation mark"),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [1, 1", "", ""),
    ("a = 0.5", "a =", "expected a value, found a newline", ""),
    ("a = 0.5", "a 0.5", "expected an equals", ""),
    ("a = 0.5", "a = \"\\q\"", "invalid escape", ""),
    ("mass = 2", "mass = 04", "`04` begins with a zero", "write 4"),
    ("mass = 2", "mass = -00.5", "`-00.5` begins with a zero", "write -0.5"),
    ("mass = 2", "mass = \u{2212}4", "the character `\u{2212}` (U+2212)", "minus of the keyboard"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, \u{2013}9.81]", "(U+2013)", "minus of the keyboard"),
    ("alpha = \"pi/2\"", "alpha = \"\u{2212}pi/2\"", "expected an angle", "write \"-pi/2\""),
    ("mass = 2", "mass = \"\u{2212}2\"", "expected a number", "minus of the keyboard"),
    ("name = \"arm\"", "name = \u{201c}arm\u{201d}", "(U+201C)", "quotation mark of the keyboard"),
    ("mass = 2", "mass =\u{a0}2", "U+00A0", "an ordinary space"),
    ("mass = 2", "mass = 17,4", "expected newline, found a comma", "decimals have a point: 17.4"),
    ("mass = 2", "mass = \"17,4\"", "expected a number", "decimals have a point: 17.4"),
    ("alpha = \"pi/2\"", "alpha = \"1,57\"", "expected an angle", "decimals have a point: 1.57"),
    ("gravity = [0, 0, -9.81]", "gravity = [0, 0, -9,81]", "found an array of 4", "decimals have a point: -9.81"),
    ("inertia = [1, 1, 1, 0, 0, 0]", "inertia = [1,5, 1, 1, 0, 0, 0]", "found an array of 7", "decimals have a point: 1.5"),
    ("velocity = 2", "velocity = 2,5", "", "decimals have a point: 2.5"),
];

#[test]
fn one_row_a_case() {
    assert_eq!(errors(GOOD), []);
    for (what, by, message, help) in ROWS {
        let errors = errors(&replaced(GOOD, what, by));
        let said = |error: &Diagnostic| {
            let hint = error.help.as_deref().unwrap_or_default();
            error.message.contains(message) && hint.contains(help)
        };
        let what = format!("{by:?} for {what:?}: expected {message:?} ({help:?})");
        assert!(errors.iter().any(said), "{what}, found {errors:#?}");
    }
}

#[test]
fn other_formats() {
    for (source, format) in [
        ("{\"name\": \"arm\"}", "JSON"),
        ("\u{feff}\n[ {\"name\": 1}]", "JSON"),
        ("<?xml version=\"1.0\"?>\n<robot name=\"a\"/>", "URDF"),
        ("<mujoco/>", "XML"),
        ("name: arm\njoints:\n  - a: 1\n", "YAML"),
        ("# An arm.\n---\nname: arm\n", "YAML"),
        ("joints:\n- {a: 1}\n", "YAML"),
    ] {
        has(only(&errors(source)), format, "TOML");
    }
    let errors = errors("name = \"arm\"\ngravity: [0, 0, 1]\n");
    assert!(!errors[0].message.contains("YAML"), "{errors:?}");
}

#[test]
fn lines_and_columns() {
    for (what, by, line, column) in [
        ("name = \"arm\"", "name = 3", 1, 8),
        ("mass = 2", "mass = -2", 12, 8),
        ("com = [0, 0.1, 0]", "com = [0, nan, 0]", 13, 11),
        ("torque = 4", "tork = 4", 17, 64),
        ("mass = 2", "", 4, 1),
        ("a = 0.5", "a = 0.5 ü", 8, 9),
        ("viscous = 0.1", "coulomb = 0.1\ncoulomb_width = 0", 16, 17),
        ("viscous = 0.1", "coulomb = 0.1", 15, 11),
    ] {
        let errors = errors(&replaced(GOOD, what, by));
        let at = only(&errors).excerpt().unwrap();
        let place = (at.line, at.column);
        assert_eq!(place, (line, column), "{by}: {errors:?}");
    }
}

#[test]
fn all_at_once() {
    let source = GOOD
        .replace("mass = 2", "mass = -2")
        .replace("name = \"arm\"", "name = \"Arm\"")
        .replace("torque = 4", "torque = -4")
        .replace("a = 0.5", "aa = 0.5")
        .replace("com = [0, 0.1, 0]", "com = [nan, true, 0]");
    let lines: Vec<_> = errors(&source).iter().map(|d| d.line().unwrap()).collect();
    assert_eq!(lines, [1, 8, 12, 13, 13, 17]);
}

#[test]
fn rendering() {
    let source = GOOD.replace("viscous = 0.1", "\tviscuos = 0.1");
    let errors = parse(&source).expect_err("a slip");
    let rendered = "error: unknown key `viscuos`\n --> arm.toml:15:2\n   |\n15 |  viscuos = 0.1\n   \
                    |  ^^^^^^^\n   = help: did you mean `viscous`?\n";
    assert_eq!(errors.clone().in_file("arm.toml").render(), rendered);
    let line = "15:2: error: unknown key `viscuos`: did you mean `viscous`?";
    assert_eq!(errors.0[0].to_string(), line);
}

#[test]
fn joints() {
    let head = "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, 0]\n";
    let joint = "[[joint]]\nkind = \"revolute\"\nmass = 0\ninertia = [0, 0, 0, 0, 0, 0]\n";
    let many = |n| format!("{head}{}", joint.repeat(n));
    assert_eq!(errors(&many(64)), []);
    let twice = many(2).replace("kind", "name = \"waist\"\nkind");
    for (text, message, line) in [
        (many(65), "a robot has 1 to 64 joints, not 65", 4 + 64 * 4),
        (twice, "joint 1 is called \"waist\" already", 10),
    ] {
        let errors = errors(&text);
        let said = (&*only(&errors).message, errors[0].line().unwrap());
        assert_eq!(said, (message, line));
    }
    has(&errors(head)[0], "no `joint`", "");
    has(&errors(&format!("joint = []\n{head}"))[0], "not 0", "");
}

#[test]
fn limits_on_the_input() {
    let long = "x".repeat(100_000);
    for (source, message) in [
        ("#".repeat(MAX_BYTES + 1), "at most 1048576"),
        (format!("a = {}", "[".repeat(500_000)), "levels deep"),
        (format!("a = {}", "{a=".repeat(300_000)), "levels deep"),
        (format!("{}a = 1", "a.".repeat(500_000)), "levels deep"),
        (format!("[{}a]", "a.".repeat(500_000)), "levels deep"),
        ("a.b = 1\n".repeat(100_000), "keys and tables"),
        ("[[a]]\n".repeat(100_000), "keys and tables"),
        (format!("name = \"{long}\""), "a word of more than"),
        (long, "a word of more than"),
    ] {
        let diagnostics = errors(&source);
        has(only(&diagnostics), message, "");
        assert!(diagnostics[0].render().len() < 1000);
    }
    let digits = "1".repeat(1000);
    let digit_errors = errors(&GOOD.replace("mass = 2", &format!("mass = 0.{digits}")));
    has(&digit_errors[0], "more than 800 digits", "");
    let key_errors = errors(&(0..8000).map(|i| format!("k{i} = 1\n")).collect::<String>());
    assert!(key_errors.len() <= 200);
    has(&key_errors[199], "more errors", "");
}

#[test]
fn not_utf8() {
    let mut bytes = GOOD.as_bytes().to_vec();
    let at = GOOD.find("waist").expect("there");
    bytes[at] = 0xff;
    let errors = parse_bytes(&bytes).expect_err("not text");
    let at = errors.0[0].excerpt().unwrap();
    assert_eq!((at.line, at.column), (5, 9));
    has(&errors.0[0], "not UTF-8", "");
}
