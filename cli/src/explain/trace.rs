//! What a number of the robot file reaches in the code that `generate` prints.

use dalembert_codegen::workspace::task::Request;
use dalembert_model::robot::Robot;
use dalembert_report::trace::parameter::Parameter;
use dalembert_report::trace::{Follower, Trace, trace};
use serde_json::{Value, json};

use crate::args::ExplainArgs;
use crate::outcome::{Failure, Outcome};
use crate::{input, output, progress};

/// More results than this are counted.
const MOST_RESULTS: usize = 8;

/// Generates, and shows what a number reaches.
pub fn run(args: &ExplainArgs, robot: &Robot, mut request: Request, name: &str) -> Outcome {
    let failed = |why: &str| Failure::Input(format!("error: --trace {name}: {why}"));
    let parameter = Parameter::named(robot, name).map_err(|why| failed(&why))?;
    let session = progress::watch(&mut request);
    let generated = input::generated(&args.robot, robot, &request, false)?;
    let traces = trace(robot, &request, &generated, &parameter);
    let traces = traces.map_err(|why| failed(&why.to_string()))?;
    drop(session);
    if args.json {
        let functions = traces.iter().map(of_function).collect::<Vec<_>>();
        return output::print_json(&json!({
            "robot": robot.name,
            "input": robot.short_hash(),
            "number": name,
            "value": parameter.value,
            "functions": functions,
        }));
    }
    let mut text = format!(
        "robot {}, input {}: what {name} = {} reaches, by lines of\n{}\n",
        robot.name,
        robot.short_hash(),
        parameter.value,
        command(args),
    );
    for trace in &traces {
        text += &words(trace);
    }
    output::print(&text)
}

/// Returns the command that prints the code.
fn command(args: &ExplainArgs) -> String {
    let mut command = format!("dalembert generate {}", args.robot.display());
    if let Some(scene) = &args.scene {
        command += &format!(" --scene {scene}");
    }
    if !args.outputs.is_empty() || args.scene.is_none() {
        let names: Vec<String> = args.outputs.iter().map(|f| f.text()).collect();
        let names = if names.is_empty() {
            "inverse_dynamics".to_owned()
        } else {
            names.join(",")
        };
        command += &format!(" --outputs {names}");
    }
    command
}

fn words(trace: &Trace) -> String {
    let (results, count) = &trace.results;
    let mut text = format!("\n{}\n", trace.function);
    if results.is_empty() {
        return text + "  no result changes with it\n";
    }
    text += &format!("  results that change: {}\n", listed(results, *count));
    let Some(constants) = &trace.constants else {
        return text
            + "  no constants follow it: the code has its form because of this very value, and another\n  \
               value gives other operations\n";
    };
    let (reached, operations) = trace.operations;
    let how = match trace.is_searched {
        true => "as a search with another value has it",
        false => "as few as could",
    };
    text += &format!(
        "  constants that follow it: {}, {how}; {reached} of {operations} operations read them, or what does\n",
        constants.len()
    );
    let mut rows = vec![
        ["lines", "constant", "", "reaches"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for constant in constants {
        let lines = constant.lines.iter().map(|(_, line, _)| line.to_string());
        let code = constant.lines.first().map_or("", |(.., code)| code);
        rows.push(vec![
            lines.collect::<Vec<_>>().join(", "),
            constant.literal.clone(),
            code.to_owned(),
            listed(&constant.results, *count),
        ]);
    }
    text + &output::table(&rows, 2)
}

fn listed(results: &[String], count: usize) -> String {
    match results.len() {
        all if all == count && all > 1 => format!("all {count}"),
        more if more > MOST_RESULTS => {
            let first = results[..MOST_RESULTS].join(" ");
            format!("{first} and {} more", more - MOST_RESULTS)
        }
        _ => results.join(" "),
    }
}

fn of_function(trace: &Trace) -> Value {
    let of_constant = |constant: &Follower| {
        let lines = constant.lines.iter().map(
            |(scalar, line, code)| json!({ "scalar": scalar.name(), "line": line, "code": code }),
        );
        json!({
            "constant": constant.literal,
            "lines": lines.collect::<Vec<_>>(),
            "reaches": constant.results,
        })
    };
    let constants = trace.constants.as_ref();
    json!({
        "function": trace.function.text(),
        "results_that_change": trace.results.0,
        "results": trace.results.1,
        "constants": constants.map(|all| all.iter().map(of_constant).collect::<Vec<_>>()),
        "is_searched": trace.is_searched,
        "operations_reached": trace.operations.0,
        "operations": trace.operations.1,
    })
}
