//! Expressions of SymPy: `D_22 = R('2.107') - R('0.7698')*sin(t3)`.

use dalembert_model::number::Rational;
use dalembert_model::number::parse::write_decimal;

use super::Format;
use crate::expression::Trig;
use crate::number::Number;
use crate::symbol::Symbol;

/// Python.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Python;

impl Format for Python {
    const TIMES: &'static str = "*";
    const MINUS: &'static str = "-";
    const PARENTHESES: [&'static str; 2] = ["(", ")"];
    const ASIDE: Option<[&'static str; 2]> = None;

    /// A decimal that is exact is a rational of SymPy.
    fn number(&self, number: &Number) -> String {
        let exact = number.to_fraction();
        exact.map_or_else(|| number.digits(), |exact| python_number(&exact))
    }

    fn fraction(&self, fraction: &Rational) -> String {
        match fraction.is_integer() {
            true => fraction.to_string(),
            false => format!("R({}, {})", fraction.numer(), fraction.denom()),
        }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        symbol.code.clone()
    }

    fn power(&self, base: String, power: u32) -> String {
        format!("{base}**{power}")
    }

    fn wave(&self, trig: &Trig) -> String {
        let function = if trig.is_sine { "sin" } else { "cos" };
        let mut angle = String::new();
        for (multiple, joint) in &trig.angle {
            angle += match (angle.is_empty(), *multiple < 0) {
                (true, true) => "-",
                (false, true) => " - ",
                (true, false) => "",
                (false, false) => " + ",
            };
            if multiple.abs() != 1 {
                angle += &format!("{}*", multiple.abs());
            }
            angle += &format!("t{joint}");
        }
        format!("{function}({angle})")
    }
}

/// Writes an exact number for SymPy.
pub(crate) fn python_number(value: &Rational) -> String {
    match write_decimal(value) {
        Some(decimal) => format!("R('{decimal}')"),
        None => format!("R({}, {})", value.numer(), value.denom()),
    }
}
