//! Given states: a strict reader, and every usual mistake found again after it
//! was made on purpose.

use std::path::PathBuf;

use dalembert_codegen::workspace::function::{Function, Quantity};
use dalembert_codegen::workspace::states::seeded;
use dalembert_codegen::workspace::verify::floating::Runtime;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, Robot};
use dalembert_report::states::GivenState;
use dalembert_report::states::diagnose::diagnose;
use dalembert_report::states::file::{FileError, read};

fn robot(name: &str) -> Robot {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let file = root.join(format!("../generated/robots/{name}.toml"));
    let bytes = std::fs::read(file).unwrap();
    let reading = dalembert_model::read::parse_bytes(&bytes, &Default::default());
    reading.unwrap().robot
}

/// States as another program gives them for a robot.
fn states(robot: &Robot) -> Vec<GivenState> {
    let runtime = Runtime::new(robot);
    let states = seeded(robot, 12, 7).into_iter().map(|state| {
        let known = [
            (Quantity::Torque, Function::InverseDynamics),
            (Quantity::Inertia, Function::Inertia),
            (Quantity::Coriolis, Function::Coriolis),
            (Quantity::Gravity, Function::Gravity),
        ];
        let known = known.map(|(quantity, function)| (quantity, runtime.run(function, &state)));
        GivenState {
            state,
            known: known.into_iter().collect(),
        }
    });
    states.collect()
}

/// Returns the one explanation of states that a changed robot gives, or that are
/// changed themselves.
fn explained(
    name: &str,
    robot_of: impl Fn(&mut Robot),
    of_states: impl Fn(&mut GivenState),
) -> String {
    let own = robot(name);
    let mut other = own.clone();
    robot_of(&mut other);
    let mut given = states(&other);
    given.iter_mut().for_each(of_states);
    let diagnosis = diagnose(&own, &given);
    assert_eq!(diagnosis.explained_by.len(), 1, "{name}: {diagnosis:?}");
    let help = diagnosis.help();
    assert!(help.contains(&diagnosis.explained_by[0]), "{help}");
    diagnosis.explained_by[0].clone()
}

fn each(change: impl Fn(&mut Joint)) -> impl Fn(&mut Robot) {
    move |robot| robot.joints.iter_mut().for_each(&change)
}

/// Returns the inertia about the origin: I + m (r² 1 − r rᵀ).
fn about_origin(joint: &mut Joint, sign: i64) {
    let m = &joint.mass * Rational::from_integer(sign.into());
    let [x, y, z] = joint.com.clone();
    let own = joint.inertia.clone();
    joint.inertia = Inertia {
        xx: own.xx + &m * (&y * &y + &z * &z),
        yy: own.yy + &m * (&x * &x + &z * &z),
        zz: own.zz + &m * (&x * &x + &y * &y),
        xy: own.xy - &m * (&x * &y),
        yz: own.yz - &m * (&y * &z),
        xz: own.xz - &m * (&x * &z),
    };
}

#[test]
fn the_mistake_that_was_made_is_named() {
    let same = |_: &mut GivenState| ();
    let thousand = || Rational::from_integer(1000.into());
    for (words, change) in [
        (
            "sign of the robot file's `gravity`",
            Box::new(|robot: &mut Robot| robot.gravity = robot.gravity.each_ref().map(|x| -x))
                as Box<dyn Fn(&mut Robot)>,
        ),
        (
            "`gravity` is [0, 0, -9.80665]",
            Box::new(|robot| robot.gravity[2] = Rational::new((-980_665).into(), 100_000.into())),
        ),
        (
            "about the origin of the link's frame instead",
            Box::new(each(|joint| about_origin(joint, -1))),
        ),
        (
            "was given it about the origin",
            Box::new(each(|joint| about_origin(joint, 1))),
        ),
        (
            "`convention` is the other one",
            Box::new(|robot| robot.convention = Convention::Modified),
        ),
        (
            "`com` is taken as mm",
            Box::new(each(move |joint| {
                joint.com.iter_mut().for_each(|x| *x /= thousand())
            })),
        ),
        (
            "`viscous` is left out",
            Box::new(each(|joint| joint.viscous = Rational::default())),
        ),
        (
            "`coulomb` is left out",
            Box::new(each(|joint| joint.coulomb = Rational::default())),
        ),
        (
            "`armature` is left out",
            Box::new(each(|joint| joint.armature = Rational::default())),
        ),
        (
            "sign of the robot file's `alpha`",
            Box::new(each(|joint| joint.alpha = joint.alpha.negate())),
        ),
        (
            // Two at once.
            "sign of the robot file's `alpha` is changed",
            Box::new(|robot| {
                each(|joint| joint.alpha = joint.alpha.negate())(robot);
                robot.gravity = robot.gravity.each_ref().map(|x| -x);
            }),
        ),
    ] {
        // Friction and armature that the file has.
        let own = {
            let mut robot = robot("puma560");
            for joint in &mut robot.joints {
                joint.viscous = Rational::new(1.into(), 3.into());
                joint.coulomb = Rational::new(5.into(), 2.into());
                joint.coulomb_width = Rational::new(1.into(), 10.into());
                joint.armature = Rational::new(1.into(), 7.into());
            }
            robot
        };
        let mut other = own.clone();
        change(&mut other);
        let diagnosis = diagnose(&own, &states(&other));
        assert_eq!(diagnosis.explained_by.len(), 1, "{words}: {diagnosis:?}");
        assert!(
            diagnosis.explained_by[0].contains(words),
            "{words}: {diagnosis:?}"
        );
    }
    let found = explained(
        "panda",
        each(|j| {
            j.inertia.xy = -&j.inertia.xy;
            j.inertia.yz = -&j.inertia.yz;
            j.inertia.xz = -&j.inertia.xz;
        }),
        same,
    );
    assert!(found.contains("products of inertia"), "{found}");
}

