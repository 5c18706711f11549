//! Scenes by `dynamics!`: of the robot file, beside it and in the robot's block.

use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::clauses::expand;

const SCENE: &str = r#"
[scene.swing]
outputs = ["inverse_dynamics"]
lock = { 1 = "pi/2", 3 = 0 }
velocity = "zero"
scalar = "f64"
"#;

/// Returns a folder with the planar arm of three joints and a scene.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots/planar3r.toml");
    let source = fs::read_to_string(robot).unwrap();
    fs::write(folder.join("arm.toml"), format!("{source}{SCENE}")).unwrap();
    folder
}

fn expanded(invocation: &str, base: &Path) -> String {
    let tokens = invocation.parse().unwrap();
    expand(tokens, base).to_string()
}

/// Returns the tokens without spaces: these depend on the lexer.
fn plain(text: &str) -> String {
    text.split_whitespace().collect()
}

#[test]
fn a_clause_names_a_scene_of_the_file() {
    let folder = folder("scene_clause");
    let text = plain(&expanded(
        "pub mod arm = \"arm.toml\"; scene: swing;",
        &folder,
    ));
    assert!(!text.contains("compile_error"), "{text}");
    assert!(text.contains("pubmodarm{"), "{text}");
    assert!(text.contains("pubfninverse_dynamics(q:&[f64;3],qdd:&[f64;3])->[f64;1]"));
    assert!(!text.contains("fngravity"), "the scene's outputs only");

    let text = expanded("mod arm = \"arm.toml\"; scene: swig;", &folder);
    assert!(text.contains("the robot has no scene `swig`"), "{text}");
    assert!(text.contains("did you mean `swing`?"), "{text}");
}

/// A scene that stands in the macro, of a robot that does not.
#[test]
fn a_scene_beside_a_file() {
    let folder = folder("scene_beside");
    let with = |scene: &str| {
        let text = format!("mod arm = \"arm.toml\"; scene: {scene};");
        expanded(&text, &folder)
    };
    let text = plain(&with(
        "reach { outputs: [gravity], lock: { elbow: pi/2, 1: 0 } }",
    ));
    assert!(!text.contains("compile_error"), "{text}");
    assert!(text.contains("fngravity(q:&[f64;3])->[f64;1]"), "{text}");
    // The tolerance too: what was left out is in the documentation.
    let tolerant = with(
        "rough { outputs: [inverse_dynamics], lock: { 1: 0 }, \
         box: { velocity: [1, 1, 1], acceleration: [1, 2, 2] }, \
         tolerance: { value: 0.1, relative_to: range } }",
    );
    assert!(!tolerant.contains("compile_error"), "{tolerant}");
    assert!(tolerant.contains("Left out"), "{tolerant}");
    for (wrong, message) in [
        ("swing { velocity: zero }", "swing"),
        ("reach { lock: { 4: 0 } }", "there is no joint `4`"),
        ("reach { lock: { elbw: 0 } }", "did you mean `elbow`?"),
        ("reach { box: { velocity: [1] } }", "one entry a joint"),
        ("reach { speed: zero }", "unknown key `speed`"),
        (
            "reach { tolerance: { value: 0, relative_to: range } }",
            "a tolerance is above zero",
        ),
        (
            "reach { outputs: [gravity], tolerance: { value: 1e-3, relative_to: actuator } }",
            "needs the torque limit of joint 1",
        ),
        ("[reach]", "expected the name of a scene"),
        (
            "reach { velocity: zero } gravity",
            "expected the name of a scene",
        ),
    ] {
        let text = with(wrong);
        assert!(text.contains("compile_error"), "{wrong}: {text}");
        assert!(text.contains(message), "{wrong}: {text}");
    }
}

#[test]
fn a_block_is_a_scene() {
    let arm = |scene: &str| {
        let text = format!(
            "mod arm {{
                convention: standard;
                gravity: [0, -9.81, 0];
                joint {{ name: hip, kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 0.1, 0.1, 0, 0, 0] }}
                joint {{ name: knee, kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 0.1, 0.1, 0, 0, 0] }}
                scene pick {{ {scene} }}
            }}
            outputs: gravity; scalar: f64; scene: pick;"
        );
        expanded(&text, Path::new("."))
    };
    for lock in ["lock: { 2: pi/2 }", "lock: { knee: 90deg }, joints: [hip]"] {
        let text = plain(&arm(lock));
        assert!(!text.contains("compile_error"), "{text}");
        assert!(text.contains("fngravity(q:&[f64;2])->[f64;1]"), "{text}");
    }
    for (wrong, message) in [
        ("lock: { 3: 0 }", "there is no joint `3`"),
        ("lock: { nee: 0 }", "did you mean `knee`?"),
        ("lock: { 2 }", "expected `joint: position`"),
        ("lock: { 2: 0, knee: 1 }", "is locked already"),
        ("velocity: none", "expected"),
        ("speed: zero", "unknown key `speed`"),
    ] {
        let text = arm(wrong);
        assert!(text.contains("compile_error"), "{wrong}: {text}");
        assert!(text.contains(message), "{wrong}: {text}");
    }
}
