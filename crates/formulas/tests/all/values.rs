//! The printed SymPy text gives the runtime's values: D, h_ikm, c_i and everything else.

use std::collections::HashMap;
use std::fs;

use dalembert_codegen::workspace::Random;
use dalembert_formulas::{Digits, Formulas, Layout, Quantity, Request, Style};
use dalembert_model::number::Rounded;
use dalembert_model::outputs::{Argument, Quantity as Output};
use dalembert_model::read::parse;
use dalembert_model::reference::{JointVectors, Reference};
use dalembert_model::robot::{Position, Robot, write};
use dalembert_model::scene::Scene;
use nalgebra::DVector;

use crate::draw::{Draw, robots};
use crate::python::{Module, Values};

const STATES: usize = 50;
const STYLES: [Style; 3] = [Style::Numbers, Style::Names, Style::Constants];

pub fn read(path: &str) -> (Robot, Vec<Scene>) {
    let path = format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"));
    let reading = parse(&fs::read_to_string(&path).unwrap()).unwrap();
    (reading.robot, reading.scenes)
}

fn module(robot: &Robot, scene: Option<&Scene>, style: Style, quantities: &[Quantity]) -> Module {
    let quantities = quantities.to_vec();
    let formulas = Formulas::new(robot, scene, &Request { quantities, style }).unwrap();
    Module::read(&formulas.write(Layout::Sympy, Digits::Six))
}

/// Compares entries with the runtime's, relative to the largest of each kind.
fn agrees(robot: &Robot, scene: Option<&Scene>, style: Style) {
    let quantities = [Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity];
    let module = module(robot, scene, style, &quantities);
    let runtime =
        Reference::<f64>::from_robot(&scene.map_or(robot.clone(), |scene| scene.apply(robot)));
    let n = robot.joints.len();
    let lock = |joint: usize| match scene?.locked(joint)? {
        Position::Angle(angle) => Some(angle.to_f64()),
        Position::Length(length) => Some(f64::nearest_rational(length)),
    };
    let rows = scene.map_or((0..n).collect(), |scene| scene.rows(n));
    let mut random = Random::new(0x666f_726d);
    for _ in 0..STATES {
        let q = (0..n).map(|i| lock(i).unwrap_or(3.0 * random.unit()));
        let q: Vec<f64> = q.collect();
        let mut inputs = HashMap::new();
        for (i, value) in q.iter().enumerate() {
            inputs.insert(format!("q{}", i + 1), *value);
            inputs.insert(format!("dq{}", i + 1), random.unit());
            inputs.insert(format!("ddq{}", i + 1), random.unit());
        }
        let values = module.run(&inputs);
        let at = DVector::from_column_slice(&q);
        let (d, c) = (runtime.inertia(&at).unwrap(), runtime.gravity(&at).unwrap());
        let h = runtime.christoffel(&at).unwrap();
        let m = rows.len();
        let pairs = || (0..m).flat_map(|i| (0..m).map(move |k| (i, k)));
        let inertia: Vec<f64> = pairs().map(|(i, k)| d[(rows[i], rows[k])]).collect();
        close(&values, "D", &inertia, robot);
        let mut christoffel = Vec::new();
        for h in rows.iter().map(|&i| &h[i]) {
            christoffel.extend(pairs().map(|(k, l)| h[(rows[k], rows[l])]));
        }
        close(&values, "h", &christoffel, robot);
        let gravity: Vec<f64> = rows.iter().map(|&i| c[i]).collect();
        close(&values, "c", &gravity, robot);
    }
}

fn close(values: &Values<'_>, list: &str, wanted: &[f64], robot: &Robot) {
    let size = wanted.iter().fold(1e-3f64, |size, x| size.max(x.abs()));
    for (place, wanted) in wanted.iter().enumerate() {
        let (name, entry) = (&robot.name, format!("{list}[{place}]"));
        let value = values.of(&entry);
        let is_close = (value - wanted).abs() <= 1e-12 * size;
        assert!(is_close, "{name}: {entry} = {value}, wanted {wanted}");
    }
}

