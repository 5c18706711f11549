//! `dalembert certify`: a certificate checked again, part by part.
//!
//! - this file: the check, and what a person reads of it
//! - [`json`]: the same for programs
//! - `whole_file`: a generated file without a certificate, by `dalembert-checker`

mod json;
mod whole_file;

use dalembert_codegen::workspace::bound::input_box::InputBox;
use dalembert_codegen::workspace::certificate::format::{self, MAX_BYTES};
use dalembert_codegen::workspace::certificate::gappa;
use dalembert_codegen::workspace::certificate::{Certificate, Checked};
use dalembert_codegen::workspace::emit::figures::inside;
use dalembert_codegen::workspace::falsify::{Falsification, falsify};
use dalembert_codegen::workspace::generate::GenerateError;
use dalembert_codegen::workspace::interval::Interval;
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_model::read::Reading;
use dalembert_model::robot::Robot;
use dalembert_model::scene::{Scene, Tolerance};
use serde_json::json;
use std::path::Path;

use crate::args::CertifyArgs;
use crate::files::folder::Folder;
use crate::generate::report;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Runs the subcommand.
pub fn run(args: &CertifyArgs) -> Outcome {
    if args
        .certificate
        .extension()
        .is_some_and(|kind| kind == "rs")
    {
        return whole_file::run(args);
    }
    let reading = input::reading(&args.robot)?;
    let certificates = read(&args.certificate)?;
    let folder = args
        .gappa
        .as_ref()
        .map(|folder| Folder::at(folder, &[], None));
    let folder = folder.transpose()?;
    let mut documents = Vec::new();
    let mut violations = Vec::new();
    for certificate in &certificates {
        let checked = Check::of(args, &reading, certificate)?;
        match args.json {
            true => documents.push(json::json(args, &reading.robot, &checked)),
            false => checked.print(args, &reading.robot)?,
        }
        violations.extend(checked.violation(args));
    }
    if args.json {
        output::print_json(&json!({
            "robot": reading.robot.name,
            "input": reading.robot.short_hash(),
            "certificates": documents,
            "passed": violations.is_empty(),
        }))?;
    }
    if !violations.is_empty() {
        return Err(Failure::Check(violations.join("\n")));
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

/// A certificate that holds, and what was seen when its code was run.
struct Check<'a> {
    certificate: &'a Certificate,
    scene: Option<&'a Scene>,
    checked: Checked,
    /// The run at many states, if it was asked for.
    seen: Option<Falsification>,
}

impl<'a> Check<'a> {
    fn of(
        args: &CertifyArgs,
        reading: &'a Reading,
        certificate: &'a Certificate,
    ) -> Result<Check<'a>, Failure> {
        let name = args.certificate.display();
        let own = certificate.scene.as_ref().map(|scene| &scene.name);
        let scene = args.scene.as_ref().or(own);
        let scene = scene.map(|scene| input::scene(&args.robot, reading, scene));
        let scene = scene.transpose()?;
        let scene_robot = SceneRobot::of(&reading.robot, scene).map_err(GenerateError::Scene)?;
        let own = scene.and_then(|scene| scene.tolerance.clone());
        let tolerance = match &args.tolerance {
            Some(value) => Some(Tolerance {
                value: vec![value.clone()],
                relative_to: certificate.relative_to.ok_or_else(|| {
                    let why =
                        "its errors are relative to scales of its own: no tolerance fits them";
                    Failure::Input(format!("error: {name}: {why}"))
                })?,
            }),
            None => own,
        };
        let failed = |why: String| Failure::Check(format!("error: {name}: {why}"));
        let checked = certificate
            .check_within(&scene_robot, tolerance.as_ref())
            .map_err(|why| failed(why.to_string()))?;
        let seen = (args.samples > 0)
            .then(|| falsify(certificate, args.samples, args.climbs, 1))
            .transpose()
            .map_err(|error| failed(error.to_string()))?;
        Ok(Check {
            certificate,
            scene,
            checked,
            seen,
        })
    }

    fn print(&self, args: &CertifyArgs, robot: &Robot) -> Outcome {
        let (certificate, checked) = (self.certificate, &self.checked);
        let of = self.scene;
        let of = of.map_or_else(String::new, |scene| format!(" in scene {}", scene.name));
        let mut text = format!(
            "{} holds for `{}` in {} of {}{of}\n  {}\n",
            args.certificate.display(),
            certificate.emitted.function,
            certificate.scalar,
            robot.name,
            checked.proof
        );
        text += &over(certificate, self.scene, robot);
        for finding in &checked.findings {
            text += &format!("warning: {finding}\n");
        }
        let mut rows = report::bounds(certificate);
        let mut column = |head: &str, values: &[f64]| {
            rows[0].push(head.into());
            for (row, value) in rows[1..].iter_mut().zip(values) {
                row.push(format!("{value:.3e}"));
            }
        };
        column("seen", &checked.ran.observed);
        if let Some(seen) = &self.seen {
            column("observed", &seen.observed);
        }
        text += &output::table(&rows, 0);
        output::print(&text)?;
        if let Some(seen) = &self.seen {
            output::note(&format!("run at {} states", seen.states));
        }
        Ok(())
    }

    /// Where the code errs more than it may, in words.
    fn violation(&self, args: &CertifyArgs) -> Option<String> {
        let (index, state) = self.seen.as_ref()?.violation.as_ref()?;
        Some(format!(
            "error: {}: {} errs more than E at q = {:?}, qd = {:?}, qdd = {:?}",
            args.certificate.display(),
            self.certificate.emitted.entry(*index),
            state.q,
            state.qd,
            state.qdd
        ))
    }
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
