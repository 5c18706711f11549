//! Coefficients that vanish or repeat: the relations of every arm.

use dalembert_cli::couplings::{Value, couplings, summary};
use dalembert_codegen::workspace::Quantity;

use crate::robots as support;

fn general(kinds: &[&str]) -> String {
    let mut text =
        String::from("name = \"general\"\nconvention = \"standard\"\ngravity = [1, 2, -9]\n");
    for (i, kind) in kinds.iter().enumerate() {
        let length = if *kind == "revolute" { "d" } else { "offset" };
        text += &format!(
            "[[joint]]\nkind = \"{kind}\"\nalpha = 0.{}\na = 0.{}\n{length} = 0.{}\nmass = {}\n\
             com = [0.1{i}, 0.2{i}, 0.3{i}]\ninertia = [0.5, 0.6{i}, 0.7, 0.01{i}, 0.02, 0.03{i}]\n",
            i + 4,
            i + 3,
            i + 2,
            i + 1,
        );
    }
    text
}

/// Arms of general geometry with revolute joints have n(n² − 1)/3 independent symbols.
#[test]
fn general_arms_have_the_relations_of_every_arm() {
    for n in 1..=5 {
        let robot = support::read_robot(&general(&vec!["revolute"; n]));
        let couplings = couplings(&robot).unwrap();
        let h = summary(&couplings, Quantity::Christoffel);
        assert_eq!(h[2], n * (n * n - 1) / 3, "{n}");
    }
}

/// h_iii = 0, h_iim = 0 for m ≤ i, h_ikm = 0 behind a prismatic joint, h_ikm = −h_kim.
#[test]
fn the_relations_are_named() {
    let robot = support::read_robot(&general(&["revolute", "prismatic", "revolute"]));
    let couplings = couplings(&robot).unwrap();
    for (name, value) in [
        ("h_333", Value::Zero),
        ("h_313", Value::Zero),
        ("h_123", Value::Zero),
        ("h_311", Value::OppositeOf("h_113".to_owned())),
    ] {
        let found = couplings.iter().find(|own| own.name == name).unwrap();
        assert_eq!(found.value, value, "{name}");
    }
}

#[test]
fn too_many_joints_are_refused() {
    let robot = support::read_robot(&general(&["revolute"; 28]).replace("0.2{i}", "0.2"));
    assert_eq!(couplings(&robot), None);
}
