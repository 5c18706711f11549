//! Documents with variables, formulas and legend, a file a format.

mod latex;
mod sympy;
mod text;

use dalembert_codegen::words;
use dalembert_model::number::parse::write_decimal;
use dalembert_model::robot::JointKind;

use crate::arm::{Offset, Variable};
use crate::expression::{Factor, Sum, Term};
use crate::formulas::Formulas;
use crate::legend::SymbolEntry;
use crate::line::Section;
use crate::write::{Digits, Format, Latex, Text};

pub use text::escaped;

words! {
    /// The format of a document.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Layout: "format of formulas" {
        /// Plain text with letters of Unicode.
        #[default]
        Text = "text",
        /// Markdown: tables of plain text, which read everywhere.
        Markdown = "markdown",
        /// A LaTeX document.
        Latex = "latex",
        /// A Python module for SymPy.
        Sympy = "sympy",
    }
}

const BASE_PARAMETERS: &str = "Base parameters: the combinations of masses and inertias that the torques depend on. \
                               Those of link i are taken in a frame on the axis of joint i: of a joint that turns, z is \
                               the axis and x that of the link; of a slide, the axes are those of the last link before \
                               it that turns, or of the base. Parts that the torques cannot tell from the link before count there \
                               (mass, MZ, YY), so that XX stands for Ixx − Iyy";
const CONSTANTS: &str = "Constants";
const SMALL: &str = "in parentheses at the end of a line: terms below 1/1000 of its largest";

impl Formulas {
    /// Writes a document.
    pub fn write(&self, layout: Layout, digits: Digits) -> String {
        let joins = self.joints < 10;
        match layout {
            Layout::Text => self.text(&Text { digits, joins }),
            Layout::Markdown => {
                let title = escaped(&self.robot);
                format!("# {title}\n\n{}", self.in_markdown(2, digits))
            }
            Layout::Latex => self.latex(&Latex { digits, joins }),
            Layout::Sympy => self.sympy(),
        }
    }

    /// Lists the entries by their identifiers, those that are zero too, as plain text.
    pub fn entries(&self, digits: Digits) -> Vec<(String, String)> {
        let joins = self.joints < 10;
        let format = Text { digits, joins };
        let mut entries = Vec::new();
        for section in &self.sections {
            for line in &section.lines {
                entries.push((line.name.code.clone(), format.sum(&line.sum)));
                for (is_negative, other) in &line.others {
                    let sign = if *is_negative { Text::MINUS } else { "" };
                    entries.push((other.code.clone(), format!("{sign}{}", line.name.text)));
                }
            }
            let zeros = section.zeros.iter();
            entries.extend(zeros.map(|zero| (zero.code.clone(), "0".to_owned())));
        }
        entries
    }

    /// Lists the symbols by their identifiers, each with the sum that it stands for, if it stands for one,
    /// and its value.
    pub fn symbols(&self) -> Vec<(String, Option<String>, f64)> {
        let legend = &self.legend;
        let of_file = legend.groups.iter().flat_map(|group| &group.entries);
        let defined = legend.constants.iter().chain(&legend.parameters);
        let symbols = defined.chain(of_file).map(|entry| {
            let sum = (!entry.sum.is_empty()).then(|| written(&entry.sum));
            (entry.symbol.code.clone(), sum, entry.value.to_f64())
        });
        symbols.collect()
    }

    /// Lists the variables that are not q_i, each with its definition: `θ3` is `q3 + pi/2`.
    pub fn shifted_variables(&self) -> Vec<(String, String)> {
        let offsets = self.offsets(|angle| angle).into_iter();
        offsets
            .map(|(letter, joint, shift)| (format!("{letter}{joint}"), format!("q{joint}{shift}")))
            .collect()
    }

    /// Lists the variables that are not q_i: the letter, the joint, and the sum's other part: `θ`,
    /// 3 and ` + pi/2`.
    fn offsets(&self, angle: impl Fn(String) -> String) -> Vec<(&'static str, usize, String)> {
        let offset = |variable: &Variable| {
            let (letter, shift) = match &variable.offset {
                Offset::None => return None,
                Offset::Angle(turn) => ("θ", angle(turn.to_string())),
                Offset::Length(x) => ("d", write_decimal(x).unwrap_or_else(|| x.to_string())),
            };
            Some((letter, variable.joint + 1, signed(&shift)))
        };
        self.variables.iter().filter_map(offset).collect()
    }

