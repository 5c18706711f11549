//! Functions that can be called in several ways: one arithmetic, which every
//! other text must bring the right values. What does not is refused.

use dalembert_codegen::Entries;
use dalembert_codegen::workspace::clauses::expand_from;
use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::keep::keep;
use dalembert_codegen::workspace::generate::{Generated, GeneratedFunction, generate};
use dalembert_codegen::workspace::language::MathPath;
use dalembert_codegen::workspace::language::Printed;
use dalembert_codegen::workspace::language::entries::Around;
use dalembert_codegen::workspace::language::entries::angles::Angles;
use dalembert_codegen::workspace::language::read::TextError;
use dalembert_codegen::workspace::plan::Plan;
use dalembert_codegen::workspace::portfolio::Start;
use dalembert_codegen::workspace::program::{Library, Lowered, ScalarType};
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::task::Layout;
use dalembert_codegen::workspace::task::Request;
use dalembert_codegen::workspace::words::parse;
use dalembert_model::robot::Robot;

use crate::support;

fn request(entries: Entries, sincos: SinCos, start: Start) -> Request {
    Request {
        scalars: vec![ScalarType::F64],
        start,
        sincos,
        math: MathPath::of(sincos.library(Library::Libm)),
        entries,
        layout: Layout::Contents,
        ..Request::of(&[
            Function::InverseDynamics,
            Function::ManipulatorEquation,
            Function::KineticEnergy,
            Function::ForwardKinematics,
            Function::ForwardDynamics,
        ])
    }
}

fn angles(robot: &Robot, generated: &Generated) -> Angles {
    let functions = generated.functions.iter();
    Angles::of(robot.joints.len(), functions.map(|f| &f.program))
}

/// Reads τ back out of a text.
fn read(
    text: &str,
    generated: &Generated,
    angles: &Angles,
    sincos: SinCos,
    entries: Entries,
) -> Result<Lowered, TextError> {
    let torques = |f: &&GeneratedFunction| f.function == Function::InverseDynamics;
    let function = generated.functions.iter().find(torques).unwrap();
    let library = sincos.library(Library::Libm);
    let code = function.code(ScalarType::F64, library);
    let around = Around {
        path: &MathPath::of(library).path,
        batch: "dalembert_batch",
        angles,
    };
    Lowered::parse_entries(
        text,
        &Printed::of(&function.program, &code),
        entries,
        &around,
    )
}

/// Arms that turn and slide, sums of angles, every kind of sines: whatever the
/// entries are, the same program is read, and nothing else of it is printed.
#[test]
fn the_same_program_by_every_entry() {
    let sums = parse::<Start>("angle_sums").unwrap();
    let torques = [Function::InverseDynamics];
    for (name, start, functions) in [
        ("planar2r", Start::Auto, None),
        ("planar3r", sums, Some(&torques)),
        ("stanford", Start::Auto, Some(&torques)),
    ] {
        let robot = support::robot(name);
        let all = [
            SinCos::Together,
            SinCos::Libm,
            SinCos::Polynomial { error: None },
        ];
        let of = |entries, sincos, plan: Option<Plan>| {
            let mut request = request(entries, sincos, start);
            if let Some(functions) = functions {
                request.functions = functions.to_vec();
            }
            request.plan = plan;
            let generated = generate(&robot, &request).unwrap();
            (request, generated)
        };
        // Programs are searched for once, and proved and printed for each.
        let (request, found) = of(Entries::Single, SinCos::Libm, None);
        let plan = keep(&robot, &request, &found, None).plan;
        for sincos in all {
            let of = |entries| of(entries, sincos, Some(plan.clone())).1;
            let single = of(Entries::Single);
            assert!(single.functions.iter().all(|function| function.planned));
            assert!(!single.text.contains("with_sincos") && !single.text.contains("angles"));
            for entries in [Entries::WithSincos, Entries::Lanes, Entries::Batch] {
                let more = of(entries);
                for (a, b) in single.emitted.iter().zip(&more.emitted) {
                    assert_eq!(a.text.difference(&b.text), None, "{name} {sincos:?}");
                }
                // The arithmetic is there once, and of batches once more over vectors.
                let lines = |text: &str| text.matches("    let t").count();
                let texts = if entries == Entries::Batch { 2 } else { 1 };
                assert_eq!(lines(&more.text), texts * lines(&single.text));
                for (entry, least) in [
                    ("_with_sincos", Entries::WithSincos),
                    ("_lanes", Entries::Lanes),
                    ("_columns", Entries::Batch),
                ] {
                    let head = format!("pub fn inverse_dynamics{entry}");
                    assert_eq!(more.text.contains(&head), entries >= least, "{entry}");
                }
            }
        }
    }
}

