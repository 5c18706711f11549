//! The six robots read well, mean what the golden data means, and survive a
//! round through the canonical text.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::read::{Options, RobotWarning, Severity, parse, parse_bytes};
use dalembert_model::robot::{Convention, Inertia, JointKind, Position, Robot, write};
use num_traits::ToPrimitive;

const NAMES: [&str; 6] = [
    "puma560", "stanford", "ur10", "panda", "planar2r", "planar3r",
];

fn source(name: &str) -> String {
    let path = format!(
        "{}/../generated/robots/{name}.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path).expect("robot file")
}

fn robot(name: &str) -> Robot {
    let text = source(name);
    match parse(&text, &Options::default()) {
        Ok(reading) => reading.robot,
        Err(errors) => panic!("{}", errors.render(name, &text)),
    }
}

fn ratio(numer: i64, denom: i64) -> Rational {
    Rational::new(numer.into(), denom.into())
}

/// Numbers come from the source text: 0.4318 is 4318/10000, not a double.
#[test]
fn numbers_are_exact() {
    let puma = robot("puma560");
    assert_eq!(puma.joints[1].a, ratio(4318, 10_000));
    assert_eq!(puma.gravity[2], ratio(-981, 100));
    assert_eq!(puma.joints[0].alpha, Angle::right_angles(1));
    assert_eq!(puma.joints[5].limits.torque, Some(ratio(213, 10)));
    assert_eq!(
        puma.joints[0].limits.position,
        Some([
            Position::Angle(Angle::right_angles(-2)),
            Position::Angle(Angle::right_angles(2))
        ])
    );
    let rod = &robot("planar2r").joints[0].inertia;
    assert_eq!(rod.zz.to_f64(), Some(1.0 / 12.0));
}

/// Conventions, kinds and the joint's variable end up where they belong.
#[test]
fn structure() {
    let panda = robot("panda");
    assert_eq!(panda.convention, Convention::Modified);
    assert_eq!(panda.joints.len(), 7);
    let stanford = robot("stanford");
    let kinds = stanford.joints.iter().map(|j| j.kind);
    let prismatic = kinds.map(|k| k == JointKind::Prismatic).collect::<Vec<_>>();
    assert_eq!(prismatic, [false, false, true, false, false, false]);
    assert_eq!(stanford.joints[2].theta, Angle::right_angles(-1));
    // Six numbers are xx, yy, zz, xy, yz, xz.
    let Inertia { xy, yz, xz, .. } = &panda.joints[0].inertia;
    assert_eq!(
        [xy, yz, xz],
        [
            &ratio(-139, 1_000_000),
            &ratio(19_169, 1_000_000),
            &ratio(6772, 1_000_000)
        ]
    );
}

/// The checked-in files silence what there is to say of inertias as published; without
/// their `allow` it is said, at the lines of these inertias.
#[test]
fn notes() {
    for name in NAMES {
        let text = source(name);
        let reading = parse(&text, &Options::default()).expect("reads");
        assert!(reading.notes.is_empty(), "{name}: {:?}", reading.notes);
        let loud: Vec<&str> = text
            .lines()
            .map(|line| if line.starts_with("allow") { "" } else { line })
            .collect();
        let reading = parse(&loud.join("\n"), &Options::default()).expect("reads");
        for note in &reading.notes {
            assert_eq!(note.severity, Severity::Warning);
            assert!(note.message.contains("no body has this inertia"), "{note}");
            assert!(loud[note.line - 1].starts_with("inertia"), "{note}");
        }
        let expected = match name {
            "puma560" => 2,
            "stanford" | "ur10" => 1,
            _ => 0,
        };
        assert_eq!(reading.notes.len(), expected, "{name}");
    }
}

/// The canonical text says the same robot, and does not change again.
#[test]
fn round_trip() {
    for name in NAMES {
        let robot = robot(name);
        let text = write(&robot);
        let again = parse_bytes(text.as_bytes(), &Options::default())
            .expect("reads")
            .robot;
        assert_eq!(again, robot, "{name}");
        assert_eq!(write(&again), text);
        assert_eq!(again.input_hash(), robot.input_hash());
    }
}

/// Every parameter takes part in the hash, and nothing else does.
#[test]
fn hash() {
    let puma = robot("puma560");
    let spaced = source("puma560").replace("mass = 17.4", "mass   = 1.740e1 # kg");
    let same = parse(&spaced, &Options::default()).expect("reads").robot;
    assert_eq!(puma.short_hash(), same.short_hash());
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
    let mut seen = std::collections::BTreeSet::from([puma.input_hash()]);
    for (i, change) in changes.iter().enumerate() {
        let mut other = puma.clone();
        change(&mut other);
        assert!(seen.insert(other.input_hash()), "change {i} is not seen");
    }
}

/// A robot filled in from doubles survives the text to the last bit, and so
/// do numbers without a decimal.
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
    let text = write(&robot);
    let again = parse(&text, &Options::default())
        .unwrap_or_else(|e| panic!("{}", e.render("robot", &text)));
    assert_eq!(again.robot, robot);
}

