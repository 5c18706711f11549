//! The build script's builder: what it writes, when it writes, what it says.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use dalembert_build::Generator;
use dalembert_codegen::{Language, RobotFile, ask};

fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("builder/{test}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../generated/robots/planar2r.toml");
    fs::copy(robot, folder.join("arm.toml")).unwrap();
    folder
}

fn generator(folder: &Path) -> Generator {
    Generator::new(folder.join("arm.toml"))
        .ask("outputs", "gravity")
        .ask("scalar", "f32")
}

fn refused(generator: &Generator, path: &Path) -> String {
    generator.write_to(path).unwrap_err().to_string()
}

/// Returns true if a generator leaves a file alone, by a time of the file in the past.
fn leaves(generator: &Generator, path: &Path) -> bool {
    let file = fs::File::options().append(true).open(path).unwrap();
    let past = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
    file.set_modified(past).unwrap();
    generator.write_to(path).unwrap();
    fs::metadata(path).unwrap().modified().unwrap() == past
}

#[test]
fn writes_what_the_one_function_generates() {
    let folder = folder("text");
    let path = folder.join("deep/er/arm.rs");
    generator(&folder).write_to(&path).unwrap();
    let robot = RobotFile::read(&folder.join("arm.toml")).unwrap();
    let asked = "outputs: gravity; scalar: f32".parse().unwrap();
    let made = ask(&robot, &asked, Language::Rust, "arm.toml").unwrap();
    let generated = made.generated;
    let files = generated.files(&made.request, "../../arm.toml", &robot.source);
    assert_eq!(fs::read_to_string(&path).unwrap(), files[0]);
    assert_eq!(fs::read_dir(folder.join("deep/er")).unwrap().count(), 1);
}

#[test]
fn writes_again_only_if_something_changed() {
    let folder = folder("again");
    let path = folder.join("arm.rs");
    generator(&folder).write_to(&path).unwrap();
    let first = fs::read_to_string(&path).unwrap();
    assert!(leaves(&generator(&folder), &path));

    // Line ends of a checkout.
    fs::write(&path, first.replace('\n', "\r\n")).unwrap();
    assert!(leaves(&generator(&folder), &path));
    assert!(leaves(&generator(&folder).ask("fma", "off"), &path));
    let together = generator(&folder).ask("sincos", "together");
    together.write_to(&path).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("dalembert_sines::sincosf(&["), "{text}");

    for (text, why) in [
        (first.replace("pub const N", "const N"), "was edited since"),
        ("fn mine() {}\n".to_owned(), "was not written by"),
    ] {
        fs::write(&path, &text).unwrap();
        let error = refused(&generator(&folder), &path);
        assert!(error.contains(why), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }
    fs::remove_file(&path).unwrap();
    generator(&folder).write_to(&path).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), first);

    let robot = fs::read_to_string(folder.join("arm.toml")).unwrap();
    fs::write(folder.join("arm.toml"), robot.replace("9.81", "1.62")).unwrap();
    assert!(!leaves(&generator(&folder), &path));
    assert!(fs::read_to_string(&path).unwrap().contains("1.62"));
}

#[test]
fn each_scalar_has_its_file() {
    let folder = folder("scalars");
    let both = generator(&folder).ask("scalar", "f64, f32");
    both.write_to(folder.join("arm.rs")).unwrap();
    let text = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    assert!(text("arm.rs").contains("pub fn gravity(q: &[f64; 2]) -> [f64; 2] {"));
    assert!(text("arm_f32.rs").contains("pub fn gravity(q: &[f32; 2]) -> [f32; 2] {"));
    // The one that is missing is written; the other has not changed.
    fs::remove_file(folder.join("arm_f32.rs")).unwrap();
    both.write_to(folder.join("arm.rs")).unwrap();
    assert!(text("arm_f32.rs").contains("f32"));
    both.write_to(folder.join("arm.h")).unwrap();
    assert!(text("arm.h").contains("planar2r_f32_gravity("));
    assert!(text("arm.h").contains("planar2r_gravity("));
    let error = refused(&both, &folder.join("arm.txt"));
    let said = "does not end as a file of any language";
    assert!(error.contains(said), "{error}");
}

#[test]
fn says_what_is_wrong_and_leaves_the_file_alone() {
    let folder = folder("wrong");
    let path = folder.join("arm.rs");
    fs::write(&path, "as it was").unwrap();
    let robot = folder.join("arm.toml");
    let text = fs::read_to_string(&robot).unwrap();
    fs::write(&robot, text.replace("mass = 1\n", "mas = 1\n")).unwrap();

    let error = refused(&generator(&folder), &path);
    let line = 1 + text.lines().position(|line| line == "mass = 1").unwrap();
    let place = format!(" --> {}:{line}:1\n", robot.display());
    assert!(error.contains("error: unknown key `mas`\n"), "{error}");
    assert!(error.contains(&place), "{error}");
    assert!(error.contains("did you mean `mass`?"), "{error}");
    assert_eq!(error.matches("error: ").count(), 4, "{error}");

    let missing = Generator::new(folder.join("arn.toml"));
    let error = missing.write_to(&path).unwrap_err();
    // `main` prints errors with Debug.
    let error = format!("{error:?}");
    let is_missing = error.starts_with("\nerror: `") && error.contains("does not exist");
    assert!(is_missing, "{error}");
    assert!(error.ends_with("arm.toml`?"), "{error}");

    fs::write(&robot, &text).unwrap();
    let wrong = generator(&folder).ask("outputs", "gravty");
    let error = refused(&wrong.ask("fma", "onn"), &path);
    for said in [
        "outputs: unknown output `gravty`: did you mean `gravity`?",
        "fma: unknown choice `onn`: did you mean `on`?",
    ] {
        assert!(error.contains(said), "{error}");
    }
    let error = refused(&generator(&folder).ask("output", "gravity"), &path);
    let said = "unknown option `output`: did you mean `outputs`?";
    assert!(error.contains(said), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "as it was");

    let file = folder.join("folder.rs");
    fs::create_dir(&file).unwrap();
    let error = refused(&generator(&folder), &file);
    assert!(error.starts_with("error: cannot write "), "{error}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 3);
}

const SCENE: &str = r#"
[scene.swing]
outputs = ["inverse_dynamics"]
lock = { 2 = "pi/2" }
velocity = "zero"
scalar = "f32"
"#;

#[test]
fn the_builder_takes_a_scene() {
    let folder = folder("scene");
    let robot = folder.join("arm.toml");
    let source = fs::read_to_string(&robot).unwrap();
    fs::write(&robot, format!("{source}{SCENE}")).unwrap();
    let output = folder.join("arm.rs");
    let build = |scene: &str| Generator::new(&robot).ask("scene", scene);
    build("swing").write_to(&output).unwrap();
    let text = fs::read_to_string(&output).unwrap();
    let torques = "pub fn inverse_dynamics(q: &[f32; 2]";
    assert!(text.contains(torques), "{text}");
    assert!(!text.contains("fn gravity"), "{text}");
    assert!(leaves(&build("swing"), &output));
    let error = refused(&build("swingg"), &output);
    assert!(error.contains("did you mean `swing`?"), "{error}");
}