/// A sum of angles has its sine after those of the joints, in every function.
#[test]
fn sums_of_angles_have_places() {
    let robot = support::robot("planar3r");
    let start = parse::<Start>("angle_sums").unwrap();
    let request = request(Entries::Lanes, SinCos::Together, start);
    let generated = generate(&robot, &request).unwrap();
    let angles = angles(&robot, &generated);
    assert!(angles.count() > 3, "{}", generated.text);
    let head = format!(
        "pub fn angles(q: &[f64; 3]) -> [f64; {}] {{",
        angles.count()
    );
    assert!(generated.text.contains(&head));
    assert!(generated.text.contains("    [q[0], q[1], q[2], a"));
    assert!(generated.text.contains("[l] = q[0][l] + q[1][l];"));
}

/// Nearly all of these compile, and give wrong numbers.
#[test]
fn what_brings_the_wrong_value_is_refused() {
    let robot = support::robot("planar2r");
    for sincos in [SinCos::Together, SinCos::Libm] {
        let generated = generate(&robot, &request(Entries::Batch, sincos, Start::Auto)).unwrap();
        let angles = angles(&robot, &generated);
        let read = |text: &str| read(text, &generated, &angles, sincos, Entries::Batch);
        let own = generated.text.find("pub fn inverse_dynamics(").unwrap();
        let (before, own) = generated.text.split_at(own);
        read(&generated.text).unwrap();
        let sines = match sincos {
            SinCos::Libm => vec![
                ("(s1[l], c1[l]) =", "(s2[l], c2[l]) ="),
                ("(s1[l], c1[l]) =", "(c1[l], s1[l]) ="),
                ("sincos(q[1][l])", "sincos(q[0][l])"),
                ("libm::sincos(q[0][l])", "crate::tancot(q[0][l])"),
                ("q[1].both(libm::sincos)", "q[0].both(libm::sincos)"),
            ],
            _ => vec![
                ("_lanes(&[q[0], q[1]])", "_lanes(&[q[1], q[0]])"),
                (
                    "let ([s1, s2], [c1, c2]) = dalembert_sines::sincos_lanes",
                    "let ([c1, c2], [s1, s2]) = dalembert_sines::sincos_lanes",
                ),
                ("dalembert_sines::sincos(", "dalembert_sines::sincos_lanes("),
                (
                    "dalembert_sines::sincos_lanes(",
                    "dalembert_sines::cossin_lanes(",
                ),
                (
                    "([q, _qd, _qdd]: &[[V; 2]; 3])",
                    "([_qd, q, _qdd]: &[[V; 2]; 3])",
                ),
                ("&[s1, s2]: &[V; 2]", "&[s2, s1]: &[V; 2]"),
                ("&[c1, c2]: &[V; 2]", "&[c1, s2]: &[V; 2]"),
            ],
        };
        let others = [
            // One state: arguments and sines that trade places.
            ("(q, qd, qdd, &[s1", "(q, qdd, qd, &[s1"),
            ("&[s1, s2], &[c1, c2])", "&[s2, s1], &[c2, c1])"),
            ("&[s1, s2], &[c1, c2])", "&[c1, c2], &[s1, s2])"),
            ("&[s1, s2], &[c1, c2])", "&[s1, 0.0], &[c1, c2])"),
            ("inverse_dynamics_with_sincos(q,", "gravity_with_sincos(q,"),
            // With sines that are given.
            ("(sin[0], cos[0])", "(sin[1], cos[1])"),
            ("(sin[0], cos[0])", "(cos[0], sin[0])"),
            (
                "let (s2, c2) = (sin[1], cos[1])",
                "let (s2, c2) = (sin[1], sin[1])",
            ),
            (
                "    let (s2, c2) = (sin[1], cos[1]);\n",
                "    let (s2, c2) = libm::sincos(qd[1]);\n",
            ),
            (
                "_sincos(_q: &[f64; 2], qd: &[f64; 2], qdd:",
                "_sincos(_q: &[f64; 2], qdd: &[f64; 2], qd:",
            ),
            (
                "sin: &[f64; 2], cos: &[f64; 2])",
                "cos: &[f64; 2], sin: &[f64; 2])",
            ),
            // Lanes.
            (
                "_lanes<const L: usize>(q: &[[f64; L]; 2], qd:",
                "_lanes<const L: usize>(qd: &[[f64; L]; 2], q:",
            ),
            ("&[qd[0][l], qd[1][l]]", "&[qd[1][l], qd[0][l]]"),
            ("&[qd[0][l], qd[1][l]]", "&[qdd[0][l], qd[1][l]]"),
            ("&[s1[l], s2[l]]", "&[s1[l], s1[l]]"),
            ("results[0][l] = result[0];", "results[0][l] = result[1];"),
            ("        results[1][l] = result[1];\n", ""),
            ("results[1][l] = result[1];", "results[0][l] = result[0];"),
            (
                "    for l in 0..L {\n        let result",
                "    for l in 1..L {\n        let result",
            ),
            // Batches.
            ("([q, qd, qdd], results)", "([q, qdd, qd], results)"),
            (
                "_columns(q: &[&[f64]; 2], qd: &[&[f64]; 2], qdd:",
                "_columns(q: &[&[f64]; 2], qdd: &[&[f64]; 2], qd:",
            ),
            ("Vector<f64>>([q, qd, qdd]:", "Vector<f64>>([q, qdd, qd]:"),
            ("of.all(9.81)", "of.all(9.82)"),
            ("[results[0], results[1]]", "[results[1], results[0]]"),
            (
                "columns::<InverseDynamicsBatch",
                "columns::<ForwardDynamicsBatch",
            ),
            (
                "states::<InverseDynamicsBatch",
                "columns::<InverseDynamicsBatch",
            ),
        ];
        for (from, to) in sines.into_iter().chain(others) {
            let changed = own.replacen(from, to, 1);
            assert_ne!(changed, own, "{from}");
            let error = read(&format!("{before}{changed}"));
            assert!(error.is_err(), "{sincos:?}: {from} -> {to}");
        }
        let exchanged = generated
            .text
            .replacen("    [q[0], q[1]]\n", "    [q[1], q[0]]\n", 1);
        assert!(read(&exchanged).is_err());
    }
}

