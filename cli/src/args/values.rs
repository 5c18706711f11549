//! How values are read.
//!
//! Clap lists the names and suggests the nearest for a slip. Numbers may begin
//! with a hyphen, or clap would take a negative one for an option that it does
//! not know: what a number should be is ours to say.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, StringValueParser, TypedValueParser};
use dalembert_codegen::workspace::clauses::words::bundle;
use dalembert_codegen::workspace::emit::Interface;
use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::Prefer;
use dalembert_codegen::workspace::language::{Entries, Language};
use dalembert_codegen::workspace::portfolio::Start;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::simplify::Effort;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_report::processor::target::{TARGETS, Target};

pub(super) fn lock_parser() -> impl TypedValueParser<Value = (String, String)> {
    StringValueParser::new().try_map(|text| match text.rsplit_once('=') {
        Some((joint, value)) if !joint.is_empty() && !value.is_empty() => {
            Ok((joint.to_owned(), value.to_owned()))
        }
        _ => Err("a joint and its position, such as elbow=0 or elbow=pi/2"),
    })
}

/// An output by its name, of which clap lists all and suggests one, or one at a frame or a
/// bundle of some, which none of its lists can have.
#[derive(Clone)]
pub(super) struct FunctionParser;

impl TypedValueParser for FunctionParser {
    type Value = Function;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Function, clap::Error> {
        let is_bundle = value.to_string_lossy().contains(['=', '+', '@', ':']);
        if is_bundle {
            let bundles = StringValueParser::new().try_map(|text| bundle(&text));
            return bundles.parse_ref(command, argument, value);
        }
        let names = PossibleValuesParser::new(Function::ALL.map(Function::name));
        let functions = names.try_map(|name| Function::parse(&name));
        functions.parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = Function::ALL.into_iter().map(Function::name);
        Some(Box::new(names.map(PossibleValue::new)))
    }
}

pub(super) fn function_parser() -> FunctionParser {
    FunctionParser
}

pub(super) fn start_parser() -> impl TypedValueParser<Value = Start> {
    PossibleValuesParser::new(Start::all().map(Start::name))
        .try_map(|name| Start::from_name(&name).ok_or("no such formulation"))
}

pub(super) fn scalar_parser() -> impl TypedValueParser<Value = ScalarType> {
    let names = PossibleValuesParser::new(ScalarType::ALL.map(ScalarType::name));
    names.try_map(|name| ScalarType::from_name(&name).ok_or("no such scalar"))
}

pub(super) fn sincos_parser() -> impl TypedValueParser<Value = SinCos> {
    PossibleValuesParser::new(SinCos::NAMES)
        .try_map(|name| SinCos::from_name(&name).ok_or("no such source of sines"))
}

pub(super) fn error_parser() -> impl TypedValueParser<Value = f64> {
    StringValueParser::new().try_map(|text| match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error < 1.0 => Ok(error),
        _ => Err("an error is a number above 0 and below 1, such as 1e-9"),
    })
}

pub(super) fn tolerance_parser() -> impl TypedValueParser<Value = f64> {
    StringValueParser::new().try_map(|text| {
        text.parse::<f64>()
            .map_err(|_| "a tolerance is a number above zero, such as 1e-3")
    })
}

pub(super) fn count_parser() -> impl TypedValueParser<Value = usize> {
    StringValueParser::new().try_map(|text| {
        text.parse::<usize>()
            .map_err(|_| "a whole number, 0 or more")
    })
}

pub(super) fn positive_parser() -> impl TypedValueParser<Value = f64> {
    StringValueParser::new().try_map(|text| {
        let number = text.parse::<f64>().ok();
        number
            .filter(|number| *number > 0.0 && number.is_finite())
            .ok_or("a tolerance is a number above zero")
    })
}

pub(super) fn states_parser() -> impl TypedValueParser<Value = usize> {
    let most = dalembert_report::explain::errors::MAX_STATES as i64;
    clap::value_parser!(i64)
        .range(1..=most)
        .map(|states| states as usize)
}

pub(super) fn prefer_parser() -> impl TypedValueParser<Value = Prefer> {
    let names = PossibleValuesParser::new(Prefer::ALL.map(Prefer::name));
    names.try_map(|name| {
        let mut all = Prefer::ALL.into_iter();
        all.find(|prefer| prefer.name() == name)
            .ok_or("no such preference")
    })
}

pub(super) fn parameter_parser() -> impl TypedValueParser<Value = RuntimeParameter> {
    let names = PossibleValuesParser::new(RuntimeParameter::ALL.map(RuntimeParameter::name));
    names.try_map(|name| {
        let mut all = RuntimeParameter::ALL.into_iter();
        all.find(|parameter| parameter.name() == name)
            .ok_or("no such parameter")
    })
}

pub(super) fn entries_parser() -> impl TypedValueParser<Value = Entries> {
    let names = PossibleValuesParser::new(Entries::ALL.map(Entries::name));
    names.try_map(|name| {
        let mut all = Entries::ALL.into_iter();
        all.find(|entries| entries.name() == name)
            .ok_or("no such entries")
    })
}

pub(super) fn language_parser() -> impl TypedValueParser<Value = Language> {
    let names = PossibleValuesParser::new(Language::ALL.map(Language::name));
    names.try_map(|name| {
        let mut all = Language::ALL.into_iter();
        all.find(|language| language.name() == name)
            .ok_or("no such language")
    })
}

pub(super) fn interface_parser() -> impl TypedValueParser<Value = Interface> {
    let names = PossibleValuesParser::new(Interface::ALL.map(Interface::name));
    names.try_map(|name| {
        let mut all = Interface::ALL.into_iter();
        all.find(|interface| interface.name() == name)
            .ok_or("no such interface")
    })
}

pub(super) fn target_parser() -> impl TypedValueParser<Value = &'static Target> {
    let names = PossibleValuesParser::new(TARGETS.iter().map(|target| target.name));
    names.try_map(|name| {
        let mut all = TARGETS.iter();
        all.find(|target| target.name == name)
            .ok_or("no such processor")
    })
}

pub(super) fn effort_parser() -> impl TypedValueParser<Value = Effort> {
    let names = PossibleValuesParser::new(Effort::ALL.map(Effort::name));
    names.try_map(|name| {
        let mut all = Effort::ALL.into_iter();
        all.find(|effort| effort.name() == name)
            .ok_or("no such effort")
    })
}
