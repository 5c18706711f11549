//! `dalembert new`: makes a crate for an arm, which builds and passes its test.
//!
//! - this file: reads the robot and makes the folder, all of it or none
//! - [`texts`]: the contents of the files

mod texts;

use std::fs;
use std::path::{Component, Path, PathBuf};

use dalembert_codegen::workspace::claim;
use dalembert_codegen::{Asked, Diagnostics, Language, RobotFile, ask};
use dalembert_import::{ChainArgs, Options, Text, read_robot};
use dalembert_model::diagnostic::Place;
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Robot, suggested_name};
use dalembert_stamp::{Comment, relative, sealed};
use nalgebra::DVector;

use crate::files::Files;
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::Report;
use crate::source::Source;

/// Arguments of `new`.
#[derive(Debug, clap::Args)]
pub struct NewArgs {
    /// The folder of the new crate; its name is the crate's name, too
    folder: PathBuf,
    /// The robot: a robot file, a URDF or an MJCF [default: two links in a plane]
    #[arg(long, value_name = "ROBOT")]
    from: Option<PathBuf>,
    #[command(flatten)]
    chain: ChainArgs,
}

pub(crate) fn run(args: &NewArgs, context: &Context) -> Outcome {
    let folder = &args.folder;
    let name = crate_name(folder)?;
    if fs::symlink_metadata(folder).is_ok() {
        let help = "give the crate another name";
        let why = format!("`{}` is there already\n  = help: {help}", folder.display());
        return Err(Failure::input(why));
    }
    let robot_file = match &args.from {
        None => {
            let text = Text::of("two links", texts::ROBOT.to_owned());
            let opened = read_robot(text, &args.chain.choose(Options::default()));
            opened?.robot_file
        }
        Some(from) => Source::open(context, from, &args.chain)?.robot_file,
    };
    let file = RobotFile::parse(&robot_file, "the robot file")
        .map_err(|error| Failure::Input(error.to_string()))?;
    let robot = &file.robot;
    let manifest = texts::manifest(&name, &dependency(folder));
    let [code, claim] = code(&file)?;
    let main = texts::source(&robot.name, robot.joints.len());
    let expected = expected(robot)?;
    let beside = |ending: &str| format!("robots/{}.{ending}", robot.name);
    let texts = [
        ("Cargo.toml".to_owned(), manifest),
        (beside("rs"), code),
        (beside("claim.json"), claim),
        (beside(EXPECTED), expected),
        (beside("toml"), robot_file),
        ("src/main.rs".to_owned(), main),
    ];
    let mut files = Files::new(context, &[]);
    let mut report = Report::default();
    let shown = folder.display().to_string();
    report.line(format!(
        "{shown}: `cargo run` prints torques, `cargo test` compares them with an independent recursion"
    ));
    report.value("crate", name);
    report.value("folder", shown);
    report.value("robot", robot.name.as_str());
    report.value("joints", robot.joints.len());
    let names = texts.each_ref().map(|(name, _)| name.as_str());
    report.value("files", names.to_vec());
    let mut done = Done::from(report);
    done.is_aside = true;
    for (name, text) in texts {
        done.files.push((files.add_in(folder, &name)?, text));
    }
    Ok(done)
}

fn code(file: &RobotFile) -> Result<[String; 2], Failure> {
    let parsed = texts::ASKED.parse::<Asked>();
    let asked = parsed.map_err(|error| Failure::Input(error.to_string()))?;
    let name = &file.robot.name;
    let made = ask(file, &asked, Language::Rust, name).map_err(|problems| {
        // The options are this program's: no message names them.
        let problems = problems.0.into_iter();
        let plain = problems.map(|problem| problem.at(Place::None));
        let text = Diagnostics(plain.collect()).render();
        Failure::Input(text.trim_end().to_owned())
    })?;
    let (request, generated) = (&made.request, &made.generated);
    let files = generated.files(request, &format!("{name}.toml"), &file.source);
    let claim = claim(&file.robot, &file.source, request, generated);
    Ok([files.concat(), claim.map_err(Failure::input)?.write()])
}

pub(crate) const EXPECTED: &str = "expected";

/// Returns the torques that the new crate expects, at three states, by the recursion for any arm.
pub(crate) fn expected(robot: &Robot) -> Result<String, Failure> {
    let n = robot.joints.len();
    let runtime = Reference::<f64>::from_robot(robot);
    let state = |step: usize| {
        // libm's sines are the same on all platforms; they are rounded to two digits.
        let value = |k: usize, size: f64| {
            let sine = libm::sin((7 * step + 3 * k) as f64);
            (size * sine * 100.0).round() / 100.0
        };
        let q = DVector::from_fn(n, |k, _| value(k, 1.5));
        let qd = DVector::from_fn(n, |k, _| value(k + 1, 2.0));
        let qdd = DVector::from_fn(n, |k, _| value(k + 2, 5.0));
        let torques = runtime.inverse_dynamics(&q, &qd, &qdd);
        let tau = torques.map_err(Failure::input)?;
        Ok([q, qd, qdd, tau].map(|vector| vector.as_slice().to_vec()))
    };
    let states: Result<Vec<texts::State>, Failure> = (1..=texts::STATES).map(state).collect();
    let text = texts::expected(&states?);
    Ok(sealed(Comment::Line, "dalembert renew", &text))
}

fn crate_name(folder: &Path) -> Result<String, Failure> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let refused = |help: String| {
        let why = format!("{name:?} cannot name a crate\n  = help: {help}");
        Err(Failure::input(why))
    };
    let plain = name.replace('-', "_");
    match suggested_name(&plain) {
        Some(good) if good != plain => refused(format!("write {good:?}")),
        None => {
            refused("lower-case letters, digits, hyphens and underscores, a letter first".into())
        }
        Some(good) if good == "dalembert" => refused(format!(
            "the new crate depends on the crate `{good}`: write \"my_{good}\""
        )),
        Some(_) => Ok(name.into_owned()),
    }
}

/// The checkout that this program was built from, if it still exists, otherwise the registry.
fn dependency(folder: &Path) -> String {
    let checkout = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let manifest = fs::read_to_string(Path::new(checkout).join("Cargo.toml")).unwrap_or_default();
    let is_dalembert = manifest.lines().any(|line| line == "name = \"dalembert\"");
    match fs::canonicalize(checkout).ok().filter(|_| is_dalembert) {
        // For a path that is text, Rust's debug format is a TOML string.
        Some(whole) => format!("path = {:?}", path_from(folder, &whole)),
        None => format!("version = {:?}", env!("CARGO_PKG_VERSION")),
    }
}

/// Relative if both are below one folder of the root, so that they can be moved together.
fn path_from(folder: &Path, checkout: &Path) -> String {
    let path = relative(checkout, &folder.join("Cargo.toml"));
    let is_name = |part: &Component| matches!(part, Component::Normal(_));
    let down = checkout.components().filter(is_name);
    // As many names as the checkout has: nothing but the root is shared.
    let names = path.split('/').filter(|part| *part != "..");
    match names.count() < down.count() {
        true => path,
        false => checkout.display().to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dependency_is_relative_where_folders_are_shared() {
        let here = fs::canonicalize(env!("CARGO_MANIFEST_DIR")).unwrap();
        assert_eq!(path_from(&here.join("new/arm"), &here), "../..");
        assert_eq!(path_from(&here.join("arm"), &here.join("src")), "../src");
        let far = Path::new("/nowhere/dalembert");
        assert_eq!(path_from(&here.join("arm"), far), far.display().to_string());
    }
}
