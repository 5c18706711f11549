//! Variants that a tolerance admitted, their claims and plans, changed at random: whatever is
//! changed, `dalembert-checker` refuses them, or what they say is true all the same. What is true is
//! decided here by other means than the checker's: the printed text is read by a reader of this
//! test's own, and run against the runtime.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::LazyLock;

use dalembert_checker::certify::ResultBound;
use dalembert_codegen::workspace::{
    JointState, Library, Node, Random, Runtime, Setup, Variant,
    testing::{InputBox, Interval},
};
use dalembert_codegen::{Function, Plan, generate};
use dalembert_model::number::{Exact, Rational};
use dalembert_model::read::parse;
use dalembert_model::scalar::Scalar;
use serde_json::Value;

use crate::certified::Certified;
use crate::support::{self, Case, daily_and_campaign, largest, read};

const DAILY: Range<usize> = 0..25;
const OTHERS: Range<usize> = 25..100;

const ROBOT: &str = r#"
name = "r2"
convention = "standard"
gravity = [0, -9.81, 0]

[[joint]]
a = 1
kind = "revolute"
mass = 1
com = [-0.5, 0, 0]
inertia = [0, 0.08, 0.08, 0, 0, 0]
limits = { position = ["-pi", 2], velocity = 2, acceleration = 10, torque = 50 }

[[joint]]
a = 0.7
alpha = "pi/5"
kind = "revolute"
mass = 0.8
com = [-0.3, 0.01, 0]
inertia = [0.01, 0.07, 0.06, 0, 0, 0]
limits = { position = [-1.5, 1.5], velocity = 3, acceleration = 20, torque = 20 }

[[joint]]
d = 0.1
kind = "revolute"
mass = 0.2
com = [0, 0.02, 0.1]
inertia = [0.001, 0.001, 0.001, 0, 0, 0]
limits = { position = [-1, 1], velocity = 3, acceleration = 20, torque = 5 }

[scene.pick]
outputs = ["inverse_dynamics"]
lock = { 3 = "pi/7" }
scalar = "f64"
tolerance = { value = 5e-2, relative_to = "actuator" }
"#;

static HONEST: LazyLock<[Variant; 3]> = LazyLock::new(|| {
    let [libm, polynomial] = ["libm", "polynomial"].map(|sincos| {
        let case = Case::read(ROBOT, &format!("scene: pick; sincos: {sincos}"));
        support::variants(&case.generated())[0].clone()
    });
    let together = Variant {
        library: Library::Together,
        ..libm.clone()
    };
    [libm, polynomial, together.printed()]
});

fn variants() -> Vec<Certified> {
    let file = |variant| Certified::variant(ROBOT, variant);
    HONEST.iter().map(file).collect()
}

