//! Functions in C: what compilers make of them has the bits of the proved program, and a
//! changed line is found.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use dalembert_codegen::workspace::clauses::RobotFile;
use dalembert_codegen::workspace::function::{Argument, Function, RuntimeParameter};
use dalembert_codegen::workspace::generate::{Fma, Generated, Request, generate};
use dalembert_codegen::workspace::language::c99::Names;
use dalembert_codegen::workspace::language::{Entries, Language, MathPath, Printed};
use dalembert_codegen::workspace::program::run::State;
use dalembert_codegen::workspace::program::{Library, Lowered, ScalarType};
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_model::robot::Robot;

use crate::support;

const STRICT: [&str; 7] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Werror",
];

fn request(sincos: SinCos, entries: Entries) -> Request {
    Request {
        language: Language::C,
        sincos,
        math: MathPath::of(sincos.library(Default::default())),
        entries,
        ..Request::default()
    }
}

/// The compilers that are there.
fn compilers() -> Vec<&'static str> {
    let there = |name: &&str| {
        let run = Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .status();
        run.is_ok_and(|status| status.success())
    };
    let found: Vec<&str> = ["gcc", "clang"].into_iter().filter(there).collect();
    if found.is_empty() {
        eprintln!("no C compiler is here: nothing of C is compiled");
    }
    found
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("c99_{name}"));
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn float(scalar: ScalarType) -> &'static str {
    match scalar {
        ScalarType::F64 => "double",
        ScalarType::F32 => "float",
    }
}

/// A program that reads states and writes what every function of a header gives, all in
/// doubles; `batch` has it call the functions of any number of states, for three.
fn main_of(robot: &Robot, generated: &Generated, batch: bool) -> String {
    let mut body = String::new();
    let joints = robot.joints.len();
    for emitted in &generated.emitted {
        let (function, float) = (emitted.function, float(emitted.scalar));
        let infix = if emitted.scalar == ScalarType::F32 {
            "_f32"
        } else {
            ""
        };
        let of = generated
            .functions
            .iter()
            .find(|f| f.function == function)
            .unwrap();
        let states = if batch { 3 } else { 1 };
        let name = format!("{}{infix}_{function}", robot.name);
        let name = if batch { format!("{name}_batch") } else { name };
        let start = generated.text.find(&format!(" {name}("));
        let name = match start {
            Some(_) => name,
            None => short(&name),
        };
        body += "    {\n";
        let mut passed = Vec::new();
        if batch {
            passed.push("3U".to_owned());
        }
        for argument in &of.program.arguments {
            let (offset, length) = (argument.index() * 16, argument.length(emitted.sizes));
            let own = argument.name();
            body += &format!(
                "        {float} {own}[{}]; for (i = 0; i < {}; ++i) {own}[i] = ({float})in[{offset} + i / {states}];\n",
                length * states,
                length * states
            );
            passed.push(own.to_owned());
        }
        let (mut write, number) = (String::new(), function.quantities()[0].shape().0.is_empty());
        if number && function.structure().is_none() && !batch {
            body += &format!("        put((double){name}({}));\n", passed.join(", "));
        } else {
            for (index, quantity) in function.quantities().iter().enumerate() {
                let length = quantity.len(emitted.sizes) * states;
                body += &format!("        {float} out{index}[{length}];\n");
                write += &format!(
                    "        for (i = 0; i < {length}; i += {states}) put((double)out{index}[i]);\n"
                );
                passed.push(format!("out{index}"));
            }
            body += &format!("        {name}({});\n{write}", passed.join(", "));
        }
        body += "    }\n";
    }
    assert!(joints <= 16);
    format!(
        "#include \"arm.h\"\n#include <stdio.h>\n\
         static void put(double x) {{ fwrite(&x, sizeof x, 1, stdout); }}\n\
         int main(void) {{\n    double in[{}]; int i;\n    \
         while (fread(in, sizeof in, 1, stdin) == 1) {{\n{body}    }}\n    return 0;\n}}\n",
        Argument::COUNT * 16
    )
}

/// A name whose words are shortened, as headers have it.
fn short(name: &str) -> String {
    let pairs = [
        ("inverse", "inv"),
        ("forward", "fwd"),
        ("dynamics", "dyn"),
        ("derivatives", "deriv"),
        ("kinematics", "kin"),
        ("coefficients", "coef"),
        ("manipulator", "manip"),
        ("equation", "eq"),
    ];
    let shortened = |name: String, (long, short): (&str, &str)| name.replace(long, short);
    pairs.into_iter().fold(name.to_owned(), shortened)
}

