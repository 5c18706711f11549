//! Processors, by what makes generated code slow on them.

use dalembert_codegen::workspace::program::ScalarType;

/// A processor that a report can warn of.
#[derive(Debug, PartialEq, Eq)]
pub struct Target {
    /// Its name on the command line.
    pub name: &'static str,
    /// True if it computes in f64; without, every operation calls software.
    pub f64: bool,
    /// True if it fuses a product with a sum in one instruction; without, `mul_add` calls a
    /// function.
    pub fma: bool,
}

/// All of them, microcontrollers first. x86-64 stands for the oldest one, which a build is
/// for unless `-C target-cpu` says otherwise.
pub const TARGETS: [Target; 4] = [
    Target {
        name: "cortex-m4f",
        f64: false,
        fma: true,
    },
    Target {
        name: "cortex-m7",
        f64: true,
        fma: true,
    },
    Target {
        name: "aarch64",
        f64: true,
        fma: true,
    },
    Target {
        name: "x86-64",
        f64: true,
        fma: false,
    },
];

impl Target {
    /// Returns whether it has the scalar.
    pub fn has(&self, scalar: ScalarType) -> bool {
        self.f64 || scalar == ScalarType::F32
    }
}
