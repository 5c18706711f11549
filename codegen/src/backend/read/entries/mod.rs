//! Reads functions that can be called in several ways: the arithmetic stands in
//! one of them, the others must bring it every value where it belongs.
//!
//! - this file: what all of them together say
//! - `call`: the values that a call passes
//! - `lanes`: several states at once
//! - `batch`: any number of states

mod batch;
mod call;
mod lanes;

use super::error::EntryFault;
use super::{Reader, TextError, head, result, statements};
use crate::backend::Entries;
use crate::backend::entries::angles::Angles;
use crate::function::{Function, Sizes};
use crate::program::{Lowered, LoweredTrig, ScalarType};
use call::{Call, parameters};

/// A function's entries as a module's text has them.
struct Text<'a> {
    lines: Vec<&'a str>,
    function: Function,
    scalar: ScalarType,
    angles: &'a Angles,
    sizes: Sizes,
}

impl Lowered {
    /// Reads the function of this name out of the text of a module in which it
    /// can be called in several ways; `sizes` are those of its results.
    pub fn parse_entries(
        module: &str,
        function: Function,
        scalar: ScalarType,
        entries: Entries,
        angles: &Angles,
        sizes: Sizes,
    ) -> Result<Lowered, TextError> {
        if entries == Entries::Single {
            return Lowered::parse(module, function, scalar);
        }
        let text = Text {
            lines: module.lines().map(str::trim).collect(),
            function,
            scalar,
            angles,
            sizes,
        };
        text.angles()?;
        let given = text.given()?;
        let (single, arguments) = text.single()?;
        text.same_angles(&given, &single)?;
        if entries >= Entries::Lanes {
            lanes::check(&text, &single, &arguments, given.outputs.len())?;
        }
        if entries >= Entries::Batch {
            batch::check(&text, &arguments)?;
        }
        Ok(Lowered {
            speeds: given.speeds,
            steps: given.steps,
            outputs: given.outputs,
            ..single
        })
    }
}

impl<'a> Text<'a> {
    /// The head of a function of this name, its place from zero, and the lines
    /// after it.
    fn function(&self, name: &str) -> Result<(usize, &'a str, &[&'a str]), TextError> {
        let first = head(&self.lines, name)?;
        Ok((first, self.lines[first], &self.lines[first + 1..]))
    }

    /// `angles`: the positions, then the sums, each where its sine is.
    fn angles(&self) -> Result<(), TextError> {
        let (first, _, lines) = self.function("angles")?;
        let mut reader = Reader::new(self.scalar);
        let (tail, end) =
            statements(&mut reader, lines, "angles").map_err(|error| error.after(first + 1))?;
        let sums = reader.take_sums();
        let joints = self.angles.count().saturating_sub(sums.len());
        let mut expected: Vec<String> = (0..joints).map(|joint| format!("q[{joint}]")).collect();
        for sum in sums {
            if self.angles.place(sum) == Some(expected.len()) {
                expected.push(format!("a{sum}"));
            }
        }
        let expected = format!("[{}]", expected.join(", "));
        call::expect(tail.trim(), &expected, first + 1 + end)
    }

    /// `NAME_with_sincos`: the arithmetic.
    fn given(&self) -> Result<Lowered, TextError> {
        let name = format!("{}_with_sincos", self.function);
        let (first, head, lines) = self.function(&name)?;
        let mut reader = Reader::given(self.scalar, self.angles);
        let (tail, end) =
            statements(&mut reader, lines, &name).map_err(|error| error.after(first + 1))?;
        let at = |fault| TextError::new(first + 1 + end, fault);
        // In their order as in the call, or names would trade places.
        let mut expected: Vec<String> = self.names()?;
        expected.extend(["sin", "cos"].map(String::from));
        let found = parameters(head).map(|name| name.trim_start_matches('_'));
        call::expect(
            &found.collect::<Vec<_>>().join(", "),
            &expected.join(", "),
            first + 1,
        )?;
        let items = result::items(&tail, self.function).map_err(at)?;
        reader.finish(&items).map_err(at)
    }

    /// The names of the function's arguments.
    fn names(&self) -> Result<Vec<String>, TextError> {
        let (_, head, _) = self.function(self.function.name())?;
        Ok(parameters(head).map(String::from).collect())
    }

    /// `NAME`: the sines and the call, and the names of its arguments.
    fn single(&self) -> Result<(Lowered, Vec<String>), TextError> {
        let name = self.function.name();
        let (first, _, lines) = self.function(name)?;
        let mut reader = Reader::new(self.scalar);
        let (tail, end) =
            statements(&mut reader, lines, name).map_err(|error| error.after(first + 1))?;
        let line = first + 1 + end;
        let sines = reader.finish(&[]);
        let sines = sines.map_err(|fault| TextError::new(line, fault))?;
        let arguments = self.names()?;
        let call = Call {
            name,
            arguments: arguments.clone(),
            trigs: &sines.trig,
            angles: self.angles,
            lane: "",
        };
        call::expect(tail.trim(), &call.write(), line - 1)?;
        Ok((sines, arguments))
    }

    /// The sines that the arithmetic reads are those that are computed.
    fn same_angles(&self, given: &Lowered, single: &Lowered) -> Result<(), TextError> {
        let sorted = |trigs: &[LoweredTrig]| {
            let taken = trigs.iter().map(|trig| (trig.angle, trig.sin, trig.cos));
            let mut taken: Vec<_> = taken.collect();
            taken.sort();
            taken
        };
        match sorted(&given.trig) == sorted(&single.trig) {
            true => Ok(()),
            false => Err(TextError::new(
                1,
                EntryFault::OtherAngles(self.function.name().to_owned()),
            )),
        }
    }
}
