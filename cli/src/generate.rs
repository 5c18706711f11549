//! `dalembert generate`: Rust source, written, printed or compared.

use std::fs;

use dalembert_codegen::generate::{Generated, Request, generate};
use dalembert_codegen::plan::{self, Entry, Plan, SceneKey};
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
    drop(session);
    output::note(&report(&robot, &request, &generated));
    if args.save_plan {
        save_plan(args, &robot, &request, &generated, kept)?;
    }
    let Some(file) = &args.output else {
        return output::print(&generated.text);
    };
    let name = file.display();
    if !args.check {
        output::write_file(file, &generated.text)?;
        output::note(&format!("\nwrote {name}"));
        return Ok(());
    }
    match fs::read(file) {
        Ok(bytes) if bytes == generated.text.as_bytes() => {
            output::note(&format!("\n{name} is up to date"));
            Ok(())
        }
        Ok(bytes) => {
            let line = first_difference(&bytes, &generated.text);
            Err(Failure::Check(format!(
                "\nerror: {name}:{line}: the file is not what would be generated; run without --check to write it"
            )))
        }
        Err(error) => Err(Failure::Check(format!(
            "\nerror: {name} cannot be compared: {error}"
        ))),
    }
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
        for &scalar in &request.scalars {
            plan.insert(Entry {
                start: request.start,
                scalar,
                source: function.source,
                stages: function.stages.clone(),
                scene: request.scene.as_ref().map(SceneKey::of),
                program: function.program.clone(),
            });
        }
    }
    let path = plan::file::path(&args.robot);
    output::write_file(&path, &plan.write())?;
    output::note(&format!("\nkept the programs in {}", path.display()));
    Ok(())
}

/// What a person wants to know about the code.
fn report(robot: &Robot, request: &Request, generated: &Generated) -> String {
    let mut text = format!(
        "robot {}, {} joints, input {}{}\n\n",
        robot.name,
        robot.joints.len(),
        robot.short_hash(),
        scene(request)
    );
    text += &counts(generated);
    text += "\nmul add sincos after each stage\n";
    text += &stages(generated);
    text += "\nproved: with exact constants, every function\n";
    for function in &generated.functions {
        text += &format!("  {}: {}\n", function.function, function.proof);
    }
    text += "the text was read back: it is the proved program, each constant rounded once\n";
    for warning in &generated.warnings {
        text += &format!("warning: {warning}\n");
    }
    text
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
            function.source.name().to_owned(),
            format!("exact, miss < 1e{}", function.proof.failure_exponent),
        ]);
    }
    output::table(&rows, 2)
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
