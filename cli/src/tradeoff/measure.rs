//! The variants compiled and timed, in a package of its own in a temporary
//! folder.
//!
//! All of them are in one program, which calls each in turn, many times over:
//! whatever slows the machine down for a while slows all of them down. What
//! counts is the median over the rounds of the ratio to the first variant in
//! the same round. It is compiled for the processor that it runs on.

use std::env;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use dalembert_codegen::workspace::function::Argument;
use dalembert_codegen::workspace::language::result::structure;
use dalembert_report::sweep::{Point, Time};

use crate::outcome::Failure;

/// A compiler that was found.
pub struct Compiler {
    cargo: String,
}

const MANIFEST: &str = "\
[package]
name = \"dalembert-measure\"
version = \"0.0.0\"
edition = \"2024\"
[dependencies]
libm = \"0.2\"
[profile.release]
opt-level = 3
codegen-units = 1
[[bin]]
name = \"measure\"
path = \"main.rs\"
[workspace]
";

/// States a variant is called with in turn, calls a round, and rounds.
const HARNESS: &str = "\
const STATES: usize = 64;
const CALLS: usize = 1024;
const ROUNDS: usize = 61;

/// Positions within a turn, rates of a few units.
fn state<const N: usize>(seed: u64, reach: f64) -> [f64; N] {
    let mut bits = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    std::array::from_fn(|_| {
        bits = bits.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        ((bits >> 11) as f64 / (1u64 << 53) as f64 - 0.5) * 2.0 * reach
    })
}

fn main() {
    let mut rounds = vec![Vec::new(); VARIANTS.len()];
    for round in 0..ROUNDS + 2 {
        for (run, times) in VARIANTS.iter().zip(&mut rounds) {
            let start = std::time::Instant::now();
            run();
            let time = start.elapsed().as_secs_f64() * 1e9 / CALLS as f64;
            // Caches and clocks settle in the first two.
            if round >= 2 {
                times.push(time);
            }
        }
    }
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    for times in &rounds {
        let ratios = times.iter().zip(&rounds[0]).map(|(a, b)| a / b).collect();
        println!(\"{} {}\", median(times.clone()), median(ratios));
    }
}
";

impl Compiler {
    /// Returns the installed cargo.
    pub fn find() -> Result<Compiler, Failure> {
        let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".into());
        match Command::new(&cargo).arg("--version").output() {
            Ok(output) if output.status.success() => Ok(Compiler { cargo }),
            _ => Err(Failure::Input(format!(
                "error: --time needs a compiler, and `{cargo} --version` does not run\n  \
                 = help: install Rust, or set CARGO to where its cargo is"
            ))),
        }
    }

    /// Times every variant; the first one must be the exact f64 variant.
    pub fn measure(&self, points: &mut [Point]) -> Result<(), Failure> {
        let folder = Folder::new()?;
        folder.write("Cargo.toml", MANIFEST)?;
        folder.write("main.rs", &source(points))?;
        self.build(&folder)?;
        let program = folder.0.join("target/release/measure");
        let ran = Command::new(&program).output();
        let output = match ran {
            Ok(output) if output.status.success() => output.stdout,
            Ok(output) => return Err(failed("the variants do not run", &output.stderr)),
            Err(error) => {
                return Err(failed(
                    "the variants do not run",
                    error.to_string().as_bytes(),
                ));
            }
        };
        let text = String::from_utf8_lossy(&output);
        let mut times = text.lines().map(|line| {
            let mut numbers = line.split(' ').filter_map(|word| word.parse().ok());
            Some(Time {
                nanoseconds: numbers.next()?,
                ratio: numbers.next()?,
            })
        });
        for point in points {
            point.time = times.next().flatten();
        }
        Ok(())
    }

    /// Builds without the network if the packages are here already.
    fn build(&self, folder: &Folder) -> Result<(), Failure> {
        let mut last = Vec::new();
        for offline in [true, false] {
            let mut command = Command::new(&self.cargo);
            command.args(["build", "--release", "--quiet"]);
            if offline {
                command.arg("--offline");
            }
            // What the caller's environment says of its own builds is not for this.
            command
                .current_dir(&folder.0)
                .env("CARGO_TARGET_DIR", folder.0.join("target"))
                .env("RUSTFLAGS", "-Ctarget-cpu=native");
            for variable in ["CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET"] {
                command.env_remove(variable);
            }
            match command.output() {
                Ok(output) if output.status.success() => return Ok(()),
                Ok(output) => last = output.stderr,
                Err(error) => last = error.to_string().into_bytes(),
            }
        }
        Err(failed("the variants cannot be compiled", &last))
    }
}

/// Returns what the system calls the processor, or its architecture.
pub fn processor() -> String {
    let known = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let mut lines = known.lines().filter_map(|line| line.split_once(':'));
    let name = lines.find(|(key, _)| key.trim() == "model name");
    name.map_or(env::consts::ARCH, |(_, name)| name.trim())
        .to_owned()
}

fn failed(what: &str, why: &[u8]) -> Failure {
    let why = String::from_utf8_lossy(why);
    let lines: Vec<&str> = why.lines().take(12).collect();
    Failure::Input(format!("error: {what}\n{}", lines.join("\n")))
}

/// A temporary folder that goes with its owner.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Folder, Failure> {
        let path = env::temp_dir().join(format!("dalembert-measure-{}", std::process::id()));
        let fail = |error| Failure::Input(format!("error: `{}`: {error}", path.display()));
        fs::create_dir_all(&path).map_err(fail)?;
        Ok(Folder(path))
    }

    fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.0.join(name);
        let fail = |error| Failure::Input(format!("error: `{}`: {error}", path.display()));
        fs::write(&path, text).map_err(fail)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left is in the folder for temporary files.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Returns the program: every variant in a module of its own, with loops that call it.
