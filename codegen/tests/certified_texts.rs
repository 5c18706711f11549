//! Files that a compiler reads otherwise than they look, and claims that a forger writes.

use dalembert_checker::certify::certify;
use dalembert_checker::identity::table::Function;
use serde_json::{Value, json};

use crate::certified::{Certified, refusal};
use crate::support::path;

/// Returns a file of the attacks on the checker.
fn attack(name: &str) -> String {
    std::fs::read_to_string(path(&format!("../checker/tests/data/attacks/{name}"))).unwrap()
}

/// Asserts that a text with one word changed is refused.
#[track_caller]
fn planted(own: &Certified, from: &str, to: &str) {
    assert!(own.text.contains(from), "{from}");
    let found = refusal(own.with(&own.text.replacen(from, to, 1)));
    assert!(found.is_some(), "{from} -> {to}");
}

/// Text that a C compiler reads otherwise than it looks: words of a header, and others.
const HEADERS: [[&str; 2]; 14] = [
    ["#ifndef P_H", "#define sin cos\n#ifndef P_H"],
    ["#include <math.h>", "#include <math.h>\n#define t1 0.0"],
    ["#include <math.h>", "#include \"math.h\""],
    [
        "#define P_UNFUSED _Pragma(\"STDC FP_CONTRACT OFF\")",
        "#define P_UNFUSED",
    ],
    ["\"no-tree-slp-vectorize\"", "\"fast-math\""],
    ["#ifdef __FAST_MATH__", "#ifdef __OTHER_MATH__"],
    [
        GRAVITY,
        "static inline double sin(double x)\n{\n    return x;\n}\nstatic inline void p_gravity(",
    ],
    [GRAVITY, "static double t9;\nstatic inline void p_gravity("],
    [GRAVITY, "typedef float p_t;\nstatic inline void p_gravity("],
    [
        GRAVITY,
        "/* a */ double t; /* b */\nstatic inline void p_gravity(",
    ],
    [
        " */\nstatic inline void p_gravity(",
        " * \\\n/\nstatic inline void p_gravity(",
    ],
    [
        " */\nstatic inline void p_gravity(",
        " *??/\n/\nstatic inline void p_gravity(",
    ],
    [GRAVITY, "#undef P_UNFUSED\nstatic inline void p_gravity("],
    ["#pragma GCC pop_options", "#pragma GCC push_options"],
];
const GRAVITY: &str = "static inline void p_gravity(";

/// The same in a function.
const FUNCTIONS: [[&str; 2]; 10] = [
    ["    P_UNFUSED\n", ""],
    ["const double t1 = ", "double t1 = "],
    [
        "const double t1 = ",
        "const double t1 = 0.0;\n    const double t1 = ",
    ],
    [" * 4.905;", " * 4.905F;"],
    [" * 14.715F;", " * 14.715;"],
    ["    c[0] = ", "    return;\n    c[0] = "],
    ["p_gravity(", "p_potential("],
    ["p_gravity(", "p_f32_gravity("],
    ["result->tau[0] = ", "result->tau[1] = "],
    ["result[P_RESTRICT 1]", "result[P_RESTRICT 2]"],
];

#[test]
fn headers_that_are_not_generated() {
    let asked = "gravity, servo=inverse_dynamics+gravity; scalar: f64, f32; name: p; language: c";
    let own = &Certified::all("planar2r", "", asked)[0];
    own.is_shown(4, asked);
    for [from, to] in HEADERS.iter().chain(&FUNCTIONS) {
        planted(own, from, to);
    }
}

/// No line of the functions that give sines, or of those that call a function at many states, can
/// go or say something else.
#[test]
fn lines_around_functions_that_are_something_else() {
    let step = if cfg!(debug_assertions) { 5 } else { 1 };
    for options in ["together", "together; batch: on"] {
        let asked = format!(
            "gravity, kinetic_energy, servo=inertia+gravity; scalar: f64; name: p; sincos: {options}; language: c"
        );
        let own = &Certified::all("planar2r", "", &asked)[0];
        own.is_shown(3, &asked);
        let count = own.changed(step, &AROUND, |line| {
            const OTHERS: [&str; 9] = [
                "const double t",
                "//",
                "/*",
                "*",
                "#",
                "}",
                "result",
                "c[",
                "return t",
            ];
            let words = line.trim();
            !words.is_empty() && !OTHERS.iter().any(|start| words.starts_with(start))
        });
        assert!(count > 60, "{count}");
    }
}

