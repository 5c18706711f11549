//! Robot files, and what is asked of them in the words of the macro: a row of a table of tests.
#![allow(
    dead_code,
    reason = "the tests of the command use what draws and reads robots"
)]

pub mod compiled;
pub mod draw;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex};

use dalembert_codegen::workspace::{
    ConditionAllowance, JointState, LEAST_PART, RunnableCode, Runtime, Variant, keep, parse,
};
use dalembert_codegen::{
    Function, GeneratedCode, GeneratedFunction, Language, Plan, Request, ScalarType, generate,
};
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;
use serde_json::Value;

/// Makes two tests of a function: with the cases of every day, and with the others, which the step
/// `campaigns` of `.ci/run` tries.
macro_rules! daily_and_campaign {
    ($($name:ident: ($($daily:tt)*), ($($others:tt)*);)*) => {
        mod daily {
            #[allow(unused_imports, reason = "numbers alone may stand for the cases")]
            use super::*;
            $(
                #[test]
                fn $name() {
                    super::$name($($daily)*);
                }
            )*
        }

        mod campaign {
            #[allow(unused_imports, reason = "numbers alone may stand for the cases")]
            use super::*;
            $(
                #[test]
                #[ignore = "minutes: the step `campaigns` of .ci/run"]
                fn $name() {
                    super::$name($($others)*);
                }
            )*
        }
    };
}
pub(crate) use daily_and_campaign;

pub fn one_in<const N: usize>(place: usize) -> bool {
    place.is_multiple_of(N)
}

pub fn all_but_one_in<const N: usize>(place: usize) -> bool {
    !one_in::<N>(place)
}

/// The error that is granted to every quantity, in units of u.
pub const BOUND: f64 = 100.0;

const FOLDERS: [&str; 4] = [
    "generated/robots",
    "codegen/tests/data",
    "crates/model/tests/data",
    "gallery/robots",
];

/// Returns the root of the workspace: `cli` has these tests' support, too, from another folder.
fn root() -> &'static Path {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = crate_folder.ancestors();
    let root = folders.find(|folder| folder.join(FOLDERS[0]).is_dir());
    root.expect("a checkout has robots")
}

pub fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

/// `frames/NAME` is a robot with the frames of the file that it is compared with.
pub fn source(name: &str, more: &str) -> String {
    if let Some(name) = name.strip_prefix("frames/") {
        return with_frames(name) + more;
    }
    let files = FOLDERS.map(|folder| root().join(format!("{folder}/{name}.toml")));
    let file = files.iter().find(|file| file.exists()).expect(name);
    std::fs::read_to_string(file).unwrap() + more
}

pub fn read(source: &str) -> Reading {
    read::parse(source).unwrap_or_else(|errors| panic!("{errors}"))
}

pub fn read_robot(source: &str) -> Robot {
    read(source).robot
}

pub fn robot(name: &str) -> Robot {
    reading_with(name, "").robot
}

pub fn reading_with(name: &str, more: &str) -> Reading {
    read(&source(name, more))
}

pub fn text(file: &str) -> String {
    std::fs::read_to_string(path(file)).unwrap()
}

pub fn json(file: &str) -> Value {
    serde_json::from_str(&text(file)).unwrap()
}

fn with_frames(name: &str) -> String {
    let table = |frame: &Value| {
        let lines = ["name", "link", "xyz", "rpy"].map(|key| format!("{key} = {}\n", frame[key]));
        format!("\n[[frame]]\n{}", lines.concat())
    };
    let json = json(&format!("tests/data/frames/{name}.json"));
    let tables = json["frames"].as_array().unwrap().iter().map(table);
    let source = source(name, "");
    let (rows, _) = source.split_once("\n[scene").unwrap_or((&source, ""));
    rows.to_owned() + &tables.collect::<String>()
}

pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

pub fn given(json: &Value) -> JointState {
    JointState::new(|argument| {
        let entry = argument.given().and_then(|key| json.get(key));
        entry.map_or_else(Vec::new, numbers)
    })
}

pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Splits a table of text: a row a line, `|` between its cells. A line `NAME := words` says what a
/// name stands for in the rows below.
pub fn rows<const N: usize>(table: &str) -> Vec<[String; N]> {
    let (mut names, mut rows) = (Vec::new(), Vec::new());
    for line in table.lines().filter(|line| !line.is_empty()) {
        if let Some(named) = line.split_once(" := ") {
            names.push(named);
            continue;
        }
        let named = |row: String, (name, words): &(&str, &str)| row.replace(name, words);
        let row = names.iter().rev().fold(line.to_owned(), named);
        let cells: Vec<String> = row.split('|').map(|cell| cell.trim().to_owned()).collect();
        rows.push(cells.try_into().unwrap_or_else(|_| panic!("{row}")));
    }
    rows
}

/// Lists words and those in their place: of a table of `FROM → TO`, one a line or with ` … `
/// between them. In it `·` is a blank, `↵` the end of a line, and `∅` nothing.
pub fn changes(table: &str) -> Vec<[String; 2]> {
    let pairs = table
        .lines()
        .flat_map(|line| line.split(" … "))
        .filter_map(|pair| pair.split_once(" → "));
    let read = |words: &str| {
        let words = words.trim().replace('·', " ");
        words.replace('↵', "\n").replace('∅', "")
    };
    pairs.map(|(from, to)| [from, to].map(read)).collect()
}

