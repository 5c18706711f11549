//! The processors that are known: a row of data each, with its sources. To add
//! one, write its row.

use super::target::{Cycles, Fused, Target, Unit};

/// All of them, microcontrollers first.
pub const TARGETS: [Target; 4] = [CORTEX_M4F, CORTEX_M7, AARCH64, X86_64];

/// Registers and what calls keep: Procedure Call Standard for the Arm
/// Architecture, VFP variant (s16–s31 are the callee's to keep).
///
/// Cycles: LLVM's scheduling model, `ARMScheduleM4.td`: VADD, VSUB and VMUL 1, VDIV
/// 14. One more by the Cortex-M4 Technical Reference Manual (DDI 0439, FPU
/// instruction set) where the next instruction reads the result, which a chain
/// does, so that VFMA takes 4. VMLA takes as long, and rustc does not write it.
const CORTEX_M4F: Target = Target {
    name: "cortex-m4f",
    about: "thumbv7em-none-eabihf, single precision",
    f32: Some(Unit {
        registers: 32,
        kept: 16,
        constant: 1,
        constants_in_table: true,
        accumulates: false,
        cycles: Cycles {
            add: 2,
            mul: 2,
            div: 15,
            fma: Some(Fused {
                factor: 4,
                addend: 4,
            }),
        },
    }),
    f64: None,
    ..ARM_V7E
};

/// Cycles: LLVM's scheduling model, `ARMScheduleM7.td`. VMLA counts as a product and
/// then a sum, which is what that has from the factors on, 6 and 11. VFMA takes as
/// long, and reads what it adds to 3 cycles later.
const CORTEX_M7: Target = Target {
    name: "cortex-m7",
    about: "thumbv7em-none-eabihf, double precision",
    f32: Some(Unit {
        registers: 32,
        kept: 16,
        constant: 1,
        constants_in_table: true,
        accumulates: true,
        cycles: Cycles {
            add: 3,
            mul: 3,
            div: 16,
            fma: Some(Fused {
                factor: 6,
                addend: 3,
            }),
        },
    }),
    f64: Some(Unit {
        registers: 16,
        kept: 8,
        constant: 1,
        constants_in_table: true,
        accumulates: true,
        cycles: Cycles {
            add: 4,
            mul: 7,
            div: 30,
            fma: Some(Fused {
                factor: 11,
                addend: 8,
            }),
        },
    }),
    ..ARM_V7E
};

/// What both have in common. VFP instructions are 4 bytes; one saves all
/// registers of a kind.
const ARM_V7E: Target = Target {
    name: "",
    about: "",
    f32: None,
    f64: None,
    word: 4,
    returns: 0,
    frame: 2,
    alignment: 8,
    restored: 8,
    saves: 16,
    bytes: 4.0,
    overwrites: false,
    reads_memory: false,
    short_constants: true,
    vectors: false,
};

/// Registers and what calls keep: Procedure Call Standard for the Arm 64-bit
/// Architecture (the lower halves of v8–v15 are the callee's to keep).
///
/// Constants: f32 by MOV, MOVK and FMOV, f64 by ADRP and LDR, as rustc does.
///
/// Cycles: LLVM's scheduling model of Neoverse N1, `AArch64SchedNeoverseN1.td`,
/// after Arm's Software Optimization Guide.
const AARCH64: Target = Target {
    name: "aarch64",
    about: "cycles of a Neoverse N1",
    f32: Some(Unit {
        registers: 32,
        kept: 8,
        constant: 3,
        constants_in_table: false,
        accumulates: false,
        cycles: Cycles {
            add: 2,
            mul: 3,
            div: 10,
            fma: Some(Fused {
                factor: 4,
                addend: 4,
            }),
        },
    }),
    f64: Some(Unit {
        registers: 32,
        kept: 8,
        constant: 2,
        constants_in_table: true,
        accumulates: false,
        cycles: Cycles {
            add: 2,
            mul: 3,
            div: 15,
            fma: Some(Fused {
                factor: 4,
                addend: 4,
            }),
        },
    }),
    word: 8,
    returns: 0,
    frame: 2,
    alignment: 16,
    restored: 8,
    saves: 2,
    bytes: 4.0,
    overwrites: false,
    reads_memory: false,
    short_constants: true,
    vectors: true,
};

/// Registers and what calls keep: System V ABI for AMD64 (calls keep no vector
/// register). Operations of SSE2, which every build may use, write over their
/// left operand.
///
/// Cycles: LLVM's scheduling model of Skylake, `X86SchedSkylakeClient.td`. Bytes: the
/// average of the functions that were compiled for the table in `processor`.
const X86_64: Target = Target {
    name: "x86-64",
    about: "SSE2, cycles of a Skylake",
    f32: Some(Unit {
        registers: 16,
        kept: 0,
        constant: 1,
        constants_in_table: true,
        accumulates: false,
        cycles: Cycles {
            add: 4,
            mul: 4,
            div: 11,
            fma: None,
        },
    }),
    f64: Some(Unit {
        registers: 16,
        kept: 0,
        constant: 1,
        constants_in_table: true,
        accumulates: false,
        cycles: Cycles {
            add: 4,
            mul: 4,
            div: 14,
            fma: None,
        },
    }),
    word: 8,
    returns: 8,
    frame: 0,
    alignment: 16,
    restored: 0,
    saves: 1,
    bytes: 5.4,
    overwrites: true,
    reads_memory: true,
    short_constants: false,
    vectors: true,
};
