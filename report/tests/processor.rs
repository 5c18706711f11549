//! What functions take of a processor: by hand where a hand can count, and near
//! what was compiled where it was.

use std::path::Path;

use dalembert_codegen::workspace::function::{Argument, Function};
use dalembert_codegen::workspace::generate::{Request, generate};
use dalembert_codegen::workspace::language::MathPath;
use dalembert_codegen::workspace::plan;
use dalembert_codegen::workspace::program::{
    AngleSum, Input, Library, Literal, Lowered, LoweredTrig, Operand, Operation, Output,
    ScalarType, Speed, Step,
};
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_report::processor::estimate::Estimate;
use dalembert_report::processor::flat::Flat;
use dalembert_report::processor::registers::{Traffic, is_short, traffic};
use dalembert_report::processor::target::{Cycles, Fused, Target, Unit};
use dalembert_report::processor::targets::TARGETS;
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

/// t1 = q0·q1, t2 = q1·q2, t3 = t1 + t2, t4 = t3/t1, t5 = t4·t4 and −t5, t4, t3.
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

const CYCLES: Cycles = Cycles {
    add: 2,
    mul: 3,
    div: 10,
    fma: Some(Fused {
        factor: 4,
        addend: 1,
    }),
};

/// A processor with so many registers, of which calls keep one.
const fn with(registers: usize) -> Target {
    Target {
        name: "by hand",
        about: "",
        f32: Some(Unit {
            registers,
            kept: 1,
            constant: 1,
            constants_in_table: true,
            accumulates: false,
            cycles: CYCLES,
        }),
        f64: None,
        word: 4,
        returns: 0,
        frame: 2,
        alignment: 8,
        restored: 8,
        saves: 16,
        bytes: 4.0,
        overwrites: false,
        reads_memory: false,
        short_constants: true,
        vectors: false,
    }
}

static FOUR: Target = with(4);
static THREE: Target = with(3);

fn of(text: &Lowered, target: &'static Target) -> (Footprint, Estimate) {
    let footprint = footprint(Function::Gravity, text, 1, &[target]);
    let estimate = footprint.on[0].1.unwrap();
    (footprint, estimate)
}

fn calls(footprint: &Footprint) -> Vec<String> {
    let calls = footprint.path.calls.iter();
    calls.map(ToString::to_string).collect()
}

/// Behind each line are alive: t1; t1 t2; t1 t3; t3 t4; t3 t4 t5; and with −t5, when
/// t5 is read no more, three again.
#[test]
fn alive_deep_and_paired_by_hand() {
    let (footprint, estimate) = of(&small(), &FOUR);
    assert_eq!(footprint.alive, 3);
    // q1·q2, then t3, t4 and t5; a change of sign is no operation.
    assert_eq!(footprint.depth, 4);
    assert_eq!(footprint.operations(), 5);
    assert!((footprint.parallelism() - 1.25).abs() < 1e-15);
    assert_eq!(estimate.cycles, 3 + 2 + 10 + 3);
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
    let (footprint, estimate) = of(&rubs, &FOUR);
    assert_eq!(footprint.operations(), 4);
    assert_eq!(footprint.depth, 2);
    assert_eq!(estimate.cycles, 10 + 3);
    assert_eq!(calls(&footprint), ["libm::sqrtf"]);
    assert!(footprint.path.branches().starts_with("in libm"));
}

