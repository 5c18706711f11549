//! Coefficients that vanish or repeat: the known counts, and the reasons.

use dalembert_codegen::workspace::function::Quantity;
use dalembert_report::couplings::{Couplings, Finding, Reason};

use crate::support;

fn summary(couplings: &Couplings, quantity: Quantity) -> (usize, usize, usize) {
    let summary = couplings.summary(quantity);
    (summary.total, summary.zero, summary.distinct)
}

#[test]
fn the_known_counts() {
    let puma = Couplings::of(&support::robot("puma560")).unwrap();
    assert_eq!(summary(&puma, Quantity::Christoffel), (126, 42, 35));
    assert_eq!(puma.summary(Quantity::Inertia).zero, 2);
    assert_eq!(puma.summary(Quantity::Gravity).zero, 2);
    let stanford = Couplings::of(&support::robot("stanford")).unwrap();
    assert_eq!(summary(&stanford, Quantity::Christoffel), (126, 64, 34));
}

/// Returns an arm by standard DH, every number general but the joint kinds.
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

/// What is left when the geometry has no part in it: the relations of every
/// arm, n(n² − 1)/3 independent symbols for revolute chains.
#[test]
fn general_arms_have_the_relations_of_every_arm() {
    for n in 1..=5 {
        let robot = support::read_robot(&general(&vec!["revolute"; n]));
        let couplings = Couplings::of(&robot).unwrap();
        let h = couplings.summary(Quantity::Christoffel);
        assert_eq!(h.distinct, n * (n * n - 1) / 3, "{n}");
        for entry in &couplings.entries {
            match entry.finding {
                Finding::Zero(reason) | Finding::Repeats { reason, .. } => {
                    assert_ne!(reason, Reason::Geometry, "{}", couplings.name(entry));
                }
                Finding::Distinct => {}
            }
        }
    }
}

#[test]
fn every_reason_is_given() {
    let robot = support::read_robot(&general(&["revolute", "prismatic", "revolute"]));
    let couplings = Couplings::of(&robot).unwrap();
    let finding = |name: &str| {
        let mut entries = couplings.entries.iter();
        entries
            .find(|entry| couplings.name(entry) == name)
            .unwrap()
            .finding
    };
    assert_eq!(finding("h_333"), Finding::Zero(Reason::OwnSquare));
    assert_eq!(finding("h_313"), Finding::Zero(Reason::OwnProduct));
    assert_eq!(finding("h_123"), Finding::Zero(Reason::Prismatic));
    assert_eq!(finding("h_322"), Finding::Zero(Reason::Prismatic));
    let Finding::Repeats {
        entry,
        opposite,
        reason,
    } = finding("h_311")
    else {
        panic!("h_311 = −h_113");
    };
    assert_eq!(couplings.name(&couplings.entries[entry]), "h_113");
    assert!(opposite);
    assert_eq!(reason, Reason::Antisymmetry);
}

#[test]
fn too_many_joints_are_refused() {
    let robot = support::read_robot(&general(&["revolute"; 28]).replace("0.2{i}", "0.2"));
    assert_eq!(Couplings::of(&robot), None);
}
