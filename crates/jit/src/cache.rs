//! A folder of what was generated before.
//!
//! A file's name is the hash of what it was made from, its first line the hash of the rest:
//! an entry that was damaged, or cut off, is ignored. A writer writes into a file of its own
//! and renames it, so that readers see one whole entry or another, even if others write.
//! A write that fails is not reported: the entry is made anew the next time.
//!
//! An entry is run without another proof. So a folder, or a file in it, that another user may
//! write or owns is not read, and nothing is kept there; notes of the arm tell it.

use std::env;
use std::fs::{self, File, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};

use dalembert_codegen::workspace::{RunnableCode, Sizes};
use dalembert_codegen::{GeneratedFunction, Plan};
use hmac_sha256::Hash;
use serde::{Deserialize, Serialize};

use crate::request::{Cache, Load};

/// Changes when entries of before mean something else, or the generator's sources change.
const GENERATOR: &str = concat!("entry 2 of ", env!("DALEMBERT_SOURCES"));

/// Larger files are not of this cache.
const MAX_BYTES: u64 = 1 << 28;

/// The parts of a loaded arm that are kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Entry {
    pub(crate) robot: String,
    pub(crate) notes: Vec<String>,
    pub(crate) functions: Vec<CachedFunction>,
    pub(crate) rust: Vec<String>,
    pub(crate) claim: String,
    /// With exact constants.
    pub(crate) plan: String,
    pub(crate) ended: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct CachedFunction {
    /// Its name, and what it bundles if it is a bundle.
    pub(crate) function: String,
    pub(crate) scalar: String,
    /// The index in `rust`.
    pub(crate) file: usize,
    pub(crate) arguments: Vec<String>,
    /// Rows, links, joints, coordinates of a base that floats, entries of limbs, base parameters, load,
    /// bodies that are arguments and rows of the table: [`Sizes`], but for the beginnings of limbs.
    pub(crate) sizes: [usize; 9],
    pub(crate) limbs: u64,
    pub(crate) proof: String,
}

impl CachedFunction {
    pub(crate) fn of(
        file: usize,
        function: &GeneratedFunction,
        emitted: &RunnableCode,
    ) -> CachedFunction {
        let sizes = emitted.sizes;
        let arguments = function.program.arguments.iter();
        let tolerance = match function.admitted {
            None => "",
            Some(_) => "; what a tolerance left out of it is bounded in its claim",
        };
        CachedFunction {
            function: function.function.text(),
            scalar: emitted.scalar.name().to_owned(),
            file,
            arguments: arguments
                .map(|argument| argument.name().to_owned())
                .collect(),
            limbs: sizes.limbs,
            sizes: [
                sizes.rows,
                sizes.links,
                sizes.joints,
                sizes.floating,
                sizes.blocks,
                sizes.base,
                sizes.load,
                sizes.bodies,
                sizes.table,
            ],
            proof: format!("{}{tolerance}", function.proof),
        }
    }

    pub(crate) fn sizes(&self) -> Sizes {
        let [rows, links, joints, floating, ..] = self.sizes;
        let [.., blocks, base, load, bodies, table] = self.sizes;
        Sizes {
            limbs: self.limbs,
            blocks,
            rows,
            links,
            joints,
            floating,
            base,
            load,
            bodies,
            table,
        }
    }
}

pub(crate) struct Folder(PathBuf);

pub(crate) fn key(source: &str, name: &str, plan: Option<&str>, load: &Load) -> String {
    let request = Load {
        // Where it is kept changes nothing.
        cache: Cache::Off,
        ..load.clone()
    };
    // Notes and the robot file tell the name.
    let (plan, request) = (plan.unwrap_or_default(), format!("{request:?}"));
    hash_of(GENERATOR, &[source, name, plan, &request])
}

/// One plan serves all functions and scalars that are searched for in the same way.
pub(crate) fn plan_key(robot: &str, load: &Load) -> String {
    let mut search = load.asked.clone();
    const OF_FUNCTIONS: [&str; 7] = [
        "outputs",
        "scalar",
        "parameters",
        "bodies",
        "keep_zeros",
        "scene",
        "name",
    ];
    for option in OF_FUNCTIONS {
        // All of them are options.
        let _ = search.set(option, "");
    }
    hash_of(GENERATOR, &[robot, &search.to_string()])
}

