//! The symbols that formulas have, and what they mean.

use std::collections::BTreeSet;

use super::{Builder, OF_FILE};
use crate::expression::{Factor, Term};
use crate::legend::{Frames, Legend, SymbolEntry};
use crate::line::Section;
use crate::names::{SharedConstants, form_of};
use crate::symbol::Symbol;

impl Builder<'_> {
    /// Lists the symbols that occur, constants first, then base parameters, then the file's.
    pub(super) fn legend(&self, sections: &[Section]) -> Legend {
        let mut legend = Legend::default();
        let mut codes: BTreeSet<String> = BTreeSet::new();
        for line in sections.iter().flat_map(|section| &section.lines) {
            collect_codes(&line.sum, &mut codes);
        }
        let names = self.names(self.constants_table());
        for (place, form) in self.shared.forms.iter().enumerate() {
            let sum = names.form(form);
            collect_codes(&sum, &mut codes);
            legend.constants.push(SymbolEntry {
                symbol: SharedConstants::symbol(place),
                sum,
                value: names.value(form),
            });
        }
        let of_file = self.names(OF_FILE);
        // An armature is a base parameter as it stands.
        let file = &self.arm.symbols.parameters;
        let is_of_file = |symbol: &Symbol| file.iter().any(|other| other.symbol == *symbol);
        for table in &self.tables[1..] {
            for (definition, (_, value)) in table.definitions.iter().zip(&table.parameters) {
                if codes.contains(&definition.symbol.code) && !is_of_file(&definition.symbol) {
                    let sum = of_file.form(&form_of(&definition.value));
                    collect_codes(&sum, &mut codes);
                    legend.parameters.push(SymbolEntry {
                        symbol: definition.symbol.clone(),
                        sum,
                        value: *value,
                    });
                }
            }
        }
        let mut entries = [self.arm.symbols.lengths.as_slice(), file].concat();
        entries.sort_by_key(|entry| entry.row);
        entries.retain(|entry| codes.contains(&entry.symbol.code));
        for entry in entries {
            legend.entry(self.label(entry.row), entry);
        }
        legend.frames = Frames::of(self.setup.robot());
        legend.has_numeric_centres = self.arm.symbols.has_numeric_centres;
        legend
    }

    /// The name of a row's joint, or of the robot. A robot with joints that follow others has more rows
    /// than variables.
    fn label(&self, row: Option<usize>) -> String {
        let robot = self.setup.robot();
        let rows = robot.rows();
        let kind = match rows.len() == robot.joints.len() {
            true => "joint",
            false => "row",
        };
        match row.map(|row| (row + 1, rows.get(row).and_then(|joint| joint.name.as_ref()))) {
            None => "robot".to_owned(),
            Some((number, Some(name))) => format!("{kind} {number} ({name})"),
            Some((number, None)) => format!("{kind} {number}"),
        }
    }
}

/// Notes the symbols of a sum, by their identifiers.
fn collect_codes(sum: &[Term], codes: &mut BTreeSet<String>) {
    for factor in sum.iter().flat_map(|term| &term.factors) {
        match factor {
            Factor::Symbol(symbol, _) => {
                codes.insert(symbol.code.clone());
            }
            Factor::Sum(sum) => collect_codes(sum, codes),
            Factor::Number(_) | Factor::Exact(_) | Factor::Wave(..) => {}
        }
    }
}
