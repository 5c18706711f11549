//! What is checked in is what the command makes; the robots are sound.

use std::fs;

use dalembert_codegen::workspace::seeded;
use dalembert_gallery::arms::ARMS;
use dalembert_gallery::made::{Made, counts};
use dalembert_gallery::{folder, page};
use dalembert_model::equations::{Arm, Formulation, JointPosition, SinCosPair};
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::read;
use dalembert_model::reference::Reference;
use dalembert_model::robot::{JointKind, Robot};
use nalgebra::DVector;

fn text(name: &str) -> String {
    fs::read_to_string(folder().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A change of the importer, the reader or the drawing shows here.
#[test]
fn imports_and_pictures_are_what_is_checked_in() {
    for arm in &ARMS {
        let made = Made::of(arm).unwrap_or_else(|why| panic!("{why}"));
        for (name, expected) in made.files() {
            // Not assert_eq: nobody reads two drawings on one line.
            assert!(
                text(&name) == expected,
                "{name}: run cargo run --release -p dalembert-gallery"
            );
            assert!(expected.len() < 60_000, "{name} is large");
        }
        // What is read is what was imported, its head and all.
        let reading = read::parse(&text(&arm.robot_file()), &read::Options::default());
        assert_eq!(reading.unwrap().robot, made.robot, "{}", arm.name);
    }
}

/// What vanishes when frames are derived is zero, and no dust of 256 bits: it would
/// cost operations as any other number does.
#[test]
fn no_length_is_dust() {
    for arm in &ARMS {
        let robot = Made::of(arm).unwrap_or_else(|why| panic!("{why}")).robot;
        for joint in &robot.joints {
            let lengths = joint.com.iter().chain([&joint.a, &joint.d]);
            for length in lengths.map(f64::nearest_rational) {
                let size = length.abs();
                assert!(size == 0.0 || size > 1e-30, "{} {:?}", arm.name, joint.name);
            }
        }
    }
}

/// Nothing is there that the command does not make, and every licence is named.
#[test]
fn every_file_belongs_to_an_arm_with_a_licence() {
    let licences = text("LICENCES.md");
    let names = |part: &str| -> Vec<String> {
        let entries = fs::read_dir(folder().join(part)).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| format!("{part}/{}", entry.unwrap().file_name().to_str().unwrap()))
            .collect();
        names.sort();
        names
    };
    let sorted = |of: &dyn Fn(&'static dalembert_gallery::arms::Arm) -> String, part: &str| {
        let mut found: Vec<String> = ARMS.iter().map(of).collect();
        found.retain(|name| name.starts_with(part));
        found.sort();
        found
    };
    assert_eq!(names("robots"), sorted(&|arm| arm.robot_file(), "robots/"));
    assert_eq!(names("pictures"), sorted(&|arm| arm.picture(), "pictures/"));
    assert_eq!(names("urdf"), sorted(&|arm| arm.path().to_owned(), "urdf/"));
    for arm in &ARMS {
        let known = ["BSD", "Apache-2.0", "MIT"];
        assert!(
            known.iter().any(|word| arm.licence.starts_with(word)),
            "{}",
            arm.name
        );
        if arm.path().ends_with(".urdf") {
            let file = arm.path().rsplit('/').next().unwrap();
            assert!(
                licences.contains(&format!("`{file}`")),
                "LICENCES.md does not say under which licence {file} is"
            );
        }
    }
}

/// The table's figures, of the arms that are searched in a second; `--check` of the
/// command, in .ci/run, has all of them.
#[test]
fn the_table_has_the_counts() {
    let page = text("README.md");
    for arm in &ARMS {
        let made = Made::of(arm).unwrap();
        assert!(page.contains(&format!("\n## {}\n", arm.name)));
        if made.robot.joints.len() <= 4 {
            let counts = counts(&made.robot).unwrap();
            let row = page::row(&made, &counts);
            assert!(page.contains(&row), "the page has no row\n{row}");
        }
    }
}

/// The runtime is a recursion in link axes that folds away what a fixed base cannot
/// feel; Lagrange–Euler folds nothing and shares no formula with it.
#[test]
fn torques_of_the_runtime_are_those_of_lagrange_euler() {
    for arm in &ARMS {
        let robot = Made::of(arm).unwrap().robot;
        let runtime = Reference::<f64>::from_robot(&robot);
        let exact: Arm<Exact> = Arm::from_robot(&robot, &mut Exact::clone);
        let rounded = exact.map(f64::nearest);
        for state in seeded(&robot, 3, 0x6761) {
            let expected = Formulation::LagrangeEuler.inverse_dynamics(
                &rounded,
                &rounded.at(&positions(&robot, &state.q)),
                &state.qd,
                &state.qdd,
            );
            let [q, qd, qdd] =
                [&state.q, &state.qd, &state.qdd].map(|x| DVector::from_column_slice(x));
            let found = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
            let largest = expected.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            assert!(largest > 0.0 && largest.is_finite(), "{}", arm.name);
            for (found, expected) in found.iter().zip(&expected) {
                let off = (found - expected).abs() / largest;
                assert!(off < 1e-12, "{}: {off:e}", arm.name);
            }
        }
    }
}

fn positions(robot: &Robot, q: &[f64]) -> Vec<JointPosition<f64>> {
    let joints = robot.joints.iter().zip(q);
    let position = |(joint, &q): (&dalembert_model::robot::Joint, &f64)| match joint.kind {
        JointKind::Revolute => {
            let (sin, cos) = libm::sincos(q);
            JointPosition::Revolute(SinCosPair { sin, cos })
        }
        JointKind::Prismatic => JointPosition::Prismatic(q),
    };
    joints.map(position).collect()
}
