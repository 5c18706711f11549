//! The build script's builder: what it writes, when it writes, what it says.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use dalembert_build::{
    BuildError, Generator, Layout, Output, Parameter, Scalar, SinCos,
};
use dalembert_codegen::workspace::clauses::RobotFile;
use dalembert_codegen::workspace::generate::generate;
use dalembert_codegen::workspace::task::Request;

/// Returns an empty folder of one test, with the robot file of the planar arm.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("builder")
        .join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots/planar2r.toml");
    fs::copy(robot, folder.join("arm.toml")).unwrap();
    folder
}

fn generator(folder: &Path) -> Generator {
    Generator::new()
        .robot(folder.join("arm.toml"))
        .outputs([Output::Gravity])
        .scalars([Scalar::F32])
}

/// Returns whether a file is written again is seen from its time, so that goes back
/// to the past.
fn age(path: &Path) -> SystemTime {
    let file = fs::File::options().append(true).open(path).unwrap();
    let past = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
    file.set_modified(past).unwrap();
    past
}

fn modified(path: &Path) -> SystemTime {
    fs::metadata(path).unwrap().modified().unwrap()
}

#[test]
fn writes_what_the_one_function_generates() {
    let folder = folder("text");
    let path = folder.join("deep/er/arm.rs");
    generator(&folder).write_to(&path).unwrap();
    let robot = RobotFile::read(&folder.join("arm.toml")).unwrap().robot;
    let request = Request {
        scalars: vec![Scalar::F32],
        ..Request::of(&[Output::Gravity])
    };
    let text = fs::read_to_string(&path).unwrap();
    let (header, text) = text.split_once('\n').unwrap();
    assert!(header.starts_with("// input "), "{header}");
    assert_eq!(text, generate(&robot, &request).unwrap().text);
    // Nothing half-written is left behind.
    assert_eq!(fs::read_dir(folder.join("deep/er")).unwrap().count(), 1);
}

#[test]
fn writes_again_only_if_something_changed() {
    let folder = folder("again");
    let path = folder.join("arm.rs");
    generator(&folder).write_to(&path).unwrap();
    let first = fs::read_to_string(&path).unwrap();
    let past = age(&path);
    generator(&folder).write_to(&path).unwrap();
    assert_eq!(modified(&path), past);

    // Another choice.
    generator(&folder).module("other").write_to(&path).unwrap();
    assert!(fs::read_to_string(&path).unwrap().contains("pub mod other"));

    // An edit by hand does not stay.
    fs::write(&path, first.replace("pub const N", "const N")).unwrap();
    generator(&folder).write_to(&path).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), first);

    // Another robot.
    age(&path);
    let robot = fs::read_to_string(folder.join("arm.toml")).unwrap();
    fs::write(folder.join("arm.toml"), robot.replace("9.81", "1.62")).unwrap();
    generator(&folder).write_to(&path).unwrap();
    assert_ne!(modified(&path), past);
    assert!(fs::read_to_string(&path).unwrap().contains("1.62"));
}

/// The words of the choice are the paths of its crate.
#[test]
fn sines_are_called_where_they_are() {
    let folder = folder("sines");
    let path = folder.join("arm.rs");
    for (sincos, call) in [
        (SinCos::Auto, "libm::"),
        (SinCos::Together, "dalembert_sines::sincosf(&["),
    ] {
        generator(&folder).sincos(sincos).write_to(&path).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(&format!(" = {call}")), "{sincos:?} {text}");
    }
}

/// Nobody has columns who did not ask for them.
#[test]
fn batches_are_asked_for() {
    let folder = folder("batches");
    let path = folder.join("arm.rs");
    for chosen in [true, false] {
        generator(&folder).batch(chosen).write_to(&path).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.contains("pub fn gravity_columns("), chosen);
        assert_eq!(text.contains("dalembert_batch::"), chosen);
    }
}

