//! A robot of a path: a robot file, a URDF or an MJCF, whichever it is.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use dalembert_model::diagnostic::{Diagnostic, Diagnostics};
use dalembert_model::read::{self, Reading};

use crate::text::{MAX_BYTES, MAX_MIB};
use crate::{Import, Options, Text, import_text};

/// A robot that was read from a path, or from a text.
#[derive(Clone, Debug)]
pub struct OpenRobot {
    /// The text of the file, with what a model includes.
    pub source: Text,
    /// The text as a robot file: the same text, or what a model was imported as.
    pub robot_file: String,
    /// The robot with its outputs and scenes; the notes are about `robot_file`.
    pub reading: Reading,
    /// The result of importing a model; none for a robot file.
    pub imported: Option<Import>,
}

/// The reason why a path gives no robot.
#[derive(Debug)]
pub enum OpenError {
    /// The system's error.
    System(io::Error),
    /// Everything that is wrong with the text.
    Wrong(Diagnostics),
}

impl OpenRobot {
    /// Returns the warnings and notes about the file, as they are shown.
    pub fn notes(&self) -> Vec<String> {
        let notes = match &self.imported {
            Some(imported) => &imported.notes,
            None => &self.reading.notes,
        };
        notes.iter().map(Diagnostic::render).collect()
    }
}

/// Opens a robot file, a URDF or an MJCF; the options choose the chain of a model.
///
/// # Errors
/// [`OpenError`]: the file cannot be read, or everything that is wrong with it.
pub fn open(path: &Path, options: &Options) -> Result<OpenRobot, OpenError> {
    read_robot(open_text(path)?, options).map_err(OpenError::Wrong)
}

/// Reads the text of a robot file or of a model, with what a model includes.
///
/// # Errors
/// [`OpenError`]: a file cannot be read, is not UTF-8, or is included twice.
pub fn open_text(path: &Path) -> Result<Text, OpenError> {
    let shown = path.display().to_string();
    let bytes = first_bytes(path, MAX_BYTES as u64 + 1).map_err(OpenError::System)?;
    let wrong = |(why, help): (String, String)| {
        let error = Diagnostic::error(format!("`{shown}` {why}")).with_help(&help);
        OpenError::Wrong(error.into())
    };
    if bytes.starts_with(b"\xff\xfe<") || bytes.starts_with(b"\xfe\xff\0<") {
        return Err(wrong(in_encoding("UTF-16", &shown)));
    }
    if is_model(&bytes) {
        if bytes.len() > MAX_BYTES {
            let why = format!("is longer than {MAX_MIB} MiB, the most that is read");
            return Err(wrong((why, String::new())));
        }
        let decoded = String::from_utf8(bytes);
        let text = decoded.map_err(|_| wrong(in_encoding("ISO-8859-1", &shown)))?;
        let file = Text::of_file(&shown, &text);
        return file.with_includes(path, included).map_err(OpenError::Wrong);
    }
    if bytes.len() <= read::MAX_BYTES
        && let Ok(text) = str::from_utf8(&bytes)
    {
        return Ok(Text::of(&shown, text.to_owned()));
    }
    // The reader of robot files says where it is not UTF-8, or too long.
    Err(match read::parse_bytes(&bytes) {
        Err(errors) => OpenError::Wrong(errors.in_file(&shown)),
        Ok(_) => wrong(("is not a robot file".to_owned(), String::new())),
    })
}

/// Reads a robot from the text of a robot file or of a model.
///
/// # Errors
/// Everything that is wrong with the text.
pub fn read_robot(source: Text, options: &Options) -> Result<OpenRobot, Diagnostics> {
    let imported = match is_model(source.as_str().as_bytes()) {
        false => {
            refuse_chain(options, source.name())?;
            None
        }
        true => Some(import_text(&source, options)?),
    };
    let text = imported.as_ref().map(|imported| imported.text.as_str());
    let robot_file = text.unwrap_or(source.as_str()).to_owned();
    // An imported robot file was already read once.
    let mut reading = read::parse(&robot_file).map_err(|errors| errors.in_file(source.name()))?;
    reading.notes = Diagnostics(reading.notes).in_file(source.name()).0;
    Ok(OpenRobot {
        source,
        robot_file,
        reading,
        imported,
    })
}

fn in_encoding(encoding: &str, name: &str) -> (String, String) {
    let why = format!("is not UTF-8, and probably {encoding}");
    let help = format!("convert it: `iconv -f {encoding} -t UTF-8 {name} > utf8.xml`");
    (why, help)
}

fn refuse_chain(options: &Options, name: &str) -> Result<(), Diagnostic> {
    let flags = [
        ("base", options.base.is_some()),
        ("tip", !options.tips.is_empty()),
        ("tree", options.tree),
        ("floating", options.floating),
        ("lock", !options.lock.is_empty()),
        ("without", !options.without.is_empty()),
        ("ignore-ties", options.ignore_ties),
    ];
    let Some((option, _)) = flags.into_iter().find(|(_, is_set)| *is_set) else {
        return Ok(());
    };
    let message = format!("--{option}: `{name}` is a robot file, and not a URDF or an MJCF");
    Err(Diagnostic::error(message).with_help("leave it out: a robot file is one robot"))
}

/// True if a text is a model's: XML, and not TOML.
pub fn is_model(text: &[u8]) -> bool {
    let text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(text);
    text.trim_ascii_start().starts_with(b"<")
}

/// Returns the first `most` bytes of a file and reads no more, since a device may have no end.
///
/// # Errors
/// The file cannot be opened or read.
pub fn first_bytes(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Returns the text of a file that is included; pipes and devices have no end.
fn included(path: &Path) -> Result<String, String> {
    let metadata = fs::metadata(path).map_err(|error| error.to_string())?;
    if !metadata.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    let bytes = first_bytes(path, MAX_BYTES as u64 + 1).map_err(|error| error.to_string())?;
    let name = path.display().to_string();
    String::from_utf8(bytes).map_err(|_| {
        let (why, help) = in_encoding("ISO-8859-1", &name);
        format!("it {why}\n  = help: {help}")
    })
}
