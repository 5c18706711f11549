//! Upper bounds on operation counts of quick searches, without any plan. They go down: where one
//! rose, the sum over all arms fell. Divisions count as one.

use dalembert_codegen::Function;

use crate::support::{Case, daily_and_campaign, rows};

/// Checks a table: robot files, the lines of a scene, what is asked, and the most operations of each
/// function, or operations/sines. A function that inverts D divides once a joint at most.
#[track_caller]
fn check(table: &str) {
    for [file, scene, asked, most] in rows(table) {
        let case = Case::in_scene(&file, &scene, &format!("{asked}; scalar: f64"));
        let functions = case.generated().functions;
        assert_eq!(functions.len(), most.split(' ').count(), "{file} {asked}");
        for (code, most) in functions.iter().zip(most.split(' ')) {
            let (function, counts) = (code.function, code.counts());
            let (operations, sines) = most.split_once('/').unwrap_or((most, "99"));
            let most_of = |most: &str| most.parse::<usize>().unwrap();
            let (operations, sines) = (most_of(operations), most_of(sines));
            let is_less = counts.operations() <= operations && counts.sincos <= sines;
            assert!(is_less, "{file} {function}: {counts}, not {most}");
            let inverts = [Function::ForwardDynamics, Function::InertiaInverse].contains(&function);
            let is_fine = (1..=case.robot().joints.len()).contains(&counts.div);
            assert!(is_fine || !inverts, "{file} {function}: {}", counts.div);
        }
    }
}

/// The second table is a campaign's.
const TORQUES: [&str; 2] = [
    "
planar2r  | | inverse_dynamics | 23
planar3r  | | inverse_dynamics | 46
stanford  | | inverse_dynamics | 212
puma560   | | inverse_dynamics | 263
ur10      | | inverse_dynamics | 264
scara     | | inverse_dynamics | 62/2
gantry    | | inverse_dynamics | 258
planar3r  | | inverse_dynamics; parameters: payload | 18 57
puma560   | | inverse_dynamics; parameters: payload | 28 337
planar3r  | | inverse_dynamics; parameters: gravity | 50
stanford  | | inverse_dynamics; parameters: gravity | 227
",
    "
rprpr     | | inverse_dynamics | 315
general6r | | inverse_dynamics | 688
gen3      | | inverse_dynamics | 537
stanford  | | inverse_dynamics; parameters: payload | 28 283
ur10      | | inverse_dynamics; parameters: payload | 31 320
panda     | | inverse_dynamics; parameters: payload | 42 523
puma560   | | inverse_dynamics; parameters: gravity | 284
ur10      | | inverse_dynamics; parameters: gravity | 286
panda     | | inverse_dynamics; parameters: gravity | 547
puma560   | | inverse_dynamics, dynamic_coefficients; formulation: lagrange_euler | 2699 2199
",
];

const OTHERS: [&str; 2] = [
    "
planar2r | | forward_dynamics, inverse_dynamics_derivatives, inertia_inverse | 25 27 10
planar3r | | forward_dynamics, inverse_dynamics_derivatives, inertia_inverse | 77 71 39
stanford | | forward_dynamics, inertia_inverse | 360 234
gantry   | | inverse_dynamics_derivatives | 699
ur10     | | dalembert_terms | 769
stanford | | forward_kinematics | 52
puma560  | | forward_kinematics | 72
ur10     | | forward_kinematics | 68
panda    | | forward_kinematics | 104
stanford | | coriolis_matrix | 295
puma560  | | gravity | 28
",
    "
stanford | | inverse_dynamics_derivatives | 879
puma560  | | forward_dynamics, inverse_dynamics_derivatives, inertia_inverse | 1070 400 255
panda    | | forward_dynamics, inverse_dynamics_derivatives | 2495 912
puma560  | | coriolis_matrix | 344
ur10     | | coriolis_matrix | 267
",
];

const BUNDLES: [&str; 2] = [
    "
planar3r       | motion=forward_kinematics+jacobian | 16
planar3r       | model=inertia+coriolis_matrix+gravity | 44
planar3r       | servo=inverse_dynamics+jacobian+forward_kinematics | 62
frames/puma560 | a=forward_kinematics@camera+forward_kinematics@elbow+forward_kinematics@hand |
",
    "
frames/puma560 | a=jacobian@camera+jacobian@elbow+jacobian@hand |
frames/panda   | a=jacobian@camera+jacobian@elbow+jacobian@hand |
frames/panda   | a=forward_kinematics@camera+forward_kinematics@elbow+forward_kinematics@hand |
",
];

/// CasADi's Hessians of λᵀτ and λᵀq̈ have 5309 and 6833 operations of the PUMA, 15464 and 19401 of
/// the Panda after common subexpressions (`benches/peers/peers.py counts`): at most half.
const SECOND: [&str; 2] = [
    "puma560 | | inverse_dynamics_second_derivatives, forward_dynamics_second_derivatives | 2654 3416",
    "panda | | inverse_dynamics_second_derivatives, forward_dynamics_second_derivatives | 7732 9700",
];

daily_and_campaign! {
    torques: (TORQUES[0]), (TORQUES[1]);
    derivatives_poses_and_matrices: (OTHERS[0]), (OTHERS[1]);
    bundles_share_work: (BUNDLES[0]), (BUNDLES[1]);
    second_derivatives_cost_half_of_casadi_s: (SECOND[0]), (SECOND[1]);
}

use self::{
    check as derivatives_poses_and_matrices, check as second_derivatives_cost_half_of_casadi_s,
    check as torques,
};

#[test]
fn scenes() {
    let table = r#"
puma560 | lock = { 4 = 0, 5 = 0, 6 = 0 }; velocity = "zero"; joints = [1, 2, 3] | inverse_dynamics | 62/2
puma560 | lock = { 1 = 0, 4 = 0, 6 = 0 }; joints = [2, 3, 5] | inverse_dynamics | 61/3
"#;
    check(table);
}

fn bundles_share_work(table: &str) {
    for [file, asked, most] in rows(table) {
        let most = most.parse().unwrap_or(usize::MAX);
        let whole = operations(&file, &asked);
        let parts = asked.split(['=', '+']).skip(1);
        let sum: usize = parts.map(|part| operations(&file, part)).sum();
        assert!(whole < sum && whole <= most, "{asked}: {whole} of {sum}");
    }
}

fn operations(file: &str, outputs: &str) -> usize {
    let case = Case::new(file, "", &format!("outputs: {outputs}; scalar: f64"));
    case.generated().functions[0].counts().operations()
}

#[test]
fn what_is_not_asked_for_is_not_computed() {
    let at = |frame: &str| operations("frames/puma560", &format!("jacobian@{frame}"));
    let [camera, angular, elbow] = ["camera", "camera:angular", "elbow"].map(at);
    let is_less = angular < camera && 2 * elbow < camera;
    assert!(is_less, "{camera} {angular} {elbow}");
}
