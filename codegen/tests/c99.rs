//! Functions in C: what compilers make of them has the bits of the proved program, and a
//! changed line is found.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use dalembert_codegen::workspace::{Code, Library, Names, Printed, RuntimeParameter};
use dalembert_codegen::{
    Fma, Function, Language, Request, RobotFile, ScalarType, SinCos, generate,
};
use dalembert_model::robot::Robot;

use crate::support;
use crate::support::compiled::{folder, same_bits, there};

const STRICT: [&str; 7] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Werror",
];

fn request(sincos: SinCos, batch: bool) -> Request {
    Request {
        language: Language::C,
        sincos,
        batch,
        ..Request::default()
    }
}

/// Compares outputs of an arm as its plan has them, from every source of sines that is the same
/// everywhere.
fn compare(name: &str, functions: &[Function], states: usize) {
    let robot = support::robot(name);
    let file = format!("../generated/robots/{name}.toml");
    let file = RobotFile::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap();
    let polynomial = SinCos::Polynomial { error: None };
    for (sines, sincos, batch) in [
        ("together", SinCos::Together, false),
        ("together", SinCos::Together, true),
        ("polynomial", polynomial, true),
    ] {
        let request = Request {
            functions: functions.to_vec(),
            plan: file.plan.clone(),
            ..request(sincos, batch)
        };
        let flags: [&[&str]; 3] = [&["-std=c99", "-O0"], &["-O2"], &["-O3", "-march=native"]];
        same_bits(&format!("{name}_{sines}"), &robot, &request, states, &flags);
    }
}

#[test]
fn compiled_functions_have_the_bits_of_the_program() {
    compare("planar2r", &Function::ALL[..6], 100);
}

#[test]
#[ignore = "more than an hour in release mode"]
fn every_output_of_five_robots_has_the_bits_of_the_program() {
    for name in ["planar2r", "planar3r", "stanford", "puma560", "panda"] {
        compare(name, &Function::ALL, 100_000);
    }
}

/// Returns a planar arm with a frame on its last link, and outputs there and under a wrench.
fn framed() -> (Robot, Vec<Function>) {
    let frame = "\n[[frame]]\nname = \"eye\"\nlink = 2\nxyz = [0.1, 0.2, 0]\nrpy = [0, 0, 0.5]\n";
    let robot = support::read_robot(&(support::source("planar2r", "") + frame));
    let functions = [
        "jacobian@eye:local",
        "contact_wrench@eye:linear",
        "operational_inertia@eye:linear",
        "forward_dynamics_with_wrench",
        "task=operational_inertia@eye:linear+null_space_projector@eye:linear",
    ];
    let functions = functions.map(|text| Function::parse(text).unwrap());
    (robot, functions.to_vec())
}

/// Lists whatever else changes what is printed, in both scalars and, of most, of many states too.
pub fn changes() -> Vec<(&'static str, Robot, Request)> {
    let of = |functions: &[Function], sincos| Request {
        functions: functions.to_vec(),
        ..request(sincos, true)
    };
    let (torques, inertia) = (Function::InverseDynamics, Function::Inertia);
    let planar = support::robot("planar2r");
    let scene = "[scene.near]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n\
                 box = { velocity = [3, 3], acceleration = [3, 3] }\n";
    let scene = support::reading_with("planar2r", scene).scenes.remove(0);
    let coulomb = include_str!("../../model/tests/data/coulomb.toml");
    let bundle = Function::bundle("servo", [torques, Function::Jacobian]).unwrap();
    let (framed, at_frames) = framed();
    vec![
        (
            "outputs",
            planar.clone(),
            of(&Function::ALL, SinCos::Together),
        ),
        (
            "frames",
            framed,
            Request {
                // The names of frames are a user's, and these functions' long anyhow.
                module: Some("p".to_owned()),
                ..of(&at_frames, SinCos::Together)
            },
        ),
        (
            "scene",
            planar.clone(),
            Request {
                scene: Some(scene),
                ..of(&[torques], SinCos::default())
            },
        ),
        (
            "coulomb",
            support::read_robot(coulomb),
            of(&[torques, Function::ForwardDynamics], SinCos::Together),
        ),
        (
            "load",
            planar.clone(),
            Request {
                parameters: RuntimeParameter::ALL.to_vec(),
                ..of(&[torques, inertia], SinCos::Together)
            },
        ),
        (
            "bundle",
            planar.clone(),
            of(&[bundle, Function::KineticEnergy], SinCos::Together),
        ),
        (
            "fused",
            planar,
            Request {
                fma: Fma::On,
                ..of(&[torques, bundle], SinCos::Together)
            },
        ),
    ]
}

