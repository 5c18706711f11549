//! Numbers that hide where nobody looks: in real numbers they cancel, and floats lose what they are
//! added to. None of these is shown. What divides may be measured at the most.

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

/// Numbers steps: `uN` is the last one before, `uM` the last of the number, `uL` the
/// one before `uN`.
fn spelled(number: &str, way: &str) -> Vec<String> {
    let mut steps: Vec<String> = Vec::new();
    let push = |word: &str, base: usize, steps: &mut Vec<String>| {
        let last = steps.len();
        let named = [("uN", last), ("uM", base), ("uL", last.saturating_sub(1))]
            .map(|(name, step)| (name, format!("u{step}")));
        let word = named.iter().fold(word.to_owned(), |word, (name, step)| {
            word.replace(name, step)
        });
        steps.push(word);
    };
    for word in number.split(' ') {
        if let Some(times) = word.strip_prefix("SQUARED") {
            for _ in 0..times.parse().unwrap() {
                push("uN*uN", 0, &mut steps);
            }
        } else if let Some(times) = word.strip_prefix("DOUBLED") {
            for _ in 0..times.parse().unwrap() {
                for word in ["uN*uN", "uN+uN", "uN-{1}"] {
                    push(word, 0, &mut steps);
                }
            }
        } else {
            push(word, 0, &mut steps);
        }
    }
    let base = steps.len();
    for word in way.split(' ') {
        push(word, base, &mut steps);
    }
    steps
}

/// Puts steps behind those of a file's function, and their last value in the place of a result.
fn hidden(file: &Certified, added: &[String]) -> Certified {
    let mut claim: Value = serde_json::from_str(&file.claim).unwrap();
    let mut constants: Vec<Value> = claim["constants"].as_array().unwrap().clone();
    let function = &claim["functions"][0];
    let [steps, returns] =
        ["steps", "returns"].map(|key| function[key].as_str().unwrap().to_owned());
    let first = returns.split(' ').next().unwrap().to_owned();
    let bare = first.trim_start_matches('-').to_owned();
    let count = steps.split(' ').count();
    let (mut words, mut lines) = (steps, String::new());
    for (place, step) in added.iter().enumerate() {
        let at = step.find(['+', '-', '*', '/']).unwrap();
        // The sign of an exponent is in brackets.
        let at = match step.starts_with('{') {
            true => step.find('}').unwrap() + 1,
            false => at,
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
                let step = word
                    .strip_prefix('u')
                    .map(|digits| digits.parse::<usize>().unwrap());
                let word = match (step, word) {
                    (Some(step), _) => format!("t{}", count + step),
                    (None, "x") => bare.clone(),
                    (None, word) => word.to_owned(),
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
    function["returns"] = json!(returns.replacen(&bare, &last, 1));
    claim["constants"] = json!(constants);
    let end = file.text.rfind(&format!("    [{first},")).unwrap();
    let (before, results) = file.text.split_at(end);
    let results = results.replacen(&bare, &last, 1);
    let mut other = file.with(&format!("{before}{lines}{results}"));
    other.claim = claim.to_string();
    other
}

#[test]
fn numbers_that_cancel_are_not_shown() {
    for (asked, divides) in [("gravity", false), ("forward_dynamics", true)] {
        let file = Certified::planar2r(&format!("{asked}; scalar: f64"));
        assert_eq!(file.report().unwrap().passes(true), !divides, "{asked}");
        assert!(file.report().unwrap().passes(false), "{asked}");
        // With nothing hidden it is shown; but what divides has no steps that come back.
        let same = hidden(&file, &["x*{3/4}".into(), "u1*{4/3}".into()]);
        assert_eq!(same.refusal().is_some(), divides, "{asked}");
        for number in NUMBERS {
            for way in WAYS {
                let other = hidden(&file, &spelled(number, way));
                let why = other.refusal();
                let what = format!("{asked}: {number}, then {way}: {}", other.text);
                assert!(why.is_some(), "{what}");
            }
        }
    }
}

/// Friction bends where speeds are small, and intervals see no more than that: in f32 the bound is
/// above 1/64, and the user may accept it.
#[test]
fn a_bound_that_says_little_needs_the_users_word() {
    let asked = "inverse_dynamics_second_derivatives; scalar: f32";
    let file = &Certified::all("coulomb", "", asked)[0];
    let why = file.refusal().unwrap();
    assert!(why.contains("of its largest value, over 1.6e-2"), "{why}");
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
    let mut claim: Value = serde_json::from_str(&file.claim).unwrap();
    let mut constants: Vec<Value> = claim["constants"].as_array().unwrap().clone();
    constants.push(json!("16385/2"));
    let number = constants.len() - 1;
    claim["constants"] = json!(constants);
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
    let function = &mut claim["functions"][0];
    let [steps, returns] =
        ["steps", "returns"].map(|key| function[key].as_str().unwrap().to_owned());
    let mut steps: Vec<String> = steps.split(' ').map(moved).collect();
    let lane = |place: usize, operand: usize| {
        let first = name + 2 * place;
        [format!("c1*#{number}"), format!("t{operand}+t{first}")]
    };
    steps[name - 1] = format!("t{}-t{}", name + 1, name + 3);
    let added = [lane(0, left), lane(1, right)].concat();
    steps.splice(name - 1..name - 1, added);
    function["steps"] = json!(steps.join(" "));
    let returns: Vec<String> = returns.split(' ').map(moved).collect();
    function["returns"] = json!(returns.join(" "));
    let mut other = file.with(&file.text.replacen(line, &lanes, 1));
    other.claim = claim.to_string();
    other
}

/// Lanes may compute the same value, but not one that cancels between them.
#[test]
fn numbers_that_cancel_between_lanes_are_not_shown() {
    let file = Certified::planar2r("forward_dynamics; scalar: f64");
    let other = in_lanes(&file);
    let why = other.refusal().unwrap();
    assert!(
        why.contains("with its like in other lanes"),
        "{why}: {}",
        other.text
    );
}
