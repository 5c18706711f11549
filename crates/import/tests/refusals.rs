//! What is refused, by name, with the line of the URDF and what to do about it;
//! and what is said of what is taken.

use crate::support::{has, locks, refused, source, taken, to};
use dalembert_import::{Imported, Options, Snap};
use dalembert_model::read::{self, Severity};

const ARM: &str = r#"<?xml version="1.0"?>
<robot name="Test Arm">
  <link name="world"/>
  <joint name="stand" type="fixed">
    <parent link="world"/> <child link="foot"/> <origin xyz="0 0 .5"/>
  </joint>
  <link name="foot"/>
  <joint name="turn" type="revolute">
    <parent link="foot"/> <child link="upper"/>
    <origin xyz="0.1 0 0.2" rpy="1.5708 0 0"/> <axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" effort="50" velocity="3"/>
    <dynamics damping="0.5" friction="0.25"/>
  </joint>
  <link name="upper">
    <inertial> <origin xyz="0 0 0.1"/> <mass value="2"/>
      <inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0" ixz="0" iyz="0"/> </inertial>
  </link>
  <joint name="reach" type="prismatic">
    <parent link="upper"/> <child link="lower"/> <origin xyz="0.3 0 0"/> <axis xyz="1 0 0"/>
    <limit lower="0" upper="0.4" effort="0" velocity="1"/>
  </joint>
  <link name="lower">
    <inertial> <mass value="1"/>
      <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/> </inertial>
  </link>
  <joint name="grip" type="fixed"> <parent link="lower"/> <child link="hand"/> <origin xyz="0.1 0 0"/> </joint>
  <link name="hand"/>
  <joint name="finger" type="prismatic">
    <parent link="hand"/> <child link="thumb"/> <axis xyz="0 1 0"/> <limit effort="1" velocity="1"/>
  </joint>
  <link name="thumb">
    <inertial> <mass value="0.1"/> <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/> </inertial>
  </link>
  <transmission name="drive">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="turn"/>
    <actuator name="motor"><mechanicalReduction>100</mechanicalReduction><motorInertia>2e-5</motorInertia></actuator>
  </transmission>
</robot>
"#;

fn at_the_hand() -> Options {
    Options {
        snap: true,
        tip: Some("hand".into()),
        without: vec!["thumb".into()],
        ..Options::default()
    }
}

fn with(change: impl FnOnce(&mut Options)) -> Options {
    let mut options = at_the_hand();
    change(&mut options);
    options
}

fn locked(joint: &str, at: &str) -> Options {
    with(|o| o.lock = locks(&[(joint, at)]))
}

fn others(at: &str) -> Options {
    Options {
        lock: locks(&[("*", at)]),
        ..Options::default()
    }
}

fn notes(imported: &Imported) -> Vec<(usize, &str)> {
    let notes = imported.notes.iter();
    notes.map(|note| (note.line, &*note.message)).collect()
}

#[test]
fn the_file_says_what_the_urdf_says() {
    let imported = taken(ARM, &at_the_hand());
    let lines = [
        "# From link world to link hand of a URDF, by `dalembert import`.\n",
        "#   line 10: joint turn, rpy: 1.5708 is taken for pi/2\n",
        "name = \"test_arm\"\n",
        "tool = { xyz = [0.1, 0, 0], rpy = [0, 0, 0] }\n",
        "placement = { xyz = [0.1, 0, 0.7], rpy = [\"pi/2\", 0, 0] }\n",
        "viscous = 0.5\n",
        "armature = 0.2\n",
        "limits = { position = [-1, 2], velocity = 3, torque = 50 }\n",
        "limits = { position = [0, 0.4], velocity = 1 }\n",
    ];
    has(&imported.text, &lines);
    let friction = "the Coulomb friction of joint `turn`, 0.25, is left out";
    let rotor = "rotors are the joints' armatures: `turn` 2e-5 kg·m² × 100² = 0.2";
    let torque = "the limit of torque of joint `reach` is 0";
    // Those that change results come first, and the robot has them.
    let away = "links are left away, with all that hangs on them: `thumb`";
    let changes = [(12, friction), (31, away), (37, rotor)];
    assert_eq!(notes(&imported), [&changes[..], &[(20, torque)]].concat());
    assert_eq!(imported.robot.notes, changes.map(|(_, message)| message));
    let help = imported.notes[0].help.as_deref().unwrap_or_default();
    let way = "`coulomb = 0.25` and `coulomb_width = 0.01`, the speed in rad/s";
    has(help, &[way]);
}

