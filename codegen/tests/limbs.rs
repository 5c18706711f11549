//! Limbs as lanes of loops: the bits of each limb's operations, and no limb in another's place.

use dalembert_codegen::workspace::Names;
use dalembert_codegen::{GeneratedCode, Language, LimbLayout, Plan, ScalarType, generate};

use serde_json::{Value, json};

use crate::c99::{compiles_without_a_warning, with_main};
use crate::certified::Certified;
use crate::support::compiled::{run, same_bits, there};
use crate::support::{Case, says, text};

/// The name, the place and the mass of the hip of each limb.
const HIPS: [[&str; 4]; 4] = [
    ["fl", "0.19", "0.047", "0.76"],
    ["fr", "0.19", "-0.047", "0.77"],
    ["rl", "-0.2", "0.047", "0.78"],
    ["rr", "-0.2", "-0.047", "0.79"],
];

/// Limbs on a base that floats or not: no two of them have all numbers alike.
fn robot(trunk: &str, limbs: usize) -> String {
    let mut text = format!("name = \"limbs\"\ngravity = [0, 0, -9.81]\n{trunk}");
    let carrier = if trunk.is_empty() { "base" } else { "trunk" };
    for [limb, x, y, m] in &HIPS[..limbs] {
        let side = y.replace("0.047", "0.095");
        text += &format!(
            r#"
[[joint]]
name = "{limb}_hip"
parent = "{carrier}"
kind = "revolute"
placement = {{ xyz = [{x}, {y}, 0] }}
axis = [1, 0, 0]
mass = {m}
com = [-0.005, {y}, -1e-4]
inertia = [0.0005, 0.001, 0.0007, -2e-6, -1e-6, 1e-6]

[[joint]]
name = "{limb}_knee"
kind = "revolute"
placement = {{ xyz = [0, {side}, 0] }}
axis = [0, 1, 0]
mass = 1.24
com = [-0.004, {y}, -0.03]
inertia = [0.006, 0.006, 0.001, 2e-5, -2e-5, 1e-4]
armature = 0.01
"#
        );
    }
    text
}

pub const TRUNK: &str = r#"
[[joint]]
name = "trunk"
kind = "floating"
mass = 7.3
com = [0.02, 0.003, -0.005]
inertia = [0.026, 0.1, 0.11, 0.0001, -3e-5, 0.0015]
"#;

fn quadruped() -> String {
    robot(TRUNK, 4)
}

const THREE: &str = "inverse_dynamics, gravity, inertia";
const OTHERS: &str = "forward_dynamics, inverse_dynamics_derivatives, inertia_blocks";

fn loops(generated: &GeneratedCode) -> Vec<Vec<usize>> {
    let functions = generated.functions.iter();
    let lanes = functions.map(|function| {
        let loops = function.program.loops.iter();
        loops.map(|lane_loop| lane_loop.lanes).collect()
    });
    lanes.collect()
}

#[test]
fn legs_are_lanes() {
    let robot = quadruped();
    for language in ["rust", "c"] {
        let asked = format!("outputs: {THREE}, {OTHERS}; scalar: f64; language: {language}");
        let file = Certified::shown(&robot, None, &asked, 6);
        let heads = ["for l in 0..4 {", "for (int l = 0; l < 4; ++l) {"];
        let count = heads.iter().map(|head| file.text.matches(head).count());
        assert!(count.sum::<usize>() >= 6, "{language}");
    }
    let single = format!("outputs: {THREE}; scalar: f32; language: c");
    Certified::shown(&robot, None, &single, 3);
    let fused = format!("outputs: {THREE}, {OTHERS}; scalar: f64; fma: on; language: c");
    let file = Certified::shown(&robot, None, &fused, 6);
    says(&file.text, "        const double t");
    says(&file.text, "= fma(u1[0][l]");
}

