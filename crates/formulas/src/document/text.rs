//! Plain text and Markdown.

use super::{BASE_PARAMETERS, CONSTANTS, SMALL, defined, has_multiple, value, zeros};
use crate::formulas::Formulas;
use crate::legend::SymbolEntry;
use crate::write::{Digits, Format, Text};

impl Formulas {
    pub(super) fn text(&self, format: &Text) -> String {
        let mut text = format!("{}\n", self.robot);
        for note in self.notes() {
            text += &format!("  {note}\n");
        }
        for section in &self.sections {
            text += &format!("\n{}\n", section.title);
            for line in &section.lines {
                text += &format!("{} = {}\n", format.names(line), format.sum(&line.sum));
            }
            if let Some(zeros) = zeros(section, format) {
                text += &format!("zero: {zeros}\n");
            }
        }
        for (title, entries) in self.sums() {
            text += &format!("\n{title}\n{}\n", defined(entries, format, "", "\n"));
        }
        if !self.legend.groups.is_empty() {
            text += &format!("\n{}\n", &self.legend.title_of_groups());
            for group in &self.legend.groups {
                let entries = defined(&group.entries, format, "", ", ");
                text += &format!("{}: {entries}\n", group.label);
            }
        }
        text
    }

    /// Writes formulas and legend as Markdown, below headings of a level.
    pub fn in_markdown(&self, level: usize, digits: Digits) -> String {
        let joins = self.joints < 10;
        let notes = self.notes().into_iter().map(|note| format!("- {note}\n"));
        notes.collect::<String>() + &self.tables(&Text { digits, joins }, level)
    }

    fn tables(&self, format: &Text, level: usize) -> String {
        let head = "#".repeat(level);
        let mut text = String::new();
        let mut table = |title: &str, columns: [&str; 2], rows: Vec<[String; 2]>| {
            // Words in a heading that look like mathematics stay as they are.
            let title = title.replace('_', "\\_").replace('^', "\\^");
            let (title, below) = match title.split_once(": ") {
                Some((title, below)) if below.len() > 60 => {
                    (title.to_owned(), format!("{}.\n\n", capital(below)))
                }
                _ => (title, String::new()),
            };
            let [left, right] = columns;
            text += &format!("\n{head} {title}\n\n{below}| {left} | {right} |\n|---|---|\n");
            for [left, right] in rows {
                text += &format!("| {left} | {right} |\n");
            }
        };
        for section in &self.sections {
            let lines = section.lines.iter();
            let mut rows: Vec<[String; 2]> = lines
                .map(|line| [escaped(&format.names(line)), format.sum(&line.sum)])
                .collect();
            if let Some(zeros) = zeros(section, format) {
                rows.push([escaped(&zeros), "0".to_owned()]);
            }
            table(&section.title, ["coefficient", "value"], rows);
        }
        for (title, entries) in self.sums() {
            let rows = entries.iter().map(|entry| {
                let right = format!("{} = {}", format.sum(&entry.sum), value(entry, format));
                [escaped(&format.symbol(&entry.symbol)), right]
            });
            table(title, ["symbol", "value"], rows.collect());
        }
        if !self.legend.groups.is_empty() {
            let rows = self.legend.groups.iter().map(|group| {
                let values = defined(&group.entries, format, "", ", ");
                [escaped(&group.label), values]
            });
            let title = self.legend.title_of_groups();
            table(&title, ["joint", "values"], rows.collect());
        }
        text
    }

    /// Lists what a reader has to know before the first line.
    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.has_coefficients() {
            notes.push(
                "τ_i = Σ_k D_ik q̈_k + Σ_k Σ_m h_ikm q̇_k q̇_m + c_i, h_ikm = h_imk: a pair k < m counts twice"
                    .to_owned(),
            );
        }
        if let Some([first, second]) = self.turning() {
            let angle = self.angle();
            let sum = match (first == second, self.joints < 10) {
                (true, _) => format!("C{first} = cos {angle}{first}"),
                (false, true) => {
                    format!("C{first}{second} = cos({angle}{first} + {angle}{second})")
                }
                (false, false) => {
                    format!("C({first}+{second}) = cos({angle}{first} + {angle}{second})")
                }
            };
            let double = match self.has_term(has_multiple) {
                true => format!(", C(2·{second}) = cos(2·{angle}{second})"),
                false => String::new(),
            };
            notes.push(format!(
                "S and C are sine and cosine of sums of angles: {sum}{double}"
            ));
        }
        let offsets = self.offsets(|angle| angle.replace("pi", "π")).into_iter();
        let line = |(letter, joint, shift)| format!("{letter}{joint} = q{joint}{shift}");
        if offsets.len() > 0 {
            notes.push(offsets.map(line).collect::<Vec<_>>().join(", "));
        }
        if self.has_term(|term| term.is_small) {
            notes.push(SMALL.to_owned());
        }
        notes.extend(self.remarks());
        notes
    }

    pub(super) fn sums(&self) -> Vec<(&'static str, &[SymbolEntry])> {
        let legend = &self.legend;
        let groups = [
            (CONSTANTS, legend.constants.as_slice()),
            (BASE_PARAMETERS, legend.parameters.as_slice()),
        ];
        groups
            .into_iter()
            .filter(|(_, entries)| !entries.is_empty())
            .collect()
    }
}

/// Begins a sentence; symbols stay as they are.
pub(super) fn capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next();
    let is_word = letters.clone().next().is_some_and(char::is_alphabetic);
    match first.filter(|_| is_word) {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => words.to_owned(),
    }
}

/// Escapes the letters of a name that Markdown reads as marks.
pub fn escaped(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars() {
        if "\\`*_{}[]<>#|~".contains(letter) {
            text.push('\\');
        }
        text.push(letter);
    }
    text
}