/// Names are looked up in a map, blocks are entered as they come: it knows no program.
fn execute(text: &str, state: &JointState) -> Option<Vec<f64>> {
    let mut names: HashMap<String, f64> = HashMap::new();
    for (name, values) in [("q", &state.q), ("qd", &state.qd), ("qdd", &state.qdd)] {
        let values = values.iter().enumerate();
        names.extend(values.map(|(index, value)| (format!("{name}[{index}]"), *value)));
    }
    let value = |word: &str, names: &HashMap<String, f64>| -> Option<f64> {
        let bare = word.strip_prefix('-').unwrap_or(word);
        let value = names.get(bare).copied().or_else(|| bare.parse().ok())?;
        Some(if bare == word { value } else { -value })
    };
    let mut pending: Option<Vec<String>> = None;
    for line in text.lines().map(str::trim) {
        if line.starts_with("#[") || line.starts_with("pub fn") || line == "};" || line == "}" {
            continue;
        }
        let Some(rest) = line.strip_prefix("let ") else {
            let words = line.trim_matches(['(', ')', '[', ']']).split(", ");
            let results: Option<Vec<f64>> = words.map(|word| value(word, &names)).collect();
            let values = results?;
            match pending.take() {
                Some(targets) => names.extend(targets.into_iter().zip(values)),
                None => return Some(values),
            }
            continue;
        };
        let (left, right) = rest.split_once(" = ")?;
        let words = left.trim_matches(['(', ')']).split(", ");
        let targets = words.map(|name| name.trim_matches(['[', ']']).to_owned());
        if right == "{" {
            pending = Some(targets.collect());
            continue;
        }
        let right = right.strip_suffix(';')?;
        let values = if let Some(call) = right.strip_prefix("libm::") {
            let (function, angle) = call.strip_suffix(')')?.split_once('(')?;
            let (sin, cos) = libm::sincos(value(angle, &names)?);
            match function {
                "sin" => vec![sin],
                "cos" => vec![cos],
                "sincos" => vec![sin, cos],
                _ => return None,
            }
        } else if let Some(call) = right.strip_prefix("dalembert_sines::sincos(&[") {
            let (mut sines, mut cosines) = (Vec::new(), Vec::new());
            for angle in call.strip_suffix("])")?.split(", ") {
                let (sin, cos) = libm::sincos(value(angle, &names)?);
                sines.push(sin);
                cosines.push(cos);
            }
            [sines, cosines].concat()
        } else {
            let words: Vec<&str> = right.split(' ').collect();
            let mut result = value(words[0], &names)?;
            for pair in words[1..].chunks(2) {
                let x = value(pair.get(1)?, &names)?;
                result = match pair[0] {
                    "+" => result + x,
                    "-" => result - x,
                    "*" => result * x,
                    _ => return None,
                };
            }
            vec![result]
        };
        names.extend(targets.zip(values));
    }
    None
}

fn shown(file: &Certified) -> Option<Vec<ResultBound>> {
    let [line]: [_; 1] = file.report().ok()?.lines.try_into().ok()?;
    Some(line.result.ok()?.results)
}

fn is_true(file: &Certified, results: &[ResultBound]) -> bool {
    let robot = read(&file.robot);
    let setup = Setup::in_scene(&robot.robot, Some(&robot.scenes[0])).unwrap();
    let limits = InputBox::within(&setup, Function::InverseDynamics).unwrap();
    let ranges = [&limits.position, &limits.velocity, &limits.acceleration];
    let runtime = Runtime::in_scene(setup);
    let mut random = Random::new(7);
    (0..400).all(|index| {
        let [q, qd, qdd] = ranges.map(|ranges| {
            let one = |range: &Interval| {
                let [low, high] = [range.low(), range.high()];
                let at = match index % 4 {
                    0 => random.unit(),
                    _ => random.below(2) as f64,
                };
                (low + (high - low) * at).clamp(low, high)
            };
            ranges.iter().map(one).collect::<Vec<f64>>()
        });
        let state = JointState {
            q,
            qd,
            qdd,
            ..JointState::default()
        };
        let Some(torques) = execute(&file.text, &state) else {
            return false;
        };
        let truth = runtime.run(Function::InverseDynamics, &state);
        let size = largest(&truth).max(1.0);
        torques.len() == truth.len()
            && (0..truth.len()).all(|i| {
                let allowed = results[i].bound.total();
                (torques[i] - truth[i]).abs() <= allowed * (1.0 + 1e-9) + 1e-12 * size
            })
    })
}

/// Asserts that a variant is refused, or true; returns whether it is refused.
fn is_refused(file: &Certified) -> bool {
    let Some(results) = shown(file) else {
        return true;
    };
    let what = format!("accepted, and false:\n{}\n{}", file.text, file.claim);
    assert!(is_true(file, &results), "{what}");
    false
}

fn one_of<'a, T>(choices: &'a [T], random: &mut Random) -> &'a T {
    &choices[random.below(choices.len())]
}

