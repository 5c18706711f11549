//! Open arms that float: they stay where a hand puts them.
//!
//! - [`Servo`]: ticks and units of a servo as radians and N·m
//! - [`cycle`]: what a microcontroller does every millisecond
//!
//! Nothing here needs std, an allocator or f64.
// The SO-101's file has an angle of 5e-8 rad, of which the macro warns.
#![allow(deprecated)]
#![no_std]
#![forbid(unsafe_code)]

pub mod cycle;

use core::f32::consts::TAU;

dalembert::dynamics! {
    /// The SO-101 of TheRobotStudio, gripper closed.
    pub mod so101 = "../../gallery/robots/so101.toml";
    outputs: gravity;
    scalar: f32;
}

dalembert::dynamics! {
    /// The OpenMANIPULATOR-X of ROBOTIS, without its gripper.
    pub mod open_manipulator = "../../gallery/robots/open_manipulator.toml";
    outputs: gravity;
    scalar: f32;
}

/// A joint's servo. All of it but the kind of servo is measured once on the arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Ticks of a turn.
    pub ticks: f32,
    /// The tick at which the robot file's angle is zero.
    pub zero: f32,
    /// 1 where more ticks are a larger angle, −1 where they are a smaller one.
    pub sign: f32,
    /// Units of the command for 1 N·m.
    pub units_per_torque: f32,
    /// Units of the command for 1 rad/s: what the turning motor's own voltage takes of a duty;
    /// zero where the servo controls the current.
    pub units_per_speed: f32,
    /// The torque that its gears take, N·m.
    pub friction: f32,
    /// No more than this, N·m.
    pub most: f32,
}

impl Servo {
    /// Returns the angle of a tick, rad.
    pub fn angle(&self, tick: u16) -> f32 {
        self.sign * (f32::from(tick) - self.zero) * (TAU / self.ticks)
    }

    /// Returns the command for a torque at a speed, N·m and rad/s.
    pub fn command(&self, torque: f32, speed: f32) -> i16 {
        let torque = torque.clamp(-self.most, self.most);
        let units = torque * self.units_per_torque + speed * self.units_per_speed;
        // To the nearest unit; what is no number becomes zero.
        let half = if units < 0.0 { -0.5 } else { 0.5 };
        (self.sign * (units + half)) as i16
    }
}

/// Feetech STS3215 at 12 V, driven by its duty: 2.9 N·m at standstill and 4.7 rad/s without a
/// load, both at a duty of 1000.
pub const STS3215: Servo = Servo {
    ticks: 4096.0,
    zero: 2048.0,
    sign: 1.0,
    units_per_torque: 1000.0 / 2.9,
    units_per_speed: 1000.0 / 4.7,
    friction: 0.06,
    most: 1.5,
};

/// ROBOTIS XM430-W350, driven by its current: 1.78 N·m for an ampere, 2.69 mA a unit.
pub const XM430: Servo = Servo {
    ticks: 4096.0,
    zero: 2048.0,
    sign: 1.0,
    units_per_torque: 1.0 / (1.78 * 2.69e-3),
    units_per_speed: 0.0,
    friction: 0.05,
    most: 1.0,
};

/// The servos of an SO-101 as LeRobot assembles it.
pub const SO101_SERVOS: [Servo; so101::N] = [STS3215; so101::N];

/// The servos of an OpenMANIPULATOR-X.
pub const OPEN_MANIPULATOR_SERVOS: [Servo; open_manipulator::N] = [XM430; open_manipulator::N];
