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
    let mut seen = 0;
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
        seen += 1;
    }
    assert_eq!(seen, 4);
}
