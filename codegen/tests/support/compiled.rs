//! Headers in C and CUDA, compiled and run beside the proved programs.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dalembert_codegen::workspace::{Argument, Emitted, JointState, Names, Random};
use dalembert_codegen::{Function, Generated, Language, Request, ScalarType, generate};
use dalembert_model::robot::Robot;

/// The most entries of an argument here.
const MOST: usize = 16;
/// The states of a batch: more than there are threads of a kernel, and no multiple.
const STATES: usize = 5;
/// The states that a program is given in one run: batches, whole.
const AT_ONCE: usize = 200 * STATES;

/// What a CUDA compiler for the device knows, for a processor: no qualifiers, and threads
/// that take turns.
const DEVICE: &str = "#define __host__\n#define __device__\n#define __global__\n\
    static struct { unsigned x; } gridDim = {2}, blockDim = {2}, blockIdx, threadIdx;\n";

/// Returns those of these programs that are there.
pub fn there(names: &[&'static str]) -> Vec<&'static str> {
    let is_there = |name: &&&str| {
        let run = Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .status();
        run.is_ok_and(|status| status.success())
    };
    let found: Vec<&str> = names.iter().filter(is_there).copied().collect();
    if found.is_empty() {
        eprintln!("none of {names:?} is here: what needs one is not tested");
    }
    found
}

pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("compiled_{name}"));
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Returns a call of a function on `STATES` states or one; what it gives is put aside.
fn call(base: &str, generated: &Generated, emitted: &Emitted, request: &Request) -> String {
    let function = emitted.function;
    let float = match emitted.scalar {
        ScalarType::F64 => "double",
        ScalarType::F32 => "float",
    };
    let batch = request.batch;
    let states = if batch { STATES } else { 1 };
    let suffix = if batch { "_batch" } else { "" };
    let names = Names::new(base, request.language, emitted.scalar);
    let name = names.of(&format!("{function}{suffix}"));
    let mut of = generated.functions.iter();
    let of = of.find(|of| of.function == function).unwrap();
    let mut body = "    {\n".to_owned();
    let mut passed = Vec::new();
    if batch {
        passed.push(format!("{STATES}U"));
    }
    for argument in &of.program.arguments {
        let (offset, length) = (argument.index() * MOST, argument.length(emitted.sizes));
        assert!(length <= MOST);
        let own = argument.name();
        let _ = writeln!(
            body,
            "        {float} {own}[{0}]; for (i = 0; i < {0}; ++i) {own}[i] = ({float})in[i % {states}][{offset} + i / {states}];",
            length * states
        );
        passed.push(own.to_owned());
    }
    let quantities = function.quantities();
    let is_bundle = matches!(function, Function::Bundle(_));
    let is_number = function.structure().is_none() && quantities[0].shape().0.is_empty();
    let mut results = Vec::new();
    match batch {
        false if is_number => results.push((format!("out{function}"), 1)),
        false if is_bundle => {
            let _ = writeln!(body, "        {name}_t result;");
            passed.push("&result".to_owned());
            let fields = quantities.iter();
            let fields = fields.map(|q| (format!("result.{}", q.field()), q.len(emitted.sizes)));
            results.extend(fields);
        }
        _ => {
            for (index, quantity) in quantities.iter().enumerate() {
                let (out, length) = (format!("out{index}"), quantity.len(emitted.sizes));
                let _ = writeln!(body, "        {float} {out}[{}];", length * states);
                passed.push(out.clone());
                results.push((out, length));
            }
        }
    }
    let mut call = format!("{name}({})", passed.join(", "));
    if !batch && is_number {
        let _ = writeln!(body, "        {float} {}[1];", results[0].0);
        call = format!("{}[0] = {call}", results[0].0);
    }
    if batch && request.language == Language::Cuda {
        call = format!(
            "for (blockIdx.x = 0; blockIdx.x < gridDim.x; ++blockIdx.x)\n            \
             for (threadIdx.x = 0; threadIdx.x < blockDim.x; ++threadIdx.x)\n                {call}"
        );
    }
    let _ = writeln!(body, "        {call};");
    for (out, length) in results {
        let _ = writeln!(
            body,
            "        for (i = 0; i < {0}; ++i) put(i % {states}, (double){out}[i]);",
            length * states
        );
    }
    body + "    }\n"
}

/// Returns a program that reads states and writes what every function of a header gives, all in
/// doubles, state by state.
fn main_of(base: &str, generated: &Generated, request: &Request) -> String {
    let calls = generated.emitted.iter();
    let calls: String = calls
        .map(|emitted| call(base, generated, emitted, request))
        .collect();
    let outputs = generated
        .emitted
        .iter()
        .map(|own| own.text.dag.outputs.len());
    let (states, device) = match (request.batch, request.language) {
        (true, Language::Cuda) => (STATES, DEVICE),
        (true, _) => (STATES, ""),
        (_, Language::Cuda) => (1, DEVICE),
        _ => (1, ""),
    };
    format!(
        "#include <stdio.h>\n{device}#include \"arm.h\"\n\
         static double in[{states}][{0}], out[{states}][{1}]; static int at[{states}];\n\
         static void put(int s, double x) {{ out[s][at[s]++] = x; }}\n\
         int main(void) {{\n    int i;\n    \
         while (fread(in, sizeof in, 1, stdin) == 1) {{\n    \
         for (i = 0; i < {states}; ++i) at[i] = 0;\n{calls}    \
         fwrite(out, sizeof out, 1, stdout);\n    }}\n    return 0;\n}}\n",
        Argument::COUNT * MOST,
        outputs.sum::<usize>()
    )
}

/// Lists states whose entries are anywhere, without an end.
fn states() -> impl Iterator<Item = Vec<f64>> {
    let mut random = Random::new(1);
    let mut next = move || (random.unit() - 0.5) * 6.0;
    std::iter::repeat_with(move || (0..Argument::COUNT * MOST).map(|_| next()).collect())
}

/// Returns what the proved programs give.
fn expected(generated: &Generated, state: &[f64]) -> Vec<u64> {
    let mut all = Vec::new();
    for emitted in &generated.emitted {
        let state = JointState::new(|argument| {
            let start = argument.index() * MOST;
            state[start..start + argument.length(emitted.sizes)].to_vec()
        });
        let results = emitted.text.run_at(&state);
        all.extend(results.into_iter().map(f64::to_bits));
    }
    all
}

/// Compiles the program in a folder by every compiler that is there with each of these flags,
/// and returns how, with where it is.
fn compiled(folder: &Path, language: Language, flags: &[&[&str]]) -> Vec<(String, PathBuf)> {
    let as_language = match language {
        Language::Cuda => "-xc++",
        Language::C | Language::Rust => "-xc",
    };
    let compilers = there(&["gcc", "clang"]).into_iter();
    let ways = compilers.flat_map(|compiler| flags.iter().map(move |flags| (compiler, *flags)));
    let compile = |(index, (compiler, flags)): (usize, (&str, &[&str]))| {
        let (how, program) = (
            format!("{compiler} {flags:?}"),
            folder.join(format!("run{index}")),
        );
        let output = Command::new(compiler)
            .args(flags)
            .args(["-o".as_ref(), program.as_os_str(), as_language.as_ref()])
            .arg(folder.join("main.c"))
            .args(["-xnone", "-lm"])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.success(),
            "{} by {how}: {said}",
            folder.display()
        );
        (how, program)
    };
    ways.enumerate().map(compile).collect()
}

