//! Dynamics in f32 without std, allocator or unwinding.
//!
//! On a microcontroller the board's runtime would call `main`; here the
//! C library calls it, so that the program runs on a computer.
#![no_std]
#![no_main]

use core::ffi::{c_char, c_int};
use core::panic::PanicInfo;

dalembert::dynamics! {
    /// A pendulum on a turntable.
    mod arm = "robots/arm.toml";
    outputs: inverse_dynamics, inertia;
    scalar: f32;
}

/// Returns 0 if the torques are right.
///
/// `no_mangle` is safe here: the C library calls this symbol, and no other
/// function has this name.
#[unsafe(no_mangle)]
pub extern "C" fn main(_count: c_int, _arguments: *const *const c_char) -> c_int {
    let upright = core::f32::consts::FRAC_PI_2;
    let swinging = arm::inverse_dynamics(&[0.3, 0.0], &[0.0, 2.0], &[1.0, 3.0]);
    let inertia = arm::inertia(&[0.3, upright]);
    // The table's inertia alone, the pendulum's m g a + m a² q̈, and no coupling.
    let good = close(inertia[0][0], 0.5)
        && close(inertia[0][1], 0.0)
        && close(swinging[0], 0.5 + 0.5)
        && close(swinging[1], 9.81 + 0.5 * 3.0);
    c_int::from(!good)
}

fn close(value: f32, expected: f32) -> bool {
    let off = value - expected;
    off < 1e-5 && off > -1e-5
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}