#[test]
fn one_note_for_one_fact() {
    let slow = ARM.replace("effort=\"50\"", "effort=\"0\"").replace(
        "effort=\"0\" velocity=\"1\"/>\n  </joint>\n  <link name=\"lower\">",
        "effort=\"0\" velocity=\"0\"/>\n  <dynamics friction=\"3\"/></joint>\n  <link name=\"lower\">",
    );
    let torques = "the limits of torque of the joints `turn` (0), `reach` (0) are zero or less";
    let frictions = "the Coulomb friction of the joints `turn` (0.25), `reach` (3) is left out";
    let rate = "the limit of velocity of joint `reach` is 0";
    let rotor = "rotors are the joints' armatures: `turn` 2e-5 kg·m² × 100² = 0.2";
    let away = "links are left away, with all that hangs on them: `thumb`";
    let changes = [(12, frictions), (31, away), (37, rotor)];
    let expected = [&changes[..], &[(11, torques), (20, rate)]].concat();
    assert_eq!(notes(&taken(&slow, &at_the_hand())), expected);
    let weightless = ARM.replace("<inertial>", "<!--");
    let weightless = weightless.replace("</inertial>", "-->");
    let imported = taken(&weightless, &at_the_hand());
    let mut massless: Vec<&str> = notes(&imported).iter().map(|note| note.1).collect();
    massless.retain(|message| message.contains("no mass"));
    let expected = "the links `upper`, `lower`, and what is fixed to them, have no mass";
    assert_eq!(massless, [expected]);
}

#[test]
fn what_is_locked_moves_with_the_link() {
    let lock = |joint: &str| {
        let mut lock = locked(joint, "0.05");
        (lock.snap, lock.without) = (false, Vec::new());
        taken(ARM, &lock)
    };
    let ratio = |n: i64, d: i64| dalembert_model::number::Rational::new(n.into(), d.into());
    let (by_name, by_number) = (lock("finger"), lock("3"));
    assert_eq!(by_name.robot.joints[1].mass, ratio(11, 10));
    assert_eq!(by_name.text, by_number.text);
    // (0.1 kg at (0.1, 0.05)) / 1.1 kg, to 20 digits.
    let com = "com = [0.0090909090909090909091, 0.00454545454545454545455, 0]";
    has(&by_name.text, &[com]);
    let without = taken(ARM, &at_the_hand()).robot.joints[1].clone();
    assert_eq!(without.mass, ratio(1, 1));
    // A joint of the chain that is locked is part of the link before.
    let mut short = locked("turn", "90deg");
    short.lock.push(("finger".into(), "0".into()));
    short.without.clear();
    assert_eq!(taken(ARM, &short).robot.joints.len(), 1);
}

#[test]
fn what_hangs_on_the_chain_is_held() {
    let limits = "<limit lower=\"0.01\" upper=\"0.04\" effort=\"1\"";
    let source = ARM.replacen("<limit effort=\"1\"", limits, 1);
    let own = taken(&source, &to("hand", &[("finger", "0.01")]));
    let held = taken(&source, &to("hand", &[("*", "0")]));
    assert_eq!(held.robot, own.robot);
    let said = "joints are held: `finger` at 0.01";
    has(&held.text, &[&format!("    \"{said}\",\n")]);
    assert!(notes(&held).iter().any(|note| note.1 == said));
}

#[test]
fn numbers_are_no_names() {
    for (turn, reach, names) in [("2", "1", ["joint_2", "joint_1"]), ("1", "2", ["1", "2"])] {
        let source = ARM.replace("name=\"turn\"", &format!("name=\"{turn}\""));
        let source = source.replace("name=\"reach\"", &format!("name=\"{reach}\""));
        let joints = taken(&source, &at_the_hand()).robot.joints.into_iter();
        let found: Vec<String> = joints.flat_map(|joint| joint.name).collect();
        assert_eq!(found, names);
    }
}

#[test]
fn exact_digits_are_no_warning() {
    for digits in ["1.5708", "1.5707963267948966", "-3.14159265358979"] {
        let source = ARM.replace("1.5708", digits);
        let text = taken(&source, &with(|o| o.exact = true)).text;
        let reading = read::parse(&text).unwrap();
        assert_eq!(reading.notes, [], "{text}");
    }
}

