//! Base parameters in words: each as a combination of the links' and the drives' parameters.

use dalembert_model::number::parse::write_decimal;
use dalembert_model::number::{Exact, Rational};
use num_traits::{One, Signed};

use super::Parameter;

fn decimal(value: &Rational) -> String {
    write_decimal(value).unwrap_or_else(|| value.to_string())
}

fn plain(constant: &Exact) -> String {
    let mut text = String::new();
    for c in constant.to_string().chars() {
        if c == '*' {
            let rest = text.strip_suffix('1');
            let ends = |c: char| c.is_ascii_digit() || c == '.' || c == '/';
            if let Some(rest) = rest.filter(|rest| !rest.ends_with(ends)) {
                text.truncate(rest.len());
                continue;
            }
        }
        text.push(c);
    }
    text.replace("+-", " - ").replace('+', " + ")
}

/// For example `Izz2 + 0.25 m3 - mx4`.
pub(super) fn combination(terms: &[(Parameter, Exact)]) -> String {
    let mut text = String::new();
    for (parameter, factor) in terms {
        let is_negative = factor.as_rational().is_some_and(Signed::is_negative);
        let sign = match (text.is_empty(), is_negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let factor = match factor.as_rational() {
            Some(value) if value.abs().is_one() => String::new(),
            Some(value) => format!("{} ", decimal(&value.abs())),
            None => format!("({}) ", plain(factor)),
        };
        text += &format!("{sign}{factor}{parameter}");
    }
    text
}
