//! Variants that a tolerance admitted, their claims and plans, changed at random: whatever is changed,
//! `dalembert-checker` refuses them, or what they say is true all the same. What is true is decided
//! here by other means than the checker's: the printed text is read by a reader of
//! this test's own, and run against the runtime.

use std::collections::HashMap;

use dalembert_checker::certify::{Bounded, certify};
use dalembert_checker::claim::{Claim, Tolerated};
use dalembert_codegen::workspace::{
    Certificate, Edited, Entry, JointState, Library, Node, Random, Runtime, Setup, claim_of,
    input_hash,
};
use dalembert_codegen::{Function, Generated, Plan, Request, ScalarType, SinCos, generate};
use dalembert_model::number::{Exact, Rational};
use dalembert_model::read::{self, Reading};
use dalembert_model::scalar::Scalar;
use serde_json::Value;

/// Of each kind.
const MUTATIONS: usize = 100;

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

fn reading(source: &str) -> Option<Reading> {
    read::parse(source, &read::Options::default()).ok()
}

fn request(reading: &Reading, sincos: SinCos) -> Request {
    let scene = reading.scenes[0].clone();
    Request {
        sincos,
        ..Request::default().in_scene(&scene)
    }
}

fn generated(sincos: SinCos) -> (Reading, Generated) {
    let reading = reading(ROBOT).unwrap();
    let generated = generate(&reading.robot, &request(&reading, sincos)).unwrap();
    (reading, generated)
}

fn certificate(generated: &Generated) -> &Certificate {
    let admitted = generated.functions[0].admitted.as_ref().unwrap();
    &admitted.certificates[0]
}

/// Variants to change: libm's sines with edits, those of all angles
/// together, and polynomials.
fn honest() -> Vec<Certificate> {
    let all = [SinCos::Libm, SinCos::Polynomial { error: None }];
    let all = all.map(|sincos| certificate(&generated(sincos).1).clone());
    let together = all[0].calling(Library::Together);
    all.into_iter().chain([together]).collect()
}

/// A variant's text and its claim, as they stand in two files.
struct Pair {
    text: String,
    claim: String,
}

impl Pair {
    fn of(own: &Certificate) -> Pair {
        let reading = reading(ROBOT).unwrap();
        let setup = Setup::new(&reading.robot, &reading.scenes[0]).unwrap();
        Pair {
            text: own.text.clone(),
            claim: claim_of(&reading.robot, ROBOT, &setup, own).write(),
        }
    }

    /// Returns what is shown of the results against a robot file, if that is the tolerance.
    fn shown(&self, robot: &str) -> Option<Vec<Bounded>> {
        let report = certify(&self.text, &self.claim, robot, Some("pick"), None).ok()?;
        let [line] = &report.lines[..] else {
            return None;
        };
        Some(line.result.as_ref().ok()?.results.clone())
    }

    /// Returns true if what was shown is true at corners and random states, as far as doubles can
    /// tell: E, or the scene's tolerance.
    fn is_true(&self, results: &[Bounded], setup: &Setup) -> bool {
        let claim = Claim::read(&self.claim).unwrap();
        let own = claim.functions[0].tolerated.clone().unwrap();
        is_true(&self.text, &own, results, setup)
    }
}

/// Returns a float's value by an operation in the scalar.
fn round(x: f64, scalar: ScalarType) -> f64 {
    match scalar {
        ScalarType::F64 => x,
        ScalarType::F32 => f64::from(x as f32),
    }
}

