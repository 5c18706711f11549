//! `dalembert new`: a crate with an arm of its own, which builds and passes.
//!
//! - this file: the robot, and the folder, all of it or none
//! - [`texts`]: what is in the files

mod texts;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use dalembert_codegen::{Asked, Language, RobotFile, ask};
use dalembert_import::{MAX_BYTES, import_text};
use dalembert_model::read::{self, Reading};
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Robot, suggested_name};
use nalgebra::DVector;
use serde_json::json;

use crate::args::{ChainArgs, NewArgs};
use crate::outcome::{Failure, Outcome};
use crate::{input, model, output};

/// Runs the subcommand.
pub fn run(args: &NewArgs) -> Outcome {
    let folder = &args.folder;
    let name = crate_name(folder)?;
    if fs::symlink_metadata(folder).is_ok() {
        return Err(Failure::Input(format!(
            "error: `{}` is there already\n  = help: give the crate another name",
            folder.display()
        )));
    }
    let robot_file = match &args.from {
        None if args.chain.is_given() => return Err(no_urdf("the two links")),
        None => texts::ROBOT.to_owned(),
        Some(from) => robot_file(from, &args.chain)?,
    };
    let reading = reading(&robot_file)?;
    let robot = &reading.robot.name;
    let source = texts::source(robot, &states(&reading.robot)?);
    let code = code(&reading, &robot_file)?;
    let dependency = dependency(args)?;
    let manifest = texts::manifest(&name, &dependency);
    let files = [
        ("Cargo.toml".to_owned(), manifest),
        (format!("robots/{robot}.rs"), code),
        (format!("robots/{robot}.toml"), robot_file),
        ("src/main.rs".to_owned(), source),
    ];
    write(folder, &files).map_err(|error| {
        Failure::Input(format!(
            "error: `{}` cannot be written: {error}",
            folder.display()
        ))
    })?;
    if args.json {
        let files: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
        return output::print_json(&json!({
            "crate": name,
            "folder": folder.display().to_string(),
            "robot": robot,
            "joints": reading.robot.joints.len(),
            "files": files,
        }));
    }
    if dependency.starts_with("version") {
        output::note(&format!(
            "dalembert {VERSION} is taken from crates.io; from a checkout of it: --path FOLDER"
        ));
    }
    output::note(&format!(
        "{}: cargo run prints torques, cargo test compares them with those of a recursion",
        folder.display()
    ));
    Ok(())
}

/// Generates the code that is checked in.
fn code(reading: &Reading, source: &str) -> Result<String, Failure> {
    let asked = texts::ASKED.parse::<Asked>();
    let asked = asked.map_err(|error| Failure::Input(error.to_string()))?;
    let name = &reading.robot.name;
    let file = RobotFile::parse(source, name);
    let file = file.map_err(|error| Failure::Input(error.to_string()))?;
    let made = ask(&file, &asked, Language::Rust, name).map_err(|problems| {
        let each = problems
            .iter()
            .map(|problem| format!("error: {}", problem.message));
        Failure::Input(each.collect::<Vec<String>>().join("\n\n"))
    })?;
    let place = format!("{name}.toml");
    let files = made.generated.files(&made.request, &place, source);
    Ok(files.concat())
}

/// Computes torques by the recursion that serves any arm, at three states.
fn states(robot: &Robot) -> Result<Vec<texts::State>, Failure> {
    let n = robot.joints.len();
    let runtime = Reference::<f64>::from_robot(robot);
    let state = |step: usize| {
        // Sines of the library of all platforms, to two digits.
        let value = |k: usize, size: f64| {
            let sine = libm::sin((7 * step + 3 * k) as f64);
            (size * sine * 100.0).round() / 100.0
        };
        let q = DVector::from_fn(n, |k, _| value(k, 1.5));
        let qd = DVector::from_fn(n, |k, _| value(k + 1, 2.0));
        let qdd = DVector::from_fn(n, |k, _| value(k + 2, 5.0));
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd);
        let tau = tau.map_err(|error| Failure::Input(format!("error: {error}")))?;
        Ok([q, qd, qdd, tau].map(|vector| vector.as_slice().to_vec()))
    };
    (1..=3).map(state).collect()
}

