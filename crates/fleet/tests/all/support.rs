//! Robots, logs, and the command.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use dalembert_fit::random::{Random, within};
use dalembert_fit::{Accumulator, Fit, Model, fit};
use dalembert_fleet::logs::{Table, canonical_names};
use dalembert_fleet::{Dynamics, Loaded, States};

pub fn robot_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../generated/robots/{name}.toml"))
}

pub fn robot(name: &str, fit: bool) -> Arc<Loaded> {
    Arc::new(Loaded::open(&robot_file(name), &Default::default(), fit).unwrap())
}

pub struct Folder(pub PathBuf);

static NEXT: AtomicU32 = AtomicU32::new(0);

impl Folder {
    pub fn new() -> Folder {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("dalembert-fleet-test-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names = Vec::from_iter(names);
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// States in columns: times, q, q̇, q̈ and torques that are off by some noise.
pub struct Sample {
    pub count: usize,
    pub time: Vec<f64>,
    pub quantities: [Vec<f64>; 4],
}

impl Sample {
    pub fn new(robot: &dyn Dynamics, count: usize, seed: u64) -> Sample {
        let n = robot.joints();
        let mut random = Random::new(seed);
        let [q, qd, qdd, mut noise] = [3.0, 2.0, 5.0, 1.0].map(|largest| {
            let draws = (0..n * count).map(|_| within(&mut random, largest));
            draws.collect::<Vec<f64>>()
        });
        let mut sample = Sample {
            count,
            time: (0..count).map(|k| k as f64 * 1e-3).collect(),
            quantities: [q, qd, qdd, Vec::new()],
        };
        for (noise, tau) in noise.iter_mut().zip(sample.torques(robot)) {
            *noise += tau;
        }
        sample.quantities[3] = noise;
        sample
    }

    pub fn column(&self, quantity: usize, joint: usize) -> &[f64] {
        &self.quantities[quantity][joint * self.count..(joint + 1) * self.count]
    }

    fn torques(&self, robot: &dyn Dynamics) -> Vec<f64> {
        let (count, [q, qd, qdd, _]) = (self.count, &self.quantities);
        let mut tau = vec![0.0; q.len()];
        let states = States { count, q, qd, qdd };
        robot.inverse_dynamics(states, &mut tau).unwrap();
        tau
    }

    pub fn residuals(&self, robot: &dyn Dynamics, joint: usize) -> Vec<f64> {
        let tau = self.torques(robot);
        let torques = tau[joint * self.count..].iter();
        let measured = self.column(3, joint).iter();
        measured.zip(torques).map(|(x, y)| x - y).collect()
    }

    pub fn write(&self, path: &Path) {
        let n = self.quantities[0].len() / self.count;
        let mut table = Table::create(path, &canonical_names(n), false).unwrap();
        let quantities = self.quantities.iter().map(Vec::as_slice);
        table.write("", &self.time, quantities).unwrap();
        table.close().unwrap();
    }
}

pub fn fitted(model: &Model, bytes: &[u8]) -> Fit {
    fit(model, &Accumulator::from_bytes(model, bytes).unwrap()).unwrap()
}

pub fn wait_until(what: &str, mut has_happened: impl FnMut() -> bool) {
    let start = Instant::now();
    while !has_happened() {
        let is_late = start.elapsed() > Duration::from_secs(300);
        assert!(!is_late, "{what}: not after {:?}", start.elapsed());
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dalembert-fleet"));
    command.args(arguments);
    command
}

/// Starts the command; both of its outputs go where `output` says.
pub fn started(arguments: &[&str], output: fn() -> Stdio) -> Child {
    let mut command = command(arguments);
    command.stdout(output()).stderr(output()).spawn().unwrap()
}

pub fn fleet(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

pub fn succeeds(arguments: &[&str]) -> String {
    let output = fleet(arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// Asserts that a text has all of these parts.
#[track_caller]
pub fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// `flags` are separated by spaces.
pub fn simulated(folder: &Folder, flags: &str) -> String {
    let (robot, logs) = (robot_file("planar2r"), folder.file("logs"));
    let mut arguments = vec!["simulate", "--robot", text(&robot), "-o", text(&logs)];
    arguments.extend(flags.split_whitespace());
    succeeds(&arguments)
}

pub fn over<'a>(
    command: &'a str,
    logs: &'a Path,
    robot: &'a Path,
    more: &[&'a str],
) -> Vec<&'a str> {
    [&[command, text(logs), "--robot", text(robot)][..], more].concat()
}

pub fn fails(arguments: &[&str]) -> String {
    let output = fleet(arguments);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success(), "{arguments:?} succeeded: {said}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed something");
    assert!(!said.contains("panicked"), "{said}");
    said
}

pub fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The columns are joint, rms, 99 %, worst, and time.
pub fn rows(table: &str, name: &str) -> Vec<Vec<f64>> {
    let lines = table.lines().filter_map(|line| {
        let mut words = line.split_whitespace();
        let is_match = words.next()?.ends_with(name);
        let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
        is_match.then_some(numbers.ok()).flatten()
    });
    lines.collect()
}