/// t2 = q0·q1 + q2 and t4 = q2 − t2·q1: two instructions, three loads, a store and the
/// return. The chain is through what t2 is a factor of.
#[test]
fn a_fused_product_is_one_instruction() {
    let fused = text(
        &[
            (Operation::Fused, q(0), q(1)),
            (Add, t(1), q(2)),
            (Operation::Fused, t(2), q(1)),
            (Sub, q(2), t(3)),
        ],
        &[(false, t(4))],
    );
    let (footprint, estimate) = of(&fused, &FOUR);
    assert_eq!((footprint.operations(), footprint.depth), (2, 2));
    assert_eq!((footprint.counts.fma, footprint.pairs), (2, 0));
    assert_eq!(estimate.cycles, 4 + 4);
    assert_eq!(estimate.instructions, 2 + 3 + 1 + 1);
    assert!(warnings(&[footprint]).is_empty());
    // Where it is added it is read later.
    let added = text(
        &[
            (Mul, q(0), q(1)),
            (Operation::Fused, q(1), q(2)),
            (Add, t(2), t(1)),
        ],
        &[(false, t(3))],
    );
    assert_eq!(of(&added, &FOUR).1.cycles, 3 + 1);
    // SSE2 has none: calls, which are warned of.
    let (footprint, estimate) = of(&fused, &TARGETS[3]);
    assert_eq!(footprint.on[0].0.name, "x86-64");
    assert!(estimate.instructions > 2 + 3 + 1 + 1);
    assert_eq!(estimate.cycles, 2 * (4 + 4));
    let warned = warnings(&[footprint]);
    assert!(warned[0].starts_with("`mul_add` of f32 calls a function on x86-64"));
}

/// With four registers nothing goes to the stack: three loads, five operations, a
/// change of sign, three stores, the return.
#[test]
fn everything_in_registers_by_hand() {
    let (_, estimate) = of(&small(), &FOUR);
    let expected = Traffic {
        loads: 3,
        registers: 3,
        ..Traffic::default()
    };
    assert_eq!(estimate.traffic, expected);
    assert_eq!(estimate.instructions, 3 + 5 + 1 + 3 + 1);
    assert_eq!((estimate.stack, estimate.constants), (0, 0));
    assert_eq!(estimate.code, 4 * estimate.instructions);
}

/// q0 to q3 are read first and again at the end, in three registers: q3 takes the
/// place of what is read last from there, q2, and q2 comes back for t3 + q2, when q3
/// is free again.
#[test]
fn what_is_read_last_goes_to_the_stack() {
    let code = text(
        &[
            (Mul, q(0), q(1)), // q0, q1, t1: of these only q1 is read later
            (Mul, q(2), t(1)), // t2 in the place of t1: q1, q2, t2
            (Sub, q(3), t(2)), // all three taken: q2 goes
            (Mul, t(3), q(1)),
            (Add, t(4), q(3)),
            (Add, t(5), q(2)), // and comes back
        ],
        &[(false, t(6))],
    );
    let (_, estimate) = of(&code, &THREE);
    let expected = Traffic {
        loads: 5,
        spills: 1,
        slots: 1,
        registers: 3,
        ..Traffic::default()
    };
    assert_eq!(estimate.traffic, expected);
    // One slot, and the two registers that are beyond those of which one is kept:
    // one is restored. Frame and return address: 8 bytes.
    assert_eq!(estimate.stack, (8 + 8 + 4usize).next_multiple_of(8));
    // Loads, the spill, operations, the result; push, vpush, sub and back, return.
    assert_eq!(estimate.instructions, 5 + 1 + 6 + 1 + (6 + 1));
    let (_, estimate) = of(&code, &FOUR);
    assert_eq!((estimate.traffic.loads, estimate.traffic.spills), (4, 0));
}

/// Of the first angle's sine and cosine, one stays in the only register that a call
/// keeps, into which it is copied, and the other goes to the stack.
#[test]
fn calls_leave_what_they_keep() {
    let (s, c) = (
        |joint| Operand::Input(Input::Sin(AngleSum::joint(joint))),
        |joint| Operand::Input(Input::Cos(AngleSum::joint(joint))),
    );
    let mut code = text(
        &[(Mul, s(0), c(1)), (Mul, c(0), s(1)), (Sub, t(1), t(2))],
        &[(false, t(3))],
    );
    code.trig = vec![sincos(0), sincos(1)];
    let (footprint, estimate) = of(&code, &FOUR);
    assert_eq!(footprint.alive, 4);
    // Two angles and what was on the stack.
    let expected = Traffic {
        loads: 3,
        spills: 1,
        copies: 1,
        slots: 1,
        registers: 3,
        over_calls: 1,
        ..Traffic::default()
    };
    assert_eq!(estimate.traffic, expected);
    assert_eq!(calls(&footprint), ["2 libm::sincosf"]);
    assert_eq!(footprint.path.f64(), "in libm");
    // q, the result's place, frame pointer and return address; a register; a slot.
    assert_eq!(estimate.stack, (4 * 4 + 8 + 4usize).next_multiple_of(8));

    let together = code.calling(Library::Together);
    let (footprint, estimate) = of(&together, &FOUR);
    assert_eq!(calls(&footprint), ["dalembert_sines::sincosf"]);
    assert_eq!(footprint.path.f64(), "beyond 100 rad");
    // Two angles and four results are in arrays; all are loaded, nothing is spilled.
    let traffic = estimate.traffic;
    assert_eq!((traffic.angles, traffic.loads, traffic.spills), (2, 6, 0));
    assert_eq!(estimate.stack, (4 * 4 + 6 * 4usize).next_multiple_of(8));
}

