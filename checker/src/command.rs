//! The command: files in, verdicts out.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;

use crate::certificate::{self, Claim};
use crate::fault::Fault;
use crate::{audit, exact, file};

const USAGE: &str =
    "usage: dalembert-checker CERTIFICATE.json ROBOT.toml [--scene NAME] [--text FILE.rs]
       dalembert-checker FILE.rs ROBOT.toml [--scene NAME]

Of a generated file FILE.rs it says how far each function can be from the robot's
dynamics. Of a certificate it shows that the function in it is as near to the robot's dynamics as the
certificate says, by means of its own. The scene is the certificate's unless it is named.
FILE.rs is a generated file whose function of that name must be the certificate's. Exit
codes: 0 every output is shown, 1 one is not, 2 bad input, or nothing that is checked.";

/// Runs the command with its arguments and prints what it finds; the exit code.
///
/// # Errors
/// Files that cannot be read or are no input, and an output that takes no more.
pub fn run(arguments: impl Iterator<Item = OsString>, out: &mut dyn Write) -> Result<u8, String> {
    let mut given: Vec<OsString> = arguments.collect();
    let mut option = |name: &str| {
        let at = given.iter().position(|word| word == name)?;
        given.remove(at);
        (at < given.len()).then(|| given.remove(at))
    };
    let (scene, text) = (option("--scene"), option("--text"));
    let [certificate, robot] = given.as_slice() else {
        return Err(USAGE.into());
    };
    let scene = scene.map(|name| name.into_string().map_err(|_| "--scene: expected UTF-8"));
    let scene = scene.transpose()?;
    let document = read(certificate)?;
    let robot = read(robot)?;
    if text.is_none() && Path::new(certificate).extension() == Some(OsStr::new("rs")) {
        let report = exact::check(&document, &robot, scene.as_deref());
        let report = report.map_err(|fault| fault.to_string())?;
        let code = u8::from(!report.is_shown());
        print(out, &report.to_string())?;
        print(out, if code == 0 { "shown\n" } else { "not shown\n" })?;
        return Ok(code);
    }
    let text = text.as_deref().map(read).transpose()?;
    let mut code = 0;
    for mut claim in certificate::read(&document).map_err(|fault| fault.to_string())? {
        if let Some(text) = &text {
            is_called(&claim, text).map_err(|fault| fault.to_string())?;
        }
        claim.scene = scene.clone().or(claim.scene);
        let (own, said) = match audit(&claim, &robot) {
            Ok(verdict) => (u8::from(!verdict.is_shown()), verdict.to_string()),
            Err(fault) => (2, format!("{fault}\n")),
        };
        code = code.max(own);
        print(out, &said)?;
    }
    print(out, if code == 0 { "shown\n" } else { "not shown\n" })?;
    Ok(code)
}

fn print(out: &mut dyn Write, text: &str) -> Result<(), String> {
    let printed = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    printed.map_err(|error| format!("the verdict cannot be printed: {error}"))
}

/// Reads a file that is no longer than any input.
fn read(path: &OsStr) -> Result<String, String> {
    let name = path.to_string_lossy();
    let failed = |why: &dyn std::fmt::Display| format!("{name}: {why}");
    let mut bytes = Vec::new();
    let opened = File::open(path).map_err(|error| failed(&error))?;
    let mut limited = opened.take(file::MOST_BYTES as u64 + 1);
    limited
        .read_to_end(&mut bytes)
        .map_err(|error| failed(&error))?;
    if bytes.len() > file::MOST_BYTES {
        return Err(failed(&format!("more than {} bytes", file::MOST_BYTES)));
    }
    String::from_utf8(bytes).map_err(|_| failed(&"expected UTF-8 text"))
}

/// Refuses a file in which a call of the claim's function is not a call of its text.
///
/// # Errors
/// A file that the generator would not print, or another function of the name in it.
pub fn is_called(claim: &Claim, source: &str) -> Result<(), Fault> {
    let name = claim.function.as_str();
    let own = claim.text.trim_end_matches('\n');
    let own = own.strip_prefix("#[must_use]\n").unwrap_or(own);
    let head = format!("pub fn {name}(");
    let mut is_there = false;
    for found in file::functions(source)? {
        let of_scalar = found.text.lines().next().is_some_and(|line| {
            line.starts_with(&head) && line.contains(&format!("[{}; ", claim.scalar))
        });
        if found.name != name || !of_scalar {
            continue;
        }
        if found.text.trim_end_matches('\n') != own {
            let why = format!("`{name}` is not the certificate's");
            return Err(Fault::Text(found.line, why));
        }
        is_there = true;
    }
    match is_there {
        true => Ok(()),
        false => Err(Fault::certificate(format!(
            "the text has no `{name}` in {}",
            claim.scalar
        ))),
    }
}
