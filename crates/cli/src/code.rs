//! The report of generated code: operations, bounds under a tolerance, the proof, and, if
//! everything is asked for, what the search did and what rounding costs.

use dalembert_codegen::workspace::{Library, Loop, Proof, SEED, Variant, VariantSet, bound_of};
use dalembert_codegen::{Function, GeneratedCode, GeneratedFunction, Request};
use dalembert_model::robot::Robot;

use crate::measure::{Bench, Code, largest};
use crate::report::{COUNTS, Cell, Report, Table, cells, counted, counts};

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// Operations, and that they were proved.
    Counts,
    /// The bounds under a tolerance, too.
    Bounds,
    Whole,
}

pub fn report(
    robot: &Robot,
    request: &Request,
    generated: &GeneratedCode,
    detail: Detail,
) -> Report {
    let mut report = Report::of(robot, request.scene.as_ref());
    report.table("functions", "", operations(generated, detail));
    let lanes = Table::new("function|lanes|each|shared")
        .with(generated.functions.iter().filter_map(lanes_of));
    let title = "limbs as lanes of loops: operations of each lane, and those that lanes share";
    report.table("lanes", title, lanes);
    let heads = "function|scalar|trig_mul|trig_add|angles|error";
    let sines = Table::new(heads).with(generated.functions.iter().flat_map(sines));
    let title = "sines and cosines by polynomials, errors proved";
    report.table("sines", title, sines);
    if detail == Detail::Whole {
        whole(&mut report, robot, request, generated);
    }
    for function in &generated.functions {
        if let (Some(admitted), true) = (&function.admitted, detail != Detail::Counts) {
            tolerance(&mut report, function.function, admitted, generated.ended);
        }
    }
    let proved = match has_tolerance(generated) {
        true => "proved before anything was left out, and shown to stay within the tolerance",
        false => "proved equal to the equations of motion",
    };
    let read_back = match detail {
        Detail::Bounds => "; the text was read back",
        Detail::Counts | Detail::Whole => "",
    };
    report.line(format!("\n{proved}{read_back}"));
    report.value("warnings", generated.warnings.clone());
    report.value("ended_early", generated.ended);
    report
}

fn has_tolerance(generated: &GeneratedCode) -> bool {
    let mut functions = generated.functions.iter();
    functions.any(|function| function.admitted.is_some())
}

fn operations(generated: &GeneratedCode, detail: Detail) -> Table {
    let more = match detail {
        Detail::Whole => "depth|calls|from|proof",
        Detail::Counts | Detail::Bounds => ".depth|.calls|.from|.proof",
    };
    let mut table = Table::keyed(&format!("function|{COUNTS}|{more}"));
    let scalar = generated.emitted.first().map(|emitted| emitted.scalar);
    for function in &generated.functions {
        let operations = scalar.map_or(function.counts(), |scalar| function.counts_in(scalar));
        let plan = if function.planned { ", plan" } else { "" };
        let mut row = cells![function.function.to_string()];
        row.extend(counts(&operations));
        row.extend(cells![
            function.program.dag.depth(),
            calls(generated, function.function),
            format!("{}{plan}", function.source.name()),
            format!("proved, p(wrong) < 1e{}", Proof::FAILURE_EXPONENT),
        ]);
        table.row(row);
    }
    // The operations of polynomials have a table of their own.
    table.without("trig_mul|trig_add").without_zeros("fma|sqrt")
}

fn lanes_of(function: &GeneratedFunction) -> Option<Vec<Cell>> {
    let program = &function.program;
    let total = program.dag.operations().count();
    let operations = |lane_loop: &Loop| lane_loop.rows * lane_loop.lanes;
    let inside: usize = program.loops.iter().map(operations).sum();
    let joined = |number: fn(&Loop) -> usize| {
        let text = |lane_loop: &Loop| number(lane_loop).to_string();
        Vec::from_iter(program.loops.iter().map(text)).join(" + ")
    };
    (inside > 0).then(|| {
        cells![
            function.function.to_string(),
            joined(|lane_loop| lane_loop.lanes),
            joined(|lane_loop| lane_loop.rows),
            total - inside,
        ]
    })
}

fn sines(function: &GeneratedFunction) -> impl Iterator<Item = Vec<Cell>> {
    function.sines.iter().map(|(scalar, sines)| {
        let counts = function.counts_in(*scalar);
        let worst = sines.iter().map(|sine| sine.errors.worst());
        cells![
            function.function.to_string(),
            scalar.name(),
            counts.trig_mul,
            counts.trig_add,
            sines.len(),
            Cell::power(worst.fold(0.0, f64::max), 1),
        ]
    })
}

