//! Against the generated Rust as rustc compiles it: a program around an arm's text reads
//! states and writes results, bit by bit: all of them as doubles, which hold each float exactly.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dalembert_jit::{Arm, Function, Real, Scalar};

use crate::support::{
    Folder, OTHERS, all_outputs_in_both, arguments, asking, drawn, is_same, robot,
};

const STATES: usize = 10_000;

const FRAME: &str = "
use std::io::{Read, Write};

trait Put {
    fn put(&self, bytes: &mut Vec<u8>);
}
impl Put for f32 {
    fn put(&self, bytes: &mut Vec<u8>) {
        f64::from(*self).put(bytes);
    }
}
impl Put for f64 {
    fn put(&self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}
impl<P: Put, const N: usize> Put for [P; N] {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|entry| entry.put(bytes));
    }
}
fn read<const N: usize>(bytes: &mut &[u8]) -> [f64; N] {
    [(); N].map(|()| {
        let (first, rest) = bytes.split_first_chunk().unwrap();
        *bytes = rest;
        f64::from_le_bytes(*first)
    })
}
";

fn program(arm: &Arm) -> String {
    let mut main = String::new();
    for function in arm.functions() {
        let scalar = function.scalar().name();
        let module = format!("in_{scalar}");
        let arguments = &function.native().signature().arguments;
        let mut names = Vec::new();
        writeln!(main, "for _ in 0..{STATES} {{").unwrap();
        for (argument, length) in arguments {
            let name = argument.name();
            names.push(format!("&{name}"));
            writeln!(main, "let {name} = read::<{length}>(&mut input);").unwrap();
            writeln!(main, "let {name} = {name}.map(|entry| entry as {scalar});").unwrap();
        }
        let (name, names) = (function.name(), names.join(", "));
        writeln!(main, "let result = generated::{module}::{name}({names});").unwrap();
        for quantity in function.output().quantities() {
            match function.output().structure() {
                None => writeln!(main, "result.put(&mut output);"),
                Some(_) => writeln!(main, "result.{}.put(&mut output);", quantity.field()),
            }
            .unwrap();
        }
        writeln!(main, "}}").unwrap();
    }
    let texts = arm.rust().iter().zip(["in_f64", "in_f32"]);
    let modules = texts.map(|(text, name)| format!("pub mod {name} {{\n{text}}}\n"));
    let modules: String = modules.collect();
    format!(
        "mod generated {{\n{modules}\n}}\n{FRAME}\nfn main() {{\n\
         let mut bytes = Vec::new();\nstd::io::stdin().read_to_end(&mut bytes).unwrap();\n\
         let mut input = bytes.as_slice();\nlet mut output = Vec::new();\n{main}\
         std::io::stdout().write_all(&output).unwrap();\n}}\n",
    )
}

fn library(folder: &Path, name: &str) -> PathBuf {
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap());
    let is_it = |path: &PathBuf| {
        let file = path.file_name().unwrap().to_string_lossy();
        file.starts_with(&format!("lib{name}-")) && file.ends_with(".rlib")
    };
    let libraries = files.map(|file| file.path()).filter(is_it);
    let modified = |path: &PathBuf| path.metadata().unwrap().modified().unwrap();
    libraries.max_by_key(modified).unwrap()
}

fn compiled(text: &str, folder: &Folder) -> PathBuf {
    let executable = std::env::current_exe().unwrap();
    let dependencies = executable.parent().unwrap();
    std::fs::create_dir_all(&folder.0).unwrap();
    let (source, program) = (folder.0.join("main.rs"), folder.0.join("main"));
    std::fs::write(&source, text).unwrap();
    let mut rustc = Command::new("rustc");
    rustc.args(["--edition=2024", "-Copt-level=1", "--cap-lints=allow"]);
    rustc.arg("-L").arg(dependencies);
    for name in ["dalembert_sines", "libm"] {
        let library = library(dependencies, name);
        rustc.args(["--extern", &format!("{name}={}", library.display())]);
    }
    let done = rustc.arg(&source).arg("-o").arg(&program).output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{said}");
    program
}

fn put<T: Real>(function: &Function, input: &mut Vec<u8>) {
    for state in drawn::<T>(function.native(), STATES, 7) {
        for entry in arguments(function.native(), &state).iter().flatten() {
            input.extend(entry.to_f64().to_le_bytes());
        }
    }
}

fn compare<T: Real>(name: &str, function: &Function, output: &mut &[u8]) {
    let native = function.native();
    let mut results = vec![T::default(); native.program().dag.outputs.len()];
    for state in drawn::<T>(native, STATES, 7) {
        let arguments = arguments(native, &state);
        let slices: Vec<&[T]> = arguments.iter().map(Vec::as_slice).collect();
        native.call(&slices, &mut results).unwrap();
        for (entry, &found) in results.iter().enumerate() {
            let (bytes, rest) = output.split_first_chunk().unwrap();
            let expected = f64::from_le_bytes(*bytes);
            *output = rest;
            let function = function.name();
            assert!(
                is_same(found.to_f64(), expected),
                "{name}, {function}, result {entry}: {found:?} for {expected:?} at {arguments:?}"
            );
        }
    }
}

fn same_as_rustc(name: &str, asked: &str, sincos: &str) {
    let arm = robot(name, &asking(&format!("{asked}; sincos: {sincos}")));
    let folder = Folder::new(&format!("rustc-{name}-{sincos}"));
    let program = compiled(&program(&arm), &folder);
    let mut input = Vec::new();
    for function in arm.functions() {
        match function.scalar() {
            Scalar::F64 => put::<f64>(function, &mut input),
            Scalar::F32 => put::<f32>(function, &mut input),
        }
    }
    let mut process = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    process.stdin.take().unwrap().write_all(&input).unwrap();
    let output = process.wait_with_output().unwrap();
    assert!(output.status.success());
    let mut output = output.stdout.as_slice();
    for function in arm.functions() {
        match function.scalar() {
            Scalar::F64 => compare::<f64>(name, function, &mut output),
            Scalar::F32 => compare::<f32>(name, function, &mut output),
        }
    }
    assert!(output.is_empty());
}

#[test]
fn all_outputs_of_a_small_arm_by_either_library_of_sines() {
    for sincos in ["auto", "libm"] {
        same_as_rustc("planar2r", &all_outputs_in_both(), sincos);
    }
}

#[test]
fn outputs_by_default_of_a_larger_arm() {
    same_as_rustc("panda", "scalar: f64, f32", "auto");
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn all_outputs_of_five_robots() {
    for name in OTHERS {
        same_as_rustc(name, &all_outputs_in_both(), "auto");
    }
}