/// Every output, frames, scenes with a tolerance, friction, arguments for payload and gravity, bundles and products
/// that are fused.
#[test]
fn whatever_is_printed_has_the_bits_of_the_program() {
    for (what, robot, request) in changes() {
        // Where products and sums may be fused: by the standard, and in GNU C.
        let [standard, gnu] = [
            &["-std=c99", "-O3", "-march=native"],
            &["-std=gnu99", "-O3", "-march=native"],
        ];
        for (batch, flags) in [(false, standard), (true, gnu)] {
            let request = Request {
                batch,
                ..request.clone()
            };
            same_bits(what, &robot, &request, 100, &[flags]);
        }
    }
}

/// Headers of all that changes what is printed, of every source of sines.
fn headers() -> Vec<String> {
    let mut all = changes();
    for sincos in [
        SinCos::Libm,
        SinCos::Together,
        SinCos::Polynomial { error: None },
    ] {
        let request = request(sincos, true);
        all.push(("sines", support::robot("planar2r"), request));
    }
    let texts = all
        .iter()
        .map(|(_, robot, request)| generate(robot, request).unwrap().text());
    texts.collect()
}

/// No compiler has a word to say of any header, in C or C++.
/// Order, units, frame and point of a payload's ten numbers stand above the function that takes them.
#[test]
fn headers_say_what_a_payload_holds() {
    let flange = "payload_frame = { xyz = [0, 0, 0.05] }\n\n[[joint]]";
    let plain = support::source("planar2r", "");
    let mut request = request(SinCos::Together, false);
    request.functions = vec![Function::Gravity];
    request.parameters = vec![RuntimeParameter::Payload];
    for (source, frame) in [
        (
            plain.replacen("[[joint]]", flange, 1),
            "table at xyz (0, 0, 0.05) m, rpy (0, 0, 0)",
        ),
        (plain, "that of joint 2 in the table (a tool's pose moves"),
    ] {
        let text = generate(&support::read_robot(&source), &request)
            .unwrap()
            .text();
        let (before, _) = text.split_once("_load(const double payload[").unwrap();
        let (_, doc) = before.rsplit_once("/*").unwrap();
        let said = doc
            .replace(" *", "")
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        for part in [
            "payload[10]: A body fixed to the last link",
            "[0] its mass, kg; [1] to [3] its centre of mass x, y, z, m, in the last link's frame",
            frame,
            "[4] to [9] its inertia Ixx, Iyy, Izz, Ixy, Iyz, Ixz, kg·m², about its centre of mass",
        ] {
            assert!(said.contains(part), "{part}: {said}");
        }
    }
}

#[test]
fn headers_are_compiled_without_a_warning() {
    let folder = folder("strict");
    for (index, text) in headers().iter().enumerate() {
        let (header, source) = (folder.join("arm.h"), folder.join("arm.c"));
        fs::write(header, text).unwrap();
        fs::write(
            &source,
            "#include \"arm.h\"\nint main(void) { return 0; }\n",
        )
        .unwrap();
        for compiler in there(&["gcc", "clang"]) {
            for (language, flags) in [("c", STRICT.as_slice()), ("c++", &STRICT[1..])] {
                let output = Command::new(compiler)
                    .args(flags)
                    .args(["-O2", "-fsyntax-only", "-x", language])
                    .arg(&source)
                    .output()
                    .unwrap();
                let said = String::from_utf8_lossy(&output.stderr);
                assert!(
                    output.status.success(),
                    "{compiler} {language} {index}: {said}"
                );
            }
        }
    }
}

