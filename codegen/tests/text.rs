//! Reading emitted text back: what is no emitted function is refused with a line and a reason, and
//! in every language no change of a line passes for the program.

use dalembert_codegen::workspace::{
    Argument, Code, Fault, JointState, Library, Names, Signature, Sizes, Text,
};
use dalembert_codegen::{Function, GeneratedCode, Language, ScalarType};

use crate::support::{Case, changes, every_line_counts, rows};

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

fn signature(function: Function, arguments: &[Argument]) -> Signature<'_> {
    Signature {
        function,
        arguments,
        sizes: Sizes::whole(2),
        scalar: ScalarType::F64,
    }
}

fn read(text: &str) -> Result<Code, usize> {
    let signature = signature(Function::Gravity, &[Argument::Position]);
    Code::parse(text, &signature).map_err(|fault| match fault {
        Fault::Text(line, reason) if !reason.is_empty() => line,
        other => panic!("{other}"),
    })
}

const REFUSED: &str = "
1 | gravity → inertia
2 | (s1, c1) → (c1, s1)
3 | libm::cos → libm::tan … libm::cos → -libm::cos … libm::cos → other::cos … libm::cos → libm::cosf
3 | libm::cos(q[1]) → libm::cos(t1) … libm::cos(q[1]) → libm::cos(q[0])
4 | let t1 = c1 * 0.5; → let t1 = c1 * 0.5 … let t1 = → let t1: … 0.5 → 5 … 0.5 → 0.5x
5 | t1 - s1 → t1 % s1 … t1 - s1 → t1 - s1 - s1 … t1 - s1 → t9 - s1 … t1 - s1 → t1 - s2
6 | let t2 → let t3
7 | [t3, -t2] → [t3, -t4] … }↵ → ∅
8 | [t3, -t2] → [t3, -t2]↵    let t4 = t1 + t2;
";

const REFUSED_TOGETHER: &str = "
2 | dalembert_sines → libm … ([s1, _] → ([c1, _] … [c1, c2] → [c2, c1] … [c1, c2] → [c1, _]
2 | [q[0], q[1]] → [q[0]] … [q[0], q[1]] → [q[0], t1] … [q[0], q[1]] → [q[1], q[0]]
2 | sincos(& → sincosf(& … sincos(& → cos(& … q[1]]); → q[1]);
3 | ····let t1 → ····let s2 = libm::sin(q[1]);↵    let t1
";

#[test]
fn what_was_not_is_refused() {
    let together = together();
    for (text, table) in [(TEXT, REFUSED), (together.as_str(), REFUSED_TOGETHER)] {
        for [line, table] in rows(table) {
            for [from, to] in changes(&table) {
                let changed = text.replacen(&from, &to, 1);
                assert_ne!(changed, text, "{from}");
                let error_line = read(&changed).unwrap_err();
                assert_eq!(error_line.to_string(), line, "{from} → {to}");
            }
        }
    }
}

fn together() -> String {
    let alone = "    let (s1, c1) = libm::sincos(q[0]);\n    let c2 = libm::cos(q[1]);\n";
    let called = "    let ([s1, _], [c1, c2]) = dalembert_sines::sincos(&[q[0], q[1]]);\n";
    assert!(TEXT.contains(alone));
    TEXT.replacen(alone, called, 1)
}

#[test]
fn all_angles_together_are_read() {
    let together = read(&together()).unwrap();
    assert_eq!(together, read(TEXT).unwrap().calling(Library::Together));
    let q = [0.3f64, 1.1];
    let ([s1, _], [c1, c2]) = dalembert_sines::sincos(&q);
    let t2 = c1 * 0.5 - s1;
    let state = JointState::at_rest(q.to_vec());
    assert_eq!(together.run_at(&state), [c2 * t2, -t2]);
    assert!(together.run_at(&JointState::default()).is_empty());
}

/// D, h and c are arrays of one element type, in a bundle too: names in the wrong order compile.
#[test]
fn the_struct_at_the_end_is_read_with_its_names() {
    const GOOD: &str = "NAME {\nd: [[1.0, -q[0]], [3.0, 4.0],],\nh: [5.0, 6.0],\nc: [7.0, 8.0],\n}";
    const WRONG: &str = "
h: → c: … h: [5.0, 6.0],↵c: [7.0, 8.0] → c: [5.0, 6.0],↵h: [7.0, 8.0] … NAME → DynamicCoefficients
NAME {↵ → ∅ … [[1.0, -q[0]], [3.0, 4.0],] → [1.0, -q[0], 3.0, 4.0] … [3.0, 4.0] → [3.0]
5.0, 6.0 → 5.0 6.0 … 5.0, 6.0 → 5.0,, 6.0 … 8.0], → 8.0] … 8.0],↵} → 8.0],↵}↵0.0
";
    let bundle = Function::parse("equation=inertia+coriolis+gravity").unwrap();
    for (function, name) in [
        (Function::ManipulatorEquation, "ManipulatorEquation"),
        (bundle, "Equation"),
    ] {
        let read = |result: &str| {
            let result = result.replace("NAME", name);
            let head = "q: &[f64; 2], _qd: &[f64; 2]";
            let text = format!("pub fn {function}({head}) -> {name} {{\n{result}\n}}\n");
            let arguments = [Argument::Position, Argument::Velocity];
            Code::parse(&text, &signature(function, &arguments))
        };
        assert_eq!(read(GOOD).unwrap().dag.outputs.len(), 8);
        for [from, to] in changes(WRONG) {
            let text = GOOD.replacen(&from, &to, 1);
            assert_ne!(text, GOOD);
            assert!(read(&text).is_err(), "{text}");
        }
    }
}