#[test]
fn the_robots_of_the_paper_and_others() {
    for name in [
        "planar2r", "planar3r", "puma560", "stanford", "ur10", "panda",
    ] {
        let (robot, _) = read(&format!("generated/robots/{name}.toml"));
        for style in STYLES {
            agrees(&robot, None, style);
        }
    }
}

#[test]
fn slides_and_odd_angles() {
    for name in [
        "scara",
        "gantry",
        "rprpr",
        "gen3",
        "wafer",
        "general6r",
        "base_and_tool",
    ] {
        let (robot, _) = read(&format!("codegen/tests/data/{name}.toml"));
        agrees(&robot, None, Style::Numbers);
        agrees(&robot, None, Style::Names);
    }
}

#[test]
fn robots_of_the_gallery() {
    let names = [
        "e0509",
        "elfin5",
        "fr3",
        "iiwa14",
        "j2s7s300",
        "open_manipulator",
        "qarm",
        "so101",
        "ur5",
        "xarm7",
    ];
    for name in names {
        let (robot, _) = read(&format!("gallery/robots/{name}.toml"));
        agrees(&robot, None, Style::Numbers);
        agrees(&robot, None, Style::Constants);
    }
}

#[test]
fn trees_and_joints_that_follow_others() {
    for name in ["panda_gripper", "baxter_both_arms"] {
        let (robot, _) = read(&format!("gallery/robots/{name}.toml"));
        agrees(&robot, None, Style::Numbers);
        agrees(&robot, None, Style::Names);
    }
}

/// Slides and lengths of rows had one name, d2.
#[test]
fn slides_and_lengths_have_different_names() {
    for name in [
        "follower_before_slide",
        "slide_with_follower",
        "slides_on_limbs",
    ] {
        let (robot, _) = read(&format!("crates/formulas/tests/data/{name}.toml"));
        for style in STYLES {
            agrees(&robot, None, style);
        }
    }
}

#[test]
fn robots_that_nobody_chose() {
    for (_, robot, _) in robots(10, 0xf0_4a) {
        agrees(&robot, None, Style::Numbers);
        agrees(&robot, None, Style::Names);
    }
}

#[test]
fn joints_that_are_locked() {
    let mut draw = Draw(Random::new(0x10c));
    for joint in 2..=4 {
        let robot = draw.robot(5);
        let text = write(&robot) + &format!("\n[scene.held]\nlock = {{ {joint} = 0.25 }}\n");
        let reading = parse(&text).unwrap();
        agrees(&reading.robot, reading.scenes.first(), Style::Numbers);
        agrees(&reading.robot, reading.scenes.first(), Style::Names);
    }
}

fn scene_of(robot: &Robot, lines: &str) -> (Robot, Vec<Scene>) {
    let reading = parse(&format!("{}\n[scene.held]\n{lines}\n", write(robot))).unwrap();
    (reading.robot, reading.scenes)
}

/// A scene that holds velocities at zero leaves no Coriolis terms, one that holds accelerations no
/// inertia.
#[test]
fn rates_that_a_scene_holds_at_zero_are_absent() {
    let (robot, _) = read("generated/robots/puma560.toml");
    let request = Request {
        quantities: vec![Quantity::Torque],
        style: Style::Numbers,
    };
    for (rate, absent) in [("velocity", "q\u{307}"), ("acceleration", "q\u{308}")] {
        let (robot, scenes) = scene_of(&robot, &format!("{rate} = \"zero\""));
        for (scene, is_absent) in [(None, false), (scenes.first(), true)] {
            let formulas = Formulas::new(&robot, scene, &request).unwrap();
            let entries = formulas.entries(Digits::Six);
            let (_, torque) = entries.iter().find(|(name, _)| name == "tau_3").unwrap();
            assert_eq!(torque.contains(absent), !is_absent, "{rate}: {torque}");
        }
    }
}

