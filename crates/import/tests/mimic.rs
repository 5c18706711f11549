//! Joints that mimic others: one coordinate with their leader, against Pinocchio; followers
//! beside the chain.

use dalembert_import::Options;
use dalembert_model::outputs::{Argument, Quantity};
use dalembert_model::reference::{JointVectors, Reference};
use nalgebra::DVector;

use crate::support::{data, flat, golden, imported, relative, source, states, taken, to};

const ARM: &str = "wafer";

fn options() -> Options {
    Options {
        file: format!("{ARM}.urdf"),
        ..Options::default()
    }
}

#[test]
fn the_runtime_gives_what_pinocchio_gives() {
    let imported = imported(ARM, &options());
    let kept = data(&format!("../../../../codegen/tests/data/{ARM}.toml"));
    assert_eq!(kept, imported.text);
    let joints = imported.robot.joints.iter();
    let names: Vec<&str> = joints.map(|j| j.name.as_deref().unwrap()).collect();
    assert_eq!(names, ["turn", "lift", "shoulder", "tilt"]);
    let runtime = Reference::<f64>::from_robot(&imported.robot);
    let mut compared = 0;
    for state in states(&golden(ARM)) {
        let of = |argument: Argument| {
            let key = argument.given().unwrap_or_default();
            DVector::from_vec(state.get(key).map_or_else(Vec::new, flat))
        };
        let at = JointVectors::new(Argument::ALL.map(|argument| (argument, of(argument))));
        for &quantity in Quantity::ALL {
            let Some(known) = quantity.facts().given.and_then(|key| state.get(key)) else {
                continue;
            };
            let entries = runtime.entries(quantity, &at).unwrap();
            let error = relative(&entries, &flat(known));
            assert!(error < 1e-12, "{quantity:?}: {error:e}");
            compared += 1;
        }
    }
    assert_eq!(compared, 23 * 5);
}

#[test]
fn limits_of_a_follower_are_its_leaders() {
    let robot = imported(ARM, &options()).robot;
    let [lift, shoulder] = [1, 2].map(|joint| &robot.joints[joint].limits);
    let text = dalembert_model::robot::write(&robot);
    // extend: 0.75 q + 0.02 in 0 to 0.32; elbow: −2 q + 0.1 in −2.7 to 2.9.
    let limits = [
        "limits = { position = [0, 0.4], velocity = 0.6",
        "limits = { position = [-1.4, 1.4], velocity = 2.5",
    ];
    assert!(limits.iter().all(|limits| text.contains(limits)), "{text}");
    assert!(lift.position.is_some() && shoulder.position.is_some());
    let again = dalembert_model::read::parse(&text).unwrap();
    assert_eq!(again.robot, robot);
}

#[test]
fn followers_are_held_with_their_leader() {
    let robot = |lock: &[(&str, &str)]| {
        let options = Options {
            lock: to("", lock).lock,
            ..options()
        };
        imported(ARM, &options).robot
    };
    let held = robot(&[("shoulder", "0.25")]);
    let fixed = robot(&[("shoulder", "0.25"), ("elbow", "-0.4"), ("level", "0.25")]);
    assert_eq!(held.joints.len(), 3);
    assert_eq!(held, fixed);
    let fingers = r#"<link name="thumb"><inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial></link>
      <link name="finger"><inertial><mass value="0.1"/><inertia ixx="1e-4" ixy="0" ixz="0" iyy="1e-4" iyz="0" izz="1e-4"/></inertial></link>
      <joint name="grip" type="prismatic"><parent link="blade"/><child link="thumb"/><axis xyz="0 1 0"/><limit lower="0" upper="0.04" velocity="1" effort="1"/></joint>
      <joint name="other" type="prismatic"><parent link="blade"/><child link="finger"/><axis xyz="0 1 0"/><mimic joint="grip" multiplier="-1" offset="0.01"/><limit lower="-0.04" upper="0.04" velocity="1" effort="1"/></joint>
    </robot>"#;
    let grips = source(ARM).replace("</robot>", fingers);
    let robot = |lock: &[(&str, &str)]| taken(&grips, &to("blade", lock)).robot;
    let follows = robot(&[("grip", "0.03")]);
    assert_eq!(follows, robot(&[("grip", "0.03"), ("other", "-0.02")]));
    assert_ne!(follows, robot(&[("grip", "0.03"), ("other", "0.01")]));
}
