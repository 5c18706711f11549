//! What cannot be had is refused by name, with what to do.

use crate::support;
use crate::support::case::Case;

/// A robot file, more tables of it, what is asked, and words of what is said.
type Row = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

const MOON: &str = "\n[scene.moon]\ngravity = [0, -2, 0]\n";
const ROUGH: &str = "\n[scene.rough]\ntolerance = { value = 1e-3, relative_to = \"range\" }\n\
    box = { position = [[-1, 1], [-1, 1]], velocity = [1, 1], acceleration = [1, 1] }\n";
const NEAR: &str = "\n[scene.near]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n";
const BOXED: &str = "\n[scene.near]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n\
    box = { velocity = [1, 1], acceleration = [1, 1] }\n";
const COARSE: &str = "\n[scene.coarse]\ntolerance = { value = 1e-3, relative_to = \"range\" }\n\
    box = { acceleration = [1, 1, 1, 1] }\n";

const LINEAR: &str = "not linear";
const OTHERS: [&str; 2] = ["leave `coulomb` out", "`full_regressor`"];
const CERTIFIED: &str = "give the tolerance to `inverse_dynamics`";
const PARAMETERS: &[&str] = &["its entries multiply parameters of any size"];

const ROWS: [Row; 22] = [
    (
        "planar2r",
        "",
        "outputs: reaction_wrenches; parameters: payload",
        &[
            "`reaction_wrenches` depends on parameters of the payload that have no effect on joint torques",
        ],
    ),
    (
        "planar2r",
        "",
        "outputs: inverse_dynamics; parameters: payload; formulation: lagrange_euler",
        &["the formulation `lagrange_euler` has no regrouped parameters"],
    ),
    (
        "planar2r",
        "",
        "outputs: inverse_dynamics; parameters: payload; batch: on",
        &["batches in Rust take arguments with an entry a joint, and payload is none"],
    ),
    (
        "planar2r",
        MOON,
        "outputs: gravity; parameters: gravity; scene: moon",
        &["the scene `moon` says what gravity is"],
    ),
    (
        "planar2r",
        ROUGH,
        "outputs: inverse_dynamics; parameters: payload; scene: rough",
        &["no box bounds its argument `load`"],
    ),
    (
        "planar2r",
        ROUGH,
        "outputs: inverse_dynamics; parameters: gravity; scene: rough",
        &["no box bounds its argument `g`"],
    ),
    (
        "planar2r",
        BOXED,
        "outputs: forward_dynamics; scene: near",
        &["`forward_dynamics`", CERTIFIED],
    ),
    (
        "planar2r",
        BOXED,
        "outputs: inertia_inverse; scene: near",
        &["`inertia_inverse`", CERTIFIED],
    ),
    (
        "planar2r",
        BOXED,
        "outputs: passivity; scene: near",
        &["`passivity`", CERTIFIED],
    ),
    (
        "puma560",
        NEAR,
        "outputs: regressor; scene: near",
        PARAMETERS,
    ),
    (
        "puma560",
        NEAR,
        "outputs: full_regressor; scene: near",
        PARAMETERS,
    ),
    (
        "puma560",
        NEAR,
        "outputs: passivity_regressor; scene: near",
        PARAMETERS,
    ),
    (
        "coulomb",
        "",
        "outputs: regressor",
        &["`regressor`", LINEAR, OTHERS[0], OTHERS[1]],
    ),
    (
        "coulomb",
        "",
        "outputs: passivity_regressor",
        &["`passivity_regressor`", LINEAR, OTHERS[0], OTHERS[1]],
    ),
    (
        "frames/planar2r",
        "",
        "outputs: jacobian@camra",
        &["`jacobian@camra`: the robot has no frame `camra`: did you mean `camera`?"],
    ),
    (
        "frames/planar2r",
        "",
        "outputs: see=gravity+jacobian@q",
        &["`see=gravity+jacobian@q`: the robot has no frame `q`: it has `hand`, `camera`, `elbow`"],
    ),
    (
        "planar2r",
        "",
        "outputs: jacobian@camera:local",
        &[
            "the robot has no frame `camera`: it has `hand`; others are [[frame]] tables of its file",
        ],
    ),
    ("wafer", "", "outputs: link_poses", &["`link_poses` "]),
    (
        "wafer",
        "",
        "outputs: reaction_wrenches",
        &["`reaction_wrenches` "],
    ),
    (
        "wafer",
        "",
        "outputs: full_regressor",
        &["`full_regressor` "],
    ),
    (
        "wafer",
        "",
        "outputs: inverse_dynamics_second_derivatives",
        &["`inverse_dynamics_second_derivatives` "],
    ),
    (
        "wafer",
        COARSE,
        "outputs: inverse_dynamics; scene: coarse",
        &["joints of the robot follow others (`mimic`)"],
    ),
];

#[test]
fn by_name() {
    for (file, more, asked, words) in ROWS {
        let said = Case::new(file, more, asked).refusal();
        assert!(
            words.iter().all(|word| said.contains(word)),
            "{asked}: {said}"
        );
    }
}

/// An arm whose last joint moves no inertia has no inverse of D; held, it needs none. Torques that
/// it takes are another matter.
#[test]
fn an_arm_that_moves_no_inertia_by_its_joint() {
    let source = support::source("planar3r", "");
    let (first, last) = source.split_at(source.rfind("\nmass").unwrap());
    let lines = last.lines().map(|line| match line.split_once(" = ") {
        Some(("mass", _)) => "mass = 0".to_owned(),
        Some(("inertia", _)) => "inertia = [0, 0, 0, 0, 0, 0]".to_owned(),
        _ => line.to_owned(),
    });
    let lines: Vec<String> = lines.collect();
    let source = first.to_owned() + &lines.join("\n") + "\n[scene.held]\nlock = { 3 = 0 }\n";
    for output in [
        "forward_dynamics",
        "inertia_inverse",
        "forward_dynamics_derivatives",
        "forward_dynamics_second_derivatives",
    ] {
        let case = Case::of(&source, &format!("outputs: {output}"));
        let (said, joint) = (case.refusal(), case.robot().joint_label(2));
        assert!(
            said.contains(&joint) && said.contains("moves no inertia"),
            "{said}"
        );
        Case::of(&source, &format!("outputs: {output}; scene: held")).generated();
    }
    Case::of(&source, "outputs: inverse_dynamics").generated();
}

/// What a scalar cannot hold inside the robot's limits is said.
#[test]
fn overflow_is_flagged_for_the_scalar_that_it_threatens() {
    let source = support::source("puma560", "");
    let is_flagged = |velocity: &str, scalar: &str| {
        let to = format!("velocity = {velocity}");
        let source = source
            .replace("velocity = 2", &to)
            .replace("velocity = 5", &to);
        let case = Case::of(
            &source,
            &format!("outputs: inverse_dynamics; scalar: {scalar}"),
        );
        case.generated()
            .warnings
            .iter()
            .any(|said| said.contains("may overflow"))
    };
    assert!(is_flagged("1e20", "f32"));
    assert!(!is_flagged("1e20", "f64") && !is_flagged("2", "f32"));
}
