//! Reading emitted text back: what is no emitted function is refused with a
//! line and a reason.

use dalembert_codegen::workspace::{
    Code, Difference, JointState, Library, Printed, write_function,
};
use dalembert_codegen::{Function, Program, Request, ScalarType, generate};

use crate::support;

const TEXT: &str = "\
pub fn gravity(q: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let c2 = libm::cos(q[1]);
    let t1 = c1 * 0.5;
    let t2 = t1 - s1;
    let t3 = c2 * t2;
    [t3, -t2]
}
";

fn read(text: &str) -> Result<Code, usize> {
    Code::parse(text, Function::Gravity, ScalarType::F64).map_err(|error| {
        assert!(!error.reason.is_empty());
        error.line
    })
}

#[test]
fn what_was_emitted_reads() {
    let program = read(TEXT).unwrap();
    let counts = program.counts();
    assert_eq!((counts.mul, counts.add, counts.sincos), (2, 1, 2));
    assert_eq!(program.dag.outputs.len(), 2);
    assert!(program.dag.outputs[1].negative);
}

/// Refuses a text with a change, at the line of the change.
fn refused(text: &str, changes: &[(&str, &str, usize)]) {
    for (from, to, line) in changes {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        assert_eq!(read(&changed), Err(*line), "{from} -> {to}");
    }
}

#[test]
fn what_was_not_is_refused() {
    refused(
        TEXT,
        &[
            ("gravity", "inertia", 1),
            ("let t1 = c1 * 0.5;", "let t1 = c1 * 0.5", 4),
            ("let t1 =", "let t1:", 4),
            ("let t2", "let t3", 5),
            ("t1 - s1", "t1 % s1", 5),
            ("t1 - s1", "t1 - s1 - s1", 5),
            ("t1 - s1", "t9 - s1", 5),
            ("t1 - s1", "t1 - s2", 5),
            ("0.5", "5", 4),
            ("0.5", "0.5x", 4),
            ("libm::cos", "libm::tan", 3),
            ("libm::cos(q[1])", "libm::cos(t1)", 3),
            ("libm::cos(q[1])", "libm::cos(q[0])", 3),
            ("libm::cos", "libm::cosf", 3),
            ("(s1, c1)", "(c1, s1)", 2),
            ("[t3, -t2]", "[t3, -t4]", 8),
            ("[t3, -t2]", "[t3, -t2]\n    let t4 = t1 + t2;", 8),
            ("}\n", "", 1),
        ],
    );
}

/// Returns the same function with all its angles in one call.
fn together() -> String {
    let alone = "    let (s1, c1) = libm::sincos(q[0]);\n    let c2 = libm::cos(q[1]);\n";
    let called = "    let ([s1, _], [c1, c2]) = dalembert_sines::sincos(&[q[0], q[1]]);\n";
    assert!(TEXT.contains(alone));
    TEXT.replacen(alone, called, 1)
}

/// One call for all angles is the same program but for the library, and its
/// sines are the library's to the last bit.
#[test]
fn all_angles_together_are_read() {
    let (alone, together) = (read(TEXT).unwrap(), read(&together()).unwrap());
    assert_eq!(together, alone.clone().calling(Library::Together));
    let differ = alone.difference(&together);
    assert_eq!(differ, Some(Difference::Library));
    assert_eq!(together.counts(), alone.counts());
    let q = [0.3f64, 1.1];
    let ([s1, _], [c1, c2]) = dalembert_sines::sincos(&q);
    let t2 = c1 * 0.5 - s1;
    let state = JointState {
        q: q.to_vec(),
        ..JointState::default()
    };
    assert_eq!(together.run_at(&state), [c2 * t2, -t2]);
    // Nothing is made up for an entry that a state lacks.
    assert!(together.run_at(&JointState::default()).is_empty());
}

#[test]
fn what_is_no_call_for_all_angles_is_refused() {
    refused(
        &together(),
        &[
            ("([s1, _]", "([c1, _]", 2),
            ("[c1, c2]", "[c2, c1]", 2),
            ("[c1, c2]", "[c1, _]", 2),
            ("[q[0], q[1]]", "[q[0]]", 2),
            ("[q[0], q[1]]", "[q[0], t1]", 2),
            ("[q[0], q[1]]", "[q[1], q[0]]", 2),
            ("sincos(&", "sincosf(&", 2),
            ("sincos(&", "cos(&", 2),
            ("q[1]]);", "q[1]);", 2),
            ("    let t1", "    let s2 = libm::sin(q[1]);\n    let t1", 3),
        ],
    );
}

