//! `dalembert verify`: the exact proof, then what rounding costs the emitted text, run bit for bit:
//! inside the limits, at states that another program computed, and at the extremes.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::{
    JointState, Quantity, RunnableCode, SEED, STATES, Setup, attempt, bound_of,
};
use dalembert_codegen::{Function, GenerateError, GeneratedCode, Request, ScalarType};
use serde_json::Value;

use crate::args::TaskArgs;
use crate::args::values::states_parser;
use crate::code::{BOUNDS, bounds};
use crate::extremes::{self, BoundKind, Row, Verdict};
use crate::given::{self, Comparison, GivenState};
use crate::measure::{Bench, ENTRY, VECTOR};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Report, Table, cells};
use crate::source::{Source, text};
use crate::terminal;

/// Arguments of `verify`.
#[derive(Debug, clap::Args)]
pub struct VerifyArgs {
    #[command(flatten)]
    task: TaskArgs,
    /// Compare with these states too: JSON with a list `states` of objects
    /// with q, qd, qdd and any of tau, D, h, c
    #[arg(long, value_name = "FILE.json", conflicts_with = "scene")]
    given: Option<PathBuf>,
    /// Measure `inverse_dynamics` also at extremes: huge angles and speeds, other masses and
    /// lengths; and functions that invert D where it is nearest to singular; both if they are asked for
    #[arg(long, conflicts_with = "scene")]
    extremes: bool,
    /// States of each row
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = states_parser(), default_value_t = 50)]
    states: usize,
}

const MAX_STATES_BYTES: u64 = 1 << 28;
const CLIMBS: usize = 2;

pub(crate) fn run(args: &VerifyArgs, context: &Context) -> Outcome {
    let source = Source::open(context, &args.task.robot, &args.task.chain)?;
    let robot = &source.robot;
    let mut request = source.request(&args.task.options.0, &ScalarType::ALL)?;
    let file = args.given.as_deref();
    let reading = file.map(|file| given_states(file, &source, &request));
    let file_states = reading.transpose()?;
    // A function that cannot be proved is not generated: this ends with the reason.
    let generated = source.generate(context, &mut request)?;
    let mut done = Done::from(Report::of(robot, request.scene.as_ref()));
    let mut proofs = Table::new("function=|proof=");
    for function in &generated.functions {
        let (name, proof) = (function.function.to_string(), function.proof.to_string());
        proofs.row(cells![name, proof]);
    }
    done.report.table("proofs", "", proofs);
    let setup = request.prepare(robot).map_err(GenerateError::from)?;
    let states = setup.states(args.states, SEED);
    let claimed = claims(&setup, &generated, &mut done)?;
    let bench = Bench::new(setup);
    if let Some((file, states)) = file.zip(file_states) {
        // A state rounded to f32 is another state.
        let emitted = generated.emitted.iter();
        let double = emitted.filter(|code| code.scalar == ScalarType::F64);
        let (runtime, robot) = (bench.runtime(), bench.setup().robot());
        let comparisons = double.flat_map(|code| given::compare(code, runtime, robot, &states));
        let compared: Vec<Comparison> = comparisons.collect();
        given::describe(&file.display().to_string(), &states, &compared, &mut done);
    }
    // The terms that a tolerance left out are not rounding: their bound is E.
    let is_exact = |code: &&RunnableCode| !claimed.contains(&(code.function, code.scalar));
    let exact = generated.emitted.iter().filter(is_exact);
    let mut rows = extremes::inside(&bench, exact, &states);
    let mut unmeasured = Vec::new();
    if args.extremes {
        terminal::step("the torques at the extremes");
        let torques = extremes::torques(robot, &request, args.states)?;
        terminal::step("functions that invert D, nearest to singular");
        let divided = extremes::divided(robot, &request, args.states)?;
        if torques.is_empty() {
            unmeasured
                .push("extremes: nothing is measured, since `inverse_dynamics` is not asked for");
        }
        if divided.is_empty() {
            unmeasured.push("nearest to singular: nothing is measured, since no function that inverts D is asked for");
        }
        rows.extend(torques.into_iter().chain(divided));
    }
    rounding(args.states, &rows, &mut done);
    for line in &unmeasured {
        done.report.line(line);
    }
    done.report.value("unmeasured", unmeasured);
    sines(&generated, &states, &mut done);
    done.report.value("warnings", generated.warnings.clone());
    done.report.value("passed", done.failed.is_empty());
    Ok(done)
}

/// Reads the states of a file; fails if nothing in them can be compared with what is generated.
fn given_states(
    file: &Path,
    source: &Source,
    request: &Request,
) -> Result<Vec<GivenState>, Failure> {
    let shown = file.display();
    let fail = |why: String| Failure::Input(format!("error: {shown}: {why}"));
    let robot = &source.robot;
    let setup = request.prepare(robot).map_err(GenerateError::from)?;
    let states = given::read(&text(file, MAX_STATES_BYTES)?, setup.robot()).map_err(fail)?;
    let quantities = states.iter().flat_map(|state| state.known.keys().copied());
    let known: BTreeSet<Quantity> = quantities.collect();
    let functions = request.functions.iter().copied();
    let returned: BTreeSet<Quantity> = functions.flat_map(given::quantities).collect();
    let words = known.iter().filter_map(|quantity| quantity.facts().given);
    let keys = Vec::from_iter(words).join(", ");
    let why = if keys.is_empty() {
        "no state has any of tau, D, h, c".to_owned()
    } else if known.is_disjoint(&returned) {
        format!("the states have {keys}, which no function of --outputs returns")
    } else if !request.scalars.contains(&ScalarType::F64) {
        "states are doubles, and only f32 code is generated\n  = help: --scalar f64".to_owned()
    } else {
        return Ok(states);
    };
    Err(fail(format!("nothing is compared: {why}")))
}