const AROUND: [[&str; 2]; 41] = [
    [";", " + 0.0;"],
    ["n + s", "s"],
    ["[s]", "[n + s]"],
    ["[s]", "[0]"],
    ["(2U * n)", "(3U * n)"],
    ["* n", "* s"],
    ["{q[s]", "{q[0]"],
    ["[0]", "[1]"],
    ["[1]", "[0]"],
    ["q_s", "qd_s"],
    ["(0, ", "(1, "],
    ["(1, ", "(0, "],
    ["far", "0"],
    ["_any", ""],
    ["_batch", ""],
    ["p_", "p_f32_"],
    ["gravity", "coriolis"],
    ["kinetic_energy", "momentum"],
    ["servo", "other"],
    ["double", "float"],
    ["const ", ""],
    ["s = 0U", "s = 1U"],
    ["s < n", "s <= n"],
    ["s < n", "s + 1U < n"],
    ["++s", "s += 2U"],
    ["4096.0", "8192.0"],
    [" && ", " || "],
    ["<=", ">="],
    ["continue", "break"],
    ["static inline", "inline"],
    ["P_SIMD", "P_UNFUSED"],
    ["_RESTRICT", "_OTHER"],
    ["{", "{ s += 1U;"],
    ["* ", "+ "],
    ["x1", "x2"],
    ["sin", "cos"],
    ["sines[0]", "sines[1]"],
    ["&q[0]", "&q[1]"],
    ["sines, cosines", "cosines, sines"],
    ["sines[2]", "sines[1]"],
    ["_sines_2", "_sines_1"],
];

/// What rustc would read otherwise, and constants that do not follow.
#[test]
fn items_that_are_not_generated() {
    let asked = "gravity, regressor, model=inertia+gravity; scalar: f64";
    let own = &Certified::all("planar2r", "", asked)[0];
    own.is_shown(3, asked);
    let first = "pub const N: usize = 2;";
    for item in [
        "use evil as libm;",
        "pub struct libm;",
        "mod libm {}",
        "macro_rules! f { () => {} }",
        "pub static T: f64 = 0.0;",
        "impl dalembert::Robot for Arm {}",
        "#[cfg(test)]",
        "pub fn gravity(q: &[f64; 2]) -> [f64; 2] {\n    [0.0, 0.0]\n}",
        "/* a */",
        "pub fn gravity\u{a0}() {}",
    ] {
        planted(own, first, &format!("{item}\n{first}"));
    }
    planted(own, first, "pub const N: usize = 3;");
    planted(own, "BASE_PARAMETERS: [f64; ", "BASE_PARAMETERS: [f32; ");
    let values = own.text.find("BASE_PARAMETERS: [").unwrap();
    let digit = values + own.text[values..].find("\n    ").unwrap() + 5;
    let other = if &own.text[digit..=digit] == "1" {
        "2"
    } else {
        "1"
    };
    let changed = format!("{}{other}{}", &own.text[..digit], &own.text[digit + 1..]);
    assert!(refusal(own.with(&changed)).is_some());
    planted(own, " BASE_PARAMETERS", " PASSIVITY_PARAMETERS");
}

/// The types of arguments that are no lists of joints, and the function that writes base
/// parameters in C, in which something else hides.
#[test]
fn what_stands_beside_functions_has_no_room() {
    let asked = "gravity; scalar: f64; parameters: payload, gravity";
    let own = &Certified::all("planar2r", "", asked)[0];
    own.is_shown(2, asked);
    for [from, to] in [
        ["[f64; 3]", "[f64; { use evil as libm; 3 }]"],
        ["[f64; 3]", "[f64; 4]"],
        ["&self.0", "&[0.0; 3]"],
        ["[0.0; 10]", "[1.0; 10]"],
        ["Payload([mass, x, y, z", "Payload([mass, y, x, z"],
    ] {
        assert!(own.text.contains(from), "{from}");
        let found = refusal(own.with(&own.text.replace(from, to)));
        assert!(found.is_some(), "{from} -> {to}");
    }
    let asked = "regressor; scalar: f64; name: p; language: c";
    let own = &Certified::all("planar2r", "", asked)[0];
    own.is_shown(1, asked);
    for [from, to] in [
        ["    pi[0] = ", "    pi[1] = "],
        ["    pi[0] = ", "    return;\n    pi[0] = "],
        ["pi[P_RESTRICT", "pi[Q_RESTRICT"],
        ["p_base_parameters(", "p_passivity_parameters("],
        ["p_base_parameters(double", "p_base_parameters(float"],
    ] {
        planted(own, from, to);
    }
    // A name that ends as the one of the box does is looked at.
    for (asked, name) in [
        ("gravity; scalar: f64", "gravity("),
        ("gravity; scalar: f64; name: p; language: c", "p_gravity("),
    ] {
        let own = &Certified::all("planar2r", "", asked)[0];
        let other = name.replace("gravity", "gravity_in_box");
        planted(own, name, &other);
        planted(own, name, &name.replace("gravity", "angles"));
    }
}

