//! What a tolerance left of a function, in the words of its documentation.

use dalembert_model::scene::Scale;

use super::ScalarType;
use crate::certify::certificate::{Certificate, Split};
use crate::certify::choose::Admitted;
use crate::certify::interval::Interval;
use crate::certify::prune::omissions;
use crate::function::Argument;

/// A line each: the certificate, the box, what was left out.
pub(super) fn describe(admitted: &Admitted, scalar: ScalarType) -> Vec<String> {
    let mut all = admitted.certificates.iter();
    let Some(certificate) = all.find(|certificate| certificate.scalar == scalar) else {
        return Vec::new();
    };
    let mut lines = vec![String::new()];
    lines.push(
        "Certified: inside the box, |this code - the full model| ≤ E·T, of which each cause has"
            .into(),
    );
    lines.push(format!(
        "its part. T is {}.",
        match certificate.relative_to {
            Some(Scale::Actuator) => "the actuators' torque limit",
            Some(Scale::Range) => "the model's own largest value",
            None => "as given",
        }
    ));
    lines.push(String::new());
    lines.extend(bounds(certificate));
    lines.push(String::new());
    lines.extend(states(certificate));
    lines.push(String::new());
    let left_out = omissions(&admitted.stages);
    if left_out.is_empty() {
        lines.push("Nothing was left out.".into());
    } else {
        lines.push("Left out, and the operations that each would bring back:".into());
        lines.push(String::new());
        lines.extend(
            left_out
                .iter()
                .map(|omission| format!("- `{}`: {}", omission.words, saved(omission))),
        );
    }
    lines
}

fn saved(omission: &crate::certify::prune::Omission) -> String {
    match omission.sincos {
        0 => omission.operations.to_string(),
        1 => format!("{} and a sine/cosine pair", omission.operations),
        more => format!("{} and {more} sine/cosine pairs", omission.operations),
    }
}

fn bounds(certificate: &Certificate) -> Vec<String> {
    let mut lines = vec![
        "| output | T | E | left out | sin/cos | rounding |".to_owned(),
        "|---|---|---|---|---|---|".to_owned(),
    ];
    for (index, (bound, scale)) in certificate
        .bounds
        .iter()
        .zip(&certificate.scales)
        .enumerate()
    {
        let Split {
            model,
            sincos,
            rounding,
        } = bound;
        lines.push(format!(
            "| {} | {} | {} | {} | {} | {} |",
            certificate.emitted.entry(index),
            short(*scale),
            up(bound.total()),
            up(*model),
            up(*sincos),
            up(*rounding)
        ));
    }
    lines
}

/// The box, for what the function reads.
fn states(certificate: &Certificate) -> Vec<String> {
    let limits = &certificate.limits;
    let columns: Vec<(&str, &[Interval])> = certificate
        .emitted
        .arguments
        .iter()
        .map(|argument| match argument {
            Argument::Position => ("q", limits.position.as_slice()),
            Argument::Velocity => ("q̇", limits.velocity.as_slice()),
            Argument::Acceleration => ("q̈", limits.acceleration.as_slice()),
        })
        .collect();
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let mut lines = vec![
        format!("| joint | {} |", names.join(" | ")),
        format!("|{}", "---|".repeat(columns.len() + 1)),
    ];
    for joint in 0..limits.joints() {
        let ranges: Vec<String> = columns
            .iter()
            .filter_map(|(_, ranges)| ranges.get(joint))
            .map(|range| format!("{} to {}", short(range.low()), short(range.high())))
            .collect();
        lines.push(format!("| {} | {} |", joint + 1, ranges.join(" | ")));
    }
    lines
}

/// Three digits, rounded up: what is read off is a bound too.
fn up(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    let near = format!("{x:.2e}");
    let (digits, exponent) = near.split_once('e').unwrap_or((&near, "0"));
    match (digits.parse::<f64>(), near.parse::<f64>()) {
        // 9.99 becomes 10.00, which reads as well.
        (Ok(digits), Ok(read)) if read < x => format!("{:.2}e{exponent}", digits + 0.01),
        _ => near,
    }
}

/// Five digits.
fn short(x: f64) -> String {
    let near = format!("{x:.4e}").parse().unwrap_or(x);
    if near == 0.0 || (1e-3..1e5).contains(&f64::abs(near)) {
        format!("{near}")
    } else {
        format!("{near:e}")
    }
}
