//! `dalembert generate`: Rust source, written, printed or compared.
//!
//! - this file: code, certificates and plan, each in its file
//! - [`report`]: what a person wants to know about the code

pub mod report;

use std::fs;
use std::path::Path;

use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::explain::errors::{MOST_STATES, affordable_states};
use dalembert_codegen::generate::{GenerateError, Generated, GeneratedFunction, Request, generate};
use dalembert_codegen::plan::{self, Edited, Entry, Plan, SceneKey};
use dalembert_codegen::scene::Setting;
use dalembert_codegen::schedule::Program;
use dalembert_codegen::simplify::Effort;
use dalembert_model::robot::Robot;

use crate::args::GenerateArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress};

/// Runs the subcommand.
pub fn run(args: &GenerateArgs) -> Outcome {
    let (robot, mut request) = input::robot_and_request(&args.robot, &args.choice)?;
    let kept = request.plan.take_if(|_| args.save_plan);
    // A comparison with what a whole search gives needs a whole search.
    let session = (!args.check).then(|| progress::watch(&mut request));
    let generated = generate(&robot, &request)?;
    let certificates = certificates(&robot, &request, &generated)?;
    drop(session);
    let states = args.states.unwrap_or(match args.choice.effort {
        Effort::Quick => affordable_states(robot.joints.len()),
        Effort::Thorough => MOST_STATES,
    });
    output::note(&report::text(&robot, &request, &generated, states));
    if args.save_plan {
        save_plan(args, &robot, &request, &generated, kept)?;
    }
    let beside = args
        .output
        .as_ref()
        .map(|file| file.with_extension("certificate.json"));
    let beside = args.certificate.clone().or(beside);
    match (beside, certificates) {
        (Some(file), Some(text)) => put(args, &file, &text)?,
        (Some(_), None) if args.certificate.is_some() => {
            return Err(Failure::Input(
                "error: there is nothing to certify: --certificate is for a scene with a tolerance"
                    .into(),
            ));
        }
        _ => {}
    }
    match &args.output {
        None => output::print(&generated.text),
        Some(file) => put(args, file, &generated.text),
    }
}

/// Writes a file, or compares it.
fn put(args: &GenerateArgs, file: &Path, text: &str) -> Outcome {
    let name = file.display();
    if !args.check {
        output::write_file(file, text)?;
        output::note(&format!("\nwrote {name}"));
        return Ok(());
    }
    match fs::read(file) {
        Ok(bytes) if bytes == text.as_bytes() => {
            output::note(&format!("\n{name} is up to date"));
            Ok(())
        }
        Ok(bytes) => {
            let line = first_difference(&bytes, text);
            Err(Failure::Check(format!(
                "\nerror: {name}:{line}: the file is not what would be generated; run without --check to write it"
            )))
        }
        Err(error) => Err(Failure::Check(format!(
            "\nerror: {name} cannot be compared: {error}"
        ))),
    }
}

/// The certificates of a scene with a tolerance, checked: those of a plan
/// were not until now.
fn certificates(
    robot: &Robot,
    request: &Request,
    generated: &Generated,
) -> Result<Option<String>, Failure> {
    let admitted = generated
        .functions
        .iter()
        .filter_map(|f| f.admitted.as_ref());
    let certificates: Vec<_> = admitted.flat_map(|a| &a.certificates).collect();
    let setting = Setting::of(robot, request.scene.as_ref()).map_err(GenerateError::Scene)?;
    for certificate in &certificates {
        let function = certificate.emitted.function;
        certificate.check_in(&setting).map_err(|why| {
            Failure::Check(format!("error: the certificate of `{function}`: {why}"))
        })?;
    }
    let texts: Vec<String> = certificates.iter().map(|c| c.to_json()).collect();
    Ok(match texts.as_slice() {
        [] => None,
        [one] => Some(one.clone()),
        all => Some(format!("[{}]\n", all.join(", ").replace("\n, ", ",\n"))),
    })
}

/// Keeps the programs; those of other requests for the same robot stay.
fn save_plan(
    args: &GenerateArgs,
    robot: &Robot,
    request: &Request,
    generated: &Generated,
    kept: Option<Plan>,
) -> Result<(), Failure> {
    let input = plan::input_hash(robot);
    let mut plan = kept.filter(|plan| plan.input == input).unwrap_or(Plan {
        robot: robot.name.clone(),
        input,
        entries: Vec::new(),
    });
    for function in &generated.functions {
        for scalar in scalars(request, function) {
            plan.insert(Entry {
                start: request.start,
                scalar,
                source: function.source,
                stages: function.stages.clone(),
                scene: request.scene.as_ref().map(SceneKey::of),
                program: exact(function).clone(),
                edited: function.admitted.as_ref().and_then(|admitted| {
                    let claim = admitted.libm.iter().find(|claim| claim.scalar == scalar)?;
                    Some(Edited {
                        stages: admitted.stages.clone(),
                        program: admitted.program.clone(),
                        bounds: claim.bounds.clone(),
                        lambda_min: claim.lambda_min,
                    })
                }),
            });
        }
    }
    let path = plan::file::path(&args.robot);
    output::write_file(&path, &plan.write())?;
    output::note(&format!("\nkept the programs in {}", path.display()));
    Ok(())
}

/// The scalars that a function was emitted in.
fn scalars(request: &Request, function: &GeneratedFunction) -> Vec<ScalarType> {
    match &function.admitted {
        None => request.scalars.clone(),
        Some(admitted) => admitted.certificates.iter().map(|c| c.scalar).collect(),
    }
}

/// The proved program: what a tolerance was applied to.
fn exact(function: &GeneratedFunction) -> &Program {
    let admitted = function.admitted.as_ref();
    let first = admitted.and_then(|admitted| admitted.stages.first());
    first.map_or(&function.program, |stage| &stage.program)
}

/// The first line, from one, in which a file differs from a text.
fn first_difference(bytes: &[u8], text: &str) -> usize {
    let same = bytes
        .iter()
        .zip(text.as_bytes())
        .take_while(|(a, b)| a == b)
        .filter(|(byte, _)| **byte == b'\n');
    same.count() + 1
}