/// A long loop is cut into blocks, the last of which hands nothing on.
#[test]
fn long_lanes_are_cut() {
    let robot = text("../gallery/robots/go2.toml");
    let asked = "outputs: inverse_dynamics_derivatives; scalar: f64; language: rust";
    let file = Certified::shown(&robot, None, asked, 1);
    let (_, lanes) = file.text.split_once("for l in 0..4 {").unwrap();
    let (lanes, _) = lanes.split_once("\n    }\n").unwrap();
    says(lanes, "        let (t");
}

#[test]
fn no_limb_is_in_the_place_of_another() {
    let robot = quadruped();
    let in_rust = "
[qd[6], qd[8], qd[10], qd[12]] → [qd[8], qd[6], qd[10], qd[12]]
[qd[6], qd[8], qd[10], qd[12]] → [qd[6], qd[8], qd[10]]
[0.19, 0.19, -0.2, -0.2] → [0.19, -0.2, 0.19, -0.2]
[c1, c3, c5, c7] → [c3, c1, c5, c7]
for l in 0..4 { → for l in 0..3 {
for l in 0..4 { → for l in 0..5 {
for l in 0..4 { → for l in 1..4 {
u1[0][l] → u1[0][0]
u1[0][l] → u1[1][l]
let mut w1 = [[0.0; 4]; → let mut w1 = [[0.0; 5];
w1[0][l] = → w1[0][0] =
w1[0][l] = → w1[1][l] =
w1[6][0] → w1[6][1]
w1[7][2] → w1[7][3]
w1[7][2] → w1[7][4]
w1[7][2] → w1[7][l]
";
    let in_c = "
{qd[6], qd[8], qd[10], qd[12]} → {qd[8], qd[6], qd[10], qd[12]}
{qd[6], qd[8], qd[10], qd[12]} → {qd[6], qd[8], qd[10]}
{0.19, 0.19, -0.2, -0.2} → {-0.2, 0.19, 0.19, -0.2}
int l = 0 → int l = 1
l < 4 → l < 3
++l → l++
u1[0][l] → u1[0][0]
double u1[ → double u2[
double w1[ → double w2[
static const double k1[ → const float k1[
w1[6][0] → w1[6][1]
w1[7][2] → w1[7][3]
LIMBS_FORGET(u1); → LIMBS_FORGET(u2);
LIMBS_FORGET(w1); → LIMBS_FORGET(q);
LIMBS_FOUR(double, &tau[0], → LIMBS_FOUR(double, &tau[1],
LIMBS_FOUR(double, &tau[0], → LIMBS_FOUR(float, &tau[0],
LIMBS_FOUR(double, &tau[0], → LIMBS_FOUR(double, &tau[0], 0.0,
(\"\" : → (\"nop\" :
FOUR_V = {a, b, c, d} → FOUR_V = {a, b, d, c}
#define LIMBS_FORGET(array)↵ → ∅
const double t7 = → static const double t7 =
(to)[2] = (c) → (to)[2] = (d)
";
    for (language, table) in [("rust", in_rust), ("c", in_c)] {
        let asked = format!("outputs: inverse_dynamics; scalar: f64; language: {language}");
        Certified::shown(&robot, None, &asked, 1).refuses(table);
    }
}

#[test]
fn vectors_have_the_bits_of_single_operations() {
    for fma in ["off", "on"] {
        let asked = format!("outputs: {THREE}; scalar: f64, f32; sincos: together; fma: {fma}");
        let case = Case::read(&quadruped(), &format!("{asked}; limbs: lanes; language: c"));
        let flags = ["-O0 -std=c99", "-O2 -std=c99", "-O3 -std=c99 -march=native"];
        same_bits(&format!("limbs_{fma}"), &case, 5, &flags);
    }
}

/// Without flags beyond -O2 and the processor's, and without a warning.
#[cfg(target_arch = "x86_64")]
#[test]
fn compilers_make_vectors_of_lanes() {
    let call = "void f(const double *q, const double *qd, const double *x, const double *g, double *y)\n\
        {\n    CALL;\n}\n";
    for (output, arguments) in [
        ("inverse_dynamics", "q, qd, x, g, y"),
        ("inertia", "q, y"),
        (
            "inverse_dynamics_derivatives",
            "q, qd, x, g, y, y + 196, y + 392",
        ),
    ] {
        let asked = format!("outputs: {output}; scalar: f64; sincos: together; language: c");
        let case = Case::read(&quadruped(), &asked);
        let generated = case.generated();
        let text = generated.text();
        compiles_without_a_warning("lanes", &text);
        let called = Names::new("limbs", Language::C, ScalarType::F64).of(output);
        let call = call.replace("CALL", &format!("{called}({arguments})"));
        let folder = with_main("lanes", &text, &call);
        let rows = generated.functions[0].program.loops[0].rows;
        for compiler in there(&["gcc", "clang"]) {
            let flags = "-O2 -mavx2 -std=c99 -Werror -S -o - arm.c".split(' ');
            let assembly = run(compiler, flags, &folder);
            let operations = ["vmulpd", "vaddpd", "vsubpd"];
            let is_vector = |line: &&str| {
                line.contains("%ymm") && operations.iter().any(|name| line.contains(name))
            };
            let vectors = assembly.lines().filter(is_vector).count();
            let what = format!("{compiler}: {output} has {vectors} for {rows} operations");
            assert!(vectors >= rows, "{what}");
        }
    }
}

#[test]
fn two_arms_are_two_lanes() {
    // Bare knees: each one's entry of D is a number, and they are two.
    let alike = robot("", 2);
    let bare = alike.replace("armature = 0.01\n", "");
    let unlike = bare.replacen("mass = 1.24", "mass = 1.3", 1);
    for robot in [alike, unlike] {
        let asked = "outputs: inverse_dynamics, inertia; scalar: f64; limbs: lanes";
        let generated = Case::read(&robot, asked).generated();
        assert_eq!(loops(&generated), [vec![2], vec![2]]);
    }
}

#[test]
fn limbs_are_apart_where_that_is_asked_for_or_lanes_are_of_states() {
    let robot = quadruped();
    for asked in ["limbs: apart", "batch: on"] {
        let asked = format!("outputs: gravity; scalar: f64; {asked}; language: c");
        let generated = Case::read(&robot, &asked).generated();
        assert_eq!(loops(&generated), [Vec::<usize>::new()], "{asked}");
    }
    for (option, words) in [
        ("batch: on", "a batch has vectors over states, not limbs"),
        (
            "language: cuda",
            "on a GPU the vectors are over states, not limbs",
        ),
        ("formulation: newton_euler", "a formulation alone"),
    ] {
        let asked = format!("outputs: gravity; scalar: f64; limbs: lanes; {option}");
        says(&Case::read(&robot, &asked).refusal(), words);
    }
}

#[test]
fn a_plan_keeps_lanes() {
    let case = Case::read(&quadruped(), "outputs: inverse_dynamics; scalar: f64");
    let generated = case.generated();
    let text = case.plan(&generated).write();
    let mut again = case.request.clone();
    again.plan = Some(Plan::parse(&text).unwrap());
    let replayed = generate(case.robot(), &again).unwrap();
    assert!(replayed.functions[0].planned);
    assert_eq!(replayed.text(), generated.text());
    again.limbs = LimbLayout::Apart;
    let apart = generate(case.robot(), &again).unwrap();
    assert_eq!(loops(&apart), [Vec::<usize>::new()]);
    let [lane_loop] = generated.functions[0].program.loops[..] else {
        panic!("one loop");
    };
    let (first, rows, lanes) = (lane_loop.first, lane_loop.rows, lane_loop.lanes);
    for other in [
        [first + 1, rows, lanes],
        [first, rows, lanes + 1],
        [first, rows / 2, 2 * lanes],
        [first, 0, lanes],
    ] {
        let mut document: Value = serde_json::from_str(&text).unwrap();
        let loops = &mut document["functions"][0]["planned"]["loops"];
        assert_eq!(*loops, json!([[first, rows, lanes]]));
        *loops = json!([other]);
        let error = Plan::parse(&document.to_string()).unwrap_err().to_string();
        says(&error, "lanes have different operations");
    }
}