/// Compiles and runs it on states, and compares bits with the proved programs.
fn same_bits(robot: &Robot, request: &Request, count: usize, batch: bool, flags: &[&[&str]]) {
    let generated = generate(robot, request).unwrap();
    let name = format!("{}_{batch}_{}", robot.name, request.functions.len());
    let folder = folder(&name);
    fs::write(folder.join("arm.h"), &generated.text).unwrap();
    fs::write(folder.join("main.c"), main_of(robot, &generated, batch)).unwrap();
    let mut seed = 1u64;
    let mut next = || {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5) * 6.0
    };
    let states: Vec<Vec<f64>> = (0..count)
        .map(|_| (0..Argument::COUNT * 16).map(|_| next()).collect())
        .collect();
    let input: Vec<u8> = states
        .iter()
        .flatten()
        .flat_map(|x| x.to_ne_bytes())
        .collect();
    fs::write(folder.join("states"), &input).unwrap();
    let mut expected: Vec<u64> = Vec::new();
    for state in &states {
        for emitted in &generated.emitted {
            let at = |argument: Argument| {
                let start = argument.index() * 16;
                &state[start..start + argument.length(emitted.sizes)]
            };
            let results = match emitted.scalar {
                ScalarType::F64 => emitted.text.run(State::of(at)),
                ScalarType::F32 => {
                    let rounded = Argument::ALL.map(|argument| {
                        at(argument).iter().map(|&x| x as f32).collect::<Vec<f32>>()
                    });
                    let run = emitted
                        .text
                        .run(State::of(|a: Argument| &rounded[a.index()][..]));
                    run.into_iter().map(f64::from).collect()
                }
            };
            expected.extend(results.into_iter().map(f64::to_bits));
        }
    }
    for compiler in compilers() {
        for flags in flags {
            let program = folder.join("run");
            let compiled = Command::new(compiler)
                .args(*flags)
                .arg("-o")
                .arg(&program)
                .arg(folder.join("main.c"))
                .arg("-lm")
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&compiled.stderr);
            assert!(compiled.status.success(), "{compiler} {flags:?}: {said}");
            let run = Command::new(&program)
                .stdin(fs::File::open(folder.join("states")).unwrap())
                .output()
                .unwrap();
            let found = run.stdout.chunks_exact(8);
            let found = found.map(|bytes| u64::from_ne_bytes(bytes.try_into().unwrap()));
            let found: Vec<u64> = found.collect();
            assert_eq!(found.len(), expected.len());
            let differ = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "{} by {compiler} {flags:?}", robot.name);
        }
    }
}

/// States of the arms: as many as a campaign has where the tests are optimised.
fn states() -> usize {
    *support::dose(&[100, 100_000], 1).last().unwrap()
}

#[test]
fn compiled_functions_have_the_bits_of_the_program() {
    let plain: [&[&str]; 3] = [&["-std=c99", "-O0"], &["-O2"], &["-O3", "-march=native"]];
    for name in support::dose(&["planar2r", "stanford", "puma560", "panda"], 1) {
        let robot = support::robot(name);
        for (sincos, batch) in [
            (SinCos::Together, false),
            (SinCos::Polynomial { error: None }, true),
        ] {
            let entries = if batch {
                Entries::Batch
            } else {
                Entries::Single
            };
            let mut request = request(sincos, entries);
            request.plan = RobotFile::read(
                &Path::new(env!("CARGO_MANIFEST_DIR"))
                    .join(format!("../generated/robots/{name}.toml")),
            )
            .unwrap()
            .plan;
            same_bits(&robot, &request, states(), batch, &plain);
        }
    }
}

/// Products are fused where that was asked for, and rounded once then.
#[test]
fn fused_products_have_the_bits_of_the_program() {
    let robot = support::robot("planar2r");
    let mut request = request(SinCos::Together, Entries::Single);
    request.functions = vec![Function::InverseDynamics];
    request.fma = Fma::On;
    same_bits(&robot, &request, 100, false, &[&["-O1"]]);
}

/// No compiler has a word to say of any header, in C or C++.
#[test]
fn headers_are_compiled_without_a_warning() {
    let robot = support::robot("planar2r");
    let folder = folder("strict");
    let mut all = Vec::new();
    for sincos in [
        SinCos::Libm,
        SinCos::Together,
        SinCos::Polynomial { error: None },
    ] {
        all.push(request(sincos, Entries::Batch));
    }
    let mut arguments = request(SinCos::Together, Entries::Single);
    arguments.functions = vec![Function::InverseDynamics, Function::Inertia];
    arguments.parameters = vec![RuntimeParameter::Payload, RuntimeParameter::Gravity];
    all.push(arguments);
    let mut bundle = request(SinCos::Libm, Entries::Batch);
    let parts = [Function::InverseDynamics, Function::Jacobian];
    bundle.functions = vec![Function::bundle("servo", parts).unwrap()];
    bundle.fma = Fma::On;
    all.push(bundle);
    for (index, request) in all.iter().enumerate() {
        let generated = generate(&robot, request).unwrap();
        let header = folder.join(format!("arm{index}.h"));
        fs::write(&header, &generated.text).unwrap();
        for compiler in compilers() {
            for (language, flags) in [("c", STRICT.as_slice()), ("c++", &STRICT[1..])] {
                let source = format!("#include \"arm{index}.h\"\nint main(void) {{ return 0; }}\n");
                let mut child = Command::new(compiler)
                    .args(flags)
                    .args(["-O2", "-fsyntax-only", "-x", language, "-I"])
                    .arg(&folder)
                    .arg("-")
                    .stdin(Stdio::piped())
                    .stderr(Stdio::piped())
                    .spawn()
                    .unwrap();
                child
                    .stdin
                    .take()
                    .unwrap()
                    .write_all(source.as_bytes())
                    .unwrap();
                let output = child.wait_with_output().unwrap();
                let said = String::from_utf8_lossy(&output.stderr);
                assert!(
                    output.status.success(),
                    "{compiler} {language} {index}: {said}"
                );
            }
        }
    }
}