/// Compilers make vectors of the loops over states, and have no word to say of those that call
/// the C library, of which they make none.
#[cfg(target_arch = "x86_64")]
#[test]
fn batches_are_vectors() {
    let folder = folder("vectors");
    let robot = support::robot("planar2r");
    for sincos in [SinCos::Libm, SinCos::Together] {
        let mut request = request(sincos, true);
        request.functions = vec![Function::InverseDynamics];
        let text = generate(&robot, &request).unwrap().text();
        fs::write(folder.join("arm.h"), text).unwrap();
        let source = folder.join("arm.c");
        let call = "#include \"arm.h\"\n\
            void f(size_t n, const double *q, const double *qd, const double *qdd, double *tau)\n\
            {\n    planar2r_inverse_dynamics_batch(n, q, qd, qdd, tau);\n}\n";
        fs::write(&source, call).unwrap();
        // With FMA, and in GNU C too, where gcc fuses products and sums unless it is told.
        let options = [
            &["-mavx2"][..],
            &["-mavx2", "-mfma"],
            &["-mfma", "-mavx2", "-std=c99"],
        ];
        let compilers = there(&["gcc", "clang"]).into_iter();
        for (compiler, options) in compilers.flat_map(|own| options.map(|all| (own, all))) {
            let output = Command::new(compiler)
                .args(["-O3", "-Werror", "-S", "-o", "-"])
                .args(options)
                .arg(&source)
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{compiler}: {said}");
            let assembly = String::from_utf8_lossy(&output.stdout);
            let lines = assembly.lines();
            let products = lines.filter(|line| line.contains("vmulpd") && line.contains("%ymm"));
            assert!(
                sincos == SinCos::Libm || products.count() > 20,
                "{compiler} {options:?}"
            );
        }
    }
}

/// The one rule of MISRA C:2012 that a checker finds broken is the guide's.
#[test]
fn misra_is_kept_but_for_what_the_guide_says() {
    let folder = folder("misra");
    for cppcheck in there(&["cppcheck"]) {
        for text in headers() {
            let (header, source) = (folder.join("arm.h"), folder.join("arm.c"));
            fs::write(header, &text).unwrap();
            let main = "#include \"arm.h\"\nint main(void);\nint main(void) { return 0; }\n";
            fs::write(&source, main).unwrap();
            let output = Command::new(cppcheck)
                .args(["--addon=misra", "--std=c99", "--enable=style", "--quiet"])
                .arg(&source)
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            let rules = said.lines().filter(|line| line.contains("[misra-c2012-"));
            for rule in rules.clone() {
                assert!(rule.ends_with("[misra-c2012-12.1]"), "{rule}");
            }
            // It looked: where roots are, the rule is broken.
            assert_eq!(rules.count() > 0, text.contains(" / sqrt("), "{said}");
        }
    }
}

/// Names of every output, of many states too, are distinct and no longer than every compiler tells
/// apart, where the robot has a name of some length.
#[test]
fn names_are_short_and_distinct() {
    let robot = support::robot("planar2r");
    for (library, sincos) in [(false, SinCos::Together), (true, SinCos::Libm)] {
        let mut request = request(sincos, true);
        request.functions = Function::ALL.to_vec();
        request.module = library.then(|| "stanford".to_owned());
        let text = generate(&robot, &request).unwrap().text();
        let heads = text
            .lines()
            .filter_map(|line| line.strip_prefix("static inline "));
        let names = heads.map(|head| {
            let head = head.split('(').next().unwrap();
            head.rsplit(' ').next().unwrap()
        });
        let names: Vec<&str> = names.collect();
        assert!(names.len() >= 4 * Function::ALL.len(), "{names:?}");
        assert!(names.iter().all(|name| name.len() <= 31), "{names:?}");
        let distinct: BTreeSet<&&str> = names.iter().collect();
        assert_eq!(distinct.len(), names.len());
    }
    // Two bundles, the one called as what the other's batch calls.
    let bundle = |name| Function::bundle(name, [Function::Gravity, Function::Inertia]).unwrap();
    let mut request = request(SinCos::Together, true);
    request.functions = vec![bundle("servo"), bundle("servo_any")];
    let error = generate(&robot, &request).unwrap_err().to_string();
    assert!(error.contains("`planar2r_servo_any`"), "{error}");
}