fn programs(mutations: &Range<usize>, change: impl Fn(&mut [Node], &mut Random)) -> usize {
    let mut random = Random::new(0xbad);
    let refused = (0..mutations.end).filter(|index| {
        let mut other = HONEST[index % HONEST.len()].clone();
        change(&mut other.emitted.dag.nodes, &mut random);
        mutations.contains(index) && is_refused(&Certified::variant(ROBOT, &other.printed()))
    });
    refused.count()
}

fn claims(
    mutations: &Range<usize>,
    pick: impl Fn(&str, &Value) -> bool,
    with: impl Fn(&Value, &mut Random) -> Value,
) -> usize {
    let honest = variants();
    let mut random = Random::new(0xbad);
    let refused = (0..mutations.end).filter(|index| {
        let file = &honest[index % honest.len()];
        let mut json = file.json();
        let place = one_of(&places(&json, "", &pick), &mut random).clone();
        let value = json.pointer_mut(&place).unwrap();
        *value = with(value, &mut random);
        mutations.contains(index) && is_refused(&file.with_claim(&json))
    });
    refused.count()
}

fn places(value: &Value, path: &str, pick: &impl Fn(&str, &Value) -> bool) -> Vec<String> {
    let mut paths = Vec::from_iter(pick(path, value).then(|| path.to_owned()));
    for (index, part) in value.as_array().into_iter().flatten().enumerate() {
        paths.extend(places(part, &format!("{path}/{index}"), pick));
    }
    for (key, part) in value.as_object().into_iter().flatten() {
        paths.extend(places(part, &format!("{path}/{key}"), pick));
    }
    paths
}

#[test]
fn honest_variants_are_shown_and_the_judge_can_tell() {
    for file in variants() {
        let results = shown(&file).unwrap();
        assert!(results.iter().all(ResultBound::is_shown), "{results:?}");
        assert!(is_true(&file, &results));
        let mut lie = results.clone();
        for result in &mut lie {
            result.bound.real *= 1e-3;
            result.bound.rounding *= 1e-3;
        }
        assert!(!is_true(&file, &lie));
        let mut lie = file.with(&file.text.replacen(" + ", " - ", 1));
        assert!(!is_true(&lie, &results));
        // Whoever names no scene is held to no tolerance.
        lie.scene = None;
        assert!(!lie.report().unwrap().passes(false));
    }
}

daily_and_campaign! {
    operations: (&DAILY), (&OTHERS);
    constants: (&DAILY), (&OTHERS);
    words: (&DAILY), (&OTHERS);
    scenes: (&DAILY), (&OTHERS);
    plans: (&DAILY), (&OTHERS);
}

/// Operations and their operands: one in ten is the same again, or within the tolerance.
fn operations(mutations: &Range<usize>) {
    let refused = programs(mutations, |nodes, random| {
        let numbered = nodes.iter().enumerate();
        let operations = numbered.filter_map(|(place, node)| match node {
            Node::Apply(operation, _) => Some((place, *operation)),
            _ => None,
        });
        let applied: Vec<_> = operations.collect();
        let (place, _) = *one_of(&applied, random);
        let Node::Apply(operation, operands) = &mut nodes[place] else {
            return;
        };
        match random.below(2) {
            0 => *operation = one_of(&applied, random).1,
            _ => operands[random.below(2)] = random.below(place) as u32,
        }
    });
    assert!(refused >= mutations.len() * 6 / 10, "{refused}");
}

/// Constants, changed by one part in so many; half of the changes matter less than the tolerance.
fn constants(mutations: &Range<usize>) {
    const PARTS: [i64; 6] = [1_000_000_000, 1000, 100, 10, -2, 1];
    let refused = programs(mutations, |nodes, random| {
        let parts = *one_of(&PARTS, random);
        let factor = Exact::from(Rational::new((parts + 1).into(), parts.into()));
        let numbers = nodes.iter_mut().filter_map(|node| match node {
            Node::Constant(constant) => Some(constant),
            _ => None,
        });
        let mut constants: Vec<&mut Exact> = numbers.collect();
        let place = random.below(constants.len());
        *constants[place] = constants[place].mul(&factor);
    });
    let some = mutations.len() / 5..mutations.len() * 4 / 5;
    assert!(some.contains(&refused), "{refused}");
}

