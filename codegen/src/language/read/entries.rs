//! Reads functions that can be called in several ways: the arithmetic stands in one of them,
//! the sines in another; from both follows what all lines must be.

use super::{Reader, TextError, at, expect, head, result, statements};
use crate::language::dialect::Dialect;
use crate::language::entries::{Around, write};
use crate::language::{Entries, Printed};
use crate::program::{Lowered, LoweredTrig};

impl Lowered {
    /// Reads a function out of the text of a module in which it can be called in several
    /// ways. Nothing is taken from the code of `printed`, which says what the function is.
    ///
    /// # Errors
    /// The first line that is not of such a function, or does not bring a value where it
    /// belongs.
    pub fn parse_entries(
        module: &str,
        printed: &Printed<'_>,
        entries: Entries,
        around: &Around<'_>,
    ) -> Result<Lowered, TextError> {
        let (function, scalar) = (printed.function, printed.code.scalar);
        if entries == Entries::Single {
            return Lowered::parse(module, function, scalar);
        }
        let (lines, name) = (module.lines().map(str::trim), function.name());
        let lines: Vec<&str> = lines.collect();
        let dialect = Dialect::rust(scalar);

        let first = head(&lines, "angles")?;
        same(&lines, first, &around.angles.lines(scalar).join("\n"))?;

        let first = head(&lines, &format!("{name}_with_sincos"))?;
        let mut reader = Reader::given(dialect, around.angles);
        let (tail, end) = statements(&mut reader, &lines, first)?;
        let items = result::items(&tail, function);
        let given = items.and_then(|items| reader.finish(&items));
        let given = given.map_err(at(end))?;

        let first = head(&lines, name)?;
        let mut reader = Reader::new(dialect);
        let (_, end) = statements(&mut reader, &lines, first)?;
        let single = reader.finish(&[]).map_err(at(end))?;
        if sorted(&given.trig) != sorted(&single.trig) {
            let reason = format!("`{name}` does not compute the sines that it reads");
            return Err(at(first)(reason));
        }
        let read = Lowered {
            speeds: given.speeds,
            steps: given.steps,
            outputs: given.outputs,
            ..single
        };
        let code = Printed {
            code: &read,
            ..*printed
        };
        let text = write(&code, around, entries, &[]);
        let start = text.find("pub fn").unwrap_or_default();
        same(&lines, first, &text[start..])?;
        Ok(read)
    }
}

/// Compares the lines from `first` with what they must be; documentation is for people.
pub(super) fn same(lines: &[&str], first: usize, expected: &str) -> Result<(), TextError> {
    let is_code = |line: &&str| !line.is_empty() && !line.starts_with("///");
    let expected = expected.lines().map(str::trim).filter(is_code);
    let mut found = lines.iter().enumerate().skip(first);
    for expected in expected {
        let next = found.by_ref().find(|(_, line)| is_code(line));
        let (number, line) = next.unwrap_or((lines.len(), &""));
        expect(line, expected).map_err(at(number))?;
    }
    Ok(())
}

/// Returns the angles with what is taken of them.
fn sorted(trigs: &[LoweredTrig]) -> Vec<(String, bool, bool)> {
    let taken = trigs.iter();
    let mut taken: Vec<_> = taken
        .map(|trig| (trig.angle.to_string(), trig.sin, trig.cos))
        .collect();
    taken.sort();
    taken
}
