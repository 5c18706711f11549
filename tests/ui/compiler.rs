//! The compiler, on one file, with the libraries that this test was linked with: they
//! are compiled once for all of the workspace's tests. (A crate of its own for the
//! cases, as `trybuild` has it, compiles the generator once more, for a minute.)

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::SystemTime;

pub struct Compiler {
    rustc: OsString,
    libraries: PathBuf,
    dalembert: PathBuf,
    folder: PathBuf,
}

impl Compiler {
    pub fn new() -> io::Result<Compiler> {
        let test = env::current_exe()?;
        let libraries = test.parent().unwrap_or(Path::new(".")).to_owned();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ui");
        fs::create_dir_all(&folder)?;
        Ok(Compiler {
            rustc: env::var_os("RUSTC").unwrap_or("rustc".into()),
            dalembert: newest(&libraries, "libdalembert-")?,
            libraries,
            folder,
        })
    }

    pub fn check(&self, case: &Path) -> io::Result<Output> {
        self.command(case)
            .args(["--emit", "metadata", "--out-dir"])
            .arg(&self.folder)
            .output()
    }

    /// Compiles a file that should be accepted, and runs it.
    pub fn run(&self, case: &Path) -> io::Result<Output> {
        let name = case.file_stem().unwrap_or_default();
        let program = self
            .folder
            .join(name)
            .with_extension(env::consts::EXE_EXTENSION);
        let compiled = self.command(case).arg("-o").arg(&program).output()?;
        match compiled.status.success() {
            true => Command::new(program).output(),
            false => Ok(compiled),
        }
    }

    fn command(&self, case: &Path) -> Command {
        let mut command = Command::new(&self.rustc);
        command
            .args(["--edition", "2024", "--color", "never", "-C", "debuginfo=0"])
            // Code for whoever calls it: here nobody does.
            .args(["-A", "dead_code"])
            .arg("-L")
            .arg(prefixed("dependency=", &self.libraries))
            .arg("--extern")
            .arg(prefixed("dalembert=", &self.dalembert))
            .arg(case)
            .env("CARGO_MANIFEST_DIR", env!("CARGO_MANIFEST_DIR"))
            .current_dir(env!("CARGO_MANIFEST_DIR"));
        command
    }
}

fn prefixed(prefix: &str, path: &Path) -> OsString {
    let mut whole = OsString::from(prefix);
    whole.push(path);
    whole
}

/// Returns the library of this name that was compiled last, of several with other features:
/// none that is older than a source is left where cargo ran a test.
fn newest(folder: &Path, prefix: &str) -> io::Result<PathBuf> {
    let mut latest: Option<(SystemTime, PathBuf)> = None;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with(prefix) && name.ends_with(".rlib") {
            let age = fs::metadata(&path)?.modified()?;
            if latest.as_ref().is_none_or(|(newest, _)| age > *newest) {
                latest = Some((age, path));
            }
        }
    }
    let missing = || io::Error::other(format!("no {prefix}*.rlib in {}", folder.display()));
    latest.map(|(_, path)| path).ok_or_else(missing)
}
