//! The six robots read well, and survive a round through the canonical text.

use crate::support::{ROBOTS, generated, has, ratio, reading, refused, replaced, rows, written};
use dalembert_model::number::{Angle, Rational, Rounded};
use dalembert_model::read::{RobotWarning, Severity, parse};
use dalembert_model::robot::{Convention, Position, Robot};

fn robot(name: &str) -> Robot {
    reading(&generated(name)).robot
}

#[test]
fn numbers_are_exact() {
    let puma = robot("puma560");
    assert_eq!(puma.joints[1].a, ratio(4318, 10_000));
    assert_eq!(puma.gravity[2], ratio(-981, 100));
    assert_eq!(puma.joints[0].alpha, Angle::right_angles(1));
    assert_eq!(puma.joints[5].limits.torque, Some(ratio(213, 10)));
    assert_eq!(puma.joints[0].d, ratio(67_183, 100_000));
    let turn = [-2, 2].map(|n| Position::Angle(Angle::right_angles(n)));
    assert_eq!(puma.joints[0].limits.position, Some(turn));
    let rod = &robot("planar2r").joints[0].inertia;
    assert_eq!(f64::nearest_rational(&rod.zz), 1.0 / 12.0);
}

#[test]
fn notes() {
    for name in ROBOTS {
        let text = generated(name);
        assert_eq!(reading(&text).notes, [], "{name}");
        let lines = text.lines();
        let loud: Vec<&str> = lines
            .map(|line| if line.starts_with("allow") { "" } else { line })
            .collect();
        let reading = reading(&loud.join("\n"));
        for note in &reading.notes {
            assert_eq!(note.severity, Severity::Warning);
            has(note, "no body has this inertia", "");
            let line = loud[note.line().unwrap() - 1];
            assert!(line.starts_with("inertia"), "{note}");
        }
        let expected = match name {
            "puma560" => 2,
            "stanford" | "ur10" => 1,
            _ => 0,
        };
        assert_eq!(reading.notes.len(), expected, "{name}");
    }
}

#[test]
fn round_trip() {
    for name in ROBOTS {
        let robot = robot(name);
        let joints = robot.joints.iter();
        let mut angles = joints.flat_map(|joint| [&joint.alpha, &joint.theta]);
        assert!(angles.all(|angle| angle.quarter_turns().is_some()));
        let text = written(&robot);
        let again = reading(&text).robot;
        assert_eq!(again.input_hash(), robot.input_hash());
        assert_eq!(written(&again), text);
    }
}

#[test]
fn hash() {
    let puma = robot("puma560");
    let text = generated("puma560");
    let same = reading(&replaced(&text, "mass = 17.4", "mass   = 1.740e1 # kg")).robot;
    assert_eq!(puma.short_hash(), same.short_hash());
    let mut noted = puma.clone();
    let note = "the springs of `a` \\ \"b\" are left out";
    noted.notes = vec![note.into(), String::new()];
    assert_eq!(puma.input_hash(), noted.input_hash());
    assert_eq!(reading(&written(&noted)).robot.notes, noted.notes);
    assert_eq!(puma.short_hash().len(), 16);

    type Change = fn(&mut Robot);
    let changes: [Change; 14] = [
        |r| r.name.push('x'),
        |r| r.convention = Convention::Modified,
        |r| r.gravity[0] = ratio(1, 1_000_000),
        |r| r.joints[0].name = None,
        |r| r.joints[1].alpha = Angle::right_angles(1),
        |r| r.joints[1].a += ratio(1, 3),
        |r| r.joints[1].d += ratio(1, 1 << 40),
        |r| r.joints[1].theta = Angle::Radians(ratio(1, 2)),
        |r| r.joints[1].mass += ratio(1, 10),
        |r| r.joints[1].com[2] += ratio(1, 10),
        |r| r.joints[1].inertia.yz += ratio(1, 10),
        |r| r.joints[1].viscous += ratio(1, 10),
        |r| r.joints[1].armature += ratio(1, 10),
        |r| r.joints[1].limits.velocity = None,
    ];
    let mut hashes = std::collections::BTreeSet::from([puma.input_hash()]);
    for (i, change) in changes.iter().enumerate() {
        let mut other = puma.clone();
        change(&mut other);
        assert!(hashes.insert(other.input_hash()), "change {i} is not seen");
    }
}