#[test]
fn chains_begin_behind_floating_joints() {
    let floats = ARM.replacen("type=\"fixed\"", "type=\"floating\"", 1);
    let text = taken(&floats, &at_the_hand()).text;
    assert!(text.starts_with("# From link foot to link hand"), "{text}");
}

#[test]
fn numbers_right_to_sixteen_digits_are_counted() {
    let source = ARM
        .replace("1.5708", "1.570796326794897")
        .replace("upper=\"2\"", "upper=\"3.1416\"");
    let imported = taken(&source, &at_the_hand());
    assert!(imported.snaps.iter().all(|snap| !snap.changes));
    let counted = "2 numbers, limits or right to 16 digits, are written exactly, such as 1.570796326794897 as pi/2";
    assert_eq!(Snap::counted(&imported.snaps).as_deref(), Some(counted));
    has(&imported.text, &[&format!("# {counted}.\n")]);
    let far = taken(ARM, &at_the_hand()).snaps;
    assert!(far[0].changes && Snap::counted(&far).is_none());
}

#[test]
fn limits_are_where_a_joint_can_be() {
    let limits = "lower=\"-1.5707\" upper=\"1.57079\"";
    let source = ARM.replace("lower=\"-1\" upper=\"2\"", limits);
    for at in ["pi/2", "1.5708", "90deg", "-1.5707", "0"] {
        let imported = taken(&source, &locked("turn", at));
        assert_eq!(imported.robot.joints.len(), 1, "{at}");
    }
    let text = refused(&source, &locked("turn", "-pi/2"));
    has(&text, &["limits are -1.5707 to 1.57079"]);
}

