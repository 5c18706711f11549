//! Runs the command.
#![allow(dead_code, reason = "each test file uses its own part")]

use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// The exit code and the output of a run.
pub struct Ran {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Ran {
    /// Expects these words on standard error.
    #[track_caller]
    pub fn says(&self, words: &[&str]) {
        let missing = words.iter().find(|word| !self.err.contains(**word));
        assert_eq!(missing, None, "{}", self.err);
    }

    /// Expects these words on standard output.
    #[track_caller]
    pub fn prints(&self, words: &[&str]) {
        let missing = words.iter().find(|word| !self.out.contains(**word));
        assert_eq!(missing, None, "{}", self.out);
    }

    /// Expects an exit code, and these words on standard error.
    #[track_caller]
    pub fn ends(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, code, "{}", self.err);
        self.says(words);
    }
}

pub fn run(arguments: &[&str]) -> Ran {
    let output = Command::new(env!("CARGO_BIN_EXE_dalembert"))
        .args(arguments)
        // The wrapper of these tests is not for a crate that the command builds.
        .env_remove("RUSTC_WORKSPACE_WRAPPER")
        .output()
        .unwrap();
    Ran {
        // A signal has no code.
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Runs the command and expects success.
#[track_caller]
pub fn good(arguments: &[&str]) -> Ran {
    let ran = run(arguments);
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    ran
}

/// Returns the path of a checked-in robot file.
pub fn robot(name: &str) -> String {
    let root = env!("CARGO_MANIFEST_DIR");
    format!("{root}/../generated/robots/{name}.toml")
}

/// Returns an empty folder of this test run.
pub fn temporary(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Writes a checked-in robot file, with `more` appended, to a new folder; returns folder and file.
pub fn arm(folder: &str, of: &str, more: &str) -> (PathBuf, String) {
    let folder = temporary(folder);
    let file = folder.join("arm.toml");
    let robot = fs::read_to_string(robot(of)).unwrap();
    fs::write(&file, format!("{robot}{more}")).unwrap();
    let name = file.to_str().unwrap().to_owned();
    (folder, name)
}