/// Returns the crate's name, which is the folder's; hyphens may be in it.
fn crate_name(folder: &Path) -> Result<String, Failure> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let refused = |help: String| {
        Err(Failure::Input(format!(
            "error: {name:?} cannot name a crate\n  = help: {help}"
        )))
    };
    let plain = name.replace('-', "_");
    match suggested_name(&plain) {
        Some(good) if good != plain => refused(format!("write {good:?}")),
        None => {
            refused("lower-case letters, digits, hyphens and underscores, a letter first".into())
        }
        Some(good) if texts::DEPENDENCIES.contains(&good.as_str()) => refused(format!(
            "the new crate depends on the crate `{good}`: write \"my_{good}\""
        )),
        Some(_) => Ok(name.into_owned()),
    }
}

/// Returns the text of a robot file, or the robot file of a URDF's chain.
fn robot_file(from: &Path, chain: &ChainArgs) -> Result<String, Failure> {
    let name = from.display().to_string();
    let source = String::from_utf8(input::bytes(from, MAX_BYTES as u64)?)
        .map_err(|_| Failure::Input(format!("error: `{name}` is not UTF-8 text")))?;
    if !source
        .trim_start_matches('\u{feff}')
        .trim_start()
        .starts_with('<')
    {
        if chain.is_given() {
            return Err(no_urdf(&format!("the robot file `{name}`")));
        }
        return match read::parse(&source, &read::Options::default()) {
            Ok(_) => Ok(source),
            Err(errors) => Err(Failure::Input(errors.render(&name, &source))),
        };
    }
    let text = model::text(from, &[])?;
    match import_text(&text, &chain.options(from)) {
        Ok(imported) => {
            output::note(&text.render(&imported.notes));
            chain.assumed().iter().for_each(|said| output::note(said));
            output::undenied()?;
            Ok(imported.text)
        }
        Err(errors) => Err(Failure::Input(text.render(&errors.0))),
    }
}

/// Refuses options for a URDF where there is none.
fn no_urdf(robot: &str) -> Failure {
    Failure::Input(format!(
        "error: {robot} has one chain, and every option for a URDF says which\n  = help: leave \
         --base, --tip, --name and the others of `import` out, or give a URDF by --from"
    ))
}

/// Returns the robot of a text that was read before, or is this command's own.
fn reading(text: &str) -> Result<Reading, Failure> {
    read::parse(text, &read::Options::default())
        .map_err(|errors| Failure::Input(errors.render("the robot file", text)))
}

/// Returns where the crate has dalembert from: the folder that was given, the checkout that
/// this program was built from, if it is still there, or the registry.
fn dependency(args: &NewArgs) -> Result<String, Failure> {
    let own = Path::new(OWN_CHECKOUT);
    let path = match &args.path {
        Some(path) => path,
        None if is_dalembert(own) => own,
        None => return Ok(format!("version = {VERSION:?}")),
    };
    let whole = fs::canonicalize(path)
        .ok()
        .filter(|path| is_dalembert(path));
    let Some(whole) = whole else {
        return Err(Failure::Input(format!(
            "error: --path: there is no dalembert in `{}`\n  = help: the folder of a checkout of dalembert, with its Cargo.toml",
            path.display()
        )));
    };
    // A debug string is a TOML string for every path that is text.
    Ok(format!("path = {:?}", whole.display().to_string()))
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Where this program was built, unless that was from the registry: there, no folder holds
/// this one and dalembert.
const OWN_CHECKOUT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Returns whether a folder holds the crate dalembert.
fn is_dalembert(folder: &Path) -> bool {
    fs::read_to_string(folder.join("Cargo.toml"))
        .is_ok_and(|manifest| manifest.lines().any(|line| line == "name = \"dalembert\""))
}

/// Writes the files into a folder beside, which then gets its name.
fn write(folder: &Path, files: &[(String, String)]) -> io::Result<()> {
    let mut name = folder.as_os_str().to_owned();
    name.push(format!(".unfinished-{}", std::process::id()));
    let unfinished = PathBuf::from(name);
    let written = || -> io::Result<()> {
        fs::create_dir(&unfinished)?;
        for (name, text) in files {
            let path = unfinished.join(name);
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            fs::write(path, text)?;
        }
        fs::rename(&unfinished, folder)
    };
    written().inspect_err(|_| {
        // What is left of it is of no use; that it cannot go is no news.
        let _ = fs::remove_dir_all(&unfinished);
    })
}
