//! `dalembert certify`: what was generated, checked anew by `dalembert-checker`, which
//! shares no code with the generator.
//!
//! - this file: the claims of a certificate
//! - [`origin`]: the robot that a file names
//! - [`whole_file`]: every function of a generated file

mod origin;
mod whole_file;

use std::path::Path;

use dalembert_checker::file::MOST_BYTES;
use dalembert_checker::{Fault, Output, Verdict, audit, read};
use serde_json::{Value, json};

use crate::args::CertifyArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Runs the subcommand.
pub fn run(args: &CertifyArgs) -> Outcome {
    let source = text(&args.certificate)?;
    let robot = text(&args.robot)?;
    let edited = origin::check(&args.certificate, &source, &args.robot, &robot)?;
    let kind = args.certificate.extension().and_then(|kind| kind.to_str());
    let outcome = match kind {
        Some("rs" | "h" | "hpp" | "hh" | "cuh" | "cu") => whole_file::run(args, &source, &robot),
        _ => certificates(args, &source, &robot),
    };
    if let (Some(note), Err(Failure::Check(_))) = (edited, &outcome) {
        output::note(&note);
    }
    outcome
}

/// Checks the claims of a certificate and prints what was found.
fn certificates(args: &CertifyArgs, source: &str, robot: &str) -> Outcome {
    let name = args.certificate.display();
    let claims = read(source).map_err(|fault| Failure::Input(format!("error: {name}: {fault}")))?;
    let (mut verdicts, mut refused) = (Vec::new(), Vec::new());
    for mut claim in claims {
        claim.scene = args.scene.clone().or(claim.scene);
        let found = audit(&claim, robot, args.tolerance).map_err(|fault| match fault {
            Fault::Robot(..) => Failure::Input(format!("error: {fault}")),
            _ => Failure::Check(format!("error: {name}: `{}`: {fault}", claim.function)),
        })?;
        if !found.is_shown() {
            refused.push(format!("`{}` in {}", found.name, found.scalar));
        }
        verdicts.push((claim.scene, found));
    }
    if args.json {
        let each = verdicts.iter().map(|(scene, verdict)| {
            json!({
                "file": name.to_string(),
                "function": verdict.name,
                "scalar": verdict.scalar,
                "scene": scene,
                "outputs": verdict.outputs.iter().map(of_output).collect::<Vec<_>>(),
                "passed": verdict.is_shown(),
            })
        });
        output::print_json(&json!({
            "certificates": each.collect::<Vec<_>>(),
            "passed": refused.is_empty(),
        }))?;
    } else {
        let each = verdicts.iter().map(|(scene, verdict)| {
            let scene = scene.as_ref();
            let scene = scene.map_or_else(String::new, |scene| format!(" in scene {scene}"));
            let head = format!(
                "`{}` in {}{scene}, relative to T\n",
                verdict.name, verdict.scalar
            );
            head + &table(verdict)
        });
        output::print(&each.collect::<Vec<_>>().join("\n"))?;
    }
    match refused.is_empty() {
        true => Ok(()),
        false => Err(Failure::Check(format!(
            "error: {name}: not shown: {}",
            refused.join(", ")
        ))),
    }
}

/// Returns what was found of an output.
fn words(output: &Output) -> &'static str {
    match (output.holds(), output.is_shown()) {
        _ if output.found.seen.off > output.claimed => "E is refuted at a state",
        (true, true) => "E holds",
        (true, false) => "E holds, but is above the tolerance",
        (false, true) => "E not shown; within the tolerance",
        (false, false) => "not shown",
    }
}

/// Returns a number relative to T; of an output that is always zero as it is.
fn relative(x: f64, output: &Output) -> f64 {
    if output.scale == 0.0 {
        x
    } else {
        x / output.scale
    }
}

/// Returns the joints of an output, from one: of an entry of D its row and its column.
fn joints(output: &Output) -> Vec<usize> {
    output.joints.iter().map(|joint| joint + 1).collect()
}

fn of_output(output: &Output) -> Value {
    let of = |x: f64| relative(x, output);
    json!({
        "joints": joints(output),
        "T": output.scale,
        "real": of(output.found.edits),
        "rounding": of(output.found.rounding),
        "bound": of(output.found.bound()),
        "E": of(output.claimed),
        "tolerance": output.tolerated.map(of),
        "seen": of(output.found.seen.off),
        "finding": words(output),
        "passed": output.is_shown(),
    })
}

/// Returns what was found, a row an output.
fn table(verdict: &Verdict) -> String {
    let head = ["joint", "T", "real", "rounding", "bound", "E", "seen", ""];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for output in &verdict.outputs {
        let label: Vec<String> = joints(output).iter().map(usize::to_string).collect();
        let of = |x: f64| format!("{:.3e}", relative(x, output));
        rows.push(vec![
            label.join(", "),
            format!("{:.4e}", output.scale),
            of(output.found.edits),
            of(output.found.rounding),
            of(output.found.bound()),
            of(output.claimed),
            of(output.found.seen.off),
            words(output).to_owned(),
        ]);
    }
    output::table(&rows, 1)
}

/// Returns the text of a file.
fn text(path: &Path) -> Result<String, Failure> {
    let bytes = input::bytes(path, MOST_BYTES as u64)?;
    let expected = |_| Failure::Input(format!("error: {}: expected UTF-8 text", path.display()));
    String::from_utf8(bytes).map_err(expected)
}
