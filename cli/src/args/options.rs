//! The options of one word, as arguments: from the table that macro and build script share.

use clap::builder::PossibleValuesParser;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use dalembert_codegen::workspace::task::{Purpose, Request, WordOption};

use super::{CODE, SEARCH};

/// What was chosen of the options that say what a file holds (`OF_TEXT`), or of the others.
#[derive(Clone, Debug, Default)]
pub struct Options<const OF_TEXT: bool>(Vec<(&'static WordOption, String)>);

impl<const OF_TEXT: bool> Options<OF_TEXT> {
    /// Sets them in a request.
    pub fn set(&self, request: &mut Request) {
        for (option, word) in &self.0 {
            // Clap has taken no other words.
            let _ = (option.set)(request, word);
        }
    }

    /// Returns whether the option of this word is on the command line.
    pub fn is_given(&self, word: &str) -> bool {
        self.0.iter().any(|(option, _)| option.word == word)
    }

    fn table() -> impl Iterator<Item = &'static WordOption> {
        let of_text = |option: &WordOption| match option.purpose {
            Purpose::Text | Purpose::File => true,
            Purpose::Search | Purpose::Code => false,
        };
        let all = WordOption::ALL.iter();
        all.filter(move |option| of_text(option) == OF_TEXT)
    }
}

impl<const OF_TEXT: bool> FromArgMatches for Options<OF_TEXT> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut options = Self::default();
        options.update_from_arg_matches(matches)?;
        Ok(options)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        for option in Self::table() {
            // Defaults are those of a request.
            let is_given = matches.value_source(option.word) == Some(ValueSource::CommandLine);
            let word = matches.get_one::<String>(option.word).filter(|_| is_given);
            self.0.extend(word.map(|word| (option, word.clone())));
        }
        Ok(())
    }
}

impl<const OF_TEXT: bool> Args for Options<OF_TEXT> {
    fn augment_args(command: Command) -> Command {
        Self::table().fold(command, |command, option| command.arg(arg(option)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

fn arg(option: &'static WordOption) -> Arg {
    let known = (option.known)();
    let arg = Arg::new(option.word)
        .long(option.word)
        .value_name("WORD")
        .value_parser(PossibleValuesParser::new(&known))
        .help(option.doc.trim())
        .help_heading(match option.purpose {
            Purpose::Search => SEARCH,
            Purpose::Code | Purpose::Text | Purpose::File => CODE,
        });
    match known.as_slice() {
        // Named alone it is on, and takes no word that follows.
        ["off", ..] => arg
            .num_args(0..=1)
            .require_equals(true)
            .default_missing_value("on"),
        [first, ..] => arg.default_value(*first),
        [] => arg,
    }
}