#[track_caller]
pub fn every_line_counts(
    text: &str,
    is_tried: impl Fn(usize) -> bool,
    mut others: impl FnMut(usize, &str) -> Vec<String>,
    is_refused: impl Fn(&str) -> bool,
) -> usize {
    let lines: Vec<&str> = text.lines().collect();
    let (mut place, mut count) = (0, 0);
    for (index, line) in lines.iter().enumerate() {
        for other in others(index, line).iter().filter(|other| other != line) {
            if is_tried(place) {
                count += 1;
                let mut changed = lines.clone();
                changed[index] = other;
                assert!(is_refused(&(changed.join("\n") + "\n")), "{line} → {other}");
            }
            place += 1;
        }
    }
    count
}

pub fn one(robot: &Robot, function: Function) -> GeneratedFunction {
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::new(&[function])
    };
    let generated = generate(robot, &request).unwrap_or_else(|error| panic!("{error}"));
    generated.functions.into_iter().next().unwrap()
}

pub fn every_output() -> String {
    let functions = Function::of(&robot("planar2r")).into_iter();
    functions.map(Function::name).collect::<Vec<_>>().join(", ")
}

/// Returns the text of a robot file with a scene that has these lines, which `;` parts, and outputs
/// with options in it; or with another table, if the lines begin with one.
pub fn in_scene(name: &str, lines: &str, asked: &str) -> (String, String) {
    let (scene, head) = match lines {
        "" => ("", ""),
        table if table.starts_with("[[") => ("", "\n"),
        _ => ("scene: test; ", "\n[scene.test]\n"),
    };
    let more = format!("{head}{}\n", lines.replace("; ", "\n"));
    (source(name, &more), format!("{scene}outputs: {asked}"))
}

pub struct Case {
    pub reading: Reading,
    pub request: Request,
}

impl Case {
    pub fn new(name: &str, more: &str, asked: &str) -> Case {
        Case::read(&source(name, more), asked)
    }

    pub fn read(source: &str, asked: &str) -> Case {
        Case::parse(source, asked).unwrap_or_else(|problems| panic!("{asked}: {problems}"))
    }

    pub fn in_scene(name: &str, lines: &str, asked: &str) -> Case {
        let (source, asked) = in_scene(name, lines, asked);
        Case::read(&source, &asked)
    }

    /// The programs of its outputs are searched for once for all tests.
    pub fn planar2r(asked: &str) -> Case {
        static PLAN: LazyLock<Plan> = LazyLock::new(|| {
            let case = Case::in_scene("planar2r", "", &every_output());
            case.plan(&case.generated())
        });
        let mut case = Case::in_scene("planar2r", "", asked);
        case.request.plan = Some(PLAN.clone());
        case
    }

    pub fn refused(name: &str, lines: &str, asked: &str) -> String {
        let (source, asked) = in_scene(name, lines, asked);
        Case::parse(&source, &asked).map_or_else(|said| said, |case| case.refusal())
    }

    fn parse(source: &str, asked: &str) -> Result<Case, String> {
        let reading = read(source);
        let (asked, language) = asked.split_once("; language: ").unwrap_or((asked, "rust"));
        let parsed = asked.parse();
        let words = parsed.unwrap_or_else(|error| panic!("{asked}: {error:?}"));
        let (robot, scenes) = (&reading.robot, &reading.scenes);
        let request = Request::parse(&words, &ScalarType::ALL, robot, &[], scenes);
        let mut request = request.map_err(|problems| {
            let said = problems.0.iter().map(|problem| format!("{problem}\n"));
            said.collect::<String>()
        })?;
        request.language = parse::<Language>(language).unwrap();
        Ok(Case { reading, request })
    }

    pub fn robot(&self) -> &Robot {
        &self.reading.robot
    }

    /// The programs of a request are searched for once for all tests, in whatever language it is.
    pub fn generated(&self) -> GeneratedCode {
        static FOUND: LazyLock<Mutex<BTreeMap<String, Plan>>> = LazyLock::new(Mutex::default);
        let robot = self.robot();
        let searched = Request {
            language: Language::default(),
            batch: false,
            module: None,
            ..self.request.clone()
        };
        // Elsewhere limbs may be lanes.
        let is_apart = self.request.batch || self.request.language == Language::Cuda;
        let key = format!("{robot:?} {searched:?} {is_apart}");
        let known = FOUND.lock().unwrap().get(&key).cloned();
        if let Some(plan) = known {
            return self.by(&plan);
        }
        let generated = self.searched();
        FOUND.lock().unwrap().insert(key, self.plan(&generated));
        generated
    }

    pub fn plan(&self, generated: &GeneratedCode) -> Plan {
        keep(self.robot(), &self.request, generated, None).plan
    }

    pub fn searched(&self) -> GeneratedCode {
        generate(self.robot(), &self.request).unwrap_or_else(|error| panic!("{error}"))
    }

