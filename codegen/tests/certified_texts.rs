//! Files that a compiler reads otherwise than they look, and claims that a forger writes.

use dalembert_checker::identity::table::Function;
use serde_json::{Value, json};

use crate::certified::Certified;
use crate::certified_hidden::{hidden, steps_and_results};
use crate::support::{self, all_but_one_in, changes, daily_and_campaign, one_in, rows, says, text};

fn attack(name: &str) -> String {
    text(&format!("../crates/checker/tests/data/attacks/{name}"))
}

fn planar2r(asked: &str, count: usize) -> Certified {
    let file = Certified::planar2r(asked);
    file.is_shown(count, asked);
    file
}

const HEADERS: &str = r#"
#ifndef P_H → #define sin cos↵#ifndef P_H
#include <math.h> → #include <math.h>↵#define t1 0.0
#include <math.h> → #include "math.h"
#define P_UNFUSED _Pragma("STDC FP_CONTRACT OFF") → #define P_UNFUSED
"no-tree-slp-vectorize" → "fast-math"
#ifdef __FAST_MATH__ → #ifdef __OTHER_MATH__
#pragma GCC pop_options → #pragma GCC push_options
HEAD → static inline double sin(double x)↵{↵    return x;↵}↵HEAD
HEAD → static double t9;↵HEAD
HEAD → typedef float p_t;↵HEAD
HEAD → /* a */ double t; /* b */↵HEAD
HEAD → #undef P_UNFUSED↵HEAD
·*/↵HEAD → ·* \↵/↵HEAD
·*/↵HEAD → ·*??/↵/↵HEAD
"#;

