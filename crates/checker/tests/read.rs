//! The reader of text: what a name stands for is what a compiler takes it for.

use dalembert_checker::Fault;
use dalembert_checker::read::{Argument, Head, Symbols, Text};

const HEAD: &str = "static inline void arm_gravity(const double q[ARM_RESTRICT 2], \
                    double c[ARM_RESTRICT 1])\n{\nARM_UNFUSED\n";

fn read(lines: &str) -> Result<(), String> {
    let text = format!("{HEAD}{lines}\nc[0] = t1;\n}}\n");
    let head = Head {
        name: "gravity",
        is_single: false,
        arguments: vec![Argument {
            place: 0,
            name: "q",
            length: 2,
        }],
        fields: vec![("c", vec![1])],
        joints: 2,
    };
    let symbols = Symbols {
        macros: "ARM".into(),
        prefix: "arm".into(),
        single: "arm_gravity".into(),
        ..Symbols::default()
    };
    let text = Text::c(&text).unwrap();
    let read = text.function(&head, Some(&symbols), false);
    read.map(|_| ()).map_err(|fault| match fault {
        Fault::Text(_, reason) => reason,
        other => other.to_string(),
    })
}

fn refused(good: &str, changes: &[(&str, &str, &str)]) {
    assert_eq!(read(good), Ok(()));
    for (from, to, why) in changes {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good, "{from}");
        let reason = read(&text).unwrap_err();
        assert!(reason.contains(why), "{text}: {reason}");
    }
}

#[test]
fn polynomials_of_another_angle() {
    let polynomial = "const double x1_1 = q[0] * q[0];\nconst double x1_2 = x1_1 * 0.5;\n";
    let other = polynomial.replace("x1", "x2").replace("q[0]", "q[1]");
    let sine = "const double s1 = x1_2;\n";
    let result = "const double t1 = s1 * 0.5;";
    let good = format!("{polynomial}{sine}{other}const double s2 = x2_2;\n{result}");
    let between = format!("{other}{sine}");
    refused(
        &good,
        &[
            (sine, "", "neither a value nor a literal"),
            (sine, &between, "neither the angle"),
            (sine, "const double s1 = x2_2;\n", "neither the angle"),
            ("x1_2 = x1_1", "x1_2 = x2_1", "neither the angle"),
            ("x1_2 = x1_1", "x1_3 = x1_1", "not the next name"),
            ("q[0] * q[0]", "q[0] * q[1]", "another angle"),
        ],
    );
}

#[test]
fn sines_of_a_list_behind_the_call() {
    let list = "const double angles[1] = {q[1]};\n";
    let call = "double sines[1];\ndouble cosines[1];\narm_sines_1(&q[0], sines, cosines);\n";
    let good = format!("{call}const double s1 = sines[0];\nconst double t1 = s1 * 0.5;");
    let behind = format!("cosines);\n{list}");
    refused(
        &good.replace("s1", "s2").replace("&q[0]", "&q[1]"),
        &[("s2 = sines", "s1 = sines", "neither the angle")],
    );
    let listed = good.replace("&q[0]", "angles").replace("s1", "s2");
    let listed = format!("{list}{listed}");
    refused(
        &listed,
        &[
            (list, "", "as many angles"),
            ("angles[1]", "angles[2]", "as many angles"),
            ("arm_sines_1", "arm_sines_2", "`arm_sines_1` expected"),
            ("angles, sines", "&q[0], sines", "neither the angle"),
        ],
    );
    let other = listed.replace("angles, sines", "&q[0], sines");
    let late = other.replace(list, "").replace("cosines);\n", &behind);
    let reason = read(&late).unwrap_err();
    assert!(reason.contains("neither the angle"), "{reason}");
    // As many angles as nobody has need no room.
    let many = good.replace("[1]", "[99999999999]");
    let refusal = read(&many.replace("sines_1", "sines_99999999999")).unwrap_err();
    assert!(refusal.contains("as many angles"), "{refusal}");
}

#[test]
fn loops_over_limbs() {
    let good = "static const double k1[1][2] = {\n{0.5, -0.5},\n};\ndouble u1[1][2] = {\n{q[0], q[1]},\n};\n\
                double w1[1][2];\nfor (int l = 0; l < 2; ++l) {\nconst double t1 = u1[0][l] * k1[0][l];\n\
                w1[0][l] = t1;\n}\nconst double t1 = w1[0][0] + w1[0][1];";
    refused(
        good,
        &[
            ("k1[1][2]", "k1[2][2]", "as many numbers"),
            ("k1[1][2]", "k1[1][3]", "as many numbers"),
            ("{0.5, -0.5}", "{0.5}", "as many numbers"),
            ("double u1[1]", "const double u1[1]", "`=` expected"),
            ("{0.5, -0.5}", "{0.5, q[0]}", "an array of numbers"),
            // In C++ it would keep the value of the first call.
            ("}\nconst double", "}\nstatic const double", "`[` expected"),
            ("w1[1][2]", "w01[1][2]", "another name of an array"),
            ("w1[1][2]", "while[1][2]", "another name of an array"),
            // Octal numbers.
            ("double w1[1][2]", "double w1[01][2]", "lengths of an array"),
            ("double w1[1][2]", "double w1[1][02]", "lengths of an array"),
            ("l < 2", "l < 02", "a loop over lanes"),
            // In C the name behind the loop is another one.
            (
                "const double t1 = u1",
                "const double x1_1 = q[0] * 2.0;\nconst double t1 = u1",
                "polynomials stand before lanes",
            ),
            (
                "const double t1 = u1",
                "const double s1 = sin(q[0]);\nconst double t1 = u1",
                "sines are taken before lanes",
            ),
            ("for (", "ARM_FORGET(k1);\nfor (", "an array of lanes"),
            ("double w1[1][2]", "double w1[1][65]", "lengths of an array"),
            ("double w1[1][2]", "double w1[2][2]", "no lane writes"),
            (
                "double w1",
                "double w2[2048][64];\ndouble w1",
                "lengths of an array",
            ),
            (
                "double w1",
                "double w2[131072][1];\ndouble w1",
                "lengths of an array",
            ),
            ("l < 2", "l < 1", "a loop over lanes"),
            ("l < 2", "l < 3", "no index"),
            ("u1[0][l] *", "u1[1][l] *", "no index"),
            ("u1[0][l] *", "w1[0][l] *", "not written yet"),
            ("w1[0][l] = t1", "w1[0][0] = t1", "written twice"),
            ("w1[0][l] = t1", "w1[0][l] = t2", "neither a value"),
            ("w1[0][l] = t1;\n", "", "no lane writes"),
            ("w1[0][l] = t1", "w1[0][l] = -t1", "negated"),
            ("w1[0][0] +", "w1[0][l] +", "no index"),
            (
                "const double t1 = u1",
                "for (int l = 0; l < 2; ++l) {\n}\nconst double t1 = u1",
                "a loop over lanes",
            ),
        ],
    );
}
