//! Contracts of functions in C: Frama-C reads them, the full model in them is the robot's, and
//! bounds are the certificate's.

use std::fs;
use std::process::Command;

use dalembert_codegen::workspace::function::{Argument, Function};
use dalembert_codegen::workspace::generate::{Generated, generate};
use dalembert_codegen::workspace::language::{Entries, Language};
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::task::Request;
use dalembert_codegen::workspace::verify::floating::Runtime;
use dalembert_model::read::Reading;

use crate::c99::changes;
use crate::support;
use crate::support::compiled::{folder, there};

const SCENE: &str = "[scene.near]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n\
    box = { velocity = [1, 3], acceleration = [3, 3] }\n";

/// Returns what of a file's first scene has contracts.
fn contracts(reading: &mut Reading, functions: &[Function]) -> (Request, Generated) {
    let request = Request {
        language: Language::C,
        acsl: true,
        scene: Some(reading.scenes.remove(0)),
        ..Request::of(functions)
    };
    let generated = generate(&reading.robot, &request).unwrap();
    (request, generated)
}

#[test]
fn a_certified_function_promises_its_bound() {
    let mut planar = support::reading_with("planar2r", SCENE);
    let functions = [Function::InverseDynamics, Function::KineticEnergy];
    let (_, generated) = contracts(&mut planar, &functions);
    for clause in [
        "/*@ logic real planar2r_near_exact_inv_dyn(double *q, double *qd, double *qdd, integer i) =",
        "/*@ requires \\valid_read(q + (0 .. 1));",
        "    requires \\valid(tau + (0 .. 1));",
        "    requires \\separated(tau + (0 .. 1), qdd + (0 .. 1));",
        "    requires -1.0d <= qd[0] <= 1.0d;",
        "    requires -1.0f <= qd[0] <= 1.0f;",
        "    assigns tau[0 .. 1];",
        "    assigns \\nothing;",
        "    ensures \\result == 0 || \\result == 1;",
    ] {
        let mut lines = generated.text.lines();
        assert!(
            lines.any(|line| line == clause),
            "{clause}\n{}",
            generated.text
        );
    }
    let of = &generated.functions[0];
    for certificate in &of.admitted.as_ref().unwrap().certificates {
        let infix = if certificate.scalar == ScalarType::F32 {
            "f32_"
        } else {
            ""
        };
        for (index, bound) in certificate.bounds.iter().enumerate() {
            let exact = format!("planar2r_near_{infix}exact_inv_dyn(q, qd, qdd, {index})");
            let start = format!("    ensures \\abs(tau[{index}] - {exact}) <= ");
            let line = generated
                .text
                .lines()
                .find_map(|line| line.strip_prefix(&start));
            let most: f64 = line.unwrap().strip_suffix(';').unwrap().parse().unwrap();
            let claimed = bound.total() * certificate.scales[index];
            assert!(
                most > claimed && most < claimed * (1.0 + 1e-15),
                "{most} {claimed}"
            );
        }
    }
}

/// Where nothing is certified and nothing bounds a state, entries are finite.
#[test]
fn an_exact_function_asks_for_numbers() {
    let request = Request {
        language: Language::C,
        acsl: true,
        ..Request::of(&[Function::Gravity])
    };
    let generated = generate(&support::robot("planar2r"), &request).unwrap();
    assert!(generated.text.contains("    requires \\is_finite(q[1]);\n"));
    assert!(!generated.text.contains("ensures"));
}

