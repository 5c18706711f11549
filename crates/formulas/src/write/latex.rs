//! LaTeX: `D_{22} = 2.107 - 0.7698\,S_{3}`.

use dalembert_model::number::Rational;

use super::{Digits, Format, angle};
use crate::expression::Trig;
use crate::number::Number;
use crate::symbol::Symbol;

/// LaTeX in mathematical mode.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Latex {
    /// The digits of numbers.
    pub digits: Digits,
    /// True if joints have one digit, so that their numbers stand side by side.
    pub joins: bool,
}

impl Format for Latex {
    const TIMES: &'static str = "\\,";
    const MINUS: &'static str = "-";
    const PARENTHESES: [&'static str; 2] = ["(", ")"];
    const ASIDE: Option<[&'static str; 2]> = Some(["\\{", "\\}"]);

    fn number(&self, number: &Number) -> String {
        let text = self.digits.write(number);
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{mantissa}{{\\cdot}}10^{{{exponent}}}"),
            None => text,
        }
    }

    fn fraction(&self, fraction: &Rational) -> String {
        match fraction.is_integer() {
            true => fraction.to_string(),
            false => format!("\\tfrac{{{}}}{{{}}}", fraction.numer(), fraction.denom()),
        }
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        symbol.latex.clone()
    }

    fn power(&self, base: String, power: u32) -> String {
        // A superscript that marks a part would stand twice.
        match base.contains('^') {
            true => format!("({base})^{{{power}}}"),
            false => format!("{base}^{{{power}}}"),
        }
    }

    fn wave(&self, trig: &Trig) -> String {
        let letter = if trig.is_sine { 'S' } else { 'C' };
        let (angle, _) = angle(trig, "\\cdot ", "-", self.joins);
        format!("\\mathrm{{{letter}}}_{{{angle}}}")
    }
}
