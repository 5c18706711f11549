//! A report: every datum once, as text for people and as JSON for programs.

use std::fmt::{self, Display};
use std::iter;

use dalembert_codegen::Counts;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

#[derive(Default)]
pub struct Report(Vec<Part>);

enum Part {
    Text(String),
    Value(String, Value),
    Table(String, Table),
}

impl Report {
    /// Returns a report about a robot in its scene.
    pub fn of(robot: &Robot, scene: Option<&Scene>) -> Report {
        let mut report = Report::default();
        let joints = counted(robot.joints.len(), "joint");
        let scene = scene.map(|scene| scene.name.as_str());
        let (name, input, within) = (&robot.name, robot.short_hash(), in_scene(scene));
        report.line(format!("robot {name}, {joints}, input {input}{within}"));
        report.value("robot", name.as_str());
        report.value("input", input);
        report.value("joints", robot.joints.len());
        report.value("scene", scene);
        report
    }

    /// Adds a line for people, or several.
    pub fn line(&mut self, text: impl Display) {
        self.0.push(Part::Text(format!("{text}\n")));
    }

    /// Adds a value for programs; a slash in the key leads into an object.
    pub fn value(&mut self, key: &str, value: impl Into<Value>) {
        self.0.push(Part::Value(key.to_owned(), value.into()));
    }

    pub fn rows(&mut self, table: Table) {
        self.0.push(Part::Text(table.to_string()));
    }

    /// Adds a table, below an empty line and its title if that is not empty.
    pub fn table(&mut self, key: &str, title: impl Display, table: Table) {
        if !table.rows.is_empty() {
            let title = title.to_string();
            let end = if title.is_empty() { "" } else { "\n" };
            self.0.push(Part::Text(format!("\n{title}{end}")));
        }
        self.0.push(Part::Table(key.to_owned(), table));
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = |part: &Part| match part {
            Part::Text(text) => text.clone(),
            Part::Table(_, table) => table.to_string(),
            Part::Value(..) => String::new(),
        };
        let text: String = self.0.iter().map(text).collect();
        // Nothing is above the first table.
        f.write_str(text.trim_start_matches('\n'))
    }
}

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut root = Map::new();
        for part in &self.0 {
            let (key, value) = match part {
                Part::Text(_) => continue,
                Part::Value(key, value) => (key, value.clone()),
                Part::Table(key, table) => (key, table.json()),
            };
            let mut keys = key.split('/');
            let last = keys.next_back().unwrap_or_default();
            let mut object = &mut root;
            for key in keys {
                let entry = object.entry(key).or_insert_with(|| Map::new().into());
                match entry {
                    Value::Object(inner) => object = inner,
                    // No key is a value and an object.
                    _ => return to.serialize_none(),
                }
            }
            object.insert(last.to_owned(), value);
        }
        root.serialize(to)
    }
}

/// The columns that a table may take.
pub const WIDTH: usize = 100;

const LEAST: usize = 24;

/// A table. Texts stand to the left, numbers to the right; the last text of a row is broken where it
/// would be too long.
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    /// Programs get an object by the first column's values instead of a list.
    is_keyed: bool,
    width: usize,
}

struct Column {
    key: String,
    title: String,
    is_hidden: bool,
}

/// A cell: a text for people and a value for programs.
#[derive(Clone)]
pub struct Cell(String, Value);

impl Cell {
    /// Returns a cell that people read as this text.
    pub fn of(text: impl Into<String>, value: impl Into<Value>) -> Cell {
        Cell(text.into(), value.into())
    }

    /// Returns a number to so many digits behind the point, in powers of ten.
    pub fn power(value: f64, digits: usize) -> Cell {
        Cell::of(format!("{value:.digits$e}"), value)
    }

    /// Returns a rounding error in u: more than three figures are not worth reading.
    pub fn units(error: f64) -> Cell {
        let text = match error {
            ..100.0 => format!("{error:.1}"),
            ..1e6 => format!("{error:.0}"),
            // No rounding: what a tolerance gave up.
            _ => format!("{error:.0e}"),
        };
        Cell::of(text, error)
    }

    /// Returns a value that only programs read.
    pub fn json(value: impl Into<Value>) -> Cell {
        Cell::of("", value)
    }
}

impl<T: Display + Into<Value>> From<T> for Cell {
    fn from(value: T) -> Cell {
        Cell::of(value.to_string(), value)
    }
}

macro_rules! cells {
    ($($cell:expr),* $(,)?) => { vec![$($crate::report::Cell::from($cell)),*] };
}
pub(crate) use cells;

impl Table {
    /// Returns a table with these heads, between bars. A head is the column's title; behind `=` stands another
    /// one, and a column that begins with a point is for programs alone.
    pub fn new(heads: &str) -> Table {
        let column = |head: &str| {
            let (key, title) = head.split_once('=').unwrap_or((head, head));
            Column {
                key: key.trim_start_matches('.').replace(' ', "_"),
                title: title.to_owned(),
                is_hidden: head.starts_with('.'),
            }
        };
        Table {
            columns: heads.split('|').map(column).collect(),
            rows: Vec::new(),
            is_keyed: false,
            width: WIDTH,
        }
    }

    /// Returns a table whose rows programs find by the first column's values.
    pub fn keyed(heads: &str) -> Table {
        Table {
            is_keyed: true,
            ..Table::new(heads)
        }
    }

    /// Returns a table for paper, where no text is broken.
    pub fn unbroken(self) -> Table {
        Table {
            width: usize::MAX,
            ..self
        }
    }