fn claims(
    setup: &Setup,
    generated: &GeneratedCode,
    done: &mut Done,
) -> Result<Vec<(Function, ScalarType)>, Failure> {
    let mut claimed = Vec::new();
    let functions = generated.functions.iter();
    let admitted = functions.filter_map(|function| function.admitted.as_ref());
    for variant in admitted.flat_map(|admitted| &admitted.variants) {
        let attempt = attempt(setup, variant, STATES, CLIMBS, SEED)
            .map_err(|error| Failure::Check(format!("error: {error}")))?;
        let (function, scalar) = (variant.emitted.function, variant.scalar);
        let mut table = Table::new(&format!("{BOUNDS}|observed"));
        for (mut row, observed) in bounds(variant).zip(attempt.observed.iter().flatten()) {
            row.push(Cell::power(*observed, 3));
            table.row(row);
        }
        let key = format!("shown/{function}/{scalar}");
        let title =
            format!("{function} in {scalar}, shown, and the largest errors that were found");
        done.report.table(&key, title, table);
        if attempt.violation.is_some() {
            done.failed.push(format!(
                "error: the bound of `{function}` in {scalar} is exceeded: a defect of this program"
            ));
        }
        claimed.push((function, scalar));
    }
    Ok(claimed)
}

fn rounding(states: usize, rows: &[Row], done: &mut Done) {
    let heads = "case|function|result|scalar|vector|entry|.condition|.held_to|verdict=";
    let mut table = Table::new(heads);
    for row in rows {
        // An error that a row is not held to stands in brackets.
        let cell = |error: f64, others: &[BoundKind]| match others.contains(&row.held) {
            true => Cell::of(format!("({error:.1})"), error),
            false => Cell::units(error),
        };
        let verdict = row.verdict.to_string();
        let held = Cell::json(format!("{:?}", row.held).to_lowercase());
        table.row(match &row.worst {
            Ok(worst) => cells![
                row.case,
                worst.function.to_string(),
                worst.quantity.symbol(),
                worst.scalar.name(),
                cell(worst.vector, &[BoundKind::Entries, BoundKind::Weight]),
                cell(worst.entry, &[BoundKind::Vector]),
                Cell::json(worst.condition),
                held,
                verdict,
            ],
            Err(_) => {
                let none = || Cell::json(Value::Null);
                cells![row.case, "", "", "", none(), none(), none(), held, verdict]
            }
        });
    }
    let is_one = rows.iter().all(|row| row.case == rows[0].case);
    let title = format!(
        "largest rounding errors at {states} states, against 256-bit arithmetic, in u (f64 2^-53, f32 2^-24):\n\
         of a vector up to {VECTOR} of its largest entry, of an entry up to {ENTRY} of its own largest value"
    );
    let table = match is_one {
        true => table.without("case"),
        false => table,
    };
    done.report.table("errors", title, table);
    for row in rows {
        if let Err(reason) = &row.worst {
            let (case, verdict) = (row.case, row.verdict);
            done.report.line(format!("\n{case}: {verdict}: {reason}"));
        }
        if let (Verdict::Failed, Ok(worst)) = (row.verdict, &row.worst) {
            let (state, scalar, case) = (&worst.state, worst.scalar, row.case);
            done.report.line(format!(
                "\nFAILED: {case} of {} in {scalar}, at\n  q   {:?}\n  qd  {:?}\n  qdd {:?}\n  tau {:?}",
                worst.function, state.q, state.qd, state.qdd, state.tau
            ));
        }
    }
    let is_failed = |row: &&Row| row.verdict == Verdict::Failed;
    let failed = rows.iter().filter(is_failed).count();
    if failed > 0 {
        let total = rows.len();
        done.failed.push(format!(
            "error: the rounding error exceeds the bound in {failed} of {total} rows"
        ));
    }
}

fn sines(generated: &GeneratedCode, states: &[JointState], done: &mut Done) {
    let mut table = Table::new("function|scalar|angle|seen|proved|verdict=");
    let mut failed = 0;
    for emitted in &generated.emitted {
        let mut functions = generated.functions.iter();
        let Some(function) = functions.find(|function| function.function == emitted.function)
        else {
            continue;
        };
        let proved = function.sines(emitted.scalar).iter();
        for ((joint, deviation), kernel) in emitted.sines(states).into_iter().zip(proved) {
            // The sine that it is held against has an ulp of its own.
            let proved = kernel.errors.worst() + f64::EPSILON;
            failed += usize::from(deviation > proved);
            table.row(cells![
                emitted.function.to_string(),
                emitted.scalar.name(),
                format!("q{}", joint + 1),
                Cell::power(deviation, 1),
                Cell::of(bound_of(proved, 2), proved),
                if deviation <= proved { "ok" } else { "FAILED" },
            ]);
        }
    }
    let title = "polynomials against libm's sine and cosine, absolute";
    done.report.table("sines", title, table);
    if failed > 0 {
        let why = "error: the error of a polynomial exceeds its proved bound";
        done.failed.push(why.into());
    }
}
