//! What a tolerance left of a function, in the words of its documentation.

use dalembert_checker::certify::Body;

use super::scale;
use crate::figures::{at_least, bound as up, inside};
use crate::function::Argument;
use crate::interval::Interval;
use crate::setup::Setup;
use crate::tolerance::input_box::payloads;
use crate::tolerance::variant::{Admitted, Variant};

pub(super) fn describe(admitted: &Admitted, variant: &Variant, setup: &Setup) -> Vec<String> {
    let mut lines = [
        "",
        "Shown: inside the box, |this code - the full model| ≤ E·T. The last two columns split E",
        "into what differs in real numbers and rounding. [`in_box`] says whether a state is inside.",
    ]
    .map(String::from)
    .to_vec();
    let quantities = variant.emitted.function.quantities();
    lines.extend(scale::sentences(variant.relative_to, quantities));
    lines.push(String::new());
    lines.extend(bounds(variant, setup));
    lines.push(String::new());
    lines.extend(states(variant, setup));
    lines.push(String::new());
    lines.push(match admitted.is_other() {
        true => {
            let [own, exact] =
                [&variant.emitted, &admitted.exact].map(|own| own.counts().operations());
            format!("It has {own} operations, without its sines; the full model has {exact}.")
        }
        false => "Nothing was left out.".into(),
    });
    lines
}

fn bounds(variant: &Variant, setup: &Setup) -> Vec<String> {
    let units = scale::units(&variant.emitted, setup.robot());
    let mut lines = vec![
        "| output | T | E | real | rounding |".to_owned(),
        "|---|---|---|---|---|".to_owned(),
    ];
    let bounds = variant.bounds.iter().zip(&variant.scales);
    for (index, ((bound, scale), unit)) in bounds.zip(units).enumerate() {
        let errors = [bound.total(), bound.real, bound.rounding];
        lines.push(format!(
            "| {} | {} {unit} | {} |",
            variant.emitted.entry(index),
            at_least(*scale),
            errors.map(up).join(" | ")
        ));
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
    let columns: Vec<Argument> = arguments
        .filter(|own| Argument::STATE.contains(own))
        .copied()
        .collect();
    let columns = &columns;
    let names: Vec<&str> = columns.iter().map(|argument| argument.symbol()).collect();
    let mut lines = vec![
        format!("| joint | {} |", names.join(" | ")),
        format!("|{}", "---|".repeat(columns.len() + 1)),
    ];
    for joint in 0..limits.joints() {
        let range = |&argument: &Argument| match held(variant, setup, argument, joint) {
            _ if setup.lock(joint).is_some() => "locked".to_owned(),
            Some(range) => inside(range.low(), range.high()),
            None => "any".to_owned(),
        };
        let ranges: Vec<String> = columns.iter().map(range).collect();
        lines.push(format!("| {} | {} |", joint + 1, ranges.join(" | ")));
    }
    if variant.load.is_some() {
        lines.push(String::new());
        lines.push(payloads_of(setup));
    }
    lines
}

fn payloads_of(setup: &Setup) -> String {
    let given = setup.robot().payload_range.as_ref();
    let Body { mass, radius } = payloads(setup);
    let [low, high] = mass;
    let default = if given.is_none() {
        " (no range is given)"
    } else {
        ""
    };
    format!(
        "Payloads: {low} to {high} kg, all of it within {radius} m of the origin of its frame{default}."
    )
}
