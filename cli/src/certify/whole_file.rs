//! A generated file without a certificate: how far each function can be from the dynamics.

use std::path::Path;

use dalembert_checker::exact;
use dalembert_checker::file::MOST_BYTES;

use crate::args::CertifyArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Checks every function of a file and prints what was found.
pub fn run(args: &CertifyArgs) -> Outcome {
    let others = [
        ("--tolerance", args.tolerance.is_some()),
        ("--gappa", args.gappa.is_some()),
        ("--samples", args.samples > 0),
        ("--json", args.json),
    ];
    if let Some((option, _)) = others.iter().find(|(_, given)| *given) {
        return Err(Failure::Input(format!(
            "error: {option} is for a certificate, and `{}` is a generated file",
            args.certificate.display()
        )));
    }
    let source = text(&args.certificate)?;
    let robot = text(&args.robot)?;
    let report = exact::check(&source, &robot, args.scene.as_deref())
        .map_err(|fault| Failure::Input(format!("error: {fault}")))?;
    output::print(&report.to_string())?;
    match report.is_shown() {
        true => Ok(()),
        false => Err(Failure::Check(format!(
            "error: not every function of {} is shown to be the robot's",
            args.certificate.display()
        ))),
    }
}

/// The text of a file.
fn text(path: &Path) -> Result<String, Failure> {
    let bytes = input::bytes(path, MOST_BYTES as u64)?;
    let expected = |_| Failure::Input(format!("error: {}: expected UTF-8 text", path.display()));
    String::from_utf8(bytes).map_err(expected)
}
