//! Numbers that hide where nobody looks: in real numbers they cancel, and floats lose what they are
//! added to. None of these is shown. A function that divides may be measured at the most.

use dalembert_checker::certify::{Demand, certify};
use serde_json::{Value, json};

use crate::certified::Certified;

/// Numbers that are large at few states, or at none that is drawn: steps of a claim, in which `u1` is
/// the first of these steps, and `{3/5}` a constant.
const NUMBERS: [&str; 9] = [
    // cos^2¹⁴ q1, 2²⁰⁰ at rest.
    "c1*c1 SQUARED13 uN*{1606938044258990275541962092341162602522202993782792835301376}",
    // The same around another angle than one of the special ones.
    "c1*{3/5} s1*{4/5} u1+u2 SQUARED14 uN*{1606938044258990275541962092341162602522202993782792835301376}",
    "c1*c2 SQUARED13 uN*{1606938044258990275541962092341162602522202993782792835301376}",
    // A comb of cos 2⁸ q1.
    "c1*c1 u1+u1 u2-{1} DOUBLED7 uN*uN SQUARED12 uN*{1e50}",
    "s2*{5/13} c2*{12/13} u1-u2 SQUARED4 DOUBLED6 uN*uN SQUARED12 uN*{1e60}",
    // A step of 1e20 everywhere.
    "c1*{1e20}",
    // Quotients.
    "{1}-c1 u1+{1e-30} c2/u2",
    "c1*c1 u1+{1e-40} s1*s1 u3/u2",
    "{1}/s1 uN*{1e9}",
];

/// Ways to add a number to a value `x` and to take it away again.
const WAYS: [&str; 6] = [
    "x+uN uN-uM",
    "x-uN uN+uM",
    "uN+uN x+uN uM+uM uL-uN",
    "x*uN uN/uM",
    "uN/uN x*uN",
    "uN-uN x+uN",
];

/// Numbers steps: `uN` is the last before, `uM` the last of the number, `uL` the one before `uN`.
fn spelled(number: &str, way: &str) -> Vec<String> {
    let mut steps: Vec<String> = Vec::new();
    let push = |word: &str, base: usize, steps: &mut Vec<String>| {
        let last = steps.len();
        let places = [("uN", last), ("uM", base), ("uL", last.saturating_sub(1))];
        let names = places.map(|(name, step)| (name, format!("u{step}")));
        let named = |word: String, (name, step): &(&str, String)| word.replace(name, step);
        steps.push(names.iter().fold(word.to_owned(), named));
    };
    for word in number.split(' ') {
        let (words, times) = match (word.strip_prefix("SQUARED"), word.strip_prefix("DOUBLED")) {
            (Some(times), _) => ("uN*uN", times),
            (_, Some(times)) => ("uN*uN uN+uN uN-{1}", times),
            _ => (word, "1"),
        };
        for _ in 0..times.parse().unwrap() {
            words.split(' ').for_each(|word| push(word, 0, &mut steps));
        }
    }
    let base = steps.len();
    for word in way.split(' ') {
        push(word, base, &mut steps);
    }
    steps
}

/// Returns the steps of a claim's first function, and its results.
pub fn steps_and_results(claim: &Value) -> [String; 2] {
    let function = &claim["functions"][0];
    ["steps", "returns"].map(|key| function[key].as_str().unwrap().to_owned())
}

/// Puts steps behind those of a file's function, and their last value in the place of a result,
/// which is `x` in them.
pub fn hidden(file: &Certified, added: &[impl AsRef<str>]) -> Certified {
    let mut claim = file.json();
    let mut constants: Vec<Value> = claim["constants"].as_array().unwrap().clone();
    let [steps, returns] = steps_and_results(&claim);
    let first = returns.split(' ').next().unwrap();
    let bare = first.trim_start_matches('-');
    let count = steps.split(' ').count();
    let (mut words, mut lines) = (steps, String::new());
    for (place, step) in added.iter().map(AsRef::as_ref).enumerate() {
        // The sign of an exponent is in brackets.
        let at = match step.starts_with('{') {
            true => step.find('}').unwrap() + 1,
            false => step.find(['+', '-', '*', '/']).unwrap(),
        };
        let operands = [&step[..at], &step[at + 1..]];
        let mut both = operands.map(|word| match word.strip_prefix('{') {
            Some(number) => {
                let number = number.trim_end_matches('}');
                constants.push(json!(number));
                let value = match number.split_once('/') {
                    Some((a, b)) => a.parse::<f64>().unwrap() / b.parse::<f64>().unwrap(),
                    None => number.parse().unwrap(),
                };
                (format!("#{}", constants.len() - 1), format!("{value:?}"))
            }
            None => {
                let word = match word.strip_prefix('u') {
                    Some(digits) => format!("t{}", count + digits.parse::<usize>().unwrap()),
                    None if word == "x" => bare.to_owned(),
                    None => word.to_owned(),
                };
                (word.clone(), word)
            }
        });
        let operation = &step[at..=at];
        let [(a, x), (b, y)] = both.each_mut().map(std::mem::take);
        words += &format!(" {a}{operation}{b}");
        lines += &format!("    let t{} = {x} {operation} {y};\n", count + place + 1);
    }
    let last = format!("t{}", count + added.len());
    let function = &mut claim["functions"][0];
    function["steps"] = json!(words);
    function["returns"] = json!(returns.replacen(bare, &last, 1));
    claim["constants"] = json!(constants);
    let end = file.text.rfind(&format!("    [{first},")).unwrap();
    let (before, results) = file.text.split_at(end);
    let results = results.replacen(bare, &last, 1);
    let other = file.with(&format!("{before}{lines}{results}"));
    other.with_claim(&claim)
}

