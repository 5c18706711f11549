//! The planar arm of three joints with scenes.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// Two joints that need little, so that a search is quick.
const SCENES: &str = r#"
[scene.pick]
outputs = ["inverse_dynamics"]
lock = { 1 = 0 }
box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }
tolerance = { value = 0.1, relative_to = "range" }
scalar = "f64"

[scene.exactly]
outputs = ["gravity"]
tolerance = { value = 1e-17, relative_to = "range" }
scalar = "f64"

[scene.any]
outputs = ["gravity"]
tolerance = { value = [1e-3, 1e-3, 1e-2], relative_to = "range" }
"#;

/// Returns the planar arm of three joints with scenes, in a folder of its own.
pub fn arm(name: &str) -> (PathBuf, String) {
    super::arm(name, "planar3r", SCENES)
}

pub fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

pub fn json(file: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}