/// A name that is known means what the table says, at its frame.
#[test]
fn names_mean_what_they_say() {
    let named = |name: &str, result: &str| {
        let own = Function::named(name, &["q".to_owned()], &[result.to_owned()]);
        own.map(|_| ())
    };
    let other = |name: &str| Err(format!("`{name}` has other results"));
    assert_eq!(named("jacobian", "jacobian.jacobian"), Ok(()));
    assert_eq!(
        named("jacobian", "jacobian.jacobian@eye"),
        other("jacobian")
    );
    assert_eq!(named("jacobian_eye", "jacobian.jacobian@eye"), Ok(()));
    assert_eq!(
        named("jacobian_eye_local", "jacobian.jacobian@eye:local"),
        Ok(())
    );
    assert_eq!(
        named("jacobian_eye", "jacobian.jacobian@hand"),
        other("jacobian_eye")
    );
    assert_eq!(
        named("jacobian_eye", "jacobian.jacobian@eye:local"),
        other("jacobian_eye")
    );
    assert_eq!(named("task", "jacobian.jacobian@hand"), Ok(()));
}

/// Claims with keys that are not known, of another version, cut, too long, and of other programs.
#[test]
fn claims_that_are_not_written_by_a_generator() {
    let asked = "gravity, regressor; scalar: f64";
    let own = &Certified::all("planar2r", "", asked)[0];
    own.is_shown(2, asked);
    let with = |claim: &str| refusal(certify(&own.text, claim, &own.robot, None, None));
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut claim: Value = serde_json::from_str(&own.claim).unwrap();
        change(&mut claim);
        with(&claim.to_string()).expect("shown")
    };
    for (key, value, words) in [
        ("claim", json!(2), "version 2 is not known"),
        ("more", json!(1), "unknown field `more`"),
        ("constants", json!(["1e999999999"]), "is no constant"),
        (
            "constants",
            json!(["1".repeat(1_000_000)]),
            "is no constant",
        ),
        ("constants", json!(["nan"]), "is no constant"),
        ("constants", json!([]), "is not of a program"),
        ("constants", json!(["1*sin(1)^65"]), "is no constant"),
        (
            "constants",
            json!(angles(2000)),
            "sines of more than 1024 angles",
        ),
        ("functions", json!([]), "nothing is claimed of `gravity`"),
    ] {
        let why = changed(&|claim| claim[key] = value.clone());
        assert!(why.contains(words), "{key}: {why}");
    }
    let gravity = |key: &'static str, value: Value| {
        changed(&|claim| claim["functions"][0][key] = value.clone())
    };
    for (key, value, words) in [
        (
            "function",
            json!("inertia"),
            "nothing is claimed of `gravity`",
        ),
        ("scene", json!("other"), "nothing is claimed of `gravity`"),
        (
            "results",
            json!(["inertia.d"]),
            "`gravity` has other results",
        ),
        (
            "results",
            json!(["gravity.g"]),
            "there is no result `gravity.g`",
        ),
        (
            "results",
            json!(["gravity.c@eye"]),
            "`gravity` has other results",
        ),
        ("arguments", json!(["qdd"]), "not of the grammar"),
        ("arguments", json!(["x"]), "there is no argument `x`"),
        ("steps", json!("t1+t1"), "`t1+t1` is not of a program"),
        ("steps", json!("s1/c1 ".repeat(5000)), "more quotients"),
        ("steps", json!("s1*qd[0]"), "is not of a program"),
        ("steps", json!("s1*#0"), "is not of a program"),
        ("returns", json!("t1"), "operations and"),
    ] {
        let why = gravity(key, value);
        assert!(why.contains(words), "{key}: {why}");
    }
    let twice = changed(&|claim| {
        let own = claim["functions"][0].clone();
        claim["functions"].as_array_mut().unwrap().push(own);
    });
    assert!(twice.contains("stands there twice"), "{twice}");
    // Another name, and results that nothing is said of.
    let text = own.text.replace("pub fn gravity(", "pub fn pull(");
    let mut claim: Value = serde_json::from_str(&own.claim).unwrap();
    claim["functions"][0]["function"] = json!("pull");
    claim["functions"][0]["results"] = json!([]);
    let why = refusal(certify(&text, &claim.to_string(), &own.robot, None, None));
    assert!(why.unwrap().contains("`pull`: it has no results"));
    for cut in (0..own.claim.len() - 2).step_by(own.claim.len() / 40) {
        assert!(with(&own.claim[..cut]).is_some());
    }
    let deep = with(&"[".repeat(100_000)).unwrap();
    assert!(deep.starts_with("claim: "), "{deep}");
    let long = with(&" ".repeat(200 << 20)).unwrap();
    assert!(long.contains("more than"), "{long}");
}

/// Returns constants of as many angles.
fn angles(count: usize) -> Vec<String> {
    (1..=count).map(|k| format!("1*sin(1/{k})")).collect()
}

