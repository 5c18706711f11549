//! Generated headers in C99: shown as the Rust text of the same robot is, and planted faults
//! are found.

use dalembert_checker::exact::{Line, Report, check};

use crate::support::file;

fn robot() -> String {
    file("generated/robots/planar2r.toml")
}

fn header() -> String {
    file("checker/tests/data/generated/planar2r.h")
}

fn report(source: &str) -> Report {
    check(source, &robot(), None).unwrap()
}

/// Compares what is found of each function: the same numbers, whichever language it is in.
fn is_same(header: &str, rust: &[&str]) {
    let header = report(&file(header));
    let rust: Vec<Line> = rust
        .iter()
        .flat_map(|path| report(&file(path)).lines)
        .collect();
    assert!(header.is_shown(), "{header:?}");
    assert_eq!(header.lines.len(), rust.len(), "{header:?}");
    for (own, other) in header.lines.iter().zip(&rust) {
        let [found, expected] = [own, other].map(|line| *line.result.as_ref().unwrap());
        assert_eq!(own.name, other.name);
        assert_eq!(found.unit, expected.unit, "{}", own.name);
        assert_eq!(found.edits, expected.edits, "{}", own.name);
        assert_eq!(found.rounding, expected.rounding, "{}", own.name);
        assert_eq!(found.seen, expected.seen, "{}", own.name);
    }
}

#[test]
fn verdicts_are_those_of_rust() {
    is_same(
        "checker/tests/data/generated/planar2r.h",
        &[
            "generated/robots/planar2r.rs",
            "generated/robots/planar2r_f32.rs",
        ],
    );
    let modules: Vec<String> = report(&header())
        .lines
        .into_iter()
        .map(|l| l.module)
        .collect();
    assert_eq!(modules[..6], ["planar2r"; 6]);
    assert_eq!(modules[6..], ["planar2r_f32"; 6]);
}

/// Sines by polynomials, in functions whose names are shortened, with fused products.
#[test]
fn polynomials_and_fused_products() {
    let [header, rust] =
        ["h", "rs"].map(|kind| format!("checker/tests/data/generated/planar2r-polynomial.{kind}"));
    is_same(&header, &[&rust]);
}

/// Sines of all angles by one call of a function of the header.
#[test]
fn sines_of_the_headers_own() {
    let [header, rust] =
        ["h", "rs"].map(|kind| format!("checker/tests/data/generated/planar2r-together.{kind}"));
    is_same(&header, &[&rust]);
    let source = file(&header);
    let listed = "    const double angles[2] = {q[0], q[1]};\n    double sines[2];\n";
    let listed = source.replace("    double sines[2];\n", listed);
    let listed = listed.replace("_sines_2(&q[0], ", "_sines_2(angles, ");
    let is_double = |line: &&Line| line.module == "planar2r";
    let shown = |source: &str| {
        let found = report(source).lines;
        let found = found.iter().filter(is_double);
        let found = found.filter(|line| line.result.as_ref().is_ok_and(|own| own.is_shown()));
        found.count()
    };
    assert_eq!((shown(&source), shown(&listed)), (6, 6));
    for (text, from, to) in [
        (&source, "s1 = sines[0]", "s1 = sines[1]"),
        (&source, "s1 = sines[0]", "s1 = cosines[0]"),
        (&source, "s1 = sines[0]", "s1 = sines[2]"),
        (&source, "sines_2(&q[0]", "sines_2(&q[1]"),
        (&source, "sines_2(&q[0]", "sines_1(&q[0]"),
        (&source, "sines_2(&q[0]", "f32_sines_2(&q[0]"),
        (&source, "sines_2(&q[0]", "sines_2(&qd[0]"),
        (
            &source,
            "sines_2(&q[0], sines, cosines)",
            "sines_2(&q[0], cosines, sines)",
        ),
        (&source, "    double sines[2];\n", ""),
        (&source, "    double sines[2];", "    double sines[1];"),
        (&source, "    double sines[2];", "    float sines[2];"),
        (&source, "    double cosines[2];", "    double cosines[1];"),
        (&listed, "{q[0], q[1]}", "{q[1], q[0]}"),
        (&listed, "{q[0], q[1]}", "{q[0], qd[1]}"),
        (&listed, "angles[2] = {q[0], q[1]}", "angles[1] = {q[0]}"),
    ] {
        let start = text.find("void planar2r_gravity(").unwrap();
        assert!(text[start..].contains(from), "{from}");
        let changed = text[start..].replacen(from, to, 1);
        let changed = format!("{}{changed}", &text[..start]);
        assert_eq!(shown(&changed), 5, "{to}");
    }
}

