//! `dalembert certify`: a certificate checked again, part by part.

use dalembert_codegen::bound::input_box::InputBox;
use dalembert_codegen::certificate::Certificate;
use dalembert_codegen::certificate::format::{self, MAX_BYTES};
use dalembert_codegen::certificate::gappa;
use dalembert_codegen::emit::figures::inside;
use dalembert_codegen::falsify::falsify;
use dalembert_codegen::generate::GenerateError;
use dalembert_codegen::interval::Interval;
use dalembert_codegen::scene::Setting;
use dalembert_model::read::Reading;
use dalembert_model::robot::Robot;
use dalembert_model::scene::{Scene, Tolerance};
use std::path::Path;

use crate::args::CertifyArgs;
use crate::files::folder::Folder;
use crate::generate::report;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Runs the subcommand.
pub fn run(args: &CertifyArgs) -> Outcome {
    let reading = input::reading(&args.robot)?;
    let certificates = read(&args.certificate)?;
    let folder = args
        .gappa
        .as_ref()
        .map(|folder| Folder::at(folder, &[], None));
    let folder = folder.transpose()?;
    for certificate in &certificates {
        one(args, &reading, certificate)?;
    }
    if let Some(folder) = folder {
        folder.write(&scripts(&certificates))?;
        output::note(&format!(
            "wrote {}: run `gappa FILE` on each",
            folder.path().display()
        ));
    }
    Ok(())
}

/// The certificates of a file.
fn read(path: &Path) -> Result<Vec<Certificate>, Failure> {
    let name = path.display();
    let bytes = input::bytes(path, MAX_BYTES as u64)?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Failure::Input(format!("error: {name}: the file is no UTF-8 text")))?;
    format::read(&text).map_err(|error| match error.at {
        Some((line, column)) => {
            Failure::Input(format!("error: {error}\n --> {name}:{line}:{column}"))
        }
        None => Failure::Input(format!("error: {name}: {error}")),
    })
}

fn one(args: &CertifyArgs, reading: &Reading, certificate: &Certificate) -> Outcome {
    let name = args.certificate.display();
    let own = certificate.scene.as_ref().map(|scene| &scene.name);
    let scene = args.scene.as_ref().or(own);
    let scene = scene.map(|scene| input::scene(&args.robot, reading, scene));
    let scene = scene.transpose()?;
    let setting = Setting::of(&reading.robot, scene).map_err(GenerateError::Scene)?;
    let own = scene.and_then(|scene| scene.tolerance.clone());
    let tolerance = match &args.tolerance {
        Some(value) => Some(Tolerance {
            value: vec![value.clone()],
            relative_to: certificate.relative_to.ok_or_else(|| {
                let why = "its errors are relative to scales of its own: no tolerance fits them";
                Failure::Input(format!("error: {name}: {why}"))
            })?,
        }),
        None => own,
    };
    let checked = certificate
        .check_within(&setting, tolerance.as_ref())
        .map_err(|why| Failure::Check(format!("error: {name}: {why}")))?;
    let of = scene.map_or_else(String::new, |scene| format!(" in scene {}", scene.name));
    let mut text = format!(
        "{name} holds for `{}` in {} of {}{of}\n  {}\n",
        certificate.emitted.function, certificate.scalar, reading.robot.name, checked.proof
    );
    text += &over(certificate, scene, &reading.robot);
    for finding in &checked.findings {
        text += &format!("warning: {finding}\n");
    }
    let mut rows = report::bounds(certificate);
    rows[0].push("seen".into());
    for (row, seen) in rows[1..].iter_mut().zip(&checked.ran.observed) {
        row.push(format!("{seen:.3e}"));
    }
    let mut seen = None;
    if args.samples > 0 {
        let falsification = falsify(certificate, args.samples, args.climbs, 1)
            .map_err(|error| Failure::Check(format!("error: {name}: {error}")))?;
        rows[0].push("observed".into());
        for (row, observed) in rows[1..].iter_mut().zip(&falsification.observed) {
            row.push(format!("{observed:.3e}"));
        }
        seen = Some(falsification);
    }
    text += &output::table(&rows, 0);
    output::print(&text)?;
    if let Some(falsification) = seen {
        output::note(&format!("run at {} states", falsification.states));
        if let Some((index, state)) = falsification.violation {
            return Err(Failure::Check(format!(
                "error: {name}: {} errs more than E at q = {:?}, qd = {:?}, qdd = {:?}",
                certificate.emitted.entry(index),
                state.q,
                state.qd,
                state.qdd
            )));
        }
    }
    Ok(())
}

/// Scripts for Gappa, one an output that takes an operation.
fn scripts(certificates: &[Certificate]) -> Vec<(String, String)> {
    let mut files = Vec::new();
    for certificate in certificates {
        let (function, scalar) = (certificate.emitted.function, certificate.scalar);
        for output in 0..certificate.emitted.outputs.len() {
            if let Some(script) = gappa::script(certificate, output) {
                files.push((format!("{function}_{scalar}_{}.g", output + 1), script));
            }
        }
    }
    files
}

/// The box, inside which everything holds.
fn over(certificate: &Certificate, scene: Option<&Scene>, robot: &Robot) -> String {
    let InputBox {
        position,
        velocity,
        acceleration,
    } = &certificate.limits;
    let mut rows = vec![["over", "q", "qd", "qdd"].map(str::to_owned).to_vec()];
    let range = |x: &Interval| inside(x.low(), x.high());
    let joints = position.iter().zip(velocity).zip(acceleration);
    for (joint, ((q, qd), qdd)) in joints.enumerate() {
        let name = robot.joint_label(joint);
        rows.push(match scene.and_then(|scene| scene.locked(joint)) {
            Some(_) => vec![name, "locked".into()],
            None => vec![name, range(q), range(qd), range(qdd)],
        });
    }
    output::table(&rows, 0)
}
