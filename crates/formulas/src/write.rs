//! Formulas as text, Markdown, LaTeX and SymPy: each format says how it writes the parts of a formula.

use dalembert_model::number::Rational;
use dalembert_model::number::parse::write_decimal;
use num_traits::ToPrimitive;

use crate::expression::{Factor, Sum, Term, Trig};
use crate::line::Line;
use crate::number::Number;
use crate::symbol::Symbol;

/// The parts of a formula in one format.
pub(crate) trait Format {
    const TIMES: &'static str;
    const MINUS: &'static str;
    /// The parentheses of small terms at the end of a line; `None` where they stand like others.
    const ASIDE: Option<[&'static str; 2]>;

    /// Writes a number that was measured.
    fn number(&self, number: &Number) -> String;
    /// Writes a fraction of small integers, neither zero nor one.
    fn fraction(&self, fraction: &Rational) -> String;
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

    fn term(&self, term: &Term) -> String {
        let factors = term.factors.iter().map(|factor| match factor {
            Factor::Number(number) => self.number(number),
            Factor::Exact(number) => self.exact(number),
            Factor::Symbol(symbol, 1) => self.symbol(symbol),
            Factor::Symbol(symbol, power) => self.power(self.symbol(symbol), *power),
            Factor::Wave(trig, 1) => self.wave(trig),
            Factor::Wave(trig, power) => self.power(self.wave(trig), *power),
            Factor::Sum(sum) => format!("({})", self.plain_sum(sum)),
        });
        match term.factors.is_empty() {
            true => "1".to_owned(),
            false => factors.collect::<Vec<_>>().join(Self::TIMES),
        }
    }

    /// Writes a sum whose terms all count alike.
    fn plain_sum(&self, sum: &[Term]) -> String {
        let terms = sum.iter().map(|term| (term.is_negative, self.term(term)));
        match sum.is_empty() {
            true => "0".to_owned(),
            false => signed_sum(terms, Self::MINUS),
        }
    }

    /// Writes a sum, small terms set off at its end.
    fn sum(&self, sum: &Sum) -> String {
        let Some([open, close]) = Self::ASIDE else {
            return self.plain_sum(sum);
        };
        let split = sum.iter().position(|term| term.is_small);
        let (large, small) = sum.split_at(split.unwrap_or(sum.len()));
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
    let first = trig.angle.first().map_or(1, |(multiple, _)| *multiple);
    let all_same = trig.angle.iter().all(|(multiple, _)| *multiple == first);
    if all_same && first > 0 && (joins || trig.angle.len() == 1) {
        let joints = trig.angle.iter().map(|(_, joint)| joint.to_string());
        let numbers: String = joints.collect();
        return match first {
            1 => (numbers, true),
            _ => (format!("{first}{times}{numbers}"), false),
        };
    }
    let mut text = String::new();
    for (multiple, joint) in &trig.angle {
        text += match text.is_empty() {
            _ if *multiple < 0 => minus,
            true => "",
            false => "+",
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

/// Plain text with letters of Unicode: `D_22 = 2.107 − 0.7698·S3`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text {
    pub digits: Digits,
    /// True if joints have one digit, so that their numbers stand side by side.
    pub joins: bool,
}

impl Format for Text {
    const TIMES: &'static str = "·";
    const MINUS: &'static str = "−";
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
        let mut text = base;
        for digit in power.to_string().bytes() {
            text.push(RAISED[usize::from(digit - b'0')]);
        }
        text
    }

    fn wave(&self, trig: &Trig) -> String {
        let letter = if trig.is_sine { 'S' } else { 'C' };
        match angle(trig, "·", "−", self.joins) {
            (angle, true) => format!("{letter}{angle}"),
            (angle, false) => format!("{letter}({angle})"),
        }
    }
}

/// LaTeX in mathematical mode: `D_{22} = 2.107 - 0.7698\,S_{3}`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Latex {
    pub digits: Digits,
    pub joins: bool,
}

impl Format for Latex {
    const TIMES: &'static str = "\\,";
    const MINUS: &'static str = "-";
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

/// Expressions of SymPy: `D_22 = R('2.107') - R('0.7698')*sin(t3)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Python;

impl Format for Python {
    const TIMES: &'static str = "*";
    const MINUS: &'static str = "-";
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
        let angle = trig.angle.iter();
        let terms = angle.map(|&(multiple, joint)| match multiple.abs() {
            1 => (multiple < 0, format!("t{joint}")),
            size => (multiple < 0, format!("{size}*t{joint}")),
        });
        format!("{function}({})", signed_sum(terms, "-"))
    }
}

/// Writes an exact number for SymPy.
pub(crate) fn python_number(value: &Rational) -> String {
    match write_decimal(value) {
        Some(decimal) => format!("R('{decimal}')"),
        None => format!("R({}, {})", value.numer(), value.denom()),
    }
}
