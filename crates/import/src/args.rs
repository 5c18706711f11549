//! The options that choose a chain of a model, as commands take them and generated files keep them.

use std::fmt;

use dalembert_model::robot::values::one_line;

use crate::Options;
use crate::select::OTHERS;

/// The options that choose the chain of a URDF or an MJCF; none of them is for a robot file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct ChainArgs {
    /// The base link of a URDF or an MJCF, which does not move unless it floats [default: the root]
    #[cfg_attr(feature = "clap", arg(long, value_name = "LINK", help_heading = MODEL))]
    pub base: Option<String>,
    /// The link whose frame is the hand [default: the palm, or the end of the longest chain]; given
    /// several times, the joints on the ways to all of them
    #[cfg_attr(feature = "clap", arg(long, value_name = "LINK", help_heading = MODEL))]
    pub tip: Vec<String>,
    /// Take every joint that moves: arms on a torso, fingers on a hand
    #[cfg_attr(feature = "clap", arg(long, conflicts_with = "tip", help_heading = MODEL))]
    pub tree: bool,
    /// Let the base float: a legged robot. Takes every joint that moves, or those on the ways to the tips;
    /// what a free joint carries in the model floats unasked, if it has several limbs or with --tree
    #[cfg_attr(feature = "clap", arg(long, help_heading = MODEL))]
    pub floating: bool,
    /// Lock a joint at a position in rad or m, such as 0.3, pi/2 or 90deg; JOINT is its name or its
    /// number among the moving joints; may be given several times
    #[cfg_attr(feature = "clap", arg(long, value_name = "JOINT=VALUE", value_parser = lock, help_heading = MODEL))]
    pub lock: Vec<(String, String)>,
    /// Lock every other joint attached to the chain at this position, or at its nearest limit
    #[cfg_attr(feature = "clap", arg(long, value_name = "VALUE", allow_hyphen_values = true, help_heading = MODEL))]
    pub lock_others: Option<String>,
    /// Leave out a link and everything attached to it; may be given several times
    #[cfg_attr(feature = "clap", arg(long, value_name = "LINK", help_heading = MODEL))]
    pub without: Vec<String>,
    /// Leave out tendons, loops and equality constraints, which links that hang on each other cannot have
    #[cfg_attr(feature = "clap", arg(long, help_heading = MODEL))]
    pub ignore_ties: bool,
}

#[cfg(feature = "clap")]
const MODEL: &str = "Options for a URDF or an MJCF";

fn lock(text: &str) -> Result<(String, String), String> {
    match text.rsplit_once('=') {
        Some(("*", value)) => Err(format!("write --lock-others {value}")),
        Some((joint, value)) if !joint.is_empty() && !value.is_empty() => {
            Ok((joint.to_owned(), value.to_owned()))
        }
        _ => Err("a joint and its position, such as elbow=0 or elbow=pi/2".to_owned()),
    }
}

impl ChainArgs {
    /// Returns the options of an import with this chain; the rest is that of `options`.
    pub fn choose(&self, options: Options) -> Options {
        let to_others = |value: &String| (OTHERS.to_owned(), value.clone());
        let others = self.lock_others.iter().map(to_others);
        Options {
            base: self.base.clone(),
            tips: self.tip.clone(),
            tree: self.tree,
            floating: self.floating,
            lock: self.lock.iter().cloned().chain(others).collect(),
            without: self.without.clone(),
            ignore_ties: self.ignore_ties,
            ..options
        }
    }

    /// Returns the options that are set, each with its value: `("lock", "elbow=0")`.
    pub fn pairs(&self) -> Vec<(String, String)> {
        let lock = |(joint, at): &(String, String)| format!("{joint}={at}");
        let locks: Vec<String> = self.lock.iter().map(lock).collect();
        let set = [self.tree, self.floating, self.ignore_ties];
        let [tree, floating, ties] = set.map(|is_set| is_set.then(String::new));
        let options: [(&str, &[String]); 8] = [
            ("base", self.base.as_slice()),
            ("tip", &self.tip),
            ("tree", tree.as_slice()),
            ("floating", floating.as_slice()),
            ("lock", &locks),
            ("lock-others", self.lock_others.as_slice()),
            ("without", &self.without),
            ("ignore-ties", ties.as_slice()),
        ];
        let pairs = options.iter().flat_map(|(option, values)| {
            let values = values.iter();
            values.map(move |value| ((*option).to_owned(), value.clone()))
        });
        pairs.collect()
    }

    /// Reads what [`ChainArgs::pairs`] returns; `None` if an option is not known.
    pub fn from_pairs(pairs: &[(String, String)]) -> Option<ChainArgs> {
        let mut args = ChainArgs::default();
        for (option, value) in pairs {
            let value = value.clone();
            match option.as_str() {
                "base" => args.base = Some(value),
                "tip" => args.tip.push(value),
                "tree" => args.tree = true,
                "floating" => args.floating = true,
                "lock" => args.lock.push(lock(&value).ok()?),
                "lock-others" => args.lock_others = Some(value),
                "without" => args.without.push(value),
                "ignore-ties" => args.ignore_ties = true,
                _ => return None,
            }
        }
        Some(args)
    }
}

/// Formats the options as command-line arguments: `--tip tool0 --lock elbow=0`.
impl fmt::Display for ChainArgs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let argument = |(option, value): (String, String)| match value.is_empty() {
            true => format!("--{option}"),
            false => format!("--{option} {value}"),
        };
        let arguments: Vec<String> = self.pairs().into_iter().map(argument).collect();
        f.write_str(&one_line(&arguments.join(" ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_set_reads_back() {
        let args = ChainArgs {
            tip: vec!["left".to_owned(), "right".to_owned()],
            tree: true,
            floating: true,
            lock: vec![("elbow".to_owned(), "pi/2".to_owned())],
            lock_others: Some("-0.1".to_owned()),
            without: vec!["left".to_owned(), "right".to_owned()],
            ignore_ties: true,
            ..ChainArgs::default()
        };
        assert_eq!(ChainArgs::from_pairs(&args.pairs()), Some(args.clone()));
        let shown = "--tip left --tip right --tree --floating --lock elbow=pi/2 --lock-others -0.1 --without left --without right --ignore-ties";
        assert_eq!(args.to_string(), shown);
        assert!(ChainArgs::default().pairs().is_empty());
        let unknown = [("top".to_owned(), String::new())];
        assert_eq!(ChainArgs::from_pairs(&unknown), None);
        let locks = args.choose(Options::default()).lock;
        assert_eq!(locks[1], ("*".to_owned(), "-0.1".to_owned()));
    }
}
