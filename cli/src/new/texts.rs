//! What is in the files of a new crate.

/// A robot to begin with: two links in a vertical plane.
pub(super) const ROBOT: &str = "\
# Two links of a metre and a kilogram in a vertical plane: put your arm here.

name = \"planar\"
convention = \"standard\"
gravity = [0, -9.81, 0]

[[joint]]
name = \"shoulder\"
kind = \"revolute\"
a = 1
mass = 1
com = [-0.5, 0, 0]
inertia = [0, \"1/12\", \"1/12\", 0, 0, 0]
limits = { position = [\"-pi\", \"pi\"], velocity = 3, acceleration = 10, torque = 60 }

[[joint]]
name = \"elbow\"
kind = \"revolute\"
a = 1
mass = 1
com = [-0.5, 0, 0]
inertia = [0, \"1/12\", \"1/12\", 0, 0, 0]
limits = { position = [\"-pi\", \"pi\"], velocity = 3, acceleration = 10, torque = 30 }
";

/// The crates that the new one depends on.
pub(super) const DEPENDENCIES: [&str; 2] = ["dalembert", "nalgebra"];

/// Returns Cargo.toml. It is a workspace of its own, wherever it is put.
pub(super) fn manifest(name: &str, dependency: &str) -> String {
    format!(
        "[package]\nname = \"{name}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
         [dependencies]\ndalembert = {{ {dependency} }}\n\n\
         [dev-dependencies]\nnalgebra = {{ version = \"0.35\", default-features = false }}\n\n\
         # The macro searches and proves while it expands.\n\
         [profile.dev.build-override]\nopt-level = 3\n\n\
         [profile.release.build-override]\nopt-level = 3\n\n[workspace]\n"
    )
}

/// Returns src/main.rs: the macro, torques, and a test against the runtime.
pub(super) fn source(robot: &str, joints: usize) -> String {
    SOURCE
        .replace("ROBOT", robot)
        .replace("JOINTS", &joints.to_string())
}

const SOURCE: &str = "\
//! The torques of ROBOT.

dalembert::dynamics! {
    /// From its robot file.
    pub mod ROBOT = \"robots/ROBOT.toml\";
    outputs: inverse_dynamics, gravity;
    scalar: f64;
}

fn main() {
    let q = [0.1; JOINTS];
    let hold = ROBOT::gravity(&q);
    let start = ROBOT::inverse_dynamics(&q, &[0.0; JOINTS], &[1.0; JOINTS]);
    println!(\"to hold still at q = {q:?}: {hold:.3?}\");
    println!(\"to speed up by 1 per second squared: {start:.3?}\");
}

#[cfg(test)]
mod tests {
    use dalembert::read;
    use dalembert::reference::Reference;
    use nalgebra::DVector;

    use super::ROBOT;

    /// The generated code against the recursion that serves any arm.
    #[test]
    fn the_code_agrees_with_the_runtime() {
        let file = include_str!(\"../robots/ROBOT.toml\");
        let reading = read::parse(file, &read::Options::default()).expect(\"a robot\");
        let runtime = Reference::<f64>::from_robot(&reading.robot);
        for step in 0..20 {
            let value = |k: usize, size: f64| size * ((7 * step + 3 * k) as f64).sin();
            let q: [f64; JOINTS] = core::array::from_fn(|k| value(k, 1.5));
            let qd: [f64; JOINTS] = core::array::from_fn(|k| value(k + 1, 2.0));
            let qdd: [f64; JOINTS] = core::array::from_fn(|k| value(k + 2, 5.0));
            let [a, b, c] = [&q, &qd, &qdd].map(|x| DVector::from_column_slice(x));
            let expected = runtime.inverse_dynamics(&a, &b, &c).expect(\"as many values\");
            let found = ROBOT::inverse_dynamics(&q, &qd, &qdd);
            let largest = expected.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            for (found, expected) in found.iter().zip(expected.iter()) {
                assert!((found - expected).abs() < 1e-12 * largest);
            }
        }
    }
}
";
