//! Variants that a tolerance admitted, shown by the checker that shares no formula with the generator.

use dalembert_checker::certify::certify;
use dalembert_codegen::workspace::{Certificate, Setup, claim_of};
use dalembert_model::read::{self, Options};

/// Has `dalembert-checker` show a variant of a robot's file, by its text and its claim alone.
pub fn shown(source: &str, own: &Certificate) {
    let reading = read::parse(source, &Options::default()).unwrap();
    let name = own.scene.as_ref().map(|scene| scene.name.as_str());
    let scene = reading
        .scenes
        .iter()
        .find(|scene| Some(scene.name.as_str()) == name);
    let setup = Setup::in_scene(&reading.robot, scene).unwrap();
    let claim = claim_of(&reading.robot, source, &setup, own).write();
    let report = certify(&own.text, &claim, source, name, None).unwrap();
    assert!(report.is_shown(), "{report:?}");
}
