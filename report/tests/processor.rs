//! What is said of functions that compilers do not say, by hand.

use std::path::Path;

use dalembert_codegen::workspace::function::{Argument, Function};
use dalembert_codegen::workspace::generate::generate;
use dalembert_codegen::workspace::language::MathPath;
use dalembert_codegen::workspace::plan;
use dalembert_codegen::workspace::program::{
    AngleSum, Input, Library, Literal, Lowered, LoweredTrig, Operand, Operation, Output,
    ScalarType, Speed, Step,
};
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::task::Request;
use dalembert_report::processor::target::{TARGETS, Target};
use dalembert_report::processor::{Footprint, Sines, footprint, footprints, warnings};

use crate::support;

use Operation::{Add, Div, Mul, Sub};

type Term = Operand<Literal>;

fn q(joint: usize) -> Term {
    Operand::Input(Input::Entry(Argument::Position, joint))
}

fn t(step: usize) -> Term {
    Operand::Step(step - 1)
}

fn text(steps: &[(Operation, Term, Term)], outputs: &[(bool, Term)]) -> Lowered {
    let steps = steps.iter().map(|&(operation, left, right)| Step {
        operation,
        left,
        right,
    });
    let outputs = outputs
        .iter()
        .map(|&(negative, value)| Output { negative, value });
    Lowered {
        scalar: ScalarType::F32,
        library: Library::Libm,
        trig: Vec::new(),
        speeds: Vec::new(),
        steps: steps.collect(),
        outputs: outputs.collect(),
    }
}

fn sincos(joint: usize) -> LoweredTrig {
    LoweredTrig {
        angle: AngleSum::joint(joint),
        sin: true,
        cos: true,
        kernel: None,
    }
}

/// Returns t1 = q0·q1, t2 = q1·q2, t3 = t1 + t2, t4 = t3/t1, t5 = t4·t4 and −t5, t4, t3.
fn small() -> Lowered {
    text(
        &[
            (Mul, q(0), q(1)),
            (Mul, q(1), q(2)),
            (Add, t(1), t(2)),
            (Div, t(3), t(1)),
            (Mul, t(4), t(4)),
        ],
        &[(true, t(5)), (false, t(4)), (false, t(3))],
    )
}

fn of(text: &Lowered) -> Footprint {
    footprint(Function::Gravity, text)
}

fn all() -> Vec<&'static Target> {
    TARGETS.iter().collect()
}

fn calls(footprint: &Footprint) -> Vec<String> {
    let calls = footprint.path.calls.iter();
    calls.map(ToString::to_string).collect()
}

/// Behind each line are alive: t1; t1 t2; t1 t3; t3 t4; t3 t4 t5; and with −t5, when
/// t5 is read no more, three again.
#[test]
fn alive_deep_and_paired_by_hand() {
    let footprint = of(&small());
    assert_eq!(footprint.alive, 3);
    // q1·q2, then t3, t4 and t5; a change of sign is no operation.
    assert_eq!(footprint.depth, 4);
    assert_eq!(footprint.operations(), 5);
    assert!((footprint.parallelism() - 1.25).abs() < 1e-15);
    // t2 is read by t3 alone; t1 by two, and no sum reads t5.
    assert_eq!(footprint.pairs, 1);
    assert_eq!(footprint.sines, Sines::default());
    let path = &footprint.path;
    assert!(path.calls.is_empty());
    assert_eq!((path.f64(), path.branches()), ("none", "none"));
}

/// q̇ r by r = 1/√(q̇² + w²): a square, a sum, a root by libm, a quotient, a product. The
/// chain begins behind the call: the quotient and the product.
#[test]
fn roots_are_calls() {
    let rubs = Lowered {
        speeds: vec![Speed {
            joint: 0,
            square: Literal(0.25),
        }],
        ..text(
            &[(
                Mul,
                Operand::Input(Input::Entry(Argument::Velocity, 0)),
                Operand::Input(Input::PerSpeed(0)),
            )],
            &[(false, t(1))],
        )
    };
    let footprint = of(&rubs);
    assert_eq!(footprint.operations(), 4);
    assert_eq!(footprint.depth, 2);
    assert_eq!(calls(&footprint), ["libm::sqrtf"]);
    assert!(footprint.path.branches().starts_with("in libm"));
}

