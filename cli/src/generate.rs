//! `dalembert generate`: Rust source, written, printed or compared.

use std::fs;
use std::path::Path;

use dalembert_codegen::certify::certificate::Certificate;
use dalembert_codegen::certify::choose::Admitted;
use dalembert_codegen::certify::prune::omissions;
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::explain::errors::{MOST_STATES, affordable_states, of_program};
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
    output::note(&report(&robot, &request, &generated, states));
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

/// What a person wants to know about the code.
fn report(robot: &Robot, request: &Request, generated: &Generated, states: usize) -> String {
    let mut text = format!(
        "robot {}, {} joints, input {}{}\n\n",
        robot.name,
        robot.joints.len(),
        robot.short_hash(),
        scene(request)
    );
    text += &counts(generated);
    text += &errors(robot, request, generated, states);
    text += "\nmul add sincos after each stage\n";
    text += &stages(generated);
    for function in &generated.functions {
        if let Some(admitted) = &function.admitted {
            text += &tolerance(admitted);
        }
    }
    text += "\nproved: with exact constants, every function\n";
    for function in &generated.functions {
        text += &format!("  {}: {}\n", function.function, function.proof);
    }
    text += match generated.functions.iter().any(|f| f.admitted.is_some()) {
        true => "the text was read back: it is the certified program, each constant rounded once\n",
        false => "the text was read back: it is the proved program, each constant rounded once\n",
    };
    for warning in &generated.warnings {
        text += &format!("warning: {warning}\n");
    }
    text
}

/// What rounding costs each program. A scene's own programs read other
/// states: what a tolerance admits has its certificates.
fn errors(robot: &Robot, request: &Request, generated: &Generated, states: usize) -> String {
    if request.scene.is_some() {
        return String::new();
    }
    let mut head = vec!["function".to_owned()];
    for scalar in &request.scalars {
        head.extend(["normwise", "per joint"].map(|what| format!("{scalar} {what}")));
    }
    let mut rows = vec![head];
    for function in &generated.functions {
        let mut row = vec![function.function.to_string()];
        for errors in of_program(robot, &function.program, &request.scalars, states) {
            row.extend([errors.normwise, errors.per_joint].map(|error| format!("{error:.1}")));
        }
        rows.push(row);
    }
    format!(
        "\nthe worst errors inside the limits, in u (f64 2^-53, f32 2^-24), of this many states: {states}\n{}",
        output::table(&rows, 0)
    )
}

/// What a tolerance admitted: E by cause, and what was left out.
fn tolerance(admitted: &Admitted) -> String {
    let mut text = String::new();
    for certificate in &admitted.certificates {
        let function = certificate.emitted.function;
        text += &format!("\n{function} in {}, certified\n", certificate.scalar);
        text += &output::table(&bounds(certificate), 0);
    }
    let left_out = omissions(&admitted.stages);
    if left_out.is_empty() {
        text += "nothing was left out: no omission was found within the tolerance\n";
        return text;
    }
    text += "\nleft out, and what putting it back costs\n";
    let mut rows = Vec::new();
    for omission in &left_out {
        let pairs = match omission.sincos {
            0 => String::new(),
            pairs => format!("+ {pairs} sincos"),
        };
        rows.push(vec![
            omission.words.clone(),
            omission.operations.to_string(),
            pairs,
        ]);
    }
    text + &output::table(&rows, 1)
}

/// The bounds of a certificate, output by output.
pub fn bounds(certificate: &Certificate) -> Vec<Vec<String>> {
    let head = ["output", "T", "model", "sincos", "rounding", "E"];
    let mut rows = vec![head.map(String::from).to_vec()];
    let pairs = certificate.bounds.iter().zip(&certificate.scales);
    for (index, (bound, scale)) in pairs.enumerate() {
        let mut row = vec![certificate.emitted.entry(index), format!("{scale:.4e}")];
        let parts = [bound.model, bound.sincos, bound.rounding, bound.total()];
        row.extend(parts.map(|x| format!("{x:.3e}")));
        rows.push(row);
    }
    rows
}

/// `, scene pick`, if there is one.
pub fn scene(request: &Request) -> String {
    let scene = request.scene.as_ref();
    scene.map_or_else(String::new, |scene| format!(", scene {}", scene.name))
}

/// The table of operation counts.
pub fn counts(generated: &Generated) -> String {
    let head = ["function", "mul", "add", "div", "sincos", "from", "proof"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for function in &generated.functions {
        let counts = function.counts;
        rows.push(vec![
            function.function.to_string(),
            counts.mul.to_string(),
            counts.add.to_string(),
            counts.div.to_string(),
            counts.sincos.to_string(),
            match function.planned {
                true => format!("{}, plan", function.source.name()),
                false => function.source.name().to_owned(),
            },
            format!("exact, miss < 1e{}", function.proof.failure_exponent),
        ]);
    }
    output::table(&rows, 2) + &sines(generated)
}

/// The table of the polynomials that give sines, if any do.
fn sines(generated: &Generated) -> String {
    let head = [
        "function", "scalar", "trig_mul", "trig_add", "angles", "error",
    ];
    let mut rows = vec![head.map(String::from).to_vec()];
    for function in &generated.functions {
        for (scalar, sines) in &function.sines {
            let counts = function.counts_in(*scalar);
            let worst = sines.iter().map(|sine| sine.errors.worst());
            rows.push(vec![
                function.function.to_string(),
                scalar.to_string(),
                counts.trig_mul.to_string(),
                counts.trig_add.to_string(),
                sines.len().to_string(),
                format!("{:.1e}", worst.fold(0.0, f64::max)),
            ]);
        }
    }
    match rows.len() {
        1 => String::new(),
        _ => format!(
            "\nsines and cosines by polynomials, errors proved\n{}",
            output::table(&rows, 2)
        ),
    }
}

fn stages(generated: &Generated) -> String {
    let mut rows = Vec::new();
    for function in &generated.functions {
        if rows.is_empty() {
            let mut head = vec![String::new()];
            head.extend(function.stages.iter().map(|s| s.name.to_owned()));
            rows.push(head);
        }
        let mut row = vec![function.function.to_string()];
        row.extend(function.stages.iter().map(|stage| {
            let counts = stage.counts;
            format!("{} {} {}", counts.mul, counts.add, counts.sincos)
        }));
        rows.push(row);
    }
    output::table(&rows, 0)
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
