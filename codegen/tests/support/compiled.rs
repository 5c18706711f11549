//! Headers in C and CUDA, compiled and run beside the proved programs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dalembert_codegen::workspace::{Argument, JointState, Names, Random, RunnableCode};
use dalembert_codegen::{Function, GeneratedCode, Language, ScalarType};

use super::Case;

const MOST: usize = 16;
/// The states of a batch: more than there are threads of a kernel, and no multiple.
const STATES: usize = 5;
const AT_ONCE: usize = 200 * STATES;

/// A CUDA compiler's words for a processor: no qualifiers, and threads that take turns.
const DEVICE: &str = "#define __host__\n#define __device__\n#define __global__\n\
    static struct { unsigned x; } gridDim = {2}, blockDim = {2}, blockIdx, threadIdx;\n\
    #define THREADS for (blockIdx.x = 0; blockIdx.x < gridDim.x; ++blockIdx.x) \
    for (threadIdx.x = 0; threadIdx.x < blockDim.x; ++threadIdx.x)\n";

const MACROS: &str = "#define IN(real, name, length, from) real name[(length) * STATES]; \
    for (i = 0; i < (length) * STATES; ++i) name[i] = (real)in[i % STATES][(from) + i / STATES];\n\
    #define PUT(name, length) for (i = 0; i < (length) * STATES; ++i) \
    out[i % STATES][at[i % STATES]++] = (double)name[i];\n";

pub fn there(names: &[&'static str]) -> Vec<&'static str> {
    let is_there = |name: &&&str| {
        let mut command = Command::new(name);
        let run = command.arg("--version").stdout(Stdio::null()).status();
        run.is_ok_and(|status| status.success())
    };
    let programs: Vec<&str> = names.iter().filter(is_there).copied().collect();
    if programs.is_empty() {
        eprintln!("none of {names:?} is here: what needs one is not tested");
    }
    programs
}

pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("compiled_{name}"));
    fs::create_dir_all(&folder).unwrap();
    folder
}

pub fn run<'a>(program: &str, flags: impl IntoIterator<Item = &'a str>, folder: &Path) -> String {
    let mut command = Command::new(program);
    command.args(flags).current_dir(folder);
    let output = command.output().unwrap();
    let said = [output.stderr, output.stdout].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    assert!(output.status.success(), "{command:?}:\n{said}");
    said
}

fn call(case: &Case, generated: &GeneratedCode, emitted: &RunnableCode) -> String {
    let (function, batch) = (emitted.function, case.request.batch);
    let float = match emitted.scalar {
        ScalarType::F64 => "double",
        ScalarType::F32 => "float",
    };
    let base = case.request.module_name(case.robot());
    let names = Names::new(&base, case.request.language, emitted.scalar);
    let name = names.of(&format!("{function}{}", if batch { "_batch" } else { "" }));
    let mut functions = generated.functions.iter();
    let generated_function = functions.find(|candidate| candidate.function == function);
    let (mut body, mut results, mut passed) = (String::new(), String::new(), Vec::new());
    if batch {
        passed.push("STATES".to_owned());
    }
    for argument in &generated_function.unwrap().program.arguments {
        let (from, length) = (argument.index() * MOST, argument.length(emitted.sizes));
        assert!(length <= MOST);
        body += &format!("IN({float}, {}, {length}, {from})\n", argument.name());
        let mut cast = String::new();
        if argument.has_type() && !batch {
            cast = format!("(const {} *)", names.of(&format!("{}_t", argument.name())));
        }
        if batch && *argument == Argument::Load {
            passed.push("STATES".to_owned());
        }
        passed.push(cast + argument.name());
    }
    let quantities = function.quantities();
    let is_bundle = !batch && matches!(function, Function::Bundle(_) | Function::Load);
    let is_number = function.structure().is_none() && quantities[0].shape().0.is_empty();
    let is_returned = !batch && is_number;
    if is_bundle {
        body += &format!("{name}_t result;\n");
        passed.push("&result".to_owned());
    }
    for (index, quantity) in quantities.iter().enumerate() {
        let length = quantity.len(emitted.sizes);
        let mut out = format!("out{index}");
        match is_bundle {
            true => out = format!("result.{}", quantity.field()),
            false => body += &format!("{float} {out}[{length} * STATES];\n"),
        }
        results += &format!("PUT({out}, {length})\n");
        if !is_bundle && !is_returned {
            passed.push(out);
        }
    }
    let is_kernel = batch && case.request.language == Language::Cuda;
    let threads = if is_kernel { "THREADS " } else { "" };
    let returned = if is_returned { "out0[0] = " } else { "" };
    let passed = passed.join(", ");
    format!("{{\n{body}{threads}{returned}{name}({passed});\n{results}}}\n")
}

