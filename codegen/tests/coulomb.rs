//! Coulomb friction in what is generated: its torque by hand, robots that nobody chose, scenes that
//! drop it, texts that say something else, and what is refused.

use dalembert_codegen::workspace::{Code, Emitted, JointState, Library, Random, Runtime, Setup};
use dalembert_codegen::{Function, Generated, Request, ScalarType, generate};

use crate::support;
use crate::support::case::Case;
use crate::support::draw::Draw;

/// The force and the width of each joint of the arm, whose last one has no friction.
const FRICTION: [(f64, f64); 3] = [(2.5, 0.01), (14.0, 1.0 / 300.0), (0.0, 1.0)];

/// Returns the arm's file without friction.
fn smooth() -> String {
    let source = Case::source("coulomb", "");
    let lines = source.lines().filter(|line| !line.starts_with("coulomb"));
    lines.map(|line| format!("{line}\n")).collect()
}

fn in_f64<'g>(generated: &'g Generated, name: &str) -> &'g Emitted {
    let mut emitted = generated.emitted.iter();
    let is = |e: &&Emitted| e.function.name() == name && e.scalar == ScalarType::F64;
    emitted.find(is).unwrap()
}

/// The torques beside those of the arm without, in all velocities; forward dynamics
/// takes them of τ, passivity has them of v.
#[test]
fn torques_are_those_of_the_textbook() {
    let asked = "outputs: inverse_dynamics, passivity, forward_dynamics; scalar: f64";
    let case = Case::new("coulomb", "", asked);
    let (with, plain) = (case.generated(), Case::of(&smooth(), asked).generated());
    let run = |of: &Generated, name, state: &JointState| in_f64(of, name).run(state);
    for state in case.runtime(100, 0x636f_756c).1 {
        let friction = |v: &[f64]| -> Vec<f64> {
            let each = FRICTION.iter().zip(v).zip(&state.qd);
            each.map(|((&(force, width), v), qd)| force * v / qd.hypot(width))
                .collect()
        };
        let close = |own: &[f64], other: &[f64]| {
            let size = other.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            let mut pairs = own.iter().zip(other);
            pairs.all(|(own, other)| (own - other).abs() < 1e-12 * size)
        };
        for (name, v) in [("inverse_dynamics", &state.qd), ("passivity", &state.v)] {
            let rest = run(&plain, name, &state).into_iter().zip(friction(v));
            let sum: Vec<f64> = rest.map(|(x, f)| x + f).collect();
            assert!(
                close(&run(&with, name, &state), &sum),
                "{name} at {state:?}"
            );
        }
        let tau = state.tau.iter().zip(friction(&state.qd));
        let less = JointState {
            tau: tau.map(|(tau, f)| tau - f).collect(),
            ..state.clone()
        };
        let expected = run(&plain, "forward_dynamics", &less);
        assert!(
            close(&run(&with, "forward_dynamics", &state), &expected),
            "{state:?}"
        );
    }
}

/// Robots that nobody chose, both conventions: what reads friction is proved of each,
/// and h, which must not.
#[test]
fn random_robots_are_proved() {
    let functions = [
        Function::InverseDynamics,
        Function::Passivity,
        Function::ForwardDynamics,
        Function::Coriolis,
    ];
    let mut draw = Draw(Random::new(0x636f_756c));
    for _ in 0..if cfg!(debug_assertions) { 4 } else { 40 } {
        let mut robot = draw.robot(3);
        for joint in &mut robot.joints {
            if !draw.chance(3) {
                joint.coulomb = draw.milli(1, 20_000);
                joint.coulomb_width = draw.milli(1, 100);
            }
        }
        let own = generate(&robot, &Request::of(&functions)).unwrap_or_else(|e| panic!("{e}"));
        let mut states = Setup::whole(&robot).states(40, 0x636f_756c);
        support::case::slowed(&mut states);
        support::rounds_well(&own.emitted, &Runtime::new(&robot), &states, &robot);
    }
}