    pub fn by(&self, plan: &Plan) -> GeneratedCode {
        let mut request = self.request.clone();
        request.plan = Some(plan.clone());
        generate(self.robot(), &request).unwrap_or_else(|error| panic!("{error}"))
    }

    pub fn refusal(&self) -> String {
        let error = generate(self.robot(), &self.request).expect_err("generated");
        error.to_string()
    }

    /// Coulomb friction has its full force at some states and is within its width at others.
    pub fn runtime(&self, count: usize, seed: u64) -> (Runtime, Vec<JointState>) {
        let setup = self.request.prepare(self.robot()).unwrap();
        let mut states = setup.states(count, seed);
        let is_rubbed = self.robot().joints.iter().any(|joint| joint.has_coulomb());
        let scales = [1.0, 1e-2, 1e-4, 0.0];
        let factors = if is_rubbed { &scales[..] } else { &scales[..1] };
        for (state, factor) in states.iter_mut().zip(factors.iter().cycle()) {
            state.qd.iter_mut().for_each(|qd| *qd *= factor);
        }
        (Runtime::in_scene(setup), states)
    }

    #[track_caller]
    pub fn rounds_well(&self, count: usize, what: &str) -> GeneratedCode {
        let (generated, (runtime, states)) = (self.generated(), self.runtime(count, 11));
        rounds_well(&generated, &runtime, &states, what);
        generated
    }
}

/// Something errs, or nothing was run.
#[track_caller]
pub fn rounds_well(
    generated: &GeneratedCode,
    runtime: &Runtime,
    states: &[JointState],
    what: &str,
) {
    assert!(!generated.emitted.is_empty(), "{what}");
    for emitted in &generated.emitted {
        let compared = with_runtime(emitted, runtime, states);
        hold(emitted, &compared, what);
        let mut errors = errors(emitted, &compared).into_iter();
        let is_exact = emitted.function != Function::InverseDynamics || states.len() < 20;
        assert!(is_exact || errors.any(|error| error > 0.0), "{what}: exact");
    }
}

/// Results of code at a state, the expected ones, and what is granted to the quantities.
pub type Compared = (Vec<f64>, Vec<f64>, ConditionAllowance);

/// Sines are libm's on both sides: how far polynomials are from them is measured apart. A result
/// that was proved to vanish is compared with zero, not with rounding noise.
pub fn with_runtime(
    emitted: &RunnableCode,
    runtime: &Runtime,
    states: &[JointState],
) -> Vec<Compared> {
    let code = emitted.with_libm();
    let compared = states.iter().map(|state| {
        let state = state.in_scalar(code.scalar);
        let known = runtime.run(code.function, &state).into_iter();
        let pairs = known.zip(code.vanishing());
        let expected = pairs.map(|(x, vanishes)| if vanishes { 0.0 } else { x });
        let granted = runtime.granted(code.function, &state);
        (code.run(&state), expected.collect(), granted)
    });
    compared.collect()
}

/// Returns the largest error of each quantity: of a vector relative to its largest entry, or to a
/// sixteenth of the largest met, in u and in what is granted; infinite if there is no number.
pub fn errors(emitted: &RunnableCode, compared: &[Compared]) -> Vec<f64> {
    let mut start = 0;
    let quantities = emitted.function.quantities().iter();
    let errors = quantities.map(|&quantity| {
        let range = start..start + quantity.len(emitted.sizes);
        start = range.end;
        let sizes = compared.iter().map(|(_, b, _)| largest(&b[range.clone()]));
        let least = LEAST_PART * sizes.fold(0.0, f64::max);
        let error = |(found, expected, granted): &Compared| {
            let (found, expected) = (&found[range.clone()], &expected[range.clone()]);
            let unit = emitted.scalar.unit_roundoff() * granted.factor(quantity);
            let most = unit * largest(expected).max(least);
            let error = |off: f64| match off / most {
                _ if off == 0.0 => 0.0,
                // A NaN loses every comparison: it must not go unnoticed.
                error if error.is_nan() => f64::INFINITY,
                error => error,
            };
            let pairs = found.iter().zip(expected);
            pairs.fold(0.0, |worst: f64, (a, b)| worst.max(error((a - b).abs())))
        };
        compared.iter().map(error).fold(0.0, f64::max)
    });
    errors.collect()
}

#[track_caller]
pub fn hold(emitted: &RunnableCode, compared: &[Compared], what: &str) {
    let errors = errors(emitted, compared).into_iter();
    for (error, quantity) in errors.zip(emitted.function.quantities()) {
        assert!(error <= BOUND, "{what} {quantity:?}: {error} u");
    }
}

#[track_caller]
pub fn says(text: &str, words: &str) {
    assert!(text.contains(words), "{words:?} expected in: {text}");
}

pub fn variants(generated: &GeneratedCode) -> &[Variant] {
    &generated.functions[0].admitted.as_ref().unwrap().variants
}

pub fn is_close(found: &[f64], expected: &[f64], most: f64) -> bool {
    let mut pairs = found.iter().zip(expected);
    found.len() == expected.len() && pairs.all(|(a, b)| (a - b).abs() <= most)
}
