//! No output is an input, or another output.

use std::path::Path;

use super::target::Target;
use crate::outcome::{Failure, Outcome};

/// Refuses outputs that would be written over an input or over each other;
/// each comes with what it is, for the message.
///
/// # Errors
/// Two of them are the same file, through links or not.
pub fn distinct(inputs: &[(&str, &Path)], outputs: &[(&str, &Target)]) -> Outcome {
    for (index, (what, target)) in outputs.iter().enumerate() {
        let Some(file) = target.file() else {
            continue;
        };
        let name = target.name.display();
        for (input, path) in inputs {
            // What cannot be read cannot be lost.
            let input_file = Target::at(path).ok();
            if input_file.is_some_and(|input| input.file() == Some(file)) {
                return Err(Failure::Input(format!(
                    "error: {what} would be written over {input}, `{name}`\n  \
                     = help: give it another name"
                )));
            }
        }
        let mut others = outputs[..index].iter();
        if let Some((other, _)) = others.find(|(_, other)| other.file() == Some(file)) {
            return Err(Failure::Input(format!(
                "error: {other} and {what} would be the same file, `{name}`\n  \
                 = help: give one of them another name"
            )));
        }
    }
    Ok(())
}
