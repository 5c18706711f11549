//! Models of robots that other programs have: a URDF, a xacro, or an MJCF with what it includes.

use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;

use dalembert_import::{MAX_BYTES, Text};

use crate::outcome::Failure;
use crate::{input, output};

/// As much of what xacro complains of is passed on.
const MAX_COMPLAINT: u64 = 1 << 16;

/// Reads a model, with what it includes; what is called a xacro is expanded with these
/// arguments.
///
/// # Errors
/// A file cannot be read, is no text, is included twice, or is a xacro that cannot be
/// expanded.
pub fn text(path: &Path, arguments: &[String]) -> Result<Text, Failure> {
    let name = path.display().to_string();
    if path
        .extension()
        .is_some_and(|extension| extension == "xacro")
    {
        let expanded = expanded(path, arguments)?;
        return Ok(Text::of(&format!("{name}, expanded"), expanded));
    }
    if !arguments.is_empty() {
        return Err(Failure::Input(format!(
            "error: `{}` is an argument for a xacro, and `{name}` is none\n  \
             = help: the name of a xacro ends in `.xacro`",
            arguments.join(" ")
        )));
    }
    let source = String::from_utf8(input::bytes(path, MAX_BYTES as u64)?)
        .map_err(|_| Failure::Input(format!("error: `{name}` is not UTF-8 text")))?;
    Text::of(&name, source)
        .with_includes(path, included)
        .map_err(Failure::Input)
}

/// Returns what the program `xacro` makes of a file; it passes on what that complains of.
fn expanded(path: &Path, arguments: &[String]) -> Result<String, Failure> {
    let name = path.display();
    // What is no file is said as of any other.
    input::bytes(path, MAX_BYTES as u64)?;
    // An option it would be if it began with a hyphen.
    let whole = std::path::absolute(path);
    let whole = whole.map_err(|error| Failure::Input(format!("error: `{name}`: {error}")))?;
    let mut command = Command::new("xacro");
    command.arg(whole).args(arguments);
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let failed = |error: &io::Error| {
        Failure::Input(match error.kind() {
            io::ErrorKind::NotFound => format!(
                "error: `{name}` is a xacro, and the program `xacro` is not on PATH\n  \
                 = help: pip install xacro, or of ROS 2: apt install ros-$ROS_DISTRO-xacro"
            ),
            _ => format!("error: `xacro` cannot be run: {error}"),
        })
    };
    let mut child = command.spawn().map_err(|error| failed(&error))?;
    // Read beside: a full pipe would stop the program.
    let complaint = child.stderr.take().map(|mut pipe| {
        thread::spawn(move || {
            let mut text = Vec::new();
            let first = pipe.by_ref().take(MAX_COMPLAINT).read_to_end(&mut text);
            let rest = first.and_then(|_| io::copy(&mut pipe, &mut io::sink()));
            // What of it could be read is passed on all the same.
            let _ = rest;
            text
        })
    });
    let mut bytes = Vec::new();
    let most = MAX_BYTES as u64;
    let read = child
        .stdout
        .take()
        .map_or(Ok(0), |pipe| pipe.take(most + 1).read_to_end(&mut bytes));
    let is_long = bytes.len() as u64 > most;
    if is_long || read.is_err() {
        // It may have ended by itself meanwhile.
        let _ = child.kill();
    }
    let status = child.wait().map_err(|error| failed(&error))?;
    let complaint = complaint
        .and_then(|reader| reader.join().ok())
        .unwrap_or_default();
    let complaint = String::from_utf8_lossy(&complaint);
    if !complaint.trim().is_empty() {
        output::note(&complaint);
    }
    if is_long {
        return Err(Failure::Input(format!(
            "error: `xacro` made more than {} MiB of `{name}`, the most that is read",
            MAX_BYTES >> 20
        )));
    }
    read.map_err(|error| failed(&error))?;
    if !status.success() {
        return Err(Failure::Input(format!(
            "error: `xacro` ended with {status} for `{name}`\n  \
             = help: its own message stands above; arguments follow `--`, as in -- name:=value"
        )));
    }
    String::from_utf8(bytes).map_err(|_| {
        Failure::Input(format!(
            "error: what `xacro` made of `{name}` is not UTF-8 text"
        ))
    })
}

/// Returns the text of a file that is included; pipes and devices have no end.
fn included(path: &Path) -> Result<String, String> {
    let found = fs::metadata(path).map_err(|error| error.to_string())?;
    if !found.is_file() {
        return Err("it is no file".to_owned());
    }
    let bytes = input::first(path, MAX_BYTES as u64 + 1).map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())
}