/// No line of the function that gives sines can go or say something else.
#[test]
fn sines_that_are_something_else() {
    let source = file("checker/tests/data/generated/planar2r-together.h");
    let lines: Vec<&str> = source.lines().collect();
    for head in [" planar2r_sines_2(", " planar2r_f32_sines_1("] {
        let first = lines.iter().position(|line| line.contains(head)).unwrap();
        let last = first + lines[first..].iter().position(|line| *line == "}").unwrap();
        for index in first - 3..=last {
            let line = lines[index];
            let mut others = vec![String::new(), line.replacen(' ', " 1 + ", 5)];
            for (from, to) in [
                ("* ", "+ "),
                ("x", "x1"),
                ("1", "2"),
                (";", "F;"),
                ("sin", "cos"),
            ] {
                others.push(line.replacen(from, to, 1));
            }
            let is_other = |other: &&String| other.trim() != line.trim();
            for other in others
                .iter()
                .filter(is_other)
                .filter(|_| !line.contains("/*"))
            {
                let mut changed = lines.clone();
                changed[index] = other;
                let found = check(&changed.join("\n"), &robot(), None);
                assert!(found.is_err(), "{line} -> {other}");
            }
        }
    }
}

/// One literal, operator, operand or result changed: what it was is shown no more.
#[test]
fn functions_that_are_something_else() {
    let source = header();
    for (name, from, to) in [
        ("inverse_dynamics", "* 14.715", "* 14.7150001"),
        ("inverse_dynamics", " = sin(q[1])", " = sin(q[0])"),
        ("gravity", "t1 - t2", "t1 + t2"),
        ("gravity", "c[0] = t6", "c[0] = t4"),
        ("gravity", "cos(q[0])", "sin(q[0])"),
        ("inertia", "d[1] = -t3", "d[1] = t3"),
        ("coriolis", "qd[0] *", "qd[1] *"),
        ("f32_gravity", "14.715F", "14.915F"),
        ("f32_manip_eq", "c2", "s2"),
        ("f32_dynamic_coef", "h[4] = ", "h[5] = "),
    ] {
        let start = source.find(&format!("planar2r_{name}(")).unwrap();
        let end = start + source[start..].find("\n}\n").unwrap();
        let body = &source[start..end];
        assert!(body.contains(from), "{name}: {from}");
        let changed = body.replacen(from, to, 1);
        let whole = format!("{}{changed}{}", &source[..start], &source[end..]);
        let found = report(&whole);
        let shown = found.lines.iter().filter(|line| {
            let result = line.result.as_ref();
            result.is_ok_and(|distance| distance.is_shown())
        });
        assert_eq!(shown.count(), 11, "{name}, {from}: {found:?}");
    }
}

/// Text that a C compiler would read otherwise than it looks.
#[test]
fn headers_that_are_not_generated() {
    let source = header();
    let gravity = "static inline void planar2r_gravity(";
    for (from, to) in [
        ("#ifndef PLANAR2R_H", "#define sin cos\n#ifndef PLANAR2R_H"),
        ("#include <math.h>", "#include <math.h>\n#define t1 0.0"),
        ("#include <math.h>", "#include \"math.h\""),
        (
            "#define PLANAR2R_UNFUSED _Pragma(\"STDC FP_CONTRACT OFF\")",
            "#define PLANAR2R_UNFUSED",
        ),
        (
            "#pragma GCC optimize (\"fp-contract=off\", \"no-tree-slp-vectorize\")",
            "#pragma GCC optimize (\"fast-math\")",
        ),
        (
            gravity,
            "static inline double sin(double x)\n{\n    return x;\n}\nstatic inline void planar2r_gravity(",
        ),
        (
            gravity,
            "static double t9;\nstatic inline void planar2r_gravity(",
        ),
        (
            gravity,
            "typedef float planar2r_t;\nstatic inline void planar2r_gravity(",
        ),
        (
            gravity,
            "/* a */ double t; /* b */\nstatic inline void planar2r_gravity(",
        ),
        (
            " */\nstatic inline void planar2r_gravity(",
            " * \\\n/\nstatic inline void planar2r_gravity(",
        ),
        (
            " */\nstatic inline void planar2r_gravity(",
            " *??/\n/\nstatic inline void planar2r_gravity(",
        ),
        (
            gravity,
            "static inline int planar2r_in_box(void)\n{\n    return 1;\n} double t;\nstatic inline void planar2r_gravity(",
        ),
        (
            gravity,
            "#undef PLANAR2R_UNFUSED\nstatic inline void planar2r_gravity(",
        ),
        ("#pragma GCC pop_options", "#pragma GCC push_options"),
    ] {
        assert!(source.contains(from), "{from}");
        let changed = source.replacen(from, to, 1);
        assert!(check(&changed, &robot(), None).is_err(), "{to}");
    }
    // In a function: refused for that function.
    for (from, to) in [
        ("    PLANAR2R_UNFUSED\n", ""),
        ("const double t1 = ", "double t1 = "),
        ("const double t1 = ", "const float t1 = "),
        (
            "const double t1 = ",
            "const double t1 = 0.0;\n    const double t1 = ",
        ),
        (" * 4.905;", " * 4.905F;"),
        (" * 4.905;", " / 4.905;"),
        ("    c[0] = ", "    c[1] = "),
        ("    c[0] = ", "    return;\n    c[0] = "),
    ] {
        let start = source.find(gravity).unwrap();
        assert!(source[start..].contains(from), "{from}");
        let changed = format!(
            "{}{}",
            &source[..start],
            source[start..].replacen(from, to, 1)
        );
        let found = report(&changed);
        let line = found
            .lines
            .iter()
            .find(|line| line.name == "gravity")
            .unwrap();
        assert!(line.result.is_err() && !found.is_shown(), "{to}: {found:?}");
    }
    // A literal of doubles would have f32 computed in doubles.
    let changed = source.replace("14.715F", "14.715");
    assert!(!report(&changed).is_shown());
}

