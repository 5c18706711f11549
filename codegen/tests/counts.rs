//! Upper bounds on operation counts of quick searches, without any plan. They go down: where one
//! rose, the sum over all arms fell. Divisions count as one.

use dalembert_codegen::{Function, Start};
use dalembert_model::equations::Formulation;

use crate::support;
use crate::support::case::Case;

/// A robot file, more tables of it, what is asked, and the most operations of each function.
type Row = (&'static str, &'static str, &'static str, &'static [usize]);

#[track_caller]
fn check(rows: &[Row]) {
    for (file, more, asked, most) in rows {
        let case = Case::new(file, more, &format!("{asked}; scalar: f64"));
        let functions = case.generated().functions;
        let found: Vec<usize> = functions.iter().map(|f| f.counts().operations()).collect();
        assert_eq!(found.len(), most.len(), "{file} {asked}");
        let mut pairs = found.iter().zip(*most);
        assert!(
            pairs.all(|(found, most)| found <= most),
            "{file} {asked}: {found:?}, {most:?}"
        );
    }
}

const TORQUES: &str = "outputs: inverse_dynamics";
const SLOPES: &str = "outputs: forward_dynamics, inverse_dynamics_derivatives";
const POSES: &str = "outputs: forward_kinematics";
const C: &str = "outputs: coriolis_matrix";
const LOADED: &str = "outputs: inverse_dynamics; parameters: payload";
const GRAVITY: &str = "outputs: inverse_dynamics; parameters: gravity";

/// Torques of checked-in arms and of other kinds, with the load and the torques of any payload,
/// and with any gravity.
#[test]
fn torques() {
    check(&[
        ("planar2r", "", TORQUES, &[23]),
        ("planar3r", "", TORQUES, &[46]),
        ("stanford", "", TORQUES, &[212]),
        ("puma560", "", TORQUES, &[263]),
        ("ur10", "", TORQUES, &[264]),
        ("scara", "", TORQUES, &[62]),
        ("gantry", "", TORQUES, &[258]),
        ("rprpr", "", TORQUES, &[315]),
        ("general6r", "", TORQUES, &[688]),
        ("gen3", "", TORQUES, &[537]),
        ("planar3r", "", LOADED, &[18, 57]),
        ("puma560", "", LOADED, &[28, 337]),
        ("stanford", "", LOADED, &[28, 283]),
        ("ur10", "", LOADED, &[31, 320]),
        ("panda", "", LOADED, &[42, 523]),
        ("planar3r", "", GRAVITY, &[50]),
        ("puma560", "", GRAVITY, &[284]),
        ("stanford", "", GRAVITY, &[225]),
        ("ur10", "", GRAVITY, &[286]),
        ("panda", "", GRAVITY, &[547]),
    ]);
}

#[test]
fn forward_dynamics_and_derivatives() {
    check(&[
        ("planar2r", "", SLOPES, &[25, 27]),
        ("planar3r", "", SLOPES, &[75, 71]),
        ("stanford", "", SLOPES, &[879, 360]),
        ("puma560", "", SLOPES, &[1070, 400]),
        ("panda", "", SLOPES, &[2495, 912]),
    ]);
}

/// Poses, from forms that turn two axes of the hand as well as from those that turn three; C, from
/// composite momenta, and from the symbols where these are about as cheap.
#[test]
fn poses_and_matrices() {
    check(&[
        ("stanford", "", POSES, &[52]),
        ("puma560", "", POSES, &[72]),
        ("ur10", "", POSES, &[68]),
        ("panda", "", POSES, &[104]),
        ("stanford", "", C, &[295]),
        ("puma560", "", C, &[344]),
        ("ur10", "", C, &[267]),
    ]);
}

const WRIST: &str = "\n[scene.some]\nlock = { 4 = 0, 5 = 0, 6 = 0 }\nvelocity = \"zero\"\n\
    joints = [1, 2, 3]\n";
const PLANE: &str = "\n[scene.some]\nlock = { 1 = 0, 4 = 0, 6 = 0 }\njoints = [2, 3, 5]\n";

/// Everything that a scene does not need is gone from the code, sines too.
#[test]
fn scenes() {
    let torques = "outputs: inverse_dynamics; scene: some";
    check(&[
        ("puma560", WRIST, torques, &[62]),
        ("puma560", PLANE, torques, &[61]),
        ("puma560", "", "outputs: gravity", &[28]),
    ]);
    for (more, sines) in [(WRIST, 2), (PLANE, 3)] {
        let generated = Case::new("puma560", more, torques).generated();
        assert!(generated.functions[0].counts().sincos <= sines);
    }
}