/// t2 = q0·q1 + q2 and t4 = q2 − t2·q1: two operations. SSE2 has none of the kind: calls,
/// which are warned of.
#[test]
fn a_fused_product_is_one_operation() {
    let fused = text(
        &[
            (Operation::Fused, q(0), q(1)),
            (Add, t(1), q(2)),
            (Operation::Fused, t(2), q(1)),
            (Sub, q(2), t(3)),
        ],
        &[(false, t(4))],
    );
    let footprint = of(&fused);
    assert_eq!((footprint.operations(), footprint.depth), (2, 2));
    assert_eq!((footprint.counts.fma, footprint.pairs), (2, 0));
    let warned = warnings(&[footprint], &all());
    assert_eq!(warned.len(), 1, "{warned:?}");
    assert!(warned[0].starts_with("`mul_add` of f32 calls a function on x86-64"));
}

/// Four sines and cosines are alive behind the calls; one call gives all of them.
#[test]
fn sines_are_calls() {
    let (s, c) = (
        |joint| Operand::Input(Input::Sin(AngleSum::joint(joint))),
        |joint| Operand::Input(Input::Cos(AngleSum::joint(joint))),
    );
    let mut code = text(
        &[(Mul, s(0), c(1)), (Mul, c(0), s(1)), (Sub, t(1), t(2))],
        &[(false, t(3))],
    );
    code.trig = vec![sincos(0), sincos(1)];
    let footprint = of(&code);
    assert_eq!((footprint.alive, footprint.pairs), (4, 1));
    assert_eq!(calls(&footprint), ["2 libm::sincosf"]);
    assert_eq!(footprint.path.f64(), "in libm");
    let footprint = of(&code.calling(Library::Together));
    assert_eq!(calls(&footprint), ["dalembert_sines::sincosf"]);
    assert_eq!(footprint.path.f64(), "beyond 100 rad");
    // x + x of a product is none of a product and something else.
    let code = text(&[(Mul, q(0), q(1)), (Add, t(1), t(1))], &[(false, t(2))]);
    assert_eq!(of(&code).pairs, 0);
}

/// Pieces of very long functions are calls.
#[test]
fn long_functions_are_called_in_parts() {
    let mut steps = vec![(Mul, q(0), q(1))];
    steps.extend((1..5001).map(|step| (Add, t(step), q(0))));
    let code = text(&steps, &[(false, t(5001))]);
    let path = of(&code).path;
    assert_eq!(path.calls[0].to_string(), "6 part");
}

fn generated(name: &str, sines: SinCos, library: Library) -> Vec<Footprint> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
    let file = folder.join(format!("{name}.toml"));
    let request = Request {
        plan: plan::file::beside(&file).unwrap(),
        sincos: sines,
        math: MathPath::of(library),
        ..Request::of(&[Function::InverseDynamics, Function::Gravity])
    };
    let generated = generate(&support::robot(name), &request).unwrap();
    footprints(&generated)
}

/// The function of the README: six values are alive behind t10, t11, t12, t14, t15,
/// and the longest chain is t2 t3 t5 t8 t13 t17 t19 t21 t23.
#[test]
fn planar2r_by_hand() {
    let footprints = generated("planar2r", SinCos::Libm, Library::Libm);
    assert_eq!(footprints.len(), 4);
    for footprint in footprints.iter().step_by(2) {
        assert_eq!(footprint.function, Function::InverseDynamics);
        assert_eq!((footprint.counts.mul, footprint.counts.add), (13, 10));
        assert_eq!((footprint.alive, footprint.depth), (6, 9));
        assert_eq!(footprint.sines.libm, 2);
    }
}

/// Where f32 meets libm, it is said which processors suffer, once, and what to do;
/// what that is, is free of it.
#[test]
fn libm_in_f32_is_warned_of() {
    let libm = generated("planar2r", SinCos::Libm, Library::Libm);
    let libm: Vec<Footprint> = libm
        .into_iter()
        .filter(|f| f.scalar == ScalarType::F32)
        .collect();
    let all = warnings(&libm, &all());
    assert_eq!(all.len(), 1, "{all:?}");
    for word in [
        "cortex-m4f",
        "f64",
        "--sincos together",
        "--sincos polynomial",
    ] {
        assert!(all[0].contains(word), "{word}: {}", all[0]);
    }
    let polynomials = SinCos::Polynomial { error: None };
    for (sines, library) in [
        (SinCos::Together, Library::Together),
        (polynomials, Library::Libm),
    ] {
        let footprints = generated("planar2r", sines, library);
        let said = warnings(&footprints, &TARGETS.iter().collect::<Vec<_>>());
        assert_eq!(
            said,
            ["cortex-m4f has no f64: every operation calls software"]
        );
        for footprint in footprints.iter().filter(|_| sines == polynomials) {
            let path = &footprint.path;
            assert!(path.calls.is_empty() && path.branches() == "none");
            let f64 = footprint.scalar == ScalarType::F64;
            assert_eq!(path.f64(), if f64 { "all" } else { "none" });
        }
    }
}