/// Names are distinct, and no longer than every compiler tells apart.
#[test]
fn names_are_short_and_distinct() {
    let robot = support::robot("planar2r");
    let text = generate(&robot, &request(SinCos::Together, Entries::Batch))
        .unwrap()
        .text;
    let heads = text
        .lines()
        .filter_map(|line| line.strip_prefix("static inline "));
    let names = heads.map(|head| {
        let head = head.split('(').next().unwrap();
        head.rsplit(' ').next().unwrap()
    });
    let names: Vec<&str> = names.collect();
    assert!(
        names.len() > 30 && names.iter().all(|name| name.len() <= 31),
        "{names:?}"
    );
    let distinct: BTreeSet<&&str> = names.iter().collect();
    assert_eq!(distinct.len(), names.len());
}

/// What C lacks is refused by name.
#[test]
fn what_c_lacks_is_refused() {
    let robot = support::robot("planar2r");
    let refused = |change: fn(&mut Request), words: &str| {
        let mut request = request(SinCos::Together, Entries::Single);
        change(&mut request);
        let error = generate(&robot, &request).unwrap_err().to_string();
        assert!(
            error.starts_with("`c`: ") && error.contains(words),
            "{error}"
        );
    };
    refused(|r| r.entries = Entries::Lanes, "`lanes`");
    refused(|r| r.entries = Entries::WithSincos, "`with_sincos`");
    refused(
        |r| r.interface = dalembert_codegen::workspace::emit::Interface::Traits,
        "traits",
    );
    refused(
        |r| r.layout = dalembert_codegen::workspace::emit::Layout::Contents,
        "contents",
    );
    refused(|r| r.module = Some("a-b".into()), "`a-b`");
    refused(
        |r| r.module = Some("an_arm_with_a_very_long_name".into()),
        "at most 31",
    );
}

/// No line of the arithmetic can go, trade places with the next one that differs in what it
/// says, or say something else.
#[test]
fn every_change_of_a_line_is_found() {
    let robot = support::robot("planar2r");
    for (sincos, fma) in [
        (SinCos::Together, Fma::Off),
        (SinCos::Libm, Fma::On),
        (SinCos::Polynomial { error: None }, Fma::Off),
    ] {
        let mut request = request(sincos, Entries::Single);
        request.functions = vec![Function::InverseDynamics];
        request.scalars = vec![ScalarType::F32];
        request.fma = fma;
        let generated = generate(&robot, &request).unwrap();
        let function = &generated.functions[0];
        let code = function.code(ScalarType::F32, sincos.library(Library::Libm));
        let printed = Printed::of(&function.program, &code);
        let names = Names::new("planar2r", ScalarType::F32);
        let is_same = |lines: &[String]| {
            let read = Lowered::parse_c(&lines.join("\n"), &printed, Entries::Single, &names);
            read.is_ok_and(|read| read.difference(&code).is_none())
        };
        let lines: Vec<String> = generated.text.lines().map(String::from).collect();
        let head = "static inline void planar2r_f32_inverse_dynamics(";
        let start = lines
            .iter()
            .position(|line| line.starts_with(head))
            .unwrap();
        let end = start + lines[start..].iter().position(|line| line == "}").unwrap();
        assert!(is_same(&lines) && end - start > 15);
        for index in start..end {
            let mut without = lines.clone();
            let line = without.remove(index);
            // That an argument is not read is for compilers.
            if line.contains("(void)") {
                continue;
            }
            assert!(!is_same(&without), "without {line}");
            for (from, to) in [
                (" + ", " - "),
                (" - ", " + "),
                (" * ", " + "),
                ("[0]", "[1]"),
                ("F", ""),
                ("F;", "e1F;"),
                ("const ", ""),
                ("float", "double"),
                ("t1 ", "t2 "),
                ("s1", "c1"),
                ("qd[", "qdd["),
                ("= ", "= -"),
                (";", ""),
                ("fmaf(", "fma("),
                ("fmaf(", "fmaf(-"),
                (", ", ", -"),
                ("sin", "cos"),
                ("cosf", "cos"),
                ("x1_", "x2_"),
            ] {
                let mut changed = lines.clone();
                changed[index] = line.replacen(from, to, 1);
                if changed[index] != line {
                    assert!(!is_same(&changed), "{line} -> {}", changed[index]);
                }
            }
        }
    }
}
