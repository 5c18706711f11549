//! Robots, states, and what is expected at them.

use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::{Argument, Random, State};
use dalembert_jit::{Arm, Cache, Load, Native, Output, Place, Real, Scalar};

/// The robots of `generated/` but the arm in the plane, of which all outputs are compared daily.
pub const OTHERS: [&str; 5] = ["puma560", "stanford", "ur10", "panda", "planar3r"];

pub const STATES: usize = 1_000;

pub fn path(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.join(name)
}

pub fn robot(name: &str, load: &Load) -> Arm {
    let path = path(&format!("generated/robots/{name}.toml"));
    Arm::load(path, load).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub fn asking(asked: &str) -> Load {
    Load {
        asked: asked.parse().unwrap(),
        cache: Cache::Off,
        ..Load::default()
    }
}

pub fn all_outputs_in_both() -> String {
    format!("outputs: {}; scalar: f64, f32", of_fixed_bases().join(", "))
}

pub fn of_fixed_bases() -> Vec<&'static str> {
    let outputs = Output::ALL
        .into_iter()
        .filter(|output| output.takes_fixed_base());
    outputs.map(Output::name).collect()
}

pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("dalembert-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        Folder(path)
    }

    pub fn load(&self) -> Load {
        Load {
            asked: "outputs: gravity".parse().unwrap(),
            cache: Cache::At(self.0.clone()),
            ..Load::default()
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Draws an entry, mostly within the reach; one of 200 is large, tiny, infinite or no number.
fn entry(random: &mut Random, reach: f64) -> f64 {
    const SPECIAL: [f64; 10] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        -0.0,
        8192.0,
        8192.5,
        -100.25,
        1e22,
        5e-324,
        -1e-40,
    ];
    match random.bits() % 200 {
        0 => SPECIAL[random.bits() as usize % SPECIAL.len()],
        _ => (2.0 * random.unit() - 1.0) * reach,
    }
}

pub fn drawn<T: Real>(native: &Native, states: usize, seed: u64) -> Vec<State<T>> {
    let mut random = Random::new(seed);
    let mut samples: Vec<State<T>> = vec![State::default(); states];
    for &(argument, entries) in &native.signature().arguments {
        let reach = match argument {
            Argument::Position => 7.0,
            other => other.reach(),
        };
        for _ in 0..entries {
            for state in &mut samples {
                state[argument.index()].push(T::literal(entry(&mut random, reach)));
            }
        }
    }
    samples
}

pub fn is_same<T: Real>(left: T, right: T) -> bool {
    let (left, right) = (left.to_f64(), right.to_f64());
    left.to_bits() == right.to_bits() || (left.is_nan() && right.is_nan())
}

pub fn arguments<T: Real>(native: &Native, state: &State<T>) -> Vec<Vec<T>> {
    let arguments = native.signature().arguments.iter();
    arguments
        .map(|(argument, _)| state[argument.index()].clone())
        .collect()
}

pub fn called<T: Real>(
    native: &Native,
    drawn: &[State<T>],
    in_rows: bool,
    threads: usize,
) -> Vec<Vec<T>> {
    let (signature, states) = (native.signature(), drawn.len());
    let place = |entries| match in_rows {
        true => Place::rows(entries),
        false => Place::columns(entries, states),
    };
    let flat = |&(argument, entries): &(Argument, usize)| -> Vec<T> {
        let vectors = || drawn.iter().map(|state| &state[argument.index()]);
        match in_rows {
            true => vectors().flatten().copied().collect(),
            false => (0..entries)
                .flat_map(|entry| vectors().map(move |vector| vector[entry]))
                .collect(),
        }
    };
    let data: Vec<Vec<T>> = signature.arguments.iter().map(flat).collect();
    let read = data.iter().zip(&signature.arguments);
    let rows = read.map(|(data, &(_, entries))| (data.as_slice(), place(entries)));
    let sizes = signature.results.iter();
    let mut outputs: Vec<_> = sizes
        .map(|size| vec![T::default(); size * states])
        .collect();
    let written = outputs.iter_mut().zip(&signature.results);
    let results = written.map(|(data, &entries)| (data.as_mut_slice(), place(entries)));
    let (rows, mut results): (Vec<_>, Vec<_>) = (rows.collect(), results.collect());
    let done = native.call_rows(&rows, &mut results, states, threads);
    done.unwrap();
    let mut series = Vec::new();
    for (output, &entries) in outputs.iter().zip(&signature.results) {
        for entry in 0..entries {
            let at = |state: usize| match in_rows {
                true => output[state * entries + entry],
                false => output[entry * states + state],
            };
            series.push((0..states).map(at).collect());
        }
    }
    series
}

pub fn compare<T: Real>(name: &str, native: &Native, states: usize) {
    const CHUNK: usize = 999;
    let mut results = vec![T::default(); native.program().dag.outputs.len()];
    for done in (0..states).step_by(CHUNK) {
        let len = CHUNK.min(states - done);
        let drawn = drawn::<T>(native, len, done as u64 + 1);
        let expected = native.program().run_many(&drawn).unwrap();
        let many = [false, true].map(|in_rows| called(native, &drawn, in_rows, 1));
        for at in 0..len {
            let arguments = arguments(native, &drawn[at]);
            let slices: Vec<&[T]> = arguments.iter().map(Vec::as_slice).collect();
            native.call(&slices, &mut results).unwrap();
            for (entry, expected) in expected.iter().enumerate() {
                for found in [results[entry], many[0][entry][at], many[1][entry][at]] {
                    assert!(
                        is_same(expected[at], found),
                        "{name}: result {entry} is {found:?}, expected {:?} at {arguments:?}",
                        expected[at]
                    );
                }
            }
        }
    }
}

pub fn compare_all(name: &str, arm: &Arm, states: usize) {
    for function in arm.functions() {
        let (function_name, scalar) = (function.name(), function.scalar());
        let name = format!("{name}: {function_name} in {}", scalar.name());
        match scalar {
            Scalar::F64 => compare::<f64>(&name, function.native(), states),
            Scalar::F32 => compare::<f32>(&name, function.native(), states),
        }
    }
}
