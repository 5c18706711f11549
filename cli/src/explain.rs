//! `dalembert explain`: what each step brought, and why.

use dalembert_codegen::couplings::{Couplings, Finding, Reason};
use dalembert_codegen::explain::errors::{self, Errors};
use dalembert_codegen::explain::merged::Merged;
use dalembert_codegen::explain::parameters::{Fate, LinkFate, Parameter, Parameters, Together};
use dalembert_codegen::explain::{Explanation, explain};
use dalembert_codegen::function::{Function, Quantity};
use dalembert_codegen::generate::Request;
use dalembert_codegen::plan;
use dalembert_codegen::portfolio::Source;
use dalembert_model::equations::Formulation;
use dalembert_model::robot::{JointKind, Robot};
use serde_json::{Map, Value, json};

use crate::args::ExplainArgs;
use crate::outcome::{Failure, Outcome};
use crate::{count, input, output, progress, table3};

/// One function with what rounding costs each of its rows.
type Measured = (Explanation, Vec<Errors>);

/// Runs the subcommand.
pub fn run(args: &ExplainArgs) -> Outcome {
    let robot = input::robot(&args.robot)?;
    let mut request = Request {
        effort: args.effort,
        plan: plan::file::beside(&args.robot)
            .map_err(|message| Failure::Input(format!("error: {message}")))?,
        ..Request::default()
    };
    let session = progress::watch(&mut request);
    let functions = match args.outputs.as_slice() {
        [] => vec![Function::InverseDynamics],
        chosen => chosen.to_vec(),
    };
    let mut explanations = Vec::new();
    for function in functions {
        let explanation = explain(&robot, function, &request)?;
        let errors = errors::measure(&robot, &explanation, args.states);
        explanations.push((explanation, errors));
    }
    drop(session);
    if args.json {
        output::print_json(&json(&robot, args.states, &explanations))
    } else {
        output::print(&text(&robot, args.states, &explanations))
    }
}

fn text(robot: &Robot, states: usize, explanations: &[Measured]) -> String {
    let mut text = format!(
        "robot {}, {} joints, input {}\n\
         errors: the worst of {states} states inside the limits, f64 against 134 digits,\n\
         in u = 2⁻⁵³; normwise max|error|/max|result|, per joint over each joint's largest\n",
        robot.name,
        robot.joints.len(),
        robot.short_hash()
    );
    for (explanation, errors) in explanations {
        text += &format!("\n{}\n", explanation.function);
        text += &output::table(&rows(robot, explanation, errors), 0);
        text += &why(robot, explanation);
    }
    if let Some(couplings) = explanations.iter().find_map(|(e, _)| e.couplings.as_ref()) {
        text += "\ncoefficients\n";
        text += &coefficients(couplings);
    }
    text
}

fn rows(robot: &Robot, explanation: &Explanation, errors: &[Errors]) -> Vec<Vec<String>> {
    let head = ["step", "mul", "add", "sincos", "normwise", "per joint"];
    let mut rows = vec![head.map(String::from).to_vec()];
    if explanation.function == Function::InverseDynamics {
        let [mul, add] = table3::paper(Formulation::LagrangeEuler, robot.joints.len());
        rows.push(vec![
            "Lagrange–Euler, Table 3".to_owned(),
            mul.to_string(),
            add.to_string(),
        ]);
    }
    for (row, errors) in explanation.rows.iter().zip(errors) {
        let counts = row.counts;
        rows.push(vec![
            row.step.title().to_owned(),
            counts.mul.to_string(),
            counts.add.to_string(),
            counts.sincos.to_string(),
            units(errors.normwise),
            units(errors.per_joint),
        ]);
    }
    rows
}

/// Three figures are more than an error is worth.
fn units(error: f64) -> String {
    if error < 100.0 {
        format!("{error:.1}")
    } else {
        format!("{error:.0}")
    }
}