#[test]
fn units_and_signs_of_the_states_are_named() {
    let same = |_: &mut Robot| ();
    let degrees = |values: &mut Vec<f64>| values.iter_mut().for_each(|x| *x = x.to_degrees());
    let found = explained("puma560", same, |given| degrees(&mut given.state.q));
    assert_eq!(found, "`q` of revolute joints is taken as degrees");
    let found = explained("ur10", same, |given| {
        degrees(&mut given.state.q);
        degrees(&mut given.state.qd);
        degrees(&mut given.state.qdd);
    });
    assert_eq!(
        found,
        "`q`, `qd` and `qdd` of revolute joints are taken as degrees"
    );
    // The third joint of the Stanford arm slides.
    let found = explained("stanford", same, |given| {
        given.state.q[2] *= 1000.0;
        given.state.qd[2] *= 1000.0;
        given.state.qdd[2] *= 1000.0;
    });
    assert_eq!(
        found,
        "`q`, `qd` and `qdd` of prismatic joints are taken as mm"
    );
    let found = explained("puma560", same, |given| {
        let tau = given.known.get_mut(&Quantity::Torque).unwrap();
        tau.iter_mut().for_each(|x| *x = -*x);
    });
    assert_eq!(found, "the sign of `tau` is changed");
    let found = explained("puma560", same, |given| {
        let load = given.known[&Quantity::Gravity].clone();
        let h = given.known.get_mut(&Quantity::Coriolis).unwrap();
        h.iter_mut().zip(load).for_each(|(h, c)| *h += c);
    });
    assert_eq!(found, "`h` is taken to include the gravity load c");
    let found = explained("puma560", same, |given| {
        given.state.q[1] -= core::f64::consts::FRAC_PI_2;
    });
    assert!(
        found.starts_with("π/2 is added to `q` of joint 2"),
        "{found}"
    );
    let found = explained("puma560", same, |given| {
        let GivenState { state, known } = given;
        for values in [&mut state.q, &mut state.qd, &mut state.qdd] {
            values[2] = -values[2];
        }
        for quantity in [Quantity::Torque, Quantity::Coriolis, Quantity::Gravity] {
            let values = known.get_mut(&quantity).unwrap();
            values[2] = -values[2];
        }
        let inertia = known.get_mut(&Quantity::Inertia).unwrap();
        for other in (0..6).filter(|other| *other != 2) {
            inertia[2 * 6 + other] *= -1.0;
            inertia[other * 6 + 2] *= -1.0;
        }
    });
    assert!(found.starts_with("the axis of joint 3"), "{found}");
}