#[test]
fn indices_of_a_scenes_results_are_explained() {
    let (robot, _) = read("generated/robots/puma560.toml");
    let (robot, scenes) = scene_of(&robot, "joints = [2, 4]");
    let request = Request {
        quantities: vec![Quantity::Inertia],
        style: Style::Numbers,
    };
    let formulas = Formulas::new(&robot, scenes.first(), &request).unwrap();
    let note = "count the scene's results: 1 is joint 2, 2 is joint 4";
    for layout in [Layout::Text, Layout::Markdown, Layout::Latex] {
        assert!(formulas.write(layout, Digits::Six).contains(note));
    }
}

/// Names of joints may have letters that Markdown or LaTeX read as marks.
#[test]
fn names_are_escaped() {
    let (mut robot, _) = read("generated/robots/planar2r.toml");
    robot.joints[0].name = Some("a|b_<c>*d*#1".to_owned());
    let request = Request {
        quantities: vec![Quantity::Inertia],
        style: Style::Names,
    };
    let formulas = Formulas::new(&robot, None, &request).unwrap();
    let written = |layout: Layout| formulas.write(layout, Digits::Six);
    assert!(written(Layout::Markdown).contains("a\\|b\\_\\<c\\>\\*d\\*\\#1"));
    assert!(written(Layout::Latex).contains("a\\textbar{}b\\_\\textless{}c\\textgreater{}*d*\\#1"));
}

/// Energies, torques, pose and Jacobian, and the parts of generalized D'Alembert, which add up.
#[test]
fn everything_else() {
    for name in [
        "generated/robots/planar2r",
        "generated/robots/puma560",
        "codegen/tests/data/rprpr",
    ] {
        let (robot, _) = read(&format!("{name}.toml"));
        let n = robot.joints.len();
        let runtime = Reference::<f64>::from_robot(&robot);
        let mut random = Random::new(7);
        for style in STYLES {
            let module = module(&robot, None, style, &Quantity::ALL);
            let mut inputs = HashMap::new();
            let mut drawn = |name: &str| {
                let values: Vec<f64> = (0..n).map(|_| random.unit()).collect();
                for (i, value) in values.iter().enumerate() {
                    inputs.insert(format!("{name}{}", i + 1), *value);
                }
                DVector::from_vec(values)
            };
            let [q, qd, qdd] = ["q", "dq", "ddq"].map(&mut drawn);
            let values = module.run(&inputs);
            let at = JointVectors::new([
                (Argument::Position, q.clone()),
                (Argument::Velocity, qd.clone()),
                (Argument::Acceleration, qdd.clone()),
            ]);
            let entries = |output| runtime.entries(output, &at).unwrap();
            let mut torques = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
            for (i, joint) in robot.joints.iter().enumerate() {
                torques[i] -= f64::nearest_rational(&joint.viscous) * qd[i];
            }
            close(&values, "tau", torques.as_slice(), &robot);
            close(&values, "J", &entries(Output::Jacobian), &robot);
            close(&values, "Drot", &entries(Output::RotationInertia), &robot);
            let translation = entries(Output::TranslationInertia);
            close(&values, "Dtran", &translation, &robot);
            let single = |name: &str, wanted: f64| {
                let value = values.of(name);
                let is_close = (value - wanted).abs() <= 1e-12 * (1.0 + wanted.abs());
                assert!(is_close, "{name}: {value} {wanted}");
            };
            single("T", entries(Output::KineticEnergy)[0]);
            single("U", entries(Output::PotentialEnergy)[0]);
            let hand = runtime.hand(&q).unwrap();
            for (axis, value) in ["px", "py", "pz"].into_iter().zip(hand.origin) {
                single(axis, value);
            }
            let rows = (0..3).flat_map(|r| (0..3).map(move |c| (r, c)));
            let rotation: Vec<f64> = rows.map(|(r, c)| hand.axes[c][r]).collect();
            close(&values, "Rot", &rotation, &robot);
            for place in 0..n * n * n {
                let [whole, rot, tran] =
                    ["h", "hrot", "htran"].map(|list| values.of(&format!("{list}[{place}]")));
                assert!((whole - rot - tran).abs() <= 1e-12, "{name}: {place}");
            }
        }
    }
}