#[test]
fn refusals_name_the_joint_and_the_way_out() {
    let hand = at_the_hand();
    let open = with(|o| o.without.clear());
    let mimic = "<mimic joint=\"reach\"/><limit lower=\"-1\"";
    let mimic = ARM.replacen("<limit lower=\"-1\"", mimic, 1);
    let kind = |kind: &str| ARM.replacen("type=\"prismatic\"", &format!("type=\"{kind}\""), 1);
    let cases: Vec<(String, Options, &[&str])> = vec![
        (ARM.into(), open.clone(), &["arm.urdf:28:3", "joint `finger` is prismatic", "add --lock finger=0", "--without thumb"]),
        (mimic, hand.clone(), &["arm.urdf:11", "joint `turn` of the chain mimics `reach`", "--lock turn=0"]),
        (kind("planar"), hand.clone(), &["joint `reach` of the chain is planar", "--base lower"]),
        (kind("floating"), hand.clone(), &["arm.urdf:18:3", "joint `reach` of the chain is floating"]),
        (kind("ball"), hand.clone(), &["arm.urdf:18", "`ball` is no type of joint", "known: revolute"]),
        (ARM.into(), with(|o| o.tip = Some("hnad".into())), &["--tip: there is no link `hnad`", "did you mean `hand`?"]),
        (ARM.into(), with(|o| o.base = Some("hand".into())), &["no joint moves between link `hand` and link `hand`"]),
        (ARM.into(), with(|o| { o.base = Some("thumb".into()); o.without.clear(); }), &["link `hand` does not hang on link `thumb`"]),
        (ARM.into(), locked("fingr", "0"), &["--lock: there is no joint `fingr`", "did you mean `finger`?"]),
        (ARM.into(), locked("0", "0"), &["--lock: there is no joint `0`", "those that move are 1 to 3, from the root outwards"]),
        (ARM.into(), locked("4", "0"), &["--lock: there is no joint `4`"]),
        (ARM.into(), locked("finger", "90deg"), &["--lock finger: `90deg` is not"]),
        (ARM.into(), locked("turn", "90"), &["arm.urdf:11:19", "--lock turn=90: the joint's limits are -1 to 2", "degrees are written as 90deg"]),
        (ARM.into(), locked("turn", "-90deg"), &["--lock turn=-90deg: the joint's limits are -1 to 2", "lock it where it can be"]),
        (ARM.into(), locked("reach", "0.41"), &["arm.urdf:20:19", "--lock reach=0.41: the joint's limits are 0 to 0.4"]),
        (ARM.replacen("<limit effort=\"1\"", "<limit lower=\"0.01\" upper=\"0.04\" effort=\"1\"", 1), open.clone(), &["add --lock finger=0.01, or"]),
        (ARM.into(), locked("stand", "0"), &["a fixed joint has no position"]),
        (ARM.into(), with(|o| o.without = vec!["finger".into()]), &["--without: there is no link `finger`", "`finger` is a joint; its link is `thumb`"]),
        (ARM.into(), with(|o| o.without = vec!["lower".into()]), &["--without lower: the chain passes through it"]),
        (ARM.replace("<mass value=\"2\"/>", ""), hand.clone(), &["arm.urdf:15:5", "the inertial of link `upper` has no <mass>"]),
        (ARM.replace("<mass value=\"2\"/>", "<mass value=\"-2\"/>"), hand.clone(), &["the mass of link `upper` is negative"]),
        (ARM.replace("ixx=\"0.02\" iyy=\"0.03\"", "ixx=\"0.02m\" iyy=\"0.03\""), hand.clone(), &["arm.urdf:16:21", "`0.02m` is not a decimal number"]),
        (ARM.replace("lower=\"-1\" upper=\"2\"", "lower=\"2\" upper=\"-1\""), hand.clone(), &["arm.urdf:11:19", "the limits of joint `turn` are reversed"]),
        (ARM.replace("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>"), hand.clone(), &["the axis of joint `turn` has no direction"]),
        (ARM.replace("xyz=\"0.1 0 0.2\"", "xyz=\"0.1 0\""), hand.clone(), &["arm.urdf:10:18", "`xyz` has 2 numbers, not 3"]),
        (ARM.replace("<child link=\"lower\"/>", "<child link=\"lowr\"/>"), hand.clone(), &["there is no link `lowr`", "did you mean `lower`?"]),
        (ARM.replace("<child link=\"lower\"/>", "<child link=\"foot\"/>"), hand.clone(), &["link `foot` hangs on joint `stand` already", "closed loops"]),
        (ARM.replace("<robot", "<robots").replace("</robot>", "</robots>"), hand.clone(), &["<robots> is no URDF"]),
        ("<mujoco/>".into(), hand.clone(), &["arm.urdf:1:1", "there are no bodies"]),
        ("joints: 3".into(), hand.clone(), &["no XML", "a URDF is XML"]),
        (ARM.replace("</robot>", ""), hand.clone(), &["the file ends before its XML does", "a URDF ends in </robot>"]),
        (ARM[..ARM.len() / 2].into(), hand.clone(), &["arm.urdf:", "the file ends before its XML does", "cut off"]),
        (
            ARM.replace("<link name=\"world\"/>", "<xacro:macro xmlns:xacro=\"http://www.ros.org/wiki/xacro\"/><link name=\"world\"/>"),
            hand.clone(),
            &["arm.urdf:3:3", "run `xacro arm.urdf.xacro > arm.urdf` first"],
        ),
        (ARM.replace("value=\"2\"", "value=\"${m}\""), hand.clone(), &["arm.urdf:15:", "`${m}` is not expanded", "run `xacro"]),
        (ARM.replace("<link name=\"world\"/>", "<gazebo> $(find arm)/x </gazebo><link name=\"world\"/>"), hand.clone(), &["arm.urdf:3:12", "`$(find` is not expanded", "run `xacro"]),
        // Without the namespace, which the parser would complain of.
        (ARM.replace("<link name=\"world\"/>", "<xacro:include filename=\"x\"/>"), hand.clone(), &["arm.urdf:3:3", "`<xacro:include` is not expanded", "run `xacro"]),
        (ARM.replace("izz=\"0.04\"", "izz=\"-0.04\""), hand.clone(), &["arm.urdf:16:21", "link `upper`: no body has this inertia: a principal moment is negative"]),
        (ARM.into(), with(|o| o.tip = Some("HAND".into())), &["did you mean `hand`?"]),
        (ARM.replace("name=\"hand\"", "name=\"arm_hand\"").replace("link=\"hand\"", "link=\"arm_hand\""), hand.clone(), &["--tip: there is no link `hand`", "did you mean `arm_hand`?"]),
        (ARM.into(), with(|o| { o.lock = vec![("*".into(), "much".into())]; o.without.clear(); }), &["--lock finger: `much` is not"]),
    ];
    for (source, options, parts) in cases {
        has(&refused(&source, &options), parts);
    }
}

