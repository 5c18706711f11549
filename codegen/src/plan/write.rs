//! The text of a plan.

use std::fmt::Write;

use super::{Edited, Plan};
use crate::edits::text::write_edit;
use crate::program::text::write_steps;
use crate::split::ErrorByCause;

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

/// Writes the edits of the program above, then program after program; the bounds.
fn variant(text: &mut String, edited: &Edited) {
    text.push_str("edited\n");
    for (index, stage) in edited.stages.iter().enumerate() {
        for edit in &stage.edits {
            let _ = writeln!(text, "edit {}", write_edit(edit));
        }
        text.push_str("next\n");
        let next = edited.stages.get(index + 1).map(|next| &next.program);
        write_steps(text, next.unwrap_or(&edited.program));
    }
    if let Some(least) = edited.lambda_min {
        let _ = writeln!(text, "eigenvalue {least:e}");
    }
    for bound in &edited.bounds {
        let ErrorByCause {
            model,
            sincos,
            rounding,
        } = bound;
        let _ = writeln!(text, "bound {model:e} {sincos:e} {rounding:e}");
    }
}
