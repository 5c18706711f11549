//! τ = Y π with the ten numbers that the model itself gives of each link, in the frame of that link,
//! what is fixed to it included.

use crate::support::{data, exact, imported, source, taken, to};
use dalembert_import::Options;
use dalembert_model::outputs::Argument::{Acceleration, Position, Velocity};
use dalembert_model::outputs::Quantity;
use dalembert_model::reference::{JointVectors, Reference};
use dalembert_model::robot::Robot;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_traits::ToPrimitive;
use roxmltree::{Document, Node};

/// The mass, the first moments, and the tensor about the origin.
type Parameters = [f64; 10];

fn list(node: Node, key: &str, otherwise: &str) -> Vec<f64> {
    let text = node.attribute(key).unwrap_or(otherwise);
    let numbers = text.split_whitespace();
    numbers.map(|x| x.parse().unwrap()).collect()
}

fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|node| node.has_tag_name(tag))
}

#[derive(Clone, Copy)]
struct Pose(Matrix3<f64>, Vector3<f64>);

impl Pose {
    fn identity() -> Pose {
        Pose(Matrix3::identity(), Vector3::zeros())
    }

    fn then(self, Pose(turned, at): Pose) -> Pose {
        Pose(self.0 * turned, self.1 + self.0 * at)
    }
}

fn add(sum: &mut Parameters, mass: f64, inertia: Matrix3<f64>, at: Pose) {
    let Pose(turned, c) = at;
    let about_centre = turned * inertia * turned.transpose();
    let tensor = about_centre + mass * (Matrix3::identity() * c.dot(&c) - c * c.transpose());
    let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
    let moments = c.iter().map(|x| mass * x);
    let tensor = places.map(|place| tensor[place]);
    let parts = [mass].into_iter().chain(moments).chain(tensor);
    for (sum, part) in sum.iter_mut().zip(parts) {
        *sum += part;
    }
}

fn origin(node: Node) -> Pose {
    let origin = child(node, "origin");
    let list = |key| origin.map_or(vec![0.0; 3], |origin| list(origin, key, "0 0 0"));
    let rpy = list("rpy");
    let [sr, sp, sy] = [0, 1, 2].map(|i| rpy[i].sin());
    let [cr, cp, cy] = [0, 1, 2].map(|i| rpy[i].cos());
    let about_x = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
    let about_y = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
    let about_z = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
    let at = Vector3::from_column_slice(&list("xyz"));
    Pose(about_z * about_y * about_x, at)
}

fn add_link(sum: &mut Parameters, root: Node, link: &str, at: Pose, moving: &[String]) {
    let tagged = |tag: &'static str| root.children().filter(move |node| node.has_tag_name(tag));
    let link_node = tagged("link").find(|node| node.attribute("name") == Some(link));
    if let Some(inertial) = child(link_node.unwrap(), "inertial") {
        let number = |tag: &str, key: &str| list(child(inertial, tag).unwrap(), key, "0")[0];
        let [xx, yy, zz, xy, yz, xz] =
            ["ixx", "iyy", "izz", "ixy", "iyz", "ixz"].map(|key| number("inertia", key));
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let mass = number("mass", "value");
        add(sum, mass, inertia, at.then(origin(inertial)));
    }
    for joint in tagged("joint") {
        let end = |tag: &str| child(joint, tag).and_then(|node| node.attribute("link"));
        let name = joint.attribute("name");
        let is_moving = moving.iter().any(|moving| name == Some(moving.as_str()));
        if end("parent") == Some(link) && !is_moving {
            let at = at.then(origin(joint));
            add_link(sum, root, end("child").unwrap(), at, moving);
        }
    }
}

fn parameters(robot: &Robot, text: &str) -> Vec<f64> {
    let document = Document::parse(text).unwrap();
    let root = document.root_element();
    let joints = robot.joints.iter();
    let names: Vec<String> = joints.map(|joint| joint.name.clone().unwrap()).collect();
    let link = |name: &String| {
        let mut sum = [0.0; 10];
        let named = |node: &Node| node.attribute("name") == Some(name.as_str());
        let joint = |node: &Node| node.has_tag_name("joint") && named(node);
        let joint = root.children().find(joint).unwrap();
        let link = child(joint, "child").unwrap().attribute("link").unwrap();
        add_link(&mut sum, root, link, Pose::identity(), &names);
        sum
    };
    names.iter().flat_map(link).collect()
}

/// Compares Y π with the torques, relative to what the sums are made of.
fn check(name: &str, robot: &Robot, text: &str) {
    let n = robot.joints.len();
    let pi = DVector::from_vec(parameters(robot, text));
    let runtime = Reference::<f64>::from_robot(robot);
    for state in 0..8 {
        let [q, qd, qdd] = [1.7, 2.3, 5.9].map(|most| {
            DVector::from_fn(n, |i, _| most * f64::sin(most * (1 + i + n * state) as f64))
        });
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let drives = DVector::from_fn(n, |i, _| {
            let [viscous, armature] = [&robot.joints[i].viscous, &robot.joints[i].armature]
                .map(|load| load.to_f64().unwrap());
            viscous * qd[i] + armature * qdd[i]
        });
        let arguments = [(Position, q), (Velocity, qd), (Acceleration, qdd)];
        let y = runtime.entries(Quantity::LinkRegressor, &JointVectors::new(arguments));
        let y = DMatrix::from_row_slice(n, 10 * n, &y.unwrap());
        let size = (y.abs() * pi.abs()).amax();
        let off = (&y * &pi + drives - tau).amax() / size;
        assert!(off < 1e-12, "{name}: {off:e}");
    }
}

fn robot(text: &str, tip: &str) -> Robot {
    let options = Options {
        exact: true,
        ..to(tip, &[])
    };
    taken(text, &options).robot
}

#[test]
fn the_numbers_of_a_urdf_give_the_torques() {
    let text = data("../../../../gallery/urdf/iiwa14.urdf");
    check("iiwa14", &robot(&text, "iiwa_link_ee"), &text);
    for name in ["panda", "z1", "so101"] {
        check(name, &imported(name, &exact(name)).robot, &source(name));
    }
}
