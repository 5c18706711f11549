//! Blocks and parts: what wraps the statements of a long function.
//!
//! Both hand values on under the names that these have inside, and a part takes them in
//! the same way; so the statements in the order of the text are the program, and only the
//! names of the wrapping are to be checked.

use std::collections::VecDeque;

use crate::function::Argument;
use crate::language::dialect::holes;

/// A block or part that is open at a line.
#[derive(Default)]
pub(super) struct Wrap {
    /// `true` if a part has begun, whose head must follow.
    is_part: bool,
    /// The lines that hand the values on and end the block or the part.
    rest: VecDeque<String>,
    /// `true` once these have begun.
    is_ending: bool,
}

impl Wrap {
    /// Returns whether the statements may end here.
    pub(super) fn is_closed(&self) -> bool {
        self.rest.is_empty()
    }

    /// Takes a line, if it belongs to the wrapping.
    pub(super) fn line(&mut self, line: &str) -> Result<bool, String> {
        let names = line.strip_prefix("let ");
        if let Some(names) = names.and_then(|names| names.strip_suffix(" = {")) {
            if !self.rest.is_empty() {
                return Err("a block in a block".into());
            }
            self.is_part = names.starts_with('[');
            self.rest.extend([names.to_owned(), "};".to_owned()]);
            return Ok(true);
        }
        if self.is_part {
            if line != "#[inline(never)]" {
                self.rest.insert(1, "}".into());
                self.rest.insert(2, call(line)?);
                self.is_part = false;
            }
            return Ok(true);
        }
        match self.rest.front() {
            Some(next) if next == line => {
                self.rest.pop_front();
                self.is_ending = !self.rest.is_empty();
                Ok(true)
            }
            Some(next) if self.is_ending || !line.starts_with("let ") => {
                Err(format!("`{next}` expected, not `{line}`"))
            }
            _ => Ok(false),
        }
    }
}

/// Returns the call that passes every parameter of this head under its own name.
fn call(head: &str) -> Result<String, String> {
    let read = || {
        let [parameters, _] = holes("fn part({}) -> {}", head)?;
        // The names of the values are the last parameter.
        let (before, _) = parameters.rsplit_once("]: ")?;
        let (arrays, values) = before.rsplit_once('[')?;
        let mut call = String::from("part(");
        for array in arrays.split_terminator(", ") {
            let (name, _) = array.split_once(": ")?;
            Argument::from_name(name)?;
            call += &format!("{name}, ");
        }
        Some(format!("{call}[{values}])"))
    };
    read().ok_or_else(|| format!("`{head}` is no head of a part"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PART: [&str; 8] = [
        "let [t1, t2] = {",
        "#[inline(never)]",
        "fn part(q: &[f64; 2], qdd: &[f64; 2], [s1, c1]: [f64; 2]) -> [f64; 2] {",
        "let t1 = s1 * c1;",
        "[t1, t2]",
        "}",
        "part(q, qdd, [s1, c1])",
        "};",
    ];

    fn read(lines: &[&str]) -> Result<Vec<bool>, String> {
        let mut wrap = Wrap::default();
        let seen = lines.iter().map(|line| wrap.line(line)).collect();
        assert!(wrap.is_closed() || lines != PART);
        seen
    }

    #[test]
    fn a_part_is_seen_through() {
        let seen = read(&PART).unwrap();
        assert_eq!(seen, [true, true, true, false, true, true, true, true]);
        let heads = ["fn part([]: [f64; 0]) -> [f64; 1] {", "part([])"];
        assert_eq!(call(heads[0]).unwrap(), heads[1]);
    }

    #[test]
    fn names_that_trade_places_are_noticed() {
        for (line, text) in [
            (4, "[t2, t1]"),
            (6, "part(q, qdd, [c1, s1])"),
            (6, "part(qdd, q, [s1, c1])"),
            (2, "fn part(x: &[f64; 2], [s1, c1]: [f64; 2]) -> [f64; 2] {"),
            (7, "}"),
        ] {
            let mut part = PART;
            part[line] = text;
            assert!(read(&part).is_err(), "{text}");
        }
    }
}
