//! A LaTeX document.

use super::text::capital;
use super::{CONSTANTS, defined, zeros};
use crate::formulas::Formulas;
use crate::write::{Format, Latex};

const HEAD: &str = "\\documentclass{article}\n\\usepackage{amsmath}\n\\usepackage[margin=15mm]{geometry}\n\
                    \\raggedright\\setlength\\parindent{0pt}\\setlength\\parskip{2pt}\n\\begin{document}\n\
                    \\relpenalty=10000\\binoppenalty=0\n";

impl Formulas {
    pub(super) fn latex(&self, format: &Latex) -> String {
        let mut text = String::from(HEAD);
        text += &format!("\\section*{{{}}}\n", plain(&self.robot));
        text += &format!("{}.\n", self.variables_in_latex().join(", "));
        if self.has_coefficients() {
            text += "\nThe equations of motion are $\\tau_i = \\sum_k D_{ik}\\,\\ddot q_k + \\sum_k\\sum_m h_{ikm}\\,\\dot \
                     q_k\\,\\dot q_m + c_i$ with $h_{ikm} = h_{imk}$: a pair $k < m$ counts twice.\n";
        }
        if self.has_term(|term| term.is_small) {
            text += "\nTerms below 1/1000 of the largest of a line are in braces at its end.\n";
        }
        for remark in self.remarks() {
            text += &format!("\n{}.\n", plain(&capital(&remark)));
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
        for (title, entries) in self.sums() {
            // Constants are short: several on a line.
            let gap = if title == CONSTANTS { ",\n" } else { "\\par\n" };
            let lines = defined(entries, format, "$", gap);
            text += &format!("{}{lines}.\n", heading(title));
        }
        if !legend.groups.is_empty() {
            text += &heading(&legend.title_of_groups());
            for group in &legend.groups {
                let entries = defined(&group.entries, format, "$", ", ");
                text += &format!("{}: {entries}\\par\n", plain(&group.label));
            }
        }
        text + "\\end{document}\n"
    }

    fn variables_in_latex(&self) -> Vec<String> {
        let mut parts = Vec::new();
        if let Some([first, second]) = self.turning() {
            let angle = if self.angle() == "θ" { "\\theta" } else { "q" };
            parts.push(format!(
                "$\\mathrm{{S}}_{{{first}}} = \\sin {angle}_{{{first}}}$"
            ));
            if first != second {
                let sum = format!("{angle}_{{{first}}} + {angle}_{{{second}}}");
                let gap = if self.joints < 10 { "" } else { "+" };
                parts.push(format!(
                    "$\\mathrm{{C}}_{{{first}{gap}{second}}} = \\cos({sum})$"
                ));
            }
        }
        let in_latex = |angle: String| angle.replace("pi", "\\pi ").replace('*', "\\,");
        for (letter, joint, shift) in self.offsets(in_latex) {
            let letter = letter.replace('θ', "\\theta");
            parts.push(format!("${letter}_{{{joint}}} = q_{{{joint}}}{shift}$"));
        }
        parts
    }
}

fn heading(title: &str) -> String {
    let (title, below) = match title.split_once(": ") {
        Some((title, below)) => (title, format!("{}.\n\n", prose(below))),
        None => (title, String::new()),
    };
    format!("\n\\subsection*{{{}}}\n{below}", prose(title))
}

/// Writes words of a heading or a legend; `D_ik` and `D^rot_ik` are mathematics.
fn prose(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let end = word.trim_end_matches([',', ':', ';', '.']).len();
        let (symbol, end) = word.split_at(end);
        match symbol.split_once('_') {
            Some((letters, indices)) if letters.chars().all(|c| c.is_alphabetic() || c == '^') => {
                let letters = match letters.split_once('^') {
                    Some((letter, mark)) => format!("{letter}^{{\\mathrm{{{mark}}}}}"),
                    None => letters.replace('τ', "\\tau"),
                };
                format!("${letters}_{{{indices}}}${end}")
            }
            _ => plain(word),
        }
    });
    words.collect::<Vec<String>>().join(" ")
}

/// Writes words without mathematics.
fn plain(text: &str) -> String {
    let mut latex = String::new();
    for c in text.chars() {
        match c {
            '_' | '&' | '%' | '#' | '$' | '{' | '}' => latex.extend(['\\', c]),
            '\\' => latex += "\\textbackslash{}",
            '<' => latex += "\\textless{}",
            '>' => latex += "\\textgreater{}",
            '|' => latex += "\\textbar{}",
            '^' => latex += "\\^{}",
            '~' => latex += "\\~{}",
            '≤' => latex += "$\\le$",
            '−' => latex += "$-$",
            '²' => latex += "$^2$",
            '×' => latex += "$\\times$",
            'ȳ' => latex += "$\\bar y$",
            // A combining macron belongs to the letter before it.
            '\u{304}' => {
                let letter = latex.pop().unwrap_or(' ');
                latex += &format!("$\\bar {letter}$");
            }
            c if c > '\u{24f}' => latex.push('?'),
            c => latex.push(c),
        }
    }
    latex
}