fn main_of(case: &Case, generated: &GeneratedCode) -> String {
    let emitted = &generated.emitted;
    let call_of = |code| call(case, generated, code);
    let calls: String = emitted.iter().map(call_of).collect();
    let outputs = emitted.iter().map(|code| code.text.dag.outputs.len());
    let states = if case.request.batch { STATES } else { 1 };
    let device = match case.request.language {
        Language::Cuda => DEVICE,
        Language::C | Language::Rust => "",
    };
    format!(
        "#include <stdio.h>\n#define STATES {states}\n{MACROS}{device}#include \"arm.h\"\n\
         static double in[STATES][{0}], out[STATES][{1}]; static int at[STATES];\n\
         int main(void) {{\n    int i;\n    \
         while (fread(in, sizeof in, 1, stdin) == 1) {{\n    \
         for (i = 0; i < STATES; ++i) at[i] = 0;\n{calls}    \
         fwrite(out, sizeof out, 1, stdout);\n    }}\n    return 0;\n}}\n",
        Argument::COUNT * MOST,
        outputs.sum::<usize>()
    )
}

fn states() -> impl Iterator<Item = Vec<f64>> {
    let mut random = Random::new(1);
    let mut next = move || (random.unit() - 0.5) * 6.0;
    std::iter::repeat_with(move || (0..Argument::COUNT * MOST).map(|_| next()).collect())
}

fn expected(generated: &GeneratedCode, state: &[f64]) -> Vec<u64> {
    let mut bits = Vec::new();
    for emitted in &generated.emitted {
        let state = JointState::new(|argument| {
            let start = argument.index() * MOST;
            state[start..start + argument.length(emitted.sizes)].to_vec()
        });
        bits.extend(emitted.text.run_at(&state).into_iter().map(f64::to_bits));
    }
    bits
}

/// `what` names a folder; every compiler that is there makes the program with each of these flags.
pub fn same_bits(what: &str, case: &Case, count: usize, flags: &[&str]) {
    let (generated, language) = (case.generated(), case.request.language);
    let is_batch = case.request.batch;
    let batch = if is_batch { "batch" } else { "single" };
    let folder = folder(&format!("{what}_{}_{batch}", language.name()));
    fs::write(folder.join("arm.h"), generated.text()).unwrap();
    fs::write(folder.join("main.c"), main_of(case, &generated)).unwrap();
    let dialect = match language {
        Language::Cuda => "-xc++",
        Language::C | Language::Rust => "-xc",
    };
    let mut programs = Vec::new();
    for compiler in there(&["gcc", "clang"]) {
        for flags in flags {
            let program = format!("run{}", programs.len());
            let ends = ["-o", &program, dialect, "main.c", "-xnone", "-lm"];
            run(compiler, flags.split(' ').chain(ends), &folder);
            programs.push((format!("{compiler} {flags}"), folder.join(program)));
        }
    }
    let mut states = states();
    for start in (0..count).step_by(AT_ONCE) {
        let states: Vec<Vec<f64>> = states.by_ref().take(AT_ONCE.min(count - start)).collect();
        let input = states.iter().flatten().flat_map(|x| x.to_ne_bytes());
        fs::write(folder.join("states"), input.collect::<Vec<u8>>()).unwrap();
        let expected = |state: &Vec<f64>| expected(&generated, state);
        let expected: Vec<u64> = states.iter().flat_map(expected).collect();
        for (how, program) in &programs {
            let states = fs::File::open(folder.join("states")).unwrap();
            let run = Command::new(program).stdin(states).output().unwrap();
            let bits_of = |bytes: &[u8]| u64::from_ne_bytes(bytes.try_into().unwrap());
            let found: Vec<u64> = run.stdout.chunks_exact(8).map(bits_of).collect();
            assert_eq!(found.len(), expected.len(), "{what}");
            let differ = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "{what} by {how}, states from {start}");
        }
    }
}
