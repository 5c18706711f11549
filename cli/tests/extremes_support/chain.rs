//! General chains of any length.

use dalembert_codegen::workspace::Random;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Inertia, Joint, Robot};

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
            alpha: match index % 4 {
                0 => Angle::right_angles(1),
                2 => Angle::right_angles(-1),
                _ => Angle::Radians(decimal(-1000, 1000)).canonical(),
            },
            a: decimal(10, 300),
            d: decimal(10, 300),
            mass,
            com: [0; 3].map(|_| decimal(-100, 100)),
            inertia: {
                let [xy, yz, xz] = [0; 3].map(|_| decimal(-1, 1));
                Inertia::of([xx, yy, zz, xy, yz, xz])
            },
            ..Joint::default()
        }
    };
    Robot {
        name: "chain".into(),
        gravity: [1.3, -2.1, -9.4].map(|x| Rational::new(((x * 10.0) as i64).into(), 10.into())),
        joints: (0..n.min(Robot::MAX_JOINTS)).map(joint).collect(),
        ..Robot::default()
    }
}