/// The golden data is computed from doubles; each is the file's number
/// rounded, but for two noisy ones.
#[test]
fn files_agree_with_their_sources() {
    let puma = robot("puma560");
    let off = puma.joints[0].d.to_f64().expect("finite") - 0.671_829_999_999_999_9;
    assert!(off.abs() < 2e-16);
    for name in NAMES {
        for joint in &robot(name).joints {
            assert!(joint.alpha.quarter_turns().is_some());
            assert!(joint.theta.quarter_turns().is_some());
        }
    }
}

/// None of the robots that are checked in is odd in a way that its file does not know.
#[test]
fn known_robots_are_not_far_off() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let mut seen = 0;
    for folder in ["generated/robots", "gallery/robots", "model/tests/data"] {
        let entries = std::fs::read_dir(format!("{root}/{folder}")).unwrap();
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            let source = std::fs::read_to_string(&path).unwrap();
            let Ok(reading) = parse(&source, &Options::default()) else {
                continue;
            };
            seen += 1;
            let mut doubts = reading.notes.iter().filter_map(|note| note.warning);
            let far = |warning: &RobotWarning| {
                matches!(
                    warning,
                    RobotWarning::LargeInertia | RobotWarning::LargeWidth
                )
            };
            assert_eq!(doubts.find(far), None, "{}", path.display());
        }
    }
    assert!(seen > 25, "{seen}");
}

const TIED: &str = "name = \"tied\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n\
    [[joint]]\nname = \"a\"\nkind = \"revolute\"\nmass = 1\ncom = [0.1, 0, 0]\ninertia = [0.1, 0.1, 0.1, 0, 0, 0]\n\
    [[joint]]\nname = \"b\"\nkind = \"revolute\"\na = 0.4\nmass = 0\nMIMIC\n\
    [[joint]]\nname = \"c\"\nkind = \"prismatic\"\nmass = 2\ncom = [0, 0, 0]\ninertia = [0.1, 0.1, 0.1, 0, 0, 0]\n";

/// A follower of a follower is its leader's, and the text says so.
#[test]
fn followers_read_back() {
    let chained = "limits = { position = [-2, 1], velocity = 3 }\nmimic = { joint = 3, multiplier = -2, offset = \"pi/2\" }";
    let text = TIED.replace("MIMIC", chained).replace(
        "kind = \"prismatic\"",
        "kind = \"revolute\"\nmimic = { joint = \"a\", multiplier = 3, offset = \"-pi/4\" }",
    );
    let robot = parse(&text, &Options::default()).unwrap().robot;
    let [b, c] = &robot.followers[..] else {
        panic!("{:?}", robot.followers)
    };
    assert_eq!((b.leader, b.turns(), c.leader, c.turns()), (0, -6, 0, 3));
    assert_eq!(b.offset, Position::Angle(Angle::PiTimes(ratio(1, 1))));
    assert_eq!(robot.joints[0].limits.velocity, Some(ratio(1, 2)));
    let again = parse(&write(&robot), &Options::default()).unwrap().robot;
    assert_eq!(again, robot);
    assert!(
        robot
            .validate()
            .iter()
            .all(|finding| finding.warning.is_some())
    );
    let mut torn = robot;
    torn.followers.swap(0, 1);
    assert!(
        torn.validate()
            .iter()
            .any(|finding| finding.warning.is_none())
    );
}

#[test]
fn what_cannot_follow_is_refused() {
    for (mimic, says) in [
        ("joint = 2", "a joint that follows itself"),
        (
            "joint = \"c\"",
            "one of both joints turns, and the other slides",
        ),
        ("joint = \"d\"", "there is no link `d`"),
        (
            "joint = 1, multiplier = 0",
            "a multiplier of 0: the joint never moves",
        ),
        (
            "joint = 1, multiplier = -0.5",
            "let that joint mimic this one, with multiplier = -2",
        ),
        (
            "joint = 1, multiplier = 17",
            "sines are of whole multiples of an angle, up to 16",
        ),
        ("joint = 1, factor = 2", "unknown key `factor`"),
        ("multiplier = 1", "mimic has no `joint`"),
        (
            "joint = 1 }\ncoulomb = 1\ncoulomb_width = 0.1\nframe = { xyz = [0, 0, 0]",
            "`coulomb` of a joint that follows another",
        ),
    ] {
        let text = TIED.replace("MIMIC", &format!("mimic = {{ {mimic} }}"));
        let errors = parse(&text, &Options::default()).unwrap_err();
        let shown = errors.render("tied.toml", &text);
        assert!(shown.contains(says), "{says}: {shown}");
    }
    let circle = TIED.replace("MIMIC", "mimic = { joint = 1 }");
    let circle = circle.replacen("mass = 1\n", "mass = 1\nmimic = { joint = 2 }\n", 1);
    let shown = parse(&circle, &Options::default()).unwrap_err();
    assert!(shown.render("tied.toml", &circle).contains("in a circle"));
    let scene = TIED.replace("MIMIC", "mimic = { joint = 1 }") + "[scene.s]\nlock = { b = 0 }\n";
    let shown = parse(&scene, &Options::default())
        .unwrap_err()
        .render("tied.toml", &scene);
    assert!(
        shown.contains("follows another") && shown.contains("joint 1 (a)"),
        "{shown}"
    );
}
