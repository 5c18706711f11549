//! No input makes the reader panic or hang, whatever is in it: arbitrary
//! bytes, pieces of TOML in any order, and robot files with pieces moved,
//! doubled, cut out and overwritten.

use dalembert_model::number::Angle;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::read::{Options, parse, parse_bytes};
use dalembert_model::robot::write;
use dalembert_model::scalar::field::Points;

fn below(points: &mut Points, n: usize) -> usize {
    (points.bits() % n.max(1) as u64) as usize
}

/// Returns a dose for every day; `FUZZ_TIMES` multiplies it.
fn dose(runs: usize) -> usize {
    let times = std::env::var("FUZZ_TIMES").ok();
    let times: Option<usize> = times.and_then(|times| times.parse().ok());
    runs * times.unwrap_or(1)
}

/// Pieces that mean something to a TOML parser or to the reader.
const PIECES: [&str; 58] = [
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    ".",
    ",",
    "\n",
    "\r\n",
    "\r",
    " ",
    "\t",
    "#",
    "\"",
    "'",
    "\"\"\"",
    "'''",
    "\\",
    "\\u00e9",
    "\\U0010FFFF",
    "\\uD800",
    "\\x41",
    "\0",
    "\u{feff}",
    "é",
    "joint",
    "scene",
    "name",
    "limits",
    "a",
    "d",
    "theta",
    "offset",
    "mass",
    "inertia",
    "position",
    "[[joint]]\n",
    "[joint]\n",
    "[joint.limits]\n",
    "[[joint.limits]]\n",
    "a.b.c = 1\n",
    "a = 1\n",
    "kind = \"revolute\"\n",
    "kind = \"prismatic\"\n",
    "-",
    "+",
    "1e400",
    "1e-400",
    "0x7f",
    "nan",
    "-inf",
    "99999999999999999999",
    "1979-05-27T07:32:00Z",
    "\"pi/2\"",
    "1.5707963267948966",
    "_1_",
];

/// Asserts that whatever comes back makes sense: positions within the text, errors printable,
/// robots valid and able to go round.
fn check(bytes: &[u8]) {
    let source = core::str::from_utf8(bytes).unwrap_or("");
    match parse_bytes(bytes, &Options::default()) {
        Ok(reading) => {
            let robot = reading.robot;
            let wrong = robot.validate().iter().any(|f| f.is_error());
            assert!(!wrong, "{source}");
            let again = parse(&write(&robot), &Options::default())
                .expect("reads")
                .robot;
            assert_eq!(again, robot, "{source}");
        }
        Err(errors) => {
            assert!(!errors.0.is_empty());
            for error in &errors.0 {
                assert!(error.line >= 1 && error.column >= 1);
                assert!(!error.message.is_empty());
            }
            assert!(errors.render("f.toml", source).starts_with("error: "));
        }
    }
}

#[test]
fn arbitrary_bytes() {
    let mut random = Points::new(1);
    for _ in 0..dose(4000) {
        let length = below(&mut random, 200);
        let bytes: Vec<u8> = (0..length).map(|_| random.bits() as u8).collect();
        check(&bytes);
        let ascii: Vec<u8> = bytes.iter().map(|b| b & 0x7f).collect();
        check(&ascii);
    }
}

/// Table headers, dotted keys and arrays of tables that contradict each other:
/// where a TOML parser has its assertions.
#[test]
fn tables_in_any_order() {
    const PARTS: [&str; 4] = ["a", "b", "joint", "\"\""];
    let mut random = Points::new(5);
    for _ in 0..dose(8000) {
        let mut text = String::new();
        for _ in 0..below(&mut random, 9) {
            let parts: Vec<&str> = (0..=below(&mut random, 3))
                .map(|_| PARTS[below(&mut random, PARTS.len())])
                .collect();
            let key = parts.join(".");
            text += &match below(&mut random, 6) {
                0 | 1 => format!("[{key}]\n"),
                2 | 3 => format!("[[{key}]]\n"),
                4 => format!("{key} = 1\n"),
                _ => format!("{key} = {{ a.b = [1, {{ b = 2 }}] }}\n"),
            };
        }
        check(text.as_bytes());
    }
}

