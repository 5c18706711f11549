//! Robot files and tolerances that are refused, by name.

use dalembert_checker::certify::{Demand, certify};

use crate::support::{changed, file, in_scene};

const ROBOTS: &str = r#"
mass = 1 | &; springs = {} | unknown field `springs`
mass = 1 | mass = true | is not a number, text, list or table
[scene.pick] | &; wind = 1 | unknown field `wind`
[scene.pick] | [scene.other] | no scene `pick`
relative_to = "actuator" | relative_to = 1, of = 2 | unknown field `of`
value = 5e-2 | value = [5e-2] | expected a number, or one a joint
value = 5e-2 | value = "much" | expected a number, or one a joint
position = ["-pi", "pi"] | position = ["pi", "-pi"] | the range of `q` is empty
position = ["-pi", "pi"] | position = [nan, 1] | the range of `q` is empty
velocity = 2 | velocity = -2 | the range of `qd` is empty
acceleration = 10 | acceleration = -10 | the range of `qdd` is empty
torque = 50 | torque = -50 | the range of `tau` is empty
[scene.pick] | &; box = { position = [[1, -1], [0, 1]] } | the range of `q` is empty
[scene.pick] | &; box = { velocity = [-1, 1] } | the range of `qd` is empty
[scene.pick] | &; box = { acceleration = [1, -1] } | the range of `qdd` is empty
[scene.pick] | &; box = { depth = [1, -1] } | unknown field `depth`
convention | name | duplicate key
"#;

#[test]
fn robot_files_that_are_none() {
    let source = file("crates/checker/tests/data/attacks/r2_conf.toml");
    let claim = r#"{ "claim": 2, "constants": [], "functions": [] }"#;
    let text = file("crates/checker/tests/data/attacks/C.rs.txt");
    for (robot, words) in changed(&source, ROBOTS) {
        let fault = certify(&text, claim, &robot, &in_scene("pick"));
        let why = fault.unwrap_err().to_string();
        assert!(why.contains(words), "{words}: {why}");
    }
    let long = format!("{source}#{}", "#".repeat(1 << 18));
    assert!(certify(&text, claim, &long, &Demand::default()).is_err());
    let deep = format!("a{} = 1", ".a".repeat(50_000));
    assert!(certify(&text, claim, &deep, &Demand::default()).is_err());
}
