//! `dalembert-audit CERTIFICATE.json ROBOT.toml [--scene NAME] [--text FILE.rs]`
#![forbid(unsafe_code)]

use std::process::ExitCode;

use dalembert_audit::{audit, read};

const USAGE: &str =
    "usage: dalembert-audit CERTIFICATE.json ROBOT.toml [--scene NAME] [--text FILE.rs]

Shows that the function in a certificate is as near to the robot's dynamics as the
certificate says, by means of its own. The scene is the certificate's unless it is named.
FILE.rs must have the function as it stands in the certificate. Exit codes: 0 every output
is shown, 1 one is not, 2 bad input, or nothing that is audited.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut given: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut option = |name: &str| {
        let at = given.iter().position(|word| *word == name)?;
        given.remove(at);
        (at < given.len()).then(|| given.remove(at))
    };
    let (scene, text) = (option("--scene"), option("--text"));
    let &[certificate, robot] = given.as_slice() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    match run(certificate, robot, scene, text) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(why) => {
            eprintln!("{why}");
            ExitCode::from(2)
        }
    }
}

/// Audits every claim of a file; whether all are shown.
fn run(
    certificate: &str,
    robot: &str,
    scene: Option<&str>,
    text: Option<&str>,
) -> Result<bool, String> {
    let file = |path: &str| std::fs::read_to_string(path).map_err(|e| format!("{path}: {e}"));
    let (document, robot) = (file(certificate)?, file(robot)?);
    let text = text.map(file).transpose()?;
    let claims = read(&document).map_err(|fault| fault.to_string())?;
    let mut all = true;
    for mut claim in claims {
        if let Some(text) = &text
            && !text.contains(claim.text.trim())
        {
            let name = claim.function.name();
            return Err(format!("the text has not the certificate's `{name}`"));
        }
        claim.scene = scene.map(String::from).or(claim.scene);
        let verdict = audit(&claim, &robot).map_err(|fault| fault.to_string())?;
        print!("{verdict}");
        all &= verdict.is_shown();
    }
    println!("{}", if all { "shown" } else { "not shown" });
    Ok(all)
}
