//! Coefficients that vanish or repeat, and why.

use std::collections::BTreeMap;

use dalembert_formulas::Quantity;
use dalembert_formulas::couplings::{Couplings, Inventory, Reason, Value, ZeroEntry};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::read::parse;
use dalembert_model::robot::Robot;

use crate::values::read;

fn general(kinds: &[&str]) -> Robot {
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
    parse(&text).unwrap().robot
}

/// Arms of general geometry with revolute joints have n(n² − 1)/3 independent symbols.
#[test]
fn general_arms_have_the_relations_of_every_arm() {
    for n in 1..=5 {
        let inventory = Inventory::new(&general(&vec!["revolute"; n])).unwrap();
        let [_, _, distinct] = inventory.summary(Quantity::Christoffel);
        assert_eq!(distinct, n * (n * n - 1) / 3, "{n}");
    }
}

/// h_iii = 0, h_iim = 0 for m ≤ i, h_ikm = 0 behind a prismatic joint, h_ikm = −h_kim.
#[test]
fn the_relations_are_named() {
    let inventory = Inventory::new(&general(&["revolute", "prismatic", "revolute"])).unwrap();
    let value = |name: &str| {
        let mut entries = inventory.0.iter();
        let entry = entries.find(|(entry, _)| entry.name().text == name);
        entry.unwrap().1.clone()
    };
    for name in ["h_333", "h_313", "h_123"] {
        assert_eq!(value(name), Value::Zero, "{name}");
    }
    let Value::OppositeOf(other) = value("h_311") else {
        panic!("h_311")
    };
    assert_eq!(other.name().text, "h_113");
}

/// Counts zeros by their reasons.
fn tally(robot: &Robot) -> BTreeMap<&'static str, usize> {
    let mut tally = BTreeMap::new();
    for zero in Couplings::new(robot).unwrap().zeros {
        *tally.entry(zero.reason.word()).or_insert(0) += 1;
    }
    tally
}

#[test]
fn every_zero_has_a_reason() {
    let cases: [(&str, &[(&str, usize)]); 8] = [
        (
            "generated/robots/puma560",
            &[("always", 21), ("body", 22), ("geometry", 3)],
        ),
        (
            "generated/robots/stanford",
            &[
                ("always", 21),
                ("body", 21),
                ("geometry", 7),
                ("joint kinds", 20),
            ],
        ),
        (
            "generated/robots/ur10",
            &[("always", 21), ("body", 7), ("geometry", 7)],
        ),
        ("generated/robots/panda", &[("always", 28), ("geometry", 1)]),
        (
            "codegen/tests/data/scara",
            &[("always", 10), ("geometry", 21), ("joint kinds", 3)],
        ),
        (
            "codegen/tests/data/rprpr",
            &[("always", 15), ("geometry", 2), ("joint kinds", 24)],
        ),
        (
            "gallery/robots/iiwa14",
            &[("always", 28), ("body", 20), ("geometry", 1)],
        ),
        (
            "gallery/robots/g1_hand",
            &[("always", 12), ("geometry", 6), ("limbs", 182)],
        ),
    ];
    for (name, wanted) in cases {
        let (robot, _) = read(&format!("{name}.toml"));
        let reasons = BTreeMap::from_iter(wanted.iter().copied());
        assert_eq!(tally(&robot), reasons, "{name}");
    }
}

/// Returns the reason of an entry that vanishes.
fn reason(robot: &Robot, name: &str) -> Option<String> {
    let mut zeros = Couplings::new(robot).unwrap().zeros.into_iter();
    let zero = zeros.find(|zero| zero.entry.name().text == name)?;
    Some(zero.reason.to_string())
}

fn arm(convention: &str, joints: &[&str]) -> Robot {
    let mut text =
        format!("name = \"arm\"\nconvention = \"{convention}\"\ngravity = [0, 0, -9.81]\n");
    for joint in joints {
        let body = match joint.contains("mass = 0") {
            true => "",
            false => "mass = 1\ncom = [0.1, 0.03, 0.2]\ninertia = [0.01, 0.011, 0.012, 0, 0, 0]",
        };
        text += &format!("[[joint]]\n{joint}\n{body}\n");
    }
    parse(&text).unwrap().robot
}

/// 0.3 + 0.3 − 0.6 is zero, and 30° + 30° + 30° a right angle, although each angle is an odd one.
#[test]
fn sums_of_odd_angles_are_seen() {
    let slide = "kind = \"prismatic\"\nalpha = ";
    let turn = "kind = \"revolute\"\nalpha = ";
    let radians = [
        "kind = \"revolute\"".to_owned(),
        format!("{slide}0.3"),
        format!("{slide}0.3"),
        format!("{turn}-0.6"),
    ];
    let degrees = [
        "kind = \"revolute\"".to_owned(),
        format!("{slide}\"30deg\""),
        format!("{slide}\"30deg\""),
        format!("{turn}\"-60deg\""),
    ];
    for joints in [radians, degrees] {
        let joints: Vec<&str> = joints.iter().map(String::as_str).collect();
        let robot = arm("modified", &joints);
        let why = "for all bodies, but only with these lengths and angles";
        assert_eq!(reason(&robot, "c_4").as_deref(), Some(why));
        let mut bent = joints.clone();
        bent[3] = "kind = \"revolute\"\nalpha = -0.6000001";
        assert_eq!(reason(&arm("modified", &bent), "c_4"), None);
    }
}

