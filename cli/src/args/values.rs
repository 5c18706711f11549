//! How values are read.
//!
//! Clap lists the names and suggests the nearest for a slip. Numbers may begin
//! with a hyphen, or clap would take a negative one for an option that it does
//! not know: what a number should be is ours to say.

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

pub fn lock_parser() -> impl TypedValueParser<Value = (String, String)> {
    StringValueParser::new().try_map(|text| match text.rsplit_once('=') {
        Some(("*", value)) => Err(format!("write --lock-others {value}")),
        Some((joint, value)) if !joint.is_empty() && !value.is_empty() => {
            Ok((joint.to_owned(), value.to_owned()))
        }
        _ => Err("a joint and its position, such as elbow=0 or elbow=pi/2".to_owned()),
    })
}

pub fn acceleration_parser() -> impl TypedValueParser<Value = Rational> {
    StringValueParser::new().try_map(|text| {
        let number = parse_decimal(text.trim()).ok();
        number
            .filter(Signed::is_positive)
            .ok_or("a limit of acceleration is a number above zero, such as 10")
    })
}

/// Reads the name of a robot or a module, as robot files have it.
pub fn name_parser() -> impl TypedValueParser<Value = String> {
    StringValueParser::new().try_map(|text| match suggested_name(&text) {
        Some(good) if good == text => Ok(text),
        Some(good) => Err(format!(
            "a name has lower-case letters, digits and `_`: write {good}"
        )),
        None => Err("a name has lower-case letters, digits and `_`, a letter first".to_owned()),
    })
}

/// Returns a value by its word, of which clap lists all and suggests one.
pub fn word_parser<W: Word + Send + Sync + 'static>() -> impl TypedValueParser<Value = W> {
    PossibleValuesParser::new(W::known()).try_map(|word| parse::<W>(&word))
}

/// Reads the path of what is certified; a model of a robot is refused, which has an argument of its own.
pub fn certified_parser() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        match path.extension().and_then(OsStr::to_str) {
            Some("toml" | "urdf" | "xacro" | "xml") => Err(format!(
                "expected a certificate (.json) or a generated file (.rs, .h, .cuh), found a robot: write \
                 `dalembert certify FILE --robot {}`",
                path.display()
            )),
            _ => Ok(path),
        }
    })
}

pub fn positive_parser() -> impl TypedValueParser<Value = f64> {
    StringValueParser::new().try_map(|text| {
        let number = text.parse::<f64>().ok();
        number
            .filter(|number| *number > 0.0 && number.is_finite())
            .ok_or("a tolerance is a number above zero, such as 1e-3")
    })
}

pub fn states_parser() -> impl TypedValueParser<Value = usize> {
    /// The most states that are measured.
    const MAX_STATES: i64 = 10_000;
    clap::value_parser!(i64)
        .range(1..=MAX_STATES)
        .map(|states| states as usize)
}

pub fn scale_parser() -> impl TypedValueParser<Value = Scale> {
    PossibleValuesParser::new(Scale::WORDS.map(|(word, _)| word)).map(|word| {
        let mut words = Scale::WORDS.into_iter();
        let found = words.find(|(own, _)| *own == word);
        found.map_or(Scale::Actuator, |(_, scale)| scale)
    })
}
