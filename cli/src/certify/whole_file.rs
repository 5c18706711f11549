//! A generated file without a certificate: how far each function can be from the dynamics.

use dalembert_checker::Fault;
use dalembert_checker::exact::{self, Distance, Line, RATE, Report};
use serde_json::{Value, json};

use crate::args::CertifyArgs;
use crate::outcome::{Failure, Outcome};
use crate::output;

/// Checks every function of a file and prints what was found.
pub fn run(args: &CertifyArgs, source: &str, robot: &str) -> Outcome {
    let name = args.certificate.display();
    if args.tolerance.is_some() {
        return Err(Failure::Input(format!(
            "error: --tolerance is for a certificate, and `{name}` is a generated file"
        )));
    }
    let failed = |fault: Fault| Failure::Input(format!("error: {fault}"));
    let report = exact::check(source, robot, args.scene.as_deref()).map_err(failed)?;
    match args.json {
        true => output::print_json(&json!({
            "file": name.to_string(),
            "functions": report.lines.iter().map(of_line).collect::<Vec<_>>(),
            "passed": report.is_shown(),
        }))?,
        false => output::print(&words(&report))?,
    }
    match report.is_shown() {
        true => Ok(()),
        false => Err(Failure::Check(format!(
            "error: not every function of {name} is shown to be the robot's"
        ))),
    }
}

fn of_line(line: &Line) -> Value {
    let found = line.result.as_ref().ok();
    let is_tried = found.is_some_and(|found| found.tried > 0);
    let number = |of: fn(&Distance) -> f64| found.map(of);
    json!({
        "module": line.module,
        "function": line.name,
        "real": number(|found| found.edits).filter(|_| !is_tried),
        "rounding": number(|found| found.rounding).filter(|_| !is_tried),
        "units": number(Distance::units),
        "tried": found.map_or(0, |found| found.tried),
        "seen_units": number(|found| found.seen / found.unit),
        "why": line.result.as_ref().err().map(ToString::to_string),
        "passed": found.is_some_and(Distance::is_shown),
    })
}

fn words(report: &Report) -> String {
    let mut text =
        "How far each function can be from the dynamics over the box of the robot file,\n\
         each entry relative to its own largest value, of a matrix to its row's or its column's;\n\
         u is half an ulp of that.\n"
            .to_owned();
    if report.is_unlimited {
        text += &format!("Where the file has no limit, rates go up to {RATE} in SI units.\n");
    }
    let mut module = "";
    for line in &report.lines {
        if line.module != module {
            module = &line.module;
            text += &format!("{module}\n");
        }
        let name = &line.name;
        text += &match &line.result {
            Ok(found) if found.tried > 0 => format!(
                "  {name:<22} no bound: of the equation that it solves {:.1} u of the terms are left at {} states  {}\n",
                found.units(),
                found.tried,
                if found.is_shown() { "tried" } else { "wrong" },
            ),
            Ok(found) => format!(
                "  {name:<22} in real numbers {:>9.2e}  rounding {:>9.2e}  both {:>7.0} u  seen {:>7.1} u  {}\n",
                found.edits,
                found.rounding,
                found.units(),
                found.seen / found.unit,
                match (found.is_shown(), found.has_polynomials) {
                    (true, _) => "shown",
                    (false, false) => "not shown",
                    (false, true) =>
                        "not shown: sines by polynomials err by more than rounding, which takes a scene with a tolerance",
                },
            ),
            Err(fault) => format!("  {name:<22} not shown: {fault}\n"),
        };
    }
    text
}
