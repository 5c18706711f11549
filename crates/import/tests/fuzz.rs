//! Any bytes get an answer, never a panic, and the same one twice; a robot file that was made
//! reads.

use crate::support::{URDFS, snapped, source, to};
use dalembert_import::{Options, import};
use dalembert_model::read;

/// xorshift.
struct Draw(u64);

impl Draw {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as usize % n.max(1)
    }
}

/// The sign of the second −1 is not ASCII's.
const WORDS: [&str; 16] = [
    "", "0", "-1", "1e400", "1e-320", "nan", "inf", "0x10", ".5", "5.", "${pi/2}", "1,5", "−1",
    "1.5708", "é\u{0}", "revolute",
];

fn mutated(source: &str, draw: &mut Draw) -> String {
    let mut text: Vec<char> = source.chars().collect();
    for _ in 0..1 + draw.below(4) {
        let at = draw.below(text.len());
        let end = (at + draw.below(60)).min(text.len());
        match draw.below(5) {
            0 => drop(text.drain(at..end)),
            1 => {
                let copy = text[at..end].to_vec();
                text.splice(at..at, copy);
            }
            2 => {
                let other = draw.below(text.len());
                text.swap(at, other);
            }
            3 => {
                let word = WORDS[draw.below(WORDS.len())];
                text.splice(at..end.min(at + 3), word.chars());
            }
            _ => {
                let quote = |from: usize| Some(from + text[from..].iter().position(|c| *c == '"')?);
                let inside = quote(at).and_then(|open| Some(open + 1..quote(open + 1)?));
                let Some(inside) = inside else { continue };
                let word = WORDS[draw.below(WORDS.len())];
                text.splice(inside, word.chars());
            }
        }
        if text.is_empty() {
            break;
        }
    }
    text.into_iter().collect()
}

fn answers(seed: u64, cases: &[(String, Options)]) -> (usize, usize) {
    let mut draw = Draw(seed);
    let (mut made, mut refused) = (0, 0);
    for round in 0..60 {
        for (source, options) in cases {
            let source = mutated(source, &mut draw);
            let options = Options {
                exact: round % 3 == 0,
                ..options.clone()
            };
            match import(&source, &options) {
                Ok(imported) => {
                    made += 1;
                    assert_eq!(import(&source, &options).unwrap().text, imported.text);
                    let again = read::parse(&imported.text).unwrap();
                    assert_eq!(again.robot, imported.robot);
                    let change = imported.change.map(|change| change.to_string());
                    assert!(change.is_none_or(|change| !change.contains("NaN")));
                }
                Err(errors) => {
                    refused += 1;
                    assert!(!errors.0.is_empty());
                    assert!(errors.0.iter().all(|error| !error.message.is_empty()));
                    assert!(!errors.render().is_empty());
                }
            }
        }
    }
    (made, refused)
}

#[test]
fn an_answer_for_every_text() {
    let mut cases = Vec::from(URDFS.map(|name| (source(name), snapped(name))));
    let tree = Options {
        tree: true,
        ..Options::default()
    };
    cases.push((source("panda"), tree));
    let (made, refused) = answers(0x9e37_79b9_7f4a_7c15, &cases);
    assert!(made > 30 && refused > 30, "{made} made, {refused} refused");
}

#[test]
fn an_answer_for_every_mjcf() {
    let tips = [
        ("degrees", "end"),
        ("geoms", "three"),
        ("so101", "gripper_link"),
    ];
    let source = |name: &str| source(&format!("mjcf/{name}"));
    let cases = tips.map(|(name, tip)| (source(name), to(tip, &[("*", "0")])));
    let (made, refused) = answers(0x2545_f491_4f6c_dd1d, &cases);
    // Small files: little of them may go.
    assert!(made > 5 && refused > 30, "{made} made, {refused} refused");
}

/// Long names, many elements, deep nesting, circles: refused in time and memory that the size of
/// the file bounds.
#[test]
fn hostile_files_are_refused_at_once() {
    let nested = |open: &str, close: &str, count: usize| {
        format!("{}{}", open.repeat(count), close.repeat(count))
    };
    let many =
        |count: usize, item: &dyn Fn(usize) -> String| -> String { (0..count).map(item).collect() };
    let robot = |inside: &str| format!("<robot name=\"r\">{inside}</robot>");
    let model = |inside: &str| format!("<mujoco><worldbody>{inside}</worldbody></mujoco>");
    let body = |inside: String| model(&format!("<body>{inside}</body>"));
    let default = |inside: &str| format!("<mujoco><default>{inside}</default></mujoco>");
    let attributes = many(80_000, &|i| format!(" a{i}=\"1\""));
    let namespaces = many(60, &|i| format!(" xmlns:n{i}=\"1\""));
    let circle = "<link name=\"a\"/><link name=\"b\"/>\
        <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>\
        <joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>";
    let entities = "<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;\">";
    for text in [
        String::new(),
        robot(""),
        format!("<!DOCTYPE r [{entities}]><robot name=\"&b;\"/>"),
        format!("<!DOCTYPE m [{entities}]><mujoco>&b;</mujoco>"),
        robot(&many(5000, &|i| format!("<link name=\"l{i}\"/>"))),
        robot(&format!("<link name=\"a\"><inertial{attributes}/></link>")),
        robot(&format!("<link{namespaces}/>").repeat(1000)),
        robot(circle),
        model(&nested("<body>", "</body>", 100_000)),
        model(&nested("<body>", "</body>", 200)),
        model(&nested("<frame>", "</frame>", 100_000)),
        model(&"<body/>".repeat(100_000)),
        body("<joint/>".repeat(50_000)),
        body("<site name='s'/>".repeat(50_000)),
        default(&many(6000, &|i| format!("<default class='c{i}'/>"))),
        default(&nested("<default class='a'>", "</default>", 199)),
        model("<body pos='1e999999999 0 0'><joint/></body>"),
    ] {
        let begin = &text[..text.len().min(80)];
        for base in [None, Some("a".to_owned())] {
            let options = Options {
                base,
                ..Options::default()
            };
            let errors = import(&text, &options).expect_err("no robot");
            assert!(!errors.0.is_empty(), "{begin}");
        }
    }
}

/// Followers in a circle lead nothing, and are held with the others.
#[test]
fn circles_of_followers_are_held() {
    let joint = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><joint type='slide' name=";
    let circle = format!(
        "<mujoco><worldbody><body name='x'>{joint}'x'/><body name='p'>{joint}'a'/></body>\
         <body name='q'>{joint}'b'/></body></body></worldbody><equality>\
         <joint joint1='a' joint2='b'/><joint joint1='b' joint2='a'/></equality></mujoco>"
    );
    let robot = import(&circle, &to("x", &[("*", "0")])).unwrap().robot;
    assert_eq!(robot.joints.len(), 1);
}