/// The full model as a contract has it, made C of, gives what the robot's own recursion gives.
#[test]
fn the_model_of_a_contract_is_the_robots() {
    let scene = "[scene.near]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n\
        lock = { shoulder = \"pi/5\" }\n\
        box = { velocity = [2, 2, 2, 2, 2, 2], acceleration = [2, 2, 2, 2, 2, 2] }\n";
    let mut puma = support::reading_with("puma560", scene);
    let (request, generated) = contracts(&mut puma, &[Function::InverseDynamics]);
    let start = generated.text.find("_exact_inv_dyn(").unwrap();
    // Entries of locked joints are not read.
    assert!(!generated.text.contains("<= q[1] <="));
    assert!(!generated.text.contains("is_finite(q[1])"));
    let model = &generated.text[start..];
    let model = &model[model.find('\n').unwrap()..model.find("*/").unwrap()];
    assert!(model.contains("\\cos("));
    let (lets, result) = model.rsplit_once(";\n      ").unwrap();
    let lets = lets
        .replace("\\let ", "const double ")
        .replace("\\pi", "M_PI");
    let scene_robot = request.scene_robot(&puma.robot).unwrap();
    let states = scene_robot.states(20, 7);
    let runtime = Runtime::in_scene(scene_robot);
    let rows: String = states
        .iter()
        .map(|state| {
            let entries = [
                Argument::Position,
                Argument::Velocity,
                Argument::Acceleration,
            ]
            .map(|argument| state.of(argument))
            .concat();
            format!(
                "{{{}}},\n",
                entries
                    .iter()
                    .map(|x| format!("{x:e}"))
                    .collect::<Vec<_>>()
                    .join(", ")
            )
        })
        .collect();
    let source = format!(
        "#define _GNU_SOURCE\n#include <math.h>\n#include <stdio.h>\n\
         static double model(const double *q, const double *qd, const double *qdd, int i) {{{};\n\
         return {result} }}\n\
         static const double states[][18] = {{{rows}}};\n\
         int main(void) {{ for (int s = 0; s < {}; s++) for (int i = 0; i < 5; i++)\n\
         printf(\"%.17g\\n\", model(states[s], states[s] + 6, states[s] + 12, i)); }}\n",
        lets.replace("\\sin", "sin").replace("\\cos", "cos"),
        states.len()
    );
    let folder = folder("model");
    let (file, program) = (folder.join("model.c"), folder.join("model"));
    fs::write(&file, source).unwrap();
    for compiler in there(&["gcc", "clang"]) {
        let built = Command::new(compiler)
            .args([
                file.as_os_str(),
                "-lm".as_ref(),
                "-o".as_ref(),
                program.as_os_str(),
            ])
            .output()
            .unwrap();
        assert!(
            built.status.success(),
            "{}",
            String::from_utf8_lossy(&built.stderr)
        );
        let run = Command::new(&program).output().unwrap();
        let found = String::from_utf8(run.stdout).unwrap();
        let found: Vec<f64> = found.lines().map(|line| line.parse().unwrap()).collect();
        let expected = states
            .iter()
            .flat_map(|state| runtime.run(Function::InverseDynamics, state));
        let expected: Vec<f64> = expected.collect();
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-11, "{found} {expected}");
        }
    }
}

/// Whatever changes what is printed, and a scene: Frama-C has no word to say of any contract.
#[test]
fn frama_c_reads_contracts() {
    let folder = folder("acsl");
    for frama_c in there(&["frama-c"]) {
        for (what, robot, request) in changes() {
            for sincos in [request.sincos, SinCos::Libm] {
                let request = Request {
                    acsl: true,
                    entries: Entries::Single,
                    sincos,
                    ..request.clone()
                };
                let generated = generate(&robot, &request).unwrap();
                assert!(generated.text.contains("/*@ requires "), "{what}");
                fs::write(folder.join("arm.h"), &generated.text).unwrap();
                let source = folder.join("arm.c");
                fs::write(
                    &source,
                    "#include \"arm.h\"\nint main(void) { return 0; }\n",
                )
                .unwrap();
                let said = Command::new(frama_c)
                    .args(["-kernel-warn-key", "annot-error=error"])
                    // That literals in C are rounded is no news.
                    .args(["-kernel-warn-key", "parser:decimal-float=inactive"])
                    .arg(&source)
                    .output()
                    .unwrap();
                let text = String::from_utf8_lossy(&said.stdout);
                assert!(
                    said.status.success() && !text.contains("arning"),
                    "{what}: {text}"
                );
            }
        }
    }
}