/// A sum with a product of its own is one instruction; the other operand is written
/// over, and copied where it is read again.
#[test]
fn products_are_added_to_what_is_there() {
    let mut target = with(8);
    for accumulates in [false, true] {
        if let Some(unit) = &mut target.f32 {
            unit.accumulates = accumulates;
        }
        let code = text(
            &[(Mul, q(0), q(1)), (Add, t(1), q(2)), (Mul, t(2), q(2))],
            &[(false, t(3))],
        );
        let flat = Flat::of(&code);
        let found = traffic(&flat, &target, target.f32.as_ref().unwrap());
        let expected = usize::from(accumulates);
        assert_eq!((found.merged, found.copies), (expected, expected));
    }
    // x + x of a product is none of a product and something else.
    let code = text(&[(Mul, q(0), q(1)), (Add, t(1), t(1))], &[(false, t(2))]);
    assert_eq!(of(&code, &FOUR).0.pairs, 0);
}

/// Pieces of very long functions are calls.
#[test]
fn long_functions_are_called_in_parts() {
    let mut steps = vec![(Mul, q(0), q(1))];
    steps.extend((1..5001).map(|step| (Add, t(step), q(0))));
    let code = text(&steps, &[(false, t(5001))]);
    let path = of(&code, &FOUR).0.path;
    assert_eq!(path.calls[0].to_string(), "6 part");
}

#[test]
fn short_constants_are_those_of_arm() {
    for short in [1.0, -0.5, 2.0, 31.0, 0.125, 1.9375, -3.875] {
        assert!(is_short(short), "{short}");
    }
    for long in [0.0, 32.0, 0.1, 1.03125, 0.0625, f64::INFINITY, 9.81] {
        assert!(!is_short(long), "{long}");
    }
}

fn generated(name: &str, sines: SinCos, library: Library) -> Vec<Footprint> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
    let file = folder.join(format!("{name}.toml"));
    let request = Request {
        functions: vec![Function::InverseDynamics, Function::Gravity],
        plan: plan::file::beside(&file).unwrap(),
        sincos: sines,
        math: MathPath::of(library),
        ..Request::default()
    };
    let generated = generate(&support::robot(name), &request).unwrap();
    footprints(&generated, &TARGETS.iter().collect::<Vec<_>>())
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
        for (target, estimate) in &footprint.on {
            let Some(estimate) = estimate else {
                assert_eq!(
                    (target.name, footprint.scalar),
                    ("cortex-m4f", ScalarType::F64)
                );
                continue;
            };
            // It fits: what goes to the stack are sines, where calls keep nothing.
            let spills = if target.name == "x86-64" { 2 } else { 0 };
            assert_eq!(estimate.traffic.spills, spills, "{}", target.name);
        }
    }
}

/// Where f32 meets libm, it is said which processors suffer, once, and what to do;
/// what that is, is free of it.
#[test]
fn libm_in_f32_is_warned_of() {
    let libm = generated("planar2r", SinCos::Libm, Library::Libm);
    let all = warnings(&libm);
    assert_eq!(all.len(), 1, "{all:?}");
    for word in [
        "cortex-m4f",
        "f64",
        "--sincos together",
        "--sincos polynomial",
    ] {
        assert!(all[0].contains(word), "{word}: {}", all[0]);
    }
    let f64_alone: Vec<Footprint> = libm
        .into_iter()
        .filter(|f| f.scalar == ScalarType::F64)
        .collect();
    assert!(warnings(&f64_alone).is_empty());
    let polynomials = SinCos::Polynomial { error: None };
    for (sines, library) in [
        (SinCos::Together, Library::Together),
        (polynomials, Library::Libm),
    ] {
        let footprints = generated("planar2r", sines, library);
        assert!(warnings(&footprints).is_empty());
        for footprint in footprints.iter().filter(|_| sines == polynomials) {
            let path = &footprint.path;
            assert!(path.calls.is_empty() && path.branches() == "none");
            let f64 = footprint.scalar == ScalarType::F64;
            assert_eq!(path.f64(), if f64 { "all" } else { "none" });
        }
    }
}

