//! A module for SymPy: symbols, then every entry, then nested lists of them.

use dalembert_model::number::Angle;
use dalembert_model::robot::JointKind;

use super::value;
use crate::arm::Offset;
use crate::formulas::Formulas;
use crate::legend::SymbolEntry;
use crate::line::List;
use crate::write::{Format, Python, python_number};

impl Formulas {
    pub(super) fn sympy(&self) -> String {
        let format = Python;
        let mut text = format!(
            "# Closed forms of {}, for SymPy.\nfrom sympy import Rational as R, atan, cos, pi, sin, symbols\n\n",
            self.robot
        );
        for letter in ["q", "dq", "ddq"] {
            let joints = self.variables.iter().map(|variable| variable.joint + 1);
            text += &declared(joints.map(|joint| format!("{letter}{joint}")));
        }
        text += "# θ and d of the table: positions with their offsets.\n";
        for variable in &self.variables {
            let number = variable.joint + 1;
            let turns = variable.kind == JointKind::Revolute;
            let letter = if turns { "t" } else { "d" };
            let offset = match &variable.offset {
                Offset::None if !turns => continue,
                Offset::None => String::new(),
                Offset::Angle(angle) => format!(" + {}", python_angle(angle)),
                Offset::Length(length) => format!(" + {}", python_number(length)),
            };
            text += &format!("{letter}{number} = q{number}{offset}\n");
        }
        let legend = &self.legend;
        let of_file = legend.groups.iter().flat_map(|group| &group.entries);
        let defined = legend.parameters.iter().chain(&legend.constants);
        let symbols: Vec<&SymbolEntry> = of_file.chain(defined).collect();
        if !symbols.is_empty() {
            text += &declared(symbols.iter().map(|entry| entry.symbol.code.clone()));
        }
        for section in &self.sections {
            text += &format!("\n# {}\n", section.title);
            for line in &section.lines {
                let name = &line.name.code;
                text += &format!("{name} = {}\n", format.sum(&line.sum));
                for (is_negative, other) in &line.others {
                    let sign = if *is_negative { "-" } else { "" };
                    text += &format!("{} = {sign}{name}\n", other.code);
                }
            }
            for zero in &section.zeros {
                text += &format!("{} = R(0)\n", zero.code);
            }
            if let Some(list) = &section.list {
                text += &format!("{} = {}\n", list.name, nested(list));
            }
        }
        if symbols.is_empty() {
            return text;
        }
        text += "\n# The symbols in other symbols, and their values: D[0][0].subs(values).\ndefinitions = {\n";
        for entry in symbols.iter().filter(|entry| !entry.sum.is_empty()) {
            text += &format!("    {}: {},\n", entry.symbol.code, format.sum(&entry.sum));
        }
        text += "}\nvalues = {\n";
        for entry in &symbols {
            text += &format!("    {}: {},\n", entry.symbol.code, value(entry, &format));
        }
        text + "}\n"
    }
}

/// Writes the declaration of symbols.
fn declared(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    let (left, right) = (names.join(", "), names.join(" "));
    format!("[{left}] = symbols('{right}', real=True, seq=True)\n")
}

fn python_angle(angle: &Angle) -> String {
    match angle {
        Angle::PiTimes(multiple) => format!("{}*pi", python_number(multiple)),
        Angle::Radians(radians) => python_number(radians),
        Angle::TwiceAtan(tangent) => format!("2*atan({})", python_number(tangent)),
    }
}

/// Writes a nested list, the innermost lists first.
fn nested(list: &List) -> String {
    let entries = list.entries.iter();
    let mut parts: Vec<String> = entries.map(|entry| entry.code.clone()).collect();
    for length in list.lengths.iter().rev() {
        let chunks = parts.chunks(*length);
        let lists = chunks.map(|entries| format!("[{}]", entries.join(", ")));
        parts = lists.collect();
    }
    parts.concat()
}
