//! Formulas as text, Markdown, LaTeX and SymPy: each format says how it writes the parts of a formula.

mod latex;
mod python;
mod text;

use dalembert_model::number::Rational;
use num_traits::ToPrimitive;

use crate::expression::{Factor, Sum, Term, Trig};
use crate::line::Line;
use crate::number::Number;
use crate::symbol::Symbol;

pub(crate) use latex::Latex;
pub(crate) use python::{Python, python_number};
pub(crate) use text::Text;

/// The parts of a formula in one format.
pub(crate) trait Format {
    /// The sign of a product.
    const TIMES: &'static str;
    /// The sign of a difference.
    const MINUS: &'static str;
    /// The parentheses of a sum.
    const PARENTHESES: [&'static str; 2];
    /// The parentheses of small terms at the end of a line; `None` where they stand like others.
    const ASIDE: Option<[&'static str; 2]>;

    /// Writes a number that was measured.
    fn number(&self, number: &Number) -> String;
    /// Writes a fraction of small integers, neither zero nor one.
    fn fraction(&self, fraction: &Rational) -> String;
    /// Writes a symbol.
    fn symbol(&self, symbol: &Symbol) -> String;
    /// Writes a power of something that stands by itself.
    fn power(&self, base: String, power: u32) -> String;
    /// Writes a sine or a cosine.
    fn wave(&self, trig: &Trig) -> String;

    /// Writes a number of the formula itself.
    fn exact(&self, number: &Number) -> String {
        let fraction = number.to_fraction().filter(|fraction| {
            let is_short = |part: Option<i64>| part.is_some_and(|part| part.abs() <= 64);
            is_short(fraction.numer().to_i64()) && is_short(fraction.denom().to_i64())
        });
        match fraction {
            Some(fraction) => self.fraction(&fraction),
            None => self.number(number),
        }
    }

    /// Writes a product.
    fn term(&self, term: &Term) -> String {
        let factors: Vec<String> = term
            .factors
            .iter()
            .map(|factor| match factor {
                Factor::Number(number) => self.number(number),
                Factor::Exact(number) => self.exact(number),
                Factor::Symbol(symbol, 1) => self.symbol(symbol),
                Factor::Symbol(symbol, power) => self.power(self.symbol(symbol), *power),
                Factor::Wave(trig, 1) => self.wave(trig),
                Factor::Wave(trig, power) => self.power(self.wave(trig), *power),
                Factor::Sum(sum) => {
                    let [open, close] = Self::PARENTHESES;
                    format!("{open}{}{close}", self.plain_sum(sum))
                }
            })
            .collect();
        match factors.is_empty() {
            true => "1".to_owned(),
            false => factors.join(Self::TIMES),
        }
    }

    /// Writes a sum whose terms all count alike.
    fn plain_sum(&self, sum: &[Term]) -> String {
        let terms = sum.iter().map(|term| (term.is_negative, self.term(term)));
        let text = signed_sum(terms, Self::MINUS);
        match text.is_empty() {
            true => "0".to_owned(),
            false => text,
        }
    }

    /// Writes a sum, small terms set off at its end.
    fn sum(&self, sum: &Sum) -> String {
        let Some([open, close]) = Self::ASIDE else {
            return self.plain_sum(sum);
        };
        let split = sum
            .iter()
            .position(|term| term.is_small)
            .unwrap_or(sum.len());
        let (large, small) = sum.split_at(split);
        let text = self.plain_sum(large);
        match small.is_empty() {
            true => text,
            false => format!("{text} + {open}{}{close}", self.plain_sum(small)),
        }
    }

    /// Writes the left side of a line.
    fn names(&self, line: &Line) -> String {
        let others = line.others.iter().map(|(is_negative, symbol)| {
            let sign = if *is_negative { Self::MINUS } else { "" };
            format!(" = {sign}{}", self.symbol(symbol))
        });
        self.symbol(&line.name) + &others.collect::<String>()
    }
}

/// The digits of a number that was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Digits {
    /// Six, for reading.
    #[default]
    Six,
    /// All of them.
    All,
}

impl Digits {
    pub(crate) fn write(self, number: &Number) -> String {
        match self {
            Digits::Six => number.rounded(6),
            Digits::All => number.digits(),
        }
    }
}

/// Writes the angle of a sine or a cosine: `23` for θ_2 + θ_3, `(2·23)` for twice that, `(12−4)`.
fn angle(trig: &Trig, times: &str, minus: &str, joins: bool) -> (String, bool) {
    let all_ones = trig.angle.iter().all(|(multiple, _)| *multiple == 1);
    let numbers = |angle: &[(i32, usize)]| -> String {
        angle.iter().map(|(_, joint)| joint.to_string()).collect()
    };
    if all_ones && (joins || trig.angle.len() == 1) {
        return (numbers(&trig.angle), true);
    }
    let first = trig.angle.first().map_or(1, |(multiple, _)| *multiple);
    let all_same = trig.angle.iter().all(|(multiple, _)| *multiple == first);
    if all_same && first > 1 && (joins || trig.angle.len() == 1) {
        return (format!("{first}{times}{}", numbers(&trig.angle)), false);
    }
    let mut text = String::new();
    for (multiple, joint) in &trig.angle {
        text += match (text.is_empty(), *multiple < 0) {
            (true, true) | (false, true) => minus,
            (true, false) => "",
            (false, false) => "+",
        };
        if multiple.abs() != 1 {
            text += &format!("{}{times}", multiple.abs());
        }
        text += &joint.to_string();
    }
    (text, false)
}

/// Joins terms, each with its sign: `−a + b`.
pub(crate) fn signed_sum(terms: impl Iterator<Item = (bool, String)>, minus: &str) -> String {
    terms.fold(String::new(), |text, (is_negative, term)| {
        match (text.is_empty(), is_negative) {
            (true, true) => format!("{minus}{term}"),
            (true, false) => term,
            (false, true) => format!("{text} {minus} {term}"),
            (false, false) => format!("{text} + {term}"),
        }
    })
}
