//! A scene's code is the full model's at the scene's values: proved, and run.

use dalembert_codegen::workspace::{Runtime, seeded};
use dalembert_model::outputs::Axis;

use crate::support::{Case, is_close, largest, rows};

/// Compares the scene's text against the runtime of the whole robot, at states that have the
/// scene's values; nothing here goes through what the generator makes of the scene. What is locked
/// or zero must not be read: it would show.
pub fn check(case: &Case) {
    let (robot, scene) = (case.robot(), case.request.scene.as_ref().unwrap());
    let generated = case.generated();
    let whole = Runtime::new(&scene.apply(robot));
    let n = robot.joints.len();
    let own = scene.rows(n);
    for mut state in seeded(robot, 20, 7) {
        let mut unread = state.clone();
        for (joint, at) in &scene.lock {
            state.q[*joint] = at.to_f64();
            (state.qd[*joint], state.qdd[*joint]) = (0.0, 0.0);
            for entries in [&mut unread.q, &mut unread.qd, &mut unread.qdd] {
                entries[*joint] = f64::NAN;
            }
        }
        if scene.velocity_zero {
            state.qd.fill(0.0);
            unread.qd.fill(f64::NAN);
        }
        if scene.acceleration_zero {
            state.qdd.fill(0.0);
            unread.qdd.fill(f64::NAN);
        }
        for emitted in &generated.emitted {
            let full = whole.run(emitted.function, &state);
            let found = emitted.run(&unread);
            let mut start = 0;
            let mut expected = Vec::new();
            for quantity in emitted.function.quantities() {
                let mut wanted = vec![0];
                for axis in quantity.shape().0 {
                    let is_joints = matches!(axis, Axis::Joints);
                    let length = if is_joints {
                        n
                    } else {
                        axis.length(emitted.sizes)
                    };
                    let all = (0..length).collect();
                    let places = if is_joints { &own } else { &all };
                    let along = |from: usize| places.iter().map(move |at| from * length + at);
                    wanted = wanted.into_iter().flat_map(along).collect();
                }
                expected.extend(wanted.into_iter().map(|index| full[start + index]));
                start += quantity.len(emitted.sizes.over(n));
            }
            let most = 1e-13 * largest(&full).max(1.0);
            let is_close = is_close(&found, &expected, most);
            assert!(is_close, "{}: {found:?} {expected:?}", emitted.function);
        }
    }
}

/// A robot, the lines of a scene, and outputs; the last scene asks for the torque that a brake holds.
const ROWS: &str = r#"
PAYLOAD := payload = { mass = 2.5, com = [0.05, 0, 0.1] }
SOME := inverse_dynamics, gravity, manipulator_equation
puma560  | lock = { 4 = 0, 5 = "pi/2", 6 = "1/3" } | SOME
puma560  | lock = { 1 = 0.5, 4 = "pi", 6 = "pi/6" } | SOME
puma560  | lock = { 2 = "-pi/4", 3 = "pi/4" } | SOME
stanford | lock = { 3 = 0.5 } | SOME
stanford | lock = { 1 = 0, 2 = "pi/2", 5 = -0.3 } | SOME
panda    | lock = { 1 = 0, 3 = "pi/2", 5 = 0, 7 = "pi/4" } | SOME
planar3r | joints = [3, 1]; PAYLOAD | SOME, inertia, coriolis, dynamic_coefficients
planar3r | lock = { 2 = "pi/3" }; gravity = [1, -3, 0.5]; acceleration = "zero" | SOME, inertia, coriolis, dynamic_coefficients
planar3r | joints = [2, 1]; lock = { 2 = "pi/3", 3 = "pi/2" }; velocity = "zero"; PAYLOAD | SOME, inertia, coriolis, dynamic_coefficients
"#;

#[test]
fn scenes_are_the_full_model() {
    for [robot, scene, outputs] in rows(ROWS) {
        check(&Case::in_scene(
            &robot,
            &scene,
            &format!("{outputs}; scalar: f64"),
        ));
    }
}