#[test]
fn all_at_once() {
    let source = ARM
        .replace("<mass value=\"2\"/>", "")
        .replace("xyz=\"0.1 0 0.2\"", "xyz=\"0.1 0\"")
        .replace("type=\"prismatic\"", "type=\"slider\"");
    let text = refused(&source, &at_the_hand());
    assert_eq!(text.matches("error: ").count(), 4, "{text}");
    // Nothing is said of what lacks because of a link or a joint that could not be read.
    for (what, by) in [
        ("<mass value=\"2\"/>", ""),
        ("xyz=\"0.1 0 0.2\"", "xyz=\"0.1 0 up\""),
    ] {
        let text = refused(&ARM.replace(what, by), &at_the_hand());
        assert_eq!(text.matches("error: ").count(), 1, "{text}");
    }
}

#[test]
fn doubtful_inertials_are_named() {
    let flat = ARM.replace("izz=\"0.04\"", "izz=\"0.4\"");
    let start = ARM.find("<link name=\"upper\">").unwrap();
    let end = start + ARM[start..].find("</link>").unwrap();
    let bare = format!("{}<link name=\"upper\">{}", &ARM[..start], &ARM[end..]);
    let impossible = "link `upper`: no body has this inertia";
    let missing = "link `upper`, and what is fixed to it, has no mass";
    let cases = [
        (&flat, Some((16, impossible))),
        (&bare, Some((14, missing))),
    ];
    for (source, expected) in cases.into_iter().chain([(&ARM.to_owned(), None)]) {
        let mut found = taken(source, &at_the_hand()).notes;
        found.retain(|note| note.severity == Severity::Warning);
        assert_eq!(found.len(), usize::from(expected.is_some()), "{found:?}");
        for (own, (line, message)) in found.iter().zip(expected) {
            assert_eq!(own.line, line);
            has(&own.message, &[message]);
        }
    }
}

#[test]
fn a_base_that_is_not_the_root_is_said() {
    let imported = taken(ARM, &with(|o| o.base = Some("foot".into())));
    let said = (7, "link `foot` is the base, and not the root");
    assert!(notes(&imported).contains(&said));
    let placement = "placement = { xyz = [0.1, 0, 0.2], rpy = [\"pi/2\", 0, 0] }";
    has(&imported.text, &[placement]);
}

#[test]
fn the_end_is_the_palm_or_where_nothing_hangs() {
    let panda = source("panda");
    let finger = "joint `panda_finger_joint2` is prismatic, mimics `panda_finger_joint1`";
    let text = refused(&panda, &Options::default());
    let all = "--lock-others 0 holds all that hangs on the chain";
    has(&text, &[finger, "--lock panda_finger_joint1=0", all]);
    let held = taken(&panda, &others("0"));
    let ends = "the chain ends at link `panda_hand`; `panda_hand_tcp` moves with it";
    assert!(notes(&held).iter().any(|note| note.1 == ends));
    // One finger is no chain's end either, and where nothing hangs there is one end.
    let thumb = Options {
        without: vec!["thumb".into()],
        ..Options::default()
    };
    let (z1, so101) = (source("z1"), source("so101"));
    for (source, options, end) in [
        (&*z1, others("0"), "gripperStator"),
        (&so101, others("0"), "gripper_link"),
        (ARM, thumb, "hand"),
    ] {
        let imported = taken(source, &options);
        let said = format!("the chain ends at link `{end}`");
        let notes = notes(&imported);
        assert!(notes.iter().any(|note| note.1 == said), "{notes:?}");
    }
}

#[test]
fn one_of_several_chains_holds_the_others() {
    let robot = |joints: &[[&str; 3]]| {
        let joints = joints.iter().map(|[kind, on, link]| {
            format!(
                "<joint name='j_{link}' type='{kind}'><parent link='{on}'/><child link='{link}'/>\
                 <axis xyz='1 0 0'/></joint><link name='{link}'><inertial><mass value='1'/>\
                 <inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
            )
        });
        let joints: String = joints.collect();
        format!("<robot name='two'><link name='base'/>{joints}</robot>")
    };
    let arms = robot(&[
        ["continuous", "base", "torso"],
        ["continuous", "torso", "left"],
        ["continuous", "torso", "right"],
    ]);
    let help = "choose the end by --tip: left, right; --lock-others 0 holds all else that hangs on the chain";
    let text = refused(&arms, &Options::default());
    has(&text, &["2 chains have 2 joints", help]);
    let right = taken(&arms, &to("right", &[("*", "0")]));
    has(&right.text, &["\"j_right\""]);
    let frames = robot(&[
        ["continuous", "base", "arm"],
        ["fixed", "arm", "front"],
        ["fixed", "arm", "back"],
    ]);
    let front = taken(&frames, &Options::default());
    let said = "the chain ends at link `front`; `back` moves with it";
    assert_eq!(notes(&front)[0].1, said);
    let help = front.notes[0].help.as_deref().unwrap_or_default();
    has(help, &["--tip back", "torques are the same"]);
    let tool = frames.replace("back", "tool");
    let tool = taken(&tool, &Options::default());
    assert!(tool.text.starts_with("# From link base to link tool "));
    assert_eq!(front.robot.joints, tool.robot.joints);
}