/// What rustc 1.95.0 made of the PUMA's torques and gravity: instructions and bytes
/// of stack. The estimates stay as near as the documentation says.
#[test]
fn near_what_was_compiled() {
    use ScalarType::{F32, F64};
    type Compiled = (&'static str, ScalarType, [(usize, usize); 2]);
    let libm: &[Compiled] = &[
        ("cortex-m4f", F32, [(398, 184), (60, 64)]),
        ("cortex-m7", F32, [(311, 176), (53, 64)]),
        ("cortex-m7", F64, [(413, 416), (59, 80)]),
        ("aarch64", F32, [(438, 240), (73, 80)]),
        ("aarch64", F64, [(422, 368), (68, 80)]),
        ("x86-64", F32, [(515, 400), (74, 64)]),
        ("x86-64", F64, [(512, 512), (74, 80)]),
    ];
    let together: &[Compiled] = &[
        ("cortex-m4f", F32, [(400, 240), (62, 64)]),
        ("cortex-m7", F64, [(412, 496), (56, 144)]),
    ];
    let polynomial: &[Compiled] = &[
        ("cortex-m4f", F32, [(541, 168), (210, 72)]),
        ("cortex-m7", F32, [(437, 152), (191, 80)]),
        ("cortex-m7", F64, [(474, 392), (125, 80)]),
        ("aarch64", F64, [(496, 336), (137, 0)]),
    ];
    for (sines, library, compiled) in [
        (SinCos::Libm, Library::Libm, libm),
        (SinCos::Together, Library::Together, together),
        (
            SinCos::Polynomial { error: None },
            Library::Libm,
            polynomial,
        ),
    ] {
        let footprints = generated("puma560", sines, library);
        for (name, scalar, functions) in compiled {
            let of = footprints.iter().filter(|f| f.scalar == *scalar);
            for (footprint, (instructions, stack)) in of.zip(functions) {
                let on = footprint.on.iter().find(|(target, _)| target.name == *name);
                let estimate = on.unwrap().1.unwrap();
                let what = format!("{name} {scalar} {}: {estimate:?}", footprint.function);
                let ratio = *instructions as f64 / estimate.instructions as f64;
                let slack = if name.starts_with("cortex") {
                    0.12
                } else {
                    0.08
                };
                assert!((ratio - 1.0).abs() < slack, "{what}");
                let vectors = *name == "x86-64";
                let most = if vectors { 2.0 } else { 1.26 };
                let stack = *stack as f64;
                assert!(stack <= most * estimate.stack as f64, "{what}");
                assert!(vectors || stack >= 0.86 * estimate.stack as f64, "{what}");
            }
        }
    }
}

/// Rows that mean something: names once, no more kept than there are, and never more
/// registers in use than there are.
#[test]
fn targets_are_sound() {
    for (index, target) in TARGETS.iter().enumerate() {
        assert!(TARGETS[..index].iter().all(|t| t.name != target.name));
        assert!(!target.about.is_empty() && target.f32.is_some());
    }
    for footprint in generated("puma560", SinCos::Libm, Library::Libm) {
        for (target, estimate) in &footprint.on {
            let Some((unit, estimate)) = target.unit(footprint.scalar).zip(*estimate) else {
                continue;
            };
            assert!(unit.kept < unit.registers);
            assert!(estimate.traffic.registers <= unit.registers);
            assert!(estimate.traffic.slots <= estimate.traffic.spills);
            assert!(estimate.cycles >= 2 * footprint.depth);
        }
    }
}