#[test]
fn blocks_hand_on_what_they_say() {
    let before = |anchor: &str, more: &str| TEXT.replace(anchor, &format!("    {more}\n{anchor}"));
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

/// Robot files, what is asked, and every how manieth line changes; the first function is read.
const PRINTED: &str = "
planar3r stanford puma560 | inverse_dynamics | 7
planar3r stanford puma560 | manipulator_equation | 7
planar3r stanford puma560 | dynamic_coefficients | 7
puma560  | inverse_dynamics; scalar: f64; fma: on | 1
coulomb  | inverse_dynamics | 1
planar2r | inverse_dynamics; scalar: f64; batch: on; sincos: together | 1
planar2r | inverse_dynamics; scalar: f64; batch: on; sincos: libm | 1
planar2r | inverse_dynamics; scalar: f64; sincos: polynomial | 1
planar2r | inverse_dynamics; scalar: f32; sincos: together; language: c | 1
planar2r | inverse_dynamics; scalar: f32; sincos: libm; fma: on; language: c | 1
planar2r | inverse_dynamics; scalar: f32; sincos: polynomial; language: c | 1
planar2r | inverse_dynamics; scalar: f32; sincos: together; language: cuda | 1
planar2r | inverse_dynamics; scalar: f32; sincos: polynomial; language: cuda | 1
";

const CHANGES: &str = "
·+· → ·-· … ·-· → ·+· … ·*· → ·+· … qd[ → qdd[ … [0] → [1] … ; → ∅
";

const IN_RUST: &str = "
= t → = -t … sincos → cossin … qd[ → q[ … = s → = c … let t1 → let t2 … -t → t
0.0001 → 0.0002 … 0.0001 → 0.0001 + 0.0 … ] + → ] - … * qd[0] → * qd[1]
qd[0] * qd[0] → qd[1] * qd[1] … qd[0] * qd[0] → qdd[0] * qdd[0] … qd[0] * qd[0] + 0.0001 → qd[0]
sqrt → sqrtf … sqrt → cbrt … 1.0 / → 2.0 / … 1.0 /· → ∅ … r1 → r3
(s1, c1) = → (s2, c2) = … (s1, c1) = → (c1, s1) = … sincos(q[1]) → sincos(q[0])
libm::sincos(q[0]) → crate::tancot(q[0]) … q[1].both(libm::sincos) → q[0].both(libm::sincos)
sincos(&[q[0], q[1]]) → sincos(&[q[1], q[0]])
let ([s1, s2], [c1, c2]) = → let ([c1, c2], [s1, s2]) =
let x2 → let x3 … x1 → x2
entries[0..2] → entries[2..4] … let q = &entries → let qd = &entries … = entries[0] → = entries[1]
&[s1, s2]: &[V; 2] → &[s2, s1]: &[V; 2] … &[c1, c2]: &[V; 2] → &[c1, s2]: &[V; 2]
[entries[0], entries[1]] → [entries[1], entries[0]] … Columns(qd), → Columns(q),
qd: &[&[f64]; 2], qdd: &[&[f64]; 2] → qdd: &[&[f64]; 2], qd: &[&[f64]; 2]
of.all(9.81) → of.all(9.82) … <InverseDynamicsBatch → <ForwardDynamicsBatch
";

const IN_C: &str = "
=· → = - … F → ∅ … F; → e1F; … const· → ∅ … float → double … t1· → t2· … s1 → c1
fmaf( → fma( … fmaf( → fmaf(- … ,· → , - … sin → cos … cosf → cos … x1_ → x2_
_MULF( → _MUL( … DALEMBERT_MULF( → ( … static· → ∅ … __device__· → ∅
";

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

fn unfused(line: &str) -> Option<[String; 5]> {
    let (name, value) = line.split_once(" = ")?;
    let (left, rest) = value.split_once(".mul_add(")?;
    let (right, addend) = rest.strip_suffix(");").unwrap().split_once(", ").unwrap();
    let bare = left.trim_start_matches("(-").trim_end_matches(')');
    let minus = match left == bare {
        true => format!("(-{left})"),
        false => bare.to_owned(),
    };
    let positive = addend.strip_prefix('-').map(str::to_owned);
    let negated = positive.unwrap_or_else(|| format!("-{addend}"));
    Some([
        format!("{name} = {left}.mul_add({addend}, {right});"),
        format!("{name} = {bare} * {right};"),
        format!("{name} = {left}.mul_add({right}, {negated});"),
        format!("{name} = {minus}.mul_add({right}, {addend});"),
        format!("{name} = {left}.mul_add({right}, {addend}) + 0.0;"),
    ])
}

fn passes(case: &Case, generated: &GeneratedCode, scalar: ScalarType, text: &str) -> bool {
    let (function, request) = (&generated.functions[0], &case.request);
    let code = function.code(scalar, request.sincos.library());
    let signature = Signature::of(&function.program, scalar);
    let names = Names::new(&request.module_name(case.robot()), request.language, scalar);
    let text = match request.language {
        Language::Rust => Text::rust(text),
        Language::C | Language::Cuda => Text::c(text),
    };
    let read = text.and_then(|text| Code::read(&text, &signature, &names, request.batch));
    read.is_ok_and(|read| read.difference(&code).is_none())
}

#[test]
fn every_change_of_a_line_is_found() {
    let [in_rust, in_c] = [IN_RUST, IN_C].map(|table| changes(&format!("{CHANGES}{table}")));
    let mut tried = [String::new(), String::new()];
    let tables = rows(PRINTED).into_iter();
    let cases = tables.flat_map(|[files, asked, every]| {
        let case = |file: &str| (Case::in_scene(file, "", &asked), every.parse().unwrap());
        files.split(' ').map(case).collect::<Vec<(Case, usize)>>()
    });
    for (case, every) in cases {
        let is_rust = case.request.language == Language::Rust;
        let [of_rust, of_c] = &mut tried;
        let function = format!("pub fn {}(", case.request.functions[0]);
        let (changes, head, tried) = match is_rust {
            true => (&in_rust, function.as_str(), of_rust),
            false => (&in_c, " void planar2r_f32_inverse_dynamics(", of_c),
        };
        let generated = case.generated();
        for (text, scalar) in generated.texts.iter().zip(&generated.scalars) {
            let start = text.lines().position(|line| line.contains(head)).unwrap();
            let mut lines = text.lines().skip(start);
            let length = lines.position(|line| line == "}").unwrap();
            let end = match case.request.batch {
                true => usize::MAX,
                false => start + length,
            };
            let is_same = |text: &str| passes(&case, &generated, *scalar, text);
            assert!(is_same(text) && length > 15, "{}", case.request.asked());
            let others = |index: usize, line: &str| {
                let is_own = (start..end).contains(&index) && (index - start).is_multiple_of(every);
                // Derives, and marks of arguments that are not read, are for compilers.
                let mut skipped = ["///", "#[", "(void)"].iter();
                if !is_own || skipped.any(|mark| line.contains(mark)) {
                    return Vec::new();
                }
                let mut others = vec![String::new()];
                // The name in a head in Rust is read; with a wrong one nobody's call compiles.
                if index > start || !is_rust {
                    *tried += &format!("{line}\n");
                    others.extend(changes.iter().map(|[from, to]| line.replacen(from, to, 1)));
                    others.extend(neighbours(line, *scalar));
                    others.extend(unfused(line).into_iter().flatten());
                }
                others
            };
            every_line_counts(text, |_| true, others, |text| !is_same(text));
        }
    }
    for (changes, tried) in [in_rust, in_c].iter().zip(&tried) {
        let mut changes = changes.iter();
        assert_eq!(changes.find(|[from, _]| !tried.contains(from)), None);
    }
    assert!(tried[0].matches(".mul_add(").count() > 40);
}
