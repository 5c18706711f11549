//! What functions take of processors, as text and for programs.

use dalembert_codegen::workspace::generate::Generated;
use dalembert_codegen::workspace::language::Entries;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::task::Request;
use dalembert_model::robot::Robot;
use dalembert_report::processor::target::{TARGETS, Target};
use dalembert_report::processor::{Footprint, Sines, footprints, warnings};
use serde_json::{Map, Value, json};

use crate::output;

/// Functions, and the processors that are warned of: those that were named, or all.
pub struct Report {
    footprints: Vec<Footprint>,
    targets: Vec<&'static Target>,
}

impl Report {
    /// Describes every function.
    pub fn of(generated: &Generated, named: &[&'static Target]) -> Report {
        Report {
            footprints: footprints(generated),
            targets: match named.is_empty() {
                true => TARGETS.iter().collect(),
                false => named.to_vec(),
            },
        }
    }
}

/// The meaning of the columns; the guide's page on real time has the rest.
const MODEL: &str = "
mul, add, div: with those of polynomials; square roots are calls
alive: the greatest number of values alive at once, of those that are computed
depth: the longest chain of operations; parallel: operations for each of it
pairs: products that one sum alone reads; so many instructions fewer where a compiler
  contracts both to one (rustc does not, unless that keeps both roundings)
";

/// Returns the tables.
pub fn text(robot: &Robot, request: &Request, generated: &Generated, report: &Report) -> String {
    let footprints = &report.footprints;
    let mut text = format!(
        "robot {}, input {}{}\n",
        robot.name,
        robot.short_hash(),
        super::report::scene(request)
    );
    for scalar in scalars(footprints) {
        let of: Vec<&Footprint> = footprints.iter().filter(|f| f.scalar == scalar).collect();
        text += &format!("\n{scalar}\n{}", programs(&of));
    }
    text += MODEL;
    if generated
        .functions
        .iter()
        .any(|f| cuts(f.program.steps.len()))
    {
        text += "part: pieces of a very long function\n";
    }
    if request.entries > Entries::Single {
        text += "of functions of one state, with their `_with_sincos` within\n";
    }
    for warning in warnings(footprints, &report.targets) {
        text += &format!("warning: {warning}\n");
    }
    text
}

fn cuts(steps: usize) -> bool {
    steps > dalembert_codegen::workspace::language::parts::LONG
}

/// Returns the scalars, in the order of the text.
fn scalars(footprints: &[Footprint]) -> Vec<ScalarType> {
    let mut scalars: Vec<ScalarType> = footprints.iter().map(|f| f.scalar).collect();
    scalars.dedup();
    scalars
}

/// Returns what does not depend on the processor.
fn programs(footprints: &[&Footprint]) -> String {
    let fuses = footprints.iter().any(|f| f.counts.fma > 0);
    let mut head = vec!["function", "mul", "add"];
    head.extend(fuses.then_some("fma"));
    head.extend([
        "div", "alive", "depth", "parallel", "pairs", "sines", "calls", "f64", "branches",
    ]);
    let mut rows = vec![head.into_iter().map(String::from).collect()];
    for footprint in footprints {
        let counts = footprint.counts;
        let mut row = vec![
            footprint.function.to_string(),
            (counts.mul + counts.trig_mul).to_string(),
            (counts.add + counts.trig_add).to_string(),
        ];
        row.extend(fuses.then(|| counts.fma.to_string()));
        row.extend([
            counts.div.to_string(),
            footprint.alive.to_string(),
            footprint.depth.to_string(),
            format!("{:.1}", footprint.parallelism()),
            footprint.pairs.to_string(),
            sines(&footprint.sines),
            calls(footprint),
            footprint.path.f64().to_owned(),
            footprint.path.branches().to_owned(),
        ]);
        rows.push(row);
    }
    output::table(&rows, 4)
}

/// Returns `4 libm`
fn sines(sines: &Sines) -> String {
    let all = [
        (sines.libm, "libm"),
        (sines.together, "together"),
        (sines.polynomial, "polynomial"),
    ];
    listed(
        all.into_iter()
            .filter(|(angles, _)| *angles > 0)
            .map(|(angles, by)| format!("{angles} {by}")),
    )
}

fn calls(footprint: &Footprint) -> String {
    listed(footprint.path.calls.iter().map(ToString::to_string))
}

fn listed(words: impl Iterator<Item = String>) -> String {
    let words: Vec<String> = words.collect();
    match words.is_empty() {
        true => "none".to_owned(),
        false => words.join(" + "),
    }
}

/// Writes it as JSON: by scalar, then by function.
pub fn json(report: &Report) -> Value {
    let footprints = &report.footprints;
    let scalars = scalars(footprints).into_iter().map(|scalar| {
        let of = footprints.iter().filter(|f| f.scalar == scalar);
        let functions: Map<String, Value> = of.map(|f| (f.function.to_string(), one(f))).collect();
        (scalar.to_string(), Value::Object(functions))
    });
    json!({
        "scalars": scalars.collect::<Map<_, _>>(),
        "warnings": warnings(footprints, &report.targets),
    })
}

fn one(footprint: &Footprint) -> Value {
    let Sines {
        libm,
        together,
        polynomial,
    } = footprint.sines;
    let calls = footprint.path.calls.iter();
    let calls: Map<String, Value> = calls.map(|c| (c.name.clone(), json!(c.times))).collect();
    json!({
        "counts": output::counts(&footprint.counts),
        "sines": { "libm": libm, "together": together, "polynomial": polynomial },
        "alive": footprint.alive,
        "depth": footprint.depth,
        "parallelism": footprint.parallelism(),
        "pairs": footprint.pairs,
        "calls": calls,
        "f64": footprint.path.f64(),
        "branches": footprint.path.branches(),
    })
}
