//! Decimal literals, read exactly.
//!
//! `0.4318` is 4318/10000. A parser that goes through f64 would read 0.43180000000000001714…, and
//! every constant of the generated code would carry a 53-bit numerator about.

use alloc::format;
use alloc::string::{String, ToString};
use core::fmt;

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::Rational;

/// The longest literal, in bytes: room for every double in range, written out to its last digit.
pub const MAX_LITERAL: usize = 1200;
/// The most digits of a literal, leading zeros aside; a double has up to 767.
pub const MAX_DIGITS: usize = 800;
/// A number that is not zero, and its reciprocal, are at most 10^`MAX_EXPONENT`: ordinary doubles.
pub const MAX_EXPONENT: i64 = 300;

/// The reasons for which a text is not a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberError {
    /// Not of the form digits, point, digits, exponent.
    Malformed,
    /// `nan` or `inf`.
    NotFinite,
    /// A hexadecimal, octal or binary integer.
    Radix,
    /// More than [`MAX_LITERAL`] bytes or [`MAX_DIGITS`] digits.
    TooLong,
    /// Not zero and outside 1e-300 to 1e300.
    OutOfRange,
    /// A fraction whose denominator is zero.
    ZeroDenominator,
    /// The text is not an exact constant as [`Exact`](super::Exact) prints it.
    NotExact,
}

impl NumberError {
    /// Returns the likely fix.
    pub fn help(self) -> &'static str {
        match self {
            NumberError::Malformed => "write a number like 0.5, -3 or 1.2e-4",
            NumberError::NotFinite => "write a finite number, or leave the key out",
            NumberError::Radix => "write it in decimal",
            NumberError::TooLong => "17 digits are enough for any double",
            NumberError::OutOfRange => "zero, or a size from 1e-300 to 1e300",
            NumberError::NotExact => "such as `3/4` or `1/2*cos(1*pi/5)^2`",
            NumberError::ZeroDenominator => "write a fraction like \"1/3\"",
        }
    }
}

impl fmt::Display for NumberError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NumberError::Malformed => "not a decimal number",
            NumberError::NotFinite => "not a finite number",
            NumberError::Radix => "not a decimal number but one in another base",
            NumberError::TooLong => return write!(f, "a number of more than {MAX_DIGITS} digits"),
            NumberError::OutOfRange => "a number too large or too small",
            NumberError::NotExact => "expected a constant such as `3/4` or `1/2*cos(1*pi/5)^2`",
            NumberError::ZeroDenominator => "a fraction with denominator zero",
        })
    }
}

impl core::error::Error for NumberError {}

/// Reads a decimal literal as TOML writes it: sign, digits with `_` between them, point, exponent.
///
/// # Errors
/// [`NumberError`]; work and memory are bounded whatever the text.
pub fn parse_decimal(text: &str) -> Result<Rational, NumberError> {
    if text.len() > MAX_LITERAL {
        return Err(NumberError::TooLong);
    }
    let (negative, rest) = split_sign(text);
    if ["inf", "nan", "infinity", "Infinity", "NaN", "Inf"].contains(&rest) {
        return Err(NumberError::NotFinite);
    }
    if ["0x", "0o", "0b"].iter().any(|p| rest.starts_with(p)) {
        return Err(NumberError::Radix);
    }
    let (mantissa, exponent) = rest.split_once(['e', 'E']).unwrap_or((rest, "0"));
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    let fraction = fraction.map_or(Ok(String::new()), digits)?;
    let scale = parse_exponent(exponent)? - fraction.len() as i64;
    let size = integer(digits(whole)? + &fraction)?;
    scaled(if negative { -size } else { size }, scale)
}

/// Reads a positive fraction `n/d` of two integers, with an optional sign.
///
/// # Errors
/// As [`parse_decimal`], and for a denominator of zero.
pub fn parse_fraction(text: &str) -> Result<Rational, NumberError> {
    let (negative, rest) = split_sign(text.trim());
    let (numer, denom) = rest.split_once('/').ok_or(NumberError::Malformed)?;
    let numer = parse_integer(numer.trim_end())?;
    let denom = parse_integer(denom.trim_start())?;
    if denom.is_zero() {
        return Err(NumberError::ZeroDenominator);
    }
    checked(Rational::new(if negative { -numer } else { numer }, denom))
}

