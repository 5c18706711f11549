//! Open arms that float: they stay where a hand puts them.
//!
//! - [`servo`]: ticks and units of a servo as radians and N·m
//! - [`cycle`]: what a microcontroller does every millisecond
//!
//! Nothing here needs std, an allocator or f64.
// The SO-101's file has an angle of 5e-8 rad, of which the macro warns.
#![allow(deprecated)]
#![no_std]
#![forbid(unsafe_code)]

pub mod cycle;
pub mod servo;

use servo::Servo;

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
