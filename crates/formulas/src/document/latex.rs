//! A LaTeX document.

use super::{BASE_PARAMETERS, CONSTANTS, SMALL, signed, value, zeros};
use crate::formulas::Formulas;
use crate::legend::Entry;
use crate::write::{Format, Latex};

const HEAD: &str = "\\documentclass{article}\n\\usepackage{amsmath}\n\\usepackage[margin=15mm]{geometry}\n\
                    \\sloppy\\setlength\\parindent{0pt}\\setlength\\parskip{2pt}\n\\begin{document}\n\
                    \\relpenalty=10000\\binoppenalty=0\n";

impl Formulas {
    pub(super) fn latex(&self, format: &Latex) -> String {
        let mut text = String::from(HEAD);
        text += &format!("\\section*{{{}}}\n", prose(&self.robot));
        text += &format!("{}.\n", self.variables_in_latex().join(", "));
        if self.has_small_terms() {
            text += &format!(
                "{}: in braces.\n",
                prose(SMALL.split_once(": ").map_or("", |own| own.1))
            );
        }
        if self.legend.has_numeric_centres {
            text += "Centres of mass are numbers: there are too many of them for symbols.\n";
        }
        for section in &self.sections {
            text += &format!("\n\\subsection*{{{}}}\n", prose(&section.title));
            for line in &section.lines {
                let (names, sum) = (format.names(line), format.sum(&line.sum));
                text += &format!("$\\displaystyle {names} = {sum}$\\par\n");
            }
            if let Some(zeros) = zeros(section, format) {
                text += &format!("Zero: ${}$.\\par\n", zeros.replace(", ", "$, $"));
            }
        }
        let legend = &self.legend;
        // Constants are short: several on a line.
        let sums = [
            (CONSTANTS, &legend.constants, ",\n"),
            (BASE_PARAMETERS, &legend.parameters, "\\par\n"),
        ];
        for (title, entries, gap) in sums {
            if !entries.is_empty() {
                let lines = entries.iter().map(|entry| defined(entry, format));
                let lines: Vec<String> = lines.collect();
                text += &format!("{}{}.\n", heading(title), lines.join(gap));
            }
        }
        if !legend.groups.is_empty() {
            text += &heading(legend.title_of_groups());
            for group in &legend.groups {
                let entries = group.entries.iter().map(|entry| defined(entry, format));
                let entries: Vec<String> = entries.collect();
                text += &format!("{}: {}\\par\n", prose(&group.label), entries.join(", "));
            }
        }
        text + "\\end{document}\n"
    }

    fn variables_in_latex(&self) -> Vec<String> {
        let mut parts = Vec::new();
        if self.has_turns() {
            let angle = if self.angle() == "θ" { "\\theta" } else { "q" };
            parts.push(format!("$\\mathrm{{S}}_1 = \\sin {angle}_1$"));
            parts.push(format!(
                "$\\mathrm{{C}}_{{12}} = \\cos({angle}_1 + {angle}_2)$"
            ));
        }
        let offsets = self.offsets("θ", |own| {
            signed(&own.to_string().replace("pi", "\\pi ").replace('*', "\\,"))
        });
        let slides = self.plain_slides().map(|own| format!("d{own} = q{own}"));
        for own in offsets.into_iter().chain(slides) {
            let Some((left, right)) = own.split_once(" = q") else {
                continue;
            };
            let digits = right.find(' ').unwrap_or(right.len());
            let (joint, rest) = right.split_at(digits);
            let letter = if left.starts_with('θ') {
                "\\theta"
            } else {
                "d"
            };
            parts.push(format!("${letter}_{{{joint}}} = q_{{{joint}}}{rest}$"));
        }
        parts
    }
}

fn defined(entry: &Entry, format: &Latex) -> String {
    let (symbol, value) = (format.symbol(&entry.symbol), value(entry, format));
    match entry.sum.is_empty() {
        true => format!("${symbol} = {value}$"),
        false => format!("${symbol} = {} = {value}$", format.sum(&entry.sum)),
    }
}

fn heading(title: &str) -> String {
    match title.split_once(": ") {
        Some((title, below)) => {
            format!("\n\\subsection*{{{}}}\n{}.\n\n", prose(title), prose(below))
        }
        None => format!("\n\\subsection*{{{}}}\n", prose(title)),
    }
}

/// Writes words of a heading or a legend.
fn prose(text: &str) -> String {
    let mut latex = String::new();
    for c in text.chars() {
        match c {
            '_' => latex += "\\_",
            '^' => latex += "\\^{}",
            '≤' => latex += "$\\le$",
            '−' => latex += "$-$",
            '²' => latex += "$^2$",
            'τ' => latex += "$\\tau$",
            '×' => latex += "$\\times$",
            'ȳ' => latex += "$\\bar y$",
            // A combining macron belongs to the letter before it.
            '\u{304}' => {
                let letter = latex.pop().unwrap_or(' ');
                latex += &format!("$\\bar {letter}$");
            }
            c => latex.push(c),
        }
    }
    latex
}
