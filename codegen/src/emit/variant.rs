//! The documentation of a function that was reduced under a tolerance.

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use super::paragraph;
use crate::figures::{at_least, bound as up, inside};
use crate::function::{Argument, ErrorScale, Quantity};
use crate::program::Program;
use crate::setup::Setup;
use crate::sincos::interval::Interval;
use crate::tolerance::input_box::payloads;
use crate::tolerance::variant::{Variant, VariantSet};

pub(super) fn describe(admitted: &VariantSet, variant: &Variant, setup: &Setup) -> Vec<String> {
    let mut lines = Vec::from(paragraph([
        "",
        "Shown: inside the box, |this code - the full model| ≤ E·T. The last two columns split E",
        "into what differs in real numbers and rounding. [`in_box`] says whether a state is inside.",
    ]));
    let quantities = variant.emitted.function.quantities();
    lines.extend(sentences(variant.relative_to, quantities));
    lines.extend(bounds(variant, setup));
    lines.extend(states(variant, setup));
    lines.push(String::new());
    lines.push(match admitted.is_other() {
        true => {
            let [operations, exact] =
                [&variant.emitted, &admitted.exact].map(|program| program.counts().operations());
            format!(
                "It has {operations} operations, without its sines; the full model has {exact}."
            )
        }
        false => "Nothing was left out.".into(),
    });
    lines
}

fn bounds(variant: &Variant, setup: &Setup) -> Vec<String> {
    let units = units(&variant.emitted, setup.robot());
    let head = "| output | T | E | real | rounding |";
    let mut lines = Vec::from(paragraph(["", head, "|---|---|---|---|---|"]));
    let bounds = variant.bounds.iter().zip(&variant.scales);
    for (index, ((bound, scale), unit)) in bounds.zip(units).enumerate() {
        let [total, real, rounding] = [bound.total(), bound.real, bound.rounding].map(up);
        let (entry, scale) = (variant.emitted.entry(index), at_least(*scale));
        let errors = format!("{total} | {real} | {rounding}");
        lines.push(format!("| {entry} | {scale} {unit} | {errors} |"));
    }
    lines
}

pub(super) fn held(
    variant: &Variant,
    setup: &Setup,
    argument: Argument,
    joint: usize,
) -> Option<Interval> {
    match argument {
        Argument::Position => variant.positions(setup.robot(), joint),
        _ => variant.limits.of_argument(argument).get(joint).copied(),
    }
}

fn states(variant: &Variant, setup: &Setup) -> Vec<String> {
    let limits = &variant.limits;
    let arguments = variant.emitted.arguments.iter();
    let state = arguments.filter(|argument| Argument::STATE.contains(argument));
    let columns: &Vec<Argument> = &state.copied().collect();
    let names: Vec<&str> = columns.iter().map(|argument| argument.symbol()).collect();
    let mut lines = vec![
        String::new(),
        format!("| joint | {} |", names.join(" | ")),
        format!("|{}", "---|".repeat(columns.len() + 1)),
    ];
    let robot = setup.robot();
    for coordinate in 0..robot.coordinates() {
        let joint = robot.joint_of(coordinate);
        let range = |&argument: &Argument| {
            let index = match argument {
                Argument::Position => joint,
                _ => Some(coordinate),
            };
            let range = index.map(|index| held(variant, setup, argument, index));
            match range {
                None => String::new(),
                _ if joint.is_some_and(|joint| setup.lock(joint).is_some()) => "locked".to_owned(),
                Some(Some(range)) => inside(range.low(), range.high()),
                Some(None) => "any".to_owned(),
            }
        };
        let ranges: Vec<String> = columns.iter().map(range).collect();
        let label = match joint {
            Some(joint) => (joint + 1).to_string(),
            None => robot.coordinate_label(coordinate),
        };
        lines.push(format!("| {label} | {} |", ranges.join(" | ")));
    }
    if variant.emitted.arguments.contains(&Argument::Gravity) {
        let most = limits.gravity.first().map_or(0.0, |range| range.high());
        lines.push(String::new());
        lines.push(format!(
            "Gravity `g` has any direction and a length in {}, m/s²: [`in_box`] does not ask for it.",
            inside(0.0, most)
        ));
    }
    if variant.load.is_some() {
        lines.push(String::new());
        let default = match setup.robot().payload_range {
            Some(_) => "",
            None => " (no range is given)",
        };
        lines.push(format!("Payloads: {}{default}.", payloads(setup)));
    }
    lines
}