const FUNCTIONS: &str = "
····P_UNFUSED↵ → ∅ … ····c[0] =· → ····return;↵····c[0] =· … const double t1 =· → double t1 =·
const double t1 =· → const double t1 = 0.0;↵    const double t1 =·
·* 4.905; → ·* 4.905F; … ·* 14.715F; → ·* 14.715;
p_gravity( → p_potential( … p_gravity( → p_f32_gravity(
result->tau[0] =· → result->tau[1] =· … result[P_RESTRICT 1] → result[P_RESTRICT 2]
#include <math.h>↵ → ∅ … }·p_servo → }·volatile p_servo
";

#[test]
fn headers_that_are_not_generated() {
    let asked = "gravity, servo=inverse_dynamics+gravity; scalar: f64, f32; name: p; language: c";
    let file = planar2r(asked, 4);
    file.refuses(&HEADERS.replace("HEAD", "static inline void p_gravity("));
    file.refuses(FUNCTIONS);
}

const AROUND: &str = "
; → ·+ 0.0; … n + s → s … [s] → [n + s] … [s] → [0] … (2U * n) → (3U * n) … * n → * s
{q[s] → {q[0] … [0] → [1] … [1] → [0] … q_s → qd_s … (0,· → (1,· … (1,· → (0,· … far → 0
_any → ∅ … _batch → ∅ … p_ → p_f32_ … gravity → coriolis … kinetic_energy → momentum
servo → other … double → float … const· → ∅ … s = 0U → s = 1U … s < n → s <= n
s < n → s + 1U < n … ++s → s += 2U … 4096.0 → 8192.0 … ·&&· → ·||· … <= → >= … continue → break … static inline → inline
P_SIMD → P_UNFUSED … _RESTRICT → _OTHER … { → { s += 1U; … *· → +· … x1 → x2 … sin → cos
sines[0] → sines[1] … &q[0] → &q[1] … sines, cosines → cosines, sines … sines[2] → sines[1]
_sines_2 → _sines_1
";

daily_and_campaign! {
    lines_around_functions_that_are_something_else: (one_in::<5>), (all_but_one_in::<5>);
}

fn lines_around_functions_that_are_something_else(is_tried: fn(usize) -> bool) {
    const OTHERS: &str = "const double t|//|/*|*|#|}|result|c[|return t";
    let is_around = |line: &str| {
        let words = line.trim();
        !words.is_empty() && !OTHERS.split('|').any(|start| words.starts_with(start))
    };
    for options in ["together", "together; batch: on"] {
        let asked = "gravity, kinetic_energy, servo=inertia+gravity; scalar: f64; name: p";
        let asked = format!("{asked}; sincos: {options}; language: c");
        let file = planar2r(&asked, 3);
        let count = file.every_line_counts(is_tried, AROUND, is_around);
        assert!(count > 60, "{count}");
    }
}

#[test]
fn items_that_are_not_generated() {
    let file = planar2r("gravity, regressor, model=inertia+gravity; scalar: f64", 3);
    for item in [
        "use evil as libm;",
        "pub struct libm;",
        "mod libm {}",
        "macro_rules! f { () => {} }",
        "pub static T: f64 = 0.0;",
        "impl dalembert::Robot for Arm {}",
        "#[cfg(test)]",
        "pub fn gravity(q: &[f64; 2]) -> [f64; 2] {↵    [0.0, 0.0]↵}",
        "/* a */",
        "pub fn gravity\u{a0}() {}",
    ] {
        let first = "pub const N: usize = 2;";
        file.refuses(&format!("{first} → {item}↵{first}"));
    }
    let constants = "
pub const N: usize = 2; → pub const N: usize = 3;
BASE_PARAMETERS: [f64;· → BASE_PARAMETERS: [f32;·
·BASE_PARAMETERS → ·PASSIVITY_PARAMETERS
";
    file.refuses(constants);
    let values = file.text.find("BASE_PARAMETERS: [").unwrap();
    let (before, values) = file.text.split_at(values);
    let changed = values.replacen("\n    ", "\n    1", 1);
    assert!(file.with(&format!("{before}{changed}")).refusal().is_some());
}

#[test]
fn what_stands_beside_functions_has_no_room() {
    let file = planar2r("gravity; scalar: f64; parameters: payload, gravity", 2);
    let table = "
[f64; 3] → [f64; { use evil as libm; 3 }] … [f64; 3] → [f64; 4] … &self.0 → &[0.0; 3]
[0.0; 10] → [1.0; 10] … Payload([mass, x, y, z → Payload([mass, y, x, z
Payload([f64; → Payload(pub [f64; … (mass >= 0.0) → (mass >= -1.0) … 0.5000005 → 1.0
";
    for [from, to] in changes(table) {
        says(&file.text, &from);
        let other = file.with(&file.text.replace(&from, &to));
        assert!(other.refusal().is_some(), "{from} → {to}");
    }
    let header = planar2r("regressor; scalar: f64; name: p; language: c", 1);
    let table = "
····pi[0] =· → ····pi[1] =· … ····pi[0] =· → ····return;↵····pi[0] =·
pi[P_RESTRICT → pi[Q_RESTRICT … p_base_parameters( → p_passivity_parameters(
p_base_parameters(double → p_base_parameters(float
";
    header.refuses(table);
    let asked = "gravity; scalar: f64; name: p; parameters: payload; language: c";
    let load_header = planar2r(asked, 2);
    let table = "
is_body = 0; → is_body = 1; … (mass >= 0.0) → (mass >= -1.0) … numbers[3]; → numbers[2];
payload[10]; → payload[11]; … p_load_t; → p_payload_t; … payload->payload[0] = mass → numbers[0] = mass
const p_load_t load[ → const double load[ … load->load[ → load->payload[
";
    load_header.refuses(table);
    // A name that ends as the one of the box does is looked at.
    for asked in ["", "; name: p; language: c"] {
        let file = planar2r(&format!("gravity; scalar: f64{asked}"), 1);
        let prefix = if asked.is_empty() { "" } else { "p_" };
        let name = format!("{prefix}gravity(");
        let others = ["gravity_in_box", "angles"].map(|other| name.replace("gravity", other));
        file.refuses(&format!("{name} → {} … {name} → {}", others[0], others[1]));
    }
}

#[test]
fn a_box_hides_nothing() {
    let asked = "gravity; scalar: f64; name: p; sincos: together; batch: on; language: c";
    let file = planar2r(asked, 1);
    let (before, behind) = file.text.split_at(file.text.rfind("#if ").unwrap());
    let evil =
        "static inline double p_evil_any(const int far, const double x)\n{\n    return x;\n}\n";
    let inside = "static inline int p_in_box(const double q[P_RESTRICT 2])\n{\n    int inside = 1;\n\
         \x20   return inside;\n}\n";
    let refusal = |item: &str| file.with(&format!("{before}{item}{behind}")).refusal();
    assert_eq!(refusal(inside), None);
    for hidden in [
        format!("{evil}{inside}"),
        inside.replace("{\n", "{\n    return 1;\n} double p_evil(double x) {\n"),
        inside.replace(")\n", "); double p_evil(double x)\n"),
        inside.replace("return inside", "return 1"),
        inside.replace(
            "    return",
            "    if (!((0.0 <= q<:0]) && (q<:0] <= 1.0))) {\n    return",
        ),
        inside.replace("_in_box", "_sines_2"),
    ] {
        assert!(refusal(&hidden).is_some(), "{hidden}");
    }
}

#[test]
fn names_mean_what_they_say() {
    let table = "
jacobian           | q    | jacobian.jacobian           |
jacobian           | q    | jacobian.jacobian@eye       | `jacobian` has other results
jacobian_eye       | q    | jacobian.jacobian@eye       |
jacobian_eye_local | q    | jacobian.jacobian@eye:local |
jacobian_eye       | q    | jacobian.jacobian@hand      | `jacobian_eye` has other results
jacobian_eye       | q    | jacobian.jacobian@eye:local | `jacobian_eye` has other results
task               | q    | jacobian.jacobian@hand      |
task               | q    | jacobian.jacobian@hand:x    |
task               | q    | jacobian.jacobian@:x        | there is no result `jacobian.jacobian@:x`
task               | q    | inverse_dynamics_with_wrench.tau@hand:x | there is no result `inverse_dynamics_with_wrench.tau@hand:x`
coriolis           | q qd | coriolis.h                  |
coriolis           | qd q | coriolis.h                  | its arguments are in another order
coriolis           | q q  | coriolis.h                  | its arguments are in another order
gravity            | q wrench  | gravity.c              | no result of it takes `wrench`
gravity            | q payload | gravity.c              | no result of it takes `payload`
task               | q    | forward_kinematics.pose@eye:local | there is no result `forward_kinematics.pose@eye:local`
task               | q qd qdd | reaction_wrenches.wrenches@eye | there is no result `reaction_wrenches.wrenches@eye`
";
    for [name, arguments, result, why] in rows(table) {
        let arguments: Vec<String> = arguments.split(' ').map(str::to_owned).collect();
        let function = Function::named(&name, &arguments, &[result]);
        assert_eq!(function.err().unwrap_or_default(), why, "{name}");
    }
}

/// A place in a claim, what stands there instead, and the refusal.
const CLAIMS: &str = r#"
NONE := nothing is claimed of `gravity`
/claim | 1 | version 1 is not known, 2 is: generate the file and its claim anew
/more | 1 | unknown field `more`
/constants | ["1e999999999"] | is not a constant
/constants | ["nan"] | is not a constant
/constants | ["1*sin(1)^65"] | is not a constant
/constants | [] | is not valid in a program
/functions | [] | NONE
/functions/0/function | "inertia" | NONE
/functions/0/scene | "other" | NONE
/functions/0/function | "x{}pub mod libm{}pub struct Y" | is not the name of a function
/functions/0/results | ["gravity.c", "gravity.c"] | is there twice
/functions/0/results | ["inertia.d"] | `gravity` has other results
/functions/0/results | ["gravity.c@eye"] | there is no result `gravity.c@eye`
/functions/0/results | ["gravity.g"] | there is no result `gravity.g`
/functions/0/arguments | ["qdd"] | no result of it takes `qdd`
/functions/0/arguments | [] | is not valid in a program
/functions/0/arguments | ["x"] | there is no argument `x`
/functions/0/steps | "t1+t1" | `t1+t1` is not valid in a program
/functions/0/steps | "s1*qd[0]" | is not valid in a program
/functions/0/steps | "s1*#0" | is not valid in a program
/functions/0/returns | "t1" | operations and
"#;

#[test]
fn claims_that_are_not_written_by_a_generator() {
    let file = planar2r("gravity, regressor; scalar: f64", 2);
    let honest = file.json();
    let refused = |place: &str, value: Value, words: &str| {
        let mut claim = honest.clone();
        let (parent, key) = place.rsplit_once('/').unwrap();
        claim.pointer_mut(parent).unwrap()[key] = value;
        file.with_claim(&claim).is_refused(words);
    };
    for [place, value, words] in rows(CLAIMS) {
        refused(&place, serde_json::from_str(&value).unwrap(), &words);
    }
    let long = "1".repeat(1_000_000);
    refused("/constants", json!([long]), "is not a constant");
    let angles: Vec<String> = (1..=2000).map(|k| format!("1*sin(1/{k})")).collect();
    refused("/constants", json!(angles), "more than 1024 angles");
    let terms = json!(vec!["1+".repeat(16_000) + "1"; 9]);
    refused("/constants", terms, "more than 131072 terms");
    let quotients = "s1/c1 ".repeat(5000);
    refused("/functions/0/steps", json!(quotients), "more quotients");
    let gravity = &honest["functions"][0];
    let twice = json!([gravity, gravity]);
    refused("/functions", twice, "is defined twice");
    let other = file.with(&file.text.replace("pub fn gravity(", "pub fn pull("));
    let mut claim = honest.clone();
    claim["functions"][0]["function"] = json!("pull");
    claim["functions"][0]["results"] = json!([]);
    other
        .with_claim(&claim)
        .is_refused("`pull`: it has no results");
    for cut in (0..file.claim.len() - 2).step_by(file.claim.len() / 40) {
        file.with_claim(&&file.claim[..cut]).is_refused("");
    }
    let deep = file.with_claim(&"[".repeat(100_000)).refusal().unwrap();
    assert!(deep.starts_with("claim: "), "{deep}");
    file.with_claim(&" ".repeat(200 << 20))
        .is_refused("more than");
}

#[test]
fn constants_that_are_aimed_at_primes() {
    let file = planar2r("gravity; scalar: f64", 1);
    assert!(file.claim.contains("2943/200"), "the constant 14.715");
    for zeros in [18, 40] {
        let constant = format!("14.715{}1", "0".repeat(zeros));
        let other = file.with_claim(&file.claim.replacen("2943/200", &constant, 1));
        other.is_refused("is not that of the robot");
    }
}

#[track_caller]
fn with_changes(file: &Certified, texts: &[[&str; 2]], claims: &[[&str; 2]]) -> Certified {
    let changed = |text: &str, changes: &[[&str; 2]]| {
        changes.iter().fold(text.to_owned(), |text, [from, to]| {
            says(&text, from);
            text.replacen(from, to, 1)
        })
    };
    let other = file.with(&changed(&file.text, texts));
    other.with_claim(&changed(&file.claim, claims))
}

#[test]
fn programs_that_lose_what_they_compute() {
    let cancelled = ["x+{1e40}", "u1-{1e40}"];
    let overflown = ["x*{1e200}", "u1*{1e200}", "u2/{1e200}", "u3/{1e200}"];
    let dynamics = planar2r("forward_dynamics; scalar: f64", 1);
    for more in [&cancelled[..], &overflown] {
        let why = hidden(&dynamics, more).refusal().expect("shown");
        let mut reasons = ["may hide a number", "has no bound"].iter();
        assert!(reasons.any(|reason| why.contains(reason)), "{why}");
    }
    let gravity = planar2r("gravity; scalar: f64; sincos: polynomial", 1);
    hidden(&gravity, &cancelled).is_refused("has a bound of");
    let asked = "outputs: inverse_dynamics; scalar: f64; parameters: payload";
    let slide = Certified::shown(SLIDE, None, asked, 2);
    let text = [
        ["payload[0] + 1.0", "payload[0] + 1e17"],
        [
            "let t1 = qdd[0] * load[0];\n    [t1]",
            "let t1 = load[0] - 1e17;\n    let t2 = t1 + 1.0;\n    let t3 = qdd[0] * t2;\n    [t3]",
        ],
    ];
    let claims = [
        ["],\"functions", ",\"1e17\"],\"functions"],
        ["payload[0]+#0", "payload[0]+#1"],
        [
            "qdd[0]*load[0]\",\"returns\":\"t1",
            "load[0]-#1 t1+#0 qdd[0]*t2\",\"returns\":\"t3",
        ],
    ];
    with_changes(&slide, &text, &claims).is_refused("has a bound of");
    let text =
        "payload[0] * 1.7e308;\n    let t2 = t1 / 1.7e308;\n    let t3 = t2 + 1.0;\n    Load([t3])";
    let text = [["payload[0] + 1.0;\n    Load([t1])", text]];
    let claims = [
        ["],\"functions", ",\"17e307\"],\"functions"],
        [
            "payload[0]+#0\",\"returns\":\"t1",
            "payload[0]*#1 t1/#1 t2+#0\",\"returns\":\"t3",
        ],
    ];
    with_changes(&slide, &text, &claims).is_refused("");
    // Without what computes it, nobody knows which load a function takes.
    let (before, behind) = slide.text.split_once("pub fn load(").unwrap();
    let (_, behind) = behind.split_once("pub fn inverse").unwrap();
    let other = slide.with(&format!("{before}pub fn inverse{behind}"));
    other.is_refused("without the function `load`");
}

const SLIDE: &str = "name = \"slide\"
convention = \"standard\"
gravity = [0, 0, 0]
[[joint]]
kind = \"prismatic\"
mass = 1
com = [0, 0, 0]
inertia = [0.1, 0.1, 0.1, 0, 0, 0]
";

/// Each of these was shown once.
#[test]
fn programs_that_go_wrong_somewhere() {
    let file = planar2r("gravity, regressor; scalar: f64", 2);
    let refused = |texts: &[[&str; 2]], claims: &[[&str; 2]], words: &str| {
        with_changes(&file, texts, claims).is_refused(words);
    };
    let result = "    [-t6, -t4]";
    let quotient = "    let t7 = s1 / s1;\n    let t8 = t6 * t7;\n    [-t8, -t4]";
    let claims = [["t4-t5", "t4-t5 s1/s1 t6*t7"], ["-t6 -t4", "-t8 -t4"]];
    refused(&[[result, quotient]], &claims, "it divides");
    let far = "    let t7 = t6 * 1e200;\n    let t8 = t7 * 1e200;\n    let t9 = t8 * 1e-200;
    let t10 = t9 * 1e-200;\n    [-t10, -t4]";
    let claims = [
        ["],\"functions", ",\"1e200\",\"1e-200\"],\"functions"],
        ["t4-t5", "t4-t5 t6*#9 t7*#9 t8*#10 t9*#10"],
        ["-t6 -t4", "-t10 -t4"],
    ];
    refused(&[[result, far]], &claims, "has a bound of");
    let sines = ["libm::sincos(q[0])", "{ (0.0, 1.0) }"];
    refused(&[sines], &[], "has a bound of");
    let head = ["fn gravity(q:", "fn held(_qd:"];
    let claims = [["\"gravity\"", "\"held\""], ["[\"q\"]", "[\"qd\"]"]];
    refused(&[head], &claims, "no result of it takes `qd`");
    let mut claim = file.json();
    let mut other = claim["functions"][1].clone();
    other["function"] = json!("other");
    other["symbols"] = json!([]);
    other["values"] = json!("#2 #6 #3 #7 #8 #3");
    claim["functions"].as_array_mut().unwrap().push(other);
    let value = "1.3333333333333333,";
    says(&file.text, value);
    let other = file.with(&file.text.replacen(value, "9.81,", 1));
    other.with_claim(&claim).is_refused("it does not follow");
}

#[test]
fn boxes_and_modules() {
    let asked = "gravity; scalar: f64; sincos: polynomial";
    let rust = planar2r(asked, 1);
    let table = "
[-3.141592653589793, 3.141592653589793], → [f64::NEG_INFINITY, f64::INFINITY],
[-3.141592653589793, 3.141592653589793], → [-3.141592653589793, 4.0],
····let inside = inside & (BOX.q[0][0] <= q[0]) & (q[0] <= BOX.q[0][1]);↵ → ∅
····inside↵} → ····let inside = true;↵····inside↵}
";
    rust.refuses(table);
    let c = planar2r(&format!("{asked}; name: p; language: c"), 1);
    let table = "
inside = 0 → inside = 1 … return inside → return 1
q[0] <= 3.141592653589793 → q[0] <= 4.0 … q[0] <= 3 → q[1] <= 3
int p_in_box( → int P_in_box(
";
    c.refuses(table);
    let is_code = |line: &&str| !line.starts_with("//") && !line.starts_with("#![");
    let lines: Vec<&str> = rust.text.lines().filter(is_code).collect();
    let body = lines.join("\n");
    let module = format!("pub mod a {{\n{body}\n}}\n");
    assert_eq!(rust.with(&module).refusal(), None);
    assert!(rust.with(&format!("{module}{module}")).refusal().is_some());
    assert!(rust.with(&format!("{module}{body}")).refusal().is_some());
    // A routine that functions call for sines is not another function.
    let asked = "gravity; scalar: f64; sincos: together; name: p; language: c";
    let header = planar2r(asked, 1);
    let [text, claim] =
        [&header.text, &header.claim].map(|content| content.replace("p_gravity", "p_sines_3"));
    let other = header.with(&text).with_claim(&claim);
    other.is_refused("not generated code");
}

/// Names are shortened, but not to the name of a function of another frame.
#[test]
fn functions_of_frames_keep_their_names() {
    let frames = "[[frame]]\nname = \"foot\"\nlink = 1\n[[frame]]\nname = \"foot2\"\nlink = 2\n";
    let robot = support::source("planar2r", "") + frames;
    let asked = "outputs: jacobian@foot, jacobian@foot2; scalar: f64; batch: on; language: c";
    let file = Certified::shown(&robot, None, asked, 2);
    for (end, name) in [("_batch(", "the batch"), ("(", "the function")] {
        let [one, other] = ["foot", "foot2"].map(|frame| format!("jacobian_{frame}{end}"));
        let shortened = file.text.replace(&one, &format!("jacobian_fot{end}"));
        let text = shortened.replace(&other, &one);
        assert_ne!(text, file.text);
        assert!(file.with(&text).refusal().is_some(), "{name}");
    }
}

#[test]
fn files_of_attacks() {
    let pend = attack("pend.toml");
    let asked = "outputs: gravity, forward_dynamics; scalar: f64";
    let [rust, c] = ["", "; name: two; language: c"]
        .map(|more| Certified::shown(&pend, None, &format!("{asked}{more}"), 2));
    let grammar = "not of the grammar: `q` expected";
    let derived = "not generated code: `#[derive(Clone, Copy, Debug, Default";
    for (file, name, words) in [
        (&rust, "ulp.rs.txt", grammar),
        (&rust, "far32.rs.txt", grammar),
        (&rust, "trait1.rs.txt", derived),
        (&rust, "n1.rs.txt", ""),
        (&c, "hide.h", ""),
    ] {
        let other = file.with(&attack(name));
        let why = format!("{:?}", other.report());
        let is_refused = other.refusal().is_some() && why.contains(words);
        assert!(is_refused, "{name}: {why}");
    }
}

/// A joint whose rates have no limit is in no box: not in one of a claim where it stands still.
#[test]
fn joints_without_limits_have_no_tolerance() {
    let robot = attack("r2_conf.toml");
    let asked = "outputs: coriolis; scene: pick; scalar: f64";
    let file = Certified::of(&robot, Some("pick"), asked).remove(0);
    assert_eq!(file.refusal(), None);
    let other = robot.replacen("velocity = 2, ", "", 1);
    assert_ne!(other, robot);
    file.with_robot(&other)
        .is_refused("a tolerance needs the range of `qd`");
}

/// Callers may give any number for a joint that is locked.
#[test]
fn joints_that_are_locked_are_not_read() {
    let tolerance = "; box = { velocity = [1, 1, 1], acceleration = [1, 1, 1] }; \
        tolerance = { value = 0.1, relative_to = \"range\" }";
    for more in ["", tolerance] {
        let scene = format!("lock = {{ 2 = 0.3 }}{more}");
        let asked = "inverse_dynamics; scalar: f64; sincos: libm";
        let file = Certified::all("planar3r", &scene, asked).remove(0);
        assert_eq!(file.refusal(), None);
        let mut claim = file.json();
        let [steps, returns] = steps_and_results(&claim);
        let count = steps.split(' ').count();
        let mut words = returns.split(' ');
        let first = words.find(|word| word.starts_with('t')).unwrap();
        let [square, sum] = [count + 1, count + 2].map(|step| format!("t{step}"));
        let function = &mut claim["functions"][0];
        function["steps"] = format!("{steps} qd[1]*qd[1] {first}+{square}").into();
        function["returns"] = returns.replacen(first, &sum, 1).into();
        let (before, results) = file.text.split_at(file.text.rfind("    [").unwrap());
        let lines = format!("let {square} = qd[1] * qd[1];\n    let {sum} = {first} + {square};");
        let text = format!("{before}    {lines}\n{}", results.replacen(first, &sum, 1));
        let other = file.with(&text).with_claim(&claim);
        other.is_refused("it reads a joint that is locked");
    }
}