/// Lengths tell the texts apart.
fn hash_of(generator: &str, parts: &[&str]) -> String {
    let mut hash = Hash::new();
    for part in [generator].iter().chain(parts) {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hexadecimal(hash.finalize())
}

fn hexadecimal(hash: [u8; 32]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Folder {
    /// The folder is made when something is kept. The error is a note: others may write the folder.
    pub(crate) fn of(cache: &Cache) -> Result<Option<Folder>, String> {
        let path = match cache {
            Cache::Off => None,
            Cache::At(path) => Some(path.clone()),
            Cache::User => user_folder(),
        };
        let Some(path) = path else { return Ok(None) };
        match fs::metadata(&path) {
            Ok(about) if !is_private(&about) => Err(format!(
                "note: nothing is read from the cache `{}` or kept there, since other users may \
                 write it: they could change the code that runs; `chmod go-w` on a folder of your \
                 own ends this",
                path.display()
            )),
            _ => Ok(Some(Folder(path))),
        }
    }

    pub(crate) fn entry(&self, key: &str) -> Option<Entry> {
        serde_json::from_str(&self.read(&format!("{key}.json"))?).ok()
    }

    pub(crate) fn keep(&self, key: &str, entry: &Entry) {
        if let Ok(text) = serde_json::to_string(entry) {
            self.write(&format!("{key}.json"), &text);
        }
    }

    pub(crate) fn plan(&self, key: &str) -> Option<Plan> {
        Plan::parse(&self.read(&format!("{key}.plan"))?).ok()
    }

    /// If two write at once, one's programs are searched for again.
    pub(crate) fn keep_plan(&self, key: &str, plan: &Plan) {
        self.write(&format!("{key}.plan"), &plan.write());
    }

    fn read(&self, name: &str) -> Option<String> {
        let path = self.0.join(name);
        let about = fs::metadata(&path).ok()?;
        if !about.is_file() || about.len() > MAX_BYTES || !is_private(&about) {
            return None;
        }
        let text = fs::read_to_string(path).ok()?;
        let (hash, rest) = text.split_once('\n')?;
        (hash == hexadecimal(Hash::hash(rest.as_bytes()))).then(|| rest.to_owned())
    }

    fn write(&self, name: &str, text: &str) -> Option<()> {
        static WRITES: AtomicUsize = AtomicUsize::new(0);
        private_folder(&self.0).ok()?;
        let number = WRITES.fetch_add(1, Ordering::Relaxed);
        let unfinished = format!("{name}.{}.{number}.tmp", process::id());
        let unfinished = self.0.join(unfinished);
        let hash = hexadecimal(Hash::hash(text.as_bytes()));
        let written = private_file(&unfinished)
            .and_then(|mut file| file.write_all(format!("{hash}\n{text}").as_bytes()))
            .and_then(|()| fs::rename(&unfinished, self.0.join(name)));
        if written.is_err() {
            // Best effort: the folder may be gone.
            let _ = fs::remove_file(&unfinished);
        }
        written.ok()
    }
}

fn user_folder() -> Option<PathBuf> {
    let set = |name| {
        let value = env::var_os(name).filter(|value| !value.is_empty());
        value.map(PathBuf::from)
    };
    let caches = || {
        if cfg!(windows) {
            set("LOCALAPPDATA")
        } else if cfg!(target_os = "macos") {
            set("HOME").map(|home| home.join("Library/Caches"))
        } else {
            set("XDG_CACHE_HOME").or_else(|| set("HOME").map(|home| home.join(".cache")))
        }
    };
    set("DALEMBERT_CACHE").or_else(|| caches().map(|caches| caches.join("dalembert")))
}

/// Tells whether a folder or file is the user's, or the system's, and others may not write it.
#[cfg(unix)]
fn is_private(about: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    let owners = [0, rustix::process::geteuid().as_raw()];
    about.mode() & 0o022 == 0 && owners.contains(&about.uid())
}

/// Elsewhere the user's folders are taken to be the user's alone.
#[cfg(not(unix))]
fn is_private(_: &Metadata) -> bool {
    true
}

fn private_folder(path: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.recursive(true).create(path)
}

fn private_file(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.write(true).create(true).truncate(true).open(path)
}

#[cfg(test)]
#[path = "../sources.rs"]
mod sources;

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::{GENERATOR, hash_of, key, plan_key, sources};
    use crate::request::{Cache, Load};

    #[test]
    fn another_generator_has_other_keys() {
        let ours = sources::hash(Path::new("."), &sources::SOURCES).unwrap();
        assert!(GENERATOR.ends_with(&ours), "of the sources as they are");
        let others = hash_of("entry 1 of others", &["a"]);
        assert_ne!(hash_of(GENERATOR, &["a"]), others);
    }

    #[test]
    fn every_byte_of_a_source_counts() {
        let name = format!("dalembert-sources-{}", std::process::id());
        let root = std::env::temp_dir().join(name);
        fs::create_dir_all(root.join("a/b")).unwrap();
        let mut hashes = vec![sources::hash(&root, &["a"]).unwrap()];
        let one = "a/b/one";
        for (file, text) in [(one, "x"), (one, "y"), ("a/two", "y"), (one, "")] {
            fs::write(root.join(file), text).unwrap();
            hashes.push(sources::hash(&root, &["a"]).unwrap());
            fs::rename(root.join(file), root.join("a/renamed")).unwrap();
            hashes.push(sources::hash(&root, &["a"]).unwrap());
            fs::rename(root.join("a/renamed"), root.join(file)).unwrap();
        }
        fs::remove_dir_all(&root).unwrap();
        let count = hashes.len();
        hashes.sort();
        hashes.dedup();
        assert_eq!(hashes.len(), count);
    }

    #[test]
    fn a_request_has_its_key_wherever_it_is_kept() {
        let load = Load::default();
        let with = |change: fn(&mut Load)| {
            let mut load = load.clone();
            change(&mut load);
            load
        };
        let off = with(|load| load.cache = Cache::Off);
        let thorough = with(|load| load.asked = "effort: thorough".parse().unwrap());
        let exact = with(|load| load.urdf.exact = true);
        assert_eq!(key("a", "b", None, &load), key("a", "b", None, &off));
        let keys = [
            key("a", "b", None, &load),
            key("a", "b", Some("c"), &load),
            key("ab", "", None, &load),
            key("a", "b", None, &thorough),
            key("a", "b", None, &exact),
        ];
        for (index, one) in keys.iter().enumerate() {
            assert!(!keys[..index].contains(one), "{index}");
        }
        assert_eq!(plan_key("a", &load), plan_key("a", &exact));
        assert_ne!(plan_key("a", &load), plan_key("a", &thorough));
    }
}
