//! The recursion of the identity against Lagrange's equation, d/dt ∂L/∂q̇ − ∂L/∂q + b∘q̇, with true
//! slopes of D and U in the field. D is computed without the recursion.

use dalembert_checker::identity::arm::Arm;
use dalembert_checker::identity::exact::Point;
use dalembert_checker::identity::number::Number;
use dalembert_checker::identity::outputs::result;
use dalembert_checker::identity::robot;
use dalembert_checker::identity::state::State;
use dalembert_checker::identity::table::functions;
use dalembert_checker::program::argument;

use crate::support::file;

const ROBOTS: [&str; 6] = [
    "generated/robots/puma560.toml",
    "generated/robots/panda.toml",
    "crates/checker/tests/data/hand.toml",
    "crates/checker/tests/data/tilted.toml",
    "codegen/tests/data/general6r.toml",
    // Two joints follow one, and one of these has a rotor here.
    "codegen/tests/data/wafer.toml",
];

fn value(arm: &Arm, state: &State, name: &str) -> Vec<Number> {
    let function = functions().iter().find(|function| function.name == name);
    result(arm, state, &function.unwrap().fields[0]).unwrap()
}

/// Σ D_ik q̈_k + Σ (∂D_ik/∂q_m − ½ ∂D_km/∂q_i) q̇_k q̇_m + ∂U/∂q_i + b_i q̇_i.
#[test]
fn torques_are_those_of_lagranges_equation() {
    for name in ROBOTS {
        let elbow = "limits = { position = [-2.7";
        let text = file(name).replace(elbow, &format!("armature = 0.7\n{elbow}"));
        let source = robot::read(&text).unwrap();
        let setting = source.setting(None).unwrap();
        let point = Point::new(&[name]);
        let arm = Arm::read(&setting, &point).unwrap();
        let state = State::draw(&point, &setting).unwrap();
        let [qd, qdd] = ["qd", "qdd"].map(|key| &state.arguments[argument(key).unwrap()]);
        let n = qd.len();
        let d = value(&arm, &state, "inertia");
        let slope = |joint: usize| {
            let moved = state.moving(0, joint, 1);
            let d = value(&arm, &moved, "inertia").into_iter();
            let u = value(&arm, &moved, "potential_energy")[0];
            (d.map(|entry| entry.slope(1)).collect(), u.slope(1))
        };
        let slopes: Vec<(Vec<Number>, Number)> = (0..n).map(slope).collect();
        let torques = value(&arm, &state, "inverse_dynamics");
        for (i, torque) in torques.into_iter().enumerate() {
            let followers = arm.joints.iter().filter(|joint| joint.leader.0 == i);
            let viscous = followers
                .map(|joint| joint.viscous * joint.leader.1 * joint.leader.1)
                .fold(0.into(), |sum: Number, one| sum + one);
            let mut expected = slopes[i].1 + viscous * qd[i];
            for k in 0..n {
                expected = expected + d[i * n + k] * qdd[k];
                for m in 0..n {
                    let slope = slopes[m].0[i * n + k] - arm.half * slopes[i].0[k * n + m];
                    expected = expected + slope * qd[k] * qd[m];
                }
            }
            let [found, expected] = [torque, expected].map(|number| number.value(point.prime));
            assert!(found.is_some() && found == expected, "{name} {i}");
        }
    }
}