fn why(robot: &Robot, explanation: &Explanation) -> String {
    let mut text = String::from("\nwhat the fingerprints found beyond folding\n");
    for (formulation, merged) in &explanation.merged {
        let Merged {
            operations,
            vanish,
            constant,
            repeat,
        } = merged;
        text += &format!(
            "  {}: of {operations} operations {vanish} vanish in every state, {constant} are \
             constant, {repeat} equal or opposite to another value\n",
            formulation_name(*formulation)
        );
    }
    let Parameters { links, unit } = &explanation.parameters;
    text += &format!(
        "\nparameters: m, s = ∫r dm, Σ = ∫r rᵀ dm of each link, with what arrived from the \
         links after it;\nunit of length {unit} m\n"
    );
    for (index, link) in links.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| &links[before]);
        text += &link_text(robot, link, before);
    }
    text
}

fn formulation_name(formulation: Formulation) -> &'static str {
    match formulation {
        Formulation::LagrangeEuler => "Lagrange–Euler",
        Formulation::Dalembert => "D'Alembert",
        _ => "Newton–Euler",
    }
}

fn link_text(robot: &Robot, link: &LinkFate, before: Option<&LinkFate>) -> String {
    let joint = link.joint + 1;
    let mut text = format!("  link {joint}\n");
    let mut line = |line: String| text += &format!("    {line}\n");
    let through = match link.kind {
        JointKind::Revolute => "on its axis",
        JointKind::Prismatic => "it never turns against the link before",
    };
    if !link.moved.is_empty() {
        let moved = values(link.moved.iter().map(|(p, value)| (*p, *value)));
        line(match before {
            Some(before) => format!("to link {}, {through}: {moved}", before.joint + 1),
            None => format!("to the base, which feels nothing: {moved}"),
        });
    }
    let with = |fate: Fate| {
        let chosen = link.left.iter().filter(move |(_, _, f)| *f == fate);
        values(chosen.map(|(p, value, _)| (*p, *value)))
    };
    let (stays, idle) = (with(Fate::Stays), with(Fate::NoEffect));
    line(match link.needed() {
        0 => "nothing is left of it".to_owned(),
        _ => format!("left: {stays}"),
    });
    if !idle.is_empty() {
        line(format!("without effect on this function: {idle}"));
    }
    match link.together {
        Some(Together::Sum) => line("of Σ_xx and Σ_yy only the sum counts".to_owned()),
        Some(Together::Difference) => {
            line("of Σ_xx and Σ_yy only the difference counts".to_owned());
        }
        None => {}
    }
    if link.spins_freely {
        line(format!(
            "symmetric about its axis: q_{joint} drops out, the frame need not turn"
        ));
    }
    if robot.joints[link.joint].armature != Default::default() {
        line("its armature stays at the joint: it adds to D_ii alone".to_owned());
    }
    text
}

fn values(list: impl Iterator<Item = (Parameter, f64)>) -> String {
    let shown = list.map(|(parameter, value)| format!("{parameter} {}", figures(value)));
    shown.collect::<Vec<_>>().join(", ")
}

/// Six figures, without those that say nothing.
fn figures(value: f64) -> String {
    let text = format!("{value:.5e}");
    let rounded: f64 = text.parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

const QUANTITIES: [(Quantity, &str); 3] = [
    (Quantity::Inertia, "D"),
    (Quantity::Christoffel, "h"),
    (Quantity::Gravity, "c"),
];

const REASONS: [Reason; 5] = [
    Reason::OwnSquare,
    Reason::OwnProduct,
    Reason::Prismatic,
    Reason::Antisymmetry,
    Reason::Geometry,
];

/// How many coefficients of a quantity vanish, and repeat, for a reason.
fn tally(couplings: &Couplings, quantity: Quantity, wanted: Reason) -> [usize; 2] {
    let mut tally = [0, 0];
    for entry in couplings.entries.iter().filter(|e| e.quantity == quantity) {
        match entry.finding {
            Finding::Zero(reason) if reason == wanted => tally[0] += 1,
            Finding::Repeats { reason, .. } if reason == wanted => tally[1] += 1,
            _ => {}
        }
    }
    tally
}

fn coefficients(couplings: &Couplings) -> String {
    let mut text = String::new();
    for (quantity, _) in QUANTITIES {
        let summary = couplings.summary(quantity);
        text += &format!(
            "  {}: {} of {} vanish, {} distinct up to sign\n",
            quantity.symbol(),
            summary.zero,
            summary.total,
            summary.distinct
        );
        for reason in REASONS {
            let [zero, repeats] = tally(couplings, quantity, reason);
            if zero > 0 {
                text += &format!("    {zero} vanish: {reason}\n");
            }
            if repeats > 0 {
                text += &format!("    {repeats} repeat another: {reason}\n");
            }
        }
    }
    text
}

fn json(robot: &Robot, states: usize, explanations: &[Measured]) -> Value {
    let functions: Map<String, Value> = explanations
        .iter()
        .map(|(e, errors)| (e.function.to_string(), explanation_json(robot, e, errors)))
        .collect();
    let couplings = explanations.iter().find_map(|(e, _)| e.couplings.as_ref());
    json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "states": states,
        "functions": functions,
        "coefficients": couplings.map(coefficients_json),
    })
}