#[test]
fn numbers_that_cancel_are_not_shown() {
    for (asked, divides) in [("gravity", false), ("forward_dynamics", true)] {
        let file = Certified::planar2r(&format!("{asked}; scalar: f64"));
        assert_eq!(file.report().unwrap().passes(true), !divides, "{asked}");
        assert!(file.report().unwrap().passes(false), "{asked}");
        // With nothing hidden it is shown; but what divides has no steps that come back.
        let same = hidden(&file, &["x*{3/4}", "u1*{4/3}"]);
        assert_eq!(same.refusal().is_some(), divides, "{asked}");
        for number in NUMBERS {
            for way in WAYS {
                let other = hidden(&file, &spelled(number, way));
                let what = format!("{asked}: {number}, then {way}: {}", other.text);
                assert!(other.refusal().is_some(), "{what}");
            }
        }
    }
}

/// Friction bends where speeds are small: in f32 the bound is above 1/64.
#[test]
fn a_bound_that_says_little_needs_the_users_word() {
    let asked = "inverse_dynamics_second_derivatives; scalar: f32";
    let file = &Certified::all("coulomb", "", asked)[0];
    file.is_refused("of its largest value, over 1.6e-2");
    let passes = |worst: f64| {
        let demand = Demand {
            worst: Some(worst),
            ..Demand::default()
        };
        let report = certify(&file.text, &file.claim, &file.robot, &demand).unwrap();
        report.passes(true)
    };
    assert!(passes(0.1) && !passes(0.001));
}

/// Puts a difference of two steps into lanes that both add the same number, which cancels.
fn in_lanes(file: &Certified) -> Certified {
    let step = |word: &str| word.strip_prefix('t')?.parse::<usize>().ok();
    let mut lines = file.text.lines();
    let difference = lines.find_map(|line| {
        let (name, value) = line.trim().strip_prefix("let ")?.split_once(" = ")?;
        let (left, right) = value.strip_suffix(';')?.split_once(" - ")?;
        Some((line, step(name)?, step(left)?, step(right)?))
    });
    let (line, name, left, right) = difference.unwrap();
    let lanes = format!(
        "    let u1 = [\n        [t{left}, t{right}],\n    ];\n    let mut w1 = [[0.0; 2]; 1];\n    for l in 0..2 {{\n        \
         let t900 = c1 * 8192.5;\n        let t901 = u1[0][l] + t900;\n        w1[0][l] = t901;\n    }}\n    \
         let t{name} = w1[0][0] - w1[0][1];"
    );
    let mut claim = file.json();
    let constants = claim["constants"].as_array_mut().unwrap();
    let number = constants.len();
    constants.push(json!("16385/2"));
    // Four steps more stand before the difference.
    let moved = |word: &str| {
        let pieces = word.split_inclusive(['+', '-', '*', '/']);
        let moved = pieces.map(|piece| {
            let end = piece.find(['+', '-', '*', '/']).unwrap_or(piece.len());
            match step(&piece[..end]) {
                Some(operand) if operand >= name => format!("t{}{}", operand + 4, &piece[end..]),
                _ => piece.to_owned(),
            }
        });
        moved.collect::<String>()
    };
    let [steps, returns] = steps_and_results(&claim);
    let mut steps: Vec<String> = steps.split(' ').map(moved).collect();
    let lane = |place: usize, operand: usize| {
        let first = name + 2 * place;
        [format!("c1*#{number}"), format!("t{operand}+t{first}")]
    };
    steps[name - 1] = format!("t{}-t{}", name + 1, name + 3);
    let added = [lane(0, left), lane(1, right)].concat();
    steps.splice(name - 1..name - 1, added);
    let returns: Vec<String> = returns.split(' ').map(moved).collect();
    let function = &mut claim["functions"][0];
    function["steps"] = json!(steps.join(" "));
    function["returns"] = json!(returns.join(" "));
    let other = file.with(&file.text.replacen(line, &lanes, 1));
    other.with_claim(&claim)
}

/// Lanes may compute the same value, but not one that cancels between them.
#[test]
fn numbers_that_cancel_between_lanes_are_not_shown() {
    let file = Certified::planar2r("forward_dynamics; scalar: f64");
    in_lanes(&file).is_refused("with its like in other lanes");
}