/// What no usual mistake explains is not explained, and few digits are few
/// digits.
#[test]
fn no_explanation_is_made_up() {
    let own = robot("puma560");
    let mut other = own.clone();
    other.joints[3].mass *= Rational::new(3.into(), 2.into());
    let diagnosis = diagnose(&own, &states(&other));
    assert!(diagnosis.explained_by.is_empty() && diagnosis.near.is_none());
    assert!(diagnosis.tried > 100);
    assert!(diagnosis.help().contains("none of"), "{}", diagnosis.help());

    let rounded = |robot: &Robot| {
        let mut given = states(robot);
        let values = given.iter_mut().flat_map(|given| given.known.values_mut());
        values
            .flatten()
            .for_each(|x| *x = format!("{x:.5e}").parse().unwrap());
        given
    };
    let diagnosis = diagnose(&own, &rounded(&own));
    assert!(diagnosis.explained_by.is_empty());
    assert!(
        diagnosis.help().contains("all values agree to"),
        "{}",
        diagnosis.help()
    );
    let mut other = own.clone();
    other.gravity = other.gravity.each_ref().map(|x| -x);
    let diagnosis = diagnose(&own, &rounded(&other));
    let help = diagnosis.help();
    assert!(
        help.contains("digits if the sign of the robot file's `gravity`"),
        "{help}"
    );

    let diagnosis = diagnose(&own, &states(&own));
    assert!(diagnosis.agrees && diagnosis.help().contains("generated code is wrong"));

    // Whichever quantity is given: what the runtime does not compute either is no
    // defect of the generated code.
    let mut given = states(&own);
    for given in &mut given {
        let qdd = given.state.qdd.clone();
        given.state.tau = given.known[&Quantity::Torque].clone();
        given.known = [(Quantity::Acceleration, qdd)].into();
    }
    assert!(diagnose(&own, &given).agrees);
    for given in &mut given {
        let qdd = given.known.get_mut(&Quantity::Acceleration).unwrap();
        qdd.iter_mut().for_each(|x| *x += 0.01 * (1.0 + x.abs()));
    }
    let diagnosis = diagnose(&own, &given);
    assert!(
        !diagnosis.agrees && diagnosis.explained_by.is_empty(),
        "{diagnosis:?}"
    );
}

#[test]
fn unknown_keys_are_errors_with_the_likely_word() {
    let zero = r#""q": [0, 0], "qd": [0, 0], "qdd": [0, 0]"#;
    let file = |keys: &str| format!(r#"{{"robot": 1, "states": [{{{zero}, {keys}}}]}}"#);
    for (keys, meant) in [
        (
            r#""torque": [1, 2]"#,
            "= help: torques that q, qd and qdd give are `tau`",
        ),
        (r#""Tau": [1, 2]"#, "did you mean `tau`?"),
        (r#""d": [1, 0, 0, 1]"#, "did you mean `D`?"),
        (r#""M": [1, 0, 0, 1]"#, "did you mean `D`?"),
        (r#""tua": [1, 2]"#, "did you mean `tau`?"),
        (r#""ddq": [1, 2]"#, "did you mean `qdd`?"),
        (r#""wind": [1, 2]"#, "help: a state has `q`"),
        (
            r#""regressor": [1, 2]"#,
            "`regressor` has 2 numbers, not 40",
        ),
        (
            r#""forward_dynamics": [1, 2]"#,
            "`torque` is missing, which `forward_dynamics` depends on",
        ),
        (r#""\u001b[31m": [1, 2]"#, "`\u{fffd}[31m` is no key"),
        (r#""condition": "good""#, "`condition` is a number"),
    ] {
        let FileError::Content(error) = read(file(keys).as_bytes(), 2).unwrap_err() else {
            panic!("{keys}");
        };
        let error = error.to_string();
        assert!(
            error.starts_with("state 1: ") && error.contains(meant),
            "{keys}: {error}"
        );
    }
    let good = read(file(r#""condition": 7.5, "tau": [1, 2]"#).as_bytes(), 2).unwrap();
    assert_eq!(good[0].known[&Quantity::Torque], [1.0, 2.0]);
    // What a quantity does not depend on may be left out, no more than that.
    let still = r#"{"states": [{"q": [0, 0], "c": [1, 2]}]}"#;
    assert_eq!(read(still.as_bytes(), 2).unwrap()[0].state.qdd, [0.0, 0.0]);
    let error = read(still.replace('c', "tau").as_bytes(), 2).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("`qd` is missing, which `tau` depends on")
    );
    let error = read(br#"{"samples": []}"#, 2).unwrap_err();
    assert!(error.to_string().contains("is `samples` meant?"));
}

/// `alpha = 90` for 90 degrees.
#[test]
fn angles_in_degrees() {
    let other = robot("puma560");
    let mut own = other.clone();
    for joint in &mut own.joints {
        if let Angle::PiTimes(turns) = &joint.alpha {
            joint.alpha = Angle::Radians(turns * Rational::from_integer(180.into())).canonical();
        }
    }
    let diagnosis = diagnose(&own, &states(&other));
    assert!(
        diagnosis.explained_by[0].contains("are taken as degrees"),
        "{diagnosis:?}"
    );
}