fn explanation_json(robot: &Robot, explanation: &Explanation, errors: &[Errors]) -> Value {
    let mut rows = Vec::new();
    if explanation.function == Function::InverseDynamics {
        let [mul, add] = table3::paper(Formulation::LagrangeEuler, robot.joints.len());
        rows.push(json!({ "step": "lagrange_euler_table3", "mul": mul, "add": add }));
    }
    for (row, errors) in explanation.rows.iter().zip(errors) {
        let mut value = json!({ "step": row.step.key() });
        if let (Value::Object(value), Value::Object(counts)) =
            (&mut value, count::counts(&row.counts))
        {
            value.extend(counts);
        }
        value["normwise_u"] = json!(errors.normwise);
        value["per_joint_u"] = json!(errors.per_joint);
        rows.push(value);
    }
    let merged = explanation.merged.iter().map(|(formulation, merged)| {
        json!({
            "formulation": Source::Textbook(*formulation).name(),
            "operations": merged.operations,
            "vanish": merged.vanish,
            "constant": merged.constant,
            "repeat": merged.repeat,
        })
    });
    let links = explanation.parameters.links.iter().map(link_json);
    json!({
        "rows": rows,
        "fingerprints": merged.collect::<Vec<_>>(),
        "unit_of_length": explanation.parameters.unit,
        "links": links.collect::<Vec<_>>(),
    })
}

fn link_json(link: &LinkFate) -> Value {
    let object = |list: Vec<(Parameter, f64)>| -> Map<String, Value> {
        let entries = list.into_iter();
        entries
            .map(|(p, value)| (p.to_string(), json!(value)))
            .collect()
    };
    let with = |fate: Fate| {
        let chosen = link.left.iter().filter(|(_, _, f)| *f == fate);
        object(chosen.map(|(p, value, _)| (*p, *value)).collect())
    };
    json!({
        "joint": link.joint + 1,
        "moved_to_the_link_before": object(link.moved.clone()),
        "left": with(Fate::Stays),
        "without_effect": with(Fate::NoEffect),
        "together": link.together.map(|together| match together {
            Together::Sum => "sum",
            Together::Difference => "difference",
        }),
        "origin": link.origin,
        "spins_freely": link.spins_freely,
    })
}

fn coefficients_json(couplings: &Couplings) -> Value {
    let of = |(quantity, key): (Quantity, &str)| {
        let summary = couplings.summary(quantity);
        let reasons: Map<String, Value> = REASONS
            .into_iter()
            .filter_map(|reason| {
                let [zero, repeats] = tally(couplings, quantity, reason);
                let counts = json!({ "zero": zero, "repeats": repeats });
                (zero + repeats > 0).then(|| (reason.name().to_owned(), counts))
            })
            .collect();
        let value = json!({
            "total": summary.total,
            "zero": summary.zero,
            "distinct": summary.distinct,
            "reasons": reasons,
        });
        (key.to_owned(), value)
    };
    QUANTITIES.into_iter().map(of).collect::<Map<_, _>>().into()
}