#[test]
fn pieces_of_toml() {
    let mut random = Points::new(2);
    for _ in 0..dose(8000) {
        let count = below(&mut random, 30);
        let text: String = (0..count)
            .map(|_| PIECES[below(&mut random, PIECES.len())])
            .collect();
        check(text.as_bytes());
    }
}

#[test]
fn mutated_robots() {
    let folder = format!("{}/../generated/robots", env!("CARGO_MANIFEST_DIR"));
    let mut seeds = Vec::new();
    for entry in std::fs::read_dir(folder).expect("robot files") {
        let path = entry.expect("an entry").path();
        seeds.push(std::fs::read(path).expect("a file"));
    }
    seeds.sort();
    let mut random = Points::new(3);
    for _ in 0..dose(8000) {
        let mut bytes = seeds[below(&mut random, seeds.len())].clone();
        for _ in 0..=below(&mut random, 6) {
            mutate(&mut bytes, &mut random);
        }
        check(&bytes);
    }
}

/// The same with joints that are placed: rows are derived of whatever reads.
#[test]
fn mutated_placements() {
    let folder = format!("{}/tests/data", env!("CARGO_MANIFEST_DIR"));
    let seeds = ["scara_placed", "puma560_placed"].map(|name| {
        let text = std::fs::read_to_string(format!("{folder}/{name}.toml")).expect("a file");
        let ends = "base = { xyz = [1e-3, 0, 12.5], rpy = [0.1, \"pi/2\", 0] }\n\
                    tool = { xyz = [0.25, 0, 0], rpy = [0, \"-30deg\", 0] }\n";
        text.replacen("\n[[joint]]", &format!("{ends}\n[[joint]]"), 1)
    });
    let mut random = Points::new(5);
    for _ in 0..dose(800) {
        let mut bytes = seeds[below(&mut random, seeds.len())].clone().into_bytes();
        for _ in 0..=below(&mut random, 3) {
            mutate(&mut bytes, &mut random);
        }
        check(&bytes);
    }
    // Numbers as large and as small as they may be.
    for (from, to) in [
        ("0.387", "1e300"),
        ("0.387", "1e-300"),
        ("axis = [0, 0, 1]", "axis = [1e-300, 1e300, 0]"),
        ("axis = [0, 0, 1]", "axis = [1e-200, 0, 1]"),
        ("-0.325", "1e-299"),
        ("\"pi/2\"", "1e300"),
        ("0.031", "1e300"),
    ] {
        let text = seeds[0].replacen(from, to, 1);
        assert_ne!(text, seeds[0], "{from}");
        check(text.as_bytes());
    }
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Points) {
    let at = below(random, bytes.len());
    let to = (at + below(random, 40)).min(bytes.len());
    match below(random, 6) {
        0 => drop(bytes.drain(at..to)),
        1 => {
            let piece = PIECES[below(random, PIECES.len())].bytes();
            drop(bytes.splice(at..at, piece));
        }
        2 => {
            let piece = PIECES[below(random, PIECES.len())].bytes();
            drop(bytes.splice(at..to, piece));
        }
        3 => {
            let copy = bytes[at..to].to_vec();
            let at = below(random, bytes.len());
            drop(bytes.splice(at..at, copy));
        }
        4 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = random.bits() as u8;
            }
        }
        // Digits for digits: what is still a robot file.
        _ => {
            for byte in bytes
                .iter_mut()
                .skip(at)
                .filter(|b| b.is_ascii_digit())
                .take(3)
            {
                *byte = b'0' + below(random, 10) as u8;
            }
        }
    }
}

#[test]
fn numbers_and_angles() {
    const LETTERS: &[u8] = b"0123456789.+-_eEpi*/deg nxab ";
    let mut random = Points::new(4);
    for _ in 0..dose(20_000) {
        let length = below(&mut random, 12);
        let text: String = (0..length)
            .map(|_| LETTERS[below(&mut random, LETTERS.len())] as char)
            .collect();
        let value = parse_decimal(&text);
        if let (Ok(value), false) = (&value, text.contains('_')) {
            let double: f64 = text.parse().expect("std reads it too");
            assert_eq!(
                num_traits::ToPrimitive::to_f64(value),
                Some(double),
                "{text}"
            );
        }
        if let Ok(angle @ Angle::PiTimes(_)) = Angle::parse(&text) {
            assert_eq!(
                Angle::parse(&angle.to_string()).unwrap_or_default(),
                angle,
                "{text}"
            );
        }
    }
}
