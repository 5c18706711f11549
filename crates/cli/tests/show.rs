//! `dalembert show`: the drawing of an arm.

use dalembert_cli::drawing;

use crate::robots::{read_robot, source};

#[test]
fn bodies_stay_on_the_paper() {
    let planar = source("planar2r", "");
    let large = planar.replace("[0, 0.08333333333333333, 0.08333333333333333,", "[1, 3, 3,");
    assert_ne!(large, planar);
    let drawn = drawing::svg(&read_robot(&large), &[0.6, 0.7]).unwrap();
    let number = |text: &str, before: &str, after: char| -> f64 {
        let start = text.find(before).unwrap() + before.len();
        let rest = &text[start..];
        rest[..rest.find(after).unwrap()].parse().unwrap()
    };
    let mut count = 0;
    for line in drawn.lines().filter(|line| line.contains("<ellipse")) {
        let [a, b] = [number(line, "rx=\"", '"'), number(line, "ry=\"", '"')];
        let x = number(line, "translate(", ' ');
        let y = number(line, &format!("translate({x:.1} "), ')');
        let turned = number(line, "rotate(", ')').to_radians();
        let across = (a * turned.cos()).hypot(b * turned.sin());
        let along = (a * turned.sin()).hypot(b * turned.cos());
        let left = if x < 440.0 { 0.0 } else { 440.0 };
        assert!(x - across >= left && x + across <= left + 440.0, "{line}");
        assert!(y - along >= 64.0 && y + along <= 504.0, "{line}");
        count += 1;
    }
    assert_eq!(count, 4);
}

/// A base that floats has no pose and no axes of its own to draw: it is one body more, and its joints
/// are counted from one.
#[test]
fn a_base_that_floats_is_a_body() {
    let robot = read_robot(&source("two_legs", ""));
    let drawn = drawing::svg(&robot, &[0.1, 0.4, -0.1, 0.4]).unwrap();
    let count = |what: &str| drawn.matches(what).count();
    let bodies = robot.bodies().count();
    assert_eq!(count("<circle class=\"m\""), 2 * bodies);
    assert!(
        drawn.contains("nothing: it floats") && drawn.contains(">4 "),
        "{drawn}"
    );
    assert!(!drawn.contains(">5 "), "{drawn}");
}
