//! Verified robot dynamics in a build script: a robot file in, a Rust file out.
//!
//! In `build.rs`:
//!
//! ```no_run
//! use dalembert_build::{BuildError, Generator};
//!
//! fn main() -> Result<(), BuildError> {
//!     Generator::new("robots/puma560.toml")
//!         .ask("outputs", "inverse_dynamics, gravity")
//!         .write_to("src/puma560.rs")
//! }
//! ```
//!
//! And in the crate, which needs `libm` for the generated code:
//!
//! ```text
//! mod puma560;
//!
//! let tau = puma560::inverse_dynamics(&q, &qd, &qdd);
//! ```
//!
//! The file can be checked in. Its first lines say of which robot file it was generated and what was
//! asked, so that nothing is generated as long as both are the same, and the text is as it was
//! written. Without the feature `search`, which is on by default, the script compiles in a second and
//! refuses a stale file by the command that makes it new.
//!
//! # Options
//!
//! The options are those of `dynamics!` and of the command: a name and a list of items.
//!
//! ```no_run
//! # use dalembert_build::{BuildError, Generator};
//! # fn main() -> Result<(), BuildError> {
//! Generator::new("robots/puma560.toml")
//!     .ask("outputs", "servo = inverse_dynamics + jacobian, gravity")
//!     .ask("scalar", "f64, f32")
//!     .ask("sincos", "together")
//!     .ask("parameters", "payload")
//!     .write_to("src/puma560.rs")
//! # }
//! ```
//!
//! Two scalars are two files, `puma560.rs` and `puma560_f32.rs`. `.ask("scene", "pick")` takes a scene
//! of the robot file, with its outputs and its scalar. A file that ends in `.h` is C, one in `.cuh` CUDA.
//!
//! # A file that nobody sees
//!
//! [`Generator::write_to_out_dir`] writes modules for `include!`, called after the file:
//!
//! ```text
//! include!(concat!(env!("OUT_DIR"), "/arm.rs"));
//!
//! let tau = arm::inverse_dynamics(&q, &qd, &qdd);
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod cargo;

use std::env;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

pub use dalembert_stamp::Asked;
use dalembert_stamp::{Comment, Stale, Stamp, beside, hash, write_whole};
#[cfg(feature = "search")]
use dalembert_stamp::{refusal, relative};

/// A robot file, and the options that were asked for.
#[derive(Clone, Debug)]
pub struct Generator {
    robot: PathBuf,
    asked: Asked,
    unknown: Vec<String>,
}

/// The mistakes for which nothing was written, each with the likely fix.
pub struct BuildError(pub Vec<String>);

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines = self.0.iter().map(|message| format!("error: {message}"));
        f.write_str(&lines.collect::<Vec<String>>().join("\n\n"))
    }
}

/// As [`Display`](fmt::Display), since `main` and `unwrap` print a build script's errors with this.
impl fmt::Debug for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for BuildError {}

fn one(message: String) -> BuildError {
    BuildError(vec![message])
}

impl Generator {
    /// Begins with a robot file, relative to the package, and nothing asked: the outputs that the
    /// file names, or the seven that a controller calls, in f64.
    pub fn new(robot: impl Into<PathBuf>) -> Generator {
        Generator {
            robot: robot.into(),
            asked: Asked::default(),
            unknown: Vec::new(),
        }
    }

    /// Asks for an option: its name, and a word or a list of items with commas between.
    #[must_use]
    pub fn ask(mut self, option: &str, value: &str) -> Generator {
        if let Err(error) = self.asked.set(option, value) {
            self.unknown.push(error.to_string());
        }
        self
    }

    /// Writes the file into `OUT_DIR`, with a module for each scalar, for `include!`.
    ///
    /// # Errors
    /// [`BuildError`]; a file that was there stays as it was.
    pub fn write_to_out_dir(&self, file_name: impl AsRef<Path>) -> Result<(), BuildError> {
        let folder = env::var_os("OUT_DIR").ok_or_else(|| {
            one("`OUT_DIR` is not set: call this from a build script, or `write_to`".into())
        })?;
        let path = Path::new(&folder).join(file_name);
        let source = self.source(&path)?;
        let old_text = fs::read_to_string(&path).ok();
        if Stamp::check(old_text.as_deref(), VERSION, &source, &self.asked).is_ok() {
            return Ok(());
        }
        let base = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut text = String::new();
        for (suffix, code, _) in self.generated(&path)? {
            text += &format!("#[rustfmt::skip]\npub mod {base}{suffix} {{\n{code}}}\n");
        }
        let stamp = Stamp {
            version: VERSION.to_owned(),
            robot: self.robot.display().to_string(),
            robot_hash: hash(&source),
            chain: Vec::new(),
            asked: self.asked.clone(),
        };
        write(&path, &stamp.write(Comment::Line, &text))
    }