#[test]
fn a_rotor_has_its_own_reduction() {
    let own = "<mechanicalReduction>100</mechanicalReduction><motorInertia>2e-5</motorInertia>";
    assert!(ARM.contains(own));
    let armature = |actuator: &str| {
        let source = ARM.replacen(own, actuator, 1);
        let source = source.replacen("<robot ", "<robot xmlns:drake=\"http://drake.mit.edu\" ", 1);
        let imported = taken(&source, &at_the_hand());
        let mut lines = imported.text.lines();
        let line = lines.find_map(|line| line.strip_prefix("armature = "));
        let notes: String = notes(&imported).iter().map(|note| note.1).collect();
        (line.map(str::to_owned), notes)
    };
    for (actuator, expected) in [
        (own, Some("2e-5 kg·m² × 100² = 0.2")),
        (
            "<mechanicalReduction>1</mechanicalReduction><drake:gear_ratio value=\"160\"/>\
             <drake:rotor_inertia value=\"1e-4\"/>",
            Some("1e-4 kg·m² × 160² = 2.56"),
        ),
        (
            "<rotorInertia>1e-4</rotorInertia><gear_ratio>7</gear_ratio><mechanicalReduction>30</mechanicalReduction>",
            Some("1e-4 kg·m² × 30² = 0.09"),
        ),
        (
            "<motorInertia>0.5</motorInertia>",
            Some("0.5 kg·m² × 1² = 0.5"),
        ),
        ("<mechanicalReduction>100</mechanicalReduction>", None),
    ] {
        let (line, notes) = armature(actuator);
        let value = expected.map(|said| said.rsplit(' ').next().unwrap().to_owned());
        assert_eq!(line, value, "{actuator}");
        let said = expected.map(|said| format!("rotors are the joints' armatures: `turn` {said}"));
        assert!(said.is_none_or(|said| notes.contains(&said)), "{notes}");
        assert_eq!(notes.contains("rotors"), expected.is_some(), "{notes}");
    }
}

#[test]
fn torques_are_not_moved_unasked() {
    let with_snap = |angle: &str, snap: bool| {
        let source = ARM.replace("1.5708", angle);
        taken(&source, &with(|o| o.snap = snap))
    };
    // Off by 3.7e-6 rad, and by 2.1e-12.
    let (kept, moved) = (with_snap("1.5708", false), with_snap("1.5708", true));
    let near = with_snap("1.570796326797", false);
    has(&kept.text, &["rpy = [1.5708, 0, 0]"]);
    // Of digits that stay, the reader of robot files has nothing to say.
    let again = read::parse(&kept.text).unwrap();
    assert_eq!(again.notes, []);
    let stay = "rounded numbers stay as they are";
    assert!(notes(&kept).iter().any(|note| note.1.contains(stay)));
    has(&moved.text, &["rpy = [\"pi/2\", 0, 0]"]);
    assert!(moved.change.unwrap().relative() > 1e-6);
    has(&near.text, &["rpy = [\"pi/2\", 0, 0]"]);
    assert!(near.change.unwrap().relative() < 1e-6);
}

#[test]
fn limits_of_acceleration_and_names_are_options() {
    let twelve = dalembert_model::number::Rational::from_integer(12.into());
    let options = with(|o| (o.acceleration, o.name) = (Some(twelve), Some("other".into())));
    let imported = taken(ARM, &options);
    let limits = imported.text.matches("acceleration = 12 }").count();
    assert_eq!((limits, &*imported.robot.name), (2, "other"));
}
