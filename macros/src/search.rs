//! Code that is generated while compiling.

use std::path::Path;

use dalembert_codegen::{Language, RobotFile, ask};

use crate::invocation::{Errors, Invocation};

/// Returns the texts of the modules, one a scalar; none after an error. What is odd about the
/// robot is said on standard error, which cargo shows.
pub(crate) fn texts(
    invocation: &Invocation,
    robot: Option<&Path>,
    errors: &mut Errors,
) -> Vec<String> {
    let shown = invocation.shown();
    let file = match robot {
        Some(path) => RobotFile::read_as(path, &shown),
        None => RobotFile::parse(&invocation.robot.value(), &shown),
    };
    let file = match file {
        Ok(file) => file,
        Err(error) => {
            for message in error.messages() {
                errors.say(&invocation.robot, &message, "");
            }
            return Vec::new();
        }
    };
    match ask(&file, &invocation.asked, Language::Rust, &shown) {
        Ok(made) => {
            made.warnings
                .iter()
                .for_each(|said| eprintln!("warning: {said}"));
            made.generated.texts
        }
        Err(problems) => {
            for problem in problems {
                let at = match problem.option.as_str() {
                    "" => quote::ToTokens::to_token_stream(&invocation.robot),
                    option => invocation.place(option, &problem.item),
                };
                errors.say(at, &problem.message, &problem.help);
            }
            Vec::new()
        }
    }
}
