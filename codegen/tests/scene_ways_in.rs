//! Scenes by `dynamics!`: of a robot file, and of the text of one.

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
fn a_clause_names_a_scene_of_a_file() {
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

#[test]
fn a_clause_names_a_scene_of_a_text() {
    let arm = |scene: &str, clause: &str| {
        let joint = "kind = 'revolute'\na = 1\nmass = 1\ncom = [-0.5, 0, 0]\n\
                     inertia = [0, 0.1, 0.1, 0, 0, 0]";
        let robot = format!(
            "name = 'arm'\nconvention = 'standard'\ngravity = [0, -9.81, 0]\n\
             [[joint]]\nname = 'hip'\n{joint}\n[[joint]]\nname = 'knee'\n{joint}\n\
             [scene.pick]\n{scene}\n"
        );
        let text = format!("mod arm = {robot:?}; outputs: gravity; scalar: f64; scene: {clause};");
        expanded(&text, Path::new("."))
    };
    let text = plain(&arm("lock = { knee = '90deg' }", "pick"));
    assert!(!text.contains("compile_error"), "{text}");
    assert!(text.contains("fngravity(q:&[f64;2])->[f64;1]"), "{text}");
    for (scene, clause, message) in [
        ("lock = { 3 = 0 }", "pick", "there is no joint `3`"),
        ("speed = 'zero'", "pick", "unknown key `speed`"),
        ("", "[pick]", "expected the name of a scene"),
        (
            "",
            "pick { velocity: zero }",
            "expected the name of a scene",
        ),
    ] {
        let text = arm(scene, clause);
        assert!(text.contains("compile_error"), "{scene}: {text}");
        assert!(text.contains(message), "{scene}: {text}");
    }
}