/// Runs a printed function line by line: names are looked up in a map, blocks
/// are entered as they come. It knows no program.
fn execute(text: &str, state: &JointState, scalar: ScalarType) -> Option<Vec<f64>> {
    let mut names: HashMap<String, f64> = HashMap::new();
    for (name, values) in [("q", &state.q), ("qd", &state.qd), ("qdd", &state.qdd)] {
        for (index, value) in values.iter().enumerate() {
            names.insert(format!("{name}[{index}]"), round(*value, scalar));
        }
    }
    let value = |word: &str, names: &HashMap<String, f64>| -> Option<f64> {
        let (sign, word) = match word.strip_prefix('-') {
            Some(rest) => (-1.0, rest),
            None => (1.0, word),
        };
        let value = names.get(word).copied();
        let value = value.or_else(|| word.parse().ok().map(|x| round(x, scalar)));
        Some(sign * value?)
    };
    let mut pending: Option<Vec<String>> = None;
    for line in text.lines().map(str::trim) {
        if line.starts_with("#[") || line.starts_with("pub fn") || line == "};" || line == "}" {
            continue;
        }
        let Some(rest) = line.strip_prefix("let ") else {
            let words = line.trim_matches(['(', ')', '[', ']']).split(", ");
            let values: Option<Vec<f64>> = words.map(|word| value(word, &names)).collect();
            match pending.take() {
                Some(targets) => names.extend(targets.into_iter().zip(values?)),
                None => return values,
            }
            continue;
        };
        let (left, right) = rest.split_once(" = ")?;
        let targets = left.trim_matches(['(', ')']).split(", ").map(str::to_owned);
        let targets: Vec<String> = targets.collect();
        if right == "{" {
            pending = Some(targets);
            continue;
        }
        let right = right.strip_suffix(';')?;
        if let Some(call) = right.strip_prefix("libm::") {
            let (function, angle) = call.strip_suffix(')')?.split_once('(')?;
            let x = value(angle, &names)?;
            let pair = match scalar {
                ScalarType::F64 => libm::sincos(x),
                ScalarType::F32 => {
                    let (sin, cos) = libm::sincosf(x as f32);
                    (f64::from(sin), f64::from(cos))
                }
            };
            let results = match function.trim_end_matches('f') {
                "sin" => vec![pair.0],
                "cos" => vec![pair.1],
                "sincos" => vec![pair.0, pair.1],
                _ => return None,
            };
            names.extend(targets.into_iter().zip(results));
            continue;
        }
        if let Some(call) = right.strip_prefix("dalembert_sines::sincos") {
            let angles = call.trim_start_matches('f').strip_prefix("(&[")?;
            let mut pairs = Vec::new();
            for angle in angles.strip_suffix("])")?.split(", ") {
                let x = value(angle, &names)?;
                pairs.push(libm::sincos(x));
            }
            let results = pairs.iter().map(|p| p.0).chain(pairs.iter().map(|p| p.1));
            let results = results.map(|x| round(x, scalar));
            let targets = targets.iter().map(|name| name.trim_matches(['[', ']']));
            names.extend(targets.map(str::to_owned).zip(results));
            continue;
        }
        let words: Vec<&str> = right.split(' ').collect();
        let mut sum = value(words[0], &names)?;
        for pair in words[1..].chunks(2) {
            let x = value(pair.get(1)?, &names)?;
            sum = round(
                match pair[0] {
                    "+" => sum + x,
                    "-" => sum - x,
                    "*" => sum * x,
                    _ => return None,
                },
                scalar,
            );
        }
        names.insert(targets[0].clone(), sum);
    }
    None
}

fn is_true(text: &str, own: &Tolerated, results: &[Bounded], setup: &Setup) -> bool {
    let runtime = Runtime::in_scene(setup.clone());
    let scalar = if own.f32.is_empty() {
        ScalarType::F64
    } else {
        ScalarType::F32
    };
    let mut random = Random::new(7);
    (0..400).all(|index| {
        let mut draw = |ranges: &[[f64; 2]]| {
            let one = |&[low, high]: &[f64; 2]| {
                let at = match index % 4 {
                    0 => random.unit(),
                    _ => random.below(2) as f64,
                };
                (low + (high - low) * at).clamp(low, high)
            };
            ranges.iter().map(one).collect::<Vec<f64>>()
        };
        let [q, qd, qdd] = own.ranges.each_ref().map(|ranges| draw(ranges));
        let state = JointState {
            q,
            qd,
            qdd,
            ..JointState::default()
        };
        let state = state.in_scalar(scalar);
        let Some(found) = execute(text, &state, scalar) else {
            return false;
        };
        let truth = runtime.run(Function::InverseDynamics, &state);
        found.len() == truth.len()
            && (0..truth.len()).all(|i| {
                let own = &results[i];
                let allowed = if own.holds() {
                    own.claimed
                } else {
                    own.tolerated
                };
                let size = truth.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
                (found[i] - truth[i]).abs() <= allowed * (1.0 + 1e-9) + 1e-12 * size
            })
    })
}

/// Asserts that each is refused or true; returns how many were refused. The scene is the robot
/// file's first.
#[track_caller]
fn judge(pairs: impl IntoIterator<Item = Pair>, source: &str) -> usize {
    let robot = reading(source).unwrap();
    let setup = Setup::new(&robot.robot, &robot.scenes[0]).unwrap();
    let refused = pairs.into_iter().filter(|pair| match pair.shown(source) {
        None => true,
        Some(results) => {
            let is_true = pair.is_true(&results, &setup);
            assert!(
                is_true,
                "accepted, and false:\n{}\n{}",
                pair.text, pair.claim
            );
            false
        }
    });
    refused.count()
}

/// Changes programs of honest variants at random, text and claim alike; returns how many were
/// refused.
fn programs(change: impl Fn(&mut [Node], &mut Random)) -> usize {
    let honest = honest();
    let mut random = Random::new(0xbad);
    let pairs = (0..MUTATIONS).map(|index| {
        let honest = &honest[index % honest.len()];
        let mut other = honest.clone();
        change(&mut other.emitted.dag.nodes, &mut random);
        Pair::of(&other.printed())
    });
    judge(pairs, ROBOT)
}

