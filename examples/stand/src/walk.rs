//! Standing, then two steps: the base leans over three feet, the fourth is put forward.

use dalembert_pose::Pose;

use crate::balance::command;
use crate::ground::{accelerations, step, touch_down};
use crate::{BENT, LEGS, Rates, Stance, State};

/// The period of the controller, s.
pub const PERIOD: f64 = 1e-3;
/// Steps of the simulation a period.
const STEPS: u32 = 4;
/// Times of a step: until the base has leant, until the foot is up, until it is forward, s.
const TIMES: [f64; 3] = [0.5, 0.7, 0.9];
/// The joints of a leg that is up, and of one that reaches for the ground in front of it, rad.
const UP: [f64; 3] = [0.0, 1.0, -1.9];
const FORWARD: [f64; 3] = [0.0, 0.47, -1.39];
/// The lean of the base backward, and away from the foot that is lifted, m.
const LEAN: [f64; 2] = [-0.05, 0.04];

/// The account of a walk.
#[derive(Clone, Debug)]
pub struct Report {
    /// The energy at the beginning, J.
    pub energy: f64,
    /// The work of the joints, J.
    pub work: f64,
    /// The energy lost at touch-downs, J.
    pub lost: f64,
    /// The largest error of the energy: what is there, less what was, work and losses, J.
    pub energy_error: f64,
    /// The greatest height of a foot, m.
    pub highest: f64,
    /// The length of the step of each front foot, m.
    pub forward: [f64; 2],
    /// The farthest that the base was from where it should be, m and rad.
    pub farthest: [f64; 2],
    /// The farthest that a standing foot was from the ground, m.
    pub slip: f64,
    /// The least vertical force on a foot that stands, N.
    pub least_force: f64,
    /// The last state.
    pub state: State,
}

/// Stands for half a second, puts the front left foot forward, then the front right one, and stands
/// for another second.
pub fn walk() -> Report {
    let start = State::at_rest();
    let home = start.pose;
    let mut report = Report {
        energy: start.energy(),
        work: 0.0,
        lost: 0.0,
        energy_error: 0.0,
        highest: 0.0,
        forward: [0.0; 2],
        farthest: [0.0; 2],
        slip: 0.0,
        least_force: f64::INFINITY,
        state: start,
    };
    let mut legs = [BENT; LEGS];
    report.stand(&home, &home, 0.5, &legs);
    let mut from = home;
    for (leg, stance) in [(0, Stance::RightThree), (1, Stance::LeftThree)] {
        let mut lean = home;
        lean.position[0] += LEAN[0];
        lean.position[1] += if leg == 0 { -LEAN[1] } else { LEAN[1] };
        report.stand(&from, &lean, TIMES[0], &legs);
        let before = report.state.foot(leg);
        let mut time = TIMES[0];
        while time < TIMES[1] || report.state.height(leg) > 0.0 {
            legs[leg] = match time < TIMES[1] {
                true => between(&BENT, &UP, (time - TIMES[0]) / (TIMES[1] - TIMES[0])),
                false => between(&UP, &FORWARD, (time - TIMES[1]) / (TIMES[2] - TIMES[1])),
            };
            report.advance(stance, &lean, &legs);
            time += PERIOD;
        }
        report.land();
        report.forward[leg] = report.state.foot(leg)[0] - before[0];
        from = lean;
    }
    report.stand(&from, &home, TIMES[0], &legs);
    report.stand(&home, &home, 1.0, &legs);
    report
}

/// From one posture to another, without a jump of the velocity at either end; beyond, the end.
fn between(from: &[f64; 3], to: &[f64; 3], part: f64) -> [f64; 3] {
    let part = part.clamp(0.0, 1.0);
    let part = part * part * (3.0 - 2.0 * part);
    [0, 1, 2].map(|i| from[i] + part * (to[i] - from[i]))
}

impl Report {
    fn stand(&mut self, from: &Pose<f64>, to: &Pose<f64>, time: f64, legs: &[[f64; 3]; LEGS]) {
        let count = (time / PERIOD).round() as u32;
        for period in 1..=count {
            let part = f64::from(period) / f64::from(count);
            let position = between(&from.position, &to.position, part);
            let target = Pose { position, ..*to };
            self.advance(Stance::Four, &target, legs);
        }
    }

    fn advance(&mut self, stance: Stance, target: &Pose<f64>, legs: &[[f64; 3]; LEGS]) {
        let command = command(&self.state, stance, target, legs);
        for _ in 0..STEPS {
            let (next, work) = step(&self.state, stance, &command.tau, PERIOD / f64::from(STEPS));
            self.state = next;
            self.work += work;
        }
        self.note(stance, target, &command.tau);
    }

    fn land(&mut self) {
        let (next, lost) = touch_down(&self.state);
        self.state = next;
        self.lost += lost;
    }

    fn note(&mut self, stance: Stance, target: &Pose<f64>, tau: &Rates) {
        let state = &self.state;
        let error = state.energy() - self.energy - self.work + self.lost;
        self.energy_error = self.energy_error.max(error.abs());
        let away = state.pose.difference(target);
        for (most, part) in self.farthest.iter_mut().zip([&away[..3], &away[3..]]) {
            let length = part.iter().map(|x| x * x).sum::<f64>().sqrt();
            *most = most.max(length);
        }
        for leg in 0..LEGS {
            let height = state.height(leg);
            match stance.has(leg) {
                true => self.slip = self.slip.max(height.abs()),
                false => self.highest = self.highest.max(height),
            }
        }
        let (_, forces) = accelerations(state, stance, tau);
        for force in forces.chunks(3) {
            let orientation = &state.pose.orientation;
            let [.., up] = orientation.rotate([force[0], force[1], force[2]]);
            self.least_force = self.least_force.min(up);
        }
    }
}
