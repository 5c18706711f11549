//! The text of a plan.

use std::fmt::Write;

use super::{Edited, Plan};
use crate::program::text::write_steps;

impl Plan {
    /// Returns the text; [`Plan::parse`] reads it back.
    pub fn write(&self) -> String {
        let mut text = String::from(
            "# Programs kept by `dalembert generate --save-plan`, so that nobody searches again.\n\
             # They are proved again whenever they are used.\n",
        );
        // Writing to a string cannot fail.
        let _ = writeln!(text, "plan 1\nrobot {}\ninput {}", self.robot, self.input);
        for entry in &self.entries {
            let program = &entry.program;
            let _ = writeln!(
                text,
                "\nprogram {} {} {} {} {}",
                program.function.text(),
                entry.start.name(),
                entry.scalar,
                entry.source.name(),
                program.joints
            );
            if let Some(scene) = &entry.scene {
                let rows: Vec<String> = program.rows.iter().map(|r| (r + 1).to_string()).collect();
                let arguments: Vec<&str> = program.arguments.iter().map(|a| a.name()).collect();
                let _ = writeln!(
                    text,
                    "scene {} {} {} {}",
                    scene.name,
                    scene.hash,
                    rows.join(","),
                    arguments.join(",")
                );
            }
            if let Some(parameters) = &entry.parameters {
                let taken: Vec<&str> = parameters.taken.iter().map(|p| p.name()).collect();
                let (load, hash) = (parameters.load, &parameters.hash);
                let _ = writeln!(text, "parameters {} {load} {hash}", taken.join(","));
            }
            for stage in &entry.passes {
                let c = stage.counts;
                let name = stage.name;
                let _ = writeln!(
                    text,
                    "stage {name} {} {} {} {}",
                    c.mul, c.add, c.div, c.sincos
                );
            }
            write_steps(&mut text, program);
            if let Some(edited) = &entry.edited {
                variant(&mut text, edited);
            }
        }
        text
    }
}

/// Writes what a tolerance left of the program above: what was left out, and the program.
fn variant(text: &mut String, edited: &Edited) {
    text.push_str("edited\n");
    for own in &edited.left_out {
        let _ = writeln!(text, "left {} {} {}", own.operations, own.sincos, own.words);
    }
    write_steps(text, &edited.program);
}
