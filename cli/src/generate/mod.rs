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
use dalembert_codegen::workspace::simplify::Effort;
use dalembert_report::explain::errors::{MAX_STATES, affordable_states};

use crate::args::GenerateArgs;
use crate::outcome::Outcome;
use crate::{input, output, progress};
use files::Files;

/// Runs the subcommand.
pub fn run(args: &GenerateArgs) -> Outcome {
    let (robot, mut request) = input::robot_and_request(&args.robot, &args.choice)?;
    args.text.set(&mut request);
    // Before the work: what cannot be written is no news after it.
    let files = Files::of(args, &request)?;
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
    match args.check {
        true => files.compare(&generated.text, certificates.as_deref()),
        false => files.write(&generated.text, certificates.as_deref(), plan.as_deref()),
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