/// Bundles: what is found is the same in both languages, and each result is held against the
/// quantity whose name it has.
#[test]
fn bundles() {
    let [header, rust] =
        ["h", "rs"].map(|kind| format!("checker/tests/data/generated/planar2r-bundle.{kind}"));
    is_same(&header, &[&rust]);
    let shown = |source: &str| {
        let lines = report(source).lines;
        let shown = |name: &str| {
            let mut own = lines.iter().filter(|line| line.name == name);
            own.all(|line| line.result.as_ref().is_ok_and(|found| found.is_shown()))
        };
        [shown("gravity"), shown("servo")]
    };
    for (path, changes) in [
        (
            &header,
            vec![
                ("result->tau[0] = ", "result->tau[1] = "),
                ("result->c[0] = ", "result->tau[0] = "),
                ("    double c[2];\n", "    float c[2];\n"),
                ("    double c[2];\n", "    double p[2];\n"),
                ("    double c[2];\n", ""),
                ("    double h[8];\n", "    double h[2];\n"),
                ("    double h[8];\n", "    double h[9];\n"),
                ("    double tau[2];\n", "    double y[2];\n"),
                ("planar2r_servo_t result[", "planar2r_other_t result["),
                ("result[PLANAR2R_RESTRICT 1]", "result[PLANAR2R_RESTRICT 2]"),
                (
                    "result[PLANAR2R_RESTRICT 1])",
                    "result[PLANAR2R_RESTRICT 1], double c[PLANAR2R_RESTRICT 2])",
                ),
            ],
        ),
        (
            &rust,
            vec![
                ("        tau: [", "        p: ["),
                ("        c: [", "        d: ["),
                ("        c: [", "        c: [-"),
            ],
        ),
    ] {
        let source = file(path);
        assert_eq!(shown(&source), [true; 2]);
        for (from, to) in changes {
            assert!(source.contains(from), "{from}");
            assert_eq!(shown(&source.replacen(from, to, 1)), [true, false], "{to}");
        }
    }
    // What none of the functions returns is named.
    let other = file(&header).replace("kinetic", "altitude");
    let found = report(&other).lines;
    let fault = found.iter().find_map(|line| line.result.as_ref().err());
    let fault = fault.unwrap().to_string();
    assert!(
        fault.contains("`servo` is not checked: it returns `altitude`"),
        "{fault}"
    );
}

/// Functions of many states: what is found is what Rust's functions of one have.
#[test]
fn batches() {
    let [header, rust] =
        ["h", "rs"].map(|kind| format!("checker/tests/data/generated/planar2r-batch.{kind}"));
    is_same(&header, &[&rust]);
    for name in ["columns", "columns-polynomial"] {
        let found = report(&file(&format!(
            "checker/tests/data/generated/planar2r-{name}.h"
        )));
        assert!(found.is_shown(), "{found:?}");
    }
}

