//! `dalembert generate`: Rust source, written, printed or compared.
//!
//! - this file: code and certificates
//! - [`files`]: what goes where, and what is there already
//! - [`report`]: what a person wants to know about the code
//! - [`json`]: the same for programs

mod files;
pub mod json;
pub mod report;

use dalembert_codegen::workspace::certificate::format;
use dalembert_codegen::workspace::generate::Generated;
use dalembert_codegen::workspace::generate::keep::keep;
use dalembert_codegen::workspace::language::Language;
use dalembert_codegen::workspace::simplify::Effort;
use dalembert_report::explain::errors::{MAX_STATES, affordable_states};

use crate::args::GenerateArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress};
use files::Files;

/// Runs the subcommand.
pub fn run(args: &GenerateArgs) -> Outcome {
    let (robot, mut request) = input::robot_and_request(&args.robot, &args.choice)?;
    args.text.set(&mut request);
    request.module.clone_from(&args.name);
    // Before the work: what cannot be written is no news after it.
    let files = Files::of(args, &request)?;
    request.language = language(args, request.language)?;
    let kept = request.plan.take_if(|_| args.save_plan);
    // A comparison with what a whole search gives needs a whole search.
    let session = (!args.check).then(|| progress::watch(&mut request));
    let generated = input::generated(&args.robot, &robot, &request, args.check)?;
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
    output::undenied()?;
    match args.check {
        true => files.compare(&generated.text, certificates.as_deref()),
        false => files.write(&generated.text, certificates.as_deref(), plan.as_deref()),
    }
}

/// The endings of the languages' files; the first of each is advised.
const ENDINGS: [(&str, Language); 6] = [
    ("rs", Language::Rust),
    ("h", Language::C),
    ("hpp", Language::C),
    ("hh", Language::C),
    ("cuh", Language::Cuda),
    ("cu", Language::Cuda),
];

/// Returns the language of the code: that of the ending of `-o`, unless `--language` is given.
///
/// # Errors
/// The ending is that of another language, or of none while `--language` is not given.
fn language(args: &GenerateArgs, asked: Language) -> Result<Language, Failure> {
    let is_asked = args.text.is_given("language");
    let Some((path, ending)) =
        (args.output.as_ref()).and_then(|path| Some((path, path.extension()?)))
    else {
        return Ok(asked);
    };
    let known = ENDINGS
        .iter()
        .find(|(known, _)| ending.eq_ignore_ascii_case(known));
    match known {
        Some((_, language)) if !is_asked || *language == asked => Ok(*language),
        None if is_asked => Ok(asked),
        _ => {
            let endings =
                ENDINGS.map(|(ending, language)| format!(".{ending} ({})", language.name()));
            Err(Failure::Input(format!(
                "error: `{}` does not end as a file of {} does\n  = help: the language follows from \
                 the ending: {}",
                path.display(),
                if is_asked {
                    asked.name()
                } else {
                    "any language"
                },
                endings.join(", ")
            )))
        }
    }
}

/// Returns the certificates of a scene with a tolerance.
fn certificates(generated: &Generated) -> Option<String> {
    let admitted = generated
        .functions
        .iter()
        .filter_map(|f| f.admitted.as_ref());
    let certificates: Vec<_> = admitted.flat_map(|a| &a.certificates).collect();
    (!certificates.is_empty()).then(|| format::write(&certificates))
}