/// A robot's name that makes others too long is cut, and told apart by its hash; one that somebody
/// chose is not changed.
#[test]
fn long_names_are_cut() {
    let mut robot = support::robot("planar2r");
    let mut heads = BTreeSet::new();
    for (name, functions) in [
        ("a_robot_of_nineteen", Function::by_default()),
        (
            "gen3_7dof_novision_for_urdf_arm_v12",
            Function::by_default(),
        ),
        (
            "gen3_7dof_novision_for_urdf_arm_v13",
            Function::by_default(),
        ),
        (
            "gen3_7dof_novision_for_urdf_arm_v12",
            Function::ALL.to_vec(),
        ),
    ] {
        for (language, batch) in [(Language::C, false), (Language::Cuda, true)] {
            let mut request = request(SinCos::Together, batch);
            (request.language, request.functions) = (language, functions.clone());
            robot.name = name.to_owned();
            let generated = generate(&robot, &request).unwrap();
            let said = generated.warnings.join("\n");
            let short = said.split('`').nth(1).unwrap();
            assert!(said.contains(&format!("with `{name}`")), "{said}");
            assert!(
                short.starts_with(&name[..3])
                    && generated.text().contains(&format!(" {short}_gravity("))
            );
            assert!(generated.text().contains(&format!("robot `{name}`")));
            heads.insert(short.to_owned());
            // Chosen, the name is the module's, and nothing is said.
            request.module = Some(short.to_owned());
            let chosen = generate(&robot, &request).unwrap();
            assert_eq!(
                (chosen.texts, chosen.warnings),
                (generated.texts, Vec::new())
            );
        }
    }
    assert!(heads.len() >= 4, "{heads:?}");
}

/// What C and CUDA lack is refused by name.
#[test]
fn what_a_language_lacks_is_refused() {
    let robot = support::robot("planar2r");
    let refused = |change: fn(&mut Request), words: &str| {
        for language in [Language::C, Language::Cuda] {
            let mut request = request(SinCos::Together, false);
            request.language = language;
            change(&mut request);
            let error = generate(&robot, &request).unwrap_err().to_string();
            let name = format!("`{}`: ", language.name());
            assert!(error.starts_with(&name) && error.contains(words), "{error}");
        }
    };
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
    for (language, sincos, fma) in [
        (Language::C, SinCos::Together, Fma::Off),
        (Language::C, SinCos::Libm, Fma::On),
        (Language::C, SinCos::Polynomial { error: None }, Fma::Off),
        (Language::Cuda, SinCos::Together, Fma::Off),
        (Language::Cuda, SinCos::Polynomial { error: None }, Fma::Off),
    ] {
        let mut request = request(sincos, false);
        request.language = language;
        request.functions = vec![Function::InverseDynamics];
        request.scalars = vec![ScalarType::F32];
        request.fma = fma;
        let generated = generate(&robot, &request).unwrap();
        let function = &generated.functions[0];
        let code = function.code(ScalarType::F32, sincos.library(Library::Libm));
        let printed = Printed::of(&function.program, &code);
        let names = Names::new("planar2r", language, ScalarType::F32);
        let is_same = |lines: &[String]| {
            let read = Code::parse_c(&lines.join("\n"), &printed, false, &names);
            read.is_ok_and(|read| read.difference(&code).is_none())
        };
        let lines: Vec<String> = generated.text().lines().map(String::from).collect();
        let head = " void planar2r_f32_inverse_dynamics(";
        let start = lines.iter().position(|line| line.contains(head)).unwrap();
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
                ("_MULF(", "_MUL("),
                ("DALEMBERT_MULF(", "("),
                ("static ", ""),
                ("__device__ ", ""),
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
