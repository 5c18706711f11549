//! Formats of files that are not read, by their first bytes.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::Error;

/// First bytes, the format that begins with them, and what makes a log of it that is read.
const FORMATS: [(&[u8], &str, &str); 11] = [
    (b"PAR1", "Parquet", ""),
    (b"\x89MCAP", MCAP, "let its name end in .mcap"),
    (
        b"#ROSBAG",
        "a bag of ROS 1",
        "`rosbags-convert` makes one of ROS 2",
    ),
    (
        b"SQLite format 3",
        "SQLite",
        "`ros2 bag convert` makes MCAP of a bag",
    ),
    (b"ARROW1", "Arrow", "`pandas.read_feather(…).to_parquet(…)`"),
    (b"\x89HDF", "HDF5", "`pandas.read_hdf(…).to_parquet(…)`"),
    (b"\x93NUMPY", "NumPy", "`pandas.DataFrame(…).to_parquet(…)`"),
    (b"MATLAB", "MATLAB", "`scipy.io.loadmat` reads it"),
    (b"PK\x03\x04", "ZIP", "unpack it"),
    (b"\x1f\x8b", "gzip", "unpack it"),
    (b"\x28\xb5\x2f\xfd", "Zstandard", "unpack it"),
];

const MCAP: &str = "MCAP";

pub(super) fn foreign(path: &Path, is_mcap: bool) -> Result<Option<Error>, Error> {
    let mut head = Vec::new();
    File::open(path)?.take(512).read_to_end(&mut head)?;
    let (format, help) = format(&head);
    let expected = if is_mcap { MCAP } else { FORMATS[0].1 };
    let is_other = format != expected;
    let help = match help {
        "" => String::new(),
        help => format!(": {help}"),
    };
    let why = format!("this is {format}, not {expected}; Parquet and MCAP are read{help}");
    Ok(is_other.then(|| Error::new(why)))
}

fn format(head: &[u8]) -> (&'static str, &'static str) {
    let mut known = FORMATS.iter();
    if let Some(&(_, name, help)) = known.find(|(first, ..)| head.starts_with(first)) {
        return (name, help);
    }
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let is_text = |byte: &u8| *byte >= b' ' || b"\t\r\n".contains(byte);
    let mut visible = head.iter().filter(|byte| !byte.is_ascii_whitespace());
    let line = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
    match visible.next() {
        None if head.is_empty() => ("an empty file", ""),
        _ if !head.iter().all(is_text) => ("an unknown format", ""),
        Some(b'{' | b'[') => ("JSON", "`pandas.read_json(…).to_parquet(…)` converts it"),
        _ if line.iter().any(|byte| b",;\t".contains(byte)) => {
            ("CSV", "`pandas.read_csv(…).to_parquet(…)` converts it")
        }
        _ => ("text", ""),
    }
}
