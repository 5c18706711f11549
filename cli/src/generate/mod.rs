//! `dalembert generate`: code, written or printed.
//!
//! - this file: code and certificates
//! - [`files`]: what goes where, and what is there already
//! - [`report`]: what a person wants to know about the code
//! - [`json`]: the same for programs

mod files;
pub mod json;
pub mod report;

use std::path::Path;

use crate::explained::errors::{MAX_STATES, affordable_states};
use dalembert_codegen::workspace::{keep, write_certificates};
use dalembert_codegen::{Effort, Generated, Language};
use dalembert_stamp::relative;

use crate::args::GenerateArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress};
use files::Files;

/// Runs the subcommand.
pub fn run(args: &GenerateArgs) -> Outcome {
    let language = language(args);
    let scalars = language.as_ref().map_or(&[][..], |own| own.scalars());
    let wanted = input::wanted(&args.robot, &args.options.0, scalars)?;
    let input::Wanted {
        robot,
        source,
        mut request,
    } = wanted;
    request.language = *language.as_ref().unwrap_or(&Language::Rust);
    // Before the work: what cannot be written is no news after it.
    let files = Files::of(args, &request)?;
    language?;
    let kept = request.plan.take_if(|_| args.save_plan);
    let session = progress::watch(&mut request);
    let generated = input::generated(&args.robot, &robot, &request)?;
    let certificates = certificates(&generated);
    drop(session);
    let measured = args.verbose || args.json;
    let states = args.states.unwrap_or(match request.effort {
        // Who ended the search waits no longer for its errors.
        Effort::Thorough if !generated.ended => MAX_STATES,
        _ => affordable_states(robot.joints.len()),
    });
    if measured && states > affordable_states(robot.joints.len()) {
        output::note(&format!("measuring rounding errors at {states} states"));
    }
    if args.json {
        output::print_json(&json::json(&robot, &request, &generated, states))?;
    } else {
        output::note(&match args.verbose {
            true => report::text(&robot, &request, &generated, states),
            false => report::brief(&robot, &request, &generated),
        });
    }
    let plan = args.save_plan.then(|| {
        let kept = keep(&robot, &request, &generated, kept);
        for (function, scalar) in kept.own {
            output::note(&format!(
                "the plan's program for `{function}` in {scalar} stays: the search, ended early, found none that is cheaper"
            ));
        }
        kept.plan.write()
    });
    let place = match args.output.as_deref() {
        Some(file) if files.has_file() => relative(&args.robot, file),
        // As if it were written beside the robot file.
        _ => name(&args.robot),
    };
    let code = generated.files(&request, &place, &source);
    output::undenied()?;
    files.write(&code, certificates.as_deref(), plan.as_deref())
}

/// Returns the name of a file, without its folder.
fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// Returns the language of the code: that of the ending of `-o`, unless `--language` is given.
///
/// # Errors
/// The ending is that of another language, or of none while `--language` is not given.
fn language(args: &GenerateArgs) -> Result<Language, Failure> {
    let path = args.output.as_deref();
    let Some(path) = path.filter(|path| path.extension().is_some()) else {
        return Ok(args.language.unwrap_or_default());
    };
    match (Language::of(path), args.language) {
        (Ok(language), None) => Ok(language),
        (Ok(language), Some(asked)) if language == asked => Ok(language),
        (Err(_), Some(asked)) => Ok(asked),
        (_, asked) => {
            // What has no ending names them.
            let known = Language::of(Path::new("")).err().unwrap_or_default();
            Err(Failure::Input(format!(
                "error: `{}` does not end as a file of {} does\n  = help: the language follows from \
                 the ending: {known}",
                path.display(),
                asked.map_or("any language", Language::name),
            )))
        }
    }
}

/// Returns the certificates of a scene with a tolerance.
pub fn certificates(generated: &Generated) -> Option<String> {
    let admitted = generated
        .functions
        .iter()
        .filter_map(|f| f.admitted.as_ref());
    let certificates: Vec<_> = admitted.flat_map(|a| &a.certificates).collect();
    (!certificates.is_empty()).then(|| write_certificates(&certificates))
}
