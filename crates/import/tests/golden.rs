//! Real models: torques, gravity loads, inertia matrices and poses are those of an independent
//! library, Pinocchio for a URDF and MuJoCo for an MJCF; with snapping they are off by no more than
//! the bounds say.

use crate::support::{
    MJCFS, URDFS, bounded, exact, flat, golden, imported, motion, snapped, states, vector, worst,
};
use dalembert_import::Motion;
use dalembert_model::reference::Reference;

#[test]
fn exact_digits_give_the_torques_of_the_model() {
    for (names, most) in [(&URDFS[..], 1e-12), (&MJCFS, 1e-10)] {
        for name in names {
            let worst = worst(&imported(name, &exact(name)).robot, &golden(name));
            println!("{name}: {worst:.1e}");
            assert!(worst < most, "{name}: {worst:e}");
        }
    }
}

#[test]
fn snapped_torques_stay_within_the_bound() {
    for (names, rounding) in [(&URDFS[..], 1e-12), (&MJCFS, 1e-11)] {
        for name in names {
            let imported = imported(name, &snapped(name));
            let most = bounded(name, &imported, &golden(name), rounding);
            assert!(most < 0.2, "{name}: {most:e}");
        }
    }
}

#[test]
fn snapped_hands_stay_within_the_bound() {
    for name in URDFS {
        let golden = golden(name);
        let imported = imported(name, &snapped(name));
        let runtime = Reference::<f64>::from_robot(&imported.robot);
        let motion = motion(&golden);
        let bound = imported.change.as_ref().map(|change| change.hand(&motion));
        let (mut far, mut turned) = (0.0f64, 0.0f64);
        for state in states(&golden) {
            let hand = runtime.hand(&vector(state, "q")).unwrap().rows();
            let pose = flat(&state["tip_pose"]);
            let off = |k: &usize| hand[*k] - pose[*k];
            let square = |keys: &[usize]| keys.iter().map(|k| off(k) * off(k)).sum::<f64>();
            far = far.max(square(&[3, 7, 11]).sqrt());
            // |R − R'| over all entries is 2√2 sin(φ/2).
            let chord = square(&[0, 1, 2, 4, 5, 6, 8, 9, 10]).sqrt();
            turned = turned.max(2.0 * (chord / 8.0f64.sqrt()).asin());
        }
        println!("{name}: off by {far:.1e} m, {turned:.1e} rad, {bound:?}");
        let [position, angle] = bound.map_or([0.0; 2], |b| [b.position, b.angle]);
        assert!(far <= position + 1e-13, "{name}: {far:e} > {position:e}");
        assert!(turned <= angle + 1e-13, "{name}: {turned:e} > {angle:e}");
        assert!(position < 1e-3 && angle < 1e-3, "{name}: {bound:?}");
    }
}

/// One joint whose bound can be worked out by hand: a bar of 2 kg, 0.5 m from an
/// axis that 1.5708 tilts by δ = 3.7e-6 against gravity.
#[test]
fn the_bound_is_the_size_of_the_change() {
    let source = r#"<robot name="bar">
      <link name="base"/>
      <joint name="swing" type="revolute">
        <parent link="base"/> <child link="bar"/> <axis xyz="0 0 1"/>
        <origin xyz="0 0 0" rpy="1.5708 0 0"/>
        <limit lower="-3" upper="3" effort="10" velocity="0"/>
      </joint>
      <link name="bar"> <inertial> <origin xyz="0.5 0 0"/> <mass value="2"/>
        <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/> </inertial> </link>
      <joint name="grip" type="fixed">
        <parent link="bar"/> <child link="hand"/> <origin xyz="0 0.25 0"/> </joint>
      <link name="hand"/>
    </robot>"#;
    let options = dalembert_import::Options {
        snap: true,
        ..Default::default()
    };
    let imported = dalembert_import::import(source, &options).unwrap();
    let change = imported.change.unwrap();
    let still = Motion {
        position: vec![0.0],
        velocity: vec![0.0],
        acceleration: vec![0.0],
    };
    let delta = "1.5708".parse::<f64>().unwrap() - std::f64::consts::FRAC_PI_2;
    let [bound] = change.torques(&still)[..] else {
        panic!("one joint");
    };
    // Weight times lever times δ is what a tilt can do at most; it is turned by a
    // matrix whose distance is √2 δ.
    let most = 2.0 * 9.81 * 0.5 * delta;
    let is_near = (most..1.5 * most).contains(&bound);
    assert!(is_near, "{bound:e} against {most:e}");
    let hand = change.hand(&still);
    assert!((delta..1.5 * delta).contains(&hand.angle), "{hand:?}");
    let quarter = 0.25 * delta..0.25 * 1.5 * delta;
    assert!(quarter.contains(&hand.position), "{hand:?}");
    // Relative to 10 N·m, over accelerations too: 2 kg at 0.5 m hardly feel δ.
    let part = change.of_efforts().unwrap();
    assert!((bound / 10.0..2.0 * bound).contains(&part), "{part:e}");
}
