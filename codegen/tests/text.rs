//! Reading emitted text back: what is no emitted function is refused with a line and a reason, and
//! in every language no change of a line passes for the program.

use dalembert_codegen::workspace::{
    Argument, Code, JointState, Library, Names, Signature, Sizes, Text, keep,
};
use dalembert_codegen::{Function, Generated, Language, ScalarType};

use crate::support::{Case, rows};

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

/// Returns what a function of two joints is called with, in doubles.
fn signature(function: Function, arguments: &[Argument]) -> Signature<'_> {
    Signature {
        function,
        arguments,
        sizes: Sizes::whole(2),
        scalar: ScalarType::F64,
    }
}

fn read(text: &str) -> Result<Code, usize> {
    let own = signature(Function::Gravity, &[Argument::Position]);
    Code::parse(text, &own).map_err(|error| {
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
            ("let t2", "let t3", 6),
            ("t1 - s1", "t1 % s1", 5),
            ("t1 - s1", "t1 - s1 - s1", 5),
            ("t1 - s1", "t9 - s1", 5),
            ("t1 - s1", "t1 - s2", 5),
            ("0.5", "5", 4),
            ("0.5", "0.5x", 4),
            ("libm::cos", "libm::tan", 3),
            ("libm::cos", "-libm::cos", 3),
            ("libm::cos", "other::cos", 3),
            ("libm::cos(q[1])", "libm::cos(t1)", 3),
            ("libm::cos(q[1])", "libm::cos(q[0])", 3),
            ("libm::cos", "libm::cosf", 3),
            ("(s1, c1)", "(c1, s1)", 2),
            ("[t3, -t2]", "[t3, -t4]", 7),
            ("[t3, -t2]", "[t3, -t2]\n    let t4 = t1 + t2;", 8),
            ("}\n", "", 7),
        ],
    );
    refused(
        &together(),
        &[
            ("dalembert_sines", "libm", 2),
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
    let differ = differ.map(|differ| differ.message);
    assert_eq!(differ.as_deref(), Some("the libraries of sines differ"));
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

/// D, h and c are arrays of one element type, in a bundle too: names in the wrong order compile.
#[test]
fn the_struct_at_the_end_is_read_with_its_names() {
    const GOOD: &str = "ManipulatorEquation {\nd: [[1.0, -q[0]], [3.0, 4.0],],\nh: [5.0, 6.0],\n\
                        c: [7.0, 8.0],\n}";
    const NAME: &str = "ManipulatorEquation";
    let bundle = Function::parse("equation=inertia+coriolis+gravity").unwrap();
    for (function, name) in [(Function::ManipulatorEquation, NAME), (bundle, "Equation")] {
        let read = |result: &str| {
            let result = result.replace(NAME, name);
            let head = "q: &[f64; 2], _qd: &[f64; 2]";
            let text = format!("pub fn {function}({head}) -> {name} {{\n{result}\n}}\n");
            let arguments = [Argument::Position, Argument::Velocity];
            Code::parse(&text, &signature(function, &arguments))
        };
        assert_eq!(read(GOOD).unwrap().dag.outputs.len(), 8);
        for (from, to) in [
            ("h:", "c:"),
            (
                "h: [5.0, 6.0],\nc: [7.0, 8.0]",
                "c: [5.0, 6.0],\nh: [7.0, 8.0]",
            ),
            (NAME, "DynamicCoefficients"),
            ("ManipulatorEquation {\n", ""),
            ("[[1.0, -q[0]], [3.0, 4.0],]", "[1.0, -q[0], 3.0, 4.0]"),
            ("[3.0, 4.0]", "[3.0]"),
            ("5.0, 6.0", "5.0 6.0"),
            ("5.0, 6.0", "5.0,, 6.0"),
            ("8.0],", "8.0]"),
            ("8.0],\n}", "8.0],\n}\n0.0"),
        ] {
            let text = GOOD.replacen(from, to, 1);
            assert_ne!(text, GOOD);
            assert!(read(&text).is_err(), "{text}");
        }
    }
}

#[test]
fn blocks_hand_on_what_they_say() {
    let before = |own: &str, more: &str| TEXT.replace(own, &format!("    {more}\n{own}"));
    let block = |head: &str, tail: &str| {
        let open = before("    let t1", &format!("let {head} = {{"));
        open.replace("    let t3", &format!("    {tail}\n    }};\n    let t3"))
    };
    assert_eq!(read(&block("(t2,)", "(t2,)")), read(TEXT));
    assert!(read(&block("(t2,)", "(t1,)")).is_err());
    assert!(read(&block("(t1, t2,)", "(t2, t1,)")).is_err());
    assert!(read(&before("    let t1", "let (t2,) = {")).is_err());
    let twice = before("    let t1", "let (t2,) = {\n    let (t2,) = {");
    assert_eq!(read(&twice), Err(5));
}

/// Arms that turn and slide, every kind of sines: with columns or without, the same program is
/// read.
#[test]
fn the_same_program_in_columns() {
    let few = "inverse_dynamics, manipulator_equation, kinetic_energy, forward_kinematics, \
               forward_dynamics";
    let one = "inverse_dynamics";
    for (name, outputs) in [("planar2r", few), ("planar3r", one), ("stanford", one)] {
        let case = |options: &str| Case::in_scene(name, "", &format!("{outputs}; {options}"));
        // Programs are searched for once, and proved and printed for each.
        let found = case("scalar: f64");
        let plan = keep(found.robot(), &found.request, &found.generated(), None).plan;
        for sincos in ["together", "libm", "polynomial"] {
            let [single, more] = ["off", "on"].map(|batch| {
                case(&format!("scalar: f64; sincos: {sincos}; batch: {batch}")).by(&plan)
            });
            assert!(single.functions.iter().all(|function| function.planned));
            assert!(!single.text().contains("_columns"));
            for (a, b) in single.emitted.iter().zip(&more.emitted) {
                assert_eq!(a.text.difference(&b.text), None, "{name} {sincos}");
            }
            // The arithmetic is there once more, over vectors.
            let lines = |text: &str| text.matches("    let t").count();
            assert_eq!(lines(&more.text()), 2 * lines(&single.text()));
            assert!(more.text().contains("pub fn inverse_dynamics_columns("));
        }
    }
}

/// Words of a line, and the words in their place.
type Change = (&'static str, &'static str);

/// Robot files, what is asked, of which the first function is read, and every how manieth line
/// changes.
const PRINTED: &str = "
planar3r stanford puma560 | inverse_dynamics | 7
planar3r stanford puma560 | manipulator_equation | 7
planar3r stanford puma560 | dynamic_coefficients | 7
puma560  | inverse_dynamics; scalar: f64; fma: on | 1
coulomb  | inverse_dynamics | 1
planar2r | inverse_dynamics; scalar: f64; batch: on; sincos: together | 1
planar2r | inverse_dynamics; scalar: f64; batch: on; sincos: libm | 1
planar2r | inverse_dynamics; scalar: f32; sincos: together; language: c | 1
planar2r | inverse_dynamics; scalar: f32; sincos: libm; fma: on; language: c | 1
planar2r | inverse_dynamics; scalar: f32; sincos: polynomial; language: c | 1
planar2r | inverse_dynamics; scalar: f32; sincos: together; language: cuda | 1
planar2r | inverse_dynamics; scalar: f32; sincos: polynomial; language: cuda | 1
";

/// Changes of a line in every language: nearly all compile, and give wrong numbers.
const CHANGES: [Change; 6] = [
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " + "),
    ("qd[", "qdd["),
    ("[0]", "[1]"),
    (";", ""),
];

/// Changes of a line in Rust: of the arithmetic, of roots, of calls for sines, and of columns.
const IN_RUST: [Change; 34] = [
    ("= t", "= -t"),
    ("sincos", "cossin"),
    ("qd[", "q["),
    ("= s", "= c"),
    ("let t1", "let t2"),
    ("-t", "t"),
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
    ("(s1, c1) =", "(s2, c2) ="),
    ("(s1, c1) =", "(c1, s1) ="),
    ("sincos(q[1])", "sincos(q[0])"),
    ("libm::sincos(q[0])", "crate::tancot(q[0])"),
    ("q[1].both(libm::sincos)", "q[0].both(libm::sincos)"),
    ("sincos(&[q[0], q[1]])", "sincos(&[q[1], q[0]])"),
    ("let ([s1, s2], [c1, c2]) =", "let ([c1, c2], [s1, s2]) ="),
    (
        "[q, _qd, _qdd]: &[[V; 2]; 3]",
        "[_qd, q, _qdd]: &[[V; 2]; 3]",
    ),
    ("&[s1, s2]: &[V; 2]", "&[s2, s1]: &[V; 2]"),
    ("&[c1, c2]: &[V; 2]", "&[c1, s2]: &[V; 2]"),
    ("        [q[0], q[1]]", "        [q[1], q[0]]"),
    ("([q, qd, qdd], results)", "([q, qdd, qd], results)"),
    (
        "qd: &[&[f64]; 2], qdd: &[&[f64]; 2]",
        "qdd: &[&[f64]; 2], qd: &[&[f64]; 2]",
    ),
    ("Vector<f64>>([q, qd, qdd]:", "Vector<f64>>([q, qdd, qd]:"),
    ("of.all(9.81)", "of.all(9.82)"),
    ("<InverseDynamicsBatch", "<ForwardDynamicsBatch"),
];

/// Changes of a line in C and CUDA.
const IN_C: [Change; 17] = [
    ("= ", "= -"),
    ("F", ""),
    ("F;", "e1F;"),
    ("const ", ""),
    ("float", "double"),
    ("t1 ", "t2 "),
    ("s1", "c1"),
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
];

/// Lists lines in place of one with a literal: with its neighbour in the scalar.
fn neighbours(line: &str, scalar: ScalarType) -> Vec<String> {
    let words = line.split([' ', ';', ',', '[', ']', '(', ')']);
    let literals = words.filter(|word| word.contains('.') && !word.contains(':'));
    // A header's literal of a float ends with its letter.
    let literals = literals.map(|word| word.trim_end_matches('F'));
    let values = literals.filter_map(|word| Some((word, scalar.parse(word)?)));
    let lines = values.map(|(word, value)| {
        let next = match scalar {
            ScalarType::F64 => format!("{:?}", value.next_up()),
            ScalarType::F32 => format!("{:?}", (value as f32).next_down()),
        };
        line.replacen(word, &next, 1)
    });
    lines.collect()
}

/// Lists lines in place of one with a fused product: factor and addend traded, without the addend,
/// each with another sign, and rounded once more.
fn unfused(line: &str) -> Vec<String> {
    let Some((name, value)) = line.split_once(" = ") else {
        return Vec::new();
    };
    let Some((left, rest)) = value.split_once(".mul_add(") else {
        return Vec::new();
    };
    let (right, addend) = rest.strip_suffix(");").unwrap().split_once(", ").unwrap();
    let bare = left.trim_start_matches("(-").trim_end_matches(')');
    let minus = if left == bare {
        format!("(-{left})")
    } else {
        bare.to_owned()
    };
    let negated = addend.strip_prefix('-').map(str::to_owned);
    let negated = negated.unwrap_or_else(|| format!("-{addend}"));
    vec![
        format!("{name} = {left}.mul_add({addend}, {right});"),
        format!("{name} = {bare} * {right};"),
        format!("{name} = {left}.mul_add({right}, {negated});"),
        format!("{name} = {minus}.mul_add({right}, {addend});"),
        format!("{name} = {left}.mul_add({right}, {addend}) + 0.0;"),
    ]
}

/// Returns whether a text is read as the first function in a scalar.
fn passes(case: &Case, generated: &Generated, scalar: ScalarType, text: &str) -> bool {
    let (function, request) = (&generated.functions[0], &case.request);
    let code = function.code(scalar, request.library());
    let signature = Signature::of(&function.program, scalar);
    let read = match request.language {
        Language::Rust => {
            Text::rust(text).and_then(|text| Code::read_rust(&text, &signature, request.batch))
        }
        language => {
            let names = Names::new(&request.module_name(case.robot()), language, scalar);
            Text::c(text).and_then(|text| Code::read_c(&text, &signature, &names, request.batch))
        }
    };
    read.is_ok_and(|read| read.difference(&code).is_none())
}

/// Lists the lines that may stand in place of one.
fn others(line: &str, scalar: ScalarType, changes: &[Change]) -> Vec<String> {
    let changes = changes.iter().filter(|(from, _)| line.contains(from));
    let changed = changes.map(|(from, to)| line.replacen(from, to, 1));
    let all = changed.chain(neighbours(line, scalar));
    all.chain(unfused(line)).collect()
}

/// No line can go, or say something else; each of these changes was tried.
#[test]
fn every_change_of_a_line_is_found() {
    let in_rust = [CHANGES.as_slice(), &IN_RUST].concat();
    let in_c = [CHANGES.as_slice(), &IN_C].concat();
    let mut tried = [String::new(), String::new()];
    let tables = rows(PRINTED).into_iter();
    let cases = tables.flat_map(|[files, asked, every]| {
        let case = |file: &str| (Case::in_scene(file, "", &asked), every.parse().unwrap());
        files.split(' ').map(case).collect::<Vec<(Case, usize)>>()
    });
    for (case, every) in cases {
        let asked = case.request.asked();
        let generated = case.generated();
        let [of_rust, of_c] = &mut tried;
        let (changes, head, tried) = match case.request.language {
            Language::Rust => (&in_rust, "pub fn ", of_rust),
            Language::C | Language::Cuda => (&in_c, " void planar2r_f32_inverse_dynamics(", of_c),
        };
        for (text, scalar) in generated.texts.iter().zip(&generated.scalars) {
            let lines: Vec<&str> = text.lines().collect();
            let start = lines.iter().position(|line| line.contains(head)).unwrap();
            let mut end = lines
                .iter()
                .skip(start)
                .position(|line| *line == "}")
                .unwrap()
                + start;
            if case.request.batch {
                end = lines.len();
            }
            let is_same = |lines: &[&str]| passes(&case, &generated, *scalar, &lines.join("\n"));
            assert!(is_same(&lines) && end - start > 15, "{asked}");
            for index in (start..end).step_by(every) {
                let line = lines[index];
                // What is derived, and that an argument is not read, is for compilers.
                let skipped = ["///", "#[", "(void)"]
                    .iter()
                    .any(|mark| line.contains(mark));
                if skipped || line.is_empty() {
                    continue;
                }
                let mut wrong = lines.clone();
                wrong.remove(index);
                assert!(!is_same(&wrong), "{asked}: without {line}");
                // Of a head in Rust its name is read; with a wrong one nobody's call compiles.
                if index == start && case.request.language == Language::Rust {
                    continue;
                }
                for changed in others(line, *scalar, changes) {
                    let mut wrong = lines.clone();
                    wrong[index] = &changed;
                    assert!(!is_same(&wrong), "{asked}: {line} -> {changed}");
                }
                *tried += line;
                tried.push('\n');
            }
        }
    }
    for (changes, tried) in [in_rust, in_c].iter().zip(&tried) {
        let mut changes = changes.iter();
        assert_eq!(changes.find(|(from, _)| !tried.contains(from)), None);
    }
    assert!(tried[0].matches(".mul_add(").count() > 40);
}
