//! Parsers of values.
//!
//! Clap lists the names and suggests the nearest one for a typing error. Numbers
//! may begin with a hyphen, or clap would take a negative one for an unknown
//! option: these parsers report what a number should be.

use std::ffi::OsStr;
use std::path::PathBuf;

use clap::builder::{
    PathBufValueParser, PossibleValuesParser, StringValueParser, TypedValueParser,
};
use dalembert_codegen::workspace::{Word, parse};
use dalembert_model::number::Rational;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::robot::suggested_name;
use dalembert_model::scene::Scale;
use num_traits::Signed;

pub fn acceleration_parser() -> impl TypedValueParser<Value = Rational> {
    StringValueParser::new().try_map(|text| {
        let number = parse_decimal(text.trim()).ok().filter(Signed::is_positive);
        number.ok_or("a limit of acceleration is a number above zero, such as 10")
    })
}

/// Parses the name of a robot or a module, by the rules of robot files.
pub fn name_parser() -> impl TypedValueParser<Value = String> {
    StringValueParser::new().try_map(|text| match suggested_name(&text) {
        Some(good) if good == text => Ok(text),
        Some(good) => Err(format!(
            "a name has lower-case letters, digits and `_`: write {good}"
        )),
        None => Err("a name has lower-case letters, digits and `_`, a letter first".to_owned()),
    })
}

/// Parses a value by its word; clap lists all words and suggests the nearest.
pub fn word_parser<W: Word + Send + Sync + 'static>() -> impl TypedValueParser<Value = W> {
    PossibleValuesParser::new(W::known()).try_map(|word| parse::<W>(&word))
}

/// Parses the path of a file to certify; refuses a robot, which is the argument of `--robot`.
pub fn certified_parser() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        match path.extension().and_then(OsStr::to_str) {
            Some("toml" | "urdf" | "xacro" | "xml") => Err(format!(
                "expected a generated file (.rs, .h), found a robot: write `dalembert certify FILE --robot {}`",
                path.display()
            )),
            _ => Ok(path),
        }
    })
}

pub fn positive_parser() -> impl TypedValueParser<Value = f64> {
    StringValueParser::new().try_map(|text| {
        let is_good = |number: &f64| *number > 0.0 && number.is_finite();
        let number = text.parse::<f64>().ok().filter(is_good);
        number.ok_or("a tolerance is a number above zero, such as 1e-3")
    })
}

pub fn states_parser() -> impl TypedValueParser<Value = usize> {
    const MAX_STATES: i64 = 10_000;
    clap::value_parser!(i64)
        .range(1..=MAX_STATES)
        .map(|states| states as usize)
}

pub fn scale_parser() -> impl TypedValueParser<Value = Scale> {
    PossibleValuesParser::new(Scale::WORDS.map(|(word, _)| word)).map(|word| {
        let mut words = Scale::WORDS.into_iter();
        let entry = words.find(|(name, _)| *name == word);
        entry.map_or(Scale::Actuator, |(_, scale)| scale)
    })
}
