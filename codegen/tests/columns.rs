//! Functions of any number of states beside those of one: the same program over vectors, read
//! back. What brings a wrong value is refused.

use dalembert_codegen::workspace::{Code, Library, Printed, TextError, keep};
use dalembert_codegen::{
    Function, Generated, GeneratedFunction, Plan, Request, ScalarType, SinCos, Start, generate,
};

use crate::support;

fn request(batch: bool, sincos: SinCos, start: Start) -> Request {
    Request {
        scalars: vec![ScalarType::F64],
        start,
        sincos,
        batch,
        ..Request::of(&[
            Function::InverseDynamics,
            Function::ManipulatorEquation,
            Function::KineticEnergy,
            Function::ForwardKinematics,
            Function::ForwardDynamics,
        ])
    }
}

/// Reads τ and its columns back out of a text.
fn read(text: &str, generated: &Generated, sincos: SinCos) -> Result<Code, TextError> {
    let torques = |f: &&GeneratedFunction| f.function == Function::InverseDynamics;
    let function = generated.functions.iter().find(torques).unwrap();
    let library = sincos.library(Library::Libm);
    let code = function.code(ScalarType::F64, library);
    Code::parse_rust(text, &Printed::of(&function.program, &code), true)
}

/// Arms that turn and slide, every kind of sines: with columns or without, the
/// same program is read.
#[test]
fn the_same_program_in_columns() {
    let torques = [Function::InverseDynamics];
    for (name, start, functions) in [
        ("planar2r", Start::Auto, None),
        ("planar3r", Start::Auto, Some(&torques)),
        ("stanford", Start::Auto, Some(&torques)),
    ] {
        let robot = support::robot(name);
        let all = [
            SinCos::Together,
            SinCos::Libm,
            SinCos::Polynomial { error: None },
        ];
        let of = |batch, sincos, plan: Option<Plan>| {
            let mut request = request(batch, sincos, start);
            if let Some(functions) = functions {
                request.functions = functions.to_vec();
            }
            request.plan = plan;
            let generated = generate(&robot, &request).unwrap();
            (request, generated)
        };
        // Programs are searched for once, and proved and printed for each.
        let (request, found) = of(false, SinCos::Libm, None);
        let plan = keep(&robot, &request, &found, None).plan;
        for sincos in all {
            let of = |batch| of(batch, sincos, Some(plan.clone())).1;
            let (single, more) = (of(false), of(true));
            assert!(single.functions.iter().all(|function| function.planned));
            assert!(!single.text().contains("_columns"));
            for (a, b) in single.emitted.iter().zip(&more.emitted) {
                assert_eq!(a.text.difference(&b.text), None, "{name} {sincos:?}");
            }
            // The arithmetic is there once more, over vectors.
            let lines = |text: &str| text.matches("    let t").count();
            assert_eq!(lines(&more.text()), 2 * lines(&single.text()));
            assert!(more.text().contains("pub fn inverse_dynamics_columns("));
        }
    }
}

/// Nearly all of these compile, and give wrong numbers.
#[test]
fn what_brings_the_wrong_value_is_refused() {
    let robot = support::robot("planar2r");
    for sincos in [SinCos::Together, SinCos::Libm] {
        let generated = generate(&robot, &request(true, sincos, Start::Auto)).unwrap();
        let text = generated.text();
        let own = text.find("pub fn inverse_dynamics(").unwrap();
        let (before, own) = text.split_at(own);
        read(&generated.text(), &generated, sincos).unwrap();
        let sines = match sincos {
            SinCos::Libm => vec![
                ("(s1, c1) =", "(s2, c2) ="),
                ("(s1, c1) =", "(c1, s1) ="),
                ("sincos(q[1])", "sincos(q[0])"),
                ("libm::sincos(q[0])", "crate::tancot(q[0])"),
                ("q[1].both(libm::sincos)", "q[0].both(libm::sincos)"),
            ],
            _ => vec![
                ("sincos(&[q[0], q[1]])", "sincos(&[q[1], q[0]])"),
                (
                    "let ([s1, s2], [c1, c2]) = dalembert_sines::sincos",
                    "let ([c1, c2], [s1, s2]) = dalembert_sines::sincos",
                ),
                ("dalembert_sines::sincos(", "dalembert_sines::cossin("),
                (
                    "([q, _qd, _qdd]: &[[V; 2]; 3])",
                    "([_qd, q, _qdd]: &[[V; 2]; 3])",
                ),
                ("&[s1, s2]: &[V; 2]", "&[s2, s1]: &[V; 2]"),
                ("&[c1, c2]: &[V; 2]", "&[c1, s2]: &[V; 2]"),
                ("        [q[0], q[1]]\n", "        [q[1], q[0]]\n"),
            ],
        };
        let columns = [
            ("([q, qd, qdd], results)", "([q, qdd, qd], results)"),
            (
                "_columns(q: &[&[f64]; 2], qd: &[&[f64]; 2], qdd:",
                "_columns(q: &[&[f64]; 2], qdd: &[&[f64]; 2], qd:",
            ),
            ("Vector<f64>>([q, qd, qdd]:", "Vector<f64>>([q, qdd, qd]:"),
            ("of.all(9.81)", "of.all(9.82)"),
            (
                "columns::<InverseDynamicsBatch",
                "columns::<ForwardDynamicsBatch",
            ),
        ];
        for (from, to) in sines.into_iter().chain(columns) {
            let changed = own.replacen(from, to, 1);
            assert_ne!(changed, own, "{from}");
            let error = read(&format!("{before}{changed}"), &generated, sincos);
            assert!(error.is_err(), "{sincos:?}: {from} -> {to}");
        }
    }
}

/// No line of the arithmetic or of a call can go.
#[test]
fn every_line_counts() {
    let robot = support::robot("planar2r");
    let mut request = request(true, SinCos::Together, Start::Auto);
    request.functions = vec![Function::InverseDynamics];
    let generated = generate(&robot, &request).unwrap();
    let text = generated.text();
    let lines: Vec<&str> = text.lines().collect();
    let mut tried = 0;
    for (index, line) in lines.iter().enumerate() {
        if !line.starts_with("    ") && *line != "}" {
            continue;
        }
        let rest: Vec<&str> = [&lines[..index], &lines[index + 1..]].concat();
        let read = read(&rest.join("\n"), &generated, SinCos::Together);
        let same = read.is_ok_and(|read| {
            let (program, library) = (&generated.functions[0].program, Library::Together);
            read.matches(program, library, &[]).is_ok()
        });
        assert!(!same, "{line}");
        tried += 1;
    }
    assert!(tried > 35, "{tried}");
}