/// No line of the arithmetic or of a call can go.
#[test]
fn every_line_counts() {
    let robot = support::robot("planar2r");
    let mut request = request(Entries::Lanes, SinCos::Together, Start::Auto);
    request.functions = vec![Function::InverseDynamics];
    let generated = generate(&robot, &request).unwrap();
    let angles = angles(&robot, &generated);
    let lines: Vec<&str> = generated.text.lines().collect();
    let mut tried = 0;
    for (index, line) in lines.iter().enumerate() {
        if !line.starts_with("    ") && *line != "}" {
            continue;
        }
        let rest: Vec<&str> = [&lines[..index], &lines[index + 1..]].concat();
        let text = rest.join("\n");
        let read = read(&text, &generated, &angles, SinCos::Together, Entries::Lanes);
        let same = read.is_ok_and(|read| {
            let (program, library) = (&generated.functions[0].program, Library::Together);
            read.matches(program, library, &[]).is_ok()
        });
        assert!(!same, "{line}");
        tried += 1;
    }
    assert!(tried > 35, "{tried}");
}

/// Without the crate's feature, batches are refused in a sentence of ours that says what to
/// write, and nothing reads a crate that is not there: rustc has nothing to add.
#[test]
fn batches_without_the_feature_are_one_sentence() {
    let invocation = "mod arm = \"../generated/robots/planar2r.toml\"; \
                      outputs: gravity; scalar: f64; entries: batch;";
    let expanded = |has_batch| {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        expand_from(invocation.parse().unwrap(), &[folder], has_batch).to_string()
    };
    let (without, with) = (expanded(false), expanded(true));
    assert_eq!(without.matches("compile_error").count(), 1, "{without}");
    assert!(without.contains("needs the feature `batch` of the crate dalembert"));
    assert!(without.contains("features = [\\\"batch\\\"]"), "{without}");
    assert!(!without.contains("dalembert :: batch"), "{without}");
    assert!(!with.contains("compile_error") && with.contains("dalembert :: batch"));
}