/// Changes one place of the claim of honest variants, picked from all its places; returns how many
/// were refused.
fn claims(
    pick: impl Fn(&str, &Value) -> bool,
    with: impl Fn(&Value, &mut Random) -> Value,
) -> usize {
    let honest: Vec<Pair> = honest().iter().map(Pair::of).collect();
    let mut random = Random::new(0xbad);
    let pairs = (0..MUTATIONS).map(|index| {
        let honest = &honest[index % honest.len()];
        let mut json: Value = serde_json::from_str(&honest.claim).unwrap();
        let mut places = Vec::new();
        collect(&json, String::new(), &pick, &mut places);
        let value = json
            .pointer_mut(&places[random.below(places.len())])
            .unwrap();
        *value = with(value, &mut random);
        Pair {
            text: honest.text.clone(),
            claim: json.to_string(),
        }
    });
    judge(pairs, ROBOT)
}

fn collect(
    value: &Value,
    path: String,
    pick: &impl Fn(&str, &Value) -> bool,
    places: &mut Vec<String>,
) {
    if pick(&path, value) {
        places.push(path.clone());
    }
    match value {
        Value::Array(all) => {
            for (index, value) in all.iter().enumerate() {
                collect(value, format!("{path}/{index}"), pick, places);
            }
        }
        Value::Object(all) => {
            for (key, value) in all {
                collect(value, format!("{path}/{key}"), pick, places);
            }
        }
        _ => {}
    }
}

#[test]
fn honest_variants_are_shown_and_the_judge_can_tell() {
    let reading = reading(ROBOT).unwrap();
    let setup = Setup::new(&reading.robot, &reading.scenes[0]).unwrap();
    for honest in honest() {
        let pair = Pair::of(&honest);
        let results = pair.shown(ROBOT).unwrap();
        assert!(results.iter().all(Bounded::holds), "{results:?}");
        assert!(pair.is_true(&results, &setup));
        // The judge is no rubber stamp.
        let mut lie = results.clone();
        for own in &mut lie {
            own.claimed *= 1e-3;
            own.tolerated = own.claimed;
        }
        assert!(!pair.is_true(&lie, &setup));
        let text = pair.text.replacen(" + ", " - ", 1);
        let lie = Pair { text, ..pair };
        assert!(!lie.is_true(&results, &setup));
        // Whoever names no scene is held to no tolerance.
        let found = certify(&lie.text, &lie.claim, ROBOT, None, None).unwrap();
        assert!(!found.is_shown());
    }
}

/// Operations and their operands: one in ten is the same again, or within the tolerance.
#[test]
fn operations() {
    let refused = programs(|nodes, random| {
        let places: Vec<usize> = (0..nodes.len())
            .filter(|&place| matches!(nodes[place], Node::Apply(..)))
            .collect();
        let place = places[random.below(places.len())];
        let others: Vec<_> = nodes
            .iter()
            .filter_map(|own| match own {
                Node::Apply(operation, _) => Some(*operation),
                _ => None,
            })
            .collect();
        let Node::Apply(operation, operands) = &mut nodes[place] else {
            return;
        };
        match random.below(2) {
            0 => *operation = others[random.below(others.len())],
            _ => operands[random.below(2)] = random.below(place) as u32,
        }
    });
    assert!(refused >= MUTATIONS * 6 / 10, "{refused}");
}

/// Constants, changed by a share; half of the changes matter less than the tolerance.
#[test]
fn constants() {
    let refused = programs(|nodes, random| {
        let shares = [
            [1, 1_000_000_000],
            [1, 1000],
            [1, 100],
            [1, 10],
            [-1, 2],
            [1, 1],
        ];
        let [over, under] = shares[random.below(shares.len())];
        let factor = Exact::from(Rational::new((over + under).into(), under.into()));
        let mut constants: Vec<&mut Exact> = nodes
            .iter_mut()
            .filter_map(|own| match own {
                Node::Constant(own) => Some(own),
                _ => None,
            })
            .collect();
        let place = random.below(constants.len());
        let changed = constants[place].mul(&factor);
        *constants[place] = changed;
    });
    assert!(
        (MUTATIONS / 5..MUTATIONS * 4 / 5).contains(&refused),
        "{refused}"
    );
}

