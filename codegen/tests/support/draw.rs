//! Robots that nobody chose.

use dalembert_codegen::workspace::Random;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Robot};

pub struct Draw(pub Random);

impl Draw {
    pub fn chance(&mut self, one_in: usize) -> bool {
        self.0.below(one_in) == 0
    }

    pub fn milli(&mut self, low: i64, high: i64) -> Rational {
        let value = low + self.0.below((high - low) as usize) as i64;
        Rational::new(value.into(), 1000.into())
    }

    fn unless<T: Default>(&mut self, one_in: usize, drawn: impl Fn(&mut Draw) -> T) -> T {
        match self.chance(one_in) {
            true => T::default(),
            false => drawn(self),
        }
    }

    pub fn length(&mut self) -> Rational {
        self.unless(4, |draw| draw.milli(-600, 600))
    }

    /// A right angle as often as not; else a fraction of π, or radians.
    pub fn angle(&mut self) -> Angle {
        let over = self.0.below(9) as i64 - 4;
        let turns = |under: i64| Angle::PiTimes(Rational::new(over.into(), under.into()));
        match self.0.below(8) {
            0..4 => turns(2),
            4 => turns(3),
            5 => turns(5),
            _ => Angle::Radians(self.milli(-3000, 3000)),
        }
    }

    pub fn joint(&mut self) -> Joint {
        let kinds = [JointKind::Revolute, JointKind::Prismatic];
        Joint {
            kind: kinds[usize::from(self.chance(3))],
            alpha: self.angle(),
            a: self.length(),
            d: self.length(),
            theta: self.unless(2, Draw::angle),
            mass: self.milli(500, 9000),
            com: [self.length(), self.length(), self.length()],
            // Diagonally dominant and within the triangle inequality: a body.
            inertia: Inertia {
                xx: self.milli(400, 500),
                yy: self.milli(400, 500),
                zz: self.milli(400, 500),
                xy: self.milli(-60, 60),
                yz: self.milli(-60, 60),
                xz: self.milli(-60, 60),
            },
            viscous: self.unless(2, |draw| draw.milli(0, 900)),
            armature: self.unless(2, |draw| draw.milli(0, 900)),
            ..Joint::default()
        }
    }

    pub fn robot(&mut self, n: usize) -> Robot {
        let conventions = [Convention::Modified, Convention::Standard];
        Robot {
            name: "random".to_owned(),
            convention: conventions[usize::from(self.chance(2))],
            gravity: [
                self.milli(-3000, 3000),
                self.milli(-3000, 3000),
                self.milli(-9800, -9000),
            ],
            joints: (0..n).map(|_| self.joint()).collect(),
            ..Robot::default()
        }
    }
}

pub fn robots(count: usize, seed: u64) -> impl Iterator<Item = (u64, Robot, Draw)> {
    (0..count).map(move |index| {
        let seed = seed + index as u64;
        let mut draw = Draw(Random::new(seed));
        let robot = draw.robot(1 + index % 8);
        let findings = robot.validate();
        let wrong = findings.iter().find(|f| f.is_error());
        assert!(wrong.is_none(), "seed {seed}: {wrong:?}");
        (seed, robot, draw)
    })
}
