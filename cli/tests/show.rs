//! `dalembert show`: the drawing of an arm.

use std::fs;

use crate::support::{good, robot, run, temporary};

#[test]
fn the_same_drawing_twice() {
    let folder = temporary("show");
    for name in ["puma560", "stanford", "panda", "planar2r"] {
        let file = folder.join(format!("{name}.svg"));
        good(&["show", &robot(name), "-o", file.to_str().unwrap()]);
        let svg = fs::read_to_string(&file).unwrap();
        assert_eq!(run(&["show", &robot(name)]).out, svg);
        assert!(svg.starts_with("<svg xmlns=") && svg.ends_with("</svg>\n"));
        assert!(svg.contains(&format!("<title>{name}</title>")));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
        // Every element ends where it begins, or is closed.
        assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
    }
    let svg = fs::read_to_string(folder.join("puma560.svg")).unwrap();
    // Two views of five links with mass; no body has the elbow's inertia, and in
    // one view that is seen.
    assert_eq!(svg.matches("class=\"m\"").count(), 10);
    assert_eq!(svg.matches("<ellipse").count(), 9);
    assert!(svg.contains("one principal moment exceeds the sum"));
    for part in [
        "from the front: x to the right, z up",
        "from above: x to the right, y up",
        "standard DH, gravity (0, 0, -9.81)",
        "drawn at q = (0, 0, 0, 0, 0, 0)",
        // Their axes lie behind each other at this position.
        ">3, 4, 6</text>",
        "1 waist",
        "(-0.3638, 0.006, 0.2275)",
    ] {
        assert!(svg.contains(part), "{part}");
    }
}

#[test]
fn at_a_position() {
    let puma = robot("puma560");
    let drawn = |at: &str| run(&["show", &puma, "--at", at]);
    let still = run(&["show", &puma]).out;
    assert_eq!(drawn("0,0,0,0,0,0").out, still);
    let bent = drawn("0,-pi/2,90deg,0,0.1,-0.2");
    assert_eq!(bent.code, 0, "{}", bent.err);
    assert_ne!(bent.out, still);
    assert!(
        bent.out
            .contains("drawn at q = (0, -1.5708, 1.5708, 0, 0.1, -0.2)")
    );
    assert!(!bent.err.contains("--at"), "{}", bent.err);
    // Degrees by mistake: drawn as it stands.
    let degrees = drawn("0,-90,90deg,0,0,0");
    assert_eq!(degrees.code, 0);
    assert!(
        degrees.err.contains("warning: --at: joint 2 (")
            && degrees
                .err
                .contains("radians? -90 degrees are -1.5708, or write -90deg"),
        "{}",
        degrees.err
    );
    for (at, part) in [
        ("0,0", "`q` has 2 values, the arm has 6 joints"),
        ("0,0,0,0,0,x", "--at: `x` is not a decimal number"),
    ] {
        let ran = drawn(at);
        assert_eq!(ran.code, 2);
        ran.says(&[part]);
    }
    let ran = run(&["show", &puma, "-o", &puma]);
    ran.says(&["would be written over the robot file"]);
}

/// The outlines of the bodies of both views, each within its half of the paper.
#[test]
fn bodies_stay_on_the_paper() {
    let folder = temporary("show_large");
    let file = folder.join("large.toml");
    let planar = fs::read_to_string(robot("planar2r")).unwrap();
    let large = planar.replace("[0, 0.08333333333333333, 0.08333333333333333,", "[1, 3, 3,");
    assert_ne!(large, planar);
    fs::write(&file, large).unwrap();
    let ran = good(&["show", file.to_str().unwrap(), "--at", "0.6,0.7"]);
    let number = |text: &str, before: &str, after: char| -> f64 {
        let start = text.find(before).unwrap() + before.len();
        let rest = &text[start..];
        rest[..rest.find(after).unwrap()].parse().unwrap()
    };
    let mut seen = 0;
    for line in ran.out.lines().filter(|line| line.contains("<ellipse")) {
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
