//! The table of steps and the reasons, for programs.

use crate::couplings::{Coupling, summary};
use crate::explained::Explanation;
use crate::explained::errors::Errors;
use crate::explained::parameters::{LinkParameters, Parameter, ParameterStatus, Together};
use crate::explained::steps::Code;
use crate::table3;
use dalembert_codegen::workspace::{Quantity, Source};
use dalembert_model::robot::Robot;
use serde_json::{Map, Value, json};

use super::{Measured, QUANTITIES};
use crate::args::ExplainArgs;
use crate::output;

/// Returns everything.
pub fn write(robot: &Robot, args: &ExplainArgs, explanations: &[Measured]) -> Value {
    let functions: Map<String, Value> = explanations
        .iter()
        .map(|(e, errors)| (e.function.to_string(), explanation_json(e, errors)))
        .collect();
    let couplings = explanations
        .iter()
        .find_map(|(e, _)| e.couplings.as_deref());
    json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "scene": args.scene,
        "states": args.states,
        "functions": functions,
        "table3": args.scene.is_none().then(|| table3::comparisons(robot)),
        "coefficients": couplings.map(coefficients_json),
        "entries": couplings.filter(|_| args.coefficients),
    })
}

fn explanation_json(explanation: &Explanation, errors: &[Errors]) -> Value {
    let mut rows = Vec::new();
    for (row, errors) in explanation.rows.iter().zip(errors) {
        let mut value = json!({ "step": row.step.key() });
        if let Code::Emitted(_, scalar) = &row.code {
            value["scalar"] = json!(scalar.name());
        }
        if let (Value::Object(value), Value::Object(counts)) =
            (&mut value, output::counts(&row.counts))
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

fn link_json(link: &LinkParameters) -> Value {
    let object = |list: Vec<(Parameter, f64)>| -> Map<String, Value> {
        let entries = list.into_iter();
        entries
            .map(|(p, value)| (p.to_string(), json!(value)))
            .collect()
    };
    let with = |fate: ParameterStatus| {
        let chosen = link.left.iter().filter(|(_, _, f)| *f == fate);
        object(chosen.map(|(p, value, _)| (*p, *value)).collect())
    };
    json!({
        "joint": link.joint + 1,
        "moved_to_the_link_before": object(link.moved.clone()),
        "left": with(ParameterStatus::Stays),
        "without_effect": with(ParameterStatus::NoEffect),
        "together": link.together.map(|together| match together {
            Together::Sum => "sum",
            Together::Difference => "difference",
        }),
        "origin": link.origin,
        "spins_freely": link.spins_freely,
        "axes": link.axes,
    })
}

fn coefficients_json(couplings: &[Coupling]) -> Value {
    let of =
        |(quantity, key): (Quantity, &str)| (key.to_owned(), json!(summary(couplings, quantity)));
    QUANTITIES.into_iter().map(of).collect::<Map<_, _>>().into()
}
