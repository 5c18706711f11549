//! The options that somebody asked for: `outputs: inverse_dynamics, gravity; scalar: f64`.

use std::fmt;
use std::path::{Path, PathBuf};

/// The options by their names, in the order in which they are written, and the word of each that
/// means as much as leaving it out.
pub const OPTIONS: [(&str, &str); 16] = [
    ("outputs", ""),
    ("scalar", ""),
    ("formulation", "auto"),
    ("effort", "quick"),
    ("prefer", "accuracy"),
    ("fma", "off"),
    ("limbs", "auto"),
    ("sincos", "auto"),
    ("sincos_error", ""),
    ("batch", "off"),
    ("parameters", ""),
    ("bodies", ""),
    ("keep_zeros", "off"),
    ("scene", ""),
    ("plan", "on"),
    ("name", ""),
];

/// The options that were asked for, each with its value, in the order of [`OPTIONS`].
///
/// Values are lists of items without spaces; what means as much as nothing is left out, so that
/// two that ask for the same are equal.
///
/// ```
/// use dalembert_stamp::Asked;
///
/// let asked: Asked = "scalar: f64; fma: off; outputs: gravity, hold = inertia + gravity".parse().unwrap();
/// assert_eq!(asked.to_string(), "outputs: gravity, hold=inertia+gravity; scalar: f64");
/// assert_eq!(asked.get("scalar"), Some("f64"));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Asked(Vec<(&'static str, String)>);

/// No option of this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NotAsked(pub String);

impl NotAsked {
    /// Returns the likely fix.
    pub fn help(&self) -> String {
        let names: Vec<&str> = OPTIONS.iter().map(|(name, _)| *name).collect();
        match names.iter().find(|name| is_near(name, &self.0)) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("known: {}", names.join(", ")),
        }
    }
}

impl fmt::Display for NotAsked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown option `{}`: {}", self.0, self.help())
    }
}

fn is_near(name: &str, word: &str) -> bool {
    let (one, other) = (name.as_bytes(), word.as_bytes());
    let before = one.iter().zip(other).take_while(|(a, b)| a == b).count();
    let reversed = one.iter().rev().zip(other.iter().rev());
    let behind = reversed.take_while(|(a, b)| a == b).count();
    let longest = one.len().max(other.len());
    longest > 1 && before + behind + 1 >= longest && one.len().abs_diff(other.len()) <= 1
}

/// Returns the end of the name of a file or module in Rust: `_f32` for that scalar of a pair.
pub fn suffix(scalar: &str, is_pair: bool) -> &'static str {
    let is_second = is_pair && scalar == "f32";
    if is_second { "_f32" } else { "" }
}

/// Returns the path of a file with the [`suffix`] of its scalar: `arm_f32.rs` beside `arm.rs`.
pub fn beside(path: &Path, suffix: &str) -> PathBuf {
    let base = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{base}{suffix}.{ending}"))
}

/// Returns the items of a value that are not empty, with spaces between words alone.
pub fn items(value: &str) -> impl Iterator<Item = String> + '_ {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let items = value.split(',').map(move |item| {
        item.split_whitespace()
            .fold(String::new(), |mut text, part| {
                if text.ends_with(is_word) && part.starts_with(is_word) {
                    text.push(' ');
                }
                text + part
            })
    });
    items.filter(|item| !item.is_empty())
}

impl Asked {
    /// Sets an option to a list of items with commas between them; to none where there is no item,
    /// or one that means as much.
    ///
    /// # Errors
    /// There is no option of this name.
    pub fn set(&mut self, option: &str, value: &str) -> Result<(), NotAsked> {
        let entry = OPTIONS.iter().find(|(name, _)| *name == option);
        let (name, default) = entry.ok_or_else(|| NotAsked(option.to_owned()))?;
        let value = items(value).collect::<Vec<String>>().join(", ");
        self.0.retain(|(key, _)| key != name);
        if !value.is_empty() && value != *default {
            let place = |name: &str| OPTIONS.iter().position(|(key, _)| *key == name);
            self.0.push((name, value));
            self.0.sort_by_key(|(key, _)| place(key));
        }
        Ok(())
    }

