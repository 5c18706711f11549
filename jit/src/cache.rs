//! A folder of what was generated before.
//!
//! A file's name is the hash of what it was made from, its first line the hash of the rest:
//! an entry that was damaged, or cut off, is none. A writer writes into a file of its own
//! and renames it, so that readers see one whole entry or another, whoever else writes.
//! What cannot be written is not kept, and nobody is told: it is made anew the next time.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};

use dalembert_codegen::workspace::plan::Plan;
use hmac_sha256::Hash;

use crate::entry::Entry;
use crate::request::Load;

/// Changes when entries of before mean something else.
const FORMAT: &str = concat!("dalembert ", env!("CARGO_PKG_VERSION"), " entry 1");

/// Larger files are none of ours.
const MAX_BYTES: u64 = 1 << 28;

/// A folder with entries and plans.
pub(crate) struct Folder(PathBuf);

/// Names an entry by all that it is made from.
pub(crate) fn key(source: &str, name: &str, plan: Option<&str>, load: &Load) -> String {
    let mut hash = Hash::new();
    let mut part = |text: &str| {
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(text);
    };
    let cache_is_no_part = Load {
        cache: crate::Cache::Off,
        ..load.clone()
    };
    part(FORMAT);
    part(source);
    // Notes and the robot file tell it.
    part(name);
    part(plan.unwrap_or_default());
    part(&format!("{cache_is_no_part:?}"));
    hexadecimal(hash.finalize())
}

fn hexadecimal(hash: [u8; 32]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Folder {
    /// Takes a folder; it is made when something is kept.
    pub(crate) fn at(path: &Path) -> Folder {
        Folder(path.to_owned())
    }

    /// Returns the user's folder, if the environment tells where that is.
    pub(crate) fn of_user() -> Option<Folder> {
        let set = |name| {
            env::var_os(name)
                .filter(|value| !value.is_empty())
                .map(PathBuf::from)
        };
        if let Some(own) = set("DALEMBERT_CACHE") {
            return Some(Folder(own));
        }
        let caches = if cfg!(windows) {
            set("LOCALAPPDATA")
        } else if cfg!(target_os = "macos") {
            set("HOME").map(|home| home.join("Library/Caches"))
        } else {
            set("XDG_CACHE_HOME").or_else(|| set("HOME").map(|home| home.join(".cache")))
        };
        caches.map(|caches| Folder(caches.join("dalembert")))
    }

    /// Reads an entry that is whole.
    pub(crate) fn entry(&self, key: &str) -> Option<Entry> {
        serde_json::from_str(&self.read(&format!("{key}.json"))?).ok()
    }

    /// Keeps an entry.
    pub(crate) fn keep(&self, key: &str, entry: &Entry) {
        if let Ok(text) = serde_json::to_string(entry) {
            self.write(&format!("{key}.json"), &text);
        }
    }

    /// Reads the plan of a robot, by its hash.
    pub(crate) fn plan(&self, robot: &str) -> Option<Plan> {
        Plan::parse(&self.read(&format!("{robot}.plan"))?).ok()
    }

    /// Keeps the plan of a robot. Of two writers at once, one's programs are searched for
    /// again.
    pub(crate) fn keep_plan(&self, robot: &str, plan: &Plan) {
        self.write(&format!("{robot}.plan"), &plan.write());
    }

    fn read(&self, name: &str) -> Option<String> {
        let path = self.0.join(name);
        let about = fs::metadata(&path).ok()?;
        if !about.is_file() || about.len() > MAX_BYTES {
            return None;
        }
        let text = fs::read_to_string(path).ok()?;
        let (hash, rest) = text.split_once('\n')?;
        (hash == hexadecimal(Hash::hash(rest.as_bytes()))).then(|| rest.to_owned())
    }

    fn write(&self, name: &str, text: &str) -> Option<()> {
        static WRITES: AtomicUsize = AtomicUsize::new(0);
        fs::create_dir_all(&self.0).ok()?;
        let number = WRITES.fetch_add(1, Ordering::Relaxed);
        let unfinished = self
            .0
            .join(format!("{name}.{}.{number}.tmp", process::id()));
        let hash = hexadecimal(Hash::hash(text.as_bytes()));
        let written = fs::write(&unfinished, format!("{hash}\n{text}"))
            .and_then(|()| fs::rename(&unfinished, self.0.join(name)));
        if written.is_err() {
            // Best effort: the folder may be gone.
            let _ = fs::remove_file(&unfinished);
        }
        written.ok()
    }
}
