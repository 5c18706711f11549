//! Blocks: what wraps the statements of a long function.
//!
//! A block hands values on under the names that these have inside; so the statements in the order
//! of the text are the program, and only the names of the wrapping are to be checked.

/// The block that is open at a line.
#[derive(Default)]
pub(super) struct Wrap {
    /// The names that it hands on.
    names: Option<String>,
    /// `true` once it has.
    is_ending: bool,
}

impl Wrap {
    /// Returns whether the statements may end here.
    pub(super) fn is_closed(&self) -> bool {
        self.names.is_none()
    }

    /// Takes a line, if it belongs to the wrapping.
    pub(super) fn line(&mut self, line: &str) -> Result<bool, String> {
        let names = line.strip_prefix("let ");
        if let Some(names) = names.and_then(|names| names.strip_suffix(" = {")) {
            if self.names.is_some() {
                return Err("a block in a block".into());
            }
            self.names = Some(names.to_owned());
            return Ok(true);
        }
        let Some(names) = &self.names else {
            return Ok(false);
        };
        let next = if self.is_ending { "};" } else { names };
        if line == next {
            if self.is_ending {
                self.names = None;
            }
            self.is_ending = !self.is_ending;
            return Ok(true);
        }
        match self.is_ending || !line.starts_with("let ") {
            true => Err(format!("`{next}` expected, not `{line}`")),
            false => Ok(false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLOCK: [&str; 5] = [
        "let (t1, t2,) = {",
        "let t1 = s1 * c1;",
        "let t2 = t1 * c1;",
        "(t1, t2,)",
        "};",
    ];

    fn read(lines: &[&str]) -> Result<Vec<bool>, String> {
        let mut wrap = Wrap::default();
        let seen = lines.iter().map(|line| wrap.line(line)).collect();
        assert!(wrap.is_closed() || lines != BLOCK);
        seen
    }

    #[test]
    fn a_block_is_seen_through() {
        assert_eq!(read(&BLOCK).unwrap(), [true, false, false, true, true]);
    }

    #[test]
    fn names_that_trade_places_are_noticed() {
        for (line, text) in [
            (3, "(t2, t1,)"),
            (3, "};"),
            (4, "let t3 = t1 * t1;"),
            (1, BLOCK[0]),
        ] {
            let mut block = BLOCK;
            block[line] = text;
            assert!(read(&block).is_err(), "{text}");
        }
    }
}
