//! Symbols in the place of the robot file's numbers.

use dalembert_codegen::Diagnostic;
use dalembert_model::equations::Arm;
use dalembert_model::scalar::Scalar;

use crate::error;
use crate::number::Number;
use crate::ring::{MAX_LENGTHS, Polynomial, Symbols};
use crate::symbol::{Definition, Symbol};

/// The symbols of an arm.
#[derive(Clone, Debug, Default)]
pub struct SymbolTable {
    /// Lengths and gravity.
    pub lengths: Vec<Definition<Number>>,
    /// Masses and moments of inertia.
    pub parameters: Vec<Definition<Number>>,
    /// True if centres of mass stay numbers, since there are too many of them.
    pub has_numeric_centres: bool,
}

impl SymbolTable {
    /// Replaces every number that is not zero, but for angles.
    pub fn new(arm: &mut Arm<Polynomial>) -> Result<SymbolTable, Diagnostic> {
        let mut naming = SymbolTable::default();
        naming.gravity(&mut arm.gravity);
        for (letter, pose) in [("b", &mut arm.base), ("t", &mut arm.tool)] {
            let origin = pose.iter_mut().flat_map(|pose| &mut pose.origin);
            for (axis, entry) in ["x", "y", "z"].into_iter().zip(origin) {
                let symbol = Symbol::indexed(&format!("{letter}{axis}"), "");
                naming.length(entry, symbol, None);
            }
        }
        for (row, link) in arm.links.iter_mut().enumerate() {
            for (letter, entry) in [("a", &mut link.a), ("d", &mut link.d)] {
                naming.length(entry, Symbol::indexed(letter, row + 1), Some(row));
            }
            let origin = link.place.iter_mut().flat_map(|place| &mut place.origin);
            for (axis, entry) in ["px", "py", "pz"].into_iter().zip(origin) {
                naming.length(entry, Symbol::indexed(axis, row + 1), Some(row));
            }
        }
        if naming.lengths.len() > MAX_LENGTHS {
            return Err(error::many_lengths(naming.lengths.len()));
        }
        let coordinates = arm.links.iter().flat_map(|link| &link.com);
        let centres = coordinates.filter(|entry| !entry.is_zero()).count();
        naming.has_numeric_centres = naming.lengths.len() + centres > MAX_LENGTHS;
        for (row, link) in arm.links.iter_mut().enumerate() {
            let number = row + 1;
            if !naming.has_numeric_centres {
                for (axis, entry) in "xyz".chars().zip(&mut link.com) {
                    naming.length(entry, Symbol::centre(axis, number), Some(row));
                }
            }
            let tensor = &mut link.inertia;
            let entries = [
                (Symbol::indexed("m", number), &mut link.mass),
                (Symbol::inertia(number, "xx"), &mut tensor.xx),
                (Symbol::inertia(number, "yy"), &mut tensor.yy),
                (Symbol::inertia(number, "zz"), &mut tensor.zz),
                (Symbol::inertia(number, "xy"), &mut tensor.xy),
                (Symbol::inertia(number, "yz"), &mut tensor.yz),
                (Symbol::inertia(number, "xz"), &mut tensor.xz),
                (Symbol::inertia(number, "a"), &mut link.armature),
            ];
            let parameters = &mut naming.parameters;
            for (symbol, place) in entries {
                name(parameters, Symbols::parameter, place, symbol, Some(row));
            }
        }
        Ok(naming)
    }

    /// Along one axis its symbol is its size.
    fn gravity(&mut self, gravity: &mut [Polynomial; 3]) {
        let mut along = gravity.iter_mut().filter(|g| !g.is_zero());
        match (along.next(), along.next()) {
            (Some(only), None) => {
                let is_negative = only.to_constant().is_some_and(|g| g.is_negative());
                let signed = |g: &Polynomial| if is_negative { g.neg() } else { g.clone() };
                let mut size = signed(only);
                self.length(&mut size, Symbol::indexed("g", ""), None);
                *only = signed(&size);
            }
            _ => {
                for (axis, entry) in ["gx", "gy", "gz"].into_iter().zip(gravity) {
                    self.length(entry, Symbol::indexed(axis, ""), None);
                }
            }
        }
    }

    fn length(&mut self, place: &mut Polynomial, symbol: Symbol, row: Option<usize>) {
        name(&mut self.lengths, Symbols::length, place, symbol, row);
    }
}

fn name(
    definitions: &mut Vec<Definition<Number>>,
    symbols: fn(usize) -> Option<Symbols>,
    place: &mut Polynomial,
    symbol: Symbol,
    row: Option<usize>,
) {
    let Some(value) = place.to_constant().filter(|value| !value.is_zero()) else {
        return;
    };
    if let Some(symbols) = symbols(definitions.len()) {
        *place = Polynomial::symbol(symbols);
    }
    definitions.push(Definition { symbol, value, row });
}
