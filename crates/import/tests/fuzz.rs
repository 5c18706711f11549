//! Whatever the bytes are: an answer, never a panic, and the same one twice; and
//! a robot file that was made reads.

use crate::support::{NAMES, data, snapped, source, to};
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
                    assert!(!errors.render("arm", &source).is_empty());
                }
            }
        }
    }
    (made, refused)
}

#[test]
fn an_answer_for_every_text() {
    let cases = NAMES.map(|name| (source(name), snapped(name)));
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
    let source = |name: &str| data(&format!("mjcf/{name}.xml"));
    let cases = tips.map(|(name, tip)| (source(name), to(tip, &[("*", "0")])));
    let (made, refused) = answers(0x2545_f491_4f6c_dd1d, &cases);
    // Small files: little of them may go.
    assert!(made > 5 && refused > 30, "{made} made, {refused} refused");
}

#[test]
fn hostile_files_are_refused_at_once() {
    let entities = "<!DOCTYPE r [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;\">]><robot name=\"&b;\"/>";
    let links = (0..5000).map(|i| format!("<link name=\"l{i}\"/>"));
    let links: String = links.collect();
    let circle = "<link name=\"a\"/><link name=\"b\"/>\
        <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>\
        <joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>";
    let turns =
        "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"l0\"/></joint>";
    let deep: String = (0..900)
        .map(|i| {
            let joint = format!("<parent link=\"l{i}\"/><child link=\"l{}\"/>", i + 1);
            format!("<link name=\"l{i}\"/><joint name=\"k{i}\" type=\"fixed\">{joint}</joint>")
        })
        .collect();
    let deep = format!("<link name=\"a\"/>{turns}{deep}<link name=\"l900\"/>");
    let many = |name: &str, count: usize| -> String {
        let all = (0..count).map(|i| format!(" {name}{i}=\"1\""));
        all.collect()
    };
    let attributes = format!("<link name=\"a\"><inertial{}/></link>", many("a", 80_000));
    let namespaces = format!("<link{}/>", many("xmlns:n", 60)).repeat(1000);
    let robot = |inside: &str| format!("<robot name=\"r\">{inside}</robot>");
    for (text, base) in [
        (entities.to_owned(), None),
        (robot(&links), None),
        (robot(&attributes), None),
        (robot(&namespaces), None),
        (robot(&deep), None),
        (robot(circle), None),
        (robot(circle), Some("a")),
        (robot(""), None),
        (String::new(), None),
    ] {
        let options = Options {
            base: base.map(str::to_owned),
            ..Options::default()
        };
        let errors = import(&text, &options).expect_err("no robot");
        let begin = &text[..text.len().min(80)];
        assert!(!errors.0.is_empty(), "{base:?}: {begin}");
    }
}
