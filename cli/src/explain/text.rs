//! The table of steps and the reasons, for readers.

use crate::couplings::{Coupling, Value, summary};
use crate::explained::Explanation;
use crate::explained::errors::Errors;
use crate::explained::merged::Merged;
use crate::explained::parameters::{
    LinkParameters, Parameter, ParameterStatus, Parameters, Together,
};
use crate::explained::steps::Code;
use crate::table3::{self, Pair};
use dalembert_codegen::ScalarType;
use dalembert_model::equations::Formulation;
use dalembert_model::robot::{JointKind, Robot};

use super::{Measured, QUANTITIES};
use crate::args::ExplainArgs;
use crate::output;

/// Returns everything.
pub fn write(robot: &Robot, args: &ExplainArgs, explanations: &[Measured]) -> String {
    let (scene, states) = (args.scene.as_deref(), args.states);
    let scene = scene.map_or_else(String::new, |scene| format!(", scene {scene}"));
    let mut text = format!(
        "robot {}, {} joints, input {}{scene}\n\
         errors: the worst of {states} states inside the limits, f64 against 77 digits,\n\
         in u = 2⁻⁵³; normwise max|error|/max|result|, per joint over each joint's largest\n{}",
        robot.name,
        robot.joints.len(),
        robot.short_hash(),
        match emits_single(explanations) {
            true => "what is in f32: states and code of f32, u = 2⁻²⁴\n",
            false => "",
        }
    );
    for (explanation, errors) in explanations {
        text += &format!("\n{}\n", explanation.function);
        text += &output::table(&rows(explanation, errors), 0);
        text += &why(robot, explanation);
    }
    if args.scene.is_none() {
        text += &table3(robot);
    }
    if let Some(couplings) = explanations
        .iter()
        .find_map(|(e, _)| e.couplings.as_deref())
    {
        text += "\ncoefficients\n";
        text += &coefficients(couplings);
        if args.coefficients {
            text += "\nD_ik with i ≤ k, h_ikm = h_imk with k ≤ m, c_i\n";
            text += &entries(couplings);
        }
    }
    text
}

/// Returns the section of Table 3, which is about whole arms.
fn table3(robot: &Robot) -> String {
    let head = ["Table 3, torques", "mul", "add", "as written: mul", "add"];
    let mut rows = vec![head.map(String::from).to_vec()];
    for compared in table3::comparisons(robot) {
        let numbers = [compared.paper, compared.as_written];
        let numbers = numbers.map(|Pair { mul, add }| [mul, add]);
        let mut row = vec![compared.formulation.to_owned()];
        row.extend(numbers.as_flattened().iter().map(u64::to_string));
        rows.push(row);
    }
    format!("\n{}", output::table(&rows, 0))
}

/// Returns the table of all coefficients.
fn entries(couplings: &[Coupling]) -> String {
    let rows = couplings.iter().map(|Coupling { name, value, .. }| {
        let value = match value {
            Value::Zero => "0".to_owned(),
            Value::Constant => "constant".to_owned(),
            Value::Distinct => "·".to_owned(),
            Value::Equals(other) => other.clone(),
            Value::OppositeOf(other) => format!("−{other}"),
        };
        vec![name.clone(), value]
    });
    output::table(&rows.collect::<Vec<_>>(), 2)
}

/// Returns whether a tolerance took f32 for a row.
fn emits_single(explanations: &[Measured]) -> bool {
    let mut rows = explanations.iter().flat_map(|(e, _)| &e.rows);
    rows.any(|row| matches!(row.code, Code::Emitted(_, ScalarType::F32)))
}

fn rows(explanation: &Explanation, errors: &[Errors]) -> Vec<Vec<String>> {
    let steps = &explanation.rows;
    // Polynomials have counts of their own, where there are such.
    let polynomials = steps.iter().any(|row| row.counts.trig_mul > 0);
    let sines: &[&str] = match polynomials {
        true => &["trig_mul", "trig_add"],
        false => &[],
    };
    let head = [
        &["step", "mul", "add", "sincos"],
        sines,
        &["normwise", "per joint"],
    ];
    let head = head.concat().into_iter();
    let mut rows = vec![head.map(String::from).collect::<Vec<_>>()];
    for (index, (row, errors)) in steps.iter().zip(errors).enumerate() {
        let counts = row.counts;
        let mut title = row.step.title();
        if let Code::Emitted(_, scalar) = &row.code {
            title += &format!(", in {scalar}");
        }
        // Of several scalars each is.
        if index + 1 == steps.len() || matches!(row.code, Code::Emitted(..)) {
            title += ": what is generated";
        }
        let mut cells = vec![title];
        cells.extend([counts.mul, counts.add, counts.sincos].map(|count| count.to_string()));
        if polynomials {
            cells.extend([counts.trig_mul, counts.trig_add].map(|count| count.to_string()));
        }
        cells.extend([errors.normwise, errors.per_joint].map(units));
        rows.push(cells);
    }
    rows
}

/// Three figures are more than an error is worth.
fn units(error: f64) -> String {
    match error {
        ..100.0 => format!("{error:.1}"),
        ..1e6 => format!("{error:.0}"),
        // Not rounding: what a tolerance gave up.
        _ => format!("{error:.0e}"),
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

fn link_text(robot: &Robot, link: &LinkParameters, before: Option<&LinkParameters>) -> String {
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
            None => format!("to the base, which depends on nothing: {moved}"),
        });
    }
    let with = |fate: ParameterStatus| {
        let chosen = link.left.iter().filter(move |(_, _, f)| *f == fate);
        values(chosen.map(|(p, value, _)| (*p, *value)))
    };
    let (stays, idle) = (
        with(ParameterStatus::Stays),
        with(ParameterStatus::NoEffect),
    );
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
    let joints = |count: i32| match count {
        1 => "one joint".to_owned(),
        more => format!("{more} joints"),
    };
    match link.axes {
        0 => {}
        less if less < 0 => line(format!(
            "seen in axes that stay behind by {}: its moments turn, not the vectors",
            joints(-less)
        )),
        more => line(format!(
            "seen in axes that run ahead by {}: its moments turn, not the vectors",
            joints(more)
        )),
    }
    if robot.rows()[link.joint].armature != Default::default() {
        line("its armature stays at the joint: it adds to D_ii alone".to_owned());
    }
    text
}

fn values(list: impl Iterator<Item = (Parameter, f64)>) -> String {
    let shown = list.map(|(parameter, value)| format!("{parameter} {}", figures(value)));
    shown.collect::<Vec<_>>().join(", ")
}

/// Returns six figures, without those that say nothing.
fn figures(value: f64) -> String {
    let text = format!("{value:.5e}");
    let rounded: f64 = text.parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        rounded.to_string()
    }
}

fn coefficients(couplings: &[Coupling]) -> String {
    let lines = QUANTITIES.into_iter().map(|(quantity, _)| {
        let summary = summary(couplings, quantity);
        format!(
            "  {}: {} of {} vanish, {} distinct up to sign\n",
            quantity.symbol(),
            summary.zero,
            summary.total,
            summary.distinct
        )
    });
    lines.collect()
}