    /// Returns the value of an option; none where it was not asked for.
    pub fn get(&self, option: &str) -> Option<&str> {
        self.iter()
            .find_map(|(name, value)| (name == option).then_some(value))
    }

    /// Returns the items of an option's value.
    pub fn items(&self, option: &str) -> Vec<&str> {
        self.get(option)
            .map_or_else(Vec::new, |value| value.split(", ").collect())
    }

    /// Returns the options that were asked for, with their values.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let options = self.0.iter();
        options.map(|(option, value)| (*option, value.as_str()))
    }

    /// Returns the options of each file in Rust, which has one scalar, and the end of its name before
    /// the extension. Without a scalar that is f64, or the scene's own.
    pub fn by_scalar(&self) -> Vec<(&'static str, Asked)> {
        let mut scalars = self.items("scalar");
        if scalars.is_empty() {
            scalars.push(self.get("scene").map_or("f64", |_| ""));
        }
        let is_pair = scalars.len() > 1;
        let one = |scalar: &str| {
            let mut asked = self.clone();
            // It is an option.
            let _ = asked.set("scalar", scalar);
            (suffix(scalar, is_pair), asked)
        };
        scalars.into_iter().map(one).collect()
    }

    /// Returns the options as arguments of the command: ` --outputs gravity,inertia --scalar f64`.
    pub fn arguments(&self) -> String {
        let argument = |(option, value): (&str, &str)| {
            let (flag, value) = (option.replace('_', "-"), value.replace(", ", ","));
            match value.as_str() {
                "on" => format!(" --{flag}"),
                value => format!(" --{flag} {value}"),
            }
        };
        self.iter().map(argument).collect()
    }
}

impl fmt::Display for Asked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |(option, value): (&str, &str)| format!("{option}: {value}");
        f.write_str(&self.iter().map(shown).collect::<Vec<String>>().join("; "))
    }
}

impl std::str::FromStr for Asked {
    type Err = NotAsked;

    fn from_str(text: &str) -> Result<Asked, NotAsked> {
        let mut asked = Asked::default();
        let options = text.split(';').map(str::trim);
        for option in options.filter(|option| !option.is_empty()) {
            let (name, value) = option.split_once(':').unwrap_or((option, ""));
            asked.set(name.trim(), value)?;
        }
        Ok(asked)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_reads_back() {
        let text =
            "scene: pick; outputs: jacobian @ hand : local , servo = gravity + inertia; fma: on";
        let asked: Asked = text.parse().unwrap();
        let written = "outputs: jacobian@hand:local, servo=gravity+inertia; fma: on; scene: pick";
        assert_eq!(asked.to_string(), written);
        assert_eq!(written.parse(), Ok(asked.clone()));
        let arguments = " --outputs jacobian@hand:local,servo=gravity+inertia --fma --scene pick";
        assert_eq!(asked.arguments(), arguments);
        assert_eq!(asked.items("outputs").len(), 2);
    }

    #[test]
    fn each_file_in_rust_has_a_scalar() {
        let file = |(suffix, asked): (&str, Asked)| format!("{suffix} {asked}");
        let files = |text: &str| {
            let asked: Asked = text.parse().unwrap();
            asked.by_scalar().into_iter().map(file).collect::<Vec<_>>()
        };
        assert_eq!(files(""), [" scalar: f64"]);
        assert_eq!(files("scalar: f32"), [" scalar: f32"]);
        assert_eq!(files("scene: pick"), [" scene: pick"]);
        let pair = [" scalar: f64", "_f32 scalar: f32"];
        assert_eq!(files("scalar: f64, f32"), pair);
    }

    #[test]
    fn defaults_are_left_out() {
        for (option, default) in OPTIONS {
            let mut asked = Asked::default();
            asked.set(option, default).unwrap();
            assert_eq!(asked, Asked::default(), "{option}");
        }
    }
}
