//! Robots of extreme numbers: what was proved is never said to be contradicted. The
//! errors that are measured where code is run, and the bounds that they are held
//! against, overflow and underflow as the code does.

use dalembert_codegen::workspace::Random;
use dalembert_codegen::{Function, GenerateError, Request, generate};
use dalembert_model::read::{self, Reading};

use crate::support;

/// Warnings that such numbers deserve, and that are no news here.
const ALLOW: &str = "allow = [\"impossible_inertia\", \"unusual_gravity\", \"large_length\", \
                     \"large_mass\", \"large_angle\", \"large_limit\", \"large_velocity\"]\n";

/// Returns a number whose size is a random power of ten up to `span` either way.
fn number(random: &mut Random, span: f64) -> f64 {
    let sign = if random.below(3) == 0 { -1.0 } else { 1.0 };
    let digits = 1.0 + 9.0 * random.unit();
    let power = span * (2.0 * random.unit() - 1.0);
    format!("{:.3}e{}", sign * digits, power.round())
        .parse()
        .unwrap()
}

/// Returns an arm whose lengths, masses, rates and gravity each are ordinary or extreme.
fn arm(seed: usize) -> String {
    let mut random = Random::new(seed as u64);
    let sizes = [3.0, 9.0, 30.0, 60.0, 100.0, 140.0];
    let size = sizes[random.below(sizes.len())];
    let mut span = || if random.below(2) == 0 { size } else { 1.0 };
    let [length, mass, rate, gravity] = [span(), span(), span(), span()];
    let conventions = ["standard", "modified"];
    let mut text = format!(
        "name = \"extreme\"\nconvention = \"{}\"\ngravity = [{:e}, 0, {:e}]\n{ALLOW}",
        conventions[random.below(2)],
        number(&mut random, gravity),
        number(&mut random, gravity)
    );
    for _ in 0..1 + random.below(3) {
        let slides = random.below(3) == 0;
        let (kind, other) = if slides {
            ("prismatic", "theta")
        } else {
            ("revolute", "d")
        };
        let twist = ["0", "\"pi/2\"", "0.3"][random.below(3)];
        let moment = number(&mut random, mass).abs();
        text += &format!(
            "[[joint]]\nkind = \"{kind}\"\nalpha = {twist}\na = {:e}\n",
            number(&mut random, length)
        );
        let other_span = if slides { 0.5 } else { length };
        text += &format!("{other} = {:e}\n", number(&mut random, other_span));
        text += &format!("mass = {:e}\n", number(&mut random, mass).abs());
        let [x, y, z] = [(); 3].map(|()| number(&mut random, length));
        text += &format!("com = [{x:e}, {y:e}, {z:e}]\n");
        text += &format!("inertia = [{moment:e}, {moment:e}, {moment:e}, 0, 0, 0]\n");
        let reach = number(&mut random, if slides { length } else { 2.0 }).abs();
        let [speed, change, torque] =
            [rate, rate, mass].map(|span| number(&mut random, span).abs());
        text += &format!(
            "limits = {{ position = [-{reach:e}, {reach:e}], velocity = {speed:e}, \
             acceleration = {change:e}, torque = {torque:e} }}\n"
        );
    }
    text
}

fn reading(seed: usize, scene: &str) -> Reading {
    let source = arm(seed) + scene;
    read::parse(&source, &read::Options::default()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Asserts that no defect is reported that there is not, refused or not.
fn never_contradicted(reading: &Reading, request: &Request, seed: usize) -> bool {
    match generate(&reading.robot, request) {
        Ok(_) => true,
        Err(error @ (GenerateError::Defect(..) | GenerateError::Disproved(..))) => {
            panic!("seed {seed}: {error}\n{}", arm(seed))
        }
        Err(_) => false,
    }
}

/// So many arms; fewer of them where nothing is optimised.
const ARMS: usize = if cfg!(debug_assertions) { 12 } else { 40 };

const OUTPUTS: [Function; 8] = [
    Function::InverseDynamics,
    Function::Gravity,
    Function::Inertia,
    Function::Coriolis,
    Function::ForwardDynamics,
    Function::KineticEnergy,
    Function::Jacobian,
    Function::Regressor,
];

#[test]
fn exact_programs_are_not_contradicted() {
    let mut done = 0;
    for seed in 0..ARMS {
        let reading = reading(seed, "");
        for scalars in support::each_scalar() {
            let request = Request {
                scalars,
                ..Request::of(&[OUTPUTS[seed % OUTPUTS.len()]])
            };
            done += usize::from(never_contradicted(&reading, &request, seed));
        }
    }
    assert!(done > ARMS / 2, "{done}");
}

/// Certificates, too: E is a bound wherever there is one.
#[test]
fn certificates_are_not_contradicted() {
    let mut done = 0;
    for seed in 0..ARMS / 2 {
        let outputs = ["inverse_dynamics", "gravity", "inertia", "coriolis"];
        let scene = format!(
            "[scene.t]\noutputs = [\"{}\"]\ntolerance = {{ value = 1e-2, relative_to = \"range\" }}\n",
            outputs[seed % outputs.len()]
        );
        let reading = reading(seed, &scene);
        let request = Request::default().in_scene(&reading.scenes[0]);
        done += usize::from(never_contradicted(&reading, &request, seed));
    }
    assert!(done > ARMS / 8, "{done}");
}

/// A rate beyond f32: the state that is tried has the largest number in its place,
/// so an entry that hands it on is one.
#[test]
fn limits_beyond_f32_leave_states_finite() {
    let arm = "name = \"fast\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n\
               allow = [\"large_velocity\"]\n[[joint]]\nkind = \"prismatic\"\nmass = 1\n\
               com = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n\
               limits = { position = [-1, 1], velocity = 1e100, acceleration = 1e120, torque = 1 }\n";
    let generated = support::one(&support::read_robot(arm), Function::Regressor);
    assert!(!generated.functions.is_empty());
}
