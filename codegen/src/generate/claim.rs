//! The document about generated functions, with which the checker compares their text.

use dalembert_checker::claim::{Claim, Claimed};
use dalembert_model::robot::Robot;

use super::{Generated, language};
use crate::claim::{Written, of_setup};
use crate::language::Language;
use crate::language::names::Names;
use crate::program::ScalarType;
use crate::task::Request;
use crate::tolerance::claim::{document, tolerated};
use crate::words::Complaint;

/// Returns the claim about the functions that were generated for the robot of a file.
///
/// # Errors
/// As of [`Request::setup`].
pub fn claim(
    robot: &Robot,
    source: &str,
    request: &Request,
    generated: &Generated,
) -> Result<Claim, Complaint> {
    let request = &*language::with_short_name(robot, request);
    let setup = &request.setup(robot)?;
    let name = request.module_name(robot);
    let mut constants = Written::default();
    let functions = generated.functions.iter().map(|own| {
        // A header of the same functions has the same claim.
        let symbol = |&scalar| Names::new(&name, Language::C, scalar).of(own.function.name());
        Claimed {
            symbols: ScalarType::ALL.iter().map(symbol).collect(),
            tolerated: (own.admitted.as_ref())
                .and_then(|own| tolerated(own.variants.first()?, &mut constants)),
            ..of_setup(&own.program, setup, &mut constants)
        }
    });
    let functions = functions.collect();
    Ok(document(robot, source, setup, functions, constants))
}