/// A joint that does not move has no friction, but its slope where it is at rest:
/// F/w + b.
#[test]
fn scenes_drop_what_does_not_move() {
    let asked = "outputs: inverse_dynamics, inverse_dynamics_derivatives";
    let still = "\n[scene.still]\nvelocity = \"zero\"\n";
    let still = Case::new("coulomb", still, &format!("{asked}; scene: still"));
    let (_, states) = still.runtime(1, 3);
    let still = still.generated();
    assert!(!still.text().contains("sqrt"));
    let slopes = in_f64(&still, "inverse_dynamics_derivatives").run(&states[0]);
    for (i, expected) in [2.5 / 0.01 + 0.3, 14.0 * 300.0, 0.05]
        .into_iter()
        .enumerate()
    {
        assert!((slopes[9 + 4 * i] - expected).abs() < 1e-10 * expected);
    }
    let held = "\n[scene.held]\nlock = { waist = 0.4 }\njoints = [\"slide\", \"wrist\"]\n";
    let held = Case::new("coulomb", held, &format!("{asked}; scene: held"));
    let text = held.generated().text();
    assert!(
        text.contains("let r2 = ") && !text.contains("let r1 = "),
        "{text}"
    );
}

/// The root stands where the arithmetic does, by the library of the sines; in columns once more,
/// by the crate of batches.
#[test]
fn roots_are_printed_once() {
    for (sincos, path) in [("libm", "libm"), ("together", "dalembert_sines")] {
        for batch in ["off", "on"] {
            let asked = format!("outputs: inverse_dynamics; sincos: {sincos}; batch: {batch}");
            let text = Case::new("coulomb", "", &asked).generated().text();
            for line in [
                format!("    let r1 = 1.0 / {path}::sqrt(qd[0] * qd[0] + 0.0001);\n"),
                format!("    let r2 = 1.0 / {path}::sqrtf(qd[1] * qd[1] + 1.1111111e-5);\n"),
            ] {
                assert_eq!(text.matches(&line).count(), 1, "{batch}: {line}\n{text}");
            }
        }
    }
}

/// Every word of the line counts.
#[test]
fn another_line_is_another_program() {
    let generated = Case::new("coulomb", "", "outputs: inverse_dynamics").generated();
    let (function, text) = (&generated.functions[0], generated.text());
    let is_program = |text: &str| {
        let read = Code::parse(text, function.function, ScalarType::F64);
        read.is_ok_and(|read| read.matches(&function.program, Library::Libm, &[]).is_ok())
    };
    let line = "let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.0001);";
    assert!(text.contains(line) && is_program(&text), "{text}");
    assert!(!is_program(&text.replacen(line, "", 1)));
    for (from, to) in [
        ("0.0001", "0.0002"),
        ("0.0001", "0.0001 + 0.0"),
        ("] +", "] -"),
        ("* qd[0]", "* qd[1]"),
        ("qd[0] * qd[0]", "qd[1] * qd[1]"),
        ("qd[0] * qd[0]", "qdd[0] * qdd[0]"),
        ("qd[0] * qd[0] + 0.0001", "qd[0]"),
        ("sqrt", "sqrtf"),
        ("sqrt", "cbrt"),
        ("1.0 /", "2.0 /"),
        ("1.0 / ", ""),
        ("r1", "r3"),
    ] {
        let other = line.replacen(from, to, 1);
        assert_ne!(other, line);
        assert!(!is_program(&text.replacen(line, &other, 1)), "{other}");
    }
}

/// What has no answer with friction says so, why, and the way around; what has no friction in it
/// is none of this.
#[test]
fn what_cannot_be_is_refused_by_name() {
    let limits = "limits = { position = [-1, 1], velocity = 2, acceleration = 9, torque = 90 }";
    let source = Case::source("coulomb", "").replace("mass =", &format!("{limits}\nmass ="))
        + "\n[scene.roughly]\ntolerance = { value = 0.1, relative_to = \"actuator\" }\n";
    let case = |asked: &str| Case::of(&source, asked);
    let why = case("outputs: inverse_dynamics; scene: roughly").refusal();
    for words in [
        "`inverse_dynamics`",
        "Coulomb friction",
        "no certified bound",
        "leave `coulomb` out",
    ] {
        assert!(why.contains(words), "{why}");
    }
    // Inside all limits nothing overflows.
    assert_eq!(
        case("outputs: inverse_dynamics").generated().warnings,
        [""; 0]
    );
    let rough = case("outputs: gravity; scene: roughly").generated();
    assert!(
        rough.functions[0]
            .admitted
            .as_ref()
            .is_some_and(|own| !own.certificates.is_empty())
    );
    let full = case("outputs: full_regressor").generated().text();
    assert!(full.contains("Armature and friction, viscous and Coulomb, have none."));
}
