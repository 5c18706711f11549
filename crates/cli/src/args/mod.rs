//! Arguments of several subcommands: the options of a request, from the table that macro, build script
//! and files share, and how values are read. A subcommand's own arguments stand beside its code.

pub mod values;

use std::ffi::OsStr;
use std::path::PathBuf;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use dalembert_codegen::{Asked, OPTIONS, OptionRow, Purpose};
use dalembert_import::ChainArgs;

/// The help heading of the options for the code.
pub const CODE: &str = "Code options";
const SEARCH: &str = "Search options";

/// A robot and the options of a request.
#[derive(Debug, clap::Args)]
pub struct TaskArgs {
    /// The robot: a robot file, a URDF or an MJCF
    pub robot: PathBuf,
    #[command(flatten)]
    pub options: Options,
    #[command(flatten)]
    pub chain: ChainArgs,
}

/// All options of the table, or the few of the subcommands that print no code.
#[derive(Clone, Debug, Default)]
pub struct Options<const ALL: bool = true>(pub Asked);

const FEW: [&str; 3] = ["outputs", "scene", "effort"];

impl<const ALL: bool> Options<ALL> {
    fn rows() -> impl Iterator<Item = &'static OptionRow> {
        OPTIONS.iter().filter(|row| ALL || FEW.contains(&row.name))
    }
}

impl<const ALL: bool> FromArgMatches for Options<ALL> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut options = Self::default();
        options.update_from_arg_matches(matches)?;
        Ok(options)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        let is_given =
            |row: &&OptionRow| matches.value_source(row.name) == Some(ValueSource::CommandLine);
        for row in Self::rows().filter(is_given) {
            let matched = matches.get_many::<String>(row.name).into_iter();
            let values: Vec<&str> = matched.flatten().map(String::as_str).collect();
            // This cannot fail: the name is in the table.
            let _ = self.0.set(row.name, &values.join(","));
        }
        Ok(())
    }
}

impl<const ALL: bool> Args for Options<ALL> {
    fn augment_args(command: Command) -> Command {
        Self::rows().fold(command, |command, row| command.arg(arg(row)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// Accepts any text: only the parser of requests refuses unknown words.
#[derive(Clone)]
struct Words(fn() -> Vec<&'static str>);

impl TypedValueParser for Words {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, Error> {
        let words = self.0;
        let text = StringValueParser::new().try_map(move |text| match text.trim() {
            "" => Err(match words().first() {
                Some(word) => format!("expected a word, such as `{word}`"),
                None => "expected a value".to_owned(),
            }),
            _ => Ok(text),
        });
        text.parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let words = (self.0)();
        (!words.is_empty()).then(|| {
            Box::new(words.into_iter().map(PossibleValue::new)) as Box<dyn Iterator<Item = _>>
        })
    }
}

/// Writes the options that a message names as flags: `sincos: libm` as `--sincos libm`.
pub fn as_flags(message: &str) -> String {
    OPTIONS.iter().fold(message.to_owned(), |text, row| {
        let flag = format!("`--{} ", row.name.replace('_', "-"));
        text.replace(&format!("`{}: ", row.name), &flag)
    })
}

fn arg(row: &'static OptionRow) -> Arg {
    let words = (row.words)();
    let value = match (row.is_list, words.is_empty()) {
        (true, _) => "NAMES",
        (false, true) if row.name.ends_with("error") => "ERROR",
        (false, true) => "NAME",
        (false, false) => "WORD",
    };
    let is_long = words.len() > 9;
    let doc = match is_long {
        true => format!("{}; `dalembert outputs` lists them", row.doc),
        false => row.doc.to_owned(),
    };
    let arg = Arg::new(row.name)
        .long(row.name.replace('_', "-"))
        .value_name(value)
        .value_parser(Words(row.words))
        .allow_hyphen_values(row.name == "sincos_error")
        .hide_possible_values(is_long)
        .help(doc);
    let arg = match row.purpose {
        Purpose::What => arg,
        Purpose::Search => arg.help_heading(SEARCH),
        Purpose::Code => arg.help_heading(CODE),
    };
    let arg = match row.is_list {
        true => arg.action(ArgAction::Append),
        false => arg,
    };
    match words.as_slice() {
        // Without a value it is on; a value needs `=`.
        ["off", "on"] => arg
            .num_args(0..=1)
            .require_equals(true)
            .default_missing_value("on"),
        [first, ..] if !row.is_list => arg.default_value(*first),
        _ => arg,
    }
}