#[test]
fn says_what_is_wrong_and_leaves_the_file_alone() {
    let folder = folder("wrong");
    let path = folder.join("arm.rs");
    fs::write(&path, "as it was").unwrap();
    let robot = folder.join("arm.toml");
    let text = fs::read_to_string(&robot).unwrap();
    fs::write(&robot, text.replace("mass = 1\n", "mas = 1\n")).unwrap();

    let error = generator(&folder).write_to(&path).unwrap_err().to_string();
    let line = 1 + text.lines().position(|line| line == "mass = 1").unwrap();
    let place = format!(" --> {}:{line}:1\n", robot.display());
    assert!(error.contains("error: unknown key `mas`\n"), "{error}");
    assert!(error.contains(&place), "{error}");
    assert!(error.contains("did you mean `mass`?"), "{error}");
    // Both joints lack it, and both are told.
    assert_eq!(error.matches("error: ").count(), 4, "{error}");

    let missing = Generator::new().robot(folder.join("arn.toml"));
    let error = missing.write_to(&path).unwrap_err().to_string();
    assert!(error.starts_with("error: there is no file `"), "{error}");
    assert!(error.ends_with("arm.toml`?"), "{error}");

    let error = Generator::new().write_to(&path).unwrap_err();
    // `main` prints errors with Debug.
    assert!(format!("{error:?}").contains("no robot file"), "{error:?}");

    fs::write(&robot, &text).unwrap();
    let error = generator(&folder).outputs([]).write_to(&path).unwrap_err();
    assert!(error.to_string().contains("nothing to generate"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "as it was");

    // A folder is in the way.
    let error = generator(&folder)
        .write_to(&folder)
        .unwrap_err()
        .to_string();
    assert!(error.starts_with("error: cannot write "), "{error}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
}

const SCENE: &str = r#"
[scene.swing]
outputs = ["inverse_dynamics"]
lock = { 2 = "pi/2" }
velocity = "zero"
scalar = "f64"
"#;

#[test]
fn the_builder_takes_a_scene() {
    let folder = folder("scene");
    let robot = folder.join("arm.toml");
    let source = fs::read_to_string(&robot).unwrap();
    fs::write(&robot, format!("{source}{SCENE}")).unwrap();
    let output = folder.join("arm.rs");
    let build = |scene: &str| {
        Generator::new()
            .robot(&robot)
            .scene(scene)
            .write_to(&output)
    };
    build("swing").unwrap();
    let text = fs::read_to_string(&output).unwrap();
    assert!(text.contains("pub mod planar2r_swing {"), "{text}");
    assert!(
        !text.contains("f32") && !text.contains("fn gravity"),
        "{text}"
    );
    let error = build("swingg").unwrap_err().to_string();
    assert!(error.contains("did you mean `swing`?"), "{error}");
}

/// The contents of a module: what stands in `src/arm.rs` for `mod arm;`.
#[test]
fn the_contents_have_no_module_and_one_scalar() {
    let folder = folder("contents");
    let path = folder.join("arm.rs");
    let contents = generator(&folder).layout(Layout::Contents);
    contents.write_to(&path).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert!(!text.contains("mod "), "{text}");
    for piece in [
        "\n//! Dynamics of the robot `planar2r`",
        "\n#![cfg_attr(rustfmt, rustfmt_skip)]\n",
        "\npub const N: usize = 2;\n",
        "\npub fn gravity(q: &[f32; 2]) -> [f32; 2] {\n",
    ] {
        assert!(text.contains(piece), "{piece}: {text}");
    }
    let error = contents
        .scalars([Scalar::F64, Scalar::F32])
        .write_to(&path)
        .unwrap_err();
    assert!(matches!(error, BuildError::Generate(..)));
    assert!(error.to_string().contains("one scalar"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
}

/// Parameters are the file's, and another choice of them is another file.
#[test]
fn parameters_are_arguments() {
    let folder = folder("parameters");
    let path = folder.join("arm.rs");
    let text = |parameters: &[Parameter]| {
        let generator = generator(&folder).parameters(parameters.iter().copied());
        generator.write_to(&path).unwrap();
        fs::read_to_string(&path).unwrap()
    };
    let plain = text(&[]);
    assert!(plain.contains("pub fn gravity(q: &[f32; 2]) -> [f32; 2] {"));
    assert!(!plain.contains("Load"));
    let taking = text(&[Parameter::Payload, Parameter::Gravity]);
    assert!(taking.contains("pub fn load(payload: &Payload) -> Load {"));
    assert!(
        taking.contains("pub fn gravity(q: &[f32; 2], g: &Gravity, load: &Load) -> [f32; 2] {")
    );
    assert_eq!(text(&[]), plain);
}

/// A bundle besides what is chosen, and alone; what is wrong with it is said before
/// anything is read.
#[test]
fn bundles_beside_outputs() {
    let folder = folder("bundle");
    let path = folder.join("arm.rs");
    let parts = [Output::Inertia, Output::Gravity];
    let of = |generator: Generator| {
        generator.bundle("hold", parts).write_to(&path).unwrap();
        fs::read_to_string(&path).unwrap()
    };
    let both = of(generator(&folder));
    assert!(both.contains("pub fn gravity(q: &[f32; 2]) -> [f32; 2] {"));
    assert!(both.contains("pub fn hold(q: &[f32; 2]) -> Hold {"));
    let robot = folder.join("arm.toml");
    let alone = of(Generator::new().robot(&robot).scalars([Scalar::F64]));
    assert!(!alone.contains("pub fn gravity(") );
    assert!(alone.contains("pub fn hold("));
    let twice = [Output::Gravity, Output::ManipulatorEquation];
    let error = generator(&folder).bundle("hold", twice).write_to(&path);
    let error = error.unwrap_err();
    assert!(matches!(error, BuildError::Bundle(_)));
    let said = error.to_string();
    assert!(
        said.contains("both return c") && said.contains("help: leave one"),
        "{said}"
    );
}

/// Roots are called where sines are; a file that has no width is refused by its line.
#[test]
fn friction_is_smoothed_where_sines_are() {
    let folder = folder("coulomb");
    let path = folder.join("arm.rs");
    let robot = fs::read_to_string(folder.join("arm.toml")).unwrap();
    let with = |keys: &str| {
        let text = robot.replacen("mass =", &format!("{keys}\nmass ="), 1);
        fs::write(folder.join("arm.toml"), text).unwrap();
    };
    let generator = || {
        generator(&folder).outputs([Output::InverseDynamics])
    };
    with("coulomb = 2.5\ncoulomb_width = 0.01");
    generator().write_to(&path).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let line = "let r1 = 1.0 / libm::sqrtf(qd[0] * qd[0] + 0.0001);";
    assert_eq!(text.matches(line).count(), 1, "{text}");
    with("coulomb = 2.5");
    let error = generator().write_to(&path).unwrap_err().to_string();
    for words in [
        "Coulomb friction without a `coulomb_width`",
        "arm.toml:",
        "in rad/s",
    ] {
        assert!(error.contains(words), "{error}");
    }
}
