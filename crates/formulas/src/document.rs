//! Documents with variables, formulas and legend, a file a format.

mod latex;
mod sympy;
mod text;

use dalembert_codegen::workspace::Word;
use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::JointKind;

use crate::arm::{Offset, Variable};
use crate::expression::{Factor, Sum, Term};
use crate::formulas::Formulas;
use crate::legend::SymbolEntry;
use crate::line::Section;
use crate::write::{Digits, Format, Latex, Text};

pub use text::escaped;

/// The format of a document.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Plain text with letters of Unicode.
    #[default]
    Text,
    /// Markdown: tables of plain text, which read everywhere.
    Markdown,
    /// A LaTeX document.
    Latex,
    /// A Python module for SymPy.
    Sympy,
}

impl Word for Layout {
    const WHAT: &'static str = "format of formulas";

    fn all() -> Vec<(&'static str, Layout)> {
        vec![
            ("text", Layout::Text),
            ("markdown", Layout::Markdown),
            ("latex", Layout::Latex),
            ("sympy", Layout::Sympy),
        ]
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
            Layout::Markdown => self.markdown(&Text { digits, joins }),
            Layout::Latex => self.latex(&Latex { digits, joins }),
            Layout::Sympy => self.sympy(),
        }
    }

    /// Lists the entries by their identifiers, those that are zero too, as plain text.
    pub fn entries(&self, digits: Digits) -> Vec<(String, String)> {
        let format = Text {
            digits,
            joins: self.joints < 10,
        };
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
        let entries = legend
            .constants
            .iter()
            .chain(&legend.parameters)
            .chain(of_file);
        entries
            .map(|entry| {
                let sum = (!entry.sum.is_empty()).then(|| written(&entry.sum));
                (entry.symbol.code.clone(), sum, entry.value.to_f64())
            })
            .collect()
    }

    /// Lists the variables that are not q_i, each with its definition: `θ3` is `q3 + pi/2`.
    pub fn shifted_variables(&self) -> Vec<(String, String)> {
        let lines = self.offsets("θ", |turn| signed(&turn.to_string()));
        let pairs = lines.iter().filter_map(|line| line.split_once(" = "));
        pairs
            .map(|(name, sum)| (name.to_owned(), sum.to_owned()))
            .collect()
    }

    /// Lists them as lines: `θ3 = q3 + pi/2`.
    fn offsets(&self, turn: &str, angle: impl Fn(&Angle) -> String) -> Vec<String> {
        let line = |variable: &Variable| {
            let number = variable.joint + 1;
            match &variable.offset {
                Offset::None => None,
                Offset::Angle(turn_by) => {
                    Some(format!("{turn}{number} = q{number}{}", angle(turn_by)))
                }
                Offset::Length(shift) => Some(format!("d{number} = q{number}{}", plus(shift))),
            }
        };
        self.variables.iter().filter_map(line).collect()
    }

    /// The name of an angle: θ where one is not q.
    fn angle(&self) -> &'static str {
        let is_moved = |variable: &Variable| matches!(variable.offset, Offset::Angle(_));
        if self.variables.iter().any(is_moved) {
            "θ"
        } else {
            "q"
        }
    }

    /// Lists what a reader has to know about this robot, in words.
    fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if !self.results.iter().copied().eq(0..self.results.len()) {
            let counted: Vec<String> = self
                .results
                .iter()
                .enumerate()
                .map(|(place, joint)| format!("{} is joint {}", place + 1, joint + 1))
                .collect();
            remarks.push(format!(
                "the indices of coefficients count the scene's results: {}",
                counted.join(", ")
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

    /// True if a line has terms that are set off.
    fn has_small_terms(&self) -> bool {
        let lines = self.sections.iter().flat_map(|section| &section.lines);
        lines.flat_map(|line| &line.sum).any(|term| term.is_small)
    }

    /// True if a line has the sine or the cosine of a multiple of an angle.
    fn has_multiples(&self) -> bool {
        let lines = self.sections.iter().flat_map(|section| &section.lines);
        lines.flat_map(|line| &line.sum).any(has_multiple)
    }

    /// The numbers of the first two joints that turn; of one joint twice the same.
    fn turning(&self) -> Option<[usize; 2]> {
        let turning = self
            .variables
            .iter()
            .filter(|variable| variable.kind == JointKind::Revolute);
        let mut numbers = turning.map(|variable| variable.joint + 1);
        let first = numbers.next()?;
        Some([first, numbers.next().unwrap_or(first)])
    }

    /// True if D, h or c are among the formulas.
    fn has_coefficients(&self) -> bool {
        let first = |section: &Section| section.list.as_ref().map(|list| list.name.clone());
        let names: Vec<String> = self.sections.iter().filter_map(first).collect();
        ["D", "h", "c"]
            .iter()
            .any(|name| names.iter().any(|other| other == name))
    }
}

/// Writes a sum as plain text, six digits a number.
pub fn written(sum: &Sum) -> String {
    let format = Text {
        digits: Digits::Six,
        joins: true,
    };
    format.sum(sum)
}

fn has_multiple(term: &Term) -> bool {
    term.factors.iter().any(|factor| match factor {
        Factor::Wave(trig, _) => trig.angle.iter().any(|(multiple, _)| multiple.abs() > 1),
        Factor::Sum(sum) => sum.iter().any(has_multiple),
        _ => false,
    })
}

fn zeros(section: &Section, format: &impl Format) -> Option<String> {
    let names: Vec<String> = section
        .zeros
        .iter()
        .map(|symbol| format.symbol(symbol))
        .collect();
    (!names.is_empty()).then(|| names.join(", "))
}

fn value<F: Format>(entry: &SymbolEntry, format: &F) -> String {
    let sign = if entry.value.is_negative() {
        F::MINUS
    } else {
        ""
    };
    format!("{sign}{}", format.number(&entry.value.abs()))
}

/// Writes ` + ` or ` - ` before a number's size.
fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(size) => format!(" - {size}"),
        None => format!(" + {text}"),
    }
}

fn plus(length: &Rational) -> String {
    signed(&write_decimal(length).unwrap_or_else(|| length.to_string()))
}