/// Compiles and runs it on so many states, and compares bits with the proved programs. `what`
/// names a folder.
pub fn same_bits(what: &str, robot: &Robot, request: &Request, count: usize, flags: &[&[&str]]) {
    let generated = generate(robot, request).unwrap_or_else(|error| panic!("{what}: {error}"));
    let language = request.language;
    let what = format!(
        "{what}_{}_{}",
        language.name(),
        if request.batch { "batch" } else { "single" }
    );
    let folder = folder(&what);
    let main = main_of(&request.module_name(robot), &generated, request);
    fs::write(folder.join("arm.h"), generated.text()).unwrap();
    fs::write(folder.join("main.c"), main).unwrap();
    let programs = compiled(&folder, language, flags);
    let mut states = states();
    for start in (0..count).step_by(AT_ONCE) {
        let states: Vec<Vec<f64>> = states.by_ref().take(AT_ONCE.min(count - start)).collect();
        let input = states.iter().flatten().flat_map(|x| x.to_ne_bytes());
        fs::write(folder.join("states"), input.collect::<Vec<u8>>()).unwrap();
        let expected = states.iter().flat_map(|state| expected(&generated, state));
        let expected: Vec<u64> = expected.collect();
        for (how, program) in &programs {
            let run = Command::new(program)
                .stdin(fs::File::open(folder.join("states")).unwrap())
                .output()
                .unwrap();
            let found = run.stdout.chunks_exact(8);
            let found = found.map(|bytes| u64::from_ne_bytes(bytes.try_into().unwrap()));
            let found: Vec<u64> = found.collect();
            assert_eq!(found.len(), expected.len(), "{what}");
            let differ = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "{what} by {how}, states from {start}");
        }
    }
}
