//! Plain text with letters of Unicode: `D_22 = 2.107 − 0.7698·S3`.

use dalembert_model::number::Rational;

use super::{Digits, Format, angle};
use crate::expression::Trig;
use crate::number::Number;
use crate::symbol::Symbol;

/// Plain text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text {
    /// The digits of numbers.
    pub digits: Digits,
    /// True if joints have one digit, so that their numbers stand side by side.
    pub joins: bool,
}

impl Format for Text {
    const TIMES: &'static str = "·";
    const MINUS: &'static str = "−";
    const PARENTHESES: [&'static str; 2] = ["(", ")"];
    const ASIDE: Option<[&'static str; 2]> = Some(["(", ")"]);

    fn number(&self, number: &Number) -> String {
        self.digits.write(number)
    }

    fn fraction(&self, fraction: &Rational) -> String {
        fraction.to_string()
    }

    fn symbol(&self, symbol: &Symbol) -> String {
        symbol.text.clone()
    }

    fn power(&self, base: String, power: u32) -> String {
        const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
        let digits = power.to_string();
        let raised = digits
            .bytes()
            .map(|digit| RAISED[usize::from(digit - b'0')]);
        base + &raised.collect::<String>()
    }

    fn wave(&self, trig: &Trig) -> String {
        let letter = if trig.is_sine { 'S' } else { 'C' };
        match angle(trig, "·", "−", self.joins) {
            (angle, true) => format!("{letter}{angle}"),
            (angle, false) => format!("{letter}({angle})"),
        }
    }
}
