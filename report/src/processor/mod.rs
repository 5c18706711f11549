//! What a compiler does not say of generated functions: operations, values alive at once,
//! the longest chain, calls, and where f64 is software. How many instructions and how much
//! stack they take, a compiler says: the guide's page on real time shows how to ask it.
//!
//! - this file: [`Footprint`], what there is to say of a function
//! - [`flat`]: the program as a processor meets it, value by value
//! - [`values`]: how many values are alive, what could be one operation
//! - [`mod@depth`]: the longest chain
//! - [`hot_path`]: calls, branches and f64
//! - [`target`]: the processors that are warned of

pub mod depth;
pub mod flat;
pub mod hot_path;
pub mod target;
pub mod values;

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::Generated;
use dalembert_codegen::workspace::program::{Counts, Library, Lowered, ScalarType};

use flat::Flat;
use hot_path::HotPath;
use target::Target;

/// All that is said of one function.
#[derive(Clone, Debug)]
pub struct Footprint {
    /// Which function.
    pub function: Function,
    /// The scalar.
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

/// Describes each function, in the order of the text.
pub fn footprints(generated: &Generated) -> Vec<Footprint> {
    let emitted = generated.emitted.iter();
    let footprints = emitted.map(|emitted| footprint(emitted.function, &emitted.text));
    footprints.collect()
}

/// Describes one function.
pub fn footprint(function: Function, text: &Lowered) -> Footprint {
    let flat = Flat::of(text);
    Footprint {
        function,
        scalar: text.scalar,
        counts: text.counts(),
        sines: Sines::of(text),
        alive: values::most_alive(&flat),
        depth: depth::in_operations(&flat),
        pairs: values::merged_products(&flat).iter().flatten().count(),
        path: HotPath::of(text),
    }
}

/// Returns what there is to warn of on these processors, each once.
pub fn warnings(footprints: &[Footprint], targets: &[&Target]) -> Vec<String> {
    let mut warnings = Vec::new();
    for target in targets {
        for footprint in footprints {
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
    /// Returns all operations, with those of the sines' polynomials.
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
