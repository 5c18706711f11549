//! The control cycle of a microcontroller, every millisecond: ticks in, commands out.

use crate::Servo;

/// The period, s.
pub const PERIOD: f32 = 1e-3;
/// The time until full support, s: whoever holds the arm feels it grow lighter.
const RAMP: f32 = 2.0;
/// The time over which speeds are averaged, s: one tick per millisecond is 1.5 rad/s.
const MEAN: f32 = 0.02;
/// The largest speed of an arm that is led by hand, rad/s; a falling arm soon exceeds it.
const FASTEST: f32 = 2.0;
/// The damping that stops a pushed arm, N·m s/rad: without it only friction would.
const DAMPING: f32 = 0.15;
/// The share of friction that is compensated: with all of it the arm would creep.
const HELP: f32 = 0.5;
/// The speed over which the sign of friction is smoothed, rad/s.
const SMOOTH: f32 = 0.2;

/// The reason why the arm was released, with the joint, counted from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The joint moves faster than a hand moves it: a wrong sign, or a wrong zero.
    Fast(usize),
    /// The joint's angle jumped: a cable, or a servo that was reset.
    Jump(usize),
}

/// Gravity compensation of an arm.
pub struct Cycle<const N: usize> {
    servos: [Servo; N],
    gravity: fn(&[f32; N]) -> [f32; N],
    q: Option<[f32; N]>,
    qd: [f32; N],
    support: f32,
    stop: Option<Stop>,
}

impl<const N: usize> Cycle<N> {
    /// Creates a cycle, at first without support, from the arm's generated function.
    pub fn new(servos: [Servo; N], gravity: fn(&[f32; N]) -> [f32; N]) -> Self {
        Cycle {
            servos,
            gravity,
            q: None,
            qd: [0.0; N],
            support: 0.0,
            stop: None,
        }
    }

    /// Returns why the arm was released, if it was.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }

    /// Returns the commands for the servos' present ticks; call it every [`PERIOD`].
    /// After a [`Stop`] all commands are zero.
    pub fn step(&mut self, ticks: &[u16; N]) -> [i16; N] {
        let q: [f32; N] = core::array::from_fn(|i| self.servos[i].angle(ticks[i]));
        let before = self.q.replace(q).unwrap_or(q);
        for i in 0..N {
            let speed = (q[i] - before[i]) / PERIOD;
            self.qd[i] += (speed - self.qd[i]) * (PERIOD / MEAN);
            // Even at the largest speed a joint moves by far less in a period.
            let jumped = (q[i] - before[i]).abs() > 20.0 * FASTEST * PERIOD;
            if jumped {
                self.stop.get_or_insert(Stop::Jump(i));
            } else if self.qd[i].abs() > FASTEST {
                self.stop.get_or_insert(Stop::Fast(i));
            }
        }
        if self.stop.is_some() {
            return [0; N];
        }
        self.support = (self.support + PERIOD / RAMP).min(1.0);
        let load = (self.gravity)(&q);
        core::array::from_fn(|i| {
            let servo = &self.servos[i];
            let qd = self.qd[i];
            let friction = HELP * servo.friction * smooth_sign(qd) - DAMPING * qd;
            servo.command(self.support * (load[i] + friction), self.support * qd)
        })
    }
}

/// Returns x / (|x| + w): a sign without a step, and without a square root.
fn smooth_sign(speed: f32) -> f32 {
    speed / (speed.abs() + SMOOTH)
}
