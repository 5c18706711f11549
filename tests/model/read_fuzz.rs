//! No input makes the reader panic or hang, whatever is in it: arbitrary bytes, pieces of TOML in
//! any order, and robot files with pieces moved, doubled, cut out and overwritten.

use crate::support::{data, replaced, written};
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Angle, Rounded};
use dalembert_model::read::parse_bytes;
use dalembert_model::scalar::field::Points;

fn below(points: &mut Points, n: usize) -> usize {
    (points.bits() % n.max(1) as u64) as usize
}

fn multiplied(runs: usize) -> usize {
    runs * std::env::var("FUZZ_TIMES").map_or(1, |times| times.parse().unwrap_or(1))
}

fn fuzz(seed: u64, runs: usize, draw: impl Fn(&mut Points) -> Vec<u8>) {
    let mut random = Points::new(seed);
    (0..multiplied(runs)).for_each(|_| check(&draw(&mut random)));
}

/// Pieces that mean something to a TOML parser or to the reader, bars between them.
const PIECES: &str = "[|]|[[|]]|{|}|=|.|,|\n|\r\n|\r| |\t|#|\"|'|\"\"\"|'''|\\|\\u00e9|\\U0010FFFF|\
    \\uD800|\\x41|\0|\u{feff}|é|joint|scene|name|limits|a|d|theta|offset|mass|inertia|position|\
    [[joint]]\n|[joint]\n|[joint.limits]\n|[[joint.limits]]\n|a.b.c = 1\n|a = 1\n|\
    kind = \"revolute\"\n|kind = \"prismatic\"\n|-|+|1e400|1e-400|0x7f|nan|-inf|\
    99999999999999999999|1979-05-27T07:32:00Z|\"pi/2\"|1.5707963267948966|_1_";

fn piece(random: &mut Points) -> &'static str {
    let pieces: Vec<&str> = PIECES.split('|').collect();
    pieces[below(random, pieces.len())]
}

fn check(bytes: &[u8]) {
    let source = core::str::from_utf8(bytes).unwrap_or("");
    match parse_bytes(bytes) {
        Ok(reading) => {
            let robot = reading.robot;
            let wrong = robot.validate().iter().any(|f| f.is_error());
            assert!(!wrong, "{source}");
            written(&robot);
        }
        Err(errors) => {
            assert!(!errors.0.is_empty());
            for error in &errors.0 {
                let at = error.excerpt().unwrap();
                assert!(at.line >= 1 && at.column >= 1);
                assert!(!error.message.is_empty());
            }
            assert!(errors.render().starts_with("error: "));
        }
    }
}

#[test]
fn arbitrary_bytes() {
    for mask in [0xff, 0x7f] {
        fuzz(1, 4000, |random| {
            let length = below(random, 200);
            (0..length).map(|_| random.bits() as u8 & mask).collect()
        });
    }
}

/// Tables that contradict each other: where a TOML parser has its assertions.
#[test]
fn tables_in_any_order() {
    fuzz(5, 8000, |random| {
        let lines = 0..below(random, 9);
        let line = |_| {
            let parts = 0..=below(random, 3);
            let parts = parts.map(|_| ["a", "b", "joint", "\"\""][below(random, 4)]);
            let key = parts.collect::<Vec<_>>().join(".");
            match below(random, 6) {
                0 | 1 => format!("[{key}]\n"),
                2 | 3 => format!("[[{key}]]\n"),
                4 => format!("{key} = 1\n"),
                _ => format!("{key} = {{ a.b = [1, {{ b = 2 }}] }}\n"),
            }
        };
        lines.map(line).collect::<String>().into_bytes()
    });
}

#[test]
fn pieces_of_toml() {
    fuzz(2, 8000, |random| {
        let pieces = 0..below(random, 30);
        pieces.flat_map(|_| piece(random).bytes()).collect()
    });
}

fn mutated(seeds: &[String], most: usize, random: &mut Points) -> Vec<u8> {
    let mut bytes = seeds[below(random, seeds.len())].clone().into_bytes();
    (0..=below(random, most)).for_each(|_| mutate(&mut bytes, random));
    bytes
}

#[test]
fn mutated_robots() {
    let folder = format!("{}/generated/robots", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(folder).expect("robot files");
    let read = |path| std::fs::read_to_string(path).expect("a file");
    let mut seeds: Vec<String> = files.map(|entry| read(entry.unwrap().path())).collect();
    seeds.sort();
    fuzz(3, 8000, |random| mutated(&seeds, 6, random));
}

#[test]
fn mutated_placements() {
    let seeds = ["scara_placed.toml", "puma560_placed.toml"].map(|name| {
        let ends = "base = { xyz = [1e-3, 0, 12.5], rpy = [0.1, \"pi/2\", 0] }\n\
                    tool = { xyz = [0.25, 0, 0], rpy = [0, \"-30deg\", 0] }\n";
        replaced(&data(name), "\n[[joint]]", &format!("{ends}\n[[joint]]"))
    });
    fuzz(5, 800, |random| mutated(&seeds, 3, random));
    for (from, to) in [
        ("0.387", "1e300"),
        ("0.387", "1e-300"),
        ("axis = [0, 0, 1]", "axis = [1e-300, 1e300, 0]"),
        ("axis = [0, 0, 1]", "axis = [1e-200, 0, 1]"),
        ("-0.325", "1e-299"),
        ("\"pi/2\"", "1e300"),
        ("0.031", "1e300"),
    ] {
        check(replaced(&seeds[0], from, to).as_bytes());
    }
}

fn mutate(bytes: &mut Vec<u8>, random: &mut Points) {
    let at = below(random, bytes.len());
    let to = (at + below(random, 40)).min(bytes.len());
    match below(random, 6) {
        0 => drop(bytes.drain(at..to)),
        1 => drop(bytes.splice(at..at, piece(random).bytes())),
        2 => drop(bytes.splice(at..to, piece(random).bytes())),
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
        _ => {
            let behind = bytes.iter_mut().skip(at);
            for byte in behind.filter(|b| b.is_ascii_digit()).take(3) {
                *byte = b'0' + below(random, 10) as u8;
            }
        }
    }
}

#[test]
fn numbers_and_angles() {
    const LETTERS: &[u8] = b"0123456789.+-_eEpi*/deg nxab ";
    let mut random = Points::new(4);
    for _ in 0..multiplied(20_000) {
        let letters = 0..below(&mut random, 12);
        let letter = |_| LETTERS[below(&mut random, LETTERS.len())] as char;
        let text: String = letters.map(letter).collect();
        let value = parse_decimal(&text);
        if let (Ok(value), false) = (&value, text.contains('_')) {
            let double: f64 = text.parse().expect("std reads it too");
            let nearest = f64::nearest_rational(value);
            assert_eq!(nearest, double, "{text}");
        }
        if let Ok(angle @ Angle::PiTimes(_)) = Angle::parse(&text) {
            let again = Angle::parse(&angle.to_string()).unwrap_or_default();
            assert_eq!(again, angle, "{text}");
        }
    }
}
