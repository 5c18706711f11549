//! What generated functions take of a processor: registers, stack, instructions,
//! calls, and how much of it can happen at once. From the program, by a stated
//! model; nothing is compiled.
//!
//! - this file: [`Footprint`], what there is to say of a function
//! - [`flat`]: the program as a processor meets it, value by value
//! - [`values`]: how many values are alive, what could be one operation
//! - [`mod@depth`]: the longest chain
//! - [`target`]: what a processor has; [`targets`]: those that are known
//! - [`registers`]: what does not fit into registers
//! - [`mod@estimate`]: instructions, stack and bytes on one processor
//! - [`hot_path`]: calls, branches and f64
//!
//! # The model
//!
//! One instruction for an operation or a change of sign, for a load, a store, a
//! copy, a call; a fused multiply-add is one of them where the processor has it, and a
//! call where it has not. Registers are given out in the printed order, by Belady's rule,
//! which knows what is read last ([`registers`]). Entries of arguments are loaded
//! once, constants as often as they are needed, results are stored at the end.
//! What sines keep over a call goes into registers that calls leave as they are,
//! as long as there are any. What is called is not counted: neither its
//! instructions nor its stack.
//!
//! # How near it is
//!
//! Compiled by rustc 1.95.0 (LLVM 22.1.2) with `-O`, on 2026-11-21: of `puma560` the
//! six functions of its file with each of the three sources of sines, of `panda`
//! five with two, 28 for each processor and scalar. Compiled over estimated, least
//! and greatest, instructions of the function and bytes that its prologue takes of
//! the stack:
//!
//! | | instructions | stack | bytes of code, with constants on Arm |
//! |---|---|---|---|
//! | cortex-m4f, f32 | 0.98 to 1.08 | 0.93 to 1.46 | 0.87 to 1.09 |
//! | cortex-m7, f32 | 0.94 to 1.13 | 0.86 to 1.78 | 0.85 to 1.12 |
//! | cortex-m7, f64 | 0.94 to 1.19 | 0.89 to 1.46 | 0.86 to 1.16 |
//! | aarch64, f32 | 0.87 to 1.14 | up to 2.2 | 0.87 to 1.14 |
//! | aarch64, f64 | 0.90 to 1.17 | up to 2.5, once 48 bytes for 0 | 0.90 to 1.17 |
//! | x86-64, f32 | 0.73 to 1.07 | up to 4.3 | 0.63 to 1.10 |
//! | x86-64, f64 | 0.91 to 1.07 | up to 2.6 | 0.83 to 1.22 |
//!
//! The torques of `puma560` with libm's sines, estimated and compiled:
//!
//! | | instructions | stack |
//! |---|---|---|
//! | cortex-m4f, f32 | 386, 398 | 192, 184 |
//! | cortex-m7, f32 | 319, 311 | 192, 176 |
//! | cortex-m7, f64 | 415, 413 | 424, 416 |
//! | aarch64, f64 | 421, 422 | 320, 368 |
//! | x86-64, f32 | 539, 515 | 208, 400 |
//! | x86-64, f64 | 539, 512 | 384, 512 |
//!
//! What is not in the model: arrays of arrays of arrays are put together on the
//! stack (`dynamic_coefficients`, 1.46 on Cortex-M). aarch64 and x86-64 have vectors,
//! of which LLVM makes some and keeps them whole on the stack; without
//! (`-C no-vectorize-slp`) the PUMA's other functions with libm's sines take 1.0 to 1.5
//! times the estimate on x86-64. And there, functions without calls use 128 bytes below
//! the stack pointer, which were not counted as compiled.
//!
//! Arm's targets were not installed: all was compiled with a `core` of forty lines, of
//! operators and indices alone. On the host that gives as many instructions and as
//! much stack as std does, for torques and gravity in both scalars. The processor was
//! chosen by `target-cpu` for Cortex-M, and left alone for the others.
//!
//! # Why the search does not use it
//!
//! What searches minimise is the same on every machine and for every user of a
//! plan: `CostModel::OPERATIONS` in codegen's `simplify`, by which `generate::early`
//! compares programs too, and the weight of a sine in `approximate::prune`. Their
//! numbers are chosen for what the searches find with them, and this crate is none
//! that a macro's user compiles. The cycles here are a processor's.

