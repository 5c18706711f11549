//! Requests that cannot be met are refused by name, with the fix.

use dalembert_codegen::{Function, Language, Request, ScalarType, generate};
use dalembert_model::scene::Scene;

use crate::support::{self, Case, rows, says};

/// A robot file, the lines of a scene, what is asked, and words of what is said.
const ROWS: &str = r#"
ROUGH := tolerance = { value = 1e-3, relative_to = "range" }; box = { position = [[-1, 1], [-1, 1]], velocity = [1, 1], acceleration = [1, 1] }
NEAR := tolerance = { value = 1e-2, relative_to = "range" }
RUBBED := NEAR; box = { position = [[-1, 1], [-1, 1], [-1, 1]], velocity = [1, 1, 1], acceleration = [1, 1, 1] }
COARSE := NEAR; box = { acceleration = [1, 1, 1, 1] }
planar2r | | reaction_wrenches; parameters: payload | `reaction_wrenches` depends on numbers of bodies that have no effect on joint torques
planar2r | | inverse_dynamics; parameters: payload; formulation: lagrange_euler | the formulation `lagrange_euler` has no regrouped parameters
planar2r | gravity = [0, -2, 0] | gravity; parameters: gravity | the scene `test` sets gravity
planar2r | | inverse_dynamics; sincos: polynomial; sincos_error: 1e-10 | f32 polynomials reach … for q1 in [-π, π], not 1e-10: use `sincos_error: … `scalar: f64` or `sincos: libm`
planar2r | ROUGH | inverse_dynamics; parameters: gravity | a box has none for `g`: leave `gravity` out of the parameters
planar2r | ROUGH | forward_dynamics | `forward_dynamics` … give the tolerance to `inverse_dynamics`
planar2r | ROUGH | inertia_inverse | `inertia_inverse` … give the tolerance to `inverse_dynamics`
planar2r | ROUGH | passivity | `passivity` … give the tolerance to `inverse_dynamics`
puma560 | NEAR | regressor | its entries multiply parameters of any size
puma560 | NEAR | full_regressor | its entries multiply parameters of any size
puma560 | NEAR | passivity_regressor | its entries multiply parameters of any size
coulomb | | regressor | `regressor` … not linear … leave `coulomb` out … `full_regressor`
coulomb | | passivity_regressor | `passivity_regressor` … not linear … leave `coulomb` out … `full_regressor`
coulomb | RUBBED | inverse_dynamics | `inverse_dynamics` … Coulomb friction … no certified bound … leave `coulomb` out
frames/planar2r | | jacobian@camra | `jacobian@camra`: the robot has no frame `camra`: did you mean `camera`?
frames/planar2r | | see=gravity+jacobian@q | `see=gravity+jacobian@q`: the robot has no frame `q`: it has `hand`, `camera`, `elbow`
planar2r | | jacobian@camera:local | the robot has no frame `camera`: it has `hand`; others are [[frame]] tables of its file
wafer | | link_poses | `link_poses`
wafer | | reaction_wrenches | `reaction_wrenches`
wafer | | full_regressor | `full_regressor`
wafer | | inverse_dynamics_second_derivatives | `inverse_dynamics_second_derivatives`
wafer | COARSE | inverse_dynamics | joints of the robot follow others (`mimic`)
planar2r | WEIGHTLESS | forward_dynamics | joint 3 (tip) moves no inertia
planar2r | WEIGHTLESS | inertia_inverse | joint 3 (tip) moves no inertia
planar2r | WEIGHTLESS | forward_dynamics_derivatives | joint 3 (tip) moves no inertia
planar2r | WEIGHTLESS | forward_dynamics_second_derivatives | joint 3 (tip) moves no inertia
planar2r | | servo = gravty + jacobian | unknown output `gravty` … did you mean `gravity`?
planar2r | | servo = gravity + gravity | `gravity` is in it twice … leave one of them out
planar2r | | servo = inertia + manipulator_equation | both return D
planar2r | | servo = gravity | two parts at least … ask for `gravity` by itself
planar2r | | servo = gravity + | expected an output
planar2r | | gravity + jacobian | `gravity+jacobian` needs a name … write NAME = gravity+jacobian
planar2r | | Servo = gravity + jacobian | is not the name of a function … small letters
planar2r | | gravity = inertia + jacobian | is an output by itself
planar2r | | a = gravity + jacobian, a = inertia + jacobian | is given twice
planar2r | | a = gravty + jacobian, b = inertja + gravity | `gravty` … `inertja`
planar2r | | servo=gravity+inertia, servo_any=gravity+inertia; batch: on; sincos: together; language: c | `planar2r_servo_any`
planar2r | | gravity; name: an_arm_with_a_very_long_name; language: c | is not a valid C identifier … at most 31
planar2r | | gravity; name: an_arm_with_a_very_long_name; language: cuda | is not a valid C identifier … at most 31
planar2r | | gravity; scalar: f64; limbs: lanes | no function has lanes
two_arms | | inertia_blocks | is not available where the base is fixed
planar2r | | gravity; bodies: 2 | none are: add `parameters: bodies`
planar2r | | gravity; keep_zeros: on | none are: add `parameters: bodies`
planar2r | | gravity; parameters: bodies; bodies: 18446744073709551615 | there is no link
planar2r | | gravity; parameters: bodies; bodies: 1 2 | the number of a link
planar2r | | gravity; parameters: bodies; bodies: +1 | the number of a link
planar2r | | grav ity | unknown output `grav ity`
planar2r | | gravity; parameters: bodies; bodies: 3 | there is no link 3: links are 1 to 2
planar2r | | gravity; parameters: bodies; bodies: two | expected the number of a link
planar2r | | gravity; parameters: bodies; bodies: 2, 2 | given twice
planar2r | | centre_of_mass; parameters: bodies | `load` does not have these
planar2r | | gravity; parameters: bodies; formulation: lagrange_euler | no regrouped parameters
planar2r | payload = { mass = 2.5, com = [0.05, 0, 0.1] } | gravity; parameters: bodies | has a payload, which is part of a link
planar2r | tolerance = { value = 1e-3, relative_to = "range" }; box = { velocity = [1, 1], acceleration = [1, 1] } | gravity; parameters: bodies | bodies
"#;

const WEIGHTLESS: &str = "[[joint]]; kind = \"revolute\"; name = \"tip\"; a = 0.3; mass = 0; \
    com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; [scene.held]; lock = { 3 = 0 }";

#[test]
fn by_name() {
    for [file, scene, asked, words] in rows(ROWS) {
        let scene = scene.replace("WEIGHTLESS", WEIGHTLESS);
        let said = Case::refused(&file, &scene, &asked);
        let mut words = words.split(" … ");
        assert!(words.all(|word| said.contains(word)), "{asked}: {said}");
    }
}

#[test]
fn requests_that_nobody_read() {
    let robot = support::robot("planar2r");
    let said = |request: &Request| generate(&robot, request).unwrap_err().to_string();
    for language in [Language::C, Language::Cuda] {
        let module = Some("a-b".to_owned());
        let said = said(&Request {
            language,
            module,
            ..Request::default()
        });
        assert!(said.starts_with("`a-b` is not a valid C"), "{said}");
    }
    let both = ["servo_2=gravity+inertia", "servo2=jacobian+inertia"];
    let bundles = both.map(|text| Function::parse(text).unwrap());
    says(&said(&Request::new(&bundles)), &both.join("` and `"));
    let scene = Scene {
        name: "test".into(),
        joints: Some(vec![0, 4]),
        ..Scene::default()
    };
    let request = Request {
        scene: Some(scene),
        ..Request::default()
    };
    says(&said(&request), "there is no joint 5");
}

#[test]
fn an_arm_that_moves_no_inertia_by_its_joint() {
    for asked in [
        "inverse_dynamics",
        "forward_dynamics; scene: held",
        "inertia_inverse; scene: held",
        "forward_dynamics_derivatives; scene: held",
        "forward_dynamics_second_derivatives; scene: held",
    ] {
        let _ = Case::in_scene("planar2r", WEIGHTLESS, asked).generated();
    }
}

#[test]
fn a_header_may_be_without_f32() {
    let source = support::source("planar2r", "").replace("mass = 1\n", "mass = 1e200\n");
    let case = Case::read(&source, "outputs: gravity; language: c");
    let generated = case.generated();
    assert_eq!(generated.scalars, [ScalarType::F64]);
    let note = generated.without_single.as_ref().unwrap();
    says(note, "which f32 cannot hold");
    assert!(generated.warnings.contains(note) && generated.text().contains(note));
    // The stamp asks for no scalar either, and so for the same file again.
    let file = &generated.files(&case.request, "arm.toml", &source)[0];
    says(file, "asked = outputs: gravity\n");
    let both = "outputs: gravity; scalar: f64, f32; language: c";
    let said = Case::read(&source, both).refusal();
    says(&said, "which f32 cannot hold");
}

#[test]
fn an_arm_without_mass_has_kinematics_alone() {
    let source = support::source("planar2r", "")
        .replace("mass = 1\n", "mass = 0\n")
        .replace("0.08333333333333333", "0");
    for function in [
        "inverse_dynamics",
        "momentum",
        "reaction_wrenches",
        "a=jacobian+gravity",
    ] {
        let said = Case::read(&source, &format!("outputs: {function}")).refusal();
        assert!(said.starts_with("no link has mass, "), "{said}");
    }
    let asked = "outputs: forward_kinematics, jacobian, full_regressor";
    assert_eq!(Case::read(&source, asked).generated().functions.len(), 3);
    let rotor = source.replacen("mass = 0\n", "mass = 0\narmature = 0.1\n", 1);
    let _ = Case::read(&rotor, "outputs: inertia").generated();
}

#[test]
fn overflow_is_flagged_for_the_scalar_that_it_threatens() {
    let source = support::source("puma560", "");
    let is_flagged = |velocity: &str, scalar: &str| {
        let to = format!("velocity = {velocity}");
        let fast = source.replace("velocity = 2", &to);
        let asked = format!("outputs: inverse_dynamics; scalar: {scalar}");
        let case = Case::read(&fast.replace("velocity = 5", &to), &asked);
        let warnings = case.generated().warnings;
        warnings.iter().any(|said| said.contains("may overflow"))
    };
    assert!(is_flagged("1e20", "f32"));
    assert!(!is_flagged("1e20", "f64") && !is_flagged("2", "f32"));
}
