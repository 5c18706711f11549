//! The keywords of both formats, as tables: each is read, left out with a message, or irrelevant
//! for the dynamics. Any other name is unknown, and reported.
//!
//! A row is for elements by `parent/tag`, where frames and the world count as bodies; `*` stands for
//! all names in an element, and `<name>` for an element that has a value as an attribute has.
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
        let words = |cell: &'static str| Vec::from_iter(cell.split_ascii_whitespace());
        let rows = text.lines().skip(1).map(|line| {
            let mut cells = line.split('\t').map(words);
            let mut cell = || cells.next().unwrap_or_default();
            let (elements, names) = (cell(), [cell(), cell(), cell()]);
            Row { elements, names }
        });
        let rows = rows.collect();
        Table { rows }
    }

    pub(crate) fn row(&self, parent: &str, tag: &str) -> Option<&Row> {
        let parent = match parent {
            "frame" | "worldbody" => "body",
            parent => parent,
        };
        let placed = format!("{parent}/{tag}");
        let mut rows = self.rows.iter();
        rows.find(|row| row.elements.contains(&&*placed))
    }

    /// Returns the row of an element whose parent is not known.
    pub(crate) fn row_of(&self, tag: &str) -> Option<&Row> {
        let is_of = |element: &str| element.rsplit('/').next() == Some(tag);
        let mut rows = self.rows.iter();
        rows.find(|row| row.elements.iter().any(|element| is_of(element)))
    }
}

impl Row {
    pub(crate) fn verdict(&self, name: &str) -> Verdict {
        let verdict = self.listed(name).or_else(|| self.listed("*"));
        verdict.unwrap_or(Verdict::Unknown)
    }

    /// Returns the verdict on a name that the row has by itself.
    pub(crate) fn listed(&self, name: &str) -> Option<Verdict> {
        const VERDICTS: [Verdict; 3] = [Verdict::Read, Verdict::LeftOut, Verdict::Irrelevant];
        let column = self.names.iter().position(|names| names.contains(&name));
        column.map(|index| VERDICTS[index])
    }

    /// True if no name of the element has an effect.
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
    use crate::{Options, open_text, read_model};

    /// Reads all models in a folder of test data.
    fn read_all(folder: &Path) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let ending = path.extension().unwrap_or_default();
            if path.is_dir() {
                read_all(&path);
            } else if ending == "xml" || ending == "urdf" {
                let text = open_text(&path).unwrap();
                read_model(&text, &Options::default(), &mut Problems::of(&text));
            }
        }
    }

    fn tag(element: &str) -> &str {
        element.rsplit('/').next().unwrap()
    }

    /// The readers look for all attributes that are read, and for no others.
    #[test]
    fn what_is_read_is_looked_for() {
        read_all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data"));
        let asked = ASKED.take();
        let rows = || URDF.rows.iter().chain(&MJCF.rows);
        let mut missing = Vec::new();
        for row in rows() {
            for name in row.names[0].iter().filter(|name| !name.starts_with('<')) {
                let mut tags = row.elements.iter().map(|element| tag(element).to_owned());
                if !tags.any(|tag| asked.contains(&[tag, (*name).to_owned()])) {
                    missing.push(format!("{} {name}", row.elements[0]));
                }
            }
        }
        assert!(missing.is_empty(), "nobody reads {missing:?}");
        let mut unlisted = Vec::new();
        for [element, name] in &asked {
            let mut of =
                rows().filter(|row| row.elements.iter().any(|known| tag(known) == element));
            if !of.any(|row| matches!(row.verdict(name), Verdict::Read | Verdict::Irrelevant)) {
                unlisted.push(format!("{element} {name}"));
            }
        }
        assert!(unlisted.is_empty(), "the tables lack {unlisted:?}");
    }

    /// An element or an attribute that is left out gets a message that names it.
    #[test]
    fn what_is_left_out_is_said() {
        for table in [&*URDF, &*MJCF] {
            for row in &table.rows {
                for name in &row.names[1] {
                    let (parent, tag) = row.elements[0].split_once('/').unwrap();
                    let inside = name.strip_prefix('<');
                    let inside = match inside.and_then(|name| name.strip_suffix('>')) {
                        Some(name) => format!("<{tag}><{name}>7.25</{name}></{tag}>"),
                        None if *name == "*" => format!("<{tag}/>"),
                        None => format!("<{tag} {name}='7.25'/>"),
                    };
                    // The parent's row is found by any of the elements above it.
                    let above = table.row_of(parent).map_or("", |row| row.elements[0]);
                    let above = above.split_once('/').map_or("", |(above, _)| above);
                    let text = match parent {
                        "" => inside,
                        _ => format!("<{parent}>{inside}</{parent}>"),
                    };
                    let text = Text::of("", text);
                    let mut problems = Problems::of(&text);
                    let root = text.elements(&mut problems).unwrap();
                    Reader::new(&mut problems, table).check(above, &root, "it");
                    let said = problems.finish().unwrap_or_else(|errors| errors.0);
                    let word = match *name {
                        "*" => tag,
                        name => name.trim_matches(['<', '>']),
                    };
                    let names = said.iter().any(|said| said.message.contains(word));
                    assert!(names, "{tag} {name}: {said:?}");
                }
            }
        }
    }
}