/// Returns a header that has one function of another, with all that calls it.
fn alone(source: &str, name: &str) -> (String, String, String) {
    let start = |from: usize| {
        from + source[from..]
            .find("\nstatic inline void planar2r_")
            .unwrap()
    };
    let (first, own) = (
        start(0),
        source.find(&format!(" planar2r_{name}_any(")).unwrap(),
    );
    let own = source[..own].rfind("\nstatic").unwrap();
    let results = source.find(&format!("/* The results of planar2r_{name}."));
    let own = results.unwrap_or_else(|| source[..own].rfind("/*\n").unwrap());
    let end = own + source[own..].find(&format!("_{name}_batch(")).unwrap();
    let end = end + source[end..].find("\n}\n").unwrap() + 3;
    let behind = source.rfind("\n#if defined(__GNUC__)").unwrap();
    let parts = [&source[..first + 1], &source[own..end], &source[behind..]];
    parts.map(str::to_owned).into()
}

/// Refuses a header if any line around the calls of a function is missing or different.
#[test]
fn batches_that_are_something_else() {
    let source = file("checker/tests/data/generated/planar2r-batch.h");
    let is_shown = |source: &str| check(source, &robot(), None).is_ok_and(|own| own.is_shown());
    for name in ["gravity", "kinetic_energy", "servo"] {
        let (before, own, behind) = alone(&source, name);
        let with = |own: &str| format!("{before}{own}{behind}");
        assert!(is_shown(&with(&own)), "{name}");
        let lines: Vec<&str> = own.lines().collect();
        let first = lines
            .iter()
            .position(|line| line.contains("(const int far, "));
        for index in first.unwrap()..lines.len() {
            let line = lines[index];
            let is_other = |start: &&str| line.trim_start().starts_with(*start);
            if line.is_empty() || ["const double t", "/*", "*"].iter().any(is_other) {
                continue;
            }
            let mut others = vec![String::new(), line.replace(';', " + 0.0;")];
            for (from, to) in [
                ("n + s", "s"),
                ("[s]", "[n + s]"),
                ("[s]", "[0]"),
                ("(2U * n)", "(3U * n)"),
                ("* n", "* s"),
                ("{q[s]", "{q[0]"),
                ("[0]", "[1]"),
                ("[1]", "[0]"),
                ("q_s", "qd_s"),
                ("qd", "q"),
                ("tau", "d"),
                ("(0, ", "(1, "),
                ("(1, ", "(0, "),
                ("far", "0"),
                ("p1", "p2"),
                (".sin", ".cos"),
                ("_any", ""),
                ("_batch", ""),
                ("planar2r_", "planar2r_f32_"),
                ("gravity", "coriolis"),
                ("gravity", "coriolis_matrix"),
                ("kinetic_energy", "momentum"),
                ("servo", "other"),
                ("double", "float"),
                ("const ", ""),
                ("s = 0U", "s = 1U"),
                ("s < n", "s <= n"),
                ("s < n", "s + 1U < n"),
                ("++s", "s += 2U"),
                ("4096.0", "8192.0"),
                (" && ", " || "),
                ("<=", ">="),
                ("continue", "break"),
                ("flatten", "optimize(3)"),
                ("static inline", "inline"),
                ("PLANAR2R_SIMD", "PLANAR2R_UNFUSED"),
                ("_RESTRICT", "_OTHER"),
                ("{", "{ s += 1U;"),
                ("}", "} return;"),
            ] {
                others.push(line.replacen(from, to, 1));
            }
            for other in others.iter().filter(|other| *other != line) {
                let mut changed = lines.clone();
                changed[index] = other;
                assert!(
                    !is_shown(&with(&(changed.join("\n") + "\n"))),
                    "{line} -> {other}"
                );
            }
            // Neighbours in another order, where that is another text.
            let next = lines.get(index + 1).unwrap_or(&"");
            if !line.starts_with("    const ") && !next.is_empty() && next.trim() != line.trim() {
                let mut changed = lines.clone();
                changed.swap(index, index + 1);
                assert!(
                    !is_shown(&with(&changed.join("\n"))),
                    "{line} behind the next"
                );
            }
        }
    }
    // What calls a function is there, and so are the macros of loops.
    let (before, own, behind) = alone(&source, "gravity");
    let batch = own.rfind("/* planar2r").unwrap();
    assert!(!is_shown(&format!("{before}{}{behind}", &own[..batch])));
    let inner = "    return pair;";
    for (from, to) in [
        (inner, "    pair.sin = 0.0;\n    return pair;"),
        ("#include <stddef.h>\n", ""),
        (", \"no-tree-pre\"", ""),
        ("\"GCC ivdep\"", "\"GCC unroll 2\""),
        ("\"omp simd\"", "\"omp parallel for\""),
        ("defined(_OPENMP)", "1"),
    ] {
        let source = format!("{before}{own}{behind}");
        assert!(source.contains(from), "{from}");
        assert!(!is_shown(&source.replacen(from, to, 1)), "{to}");
    }
}