fn whole(report: &mut Report, robot: &Robot, request: &Request, generated: &GeneratedCode) {
    for refused in generated.functions.iter().filter_map(refused) {
        report.line(format!("\n{refused}"));
    }
    // A program that a tolerance admits has its bounds.
    let is_exact = !has_tolerance(generated);
    if let Some(setup) = request.prepare(robot).ok().filter(|_| is_exact) {
        let states = affordable_states(robot.joints.len());
        let drawn = setup.states(states, SEED);
        let bench = Bench::new(setup);
        let rows = generated.emitted.iter().map(|emitted| {
            let worst = bench.measure(&Code::emitted(emitted), &drawn, &drawn);
            let [vector, entry] = largest(&worst).map(Cell::units);
            let function = emitted.function.to_string();
            cells![function, emitted.scalar.name(), vector, entry]
        });
        let states = counted(states, "random state");
        let title = format!(
            "largest rounding errors at {states} inside the limits, in u (f64 2^-53, f32 2^-24)"
        );
        let table = Table::new("function|scalar|vector|entry").with(rows);
        report.table("rounding", title, table);
    }
    let mut stages = Table::new(&format!("function|stage|{COUNTS}"));
    for function in &generated.functions {
        // The program that the tolerance left is emitted.
        let has_tolerance = function.admitted.is_some();
        let last = has_tolerance.then(|| ("tolerance", function.counts()));
        let passes = function.passes.iter().map(|pass| (pass.name, pass.counts));
        for (stage, operations) in passes.chain(last) {
            let mut row = cells![function.function.to_string(), stage];
            row.extend(counts(&operations));
            stages.row(row);
        }
    }
    let stages = stages.without_zeros(COUNTS);
    report.table("stages", "operations after each stage", stages);
}

fn tolerance(report: &mut Report, function: Function, admitted: &VariantSet, ended: bool) {
    for variant in &admitted.variants {
        let scalar = variant.scalar;
        let title = format!("{function} in {scalar}, shown");
        let table = Table::new(BOUNDS).with(bounds(variant));
        report.table(&format!("shown/{function}/{scalar}"), title, table);
    }
    if !admitted.is_other() {
        let why = match ended {
            false => "no cheaper program was found",
            true => "the search was ended early, and the quick one found no cheaper program",
        };
        report.line(format!("nothing was left out: {why} within the tolerance"));
    }
}

/// The columns of [`bounds`].
pub const BOUNDS: &str = "output|T|real|rounding|E";

/// Returns the bounds of a variant, result by result, relative to T.
pub fn bounds(variant: &Variant) -> impl Iterator<Item = Vec<Cell>> {
    let pairs = variant.bounds.iter().zip(&variant.scales);
    pairs.enumerate().map(|(index, (bound, &scale))| {
        let cell = |x: f64| Cell::of(bound_of(x, 4), x);
        cells![
            variant.emitted.entry(index),
            Cell::of(bound_of(scale, 5), scale),
            cell(bound.real),
            cell(bound.rounding),
            cell(bound.total()),
        ]
    })
}

fn refused(function: &GeneratedFunction) -> Option<String> {
    let refused = function.refused.filter(|_| function.admitted.is_none())?;
    let operations = function.counts().operations();
    let fewer = operations.saturating_sub(refused.counts.operations());
    let [error, taken] = [refused.error, refused.taken].map(|u| format!("{u:.0}"));
    // The limit holds for every result; the largest error may be another's.
    let price = match error == taken {
        true => format!("one result less accurate; the worst stays at about {taken} u"),
        false => format!("a rounding error of about {error} u instead of {taken}"),
    };
    let saved = format!("save {fewer} operations, with {price}");
    let name = function.function;
    Some(format!("{name}: `--prefer operations` would {saved}"))
}

/// The reference's work grows with the cube of the number of joints where it returns D.
fn affordable_states(joints: usize) -> usize {
    const STATES: usize = 100;
    const JOINTS: usize = 10;
    match joints {
        0..=JOINTS => STATES,
        _ => (STATES * JOINTS.pow(3) / joints.pow(3)).max(1),
    }
}

/// Polynomials need no call; with `Library::Together` one call serves all angles.
fn calls(generated: &GeneratedCode, function: Function) -> usize {
    let mut emitted = generated.emitted.iter();
    let Some(emitted) = emitted.find(|emitted| emitted.function == function) else {
        return 0;
    };
    let text = &emitted.text;
    let called = text.pairs.iter().filter(|pair| pair.kernel.is_none());
    let angles = match text.library {
        Library::Libm => called.count(),
        Library::Together => called.count().min(1),
    };
    angles + text.speeds.len()
}