/// Less than the parts by themselves, where they have more in common than sines: of one arm, and of
/// frames that have the way there in common.
#[test]
fn bundles_share_work() {
    for (file, asked, most) in [
        ("planar3r", "motion=forward_kinematics+jacobian", 16),
        ("planar3r", "model=inertia+coriolis_matrix+gravity", 44),
        (
            "planar3r",
            "servo=inverse_dynamics+jacobian+forward_kinematics",
            62,
        ),
        (
            "frames/puma560",
            "a=jacobian@camera+jacobian@elbow+jacobian@hand",
            usize::MAX,
        ),
        (
            "frames/panda",
            "a=jacobian@camera+jacobian@elbow+jacobian@hand",
            usize::MAX,
        ),
        (
            "frames/puma560",
            "a=forward_kinematics@camera+forward_kinematics@elbow+forward_kinematics@hand",
            usize::MAX,
        ),
        (
            "frames/panda",
            "a=forward_kinematics@camera+forward_kinematics@elbow+forward_kinematics@hand",
            usize::MAX,
        ),
    ] {
        let whole = operations(file, asked);
        let parts = asked.split(['=', '+']).skip(1);
        let sum: usize = parts.map(|part| operations(file, part)).sum();
        assert!(
            whole < sum && whole <= most,
            "{file} {asked}: {whole} of {sum}"
        );
    }
}

fn operations(file: &str, outputs: &str) -> usize {
    let case = Case::new(file, "", &format!("outputs: {outputs}; scalar: f64"));
    case.generated().functions[0].counts().operations()
}

/// A Jacobian of some rows, or of a frame before the hand, costs less than all of it.
#[test]
fn what_is_not_asked_for_is_not_computed() {
    let [whole, angular, inner] = [
        "jacobian@camera",
        "jacobian@camera:angular",
        "jacobian@elbow",
    ]
    .map(|outputs| operations("frames/puma560", outputs));
    assert!(
        angular < whole && 2 * inner < whole,
        "{whole} {angular} {inner}"
    );
}

/// Of CasADi's Hessians of λᵀτ and λᵀq̈ after common subexpressions, at the best of its ways, there
/// are 5309 and 6833 operations of the PUMA, 15464 and 19401 of the Panda
/// (`benches/peers/peers.py counts`): at most half.
#[test]
fn second_derivatives_cost_half_of_casadi_s() {
    let asked = "outputs: inverse_dynamics_second_derivatives, forward_dynamics_second_derivatives";
    let rows: [Row; 2] = [
        ("puma560", "", asked, &[2654, 3416]),
        ("panda", "", asked, &[7732, 9700]),
    ];
    // The larger one where tests are not optimised would take them minutes.
    check(support::dose(&rows, 1));
}

#[test]
fn lagrange_euler_alone() {
    let asked = "outputs: inverse_dynamics, dynamic_coefficients; formulation: lagrange_euler";
    check(&[("puma560", "", asked, &[2699, 2199])]);
}

/// The search starts from the cheapest formulation and never makes it dearer.
#[test]
fn auto_is_never_dearer_than_one_formulation() {
    for name in ["planar2r", "stanford"] {
        for function in Function::ALL[..6].to_vec() {
            let auto = operations(name, function.name());
            for formulation in [
                Formulation::LagrangeEuler,
                Formulation::Dalembert,
                Formulation::NewtonEulerLink,
            ] {
                let one = support::from(&support::robot(name), function, Start::Only(formulation));
                // Sines and cosines weigh more than operations: a few more of
                // these may stand for fewer of those.
                let folded = one.functions[0].passes[1].counts.operations();
                assert!(auto <= folded, "{name} {function} {formulation:?}");
            }
        }
    }
}

#[test]
fn there_is_a_division_a_joint_at_most() {
    for name in ["planar2r", "planar3r", "stanford", "puma560"] {
        let case = Case::new(
            name,
            "",
            "outputs: forward_dynamics, inertia_inverse; scalar: f64",
        );
        for function in case.generated().functions {
            let divisions = function.counts().div;
            assert!(
                (1..=case.robot().joints.len()).contains(&divisions),
                "{name} {divisions}"
            );
        }
    }
}
