//! `dalembert explain`: what each step brought, and why.
//!
//! - this file: what is measured and counted
//! - [`text`]: the table and the reasons for readers
//! - [`json`]: the same for programs

mod json;
mod text;

use crate::explained::errors::{self, Errors};
use crate::explained::{Explanation, explain_all};
use dalembert_codegen::workspace::{Quantity, plan_file};
use dalembert_codegen::{Function, GenerateError, Request};

use crate::args::ExplainArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress};

/// One function with what rounding costs each of its rows.
type Measured = (Explanation, Vec<Errors>);

/// Runs the subcommand.
pub fn run(args: &ExplainArgs) -> Outcome {
    let reading = input::reading(&args.robot)?;
    let functions = match args.outputs.as_slice() {
        [] => vec![Function::InverseDynamics],
        chosen => chosen.to_vec(),
    };
    let mut request = Request {
        functions,
        effort: args.effort,
        plan: plan_file::beside(&args.robot)
            .map_err(|message| Failure::Input(format!("error: {message}")))?,
        ..Request::default()
    };
    if let Some(name) = &args.scene {
        let scene = input::scene(&args.robot, &reading, name)?;
        let outputs = (!args.outputs.is_empty()).then(|| args.outputs.clone());
        request = request.choose(outputs, None, Some(scene));
    }
    let session = progress::watch(&mut request);
    let robot = &reading.robot;
    let explained = match explain_all(robot, &request, &args.without) {
        Err(GenerateError::StalePlan { .. }) => {
            output::note(
                "warning: the plan beside the robot file no longer fits it: a search takes its place",
            );
            request.plan = None;
            explain_all(robot, &request, &args.without)
        }
        explained => explained,
    };
    let explanations = explained?.into_iter();
    let explanations: Vec<Measured> = explanations
        .map(|explanation| {
            let errors = errors::measure(&explanation, args.states);
            (explanation, errors)
        })
        .collect();
    drop(session);
    if args.json {
        output::print_json(&json::write(robot, args, &explanations))
    } else {
        output::print(&text::write(robot, args, &explanations))
    }
}

const QUANTITIES: [(Quantity, &str); 3] = [
    (Quantity::Inertia, "D"),
    (Quantity::Christoffel, "h"),
    (Quantity::Gravity, "c"),
];
