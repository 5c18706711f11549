//! What a tolerance left of a function, in the words of its documentation.

use std::cmp::Reverse;

use super::scale;
use crate::approximate::admitted::Admitted;
use crate::certificate::Certificate;
use crate::edits::Omission;
use crate::figures::{at_least, bound as up, inside};
use crate::function::Argument;
use crate::interval::Interval;
use crate::setup::Setup;

pub(super) fn describe(
    admitted: &Admitted,
    certificate: &Certificate,
    setup: &Setup,
) -> Vec<String> {
    let mut lines = [
        "",
        "Certified: inside the box, |this code - the full model| ≤ E·T. The last two columns split E",
        "into what differs in real numbers and rounding. [`in_box`] says whether a state is inside.",
    ]
    .map(String::from)
    .to_vec();
    let quantities = certificate.emitted.function.quantities();
    lines.extend(scale::sentences(certificate.relative_to, quantities));
    lines.push(String::new());
    lines.extend(bounds(certificate, setup));
    lines.push(String::new());
    lines.extend(states(certificate, setup));
    lines.push(String::new());
    if !admitted.left_out.is_empty() {
        lines.extend(omitted(admitted.left_out.clone()));
    } else if admitted.is_other() {
        lines.push("Computed by a smaller model, fitted to the full one.".into());
    } else {
        lines.push("Nothing was left out.".into());
    }
    lines
}

const MAX_LISTED: usize = 3;

fn omitted(mut left_out: Vec<Omission>) -> Vec<String> {
    let count = left_out.len();
    // Stable: of equal ones the first.
    left_out.sort_by_key(|omission| Reverse((omission.sincos, omission.operations)));
    left_out.truncate(MAX_LISTED);
    let mut lines = vec![
        match count {
            1 => "Left out, and the operations that it would bring back:".to_owned(),
            2..=MAX_LISTED => "Left out, and the operations that each would bring back:".to_owned(),
            _ => format!(
                "Left out: {count} values, which `dalembert generate` lists. The {MAX_LISTED} that save \
                 most, and the operations that each would bring back:"
            ),
        },
        String::new(),
    ];
    let listed = left_out.iter();
    lines.extend(listed.map(|omission| format!("- `{}`: {}", omission.words, saved(omission))));
    lines
}

fn saved(omission: &Omission) -> String {
    match omission.sincos {
        0 => omission.operations.to_string(),
        1 => format!("{} and a sine/cosine pair", omission.operations),
        more => format!("{} and {more} sine/cosine pairs", omission.operations),
    }
}

fn bounds(certificate: &Certificate, setup: &Setup) -> Vec<String> {
    let units = scale::units(&certificate.emitted, setup.robot());
    let mut lines = vec![
        "| output | T | E | real | rounding |".to_owned(),
        "|---|---|---|---|---|".to_owned(),
    ];
    let bounds = certificate.bounds.iter().zip(&certificate.scales);
    for (index, ((bound, scale), unit)) in bounds.zip(units).enumerate() {
        let errors = [bound.total(), bound.model + bound.sincos, bound.rounding];
        lines.push(format!(
            "| {} | {} {unit} | {} |",
            certificate.emitted.entry(index),
            at_least(*scale),
            errors.map(up).join(" | ")
        ));
    }
    lines
}

pub(super) fn held(
    certificate: &Certificate,
    setup: &Setup,
    argument: Argument,
    joint: usize,
) -> Option<Interval> {
    match argument {
        Argument::Position => certificate.positions(setup.robot(), joint),
        _ => certificate.limits.of_argument(argument).get(joint).copied(),
    }
}

fn states(certificate: &Certificate, setup: &Setup) -> Vec<String> {
    let limits = &certificate.limits;
    let columns = &certificate.emitted.arguments;
    let names: Vec<&str> = columns.iter().map(|argument| argument.symbol()).collect();
    let mut lines = vec![
        format!("| joint | {} |", names.join(" | ")),
        format!("|{}", "---|".repeat(columns.len() + 1)),
    ];
    for joint in 0..limits.joints() {
        let range = |&argument: &Argument| match held(certificate, setup, argument, joint) {
            _ if setup.lock(joint).is_some() => "locked".to_owned(),
            Some(range) => inside(range.low(), range.high()),
            None => "any".to_owned(),
        };
        let ranges: Vec<String> = columns.iter().map(range).collect();
        lines.push(format!("| {} | {} |", joint + 1, ranges.join(" | ")));
    }
    lines
}
