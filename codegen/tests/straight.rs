//! Functions have no branch and no loop, and with polynomials for sines they call nothing.

use dalembert_codegen::{Function, Language, Request, ScalarType, SinCos, generate};

use crate::support;

/// What begins a branch or a loop in some language.
const BRANCHES: [&str; 10] = [
    "if", "else", "match", "switch", "while", "for", "loop", "do", "goto", "break",
];
/// A product of CUDA is a macro.
const MACRO: &str = "DALEMBERT_MUL";

/// Returns the functions of a text: the line that each begins with, and those behind it.
fn functions(text: &str) -> Vec<(&str, Vec<&str>)> {
    let lines: Vec<&str> = text.lines().collect();
    let heads = lines.iter().enumerate();
    let heads =
        heads.filter(|(_, line)| line.starts_with("pub fn ") || line.starts_with("static "));
    let functions = heads.map(|(index, head)| {
        let body = lines[index + 1..].iter().copied();
        (*head, body.take_while(|line| *line != "}").collect())
    });
    functions.collect()
}

/// Returns the words behind which a bracket opens.
fn calls(line: &str) -> impl Iterator<Item = &str> {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let before = line.match_indices('(').map(|(place, _)| &line[..place]);
    let words = before.map(move |text| text.rsplit(|c: char| !is_letter(c)).next().unwrap_or(""));
    words.filter(|word| !word.is_empty())
}

/// Of every output in every language. What gives sines by the crate's algorithm in C is a loop, and
/// says so by its name.
#[test]
fn functions_are_straight_lines() {
    let robot = support::robot("planar2r");
    let polynomial = SinCos::Polynomial { error: None };
    for (language, sincos) in [
        (Language::Rust, SinCos::Libm),
        (Language::Rust, polynomial),
        (Language::C, SinCos::Together),
        (Language::C, polynomial),
        (Language::Cuda, polynomial),
    ] {
        let request = Request {
            functions: Function::ALL.to_vec(),
            language,
            sincos,
            scalars: vec![ScalarType::F64],
            ..Request::default()
        };
        let text = generate(&robot, &request).unwrap().text();
        let all = functions(&text);
        let is_output =
            |(head, _): &&(&str, _)| !head.contains("_sines_") && !head.contains("in_box");
        let outputs: Vec<_> = all.iter().filter(is_output).collect();
        assert!(outputs.len() >= Function::ALL.len(), "{}", outputs.len());
        for (head, body) in outputs {
            for line in body {
                let mut words = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
                let branches = words.any(|word| BRANCHES.contains(&word));
                assert!(!branches && !line.contains(['?', '|']), "{head}: {line}");
                let is_called = calls(line).any(|word| word != MACRO);
                assert!(!is_called || sincos != polynomial, "{head}: {line}");
            }
        }
        let loops = all.iter().filter(|(head, _)| head.contains("_sines_"));
        assert_eq!(loops.count() > 0, sincos == SinCos::Together);
    }
    assert_eq!(calls("let t1 = f(x) + (y);").collect::<Vec<_>>(), ["f"]);
}
