//! The keywords of both formats, as tables: each is read, left out with a message, or irrelevant
//! for the dynamics. A name in none of the three is unknown, and said.
//!
//! A row is for elements by their tag, or by `parent/tag`; `*` stands for all names in an element.
//! Kinds of actuators share one row, and so do classes and elements, so that they cannot differ.

use std::sync::LazyLock;

pub(crate) static URDF: LazyLock<Table> = LazyLock::new(|| Table::of(include_str!("urdf.tsv")));
pub(crate) static MJCF: LazyLock<Table> = LazyLock::new(|| Table::of(include_str!("mjcf.tsv")));

pub(crate) struct Table {
    pub(crate) rows: Vec<Row>,
}

pub(crate) struct Row {
    pub(crate) elements: Vec<&'static str>,
    /// The names that are read, left out, irrelevant.
    pub(crate) names: [Vec<&'static str>; 3],
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Read,
    LeftOut,
    Irrelevant,
    Unknown,
}

impl Table {
    fn of(text: &'static str) -> Table {
        let rows = text.lines().skip(1).map(|line| {
            let mut cells = line
                .split('\t')
                .map(|cell| cell.split_ascii_whitespace().collect());
            let mut cell = || cells.next().unwrap_or_default();
            let (elements, names) = (cell(), [cell(), cell(), cell()]);
            Row { elements, names }
        });
        let rows = rows.collect();
        Table { rows }
    }

    /// Returns the row of an element: that of `parent/tag`, or else that of its tag.
    pub(crate) fn row(&self, parent: &str, tag: &str) -> Option<&Row> {
        let placed = format!("{parent}/{tag}");
        let find = |name: &str| self.rows.iter().find(|row| row.elements.contains(&name));
        find(&placed).or_else(|| find(tag))
    }
}

impl Row {
    pub(crate) fn verdict(&self, name: &str) -> Verdict {
        let found = self.listed(name).or_else(|| self.listed("*"));
        found.unwrap_or(Verdict::Unknown)
    }

    /// Returns the verdict on a name that the row has by itself.
    pub(crate) fn listed(&self, name: &str) -> Option<Verdict> {
        const VERDICTS: [Verdict; 3] = [Verdict::Read, Verdict::LeftOut, Verdict::Irrelevant];
        let found = self.names.iter().position(|names| names.contains(&name));
        found.map(|index| VERDICTS[index])
    }

    /// True if the element has an effect by none of its names.
    pub(crate) fn is_irrelevant(&self) -> bool {
        self.names == [vec![], vec![], vec!["*"]]
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::problems::Problems;
    use crate::read::Reader;
    use crate::text::Text;
    use crate::xml::tests::ASKED;
    use crate::xml::{Attribute, Element};
    use crate::{Options, open_text, read_model};

    /// Reads all models in a folder of test data.
    fn read_all(folder: &Path) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                read_all(&path);
            } else if path
                .extension()
                .is_some_and(|ending| ending == "xml" || ending == "urdf")
            {
                let text = open_text(&path).unwrap();
                read_model(&text, &Options::default(), &mut Problems::of(&text));
            }
        }
    }

    /// The readers look for all names that are read, and for no others.
    #[test]
    fn what_is_read_is_looked_for() {
        read_all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data"));
        let asked = ASKED.take();
        fn tag(element: &str) -> &str {
            element.rsplit('/').next().unwrap()
        }
        let mut missing = Vec::new();
        let rows = || URDF.rows.iter().chain(&MJCF.rows);
        for row in rows() {
            for name in &row.names[0] {
                let mut tags = row.elements.iter().map(|element| tag(element).to_owned());
                if !tags.any(|tag| asked.contains(&[tag, (*name).to_owned()])) {
                    missing.push(format!("{} {name}", row.elements[0]));
                }
            }
        }
        assert!(missing.is_empty(), "nobody reads {missing:?}");
        let mut unlisted = Vec::new();
        for [element, name] in &asked {
            let mut of = rows().filter(|row| row.elements.iter().any(|own| tag(own) == element));
            if !of.any(|row| matches!(row.verdict(name), Verdict::Read | Verdict::Irrelevant)) {
                unlisted.push(format!("{element} {name}"));
            }
        }
        assert!(unlisted.is_empty(), "the tables lack {unlisted:?}");
    }

    /// An element or an attribute that is left out gets a message that names it.
    #[test]
    fn what_is_left_out_is_said() {
        for (table, root) in [(&*URDF, "robot"), (&*MJCF, "mujoco")] {
            for row in &table.rows {
                for name in &row.names[1] {
                    let path = row.elements[0]
                        .rsplit_once('/')
                        .unwrap_or((root, row.elements[0]));
                    let mut element = Element {
                        tag: path.1.to_owned(),
                        ..Element::default()
                    };
                    element.attributes.push(Attribute {
                        key: (*name).to_owned(),
                        value: "7.25".to_owned(),
                        at: 0..0,
                    });
                    let parent = Element {
                        tag: path.0.to_owned(),
                        inside: vec![element],
                        ..Element::default()
                    };
                    let text = Text::of("", String::new());
                    let mut problems = Problems::of(&text);
                    Reader::new(&mut problems, table).check(
                        if path.0 == root { "" } else { root },
                        &parent,
                        "it",
                    );
                    let said = match problems.finish() {
                        Ok(said) => said,
                        Err(errors) => errors.0,
                    };
                    let word = if *name == "*" { path.1 } else { name };
                    let names = said.iter().any(|said| said.message.contains(word));
                    assert!(names, "{} {name}: {said:?}", path.1);
                }
            }
        }
    }
}