/// A link without mass has no inertia; an armature would give D_33 one.
#[test]
fn an_armature_that_is_missing_is_a_reason() {
    let turn = "kind = \"revolute\"\nalpha = \"pi/2\"\na = 0.1\nd = 0.2";
    let last = "kind = \"revolute\"\na = 0.123\nd = 0.456\nmass = 0";
    let why = reason(&arm("standard", &[turn, turn, last]), "D_33");
    assert_eq!(why.as_deref(), Some("ZZ3 = 0; joint 3 has no armature"));
    let driven = format!("{last}\narmature = 0.1");
    let robot = arm("standard", &[turn, turn, &driven]);
    assert_eq!(reason(&robot, "D_33"), None);
}

fn zeros(robot: &Robot) -> Vec<String> {
    let inventory = Inventory::new(robot).unwrap().0.into_iter();
    let zeros = inventory.filter(|(_, value)| *value == Value::Zero);
    zeros.map(|(entry, _)| entry.name().text).collect()
}

/// Changes the robot file's numbers, and compares the coefficients that appear with those whose reasons
/// name what changed.
#[test]
fn a_change_of_what_a_reason_names_makes_couplings() {
    let (puma, _) = read("generated/robots/puma560.toml");
    let before = zeros(&puma);
    let appeared = |change: &dyn Fn(&mut Robot)| {
        let mut robot = puma.clone();
        change(&mut robot);
        let after = zeros(&robot);
        assert!(after.iter().all(|name| before.contains(name)), "{after:?}");
        let gone = before.iter().filter(|name| !after.contains(name));
        gone.cloned().collect::<Vec<String>>()
    };
    let small = |n: i64| Rational::new(n.into(), 1_000_000.into());
    // Axis 6 is principal of link 6, in the xz plane.
    let product = appeared(&|robot| robot.joints[5].inertia.xz = small(3));
    let body = Couplings::new(&puma).unwrap();
    let named = |words: &str| -> Vec<String> {
        let is_named = |zero: &&ZeroEntry| match &zero.reason {
            Reason::Body { conditions, .. } => {
                conditions.iter().any(|condition| condition.contains(words))
            }
            _ => false,
        };
        let zeros = body.zeros.iter().filter(is_named);
        zeros.map(|zero| zero.entry.name().text).collect()
    };
    assert_eq!(product, named("axis 6 is a principal axis"));
    // Its moments across the axis.
    let moment = appeared(&|robot| robot.joints[5].inertia.xx += small(5));
    assert_eq!(moment, named("equal moments"));
    // Axes 2 and 3 are parallel; of gravity the first joint feels nothing.
    let twist = Angle::Radians(Rational::new(1.into(), 10.into()));
    let turned = appeared(&|robot| robot.joints[1].alpha = twist.clone());
    let has = |name: &str| turned.iter().any(|entry| entry == name);
    for name in ["h_213", "h_312", "h_236", "h_623"] {
        assert!(has(name), "{name}: {turned:?}");
    }
    assert!(!has("c_1"));
    assert_eq!(appeared(&|robot| robot.gravity[0] = small(100)), ["c_1"]);
}

/// A PUMA whose last link is off its axis, but balanced: I_xz = m x̄ z̄.
#[test]
fn rotation_balances_translation() {
    let (mut puma, _) = read("generated/robots/puma560.toml");
    let decimal = |n: i64| Rational::new(n.into(), 10_000_000.into());
    let tip = &mut puma.joints[5];
    tip.com = [100_000, 0, 320_000].map(decimal);
    tip.inertia.xx = decimal(1500);
    tip.inertia.yy = decimal(1500);
    tip.inertia.zz = decimal(400);
    tip.inertia.xz = decimal(288);
    let mut balanced = Couplings::new(&puma).unwrap().zeros;
    balanced.retain(|zero| zero.reason.word() == "balance");
    let names = balanced.iter().map(|zero| zero.entry.name().text);
    assert_eq!(names.collect::<Vec<_>>(), ["D_56", "h_466", "h_566"]);
    assert!(balanced.iter().all(|zero| zero.rotation.is_some()));
    assert_eq!(tally(&puma)["geometry"], 3);
}

#[test]
fn near_misses_are_found() {
    let (stanford, _) = read("generated/robots/stanford.toml");
    let near = Couplings::new(&stanford).unwrap().near;
    let weak: Vec<String> = near.weak.iter().map(|weak| weak.0.name().text).collect();
    assert_eq!(weak, ["D_45", "D_26", "D_16", "D_46"]);
    let nearest = &near.alive[0];
    let (name, vanishing) = (nearest.symbol.code.as_str(), nearest.vanishing);
    assert_eq!((name, vanishing), ("z5", 0.0));
    let entries = nearest.entries.iter().map(|entry| entry.name().text);
    assert_eq!(entries.collect::<Vec<_>>(), ["D_45", "h_455"]);
    // One small number alone does it.
    assert!(near.small.is_none());
}