/// Words that say what the claim is about, and words of its programs.
#[test]
fn words() {
    let refused = claims(
        |path, _| {
            path.ends_with("/function")
                || path.ends_with("/relative_to")
                || path.ends_with("/scene")
        },
        |_, random| {
            let words = [
                "", "gravity", "coriolis", "f16", "range", "1", "r2", "q", "trust me",
            ];
            words[random.below(words.len())].into()
        },
    );
    assert_eq!(refused, MUTATIONS);
    let refused = claims(
        |path, _| path.ends_with("/steps") || path.ends_with("/returns"),
        |text, random| {
            let words = [
                "t1", "t2", "#0", "#3", "s1", "t1+t2", "q[0]*#1", "t3-t3", "-t4", "t9*t9",
            ];
            other_word(text.as_str().unwrap(), random, &words).into()
        },
    );
    assert!(refused >= MUTATIONS * 8 / 10, "{refused}");
}

#[test]
fn numbers() {
    let refused = claims(
        |_, value| value.is_f64(),
        |number, random| {
            let x = number.as_f64().unwrap();
            let changed = [
                0.0,
                -x,
                x * 0.5,
                x * 2.0,
                x.next_up(),
                x.next_down(),
                1e300,
                x * (1.0 - 1e-9),
                -0.0,
                1.0,
            ];
            changed[random.below(changed.len())].into()
        },
    );
    assert!(refused >= MUTATIONS / 2, "{refused}");
}

/// The robot file is changed and the claim is not.
#[test]
fn scenes() {
    let honest = honest();
    let mut random = Random::new(0x5ce2e);
    let digits: Vec<usize> = ROBOT
        .char_indices()
        .filter(|(_, c)| c.is_ascii_digit())
        .map(|(at, _)| at)
        .collect();
    let (mut tried, mut refused) = (0, 0);
    while tried < MUTATIONS {
        let at = digits[random.below(digits.len())];
        let digit = random.below(10).to_string();
        let changed = format!("{}{digit}{}", &ROBOT[..at], &ROBOT[at + 1..]);
        let Some(robot) = reading(&changed).filter(|_| changed != ROBOT) else {
            continue;
        };
        if Setup::new(&robot.robot, &robot.scenes[0]).is_err() {
            continue;
        }
        refused += judge([Pair::of(&honest[tried % 2])], &changed);
        tried += 1;
    }
    // Limits of joints may be narrower, and torques higher.
    assert!(refused >= MUTATIONS / 3, "{refused}");
}

/// Returns a document with one of its words changed into one of `words`.
fn other_word(text: &str, random: &mut Random, words: &[&str]) -> String {
    let is_word = |c: char| !c.is_whitespace() && !"\"{}:,".contains(c);
    let found: Vec<&str> = text
        .split(|c| !is_word(c))
        .filter(|own| !own.is_empty())
        .collect();
    let old = found[random.below(found.len())];
    // A part of the text, so that it has a place there.
    let place = old.as_ptr() as usize - text.as_ptr() as usize;
    let new = words[random.below(words.len())];
    format!("{}{new}{}", &text[..place], &text[place + old.len()..])
}

/// What the command does with a plan: it generates from it, and what it certifies is true.
#[test]
fn plans() {
    let (robot, generated) = generated(SinCos::Libm);
    let plan = plan(&robot, &generated);
    let mut random = Random::new(0x91a2);
    let words = [
        "t1+t2",
        "t2*#1",
        "t7-t1",
        "qd[1]*qd[1]",
        "s1*#0",
        "c2-#2",
        "s3*c2",
        "#0",
        "1/2",
        "2",
        "-t1",
        "t2",
        "t9",
        "-7",
        "[]",
        "0",
        "f32",
        "gravity",
        "q",
        "load",
        "planned",
        "returns",
    ];
    let (mut refused, mut kept) = (0, 0);
    for _ in 0..MUTATIONS {
        let changed = other_word(&plan, &mut random, &words);
        let Ok(plan) = Plan::parse(&changed) else {
            refused += 1;
            continue;
        };
        let mut request = request(&robot, SinCos::Libm);
        request.plan = Some(plan);
        match generate(&robot.robot, &request) {
            Err(_) => refused += 1,
            Ok(generated) => {
                let again = judge([Pair::of(certificate(&generated))], ROBOT);
                assert_eq!(again, 0, "{changed}");
                kept += 1;
            }
        }
    }
    assert_eq!(refused + kept, MUTATIONS);
    assert!(refused >= MUTATIONS / 3, "{refused}");
}

fn plan(robot: &Reading, generated: &Generated) -> String {
    let function = &generated.functions[0];
    let claim = certificate(generated);
    Plan {
        robot: robot.robot.name.clone(),
        input: input_hash(&robot.robot),
        entries: vec![Entry {
            start: Request::default().start,
            scalar: claim.scalar,
            source: function.source,
            passes: Vec::new(),
            scene: claim.scene.clone(),
            parameters: None,
            program: claim.exact.clone(),
            edited: Some(Edited {
                program: claim.emitted.clone(),
                left_out: Vec::new(),
            }),
        }],
    }
    .write()
}
