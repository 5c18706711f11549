//! Open-source arms that float: they stay where a hand puts them.
//!
//! - [`Servo`]: converts ticks and command units to radians and N·m
//! - [`cycle`]: the control cycle of a microcontroller, every millisecond
//!
//! Nothing here needs std, an allocator or f64.
// The macro warns of an angle of 5e-8 rad in the SO-101's file.
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

/// A joint's servo. All values but those of the servo's type are measured once on the arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// Ticks per turn.
    pub ticks: f32,
    /// The tick at which the robot file's angle is zero.
    pub zero: f32,
    /// 1 if the angle grows with the ticks, −1 if it falls.
    pub sign: f32,
    /// Command units per N·m.
    pub units_per_torque: f32,
    /// Command units per rad/s: the part of the duty that the motor's back-EMF takes; zero if the
    /// servo controls the current.
    pub units_per_speed: f32,
    /// The friction torque of the gears, N·m.
    pub friction: f32,
    /// The largest torque, N·m.
    pub most: f32,
}

impl Servo {
    /// Returns the angle at a tick, rad.
    pub fn angle(&self, tick: u16) -> f32 {
        self.sign * (f32::from(tick) - self.zero) * (TAU / self.ticks)
    }

    /// Returns the command for a torque at a speed, N·m and rad/s.
    pub fn command(&self, torque: f32, speed: f32) -> i16 {
        let torque = torque.clamp(-self.most, self.most);
        let units = torque * self.units_per_torque + speed * self.units_per_speed;
        // Rounds to the nearest unit; NaN becomes zero.
        let half = if units < 0.0 { -0.5 } else { 0.5 };
        (self.sign * (units + half)) as i16
    }
}

/// Feetech STS3215 at 12 V, controlled by its duty: 2.9 N·m at standstill and 4.7 rad/s without a
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

/// ROBOTIS XM430-W350, controlled by its current: 1.78 N·m per ampere, 2.69 mA per unit.
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