/// Says what T is: a sentence for each kind of output.
fn sentences(relative_to: Scale, quantities: &[Quantity]) -> Vec<String> {
    if relative_to == Scale::Range {
        return Vec::from(paragraph([
            "T of an output is a size that it attains in the box, at its largest there or just",
            "below.",
        ]));
    }
    let has = |scale| quantities.iter().any(|q| q.facts().scale == scale);
    let is_load = |q: &&Quantity| q.facts().scale == ErrorScale::Load;
    let loads = quantities.iter().filter(is_load);
    let symbols: Vec<&str> = loads.map(|quantity| quantity.symbol()).collect();
    let mut lines = Vec::new();
    if !symbols.is_empty() {
        let what = "is T_i, the torque limit of the joint's actuator.";
        lines.push(format!("T of {} {what}", symbols.join(" and of ")));
    }
    if has(ErrorScale::Inertia) {
        lines.extend(paragraph([
            "T of D_ik is min(T_i/q̈_k, T_k/q̈_i): the inertia that by itself takes the torque",
            "limit T_i of an actuator at the largest acceleration q̈_k of the box.",
        ]));
    }
    if has(ErrorScale::Coefficient) {
        lines.extend(paragraph([
            "T of h_ikm is T_i/(q̇_k q̇_m): the coefficient that by itself takes the torque limit",
            "T_i at the largest velocities of the box.",
        ]));
    }
    lines
}

fn units(program: &Program, robot: &Robot) -> Vec<&'static str> {
    let (rows, sizes) = (&program.rows, program.sizes());
    let mut units = Vec::new();
    for quantity in program.function.quantities() {
        let entries = 0..quantity.len(sizes);
        units.extend(entries.map(|index| quantity.unit(index, rows, sizes, robot)));
    }
    units
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::{Function, Sizes};
    use dalembert_model::read::parse;

    #[test]
    fn units_of_mixed_joints() {
        let joint = |kind: &str| {
            format!(
                "[[joint]]\nkind = \"{kind}\"\nmass = 1\ncom = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n"
            )
        };
        let head = "name = \"arm\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n";
        let source = [head, &joint("revolute"), &joint("prismatic")].concat();
        let robot = parse(&source).unwrap().robot;
        let of = |function| units(&Program::empty(function, Sizes::whole(2)), &robot).join(" ");
        assert_eq!(of(Function::InverseDynamics), "N·m N");
        let equation = of(Function::ManipulatorEquation);
        assert_eq!(equation, "kg·m² kg·m kg·m kg N·m N N·m N");
        let symbols = "kg·m² kg·m kg·m kg kg·m kg kg kg/m";
        let coefficients = of(Function::DynamicCoefficients);
        assert_eq!(coefficients, format!("kg·m² kg·m kg·m kg {symbols} N·m N"));
    }

    #[test]
    fn every_kind_of_output_has_its_t() {
        let said = |function: Function| sentences(Scale::Actuator, function.quantities()).join(" ");
        let torques = said(Function::InverseDynamics);
        assert!(torques.starts_with("T of τ is T_i") && !torques.contains("D_ik"));
        let inertia = said(Function::Inertia);
        assert!(inertia.starts_with("T of D_ik is min(T_i/q̈_k, T_k/q̈_i)"));
        let whole = said(Function::ManipulatorEquation);
        assert!(whole.contains("T of h and of c is") && whole.contains("D_ik"));
        let symbols = said(Function::DynamicCoefficients);
        for kind in ["T of c is", "D_ik", "T of h_ikm is T_i/(q̇_k q̇_m)"] {
            assert!(symbols.contains(kind), "{symbols}");
        }
    }
}
