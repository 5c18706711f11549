//! What a function meets beside its own arithmetic: calls, branches, f64.

use std::fmt;

use dalembert_codegen::workspace::language::parts::{LONG, PART};
use dalembert_codegen::workspace::program::{Library, Lowered, LoweredTrig, ScalarType};

use super::target::Target;

/// Functions of one name that are called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// Its name, as the text has it.
    pub name: String,
    /// Number of calls.
    pub times: usize,
}

/// The calls and the slow paths of a function. The text of the function itself has no
/// branch and no loop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HotPath {
    /// The scalar.
    pub scalar: ScalarType,
    /// The functions that are called.
    pub calls: Vec<Call>,
    /// Whose sines, if any are called.
    pub library: Option<Library>,
    /// True if libm's square roots are called, for Coulomb friction.
    pub roots: bool,
    /// True if products are fused with sums.
    pub fuses: bool,
}

impl HotPath {
    /// Reads the printed text.
    pub fn of(text: &Lowered) -> HotPath {
        let called: Vec<&LoweredTrig> = text.trig.iter().filter(|t| t.kernel.is_none()).collect();
        let library = (!called.is_empty()).then_some(text.library);
        let suffix = text.scalar.math_suffix();
        let mut calls = Vec::new();
        match library {
            None => {}
            Some(Library::Together) => calls.push(Call {
                name: format!("dalembert_sines::sincos{suffix}"),
                times: 1,
            }),
            Some(Library::Libm) => {
                for (name, sin, cos) in [
                    ("sincos", true, true),
                    ("sin", true, false),
                    ("cos", false, true),
                ] {
                    let same = called.iter().filter(|t| (t.sin, t.cos) == (sin, cos));
                    calls.push(Call {
                        name: format!("libm::{name}{suffix}"),
                        times: same.count(),
                    });
                }
            }
        }
        calls.push(Call {
            name: format!("libm::sqrt{suffix}"),
            times: text.speeds.len(),
        });
        if text.steps.len() > LONG {
            calls.push(Call {
                name: "part".to_owned(),
                times: text.steps.len().div_ceil(PART),
            });
        }
        calls.retain(|call| call.times > 0);
        HotPath {
            scalar: text.scalar,
            calls,
            library,
            roots: !text.speeds.is_empty(),
            fuses: text.counts().fma > 0,
        }
    }

    /// Returns where it branches.
    pub fn branches(&self) -> &'static str {
        match (self.library, self.scalar) {
            (None, _) if self.roots => "in libm, where it has no instruction for roots",
            (None, _) => "none",
            (Some(Library::Libm), _) => "in libm",
            (Some(Library::Together), ScalarType::F64) => "one: angles beyond 8192 rad",
            (Some(Library::Together), ScalarType::F32) => "one: angles beyond 100 rad",
        }
    }

    /// Returns where it computes in f64.
    pub fn f64(&self) -> &'static str {
        match (self.scalar, self.library) {
            (ScalarType::F64, _) => "all",
            (ScalarType::F32, Some(Library::Libm)) => "in libm",
            (ScalarType::F32, Some(Library::Together)) => "beyond 100 rad",
            (ScalarType::F32, None) => "none",
        }
    }

    /// Returns what is slow on a processor, and the way around.
    pub fn warnings(&self, target: &Target) -> Vec<String> {
        let all = [
            self.of_f64(target),
            self.of_sines(target),
            self.of_fused(target),
        ];
        all.into_iter().flatten().collect()
    }

    /// Returns the reason that it has no f64.
    fn of_f64(&self, target: &Target) -> Option<String> {
        (!target.has(self.scalar)).then(|| {
            format!(
                "{} has no {}: every operation calls software",
                target.name, self.scalar
            )
        })
    }

    /// Returns the reason that it has no instruction for `mul_add`.
    fn of_fused(&self, target: &Target) -> Option<String> {
        (self.fuses && !target.fma).then(|| {
            format!(
                "`mul_add` of {} calls a function on {}, slower by far than two operations: build \
                 for a processor that has it (`-C target-feature=+fma`), or leave `--fma` out",
                self.scalar, target.name
            )
        })
    }

    /// Returns the reason that it has no f64, which libm's sines compute in.
    fn of_sines(&self, target: &Target) -> Option<String> {
        let software = !target.f64 && self.library == Some(Library::Libm);
        (software && self.scalar == ScalarType::F32).then(|| {
            format!(
                "libm's f32 sines compute in f64, which is software on {}: `--sincos together` \
                 computes them in f32, `--sincos polynomial` also without a call",
                target.name
            )
        })
    }
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.times {
            1 => f.write_str(&self.name),
            times => write!(f, "{times} {}", self.name),
        }
    }
}
