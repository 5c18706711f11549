//! `NAME_lanes`: in a lane every line is one of the function of one state, with
//! `[l]` after the names of what has lanes.
//!
//! Left out, `[l]` is an array where Rust wants a number; so the types see to it
//! that it stands everywhere, and here it is taken away.

use std::collections::BTreeSet;

use super::call::{Call, expect, parameters};
use super::{Reader, Text, TextError};
use crate::backend::entries::lanes::in_lane;
use crate::backend::read::error::{EntryFault, Kind, TextFault};
use crate::function::Argument;
use crate::program::Lowered;

/// The lines of a function, from the one after its head.
struct Lines<'a> {
    lines: &'a [&'a str],
    /// How many were taken, and come before them in the text.
    taken: usize,
    before: usize,
}

impl<'a> Lines<'a> {
    fn peek(&self) -> &'a str {
        self.lines.get(self.taken).copied().unwrap_or_default()
    }

    fn take(&mut self) -> &'a str {
        let line = self.peek();
        self.taken += 1;
        line
    }

    /// The number of the line that was taken last, from one.
    fn number(&self) -> usize {
        self.before + self.taken
    }

    fn expect(&mut self, expected: &str) -> Result<(), TextError> {
        let line = self.take();
        expect(line, expected, self.number())
    }

    fn error(&self, fault: impl Into<TextFault>) -> TextError {
        TextError::new(self.number(), fault)
    }
}

/// Checks it: the sines are those of one state, every lane's values are passed,
/// and every number of the result is taken from where it stands.
pub(super) fn check(
    text: &Text<'_>,
    single: &Lowered,
    arguments: &[String],
    outputs: usize,
) -> Result<(), TextError> {
    let name = text.function.name();
    let (first, head, lines) = text.function(&format!("{name}_lanes"))?;
    let mut lines = Lines {
        lines,
        taken: 0,
        before: first + 1,
    };
    let names: Vec<&str> = parameters(head).collect();
    expect(&names.join(", "), &arguments.join(", "), first + 1)?;

    let sines = sines(&mut lines, text)?;
    if sines.trig != single.trig || sines.library != single.library {
        return Err(lines.error(EntryFault::OtherSines));
    }
    let line = lines.take();
    if !(line.starts_with("let mut results = ") && line.ends_with(';')) {
        return Err(lines.error(EntryFault::NoResults(line.to_owned())));
    }
    lines.expect("for l in 0..L {")?;
    let columns = arguments.iter().map(|argument| {
        let known = Argument::from_name(argument);
        known.map_or_else(String::new, |known| in_lane(known, text.sizes))
    });
    let call = Call {
        name,
        arguments: columns.collect(),
        trigs: &single.trig,
        angles: text.angles,
        lane: "[l]",
    };
    lines.expect(&format!("let result = {};", call.write()))?;
    let mut places = BTreeSet::new();
    while lines.peek() != "}" {
        let line = lines.take();
        let place = line.strip_prefix("results").and_then(|line| {
            let (place, value) = line.strip_suffix(';')?.split_once("[l] = ")?;
            (value.strip_prefix("result") == Some(place)).then_some(place)
        });
        match place {
            Some(place) if places.insert(place) => {}
            Some(_) => return Err(lines.error(EntryFault::Twice)),
            None => return Err(lines.error(EntryFault::NoLane(line.to_owned()))),
        }
    }
    if places.len() != outputs {
        return Err(lines.error(EntryFault::Count(outputs)));
    }
    lines.expect("}")?;
    lines.expect("results")?;
    lines.expect("}")
}

/// What is computed before the arithmetic.
fn sines(lines: &mut Lines<'_>, text: &Text<'_>) -> Result<Lowered, TextError> {
    let mut reader = Reader::new(text.scalar);
    let mut arrays = Vec::new();
    while let Some(array) = lines.peek().strip_prefix("let mut ")
        && let Some(name) = array.strip_suffix(" = [0.0; L];")
        && name != "results"
    {
        arrays.push(name.to_owned());
        lines.take();
    }
    if !arrays.is_empty() {
        lines.expect("for l in 0..L {")?;
        let filled = in_lanes(lines, &mut reader)?;
        if filled != arrays {
            return Err(lines.error(EntryFault::OtherArrays));
        }
    }
    if lines.peek().starts_with("let ([") {
        let call = lines.take().replacen("_lanes(&[", "(&[", 1);
        let statement = call.strip_prefix("let ").unwrap_or_default();
        let read = reader.statement(statement);
        read.map_err(|fault| lines.error(fault))?;
    }
    reader.finish(&[]).map_err(|fault| lines.error(fault))
}

/// A loop over lanes, as what it says of one; the arrays that it fills.
fn in_lanes(lines: &mut Lines<'_>, reader: &mut Reader<'_>) -> Result<Vec<String>, TextError> {
    let mut filled = Vec::new();
    while lines.peek() != "}" {
        let line = lines.take();
        let mut statement = line.replace("[l]", "");
        if let Some((names, _)) = line.split_once(" = ")
            && !line.starts_with("let ")
        {
            let names = names.trim_start_matches('(').trim_end_matches(')');
            for name in names.split(", ") {
                let array = name.strip_suffix("[l]");
                let array = array.ok_or_else(|| lines.error(Kind::Lane.not(name)))?;
                filled.push(array.to_owned());
            }
            statement = format!("let {statement}");
        }
        let block = reader.block(&statement);
        if block.map_err(|fault| lines.error(fault))? {
            continue;
        }
        let Some(statement) = statement.strip_prefix("let ") else {
            return Err(lines.error(Kind::Sine.not(line)));
        };
        let read = reader.statement(statement);
        read.map_err(|fault| lines.error(fault))?;
    }
    lines.expect("}")?;
    Ok(filled)
}