/// A constant that is off by a prime, or by a digit that no float has, in claim and text alike.
#[test]
fn constants_that_are_aimed_at_primes() {
    let own = &Certified::all("planar2r", "", "gravity; scalar: f64")[0];
    let text = own.claim.clone();
    let place = text.find("2943/200").expect("the constant 14.715");
    for off in [
        "14.7150000000000000001",
        "14.71500000000000000000000000000000000000000001",
    ] {
        let claim = format!(
            "{}{off}{}",
            &text[..place],
            &text[place + "2943/200".len()..]
        );
        let why = refusal(certify(&own.text, &claim, &own.robot, None, None)).unwrap();
        assert!(why.contains("is not that of the robot"), "{why}");
    }
}

/// Files that another checker took for right: sines of constants and of what is far, an item that
/// hides, another number of joints.
#[test]
fn files_of_attacks() {
    let pend = attack("pend.toml");
    let asked = "outputs: gravity, forward_dynamics; scalar: f64";
    let own = &Certified::of(&pend, None, asked)[0];
    own.is_shown(2, asked);
    for (name, words) in [
        ("ulp.rs", "not of the grammar: `q` expected"),
        ("far32.rs", "not of the grammar: `q` expected"),
        ("trait1.rs", "follow from the functions and the robot"),
        ("n1.rs", ""),
    ] {
        let report = own.with(&attack(name));
        let why = format!("{report:?}");
        assert!(
            why.contains(words) && refusal(report).is_some(),
            "{name}: {why}"
        );
    }
    let own = &Certified::of(&pend, None, &format!("{asked}; name: two; language: c"))[0];
    own.is_shown(2, asked);
    assert!(refusal(own.with(&attack("hide.h"))).is_some());
}

/// A joint whose rates have no limit is in no box: not in one of a claim where it stands still.
#[test]
fn joints_without_limits_have_no_tolerance() {
    let robot =
        std::fs::read_to_string(path("../checker/tests/data/attacks/r2_conf.toml")).unwrap();
    let own = &Certified::of(
        &robot,
        Some("pick"),
        "outputs: coriolis; scene: pick; scalar: f64",
    )[0];
    own.is_shown(own.report().unwrap().lines.len(), "pick");
    let other = robot.replacen("velocity = 2, ", "", 1);
    assert_ne!(other, robot);
    let why = refusal(certify(&own.text, &own.claim, &other, own.scene, None)).unwrap();
    assert!(why.contains("a tolerance needs the range of `qd`"), "{why}");
}

/// Who passes q̇ for q does so because a text has them in another order.
#[test]
fn arguments_have_their_order() {
    let named = |arguments: [&str; 2]| {
        let words = arguments.map(str::to_owned);
        Function::named("coriolis", &words, &["coriolis.h".to_owned()])
    };
    assert!(named(["q", "qd"]).is_ok());
    for others in [["qd", "q"], ["q", "q"]] {
        let why = named(others).unwrap_err();
        assert!(why.contains("another order"), "{why}");
    }
}

/// Whoever calls a function in a scene may give any number for a joint that is locked: one that is
/// added to a result, in text and claim, is refused, with a tolerance and without.
#[test]
fn joints_that_are_locked_are_not_read() {
    let tolerance = "velocity = [1, 1, 1], acceleration = [1, 1, 1] }; \
        tolerance = { value = 0.1, relative_to = \"range\" }";
    for more in ["", &format!("; box = {{ {tolerance}")] {
        let scene = format!("lock = {{ 2 = 0.3 }}{more}");
        let asked = "inverse_dynamics; scalar: f64; sincos: libm";
        let own = &Certified::all("planar3r", &scene, asked)[0];
        own.is_shown(own.report().unwrap().lines.len(), &scene);
        let mut claim: Value = serde_json::from_str(&own.claim).unwrap();
        let function = &mut claim["functions"][0];
        let [steps, returns] =
            ["steps", "returns"].map(|key| function[key].as_str().unwrap().to_owned());
        let count = steps.split(' ').count();
        let first = returns.split(' ').next().unwrap();
        assert!(first.starts_with('t'), "{first}");
        let [square, sum] = [count + 1, count + 2].map(|step| format!("t{step}"));
        function["steps"] = format!("{steps} qd[1]*qd[1] {first}+{square}").into();
        function["returns"] = returns.replacen(first, &sum, 1).into();
        let last = own.text.rfind(&format!("    [{first},")).unwrap();
        let text = format!(
            "{}    let {square} = qd[1] * qd[1];\n    let {sum} = {first} + {square};\n{}",
            &own.text[..last],
            own.text[last..].replacen(first, &sum, 1)
        );
        let found = certify(&text, &claim.to_string(), &own.robot, own.scene, None);
        let why = refusal(found).unwrap();
        assert!(why.contains("it reads a joint that is locked"), "{why}");
    }
}