/// D, h and c are arrays of one element type: names in the wrong order compile.
#[test]
fn the_struct_at_the_end_is_read_with_its_names() {
    let read = |result: &str| {
        let text = format!("pub fn manipulator_equation() -> M {{\n{result}\n}}\n");
        Code::parse(&text, Function::ManipulatorEquation, ScalarType::F64)
    };
    let good =
        "ManipulatorEquation {\nd: [[1.0, -q[0]], [3.0, 4.0]],\nh: [5.0, 6.0],\nc: [7.0, 8.0],\n}";
    assert_eq!(read(good).unwrap().dag.outputs.len(), 8);
    for (from, to) in [
        ("h:", "c:"),
        (
            "h: [5.0, 6.0],\nc: [7.0, 8.0]",
            "c: [5.0, 6.0],\nh: [7.0, 8.0]",
        ),
        ("ManipulatorEquation", "DynamicCoefficients"),
        ("ManipulatorEquation {\n", ""),
        ("[[1.0, -q[0]], [3.0, 4.0]]", "[1.0, -q[0], 3.0, 4.0]"),
        ("[3.0, 4.0]", "[3.0]"),
        ("5.0, 6.0", "5.0 6.0"),
        ("5.0, 6.0", "5.0,, 6.0"),
        ("8.0],", "8.0]"),
        ("8.0],\n}", "8.0],\n}\n0.0"),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good);
        assert!(read(&text).is_err(), "{text}");
    }
}

#[test]
fn blocks_hand_on_what_they_say() {
    let block = |head: &str, tail: &str| {
        TEXT.replace(
            "    let t1",
            &format!("    let {head} = {{\n        let t1"),
        )
        .replace(
            "    let t3",
            &format!("        {tail}\n    }};\n    let t3"),
        )
    };
    assert_eq!(read(&block("(t2,)", "(t2,)")), read(TEXT));
    assert!(read(&block("(t2,)", "(t1,)")).is_err());
    assert!(read(&block("(t1, t2,)", "(t2, t1,)")).is_err());
    let open = TEXT.replace("    let t1", "    let (t2,) = {\n    let t1");
    assert!(read(&open).is_err());
    let twice = TEXT.replace(
        "    let t1",
        "    let (t2,) = {\n    let (t2,) = {\n    let t1",
    );
    assert_eq!(read(&twice), Err(5));
}

/// Longer functions are printed in blocks, and read back: `generate` does.
#[test]
fn long_functions_are_in_blocks() {
    let panda = support::robot("panda");
    let text = support::one(&panda, Function::DynamicCoefficients).text();
    let most = text
        .split("= {\n")
        .map(|part| part.lines().take_while(|l| l.contains("let t")).count());
    assert!(most.max().unwrap() <= 1001);
    if text.matches("    let t").count() > 2 * 1000 {
        assert!(text.contains(",) = {\n"));
    }
}

#[test]
fn a_robot_is_generated_alike_every_time() {
    for name in support::dose(&["puma560", "panda"], 1) {
        let robot = support::robot(name);
        let text = || generate(&robot, &Request::default()).unwrap().text();
        assert!(text() == text(), "{name}");
    }
}

/// Returns the text of a program, and whether it passes for the program.
fn passes(program: &Program, scalar: ScalarType, text: &str) -> bool {
    Code::parse(text, program.function, scalar)
        .is_ok_and(|read| read.matches(program, Library::Libm, &[]).is_ok())
}

#[test]
fn every_slip_of_the_printer() {
    for (robot, program) in crate::disproved::programs() {
        for scalar in ScalarType::ALL {
            let code = program.code(scalar, Library::Libm, &[]);
            let text = write_function(&Printed::of(&program, &code), Library::Libm, &[]);
            assert!(passes(&program, scalar, &text));
            let lines: Vec<&str> = text.lines().collect();
            for (index, line) in lines.iter().enumerate().skip(2).step_by(7) {
                for changed in slips(line, scalar) {
                    let mut wrong = lines.clone();
                    wrong[index] = &changed;
                    let wrong = wrong.join("\n") + "\n";
                    let at = format!("{} {scalar}: {line} -> {changed}", robot.name);
                    assert!(!passes(&program, scalar, &wrong), "{at}");
                }
            }
        }
    }
}

/// Lists other lines that compile just as well.
fn slips(line: &str, scalar: ScalarType) -> Vec<String> {
    let mut slips = vec![String::new()];
    for (a, b) in [
        (" + ", " - "),
        (" - ", " + "),
        (" * ", " + "),
        ("sincos", "cossin"),
        ("qd[", "q["),
        ("= s", "= c"),
        ("let t1", "let t2"),
        ("-t", "t"),
    ] {
        if line.contains(a) {
            slips.push(line.replacen(a, b, 1));
        }
    }
    // Literals: the neighbours in the scalar.
    for word in line.split([' ', ';', ',', '[', ']']) {
        if !word.contains('.') || word.contains(':') {
            continue;
        }
        let Some(value) = scalar.parse(word) else {
            continue;
        };
        let next = match scalar {
            ScalarType::F64 => format!("{:?}", value.next_up()),
            ScalarType::F32 => format!("{:?}", (value as f32).next_down()),
        };
        slips.push(line.replacen(word, &next, 1));
    }
    slips
}
