//! The cache: its entries and their ends.

use std::fs;
use std::path::PathBuf;

use dalembert_jit::{Arm, Cache, Error, Load, Scalar};

use crate::support::{Folder, path};

fn arm(load: &Load) -> Arm {
    Arm::load(path("generated/robots/planar2r.toml"), load).unwrap()
}

fn refusal(arm: Result<Arm, Error>) -> String {
    arm.err().unwrap().to_string()
}

fn gravity(arm: &Arm) -> [f64; 2] {
    let mut c = [0.0; 2];
    let function = arm.function("gravity", Scalar::F64).unwrap();
    function.native().call(&[&[0.3, 0.4]], &mut c).unwrap();
    c
}

fn files(folder: &Folder, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(&folder.0).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == extension));
    paths
}

/// Returns the path of the only entry, and its JSON.
fn entry(folder: &Folder) -> (PathBuf, String) {
    let entry = files(folder, "json").pop().unwrap();
    let text = fs::read_to_string(&entry).unwrap();
    (entry, text.split_once('\n').unwrap().1.to_owned())
}

fn hashed(json: &str) -> String {
    let bytes = hmac_sha256::Hash::hash(json.as_bytes());
    let hash: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{hash}\n{json}")
}

#[test]
fn a_second_load_searches_for_nothing() {
    let folder = Folder::new("second");
    let first = arm(&folder.load());
    let second = arm(&folder.load());
    assert!(!first.is_from_cache() && second.is_from_cache());
    assert_eq!(gravity(&first), gravity(&second));
    assert_eq!(first.rust(), second.rust());
    assert_eq!(first.functions()[0].proof(), second.functions()[0].proof());
    // Another request is another entry, and takes its programs from the plan.
    let more = Load {
        asked: "outputs: gravity, inertia".parse().unwrap(),
        ..folder.load()
    };
    assert!(!arm(&more).is_from_cache());
    assert_eq!(files(&folder, "json").len(), 2);
    assert_eq!(files(&folder, "plan").len(), 1);
    assert_eq!(files(&folder, "tmp").len(), 0);
}

#[test]
fn nothing_is_kept_where_nobody_wants_it() {
    let off = Load {
        cache: Cache::Off,
        ..Folder::new("off").load()
    };
    assert!(!arm(&off).is_from_cache());
    assert!(!arm(&off).is_from_cache());
}

#[test]
fn a_damaged_entry_is_made_anew() {
    let folder = Folder::new("damaged");
    let expected = gravity(&arm(&folder.load()));
    let entry = files(&folder, "json").pop().unwrap();
    let whole = fs::read(&entry).unwrap();
    let mut changed = whole.clone();
    let middle = changed.len() / 2;
    changed[middle] ^= 1;
    for damaged in [&whole[..whole.len() - 9], &changed, b"", b"\xff\xfe\n{}"] {
        fs::write(&entry, damaged).unwrap();
        let anew = arm(&folder.load());
        assert!(!anew.is_from_cache());
        assert_eq!(gravity(&anew), expected);
        assert!(arm(&folder.load()).is_from_cache());
    }
    let plan = files(&folder, "plan").pop().unwrap();
    fs::write(plan, "nonsense").unwrap();
    fs::remove_file(&entry).unwrap();
    assert_eq!(gravity(&arm(&folder.load())), expected);
}

#[test]
fn an_entry_of_another_kind_is_made_anew() {
    let folder = Folder::new("other");
    let expected = gravity(&arm(&folder.load()));
    let (entry, json) = entry(&folder);
    for (from, to) in [
        ("\"f64\"", "\"f16\""),
        ("pub fn gravity", "pub fn levity"),
        ("{", "["),
    ] {
        let other = json.replacen(from, to, 1);
        assert_ne!(other, json);
        fs::write(&entry, hashed(&other)).unwrap();
        let anew = arm(&folder.load());
        assert!(!anew.is_from_cache(), "{to}");
        assert_eq!(gravity(&anew), expected);
    }
}

/// Another user's code is not run, though its hash is right.
#[cfg(unix)]
#[test]
fn what_others_may_write_is_not_trusted() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("others");
    let expected = gravity(&arm(&folder.load()));
    let (entry, json) = entry(&folder);
    let forged = hashed(&json.replacen("c2", "s2", 1));
    let allow = |path: &PathBuf, mode| {
        fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    };
    for (folder_mode, file_mode) in [(0o770, 0o600), (0o707, 0o600), (0o700, 0o666)] {
        fs::write(&entry, &forged).unwrap();
        allow(&folder.0, folder_mode);
        allow(&entry, file_mode);
        let arm = arm(&folder.load());
        assert_eq!(gravity(&arm), expected);
        assert!(!arm.is_from_cache());
        let note = arm.notes().iter().any(|note| note.contains("chmod go-w"));
        assert_eq!(note, folder_mode != 0o700, "{:?}", arm.notes());
    }
    // An entry that was made anew is the user's alone.
    assert!(arm(&folder.load()).is_from_cache());
}

#[test]
fn writers_at_once_leave_whole_entries() {
    let folder = Folder::new("writers");
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| gravity(&arm(&folder.load())));
        }
    });
    assert!(arm(&folder.load()).is_from_cache());
    assert_eq!(files(&folder, "json").len(), 1);
    assert_eq!(files(&folder, "tmp").len(), 0);
}

#[test]
fn a_folder_that_cannot_be_written_is_no_error() {
    let folder = Folder::new("file");
    fs::write(&folder.0, "a file").unwrap();
    assert!(!arm(&folder.load()).is_from_cache());
    fs::remove_file(&folder.0).unwrap();
}

#[test]
fn a_urdf_is_loaded() {
    let folder = Folder::new("urdf");
    let urdf = path("crates/import/tests/data/panda.urdf");
    let mut load = folder.load();
    load.urdf.tips = vec!["panda_link8".to_owned()];
    load.urdf.lock = vec![("*".to_owned(), "0".to_owned())];
    let arm = Arm::load(&urdf, &load).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(arm.robot().joints.len(), 7);
    assert!(Arm::load(&urdf, &load).unwrap().is_from_cache());
    load.urdf.tips = vec!["panda_link9".to_owned()];
    let error = refusal(Arm::load(&urdf, &load));
    assert!(error.contains("panda_link9"), "{error}");
    let error = refusal(Arm::load(path("nowhere.toml"), &load));
    assert!(error.contains("does not exist"), "{error}");
    let error = refusal(Arm::parse("<robot", "it", None, &load));
    assert!(error.contains("error"), "{error}");
}