fn words(mutations: &Range<usize>) {
    const ABOUT: [&str; 9] = [
        "", "gravity", "coriolis", "f16", "range", "1", "r2", "q", "trust me",
    ];
    let is_one = |path: &str, keys: &[&str]| keys.iter().any(|key| path.ends_with(key));
    let refused = claims(
        mutations,
        |path, _| is_one(path, &["/function", "/relative_to", "/scene"]),
        |_, random| (*one_of(&ABOUT, random)).into(),
    );
    assert_eq!(refused, mutations.len());
    let words = "t1 t2 #0 #3 s1 t1+t2 q[0]*#1 t3-t3 -t4 t9*t9";
    let refused = claims(
        mutations,
        |path, _| is_one(path, &["/steps", "/returns"]),
        |text, random| other_word(text.as_str().unwrap(), random, words).into(),
    );
    assert!(refused >= mutations.len() * 8 / 10, "{refused}");
}

fn scenes(mutations: &Range<usize>) {
    let honest = variants();
    let mut random = Random::new(0x5ce2e);
    let is_digit = |at: &usize| ROBOT.as_bytes()[*at].is_ascii_digit();
    let digits: Vec<usize> = (0..ROBOT.len()).filter(is_digit).collect();
    let (mut tried, mut refused) = (0, 0);
    while tried < mutations.end {
        let at = *one_of(&digits, &mut random);
        let digit = random.below(10).to_string();
        let mut file = honest[tried % 2].clone();
        file.robot.replace_range(at..=at, &digit);
        let robot = parse(&file.robot).ok();
        let Some(robot) = robot.filter(|_| file.robot != ROBOT) else {
            continue;
        };
        if Setup::in_scene(&robot.robot, Some(&robot.scenes[0])).is_ok() {
            refused += usize::from(mutations.contains(&tried) && is_refused(&file));
            tried += 1;
        }
    }
    // Limits of joints may be narrower, and torques higher.
    assert!(refused >= mutations.len() / 3, "{refused}");
}

fn other_word(text: &str, random: &mut Random, words: &str) -> String {
    let is_word = |c: char| !c.is_whitespace() && !"\"{}:,".contains(c);
    let parts = text.split(|c| !is_word(c));
    let tokens: Vec<&str> = parts.filter(|token| !token.is_empty()).collect();
    let old = *one_of(&tokens, random);
    let place = old.as_ptr() as usize - text.as_ptr() as usize;
    let words: Vec<&str> = words.split(' ').collect();
    let new = one_of(&words, random);
    format!("{}{new}{}", &text[..place], &text[place + old.len()..])
}

fn plans(mutations: &Range<usize>) {
    let words = "t1+t2 t2*#1 t7-t1 qd[1]*qd[1] s1*#0 c2-#2 s3*c2 #0 1/2 2 -t1 t2 t9 -7 [] 0 f32 \
        gravity q load planned returns";
    let mut case = Case::read(ROBOT, "scene: pick; sincos: libm");
    let mut plan = case.plan(&case.generated());
    for entry in &mut plan.entries {
        entry.passes.clear();
    }
    let text = plan.write();
    let mut random = Random::new(0x91a2);
    let mut refused = 0;
    for index in 0..mutations.end {
        let changed = other_word(&text, &mut random, words);
        if !mutations.contains(&index) {
            continue;
        }
        let code = Plan::parse(&changed).ok().and_then(|plan| {
            case.request.plan = Some(plan);
            generate(case.robot(), &case.request).ok()
        });
        let Some(generated) = code else {
            refused += 1;
            continue;
        };
        let file = Certified::variant(ROBOT, &support::variants(&generated)[0]);
        assert!(!is_refused(&file), "{changed}");
    }
    assert!(refused >= mutations.len() / 3, "{refused}");
}