    /// The name of an angle: θ where one is not q.
    fn angle(&self) -> &'static str {
        let is_moved = |variable: &Variable| matches!(variable.offset, Offset::Angle(_));
        match self.variables.iter().any(is_moved) {
            true => "θ",
            false => "q",
        }
    }

    /// Lists what a reader has to know about this robot, in words.
    fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if !self.results.iter().copied().eq(0..self.results.len()) {
            let results = self.results.iter().zip(1..);
            let counted = results.map(|(joint, place)| format!("{place} is joint {}", joint + 1));
            remarks.push(format!(
                "the indices of coefficients count the scene's results: {}",
                counted.collect::<Vec<_>>().join(", ")
            ));
        }
        if self.rows > self.joints {
            remarks.push(
                "q has the number of its joint; lengths, masses and inertias have that of their row, and joints that \
                 follow others have rows too"
                    .to_owned(),
            );
        }
        if self.legend.has_numeric_centres {
            remarks.push(
                "centres of mass are numbers: there are too many of them for symbols".to_owned(),
            );
        }
        remarks
    }

    fn has_term(&self, is_such: impl Fn(&Term) -> bool) -> bool {
        let lines = self.sections.iter().flat_map(|section| &section.lines);
        lines.flat_map(|line| &line.sum).any(is_such)
    }

    /// The numbers of the first two joints that turn; of one joint twice the same.
    fn turning(&self) -> Option<[usize; 2]> {
        let turns = |variable: &&Variable| variable.kind == JointKind::Revolute;
        let turning = self.variables.iter().filter(turns);
        let mut numbers = turning.map(|variable| variable.joint + 1);
        let first = numbers.next()?;
        Some([first, numbers.next().unwrap_or(first)])
    }

    /// True if D, h or c are among the formulas.
    fn has_coefficients(&self) -> bool {
        let mut lists = self.sections.iter().flat_map(|section| &section.list);
        lists.any(|list| ["D", "h", "c"].contains(&list.name.as_str()))
    }
}

/// Writes a sum as plain text, six digits a number.
pub fn written(sum: &Sum) -> String {
    let (digits, joins) = (Digits::Six, true);
    Text { digits, joins }.sum(sum)
}

/// True for the sine or the cosine of a multiple of an angle.
fn has_multiple(term: &Term) -> bool {
    term.factors.iter().any(|factor| match factor {
        Factor::Wave(trig, _) => trig.angle.iter().any(|(multiple, _)| multiple.abs() > 1),
        Factor::Sum(sum) => sum.iter().any(has_multiple),
        _ => false,
    })
}

fn zeros(section: &Section, format: &impl Format) -> Option<String> {
    let names = section.zeros.iter().map(|symbol| format.symbol(symbol));
    let text = names.collect::<Vec<_>>().join(", ");
    (!text.is_empty()).then_some(text)
}

fn value<F: Format>(entry: &SymbolEntry, format: &F) -> String {
    let size = format.number(&entry.value.abs());
    match entry.value.is_negative() {
        true => format!("{}{size}", F::MINUS),
        false => size,
    }
}

/// Writes symbols with their sums and values, each between marks.
fn defined(entries: &[SymbolEntry], format: &impl Format, mark: &str, gap: &str) -> String {
    let definitions = entries.iter().map(|entry| {
        let (symbol, value) = (format.symbol(&entry.symbol), value(entry, format));
        match entry.sum.is_empty() {
            true => format!("{mark}{symbol} = {value}{mark}"),
            false => format!(
                "{mark}{symbol} = {} = {value}{mark}",
                format.sum(&entry.sum)
            ),
        }
    });
    definitions.collect::<Vec<_>>().join(gap)
}

/// Writes ` + ` or ` - ` before a number's size.
fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(size) => format!(" - {size}"),
        None => format!(" + {text}"),
    }
}