fn source(points: &[Point]) -> String {
    let mut text = String::from("#![allow(clippy::all, unused)]\n");
    let mut names = Vec::new();
    for (index, point) in points.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "mod v{index} {{\n{}{}}}",
            function(point),
            calls(point)
        );
        names.push(format!("v{index}::run"));
    }
    let _ = writeln!(
        text,
        "const VARIANTS: [fn(); {}] = [{}];",
        names.len(),
        names.join(", ")
    );
    text + HARNESS
}

/// Returns a variant's text after the struct that it returns, if it does, and the states
/// of its arguments.
fn function(point: &Point) -> String {
    let certificate = &point.certificate;
    let (program, scalar) = (&certificate.emitted, certificate.scalar);
    let mut text = structure(program.function, program.sizes(), scalar).unwrap_or_default();
    let _ = write!(text, "#[inline(never)]\n{}", certificate.text);
    for argument in &program.arguments {
        let name = argument.name();
        let (seed, reach) = match argument {
            Argument::Position => (1, 3.0),
            Argument::Velocity => (2, 2.0),
            Argument::Acceleration => (3, 10.0),
            other => (other.index() + 1, other.reach()),
        };
        let n = program.joints;
        let _ = writeln!(
            text,
            "fn all_{name}() -> [[{scalar}; {n}]; crate::STATES] {{\n\
             std::array::from_fn(|i| crate::state::<{n}>(3 * i as u64 + {seed}, {reach:?}).map(|x| x as {scalar}))\n}}"
        );
    }
    text
}

/// Returns a loop that calls a variant with one state after the other.
fn calls(point: &Point) -> String {
    let program = &point.certificate.emitted;
    let names = program.arguments.iter().map(|argument| argument.name());
    let all: String = names
        .clone()
        .map(|name| format!("let {name} = all_{name}();\n"))
        .collect();
    let states = names.map(|name| format!("black_box(&{name}[call % crate::STATES])"));
    let states: Vec<String> = states.collect();
    format!(
        "pub fn run() {{\nuse std::hint::black_box;\n{all}\
         for call in 0..crate::CALLS {{ black_box({}({})); }}\n}}\n",
        program.function,
        states.join(", ")
    )
}
