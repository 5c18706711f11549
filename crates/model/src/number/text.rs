//! Exact constants as text: `-3/4`, `1/2*cos(pi/5)^2+3*sin(3/10)*cos(3/10)`.

use alloc::string::{String, ToString};
use alloc::sync::Arc;
use core::fmt;
use core::str::FromStr;

use num_traits::Zero;

use super::exact::{Canonical, Monomial, Power, Terms};
use super::parse::NumberError;
use super::{Angle, Exact, Rational};

impl fmt::Display for Exact {
    /// Writes it without blanks; angles are in radians, or multiples of `pi`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let terms = match &self.0 {
            Canonical::Rational(value) => return write!(f, "{value}"),
            Canonical::Polynomial(terms) => terms,
        };
        for (index, (monomial, coefficient)) in terms.iter().enumerate() {
            if index > 0 {
                f.write_str("+")?;
            }
            write!(f, "{coefficient}")?;
            for power in monomial {
                let angle = angle_text(&power.angle);
                if power.sin > 0 {
                    write!(f, "*sin({angle})")?;
                }
                match power.cos {
                    0 => {}
                    1 => write!(f, "*cos({angle})")?,
                    n => write!(f, "*cos({angle})^{n}")?,
                }
            }
        }
        Ok(())
    }
}

fn angle_text(angle: &Angle) -> String {
    match angle {
        Angle::PiTimes(multiple) => alloc::format!("{}*pi/{}", multiple.numer(), multiple.denom()),
        Angle::Radians(value) | Angle::TwiceAtan(value) => value.to_string(),
    }
}

/// Longer texts are refused: no plan needs them.
const MAX_BYTES: usize = 1 << 16;

impl FromStr for Exact {
    type Err = NumberError;

    fn from_str(text: &str) -> Result<Self, NumberError> {
        if text.len() > MAX_BYTES {
            return Err(NumberError::NotExact);
        }
        let mut terms = Terms::new();
        for term in text.split('+') {
            let (monomial, coefficient) = parse_term(term)?;
            *terms.entry(monomial).or_insert_with(Rational::zero) += coefficient;
        }
        Ok(Exact::from_terms(terms))
    }
}

fn parse_term(text: &str) -> Result<(Monomial, Rational), NumberError> {
    let (coefficient, mut rest) = text.split_at(text.find('*').unwrap_or(text.len()));
    let coefficient = rational(coefficient)?;
    let mut monomial = Monomial::new();
    while !rest.is_empty() {
        rest = rest.strip_prefix('*').ok_or(NumberError::NotExact)?;
        let is_sin = rest.starts_with("sin(");
        let function = if is_sin { "sin(" } else { "cos(" };
        let argument = rest.strip_prefix(function).ok_or(NumberError::NotExact)?;
        let (angle, after) = argument.split_once(')').ok_or(NumberError::NotExact)?;
        let (power, after) = after.split_at(after.find('*').unwrap_or(after.len()));
        let exponent: u32 = match power.strip_prefix('^') {
            Some(exponent) => exponent.parse().map_err(|_| NumberError::NotExact)?,
            None if power.is_empty() => 1,
            None => return Err(NumberError::NotExact),
        };
        // Powers come from at most 64 joints; a squared sine is never written.
        if exponent > if is_sin { 1 } else { 1024 } || exponent == 0 {
            return Err(NumberError::NotExact);
        }
        let angle = parse_angle(angle)?;
        let (sin, cos) = (exponent * u32::from(is_sin), exponent * u32::from(!is_sin));
        match monomial.last_mut() {
            Some(last) if *last.angle == angle && last.cos == 0 && cos > 0 => last.cos = cos,
            // Ascending, each once: reading must not multiply polynomials out.
            Some(last) if *last.angle >= angle => return Err(NumberError::NotExact),
            _ => monomial.push(Power {
                angle: Arc::new(angle),
                sin,
                cos,
            }),
        }
        rest = after;
    }
    Ok((monomial, coefficient))
}

fn parse_angle(text: &str) -> Result<Angle, NumberError> {
    match text.contains("*pi/") {
        true => rational(&text.replacen("*pi/", "/", 1)).map(Angle::PiTimes),
        false => rational(text).map(Angle::Radians),
    }
}

fn rational(text: &str) -> Result<Rational, NumberError> {
    let (_, denominator) = text.split_once('/').unwrap_or((text, "1"));
    match text.starts_with('+') || denominator.starts_with(['-', '+']) || text.contains('_') {
        true => Err(NumberError::NotExact),
        false => text.parse().map_err(|_| NumberError::NotExact),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::ratio;
    use crate::scalar::Scalar;

    #[test]
    fn constants_read_back() {
        let a = Exact::sincos(&Angle::PiTimes(ratio(1, 5)));
        let b = Exact::sincos(&Angle::Radians(ratio(3, 10)));
        let three = Exact::from(ratio(-3, 4));
        for constant in [
            three.clone(),
            Exact::zero(),
            a.sin.mul(&a.cos).mul(&a.cos).add(&three),
            a.cos.mul(&b.sin).sub(&b.cos.mul(&b.cos).mul(&three)),
        ] {
            assert_eq!(constant.to_string().parse(), Ok(constant));
        }
        let wrong = "1/0 x 1*sin( 1*cos(1)^ 1/-2 1*tan(1) 1*cos(1)^9999 1*sin(1)^2 \
            1*sin(1)*sin(1) 1*cos(2)*cos(1)";
        for wrong in wrong.split(' ').chain([""]) {
            let read = wrong.parse::<Exact>();
            assert_eq!(read, Err(NumberError::NotExact), "{wrong}");
        }
    }
}
