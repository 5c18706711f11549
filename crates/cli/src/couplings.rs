//! `dalembert explain --couplings`: which coefficients vanish, and why; and which nearly do.

use dalembert_formulas::couplings::{Alive, Couplings, Entry, Inventory, Near, Reason};
use dalembert_formulas::{Frames, Quantity, significant, written};
use dalembert_model::robot::Robot;
use serde_json::json;

use crate::output::Failure;
use crate::report::{Report, Table, cells};

/// Reports the coefficients that vanish, each with its reason, and those that nearly vanish.
pub(crate) fn report(robot: &Robot) -> Result<Report, Failure> {
    let couplings = Couplings::new(robot)?;
    let mut report = Report::of(robot, None);
    report.line(format!(
        "{} of {} coefficients vanish: D_ik with i ≤ k, h_ikm = h_imk with k ≤ m, c_i",
        couplings.zeros.len(),
        couplings.total
    ));
    for line in lines(&couplings) {
        report.line(line);
    }
    let zeros = couplings.zeros.iter().map(|zero| {
        let rotation = zero.rotation.as_ref().map(written);
        json!({
            "name": zero.entry.name().text,
            "reason": zero.reason.word(),
            "because": zero.reason.to_string(),
            "rotation": rotation,
        })
    });
    report.value("zeros", zeros.collect::<Vec<_>>());
    let near = &couplings.near;
    let pairs = near.weak.iter();
    let weak = pairs.map(|(entry, part)| json!({ "name": entry.name().text, "part": part }));
    report.value("near/weak", weak.collect::<Vec<_>>());
    let alive = near.alive.iter().map(|alive| {
        json!({
            "number": alive.symbol.code,
            "value": alive.value,
            "vanishing": alive.vanishing,
            "part": alive.part,
            "names": names(&alive.entries),
        })
    });
    report.value("near/alive", alive.collect::<Vec<_>>());
    if let Some((symbols, entries)) = &near.small {
        let symbols: Vec<&str> = symbols.iter().map(|symbol| symbol.code.as_str()).collect();
        report.value("near/small/numbers", symbols);
        report.value("near/small/names", names(entries));
    }
    Ok(report)
}

/// Writes reasons and near misses, a line each.
pub(crate) fn lines(couplings: &Couplings) -> Vec<String> {
    let mut lines = vec![String::new()];
    for (reason, entries) in couplings.reasons() {
        let entries: Vec<Entry> = entries.into_iter().cloned().collect();
        let (word, names) = (reason.word(), shown(reason, &entries));
        lines.push(format!("{word}: {names}: {reason}"));
    }
    for zero in &couplings.zeros {
        if let Some(rotation) = &zero.rotation {
            let name = zero.entry.name().text;
            lines.push(format!(
                "{name}: rotation and translation are opposite: {name}^rot = −{name}^tran = {}",
                written(rotation)
            ));
        }
    }
    lines.extend(near(&couplings.near));
    if couplings.frames != Frames::File {
        lines.push(String::new());
        lines.push(format!("numbers of a link: {}", couplings.frames.words()));
    }
    lines
}

/// Lists entries; of those that vanish for every arm their number.
fn shown(reason: &Reason, entries: &[Entry]) -> String {
    match reason {
        Reason::Always | Reason::JointKinds { .. } | Reason::Limbs if entries.len() > 40 => {
            format!("{} coefficients", entries.len())
        }
        _ => names(entries).join(", "),
    }
}

fn near(near: &Near) -> Vec<String> {
    let mut lines = Vec::new();
    if !near.weak.is_empty() {
        let pairs = near.weak.iter();
        let weak = pairs.map(|(entry, part)| format!("{} {}", entry.name().text, percent(*part)));
        lines.push(String::new());
        lines.push(format!(
            "weak: the largest |D_ik| is below 2 % of √(max D_ii · max D_kk): {}",
            Vec::from_iter(weak).join(", ")
        ));
    }
    let alive = near.alive.iter().map(|alive: &Alive| {
        let of = match alive.symbol.code.starts_with('I') {
            true => "largest moment of inertia",
            false => "size",
        };
        let [value, vanishing] = [alive.value, alive.vanishing].map(rounded);
        let part = percent(alive.part);
        format!(
            "{} would vanish if {} were {vanishing}: it is {value}, {part} of its link's {of} away",
            many(&alive.entries),
            alive.symbol.text,
        )
    });
    lines.extend(alive);
    if let Some((symbols, entries)) = &near.small {
        let symbols: Vec<&str> = symbols.iter().map(|symbol| symbol.text.as_str()).collect();
        lines.push(format!(
            "{} would vanish if {} were zero, each below 1 % of its link's size",
            many(entries),
            symbols.join(" and ")
        ));
    }
    lines
}

fn many(entries: &[Entry]) -> String {
    let names = names(entries);
    match names.len() {
        0..=8 => names.join(", "),
        count => format!("{} and {} more", names[..6].join(", "), count - 6),
    }
}

fn names(entries: &[Entry]) -> Vec<String> {
    entries.iter().map(|entry| entry.name().text).collect()
}

fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    // Two digits that count.
    let places = (1.0 - percent.log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{percent:.places$} %")
}

fn rounded(value: f64) -> String {
    let sign = if value < 0.0 { "−" } else { "" };
    format!("{sign}{}", significant(value.abs(), 6))
}

/// Adds how many coefficients vanish and repeat; nothing of a robot that has no formulas.
pub(crate) fn count(report: &mut Report, robot: &Robot) {
    let Ok(inventory) = Inventory::new(robot) else {
        return;
    };
    let mut table = Table::keyed("coefficients|total|zero|distinct up to sign");
    for (quantity, name) in [
        (Quantity::Inertia, "D"),
        (Quantity::Christoffel, "h"),
        (Quantity::Gravity, "c"),
    ] {
        let [total, zero, distinct] = inventory.summary(quantity);
        table.row(cells![name, total, zero, distinct]);
    }
    report.table("coefficients", "", table);
}
