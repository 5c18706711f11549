//! `NAME_batch`, `NAME_columns` and what the crate that runs them asks for: each
//! argument in its place, each number of the result in its place.

use super::call::{expect, parameters};
use super::{Text, TextError, result, statements};
use crate::backend::read::Reader;
use crate::backend::read::error::EntryFault;
use crate::function::{Function, Sizes};

/// Checks them.
pub(super) fn check(text: &Text<'_>, arguments: &[String]) -> Result<(), TextError> {
    let name = text.function.name();
    let passed = arguments.join(", ");
    let mut kind = None;
    for (entry, driver) in [("batch", "states"), ("columns", "columns")] {
        let (first, head, lines) = text.function(&format!("{name}_{entry}"))?;
        let names: Vec<&str> = parameters(head).collect();
        expect(&names.join(", "), &format!("{passed}, results"), first + 1)?;
        let line = lines.first().copied().unwrap_or_default();
        let (path, values) = line.split_once(">(").unwrap_or_default();
        expect(values, &format!("[{passed}], results)"), first + 2)?;
        let found = path.split_once(&format!("::{driver}::<"));
        let found = found.and_then(|(_, rest)| Some(rest.split_once(", ")?.0));
        if found.is_none() || kind.is_some_and(|kind| Some(kind) != found) {
            let line = line.to_owned();
            let fault = EntryFault::Driver { driver, line };
            return Err(TextError::new(first + 2, fault));
        }
        kind = found;
    }
    implementation(text, kind.unwrap_or_default(), &passed)
}

fn implementation(text: &Text<'_>, kind: &str, passed: &str) -> Result<(), TextError> {
    let missing = |part: &'static str| {
        let kind = kind.to_owned();
        TextError::new(1, EntryFault::Lacks { kind, part })
    };
    let end = format!(" for {kind} {{");
    let start = text.lines.iter().position(|line| line.ends_with(&end));
    let start = start.ok_or_else(|| missing("implementation"))?;
    let method = |name: &'static str| {
        let head = format!("fn {name}<const L: usize>(");
        let rest = &text.lines[start..];
        let at = rest.iter().position(|line| line.starts_with(&head));
        at.map(|at| start + at).ok_or_else(|| missing(name))
    };

    let lanes = method("lanes")?;
    let parameter = text.lines[lanes]
        .split_once("([")
        .map_or("", |(_, rest)| rest);
    let names = parameter.split_once("]: ").map_or("", |(names, _)| names);
    expect(names, passed, lanes + 1)?;
    let call = text.lines.get(lanes + 1).copied().unwrap_or_default();
    expect(
        call,
        &format!("{}_lanes({passed})", text.function),
        lanes + 2,
    )?;

    let state = method("state")?;
    let mut none = Reader::new(text.scalar);
    let (tail, _) = statements(&mut none, &text.lines[state + 1..], "state")
        .map_err(|error| error.after(state + 1))?;
    let items = result::items(&tail, text.function);
    let items = items.map_err(|fault| TextError::new(state + 1, fault))?;
    let places = places(text.function, text.sizes);
    if items.len() != places.len() {
        return Err(TextError::new(state + 1, EntryFault::OtherArm));
    }
    let expected: Vec<String> = places
        .iter()
        .map(|place| format!("results{place}[l]"))
        .collect();
    expect(&items.join(", "), &expected.join(", "), state + 1)?;

    let columns = method("columns")?;
    let all: Vec<String> = places
        .iter()
        .map(|place| match place.is_empty() {
            true => "*results".to_owned(),
            false => format!("results{place}"),
        })
        .collect();
    let found = text.lines.get(columns + 1).copied().unwrap_or_default();
    expect(found, &format!("[{}]", all.join(", ")), columns + 2)
}

/// Where the numbers of a result stand, in their order.
fn places(function: Function, sizes: Sizes) -> Vec<String> {
    let mut all = Vec::new();
    for quantity in function.quantities() {
        let mut places = vec![match function.structure() {
            Some(_) => format!(".{}", quantity.field()),
            None => String::new(),
        }];
        for length in quantity.shape().lengths(sizes) {
            let longer = |place: &String| {
                let place = place.clone();
                (0..length).map(move |at| format!("{place}[{at}]"))
            };
            places = places.iter().flat_map(longer).collect();
        }
        all.extend(places);
    }
    all
}