    /// Writes the file to a path, so that it can be checked in and read in review; the second of two
    /// scalars to one that ends in `_f32`. Nothing is generated if the files are there already,
    /// unchanged, from the same robot file and with what is asked.
    ///
    /// # Errors
    /// [`BuildError`], also for a file that was edited, or that dalembert did not write; a file that
    /// was there stays as it was.
    pub fn write_to(&self, path: impl AsRef<Path>) -> Result<(), BuildError> {
        let path = path.as_ref();
        let source = self.source(path)?;
        let is_rust = path.extension().is_some_and(|ending| ending == "rs");
        let files = match is_rust {
            true => self.asked.by_scalar(),
            false => vec![("", self.asked.clone())],
        };
        for (suffix, asked) in files {
            let file = beside(path, suffix);
            let old_text = fs::read_to_string(&file).ok();
            if let Err(why) = Stamp::check(old_text.as_deref(), VERSION, &source, &asked) {
                return self.renew(path, &file, why);
            }
        }
        Ok(())
    }

    fn source(&self, output: &Path) -> Result<String, BuildError> {
        if !self.unknown.is_empty() {
            return Err(BuildError(self.unknown.clone()));
        }
        cargo::watch(&self.robot, output);
        match fs::read(&self.robot) {
            Ok(bytes) => Ok(String::from_utf8_lossy(&bytes).into_owned()),
            // The generator explains better what is wrong with the file.
            #[cfg(feature = "search")]
            Err(_) => self.generated(output).map(|_| String::new()),
            #[cfg(not(feature = "search"))]
            Err(error) => {
                let robot = self.robot.display();
                Err(one(format!("cannot read `{robot}`: {error}")))
            }
        }
    }

    #[cfg(not(feature = "search"))]
    fn renew(&self, path: &Path, file: &Path, why: Stale) -> Result<(), BuildError> {
        let (robot, stale) = (self.robot.display().to_string(), file.display().to_string());
        let command = format!(
            "dalembert generate {robot}{} -o {}",
            self.asked.arguments(),
            path.display()
        );
        let message = why.message(&stale, &robot);
        Err(one(format!("{message}\n  = help: {command}")))
    }

    #[cfg(feature = "search")]
    fn renew(&self, path: &Path, _: &Path, _: Stale) -> Result<(), BuildError> {
        let generated = self.generated(path)?.into_iter();
        let files: Vec<(PathBuf, String)> = generated
            .map(|(suffix, _, text)| (beside(path, suffix), text))
            .collect();
        let kept: Vec<String> = files.iter().filter_map(|(file, _)| kept(file)).collect();
        if !kept.is_empty() {
            return Err(BuildError(kept));
        }
        files.iter().try_for_each(|(file, text)| write(file, text))
    }

    #[cfg(not(feature = "search"))]
    fn generated(&self, _: &Path) -> Result<Vec<Text>, BuildError> {
        let robot = self.robot.display();
        Err(one(format!(
            "`OUT_DIR` has no code of `{robot}`, and generating it needs the feature `search`\n  = help: \
             turn it on, or check the file in and call `write_to`"
        )))
    }

    #[cfg(feature = "search")]
    fn generated(&self, path: &Path) -> Result<Vec<Text>, BuildError> {
        use dalembert_codegen::{Diagnostic, Language, Place, RobotFile, ask};
        let language = Language::of(path).map_err(|known| {
            one(format!(
                "`{}` does not end as a file of any language does\n  = help: {known}",
                path.display()
            ))
        })?;
        let shown = self.robot.display().to_string();
        let file = RobotFile::read(&self.robot).map_err(|errors| {
            let plain = |error: &Diagnostic| error.render_plain().trim_end().to_owned();
            BuildError(errors.0.iter().map(plain).collect())
        })?;
        let made = ask(&file, &self.asked, language, &shown).map_err(|problems| {
            let of = |problem: &Diagnostic| match &problem.place {
                Place::None => format!("{shown}: {}", problem.message),
                _ => problem.to_string(),
            };
            BuildError(problems.0.iter().map(of).collect())
        })?;
        made.warnings.iter().for_each(|said| cargo::warn(said));
        let robot = relative(&self.robot, path);
        let files = made.generated.files(&made.request, &robot, &file.source);
        let suffixes = made.generated.suffixes().into_iter();
        let texts = suffixes.zip(made.generated.texts).zip(files);
        Ok(texts
            .map(|((suffix, text), file)| (suffix, text, file))
            .collect())
    }
}

/// Returns why a file must not be replaced.
#[cfg(feature = "search")]
fn kept(file: &Path) -> Option<String> {
    let bytes = fs::read(file).unwrap_or_default();
    let edited = "was edited since dalembert wrote it";
    let why = refusal(&bytes, edited, "was not written by dalembert")?;
    let (file, help) = (file.display(), "delete it, or write to another file");
    Some(format!("`{file}` {why}\n  = help: {help}"))
}

/// The end of a file's name, the code, and the whole file.
type Text = (&'static str, String, String);

const VERSION: &str = env!("CARGO_PKG_VERSION");

fn write(path: &Path, text: &str) -> Result<(), BuildError> {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    let written = folder.and_then(|()| write_whole(path, text));
    written.map_err(|error| one(format!("cannot write {}: {error}", path.display())))
}
