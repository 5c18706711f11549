//! Blocks and parts: how a long function's statements are wrapped.
//!
//! Both hand values on under the names that these have inside, and a part
//! takes them in the same way; so the statements in the order of the text are
//! the program, and only the names of the wrapping are to be checked.

use super::error::{Kind, TextFault, WordFault};
use crate::function::Argument;

/// What is open at a line.
#[derive(Default)]
pub(super) enum Wrap {
    /// Nothing.
    #[default]
    None,
    /// A block, with the names that it hands on.
    Block(String),
    /// A block that has handed them on.
    BlockDone,
    /// A part before its head, with the names that it hands on.
    Part(String),
    /// Inside a part: the names, and the call that must follow.
    PartBody(String, String),
    /// A part that has handed them on.
    PartDone(String),
    /// A part's end.
    PartEnd(String),
    /// A part that has been called.
    Called,
}

impl Wrap {
    /// Whether the statements may end here.
    pub(super) fn is_none(&self) -> bool {
        matches!(self, Wrap::None)
    }

    /// Takes a line; whether it belongs to the wrapping.
    pub(super) fn line(&mut self, line: &str) -> Result<bool, TextFault> {
        let begins = line
            .strip_prefix("let ")
            .and_then(|l| l.strip_suffix(" = {"));
        let next = match (std::mem::take(self), begins) {
            (Wrap::None, Some(names)) if names.starts_with('[') => Wrap::Part(names.into()),
            (Wrap::None, Some(names)) => Wrap::Block(names.into()),
            (_, Some(_)) => return Err(TextFault::Nested),
            (Wrap::Block(names), None) if line.starts_with('(') => {
                handed_on(line, &names)?;
                Wrap::BlockDone
            }
            (Wrap::Part(names), None) => match line {
                "#[inline(never)]" => Wrap::Part(names),
                head => Wrap::PartBody(names, call(head)?),
            },
            (Wrap::PartBody(names, call), None) if line.starts_with('[') => {
                handed_on(line, &names)?;
                Wrap::PartDone(call)
            }
            (Wrap::PartDone(call), None) if line == "}" => Wrap::PartEnd(call),
            (Wrap::PartEnd(call), None) if line == call => Wrap::Called,
            (Wrap::PartEnd(expected), None) => {
                let found = line.to_owned();
                return Err(WordFault::Instead { expected, found }.into());
            }
            (Wrap::BlockDone | Wrap::Called, None) if line == "};" => Wrap::None,
            (Wrap::BlockDone | Wrap::PartDone(_) | Wrap::Called, None) => {
                return Err(TextFault::Overlong);
            }
            (open, None) => {
                *self = open;
                return Ok(false);
            }
        };
        *self = next;
        Ok(true)
    }
}

fn handed_on(line: &str, names: &str) -> Result<(), TextFault> {
    if line == names {
        Ok(())
    } else {
        Err(TextFault::HandedOn {
            inside: line.to_owned(),
            outside: names.to_owned(),
        })
    }
}

/// The call that passes every parameter of this head under its own name.
fn call(head: &str) -> Result<String, WordFault> {
    let no_head = || Kind::PartHead.not(head);
    let parameters = head.strip_prefix("fn part(").ok_or_else(no_head)?;
    let (parameters, _) = parameters.split_once(") -> ").ok_or_else(no_head)?;
    let (arrays, values) = parameters.split_once('[').ok_or_else(no_head)?;
    // An array's type has a bracket too.
    let (arrays, values) = match arrays.is_empty() {
        true => ("", values),
        false => match parameters.rsplit_once(", [") {
            Some((arrays, values)) => (arrays, values),
            None => return Err(no_head()),
        },
    };
    let (values, _) = values.split_once("]: ").ok_or_else(no_head)?;
    let mut arguments = String::new();
    for array in arrays.split(", ").filter(|array| !array.is_empty()) {
        let (name, _) = array.split_once(": ").ok_or_else(no_head)?;
        if Argument::from_name(name).is_none() {
            return Err(no_head());
        }
        arguments += &format!("{name}, ");
    }
    Ok(format!("part({arguments}[{values}])"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(lines: &[&str]) -> Result<Vec<bool>, TextFault> {
        let mut wrap = Wrap::default();
        lines.iter().map(|line| wrap.line(line)).collect()
    }

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