pub mod depth;
pub mod estimate;
pub mod flat;
pub mod hot_path;
pub mod registers;
pub mod target;
pub mod targets;
pub mod values;

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::Generated;
use dalembert_codegen::workspace::program::{Counts, Library, Lowered, ScalarType};

use estimate::{Estimate, estimate};
use flat::Flat;
use hot_path::HotPath;
use target::Target;

/// What a function takes.
#[derive(Clone, Debug)]
pub struct Footprint {
    /// Which function.
    pub function: Function,
    /// In which scalar.
    pub scalar: ScalarType,
    /// Its operations, and those of the polynomials of its sines.
    pub counts: Counts,
    /// Angles by who computes their sines and cosines.
    pub sines: Sines,
    /// The greatest number of values alive at once.
    pub alive: usize,
    /// The longest chain of operations.
    pub depth: usize,
    /// Products that one sum alone reads: so many instructions fewer where both are
    /// contracted to one.
    pub pairs: usize,
    /// Calls, branches and f64.
    pub path: HotPath,
    /// On each processor, if that has the scalar.
    pub on: Vec<(&'static Target, Option<Estimate>)>,
}

/// Angles by who computes their sines and cosines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sines {
    /// By libm, an angle a call.
    pub libm: usize,
    /// By `dalembert-sines`, all in one call.
    pub together: usize,
    /// By polynomials within the function.
    pub polynomial: usize,
}

/// What each function takes of processors, in the order of the text.
pub fn footprints(generated: &Generated, targets: &[&'static Target]) -> Vec<Footprint> {
    let emitted = generated.emitted.iter();
    let footprints = emitted.map(|emitted| {
        let mut functions = generated.functions.iter();
        let program = functions.find(|f| f.function == emitted.function);
        let arguments = program.map_or(0, |f| f.program.arguments.len());
        footprint(emitted.function, &emitted.text, arguments, targets)
    });
    footprints.collect()
}

/// What one function of so many arguments takes.
pub fn footprint(
    function: Function,
    text: &Lowered,
    arguments: usize,
    targets: &[&'static Target],
) -> Footprint {
    let flat = Flat::of(text);
    let scalar = text.scalar;
    let on = targets.iter().map(|&target| {
        let unit = target.unit(scalar);
        let estimate = unit.map(|unit| estimate(&flat, target, unit, scalar, arguments));
        (target, estimate)
    });
    Footprint {
        function,
        scalar,
        counts: text.counts(),
        sines: Sines::of(text),
        alive: values::most_alive(&flat),
        depth: depth::in_operations(&flat),
        pairs: values::merged_products(&flat).iter().flatten().count(),
        path: HotPath::of(text),
        on: on.collect(),
    }
}

/// What there is to warn of, each once.
pub fn warnings(footprints: &[Footprint]) -> Vec<String> {
    let mut warnings = Vec::new();
    for footprint in footprints {
        for (target, _) in &footprint.on {
            for warning in footprint.path.warnings(target) {
                if !warnings.contains(&warning) {
                    warnings.push(warning);
                }
            }
        }
    }
    warnings
}

impl Footprint {
    /// All operations, with those of the sines' polynomials.
    pub fn operations(&self) -> usize {
        self.counts.operations() + self.counts.trig_mul + self.counts.trig_add
    }

    /// Operations for each of the longest chain: how many could run at once.
    pub fn parallelism(&self) -> f64 {
        self.operations() as f64 / self.depth.max(1) as f64
    }
}

impl Sines {
    fn of(text: &Lowered) -> Sines {
        let mut sines = Sines::default();
        for trig in &text.trig {
            match (&trig.kernel, text.library) {
                (Some(_), _) => sines.polynomial += 1,
                (None, Library::Libm) => sines.libm += 1,
                (None, Library::Together) => sines.together += 1,
            }
        }
        sines
    }
}
