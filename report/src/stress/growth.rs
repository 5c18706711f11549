//! How generation grows with the number of joints: seeded general chains.

use std::time::{Duration, Instant};

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Limits, Robot};

use super::deviation::Measure;
use super::subject::Code;
use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{GenerateError, generate};
use dalembert_codegen::workspace::language::MathPath;
use dalembert_codegen::workspace::program::{Counts, ScalarType};
use dalembert_codegen::workspace::random::Random;
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_codegen::workspace::states::seeded;
use dalembert_codegen::workspace::task::Request;
use dalembert_codegen::workspace::verify::reference::Reference;

/// The lengths of chain that are measured.
pub const JOINTS: [usize; 10] = [1, 2, 3, 4, 6, 8, 12, 20, 30, 60];

/// The cost of one length of chain.
#[derive(Clone, Debug)]
pub struct Growth {
    /// n
    pub joints: usize,
    /// The operation counts of inverse dynamics.
    pub counts: Counts,
    /// Generation, proof and printing.
    pub time: Duration,
    /// The module's text, for a compiler to be timed on. Sine and cosine are
    /// `super::math::sincos`, `sin` and `cos`.
    pub text: String,
    /// Worst normwise error of τ in f64 over some states, in u.
    pub error: f64,
}

/// Measures inverse dynamics of a chain of n joints in f64.
///
/// # Errors
/// Those of generating the code that is run.
pub fn measure(n: usize, request: &Request) -> Result<Growth, GenerateError> {
    let robot = chain(n, n as u64);
    let request = Request {
        functions: vec![Function::InverseDynamics],
        scalars: vec![ScalarType::F64],
        math: MathPath::libm("super::math"),
        ..request.clone()
    };
    let begin = Instant::now();
    let generated = generate(&robot, &request)?;
    let time = begin.elapsed();
    let code = Code::Emitted(generated.emitted);
    let reference = Reference::new(&SceneRobot::whole(&robot));
    let measure = Measure::new(&robot, ScalarType::F64, Vec::new());
    let mut error = 0.0f64;
    for state in seeded(&robot, 20, 1) {
        let run = Function::InverseDynamics;
        if let Some(found) = code.run(run, &state) {
            error = error.max(measure.of(&found, &reference.run(run, &state)).normwise);
        }
    }
    let counts = generated.functions.first().map(|f| f.counts());
    Ok(Growth {
        joints: n,
        counts: counts.unwrap_or_default(),
        time,
        text: generated.text,
        error,
    })
}

/// Returns a general chain: right twists every other joint as arms have them, all
/// other parameters their own, with three decimals.
pub fn chain(n: usize, seed: u64) -> Robot {
    let mut random = Random::new(seed);
    let mut decimal = |low: i64, high: i64| {
        let drawn = low + random.below((high - low + 1) as usize) as i64;
        Rational::new(drawn.into(), 1000.into())
    };
    let joint = |index: usize| {
        let mass = decimal(500, 3000);
        // Moments of a body: of three the largest is below the sum of others.
        let [xx, yy, zz] = [0; 3].map(|_| decimal(10, 19));
        Joint {
            name: None,
            kind: JointKind::Revolute,
            alpha: match index % 4 {
                0 => Angle::right_angles(1),
                2 => Angle::right_angles(-1),
                _ => Angle::Radians(decimal(-1000, 1000)).canonical(),
            },
            beta: Angle::default(),
            a: decimal(10, 300),
            d: decimal(10, 300),
            theta: Angle::default(),
            mass,
            com: [0; 3].map(|_| decimal(-100, 100)),
            inertia: {
                let [xy, yz, xz] = [0; 3].map(|_| decimal(-1, 1));
                Inertia::of([xx, yy, zz, xy, yz, xz])
            },
            viscous: Rational::default(),
            coulomb: Rational::default(),
            coulomb_width: Rational::default(),
            armature: Rational::default(),
            frame: None,
            limits: Limits::default(),
        }
    };
    Robot {
        name: "chain".into(),
        convention: Convention::Standard,
        gravity: [1.3, -2.1, -9.4].map(|x| Rational::new(((x * 10.0) as i64).into(), 10.into())),
        base: None,
        tool: None,
        payload_frame: None,
        joints: (0..n.min(Robot::MAX_JOINTS)).map(joint).collect(),
        followers: Vec::new(),
        frames: Vec::new(),
    }
}