pub(super) fn parse_integer(text: &str) -> Result<BigInt, NumberError> {
    if text.len() > MAX_LITERAL {
        return Err(NumberError::TooLong);
    }
    integer(digits(text)?)
}

/// True if a number is zero or of a size from 1e-300 to 1e300.
pub fn in_range(value: &Rational) -> bool {
    // Bits first: the exact comparison should not multiply with a numerator of any length.
    let bits = |n: &BigInt| n.bits() as i64;
    let size = bits(value.numer()) - bits(value.denom());
    if value.is_zero() || size.abs() < 990 {
        return true;
    }
    if size.abs() > 1010 {
        return false;
    }
    let power = Rational::from_integer(BigInt::from(10).pow(MAX_EXPONENT as u32));
    let size = value.abs();
    size <= power && size.recip() <= power
}

pub(super) fn checked(value: Rational) -> Result<Rational, NumberError> {
    Some(value).filter(in_range).ok_or(NumberError::OutOfRange)
}

/// Returns `size`·10^`scale`, refused before it is built if it would be out of range.
fn scaled(size: BigInt, scale: i64) -> Result<Rational, NumberError> {
    if size.is_zero() {
        return Ok(Rational::zero());
    }
    // |scale| is at most 10 000 + 800 here; size has up to 800 digits.
    if scale.abs() > 2 * MAX_LITERAL as i64 {
        return Err(NumberError::OutOfRange);
    }
    checked(Rational::from_integer(10.into()).pow(scale as i32) * size)
}

pub(crate) fn split_sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// An exponent beyond ±10 000 stays there, out of range for every literal that is not zero.
fn parse_exponent(text: &str) -> Result<i64, NumberError> {
    let (negative, rest) = split_sign(text);
    // Too many digits for an integer are too many for a size.
    let value = digits(rest)?.parse().unwrap_or(i64::MAX).min(10_000);
    Ok(if negative { -value } else { value })
}

fn digits(run: &str) -> Result<String, NumberError> {
    let good = run.split('_').all(|part| !part.is_empty())
        && run.bytes().all(|b| b.is_ascii_digit() || b == b'_');
    good.then(|| run.replace('_', ""))
        .ok_or(NumberError::Malformed)
}

fn integer(digits: String) -> Result<BigInt, NumberError> {
    match digits.trim_start_matches('0') {
        "" => Ok(BigInt::zero()),
        digits if digits.len() > MAX_DIGITS => Err(NumberError::TooLong),
        digits => digits.parse().map_err(|_| NumberError::Malformed),
    }
}

/// Writes a number so that it reads back exactly: a decimal where there is one, else `None`.
///
/// Integers that a 64-bit reader would refuse, and numbers with many zeros, get an exponent.
pub fn write_decimal(value: &Rational) -> Option<String> {
    if value.is_zero() {
        return Some("0".to_string());
    }
    // value = digits · 10^−places, with the fewest places.
    let mut denom = value.denom().clone();
    let (mut twos, mut fives) = (0u32, 0u32);
    for (prime, count) in [(2u32, &mut twos), (5, &mut fives)] {
        while (&denom % prime).is_zero() {
            denom /= prime;
            *count += 1;
        }
    }
    if !denom.is_one() {
        return None;
    }
    let places = twos.max(fives);
    let digits = value.numer().abs()
        * BigInt::from(2).pow(places - twos)
        * BigInt::from(5).pow(places - fives);
    let digits = digits.to_string();
    let kept = digits.trim_end_matches('0');
    let sign = if value.is_negative() { "-" } else { "" };
    let lead = digits.len() as i64 - 1 - i64::from(places);
    Some(if !(-5..=15).contains(&lead) {
        let (first, rest) = kept.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        format!("{sign}{first}{point}{rest}e{lead}")
    } else if places == 0 {
        format!("{sign}{digits}")
    } else if lead < 0 {
        format!("{sign}0.{}{kept}", "0".repeat((-lead - 1) as usize))
    } else {
        let (whole, rest) = digits.split_at(lead as usize + 1);
        format!("{sign}{whole}.{rest}")
    })
}
