//! An arm without special numbers, the same on every run.

use dalembert_codegen::workspace::random::Random;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Limits, Robot};

/// n revolute joints; every parameter has three random decimals.
pub fn robot(n: usize) -> Robot {
    let mut random = Random::new(0x7ab1e3);
    let mut milli = |low: u64, high: u64| {
        let value = low + random.bits() % (high - low);
        Rational::new(value.into(), 1000.into())
    };
    let gravity = [milli(1000, 2000), -milli(1000, 2000), -milli(9000, 9500)];
    let joints = (0..n)
        .map(|_| Joint {
            name: None,
            kind: JointKind::Revolute,
            alpha: Angle::Radians(milli(200, 1400)),
            beta: Angle::default(),
            a: milli(100, 600),
            d: milli(100, 600),
            theta: Angle::default(),
            mass: milli(1000, 9000),
            com: [milli(10, 200), milli(10, 200), milli(10, 200)],
            inertia: Inertia {
                xx: milli(400, 500),
                yy: milli(400, 500),
                zz: milli(400, 500),
                xy: milli(10, 100),
                yz: milli(10, 100),
                xz: milli(10, 100),
            },
            viscous: Rational::default(),
            coulomb: Rational::default(),
            coulomb_width: Rational::default(),
            armature: Rational::default(),
            limits: Limits::default(),
        })
        .collect();
    Robot {
        name: "generic".to_owned(),
        convention: Convention::Standard,
        gravity,
        base: None,
        tool: None,
        payload_frame: None,
        joints,
    }
}