#[test]
fn doubles_and_fractions_round_trip() {
    let mut robot = robot("stanford");
    let double = |x: f64| Rational::from_float(x).expect("finite");
    robot.joints[0].mass = double(0.1);
    robot.joints[1].mass = double(1.234e-299);
    robot.joints[2].mass = double(9.87e299);
    robot.joints[2].d = ratio(-1, 3);
    robot.joints[3].mass = ratio(1, 7);
    robot.joints[3].theta = Angle::Radians(ratio(1, 3));
    robot.joints[4].theta = Angle::PiTimes(ratio(-5, 7));
    robot.joints[5].name = Some("\"quoted\" \\ ünïcode".into());
    robot.joints[5].mass = ratio(i64::MAX, 1) * ratio(100, 1);
    written(&robot);
}

#[test]
fn known_robots_are_not_far_off() {
    let root = env!("CARGO_MANIFEST_DIR");
    let mut count = 0;
    for folder in "generated/robots gallery/robots crates/model/tests/data".split(' ') {
        let entries = std::fs::read_dir(format!("{root}/{folder}")).unwrap();
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let source = std::fs::read_to_string(&path).unwrap();
            let Ok(reading) = parse(&source) else {
                continue;
            };
            count += 1;
            for far in [RobotWarning::LargeInertia, RobotWarning::LargeWidth] {
                let is_far = reading.notes.iter().any(|note| note.warning == Some(far));
                assert!(!is_far, "{}", path.display());
            }
        }
    }
    assert!(count > 25, "{count}");
}

const TIED: &str = "name = \"tied\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n\
    [[joint]]\nname = \"a\"\nkind = \"revolute\"\nmass = 1\ncom = [0.1, 0, 0]\ninertia = [0.1, 0.1, 0.1, 0, 0, 0]\n\
    [[joint]]\nname = \"b\"\nkind = \"revolute\"\na = 0.4\nmass = 0\nMIMIC\n\
    [[joint]]\nname = \"c\"\nkind = \"prismatic\"\nmass = 2\ncom = [0, 0, 0]\ninertia = [0.1, 0.1, 0.1, 0, 0, 0]\n";

#[test]
fn followers_read_back() {
    let chained = "limits = { position = [-2, 1], velocity = 3 }\nmimic = { joint = 3, multiplier = -2, offset = \"pi/2\" }";
    let text = TIED.replace("MIMIC", chained).replace(
        "kind = \"prismatic\"",
        "kind = \"revolute\"\nmimic = { joint = \"a\", multiplier = 3, offset = \"-pi/4\" }",
    );
    let robot = reading(&text).robot;
    let [b, c] = &robot.followers[..] else {
        panic!("{:?}", robot.followers)
    };
    assert_eq!((b.leader, b.turns(), c.leader, c.turns()), (0, -6, 0, 3));
    assert_eq!(b.offset, Position::Angle(Angle::PiTimes(ratio(1, 1))));
    assert_eq!(robot.joints[0].limits.velocity, Some(ratio(1, 2)));
    written(&robot);
    let is_wrong = |robot: &Robot| {
        let mut findings = robot.validate().into_iter();
        findings.any(|finding| finding.warning.is_none())
    };
    assert!(!is_wrong(&robot));
    let mut torn = robot;
    torn.followers.swap(0, 1);
    assert!(is_wrong(&torn));
}

const UNFOLLOWED: &str = r#"
joint = 2 | the joint follows itself
joint = "c" | one of the two joints turns and the other slides
joint = "d" | there is no link `d`
joint = 1, multiplier = 0 | a multiplier of 0: the joint never moves
joint = 1, multiplier = -0.5 | let that joint mimic this one, with multiplier = -2
joint = 1, multiplier = 17 | sines are of whole multiples of an angle, up to 16
joint = 1, factor = 2 | unknown key `factor`
multiplier = 1 | mimic has no `joint`
joint = 1 }\ncoulomb = 1\ncoulomb_width = 1\nframe = { | `coulomb` of a joint that follows another
"#;

#[test]
fn what_cannot_follow_is_refused() {
    let text = |mimic: &str| TIED.replace("MIMIC", &format!("mimic = {{ {mimic} }}"));
    for [mimic, says] in rows(UNFOLLOWED) {
        let shown = refused(&text(&mimic));
        assert!(shown.contains(&says), "{says}: {shown}");
    }
    let tied = text("joint = 1");
    let circle = replaced(&tied, "mass = 1\n", "mass = 1\nmimic = { joint = 2 }\n");
    assert!(refused(&circle).contains("in a circle"));
    let shown = refused(&(tied + "[scene.s]\nlock = { b = 0 }\n"));
    assert!(shown.contains("follows another"), "{shown}");
    assert!(shown.contains("joint 1 (a)"), "{shown}");
}
