//! What functions take of processors, as text and for programs.

use dalembert_codegen::workspace::generate::{Generated, Request};
use dalembert_codegen::workspace::language::Entries;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_model::robot::Robot;
use dalembert_report::processor::estimate::Estimate;
use dalembert_report::processor::target::Target;
use dalembert_report::processor::targets::TARGETS;
use dalembert_report::processor::{Footprint, Sines, footprints, warnings};
use serde_json::{Map, Value, json};

use super::report;
use crate::output;

/// What every function takes of the processors that were named, or of all.
pub fn of(generated: &Generated, named: &[&'static Target]) -> Vec<Footprint> {
    let targets = match named.is_empty() {
        true => TARGETS.iter().collect(),
        false => named.to_vec(),
    };
    footprints(generated, &targets)
}

/// The model in a few lines; the guide's page on real time has the rest.
const MODEL: &str = "
mul, add, div: with those of polynomials; square roots are calls
alive: the greatest number of values alive at once, of those that are computed
depth: the longest chain of operations; parallel: operations for each of it
pairs: products that one sum alone reads; so many instructions fewer where a compiler
  contracts both to one (rustc does not, unless that keeps both roundings)
estimates, from the program as printed: registers given out in its order, arguments loaded
  once, results stored; without the instructions and the stack of functions that are called;
  stack, code and constants are bytes; chain: cycles of the longest chain, behind the calls
";

/// The tables.
pub fn text(
    robot: &Robot,
    request: &Request,
    generated: &Generated,
    footprints: &[Footprint],
) -> String {
    let mut text = format!(
        "robot {}, input {}{}\n",
        robot.name,
        robot.short_hash(),
        report::scene(request)
    );
    for scalar in scalars(footprints) {
        let of: Vec<&Footprint> = footprints.iter().filter(|f| f.scalar == scalar).collect();
        text += &format!("\n{scalar}\n{}", programs(&of));
        let targets = of.first().map_or(0, |first| first.on.len());
        for target in 0..targets {
            text += &estimates(&of, target);
        }
    }
    text += MODEL;
    let mut targets = footprints.iter().flat_map(|f| &f.on);
    if targets.any(|(target, estimate)| target.vectors && estimate.is_some()) {
        text += "  on aarch64 and x86-64 compilers also make vectors, which take more stack\n";
    }
    if generated
        .functions
        .iter()
        .any(|f| cuts(f.program.steps.len()))
    {
        text += "part: pieces of a very long function, whose calls the estimates leave out\n";
    }
    if request.entries > Entries::Single {
        text += "of functions of one state, with their `_with_sincos` within\n";
    }
    for warning in warnings(footprints) {
        text += &format!("warning: {warning}\n");
    }
    text
}

fn cuts(steps: usize) -> bool {
    steps > dalembert_codegen::workspace::language::parts::LONG
}

/// The scalars, in the order of the text.
fn scalars(footprints: &[Footprint]) -> Vec<ScalarType> {
    let mut scalars: Vec<ScalarType> = footprints.iter().map(|f| f.scalar).collect();
    scalars.dedup();
    scalars
}

/// What does not depend on the processor.
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

/// `4 libm`
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

/// What is estimated of a processor.
fn estimates(footprints: &[&Footprint], target: usize) -> String {
    let on = footprints.iter().filter_map(|footprint| {
        let (target, estimate) = footprint.on.get(target)?;
        Some((*footprint, *target, *estimate))
    });
    let on: Vec<_> = on.collect();
    let Some(&(first, target, _)) = on.first() else {
        return String::new();
    };
    let scalar = first.scalar;
    let Some(unit) = target.unit(scalar) else {
        return format!(
            "\n{scalar} on {}: it has no {scalar}, every operation calls software\n",
            target.name
        );
    };
    let head = [
        "function",
        "instructions",
        "spills",
        "stack",
        "code",
        "constants",
        "chain",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
    for (footprint, _, estimate) in on {
        let Some(estimate) = estimate else {
            continue;
        };
        let mut row = vec![footprint.function.to_string()];
        let Estimate {
            traffic,
            instructions,
            stack,
            code,
            constants,
            cycles,
        } = estimate;
        let numbers = [instructions, traffic.spills, stack, code, constants, cycles];
        row.extend(numbers.map(|number| number.to_string()));
        rows.push(row);
    }
    format!(
        "\n{scalar} on {} ({}): {} registers, {} kept over calls\n{}",
        target.name,
        target.about,
        unit.registers,
        unit.kept,
        output::table(&rows, 0)
    )
}

/// The same for programs: by scalar, then by function.
pub fn json(footprints: &[Footprint]) -> Value {
    let scalars = scalars(footprints).into_iter().map(|scalar| {
        let of = footprints.iter().filter(|f| f.scalar == scalar);
        let functions: Map<String, Value> = of.map(|f| (f.function.to_string(), one(f))).collect();
        (scalar.to_string(), Value::Object(functions))
    });
    json!({
        "scalars": scalars.collect::<Map<_, _>>(),
        "warnings": warnings(footprints),
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
    let on = footprint.on.iter().map(|(target, estimate)| {
        let estimate = estimate.map(|estimate| {
            json!({
                "instructions": estimate.instructions,
                "loads": estimate.traffic.loads,
                "spills": estimate.traffic.spills,
                "copies": estimate.traffic.copies,
                "slots": estimate.traffic.slots,
                "registers": estimate.traffic.registers,
                "stack_bytes": estimate.stack,
                "code_bytes": estimate.code,
                "constant_bytes": estimate.constants,
                "chain_cycles": estimate.cycles,
            })
        });
        (target.name.to_owned(), json!(estimate))
    });
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
        "on": on.collect::<Map<_, _>>(),
    })
}
