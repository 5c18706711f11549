//! Writing all outputs, or none.

use std::fs::OpenOptions;
use std::io::Write;

use super::target::{Destination, Target};
use super::unfinished::Unfinished;
use super::unwritable;
use crate::outcome::Outcome;
use crate::output;

/// Writes texts to their targets: files under other names in the same folders,
/// then into pipes and devices, and when all of that went well the files get
/// their names.
///
/// # Errors
/// Something cannot be written: then no file has changed, unless the system
/// refused to rename a later one.
pub fn write(outputs: &[(&Target, &str)]) -> Outcome {
    let mut unfinished = Vec::new();
    for (target, text) in outputs {
        if let Destination::File(path) = &target.place {
            let part = Unfinished::beside(path).and_then(|mut part| {
                part.file.write_all(text.as_bytes())?;
                Ok(part)
            });
            let part = part.map_err(|error| unwritable(&target.name, error))?;
            unfinished.push((target, path, part));
        }
    }
    for (target, text) in outputs {
        match &target.place {
            Destination::Standard => output::print(text)?,
            Destination::Stream(path) => {
                // At the end: what is open may be a file with something in it.
                let opened = OpenOptions::new().append(true).open(path);
                let written = opened.and_then(|mut file| file.write_all(text.as_bytes()));
                written.map_err(|error| unwritable(&target.name, error))?;
            }
            Destination::File(_) => {}
        }
    }
    for (target, path, part) in unfinished {
        part.finish(path)
            .map_err(|error| unwritable(&target.name, error))?;
    }
    Ok(())
}