    pub fn row(&mut self, cells: Vec<Cell>) {
        self.rows.push(cells);
    }

    /// Returns the table with more rows.
    pub fn with(mut self, rows: impl IntoIterator<Item = Vec<Cell>>) -> Table {
        self.rows.extend(rows);
        self
    }

    /// Hides columns from people.
    pub fn without(mut self, titles: &str) -> Table {
        for column in &mut self.columns {
            column.is_hidden |= titles.split('|').any(|title| title == column.title);
        }
        self
    }

    /// Hides columns from people in which every row has zero or nothing.
    pub fn without_zeros(mut self, titles: &str) -> Table {
        for (place, column) in self.columns.iter_mut().enumerate() {
            let mut cells = self.rows.iter().map(|row| row[place].0.as_str());
            column.is_hidden |= titles.split('|').any(|title| title == column.title)
                && cells.all(|cell| cell.is_empty() || cell == "0");
        }
        self
    }

    pub fn json(&self) -> Value {
        let object = |cells: &[Cell], columns: &[Column]| -> Value {
            let pair = |(column, cell): (&Column, &Cell)| (column.key.clone(), cell.1.clone());
            Value::Object(columns.iter().zip(cells).map(pair).collect())
        };
        let rows = self.rows.iter();
        match self.is_keyed {
            false => rows.map(|row| object(row, &self.columns)).collect(),
            true => {
                let row =
                    |row: &Vec<Cell>| (row[0].0.clone(), object(&row[1..], &self.columns[1..]));
                Value::Object(rows.map(row).collect())
            }
        }
    }

    /// Writes it for programs that read tables: all columns, numbers to seven digits.
    pub fn csv(&self) -> String {
        let cell = |cell: &Cell| match &cell.1 {
            Value::Number(number) if cell.0.contains('.') => {
                format!("{:.6e}", number.as_f64().unwrap_or_default())
            }
            Value::Null => String::new(),
            Value::String(text) => text.clone(),
            _ => cell.0.clone(),
        };
        let keys = self.columns.iter();
        let heads = keys.map(|column| column.key.clone()).collect();
        let rows = self.rows.iter().map(|row| row.iter().map(cell).collect());
        let line = |cells: Vec<String>| cells.join(",") + "\n";
        iter::once(heads).chain(rows).map(line).collect()
    }
}

impl Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut lines = vec![String::new(); self.rows.len() + 1];
        for (place, column) in self.columns.iter().enumerate() {
            if column.is_hidden {
                continue;
            }
            let cells = || self.rows.iter().map(|row| &row[place]);
            let title = column.title.as_str();
            let texts = || iter::once(title).chain(cells().map(|cell| cell.0.as_str()));
            let wide = texts().map(width).max().unwrap_or(0);
            let is_left = place == 0 || !cells().any(|cell| cell.1.is_number());
            let before = width(&lines[0]) + 2;
            let room = self.width.saturating_sub(before).max(LEAST);
            let mut others = self.columns[place + 1..].iter();
            let is_last = others.all(|column| column.is_hidden);
            if is_last && is_left && wide > room {
                let next = format!("\n{}", " ".repeat(before));
                for (line, text) in lines.iter_mut().zip(texts()) {
                    *line += &format!("  {}", broken(text, room).join(&next));
                }
                break;
            }
            for (line, text) in lines.iter_mut().zip(texts()) {
                let pad = " ".repeat(wide - width(text));
                *line += &match is_left {
                    true => format!("  {text}{pad}"),
                    false => format!("  {pad}{text}"),
                };
            }
        }
        // A head without titles, or without rows below it, is left out.
        let mut lines = lines.iter().map(|line| line.trim_end());
        let head = lines.next();
        let head = head.filter(|head| !head.is_empty() && !self.rows.is_empty());
        let mut shown = head.into_iter().chain(lines);
        shown.try_for_each(|line| writeln!(f, "{line}"))
    }
}

/// Breaks a text at spaces into lines of at most so many columns; a longer word has a line.
pub fn broken(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.is_empty() => *line += word,
            Some(line) if width(line) + 1 + width(word) <= most => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Returns the places that a text takes: dots above letters take none.
pub fn width(text: &str) -> usize {
    let dots = '\u{300}'..='\u{36f}';
    text.chars().filter(|c| !dots.contains(c)).count()
}

/// The columns of operation counts, of which [`counts`] makes the cells.
pub const COUNTS: &str = "mul|add|fma|div|sqrt|sincos|trig_mul|trig_add";

pub fn counts(counts: &Counts) -> Vec<Cell> {
    let arithmetic = [counts.mul, counts.add, counts.fma, counts.div, counts.sqrt];
    let sines = [counts.sincos, counts.trig_mul, counts.trig_add];
    let numbers = arithmetic.into_iter().chain(sines);
    numbers.map(Cell::from).collect()
}

/// Writes `, scene pick` behind a robot, if there is a scene.
pub fn in_scene(scene: Option<&str>) -> String {
    scene.map_or_else(String::new, |scene| format!(", scene {scene}"))
}

/// Writes a number with its noun: `1 joint`, `6 joints`.
pub fn counted(number: usize, noun: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {noun}{plural}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_fit_a_terminal() {
        let words = vec!["words"; 60].join(" ");
        let table = Table::new("name=|text=|.hidden").with([cells!["τ̈", &*words, 1usize]]);
        let text = table.to_string();
        assert!(text.lines().all(|line| width(line) <= WIDTH), "{text}");
        assert_eq!(text.split_whitespace().count(), 61);
    }
}
